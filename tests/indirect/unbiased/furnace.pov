// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// A closed room in which everything glows with 0.2 and returns 0.6 of the light, seen from inside: with five
// bounces each point has 0.2 (1 + 0.6 + ... + 0.6^5) = 0.476672.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { recursion_limit 5 } }
#default { pigment { rgb 1 } finish { ambient 0 diffuse 0.6 emission 0.2 } }
camera { location <0, 1, -2.5> look_at <0, 0.5, 0> angle 80 }
box { <-3, 0, -3>, <3, 3, 3> }
sphere { <-0.8, 0.5, 0>, 0.5 }
torus { 0.6, 0.25 rotate 60*x translate <0.9, 0.7, 0> }
cone { <0, 0, 1.2>, 0.6, <0, 1.4, 1.2>, 0 }
