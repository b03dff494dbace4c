// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// The ultra_wide_angle camera; the angle upward is in proportion to up and right.
#include "room.inc"
camera { ultra_wide_angle location <0, 0.5, 0> look_at <1, 0.3, 1> angle 140 }
