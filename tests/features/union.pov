// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
union {
	sphere { <-0.6, 0.6, 0>, 0.6 }
	sphere { <0.6, 0.6, 0>, 0.6 texture { pigment { rgb <0.2, 0.9, 0.4> } } }
	union { box { <-0.3, 1, -0.3>, <0.3, 1.8, 0.3> } cylinder { <-1, 1.6, 0>, <1, 1.6, 0>, 0.1 no_shadow } rotate y * 25 }
	pigment { rgb <0.9, 0.5, 0.2> }
	finish { phong 0.6 }
	scale <1.2, 1, 0.8>
	rotate y * -15
}
