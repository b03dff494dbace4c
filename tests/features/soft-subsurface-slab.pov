// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Edges and thin slabs, where rays from below are long and graze: a cube, and a pane lit from behind. One of them has a
// single translucency for all colours.
#version 3.7;
global_settings { assumed_gamma 1 mm_per_unit 10 subsurface { samples 400, 50 } }
camera { location <0.5, 1.2, -4> look_at 0 angle 40 }
background { rgb <0.05, 0.1, 0.2> }
light_source { <2, 3, 6> rgb 1.2 }
light_source { <-3, 4, -5> rgb <0.3, 0.4, 0.2> }
plane { y, -1 pigment { rgb 0.5 } }
box {
	-0.5, 0.5
	pigment { rgb <0.8, 0.5, 0.3> }
	finish { ambient 0 diffuse 0.9 subsurface { translucency <3, 2, 1> } }
	interior { ior 1.5 }
	rotate y * 30
	translate -0.8 * x
}
box {
	<-0.6, -0.9, -0.05>, <0.6, 0.6, 0.05>
	pigment { rgb <0.4, 0.7, 0.6> }
	finish { ambient 0 diffuse 0.9 subsurface { translucency 2 } }
	interior { ior 1.3 }
	rotate y * 30
	translate 0.8 * x
}
