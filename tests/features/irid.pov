// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Thin films: over diffuse light and highlights, over what mirrors with an exponent show, over glass; turbulence.
#include "stage.inc"
light_source { <-4, 5, -3> rgb 0.3 }
sphere { <-1.6, 0.8, 0>, 0.8 pigment { rgb 0.5 } finish { diffuse 0.5 phong 0.6 irid { 0.35 thickness 0.5 } } }
sphere {
	<0, 0.8, 0>, 0.8 pigment { rgb 0.2 }
	finish { diffuse 0.2 specular 0.5 reflection { 0.5 exponent 1.4 } irid { 0.35 thickness 0.2 turbulence 0.5 } }
}
sphere {
	<1.6, 0.8, 0>, 0.8 pigment { rgbf <0.8, 0.9, 1, 0.9> }
	finish { diffuse 0.2, 0.3 reflection { 0.1, 0.8 fresnel } conserve_energy irid { 0.4 thickness 0.3 } }
	interior { ior 1.5 }
}
