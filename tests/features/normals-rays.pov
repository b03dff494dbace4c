// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Bent normals in mirrors and glass: each layer mirrors by its own, refraction goes by the topmost; rays that
// a bent normal throws into the surface; light from behind the bent normal.
#include "stage.inc"
sphere { <-1.4, 1, 0>, 0.9 pigment { rgb 0.2 } normal { bumps 1.2 scale 0.3 } finish { reflection 0.6 diffuse 0.3 } }
sphere { <0.6, 1, -0.6>, 0.8 pigment { rgbf 0.9 } normal { ripples 0.6 frequency 3 } interior { ior 1.4 }
	finish { reflection { 0, 1 fresnel } conserve_energy diffuse 0 specular 0.4 } }
box { <-0.6, 0, -0.6>, <0.6, 1.4, 0.6>
	texture { pigment { rgb <0.7, 0.3, 0.2> } normal { gradient y 0.5 scale 0.3 } finish { reflection 0.2 } }
	texture { pigment { rgbt <0.3, 0.4, 0.8, 0.6> } normal { bozo 0.6 scale 0.1 } finish { reflection 0.3 diffuse 0.6 0.3 } }
	rotate y * 30 translate <2, 0, 1> }
light_source { <-5, 1, 3> rgb 0.4 }
