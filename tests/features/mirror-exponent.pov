// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
sphere { <-1, 1, 0>, 0.9 pigment { rgb 0.05 } finish { reflection { 0.8 exponent 0.6 } } }
sphere { <1.2, 1, 0>, 0.9 pigment { rgb 0.05 } finish { reflection { 0.8 exponent 1.7 } conserve_energy } }
