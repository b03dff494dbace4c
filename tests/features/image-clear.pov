// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// What pictures let through: alpha, straight or multiplied in, filter all and transmit all, which are added to it,
// and those of a palette's entries, which replace it.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#include "wall.inc"
#declare Stripe = 0;
#while (Stripe < 20)
	box { <-1, 0, 1>, <6, 0.1, 1.1> translate Stripe / 5 * y
		pigment { rgb <1, 0.8, 0.5> } finish { ambient 1 diffuse 0 } }
	#declare Stripe = Stripe + 1;
#end
Tile (0, texture { pigment { image_map { png "pictures/clear.png" } } })
Tile (1, texture { pigment { image_map { png "pictures/clear.png" interpolate 2 } } })
Tile (2, texture { pigment { image_map { png "pictures/clear.png" premultiplied on interpolate 2 } } })
Tile (3, texture { pigment { image_map { png "pictures/greyclear.png" interpolate 3 } } })
Tile (4, texture { pigment { image_map { png "pictures/colour.png" filter all 0.6 } } })
Tile (5, texture { pigment { image_map { png "pictures/colour.png" transmit all 0.4 interpolate 2 } } })
Tile (6, texture { pigment { image_map { png "pictures/clear.png" filter all 0.3 transmit all 0.1 } } })
Tile (7, texture { pigment { image_map { exr "pictures/light.exr" interpolate 2 } } })
Tile (8, texture { pigment { image_map { png "pictures/palette.png" } } })
Tile (9, texture { pigment { image_map { png "pictures/palette.png" filter 2, 0.7 transmit 4, 0.5 } } })
Tile (10, texture { pigment { image_map { png "pictures/palette.png" filter all 0.5 interpolate 2 } } })
Tile (11, texture { pigment { image_map { png "pictures/palette.png" transmit all 0.3 filter 0, 0.5 } } })
