// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Isosurfaces: in boxes and balls whose own surface shows where they cut, open, with gradients given and found,
// cut out of a solid, and around noise.
#version 3.7; global_settings { assumed_gamma 1 }
camera { location <0,2,-7> look_at <0,0.3,0> angle 50 }
light_source { <3,5,-5> rgb 1 }
plane { y, -1.2 pigment { checker rgb 0.3 rgb 0.7 } }
#default { pigment { rgb <.8,.5,.3> } finish { phong .5 } }
isosurface { function { sqrt(x*x+y*y+z*z) - 0.9 } max_gradient 1.2 accuracy 1e-5 translate <-2.4,0,0> }
isosurface { function { x*x+y*y+z*z-1+0.3*sin(9*x)*sin(9*y)*sin(9*z) } contained_by { sphere { 0, 1.1 } } max_gradient 6 accuracy 1e-4 all_intersections }
isosurface { function { abs(x)+abs(y)+abs(z)-1.3 } contained_by { box { <-1,-1,-1>, <1,.6,1> } } max_gradient 2 accuracy 1e-4 rotate 20*y translate <2.2,0,0.6> }
isosurface { function { pow(pow(abs(sqrt(x*x+z*z)-0.8),3)+pow(abs(y),3),1/3) - 0.25 } threshold 0 contained_by { box { <-1.1,-.3,-1.1>,<1.1,.3,1.1> } } evaluate 1, 10, 0.1 accuracy 1e-4 rotate -50*x translate <0,-.3,-2.5> }
isosurface { function { y - 0.2*sin(6*x) } open contained_by { box { -0.6, 0.6 } } max_gradient 2 translate <0,1.5,1> }
difference {
	sphere { 0, 0.6 }
	isosurface { function { sqrt(x*x + z*z) - 0.25 + 0.05 * sin(12 * y) } max_gradient 1.5 accuracy 1e-4 all_intersections rotate 60 * x }
	translate <-1.6, 1.4, 1>
}
#declare Bumps = function { pigment { bozo color_map { [0 rgb 0] [1 rgb 1] } scale 0.4 } }
isosurface {
	function { sqrt(x*x + y*y + z*z) - 0.5 - 0.15 * Bumps(x, y, z).grey }
	contained_by { sphere { 0, 0.7 } } max_gradient 3
	pigment { rgb <0.5, 0.8, 0.6> }
	translate <1.9, 1.6, 0>
}
