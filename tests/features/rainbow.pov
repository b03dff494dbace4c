// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Rainbows: two that overlap, arcs that fade, filter and transmit, one close by before what stands in it, seen
// in a mirror and through a pane, behind fog.
#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb <0.5, 0.6, 0.7> }
camera { location <0, 1, 0> look_at <0, 2, 5> angle 75 }
light_source { <-30, 40, -50> rgb 1 }
#declare Colours = color_map {
	[0 color srgbt <1, 0.5, 1, 1>] [0.3 color srgbt <0.2, 0.2, 1, 0.5>] [0.5 color srgbft <0.2, 1, 0.2, 0.3, 0.3>]
	[0.8 color srgbt <1, 0.8, 0.2, 0.4>] [1 color srgbt <1, 0.2, 0.2, 1>]
}
rainbow { angle 22 width 8 distance 40 direction <0, 0.3, 1> color_map { Colours } }
rainbow {
	angle 32 width 16 distance 1e7 direction <0.1, 0.1, 1> up <0.3, 1, 0> arc_angle 150 falloff_angle 60
	color_map { Colours }
}
rainbow { angle 12 width 6 distance 4 direction <0.2, -0.1, 1> arc_angle 360 color_map { [0 rgb 1] [1 rgb 0] } }
fog { distance 60 color rgbt <0.8, 0.8, 0.9, 0.5> }
plane { y, 0 pigment { checker rgb 0.3 rgb 0.6 } }
sphere { <-2, 2, 8>, 2 pigment { rgb <0.7, 0.3, 0.2> } }
sphere { <2.5, 1.5, 6>, 1.5 pigment { rgb 0.1 } finish { reflection 0.8 } }
box { <-0.4, 0, 4>, <0.8, 3, 4.1> pigment { rgbt <0.6, 0.9, 0.6, 0.6> } }
