// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// difference, intersection and merge of analytic shapes and planes: cut surfaces have the textures of
// what cuts, or of the whole.
#include "stage.inc"
difference { box{<-2.6,0,-.6>,<-1.4,1.2,.6>} sphere{<-2,1.2,-.6>,.6 pigment{rgb y}} cylinder{<-2,-1,0>,<-2,3,0>,.25 pigment{rgb z}} pigment{rgb <.9,.3,.2>} rotate y*10}
intersection { sphere{<-.3,.8,0>,.8} box{<-.9,.2,-.6>,<.3,1.3,.6> pigment{rgb <1,1,0>}} plane{<1,1,-1>,.9 pigment{rgb <0,1,1>}} pigment{rgb <.3,.3,.9>} finish{phong .6}}
merge { sphere{<1.2,.5,0>,.5} sphere{<1.7,.6,0>,.5} cylinder{<1.2,.5,0>,<1.7,1.6,0>,.2} pigment{rgbf <.9,.9,.5,.8>} interior{ior 1.2} finish{phong .8}}
difference { sphere{<.8,.4,-2>,.4} plane{<0,1,-.4>,1.1 inverse pigment{rgb x}} torus{.3,.15 translate <.8,.4,-2.2> pigment{rgb y}} pigment{rgb .7} }
