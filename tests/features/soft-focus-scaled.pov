// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Focal blur: the focal plane follows the direction's length, and scaling does not move it.
#include "room.inc"
camera { location <0, 0.5, 0> look_at <1, 0.3, 1>
	direction z * 3 right x * 2 up y * 1.5 aperture 0.6 blur_samples 4000 variance 0 confidence 0.999
	focal_point <2.5, 0, 3> scale <1, 1, 1.5> }
