// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// The cylinder camera 4: around right, from the axis.
#include "room.inc"
camera { cylinder 4 location <0, 0.5, 0> look_at <1, 0.3, 1> angle 200 right x * 3 }
