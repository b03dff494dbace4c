// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// image_map on a plane of its own: where pixels lie, how the picture repeats, all interpolations; once and what
// is beside it; the words repeat and offset, which the manual does not have.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "wall.inc"
#declare Place = transform { scale <0.4, 0.55, 1> translate <0.2, 0.3, 0> }
Tile (0, texture { pigment { image_map { png "pictures/colour.png" } transform Place } })
Tile (1, texture { pigment { image_map { png "pictures/colour.png" interpolate 2 } transform Place } })
Tile (2, texture { pigment { image_map { png "pictures/colour.png" interpolate 3 } transform Place } })
Tile (3, texture { pigment { image_map { png "pictures/colour.png" interpolate 4 } transform Place } })
Tile (4, texture { pigment { image_map { png "pictures/colour.png" once } transform Place } })
Tile (5, texture { pigment { image_map { png "pictures/colour.png" once interpolate 2 } transform Place } })
Tile (6, texture { pigment { image_map { png "pictures/colour.png" once interpolate 3 } transform Place } })
Tile (7, texture { pigment { image_map { png "pictures/colour.png" once interpolate 4 } transform Place } })
Tile (8, texture { pigment { image_map { "pictures/colour.png" interpolate 2 } rotate 30 * z scale <1, -1, 1> } })
Tile (9, texture { pigment { image_map { png "pictures/colour.png" repeat <2, 3> interpolate 2 } } })
Tile (10, texture { pigment { image_map { png "pictures/colour.png" offset <0.3, 0.6> interpolate 2 } } })
Tile (11, texture { pigment { image_map { png "pictures/palette.png" interpolate 2 } translate <-7.3, 5.1, 0> } })
