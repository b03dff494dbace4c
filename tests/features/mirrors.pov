// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
sphere { <-1.6, 1, 0>, 0.9 pigment { rgb 0.1 } finish { reflection 0.7 } }
sphere { <0.3, 1, 0.4>, 0.9 pigment { rgb <0.7, 0.5, 0.1> } finish { reflection { rgb 0.1, rgb <0.9, 0.8, 0.7> falloff 3 } } }
sphere { <2.1, 1, 0>, 0.9 pigment { rgb <0.9, 0.4, 0.1> } finish { reflection { 0.6 metallic } } }
box { <-3, 0, 2>, <3, 2, 2.2> pigment { rgb <0.2, 0.7, 0.3> } rotate y * 10 }
