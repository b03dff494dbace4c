// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// A cone whose falloff is inside its radius; orient without circular.
#declare No_lamp = 1;
#include "stage.inc"
light_source { <-2, 5, -2> rgb <1, 0.8, 0.6> spotlight point_at <-0.8, 0, 0> radius 20 falloff 18 tightness 0 }
light_source { <2, 4, -1> rgb <0.6, 0.7, 0.9> area_light <1.5, 0, 0>, <0, 1, 0.2>, 4, 3 orient }
sphere { <0.6, 0.7, 0>, 0.6 pigment { rgb 0.9 } }
