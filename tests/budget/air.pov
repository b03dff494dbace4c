// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Scattering media, whose samples are jittered, and a lamp's beam in them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> direction z right 4/3*x up y }
light_source { <-2, 4, 0> rgb 2 spotlight point_at <0, 0, 0.5> radius 9 falloff 14 }
media { scattering { 1, rgb 0.12 extinction 0.5 } intervals 2 samples 2, 2 method 1 }
plane { y, -0.5 pigment { rgb 0.7 } finish { ambient 0.05 diffuse 0.8 } }
sphere { <0, 0.5, 0.5>, 0.5 hollow pigment { rgb <0.9, 0.5, 0.2> } finish { ambient 0.05 diffuse 0.8 } }
