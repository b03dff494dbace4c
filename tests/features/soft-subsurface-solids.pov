// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Two objects that are given the same interior are two solids. Other things inside of a solid, and what is cut out of
// it. What is seen through it.
#version 3.7;
global_settings { assumed_gamma 1 mm_per_unit 10 subsurface { samples 200, 50 } }
camera { location <0, 1, -5> look_at 0 angle 40 }
background { rgb <0.05, 0.1, 0.2> }
light_source { <-3, 4, -5> rgb <0.8, 1, 0.9> }
light_source { <2, 3, 6> rgb 0.5 }
plane { y, -0.8 pigment { checker rgb 0.2, rgb 0.7 scale 0.3 } }
#declare Wax = texture {
	pigment { rgb <0.8, 0.6, 0.5> }
	finish { ambient 0 diffuse 0.8 subsurface { translucency 2 } }
}
#declare Inside = interior { ior 1.1 }
union {
	sphere { 0, 0.4 texture { Wax } interior { Inside } }
	box { <-0.1, -0.5, -0.3>, <0.1, 0.5, 0> texture { Wax } interior { Inside } }
	translate <-0.3, 0, 0>
}
sphere { <0.5, 0, 0>, 0.4 texture { Wax } interior { Inside } }
box { <0.4, -0.3, -0.3>, <0.6, 0.3, 0> pigment { rgb <0, 1, 0> } finish { emission 0.5 } }
difference {
	sphere { 0, 0.4 }
	box { <-0.1, -1, -1>, <0.1, 1, 0.1> }
	texture { Wax }
	interior { Inside }
	translate <1.3, 0, 0>
}
