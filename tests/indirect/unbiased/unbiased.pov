// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// What unbiased.py also computes by itself: a plane and three balls, of which one glows, in
// a large one; a lamp, two bounces. What falls on the dark ball is followed by chance.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { recursion_limit 2 } }
camera { location <0, 1.5, -5> direction z right 1.3333333333333333*x up y }
light_source { <2, 4, -3> rgb 0.8 }
plane { y, 0 pigment { rgb <0.8, 0.7, 0.6> } finish { ambient 0 diffuse 0.9 } }
sphere { <-1.1, 1, 0.5>, 1 pigment { rgb <0.9, 0.4, 0.3> } finish { ambient 0 diffuse 0.8 } }
sphere { <1, 0.8, 0>, 0.8 pigment { rgb <0.1, 0.25, 0.3> } finish { ambient 0 diffuse 0.9 } }
sphere { <0, 0.6, -1>, 0.6 pigment { rgb 1 } finish { ambient 0 diffuse 0 emission <1, 0.8, 0.5> } }
sphere { <0, 2, 0>, 7 pigment { rgb <0.6, 0.65, 0.7> } finish { ambient 0 diffuse 0.9 } }
