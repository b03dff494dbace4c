// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#declare No_lamp = 1;
#include "stage.inc"
light_source { <-2, 4, -2> rgb <0.8, 0.7, 0.6> area_light <2, 0, 0>, <0, 0, 2>, 6, 3 adaptive 0 area_illumination fade_distance 4 fade_power 2 }
light_source { <3, 4, -1> rgb <0.5, 0.5, 0.7> area_light <1.5, 0, 0>, <0, 0, 1.5>, 7, 7 circular orient adaptive 2 }
sphere { <-1, 0.8, 0>, 0.8 pigment { rgb <0.9, 0.6, 0.4> } finish { phong 0.7 } }
box { <0.8, 0, -0.4>, <1.6, 1.2, 0.4> pigment { rgb <0.4, 0.8, 0.5> } finish { diffuse 0.6, 0.3 } }
