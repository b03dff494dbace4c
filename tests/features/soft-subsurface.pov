// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Light from below a sphere that is lit from behind, of another reach for each colour, under two lamps; a black box,
// a mirror and a highlight see it as any other surface.
#version 3.7;
global_settings { assumed_gamma 1 subsurface { samples 100, 25 } } // mm_per_unit is 10
camera { location <0.5, 1.2, -4> look_at 0 angle 40 }
background { rgb <0.05, 0.1, 0.2> }
light_source { <2, 3, 6> rgb 2 }
light_source { <-3, 4, -5> rgb <0.3, 0.4, 0.2> }
plane { y, -1 pigment { rgb 0.5 } finish { ambient 0 reflection 0.3 } }
sphere {
	0, 1
	pigment { rgb <0.8, 0.5, 0.3> }
	finish { ambient 0 diffuse 0.9 specular 0.3 subsurface { translucency <3, 2, 1> } }
	interior { ior 1.3 }
}
box { <-1.6, -1, -0.6>, <-1.1, 0.4, 0> pigment { rgb 0.1 } }
