// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// material_map: textures by a palette's number, or by the red of a picture without one. (Interpolated, such a picture
// has stray pixels of the first texture in POV-Ray where the weights do not quite add up to 1; not so in ours.)
#include "stage.inc"
box { <-2.4, 0.2, 0>, <-0.2, 2.2, 0.3>
	texture { material_map { png "pictures/palette.png"
		texture { pigment { rgb <1, 0.2, 0.2> } }
		texture { pigment { rgb <0.2, 1, 0.2> } finish { reflection 0.3 } }
		texture { pigment { rgb <0.2, 0.3, 1> } }
		texture { pigment { rgbt <0.2, 0.3, 1, 0.5> } } } scale 2 } }
box { <0.2, 0.2, 0>, <2.4, 2.2, 0.3>
	texture { material_map { png "pictures/colour.png"
		texture { pigment { rgb <1, 0.8, 0.2> } }
		texture { pigment { rgb <0.2, 0.8, 0.7> } }
		texture { pigment { rgb <0.7, 0.3, 1> } } } scale 2 } }
