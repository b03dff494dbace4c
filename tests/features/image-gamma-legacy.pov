// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// As image-gamma, for older scenes: only what files state is corrected.
// word gamma. POV-Ray keeps grey PNG pictures in 8 bits of light, rounded down.
#version 3.6;
global_settings { assumed_gamma 1.8 }
#include "wall.inc"
Tile (0, texture { pigment { image_map { png "pictures/colour.png" } } })
Tile (1, texture { pigment { image_map { png "pictures/deep.png" } } })
Tile (2, texture { pigment { image_map { png "pictures/grey.png" } } })
Tile (3, texture { pigment { image_map { png "pictures/greyclear.png" } } })
Tile (4, texture { pigment { image_map { jpeg "pictures/photo.jpg" } } })
Tile (5, texture { pigment { image_map { jpeg "pictures/greyphoto.jpg" } } })
Tile (6, texture { pigment { image_map { ppm "pictures/plain.ppm" } } })
Tile (7, texture { pigment { image_map { exr "pictures/light.exr" interpolate 2 } } })
Tile (8, texture { pigment { image_map { png "pictures/colour.png" gamma 1.8 } } })
Tile (9, texture { pigment { image_map { png "pictures/deep.png" gamma srgb } } })
Tile (10, texture { pigment { image_map { ppm "pictures/plain.ppm" gamma srgb } } })
Tile (11, texture { pigment { image_map { exr "pictures/light.exr" gamma 1.5 } } })
