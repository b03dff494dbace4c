// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Opaque outside, clear inside: a solid lets light through, a mesh does not.
#include "stage.inc"
cylinder { <-1, 0.2, 0>, <0.4, 1.5, 0>, 0.7 open pigment { rgb <0.9, 0.3, 0.2> } interior_texture { pigment { rgbt <0.2, 0.3, 0.9, 0.8> } } }
mesh2 {
	vertex_vectors { 4, <0.8, 0.2, -0.5>, <2, 0.2, -0.4>, <0.8, 1.6, 0.3>, <2, 1.5, 0.4> }
	face_indices { 2, <0, 2, 1>, <1, 2, 3> }
	texture { pigment { rgb <0.3, 0.9, 0.2> } } interior_texture { pigment { rgbt <0.9, 0.3, 0.9, 0.8> } }
}
