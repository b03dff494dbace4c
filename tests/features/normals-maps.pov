// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// normal_map and average, in one another; no_bump_scale goes for what stands in the map; objects are turned
// and stretched with their normals.
#include "stage.inc"
#declare Rough = normal { bumps 0.5 scale 0.1 }
#declare Soft = normal { average normal_map { [1 Rough] [2 ripples 0.6 frequency 5] [0.5 gradient x 0.5 scale 0.2] } rotate z * 30 }
#default { pigment { rgb <0.6, 0.8, 0.7> } finish { phong 0.5 diffuse 0.6 } }
sphere { <-1.6, 1.2, 0>, 0.7 normal { Soft } }
sphere { <0, 1.2, 0>, 0.7 normal { gradient y normal_map { [0.2 Soft] [0.5 wrinkles 0.8 scale 0.3] [0.9 bozo 0.7 scale 0.1] } scale <1, 0.7, 1> } }
box { <-0.5, -0.5, -0.5>, <0.5, 0.6, 0.5> texture { pigment { rgb <0.8, 0.5, 0.4> }
	normal { marble normal_map { [0.3 bumps 0.3 scale 0.2] [0.7 average normal_map { [1 dents 0.7 scale 0.3] [1 onion 0.2 scale 0.2] }] } turbulence 0.4 scale 0.4 no_bump_scale } }
	scale <1, 1.4, 0.7> rotate <20, 30, 0> translate <1.5, 1.2, 0> }
cylinder { <-2.2, 0.2, -1.4>, <2.2, 0.2, -1.4>, 0.2 texture { pigment { rgb 0.7 } normal { Rough scale 3 } } scale <1, 1, 0.9> }
