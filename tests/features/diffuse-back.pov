// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
disc { <-1.2, 1, 0>, <0.3, 0.4, 1>, 0.9 pigment { rgb <0.9, 0.7, 0.2> } finish { diffuse 0.6, 0.4 } }
disc { <1.2, 1, 0>, <-0.6, 0.2, 1>, 0.9 pigment { rgb <0.3, 0.7, 0.9> } finish { diffuse 0.6 } double_illuminate }
disc { <0, 1.8, 1>, <0, 1, 0.3>, 0.8, 0.3 pigment { rgb <0.8, 0.3, 0.6> } }
light_source { <-3, 2, 6> rgb <0.8, 0.8, 1> }
