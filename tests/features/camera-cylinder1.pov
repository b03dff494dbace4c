// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// The cylinder camera 1: around up, from a point.
#include "room.inc"
camera { cylinder 1 location <0, 0.5, 0> look_at <1, 0.3, 1> angle 200 up y * 1.3 rotate z * 20 scale 1.2 }
