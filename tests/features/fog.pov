// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Fog everywhere, but in solid glass: along camera, mirrored and bent rays; the lamp is not dimmed.
#include "fogs.inc"
fog { distance 6 rgb <0.7, 0.6, 0.5> }
