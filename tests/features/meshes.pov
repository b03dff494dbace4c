// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
#declare Red = texture { pigment { rgb <1, 0.2, 0.1> } };
#declare Green = texture { pigment { rgb <0.2, 0.9, 0.1> } finish { phong 0.7 } };
#declare Blue = texture { pigment { rgbt <0.1, 0.2, 1, 0.3> } };
#declare M = mesh2 {
	vertex_vectors { 4, <-1, 0, -1>, <1, 0, -1>, <0, 0, 1>, <0, 1.6, 0> }
	normal_vectors { 4, <-0.7, -0.3, -0.7>, <0.7, -0.3, -0.7>, <0, -0.3, 1>, <0, 1, 0> }
	texture_list { 3, texture { Red } texture { Green } texture { Blue } }
	face_indices { 4, <0, 1, 3>, 0, 1, 2, <1, 2, 3>, 1, <2, 0, 3>, 0, 2, 1, <0, 2, 1>, 0 }
}
object { M translate <-1.4, 0.3, 0> }
object { M scale <0.6, 0.8, 0.6> rotate y * 40 translate <1.4, 0.2, 0.3> }
mesh {
	triangle { <-0.5, 0.2, -0.9>, <0.5, 0.2, -0.9>, <0, 1.1, -0.5> texture { Green } }
	smooth_triangle { <0.5, 1.2, -0.3>, <0, 0, -1>, <1.2, 1.4, -0.2>, <1, 0.5, -0.5>, <0.8, 2, 0>, <0, 1, 0> }
	texture { Red }
}
triangle { <-0.4, 1.2, 0>, <0.3, 1.3, 0>, <0, 2, 0.1> pigment { rgb <0.9, 0.9, 0.1> } }
