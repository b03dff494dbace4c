// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Two fogs: one above a tilted ground, both with filter and transmit.
#include "fogs.inc"
fog { distance 6 rgbft <0.7, 0.6, 0.5, 0.4, 0.2> }
fog { distance 3 fog_type 2 fog_alt 1 rgbf <0.2, 0.6, 0.9, 0.3> fog_offset 0.4 up <1, 2, 0> rotate z * 20 translate y * 5 }
