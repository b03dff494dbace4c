// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// The fisheye camera: the whole angle across the unit circle, nothing outside; its shape follows right and up.
#include "room.inc"
camera { fisheye location <0, 0.5, 0> look_at <1, 0.3, 1> angle 170 right x * 1.2 rotate z * 10 }
