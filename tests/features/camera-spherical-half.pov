// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// One angle given to a spherical camera: half of it upward.
#include "room.inc"
camera { spherical location <0, 0.5, 0> look_at <1, 0.3, 1> angle 200 }
