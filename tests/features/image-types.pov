// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// map_type: spherical, cylindrical and toroidal pictures round the y axis.
#include "stage.inc"
#declare Ball = pigment { image_map { png "pictures/colour.png" map_type 1 interpolate 2 } }
sphere { 0, 0.9 pigment { Ball rotate 20 * y } rotate <20, 0, 10> translate <-1.9, 1, 0> }
cylinder { 0, 1.6 * y, 0.7
	pigment { image_map { png "pictures/colour.png" map_type 2 interpolate 2 once } }
	translate <0.1, 0.2, 1.5> }
torus { 1, 0.35
	pigment { image_map { png "pictures/colour.png" map_type 5 interpolate 2 } rotate 70 * y }
	rotate <-50, 0, 0> translate <1.9, 1.3, 0> }
box { -0.5, 0.5
	pigment { image_map { jpeg "pictures/photo.jpg" map_type 1 } translate <0.05, 0.1, -0.02> }
	rotate 30 * y translate <0, 0.5, -1.5> }
