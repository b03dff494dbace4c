// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Mandelbrot and Julia sets and the magnet models, with all ways to colour them.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 1 diffuse 0 } }
camera { orthographic location <3,1,-8> look_at <3,1,0> right 8*x up 4*y }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { mandel 25 scale 0.6 } translate <0, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { mandel 12 exponent 3 exterior 1, 1 scale 0.6 } translate <2, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { mandel 15 exponent 5 exterior 6, 0.4 interior 1, 2 scale 0.7 } translate <4, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { julia <-0.6, 0.5>, 30 scale 0.6 color_map { [0 rgb 0] [0.5 rgb x] [1 rgb 1] } interior 2, 3 } translate <6, 0, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { julia <0.3, 0.4>, 20 exponent 4 exterior 7, 4 scale 0.7 } translate <0, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { magnet 1 mandel 20 exterior 8, 3 scale 0.4 translate -x*0.5 } translate <2, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { magnet 2 mandel 20 exterior 2, 0.7 interior 5, 0.3 scale 0.4 translate -x*0.5 } translate <4, 2, 0> }
box { -0.7, 0.7 rotate <25, 35, 0> pigment { magnet 1 julia <0.5, 0.6>, 15 exterior 4, 0.01 interior 6, 0.2 scale 0.3 } translate <6, 2, 0> }
