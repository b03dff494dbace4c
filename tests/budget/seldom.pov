// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Indirect light from a small bright thing: one ray in a hundred finds it.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { recursion_limit 1 } }
camera { location <0, 1, -3> direction z right 4/3*x up y }
plane { y, 0 pigment { rgb 0.8 } finish { ambient 0 diffuse 0.9 } }
sphere { <0.2, 1.5, 0.5>, 0.14 pigment { rgb 12 } finish { ambient 0 diffuse 0 emission 1 } }
sphere { <-0.8, 0.5, 0.4>, 0.5 pigment { rgb <0.9, 0.4, 0.3> } finish { ambient 0 diffuse 0.8 } }
background { rgb 0.03 }
