// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
box { <-1.8, 1, -1>, <-0.4, 1.1, 1> pigment { rgbf <1, 0.2, 0.1, 0.8> } }
box { <0, 1, -1>, <1.4, 1.1, 1> pigment { rgbt <0.1, 0.2, 1, 0.6> } }
box { <-1, 1.6, -0.4>, <0.8, 1.7, 0.4> pigment { rgbft <0.2, 0.9, 0.2, 0.5, 0.2> } }
sphere { <2.3, 0.9, 0>, 0.7 pigment { rgbf <0.9, 0.9, 1, 0.9> } interior { caustics 0.7 ior 1.3 } }
