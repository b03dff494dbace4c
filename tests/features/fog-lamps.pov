// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// With media_attenuation fog dims what lamps send, also through glass; not with media_interaction off.
#declare No_lamp = 1;
#include "fogs.inc"
light_source { <4, 7, -5> rgb 1 media_attenuation on }
light_source { <-4, 7, -5> rgb 0.5 parallel point_at 0 media_attenuation on }
light_source { <-6, 3, -1> rgb 0.3 media_attenuation on media_interaction off }
fog { distance 9 rgbft <0.7, 0.6, 0.5, 0.1, 0.02> }
