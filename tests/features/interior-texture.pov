// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
cylinder { <-1, 0.2, 0>, <-0.6, 1.5, 0>, 0.7 open pigment { rgb <0.9, 0.3, 0.2> } interior_texture { pigment { rgb <0.2, 0.3, 0.9> } } }
cylinder { <1, 0.2, 0>, <1.2, 1.5, 0>, 0.7 open texture { pigment { rgbf <0.9, 0.9, 0.2, 0.5> } } interior_texture { pigment { rgbt <0.9, 0.2, 0.9, 0.3> } finish { phong 0.7 } } }
