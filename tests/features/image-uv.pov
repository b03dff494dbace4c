// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// uv_mapping of pictures on meshes and solids.
#include "stage.inc"
mesh2 { vertex_vectors { 4, <-2.5, 0.1, 0.5>, <-0.5, 0, 0>, <-0.4, 2, 0.4>, <-2.6, 1.7, 0> }
	uv_vectors { 4, <-0.3, 0.1>, <1.7, 0>, <1.5, 1>, <0, 1.4> }
	face_indices { 2, <0, 1, 2>, <0, 2, 3> } uv_indices { 2, <0, 1, 2>, <0, 2, 3> }
	pigment { uv_mapping image_map { png "pictures/colour.png" interpolate 2 } } }
mesh2 { vertex_vectors { 4, <0.5, 0.1, 0.5>, <2.5, 0, 0>, <2.4, 2, 0.4>, <0.6, 1.7, 0> }
	uv_vectors { 3, <-0.3, 0.1>, <1.7, 0>, <1.5, 1> }
	face_indices { 2, <0, 1, 2>, <0, 2, 3> } uv_indices { 2, <0, 1, 2>, <1, 2, 0> }
	texture { uv_mapping pigment { image_map { png "pictures/clear.png" once interpolate 2 } scale 0.8 translate 0.1 } } }
sphere { <0, 0.6, -1.2>, 0.6 pigment { uv_mapping image_map { jpeg "pictures/photo.jpg" interpolate 2 } } }
