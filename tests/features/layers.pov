// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
sphere { <-1.2, 1, 0>, 0.9
	texture { pigment { rgb <0.2, 0.4, 0.8> } finish { diffuse 0.6 } }
	texture { pigment { rgbt <1, 0.6, 0.2, 0.5> } finish { diffuse 0.5 phong 0.6 } }
	texture { pigment { rgbft <0.5, 1, 0.5, 0.4, 0.3> } finish { specular 0.7 roughness 0.01 metallic reflection 0.2 } } }
sphere { <1.2, 1, 0>, 0.9
	texture { pigment { rgbf <1, 0.9, 0.6, 0.7> } }
	texture { pigment { rgbt <0.3, 0.6, 0.9, 0.8> } finish { reflection 0.3 conserve_energy } } interior { ior 1.1 } }
