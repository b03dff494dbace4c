// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#declare Trace_level = 20;
#include "stage.inc"
sphere { <0, 1.2, 0>, 1.1 pigment { rgbf <0.95, 1, 0.95, 0.95> } interior { ior 1.5 } }
sphere { <0.2, 1.3, 0>, 0.6 pigment { rgbf <1, 0.9, 0.9, 0.9> } interior { ior 1.2 } }
sphere { <0.9, 0.8, -0.3>, 0.6 pigment { rgbf <0.9, 0.9, 1, 0.9> } interior { ior 1.8 } }
