// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// White light is split where it is first bent, in seven bands or as many as are asked for, and not again: by a ball
// with a mirror's share, a prism of coloured and fading glass, and a slab that bends nothing but its colours.
#declare Trace_level = 12;
#include "stage.inc"
#declare Glass = texture { pigment { rgbf <0.95, 1, 0.95, 0.95> } finish { diffuse 0.05 specular 0.4 } }
sphere {
	<-1.4, 0.9, 0>, 0.85
	texture { Glass finish { reflection { 0, 1 fresnel } conserve_energy } }
	interior { ior 1.5 dispersion 1.15 }
}
intersection {
	box { <-0.6, 0, -0.6>, <0.6, 1.7, 0.6> }
	plane { x, 0 rotate y * 30 translate x * 0.2 }
	plane { -x, 0 rotate -y * 30 translate -x * 0.5 }
	texture { Glass pigment { rgbf <1, 0.9, 0.8, 0.9> } }
	interior { ior 1.4 dispersion 1.1 dispersion_samples 12 fade_distance 1 fade_power 1 fade_color <0.9, 0.6, 0.5> }
	translate <0.7, 0.001, -1>
}
box { <-0.5, 0.001, -0.3>, <0.5, 1.2, 0.3> texture { Glass } interior { ior 1 dispersion 1.4 dispersion_samples 4 } rotate y * 40 translate <2, 0, 0> }
box { <-4, 0, 2>, <4, 3, 2.2> pigment { gradient x color_map { [0.5 rgb <0.1, 0.1, 0.2>] [0.5 rgb <1, 0.9, 0.7>] } scale 0.7 } }
