// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// The omnimax camera: its own lens, and nothing 45 degrees below the screen's axis.
#include "room.inc"
camera { omnimax location <0, 0.5, 0> look_at <1, 0.9, 1> }
