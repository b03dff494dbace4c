// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#declare No_lamp = 1;
#include "stage.inc"
light_source { <-1.5, 2, -0.5> rgb <1, 0.7, 0.4> fade_distance 1.5 fade_power 2 }
light_source { <2, 2.5, 0> rgb <0.4, 0.6, 1> fade_distance 3 fade_power 1 }
cone { <0, 0, 0>, 0.8, <0.2, 1.6, 0.1>, 0.2 pigment { rgb 0.8 } }
