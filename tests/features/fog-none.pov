// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// A camera inside something opaque that is not hollow: no fog at all.
#include "fogs.inc"
sphere { <0, 2, -6>, 40 pigment { rgb <0.2, 0.2, 0.6> } }
fog { distance 6 rgb <0.7, 0.6, 0.5> }
