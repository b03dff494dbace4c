// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Warps, between transforms and behind turbulence.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 1 diffuse 0 } }
camera { orthographic location <3,2,-8> look_at <3,2,0> right 8*x up 6*y }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { checker scale 0.3 warp { repeat x*0.5 offset y*0.2 flip <1, 0, 1> } } translate <0, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { checker scale 0.2 warp { black_hole <0, 0, -0.9>, 0.8 strength 1.2 falloff 1.5 } } translate <2, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { brick scale 0.06 warp { black_hole <0.3, 0.3, 0>, 0.4 inverse repeat 1 } } translate <4, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { gradient x scale 0.1 warp { spherical } rotate x*20 } translate <6, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { checker scale 0.1 warp { cylindrical orientation y dist_exp 1 } } translate <0, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { hexagon scale 0.1 warp { toroidal major_radius 0.6 orientation y } } translate <2, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { checker scale 0.2 warp { planar <1, 1, 0>, 0.3 } } translate <4, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { checker scale 0.1 warp { cubic } } translate <6, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { gradient y scale 0.2 warp { turbulence <0.3, 0.1, 0> octaves 3 lambda 1.8 omega 0.6 } rotate z*45 warp { repeat y*0.6 } } translate <0, 4, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { spiral1 3 turbulence 0.3 rotate x*90 scale 0.4 } translate <2, 4, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { wood turbulence 0.1 scale 0.2 rotate x*70 } translate <4, 4, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { agate agate_turb 0.6 turbulence 0.1 scale 0.5 } translate <6, 4, 0> }
