// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Focal blur, with a small bright thing that becomes a faint disc.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> direction 1.2*z right 4/3*x up y aperture 0.5 focal_point <0, 0.5, 0> blur_samples 16 }
light_source { <3, 5, -4> rgb 1 }
plane { y, -0.4 pigment { checker rgb 0.9, rgb 0.1 scale 0.8 } finish { ambient 0 diffuse 0.9 } }
sphere { <0, 0.5, 0>, 0.8 pigment { rgb <0.9, 0.3, 0.2> } finish { ambient 0.1 diffuse 0.8 } }
sphere { <1.6, 2, 3>, 0.12 pigment { rgb 20 } finish { ambient 1 diffuse 0 } }
