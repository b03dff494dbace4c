// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// The spherical camera, with both angles.
#include "room.inc"
camera { spherical location <0, 0.5, 0> look_at <1, 0.3, 1> angle 300 120 rotate <10, 20, 30> scale <1, 1, 1.5> }
