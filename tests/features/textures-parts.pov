// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Textures with patterns for faces and for corners of faces, an interior_texture, and layers of which some were moved
// before the others came.
#include "stage.inc"
#declare Two = mesh2 { vertex_vectors { 4, <-1, 0, 0>, <1, 0, 0>, <1, 2, 0>, <-1, 2, 0> } uv_vectors { 4, <0, 0>, <1, 0>, <1, 1>, <0, 1> }
	texture_list { 3, texture { pigment { checker rgb <1, 0.8, 0.2> rgb 0.2 scale 0.2 } } texture { pigment { uv_mapping gradient y color_map { [0 rgb x] [1 rgb z] } } }
		texture { bozo texture_map { [0.4 pigment { rgb 1 } finish { phong 1 } ] [0.6 pigment { rgbt <0.2, 0.8, 0.3, 0.4> } ] } scale 0.2 } }
	face_indices { 2, <0, 1, 2>, 0, 1, 2, <0, 2, 3>, 1 } }
object { Two translate <-1.6, 0.1, 0> }
object { Two texture { pigment { rgb y } } rotate y*40 scale <0.7, 1, 1> translate <2, 0.1, 0.5> }
sphere { <0.2, 0.7, -0.8>, 0.6 texture { pigment { checker rgbt <1, 1, 1, 0.9> rgbf <1, 0.5, 0.2, 0.7> scale 0.15 } }
	interior_texture { pigment { gradient y color_map { [0 rgb x] [1 rgb y] } scale 0.2 } scale 2 } rotate z*5 interior { ior 1.1 } }
sphere { <0.3, 2, -0.3>, 0.5 texture { pigment { rgb <0.3, 0.4, 0.9> } } texture { pigment { agate color_map { [0.3 rgbt 1] [0.6 rgb <1, 1, 0.7>] } scale 0.3 } rotate z*40 }
	scale <1, 0.9, 1> texture { pigment { onion color_map { [0.5 rgbt 1] [0.6 rgbt <0, 0, 0, 0.3>] } scale 0.1 } finish { specular 0.6 } } translate x*0.1 }
