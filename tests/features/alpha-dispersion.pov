// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Light that was split does not let the background's transparency through; light that was not does.
#declare Trace_level = 8;
#include "stage.inc"
sphere { <-1, 1.5, 0>, 0.9 pigment { rgbf 0.9 } finish { diffuse 0 } interior { ior 1.3 dispersion 1.1 } }
sphere { <1, 1.5, 0>, 0.9 pigment { rgbf 0.9 } finish { diffuse 0 } interior { ior 1.3 } }
