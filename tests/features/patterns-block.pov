// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Patterns of blocks, with all, some or none of their entries given.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 1 diffuse 0 } }
camera { orthographic location <3,2,-8> look_at <3,2,0> right 8*x up 6*y }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { checker } translate <0, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { checker rgb <1, 0.5, 0.2> scale 0.3 } translate <2, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { brick scale 0.1 } translate <4, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { brick rgb 1, rgb <0.2, 0.3, 0.8> brick_size <0.7, 0.3, 0.4> mortar 0.08 rotate y*20 } translate <6, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { hexagon scale 0.3 rotate x*20 } translate <0, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { hexagon rgb 1 rgb 0 scale 0.2 translate 0.1 } translate <2, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { square scale 0.4 rotate x*50 } translate <4, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { triangular scale 0.5 rotate x*70 } translate <6, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { cubic } translate <0, 4, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { cubic rgb 1 rgb 0.8 rgb 0.6 rgb 0.4 rgb 0.2 rgb 0 rotate <10, 20, 30> translate <0.3, 0.1, 0> } translate <2, 4, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { square pigment { checker scale 0.2 } pigment { rgb x } pigment { onion scale 0.1 } pigment { brick scale 0.03 } scale 0.5 } translate <4, 4, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { checker pigment { hexagon scale 0.3 } turbulence 0.2 scale 0.5 } translate <6, 4, 0> }
