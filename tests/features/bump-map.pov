// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// bump_map: heights by grey or a palette's number, sizes below 0, interpolation, on all sides of things.
#include "stage.inc"
#default { finish { ambient 0.05 diffuse 0.6 specular 0.4 roughness 0.02 } }
sphere { 0, 0.9 pigment { rgb 0.8 }
	normal { bump_map { png "pictures/grey.png" interpolate 2 bump_size 3 } scale 0.8 } translate <-1.9, 1, 0> }
sphere { 0, 0.9 pigment { rgb <0.9, 0.7, 0.5> }
	normal { bump_map { png "pictures/colour.png" map_type 1 interpolate 2 bump_size -4 } } translate <1.9, 1, 0> }
box { -0.6, 0.6 pigment { rgb <0.5, 0.7, 0.9> }
	normal { bump_map { png "pictures/palette.png" use_index bump_size 0.3 } rotate <20, 30, 0> }
	rotate 30 * y translate <0, 0.9, 0> }
cylinder { <-1, 0.3, -1.6>, <1, 0.3, -1.6>, 0.3 pigment { rgb 0.7 }
	normal { bump_map { jpeg "pictures/photo.jpg" once interpolate 3 } bump_size 2 translate -0.5 } }
