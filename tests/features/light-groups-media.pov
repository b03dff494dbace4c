// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Media are lit by the lights of what the ray meets behind them, be it the back of what they fill or a wall.
#include "stage.inc"
fog { distance 30 rgb <0.4, 0.4, 0.5> }
light_group {
	light_source { <-3, 4, -4> rgb <1, 0.3, 0.2> media_attenuation on }
	box { <-2.5, 0, 1>, <0, 2, 1.2> pigment { rgb 0.7 } }
	sphere { <-1, 0.6, 0>, 0.6 hollow pigment { rgbt 1 } interior { media { scattering { 1, 0.6 extinction 1 } samples 8, 8 } } }
}
sphere { <0.9, 0.7, 0>, 0.7 hollow pigment { rgbt 1 } interior { media { scattering { 1, 0.6 extinction 1 } samples 8, 8 } } }
light_group {
	box { <0, 0, 1.4>, <1, 2, 1.6> pigment { rgb 0.7 } }
	light_source { <3, 3, -4> rgb <0.1, 0.3, 1> }
	global_lights
}
