// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// The panoramic camera: half a turn, whatever its angle; the direction's length counts.
#include "room.inc"
camera { panoramic location <0, 0.5, 0> direction z * 2 angle 120 rotate y * 40 }
