// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#declare No_lamp = 1;
#include "stage.inc"
light_source { <-2, 5, -2> rgb <1, 0.8, 0.6> spotlight point_at <-0.8, 0, 0> radius 12 falloff 22 tightness 0 }
light_source { <3, 4, -1> rgb <0.5, 0.7, 1> spotlight point_at <1, 0, 0.5> radius 30 falloff 45 tightness 10 }
light_source { <0, 5, 2> rgb <0.7, 1, 0.7> cylinder point_at <0.2, 0, 1> radius 0.5 falloff 0.9 tightness 0 }
sphere { <0.3, 0.6, 0>, 0.6 pigment { rgb 0.9 } }
