// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
// Blended and layered textures that all mirror and let light through: where they ask for the same ray one serves
// them all, which may not show but where adc_bailout cuts a tree off. Glass on the right, flat mirrors on the left.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 7 }
camera { location <0, 1, -5> look_at <0, .7, 0> angle 45 }
light_source { <4, 8, -6> rgb 1 }
background { rgb <.2, .3, .5> }
plane { y, 0 pigment { checker rgb .9 rgb .2 scale .7 } }
#declare A = texture { pigment { rgbf <1, .9, .8, .9> } finish { reflection { .2 .3 } diffuse .1 } };
#declare B = texture { pigment { rgbf <.8, .9, 1, .7> } finish { reflection { .3 } diffuse .1 } };
#declare L = texture { pigment { rgbt <1, 1, 1, .8> } finish { reflection .2 diffuse .2 } }
	texture { pigment { rgbt <1, .5, 1, .7> } finish { reflection .1 diffuse .2 } }
#declare M = texture { average texture_map {
	[1 pigment { rgb <1, .6, .3> } finish { reflection .7 diffuse .3 }]
	[2 pigment { rgb <.3, .6, 1> } finish { reflection .5 diffuse .4 }] } }
sphere { <.2, .6, 0>, .55 texture { gradient y texture_map { [0 A] [1 B] } } interior { ior 1.4 } }
sphere { <1.4, .6, 0>, .55 texture { average texture_map { [1 A] [1 B] [2 L] } } interior { ior 1.2 } }
box { <-2, 0, .5>, <-.6, 1.6, .6> texture { M } }
box { <-2.1, 0, -1.5>, <-2, 1.6, .6> texture { M } }
