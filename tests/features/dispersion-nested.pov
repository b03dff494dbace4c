// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Glass in glass, glass that overlaps, and a camera within glass: the ratio of the dispersions on both sides of
// a surface counts, and the bands of the surface that is crossed, or on the way out of it those of what is around if
// they are more.
#declare Trace_level = 14;
#include "stage.inc"
#declare Clear = texture { pigment { rgbf 0.95 } finish { diffuse 0 } }
sphere { <0, 2.2, -6>, 1.5 texture { Clear } interior { ior 1.05 dispersion 1.05 dispersion_samples 9 } hollow }
sphere { <-0.2, 2, -4.9>, 0.1 texture { Clear } interior { ior 1.2 dispersion_samples 3 } }
sphere { <0.2, 2, -4.9>, 0.1 texture { Clear } interior { ior 1.1 dispersion 1.05 } }
sphere { <-1.2, 1, 0>, 0.9 texture { Clear } interior { ior 1.4 dispersion 1.1 } }
sphere { <-1.2, 1, 0>, 0.6 texture { Clear } interior { ior 1.1 } }
sphere { <1, 0.8, 0>, 0.7 texture { Clear } interior { ior 1.3 dispersion 1.2 } }
sphere { <1.6, 1.1, -0.3>, 0.6 texture { Clear } interior { ior 1.5 dispersion 1.1 } }
box { <-4, 0, 2>, <4, 3, 2.2> pigment { checker rgb <0.1, 0.1, 0.2>, rgb <1, 0.9, 0.7> scale 0.5 } }
