// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Focal blur of a camera that looks around: what is in focus is a sphere.
#include "room.inc"
camera { spherical location <0, 0.5, 0> look_at <1, 0.3, 1>
	angle 120 aperture 0.6 blur_samples 4000 variance 0 confidence 0.999 focal_point <2.5, 0, 3> }
