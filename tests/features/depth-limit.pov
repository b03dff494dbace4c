// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#declare Trace_level = 3;
#include "stage.inc"
sphere { <-1.2, 1, 0>, 0.9 pigment { rgbf <1, 1, 1, 0.9> } finish { reflection 0.3 } interior { ior 1.5 } }
sphere { <1.2, 1, 0>, 0.9 pigment { rgbt <1, 1, 1, 0.7> } finish { reflection 0.8 } }
box { <-3, 0, 2>, <3, 3, 2.2> pigment { rgb 0.1 } finish { reflection 0.9 } }
