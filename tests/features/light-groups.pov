// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// What stands in a light_group is lit by its lights only, also in mirrors and by soft lamps; global_lights lets the
// others in. A group within has its own; the outermost decides about global_lights. Shadows are everybody's. A union's
// lamp in a group is in no group, and a moved copy of a group takes its lamps along.
#include "stage.inc"
#declare White = texture { pigment { rgb 0.9 } }
#declare Ball = sphere { <0, 0.5, 0>, 0.5 texture { White finish { specular 0.3 } } }
light_group {
	light_source { <-3, 4, -4> rgb <1, 0.3, 0.2> area_light x, y, 3, 3 adaptive 0 }
	object { Ball translate <-2, 0, 0> }
	light_group {
		object { Ball scale 0.6 translate <-2, 1, 0> }
		light_source { <-3, 4, -4> rgb <0.2, 1, 0.2> }
		global_lights
	}
}
light_group {
	light_source { <3, 2, -4> rgb <0.1, 0.3, 1> spotlight radius 10 falloff 20 point_at <0, 0.5, 0> }
	union { object { Ball } light_source { <0, 0.2, -2> rgb 0.3 fade_distance 0.5 fade_power 2 } }
	difference { box { <-0.3, 1, -0.3>, <0.3, 1.5, 0.3> } sphere { <0, 1.5, -0.3>, 0.3 } texture { White } }
	global_lights on
}
#declare Lit = light_group {
	light_source { <0, 1.4, -0.8> rgb <1, 1, 0.2> looks_like { sphere { 0, 0.1 texture { White } } } }
	object { Ball scale 0.7 }
	translate <1.4, 0, 0>
}
object { Lit }
object { Lit translate <1.2, 0, 0.5> }
box { <-3.5, 0, 1.8>, <3.5, 2.5, 2> pigment { rgb 0.2 } finish { reflection 0.5 } }
