// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#declare No_lamp = 1;
#include "stage.inc"
light_source { <-2, 5, -2> rgb <1, 0.9, 0.8> area_light <1.5, 0, 0>, <0, 0, 1.5>, 5, 5 }
light_source { <4, 4, -1> rgb <0.4, 0.5, 0.7> area_light <1, 0, 0>, <0, 1, 0>, 9, 9 adaptive 1 }
torus { 0.8, 0.25 rotate x * 50 translate <-1, 1, 0> pigment { rgb <0.9, 0.4, 0.4> } }
box { <0.8, 0, -0.4>, <1.6, 1.2, 0.4> pigment { rgb <0.4, 0.8, 0.5> } }
