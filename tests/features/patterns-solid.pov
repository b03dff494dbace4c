// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Patterns that are formulas of the point, their waves, default colours, and maps of the old kind with two colours.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 1 diffuse 0 } }
camera { orthographic location <3,3,-8> look_at <3,3,0> right 8*x up 8*y }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { gradient <1, 2, 0.5> frequency 2.5 phase 0.3 } translate <0, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { onion scale 0.4 sine_wave } translate <2, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { radial frequency -3 } translate <4, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { leopard scale 0.12 } translate <6, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { planar cubic_wave } translate <0, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { boxed color_map { [0 rgb x] [0.5 rgb y] [0.5 rgb z] [1 rgb 1] } frequency 2 } translate <2, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { cylindrical poly_wave 2 rotate x*90 } translate <4, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { spherical triangle_wave frequency 3 } translate <6, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { spiral1 5 rotate x*90 scale 0.4 } translate <0, 4, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { spiral2 3 scale 0.5 scallop_wave } translate <2, 4, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { quilted control0 0.2 control1 1.4 scale 0.5 } translate <4, 4, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { average pigment_map { [1 gradient x] [2 rgb <0.2, 0.6, 0.1>] [0.5 checker scale 0.3] } } translate <6, 4, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { pigment_pattern { gradient y color_map { [0 rgb x] [1 rgb 1] } scale 0.7 } color_map { [0.2 rgb z] [0.9 rgb <1, 1, 0>] } translate 0.213 } translate <0, 6, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { marble scale 0.3 rotate z*30 color_map { [0, 0.5 color rgb 1 color rgb x] [0.5, 1 color rgb x color rgb y] } } translate <2, 6, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { gradient x pigment_map { [0.2 gradient y scale 0.3] [0.8 bozo scale 0.2] } rotate z*20 } translate <4, 6, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { mandel 20 } translate <6, 6, 0> }
