// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Patterns that push normals by vectors of their own, with the words that matter to them: frequency, phase
// and noise_generator, turbulence, and no_bump_scale.
#include "stage.inc"
#macro Ball(X, Y)
	sphere { <X, Y, 0>, 0.42 pigment { rgb <0.8, 0.7, 0.5> } finish { phong 0.4 }
#end
Ball(-1.5, 1.4) normal { bumps 0.8 scale 0.1 } }
Ball(-0.5, 1.4) normal { dents 1.5 noise_generator 1 turbulence 0.3 scale <0.1, 0.2, 0.05> } }
Ball(0.5, 1.4) normal { wrinkles 0.7 scale 0.2 rotate 40 } }
Ball(1.5, 1.4) normal { ripples 0.8 frequency 8 phase 0.3 } }
Ball(-1.5, 0.5) normal { waves 0.8 frequency 6 noise_generator 3 } }
Ball(-0.5, 0.5) normal { quilted 0.9 control0 0.3 control1 -0.5 scale 0.3 } }
Ball(0.5, 0.5) normal { facets size 0.2 } }
Ball(1.5, 0.5) normal { facets coords 0.6 scale 0.15 } }
Ball(-1, 2.2) normal { bumps 0.3 scale 0.1 no_bump_scale } }
Ball(1, 2.2) normal { bumps 0.5 scale <0.05, 0.3, 0.3> } }
