// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Bent normals and light that goes through: fake caustics follow the bumps; refraction turns a bent normal that
// looks away from the ray.
#include "stage.inc"
sphere { <-1.3, 1.3, 0.3>, 0.9
	pigment { rgbf <0.9, 1, 0.95, 0.9> } normal { bumps 0.7 scale 0.25 } interior { caustics 0.6 } }
disc { <1.2, 1, -1>, <0.2, 0.3, -1>, 0.9
	pigment { rgbt 0.9 } interior { ior 1.4 }
	normal { bump_map { png "pictures/grey.png" bump_size -8 } scale 0.7 } }
