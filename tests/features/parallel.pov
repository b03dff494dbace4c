// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#declare No_lamp = 1;
#include "stage.inc"
light_source { <2, 5, -2> rgb 0.9 parallel point_at <0, 0, 0> }
light_source { <-4, 3, 1> rgb <0.4, 0.1, 0.1> shadowless }
box { <-1.5, 0, -0.5>, <-0.5, 1, 0.5> pigment { rgb <0.7, 0.8, 0.2> } rotate y * 20 }
cylinder { <0.8, 0, 0>, <1.2, 1.8, 0.4>, 0.4 pigment { rgb <0.4, 0.5, 0.9> } finish { phong 0.6 } }
