// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Normals bent by the slope of a pattern's values: accuracy, waves, slope_map, blocks.
#include "stage.inc"
#macro Ball(X, Y)
	sphere { <X, Y, 0>, 0.42 pigment { rgb <0.8, 0.7, 0.5> } finish { specular 0.4 }
#end
Ball(-1.5, 1.4) normal { bozo 0.8 scale 0.1 } }
Ball(-0.5, 1.4) normal { granite 0.3 accuracy 0.1 scale 0.3 } }
Ball(0.5, 1.4) normal { gradient y 0.6 sine_wave frequency 6 } }
Ball(1.5, 1.4) normal { gradient x slope_map { [0 <0, 1>] [0.3 <0.3, 1>] [0.3 <0.3, 0>] [0.7 <0.5, -2>] [1 <0, 0>] } scale 0.3 } }
Ball(-1.5, 0.5) normal { checker 0.4 scale 0.2 accuracy 0.1 } }
Ball(-0.5, 0.5) normal { crackle 0.7 metric 1 scale 0.25 } }
Ball(0.5, 0.5) normal { wood 0.5 turbulence 0.1 scale 0.15 rotate x * 30 } }
Ball(1.5, 0.5) normal { agate 0.4 scale 0.4 } }
Ball(-1, 2.2) normal { brick 0.5 frequency 0.7 phase 0.2 scale 0.05 accuracy 0.05 } }
Ball(1, 2.2) normal { leopard 0.4 scale 0.05 no_bump_scale } }
