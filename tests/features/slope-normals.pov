// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// slope and aoi go by the last normal that was bent, be it another texture's; within a pattern of textures it is that
// normal as it lies in their coordinates.
#include "stage.inc"
#declare S = texture { pigment { slope <-0.6, 0.5, 0.2> } finish { ambient 1 diffuse 0 } }
#declare N = texture { pigment { rgb 1 } normal { bumps 0.5 scale 0.4 } }
sphere { <-1.4, 2.2, 0>, 0.8 texture { average texture_map { [1 N] [2 S] } } }
sphere { <0.2, 2.2, 0>, 0.8 texture { gradient x texture_map { [0 N] [1 S] } scale 0.5 rotate z*30 } rotate y*20 }
sphere { <-1.4, 0.6, 0>, 0.8 texture { gradient x texture_map { [0 S] [1 N] } scale <0.5, 1, 2> rotate z*30 } }
sphere { <0.2, 0.6, 0>, 0.8 texture { average texture_map { [1 pigment { slope y } normal { spiral2 5, 0.3 }
	scale <1.5, 1, 0.6> rotate x*40] [1 pigment { aoi } ] } translate y } rotate <40, 20, 50> translate <0.4, 0.6, 0.1> }
sphere { <1.9, 2.2, 0>, 0.8 pigment { slope { <1, 1, 0>, 0.2, 0.7 altitude y, 1, 3 } color_map { [0 rgb x] [0.5 rgb y] [1 rgb z] } } }
sphere { <2.1, 0.6, 0>, 0.8 pigment { slope { point_at <1, 2, -3> } } normal { marble 0.4 turbulence 0.3 } }
