// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
sphere { <-1.6, 1, 0>, 0.7 pigment { rgb <0.9, 0.4, 0.3> } no_shadow }
sphere { <0, 1, 0>, 0.7 pigment { rgb <0.4, 0.9, 0.3> } no_image }
sphere { <1.6, 1, 0>, 0.7 pigment { rgb <0.4, 0.4, 0.9> } no_reflection }
box { <-3, 0, 1.8>, <3, 2.4, 2> pigment { rgb 0.1 } finish { reflection 0.8 } }
