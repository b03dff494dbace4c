// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Focal blur: a disc of a quarter of the aperture, and its own anti-aliasing.
#include "room.inc"
camera { location <0, 0.5, 0> look_at <1, 0.3, 1> aperture 0.6
	blur_samples 4000 variance 0 confidence 0.999 focal_point <2.5, 0, 3> }
