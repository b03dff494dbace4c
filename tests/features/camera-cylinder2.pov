// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// The cylinder camera 2: around right, from a point.
#include "room.inc"
camera { cylinder 2 location <0, 0.5, 0> look_at <1, 0.3, 1> angle 200 right x * 2 }
