// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Patterns lie in their own coordinates, which move with what comes after them: in a pigment, in a texture,
// of an object. Wood with turbulence uses it inside.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,3,-6> look_at 0 angle 50 }
light_source { <5,10,-10> rgb 1 }
plane { y, -1 pigment { checker rgb 1 rgb <1,.2,.1> scale 0.7 } }
sphere { <-1.5,0,0>, 1 pigment { gradient y color_map { [0 rgb <1,0,0>][.5 rgb <0,1,0>][1 rgb <0,0,1>] } scale 0.5 rotate z*30 } }
sphere { <1.5,0,0>, 1 texture { pigment { wood turbulence .1 scale .3 } finish { phong .5 } } rotate x*40 translate y*.2 }
box { -0.5, 0.5 texture { brick texture { pigment { rgb .8 } } texture { pigment { onion scale .1 } } scale .06 } rotate y*30 }
