// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Where some bands are totally reflected and others are not: the far face of a prism, and a pane of air in a
// block of glass that is looked at from within. Indices may fall from violet to red or rise.
#declare Trace_level = 10;
#include "stage.inc"
#declare Clear = texture { pigment { rgbf 0.95 } finish { diffuse 0 } }
#declare Mirror = texture { Clear finish { reflection 0.3 } }
intersection {
	plane { -y, 0 }
	plane { y, 0 rotate z * 38 translate y * 0.7 }
	plane { y, 0 rotate -z * 44 translate y * 0.8 }
	plane { -z, 0.8 }
	plane { z, 0.8 }
	texture { Mirror }
	interior { ior 1.45 dispersion 1.2 dispersion_samples 6 }
	rotate y * 20 scale 1.4 translate <-1.2, 0.01, 0>
}
sphere { <1.4, 1, 0>, 0.9 texture { Clear } interior { ior 0.8 dispersion 1.2 } }
sphere { <0, 0.5, -1.5>, 0.45 texture { Mirror } interior { ior 1.6 dispersion 0.85 dispersion_samples 5 } }
box { <-4, 0, 2>, <4, 3, 2.2> pigment { checker rgb <0.1, 0.1, 0.2>, rgb <1, 0.9, 0.7> scale 0.5 } }
