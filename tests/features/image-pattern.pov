// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// image_pattern: the grey of colours, palettes, alpha; no gamma unless it is asked for.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "wall.inc"
#declare Map = color_map { [0 rgb <1, 0.2, 0.1>] [0.5 rgb <0.1, 0.6, 0.2>] [1 rgb <0.2, 0.2, 1>] }
Tile (0, texture { pigment { image_pattern { png "pictures/colour.png" } color_map { Map } } })
Tile (1, texture { pigment { image_pattern { png "pictures/colour.png" interpolate 2 } color_map { Map } } })
Tile (2, texture { pigment { image_pattern { png "pictures/grey.png" } color_map { Map } } })
Tile (3, texture { pigment { image_pattern { png "pictures/palette.png" } color_map { Map } } })
Tile (4, texture { pigment { image_pattern { png "pictures/palette.png" use_index } color_map { Map } } })
Tile (5, texture { pigment { image_pattern { png "pictures/palette.png" use_color interpolate 2 } color_map { Map } } })
Tile (6, texture { pigment { image_pattern { png "pictures/clear.png" use_alpha } color_map { Map } } })
Tile (7, texture { pigment { image_pattern { png "pictures/colour.png" use_alpha interpolate 2 } color_map { Map } } })
Tile (8, texture { pigment { image_pattern { jpeg "pictures/photo.jpg" interpolate 3 } color_map { Map } } })
Tile (9, texture { pigment { image_pattern { png "pictures/colour.png" gamma 2.2 } color_map { Map } } })
Tile (10, texture { pigment { image_pattern { png "pictures/colour.png" once } color_map { Map } scale 0.6 } })
Tile (11, texture { pigment { image_pattern { exr "pictures/light.exr" } color_map { Map } scallop_wave } })
