// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
sphere { <-1, 1, 0>, 0.9 pigment { rgb 0.3 } finish { reflection { 0.05, 1 fresnel on } } interior { ior 1.8 } }
sphere { <1.2, 1, 0>, 0.9 pigment { rgb <0.1, 0.2, 0.6> } finish { reflection { 1 fresnel } conserve_energy } interior { ior 1.33 } }
