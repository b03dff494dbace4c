// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Edges only: the area of the pixel is all there is to integrate.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> direction 1.2*z right 4/3*x up y }
light_source { <3, 5, -4> rgb 1 }
plane { y, -0.4 pigment { checker rgb 0.9, rgb 0.1 scale 0.4 } finish { ambient 0 diffuse 0.9 } }
sphere { <0, 1, 0>, 0.9 pigment { rgb <0.9, 0.3, 0.2> } finish { ambient 0.1 diffuse 0.8 phong 0.8 phong_size 60 } }
cylinder { <-2, -1, 1>, <-1, 3, 1>, 0.05 pigment { rgb <0.2, 0.9, 0.4> } finish { ambient 1 diffuse 0 } }
