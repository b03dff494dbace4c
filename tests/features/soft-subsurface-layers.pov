// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers, patterns and bumps: bumps matter to highlights only, what is above filters, a clear pigment lets lamps in
// from behind and the eye through besides. Emission and ambient stay.
#version 3.7;
global_settings { assumed_gamma 1 mm_per_unit 10 subsurface { samples 200, 25 } }
camera { location <0, 1, -5> look_at 0 angle 40 }
background { rgb <0.05, 0.1, 0.2> }
light_source { <-3, 4, -5> rgb <0.8, 1, 0.9> }
light_source { <2, 3, 6> rgb 1 }
plane { y, -0.8 pigment { rgb 0.5 } }
#declare Below = finish { ambient 0 diffuse 0.8 specular 0.4 subsurface { translucency <3, 2, 1> } }
sphere {
	<-1.1, 0, 0>, 0.5
	pigment { checker rgb <0.8, 0.5, 0.3>, rgb <0.3, 0.6, 0.9> scale 0.2 }
	normal { bumps 1 scale 0.1 }
	finish { Below }
	interior { ior 1.3 }
}
sphere {
	0, 0.5
	texture { pigment { rgb <0.8, 0.5, 0.3> } finish { Below } }
	texture { pigment { gradient x color_map { [0.4 rgbf <1, 0.5, 0.5, 0.7>] [0.4 rgbt 1] } } finish { ambient 0 } }
	interior { ior 1.3 }
}
sphere {
	<1.1, 0, 0>, 0.5
	pigment { rgbt <0.8, 0.5, 0.3, 0.3> }
	finish { Below ambient 0.1 emission 0.1 }
	interior { ior 1.1 }
}
