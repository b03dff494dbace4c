// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// A sky sphere of two layers, moved, with an emission; seen by mirrors and through glass.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
#default { finish { ambient 0.05 diffuse 0.7 } }
camera { location <0, 1.2, -6> look_at <0, 1.5, 0> right x * 4 / 3 up y angle 80 }
light_source { <4, 7, -5> rgb 1 }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <0.9, 0.3, 0.2> } }
sphere { <1.5, 1, 0>, 1 pigment { rgbf 0.9 } finish { diffuse 0.1 } interior { ior 1.3 } }
sphere { <0, 1, 2.5>, 1 pigment { rgb 0.1 } finish { reflection 0.8 } }
sky_sphere {
	pigment {
		gradient y color_map { [0 rgb <1, 0.8, 0.6>] [0.3 rgb <0.4, 0.6, 1>] [1 rgb <0.1, 0.1, 0.5>] }
		scale 2 translate -1
	}
	pigment {
		bozo color_map { [0 rgbf <1, 0.3, 0.2, 1>] [0.5 rgbft <1, 0.9, 0.8, 0.3, 0.4>] [0.7 rgb 1] }
		scale 0.3 turbulence 0.4
	}
	emission <0.8, 1, 1.2> rotate <10, 40, 0> scale <1, 2, 1> translate <0.1, 0.2, 0.3>
}
