// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Turbulence thins fog, by its own octaves, lambda and omega.
#include "fogs.inc"
fog {
	distance 6 rgb <0.7, 0.6, 0.5> turbulence <0.5, 0.2, 1> turb_depth 0.9 octaves 3 lambda 3 omega 0.7
	fog_type 2 fog_alt 0.5
}
fog { distance 15 rgb <0.2, 0.3, 0.6> turbulence 0.5 }
