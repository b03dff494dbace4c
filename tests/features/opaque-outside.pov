// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Opaque outside, clear inside: the shadow is full.
#include "stage.inc"
cylinder { <-1, 0.2, 0>, <0.4, 1.5, 0>, 0.7 open pigment { rgb <0.9, 0.3, 0.2> } interior_texture { pigment { rgbt <0.2, 0.3, 0.9, 0.8> } } }
