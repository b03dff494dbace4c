// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Maps of pigments and textures are asked behind the warps of the pattern; textures that a pattern blends mirror
// and let light through each for itself; a union's layers with patterns are for what has no texture.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,3,-6> look_at 0 angle 50 }
light_source { <5,10,-10> rgb 1 }
plane { y, -1 texture { checker texture { pigment { rgbt <1,1,1,.5> } } texture { pigment { rgb <1,.2,.1> } finish { reflection .3 } } scale 0.7 } }
plane { y, -2 pigment { hexagon scale .4 } }
#declare T = texture { gradient x texture_map { [0 pigment { rgb <1,0,0> } finish { reflection .5 }] [.5 pigment { rgbf <.2,1,.2,.8> } ] [1 pigment { agate } ] } scale .8 }
sphere { <-1.5,0,0>, 1 texture { T } rotate y*30 }
union { sphere { <1.5,0,0>, 1 } box { <1,-.5,-.5>, <2,1.5,.5> pigment { crackle scale .2 } } texture { pigment { marble turbulence .3 color_map { [0 rgbt <1,1,0,.7>] [1 rgb .2] } } scale .3 } texture { pigment { radial frequency 8 color_map { [0 rgbt <1,1,0,.7>] [1 rgb .2] } } } rotate x*40 translate y*.2 }
box { -0.5, 0.5 pigment { average pigment_map { [1 gradient x] [2 spherical scale 1 translate y*.1] [.5 rgb <1,0,1>] } } rotate y*30 }
