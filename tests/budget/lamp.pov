// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// A jittered area light.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -4> direction z right 4/3*x up y }
light_source { <2, 4, -2> rgb 0.9 area_light 1.6*x, 1.6*z, 2, 2 jitter }
plane { y, 0 pigment { rgb 0.8 } finish { ambient 0 diffuse 0.9 } }
box { <-0.5, 0.3, -0.5>, <0.5, 1, 0.5> pigment { rgb <0.3, 0.6, 0.9> } finish { ambient 0.05 diffuse 0.8 } }
sphere { <1.3, 0.5, 1>, 0.5 pigment { rgb <0.9, 0.8, 0.3> } finish { ambient 0.05 diffuse 0.8 } }
