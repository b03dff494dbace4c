// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// A background below a clear sky sphere; without alpha its transmit is black.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
#default { finish { ambient 0.05 diffuse 0.7 } }
camera { location <0, 1.2, -6> look_at <0, 1.5, 0> right x * 4 / 3 up y angle 80 }
light_source { <4, 7, -5> rgb 1 }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <0.9, 0.3, 0.2> } }
sphere { <1.5, 1, 0>, 1 pigment { rgbf 0.9 } finish { diffuse 0.1 } interior { ior 1.3 } }
sphere { <0, 1, 2.5>, 1 pigment { rgb 0.1 } finish { reflection 0.8 } }
background { rgbft <0.2, 0.3, 0.5, 0.1, 0.2> }
sky_sphere { pigment { rgbft <0.9, 0.5, 0.2, 0.3, 0.3> } pigment { rgbft <0.2, 0.9, 0.3, 0.5, 0.2> } }
