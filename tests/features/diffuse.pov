// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
sphere { <-1.5, 1, 0>, 0.9 pigment { rgb <1, 0.3, 0.2> } }
sphere { <0.5, 1, 0>, 0.9 pigment { rgb <0.3, 0.8, 0.4> } finish { diffuse 0.5 brilliance 3 } }
sphere { <2.3, 1, 1>, 0.7 pigment { srgb <0.3, 0.4, 0.9> } finish { ambient rgb <0.1, 0.2, 0> emission 0.15 } }
