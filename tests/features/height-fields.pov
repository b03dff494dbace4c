// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Heights of pictures (grey, colours, a palette, gamma) and of a function, which may overflow; smooth ones, water
// levels, and solids cut by them; flat cells have their diagonals where POV-Ray has them.
#include "stage.inc"
#declare Hills = function { 0.3 + 0.2 * sin(9 * x + 4 * y) * cos(7 * y) }
height_field { function 9, 7 { Hills(x, y, 0) } scale <1.8, 1, 1.2> translate <-2.6, 0.05, -1.6>
	pigment { rgb <0.9, 0.7, 0.4> } }
height_field { function 8, 8 { Hills(x, y, 0) } smooth scale <1.6, 1.2, 1.4> rotate y * 20 translate <-0.7, 0, -1.9>
	pigment { rgb <0.4, 0.8, 0.5> } finish { phong 0.6 } }
height_field { function 24, 16 { Hills(y, x, 0) + 0.9 * (x > 0.7) } smooth water_level 0.28 scale <1.4, 1.2, 1.4>
	rotate x * -30 translate <0.9, 0.2, -1.7> pigment { gradient x scale 0.4 } interior_texture { pigment { rgb x } } }
height_field { png "pictures/grey.png" smooth scale <1.4, 0.4, 1> rotate x * -60 translate <-2, 0.9, 0.4>
	pigment { rgb <0.8, 0.8, 1> } }
height_field { "pictures/colour.png" gamma 2 scale <1.2, 0.5, 1> rotate x * -60 translate <-0.4, 0.9, 0.4>
	pigment { rgb <1, 0.8, 0.8> } }
difference { box { <0.05, 0, 0.05>, <0.95, 0.6, 0.95> } height_field { function 20, 20 { Hills(x, y, 0) } }
	rotate <-30, -30, 0> scale 1.3 translate <1, 0.9, 0.3> pigment { rgb <0.9, 0.5, 0.9> } }
height_field { png "pictures/palette.png" scale <0.8, 2, 0.5> rotate x * -60 translate <-2.2, 0.1, -2.4> pigment { rgb <1, 1, 0.5> } }
height_field { jpeg "pictures/greyphoto.jpg" scale <0.8, 0.6, 0.5> rotate x * -60 translate <1.2, 0, -2.5> pigment { rgb <0.5, 1, 1> } }
height_field { "pictures/deep.png" smooth scale <0.8, 0.3, 0.5> rotate x * -60 translate <2, 1.4, 0.5> pigment { rgb <0.7, 1, 0.7> } }
