// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// The cylinder camera 3: around up, from the axis.
#include "room.inc"
camera { cylinder 3 location <0, 0.5, 0> look_at <1, 0.3, 1> angle 200 up y * 3 }
