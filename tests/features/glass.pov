// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#declare Trace_level = 12;
#include "stage.inc"
sphere { <-1.2, 1, 0>, 0.9 pigment { rgbft <0.9, 1, 0.9, 0.8, 0.1> } finish { diffuse 0.1 reflection { 0, 1 fresnel } conserve_energy specular 0.5 } interior { ior 1.5 } }
box { <-0.7, 0, -0.7>, <0.7, 1.6, 0.7> rotate y * 30 translate <1.3, 0.001, 0.2> pigment { rgbt <1, 0.8, 0.8, 0.9> } finish { diffuse 0.1 } interior { ior 1.3 } }
box { <-3, 0, 2>, <3, 2, 2.2> pigment { rgb <0.2, 0.7, 0.3> } }
