// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Textures in tiles, layered ones too; black holes that lie somewhere in their blocks.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,3,-6> look_at 0 angle 50 }
light_source { <5,10,-10> rgb 1 }
plane { z, 0 texture { tiles { texture { pigment { rgb x } } texture { pigment { onion color_map { [0 rgbt 1][1 rgb 1] } } } tile2 texture { pigment { rgb <0,1,.5> } } } scale .4 rotate z*20 } }
plane { y, -1 texture { pigment { checker scale .2 warp { black_hole <.3,.3,0>, .3 strength 1.5 repeat <1.2,1.3,2> turbulence <.4,.5,.2> } } } }
