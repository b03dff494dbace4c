// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Quadrics, cubics, quartics, poly and polynomial: whole, clipped, in solids that they bound and that they cut, inside
// out, with textures inside, far larger than the scene, and moved.
#include "stage.inc"
// a torus, two ways
quartic {
	<1, 0, 0, 0, 2, 0, 0, 2, 0, -0.58, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
	1, 0, 0, 2, 0, 0.42, 0, 0, 0, 0, 1, 0, -0.58, 0, 0.044100>
	sturm rotate <60, 20, 0> translate <-1.9, 1, 0> pigment { rgb <0.9, 0.8, 0.3> } finish { phong 0.5 } }
polynomial { 4,
	xyz(4,0,0): 1, xyz(2,2,0): 2, xyz(2,0,2): 2, xyz(2,0,0): -58e4, xyz(0,4,0): 1, xyz(0,2,2): 2, xyz(0,2,0): 42e4,
	xyz(0,0,4): 1, xyz(0,0,2): -58e4, xyz(0,0,0): 441e8
	sturm scale 1e-3 translate <-0.6, 0.2, -0.9> pigment { rgb <0.3, 0.8, 0.9> } }
// a cone without ends between planes; its tip shows
intersection { quadric { <1, -0.3, 1>, <0, 0, 0>, <0, 0, 0>, 0 } box { <-1, -1, -1>, <1, 0.4, 1> }
	translate <0.2, 1, 0.3> pigment { rgb <0.9, 0.3, 0.3> } }
// a saddle, clipped
quadric { <1, 0, -1>, 0, <0, -1, 0>, 0 clipped_by { sphere { 0, 0.8 } } rotate y * 30 translate <1.6, 1, 0>
	pigment { rgb <0.4, 0.9, 0.4> } interior_texture { pigment { rgb <0.5, 0.4, 1> } } }
// a box with a hyperboloid taken out
difference { box { <-0.4, -0.3, -0.4>, <0.4, 0.3, 0.4> } quadric { <1, -0.5, 1>, 0, 0, -0.02 }
	rotate <-30, 30, 0> translate <0.6, 0.3, -1.4> pigment { rgb <0.9, 0.5, 0.9> } }
// a ball with all that is outside of a cylinder taken out
difference { sphere { 0, 0.5 } quadric { <1, 0, 1>, 0, 0, -0.04 inverse }
	rotate <50, 0, 30> translate <1.5, 0.4, -1.5> pigment { rgb <1, 0.9, 0.5> } }
// an egg, and a cubic
quadric { <4, 2, 4>, <0, 0, 0.5>, <0, -0.2, 0>, -0.3 translate <-1.7, 0.4, -1.5> pigment { rgb <0.8, 0.8, 1> } }
cubic { <1, 0, 0, 0, -3, 0, 0, 0, 0, -1.2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0>
	clipped_by { box { -0.5, 0.5 } }
	scale 1.2 translate <-0.7, 1.7, 0.5> pigment { rgb <0.6, 0.6, 0.9> } }
// one without bounds: a valley behind all
quadric { <0.02, 0, 0>, 0, <0, -1, 0.5>, -6 pigment { checker rgb 0.5 rgb 0.9 scale 2 } }
// of degree 6, x^6 + y^6 + z^6 = r^6
polynomial { 6, xyz(6,0,0): 1, xyz(0,6,0): 1, xyz(0,0,6): 1, xyz(0,0,0): -0.0041
	rotate <20, 40, 0> translate <1, 1.6, -0.6> pigment { rgb <0.9, 0.6, 0.3> } }
