// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Fog fills a hollow glass ball, and a clear box around the camera keeps it out.
#declare Hollow_glass = 1;
#include "fogs.inc"
box { <-3, 1, -7>, <3, 4, -5.5> pigment { rgbt 0.9 } }
fog { distance 6 rgb <0.7, 0.6, 0.5> }
