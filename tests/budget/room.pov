// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Indirect light with two bounces, in a box with one open side.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { recursion_limit 2 } }
camera { location <0, 1, -2.4> direction z right 4/3*x up y }
light_source { <0.6, 1.8, -1> rgb 0.7 }
box { <-1.6, 0, -3>, <1.6, 2, 1.5> hollow
	pigment { gradient x color_map { [0.5 rgb <0.8, 0.2, 0.1>] [0.5 rgb <0.2, 0.3, 0.8>] } scale 4 translate -2*x }
	finish { ambient 0 diffuse 0.8 } }
sphere { <-0.5, 0.4, 0.3>, 0.4 pigment { rgb 0.9 } finish { ambient 0 diffuse 0.8 } }
sphere { <0.7, 0.35, -0.2>, 0.35 pigment { rgb <0.9, 0.8, 0.2> } finish { ambient 0 diffuse 0.4 reflection 0.4 } }
