// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
cone { <-2.4, 0, 0>, 0.6, <-2.2, 1.4, 0>, 0 open pigment { rgb <0.8, 0.4, 0.3> } }
cylinder { <-1.2, 0.2, 0>, <-0.8, 1.4, 0.3>, 0.4 open pigment { rgb <0.3, 0.5, 0.9> } }
torus { 0.6, 0.2 rotate <60, 20, 0> scale <1, 1.3, 0.8> translate <0.4, 1.1, 0.2> pigment { rgb <0.9, 0.8, 0.3> } finish { phong 0.5 } }
box { -0.5, 0.5 matrix <1, 0.2, 0, 0.1, 1, 0, 0, 0.3, 1, 1.9, 0.8, 0> pigment { rgb <0.4, 0.9, 0.6> } }
disc { <1.2, 1.9, 1>, <-0.2, 0.3, -1>, 0.7, 0.25 pigment { rgb <0.9, 0.5, 0.9> } }
