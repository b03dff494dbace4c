// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Constructive solid geometry that light passes: one interior for the whole, merges without inner walls;
// unions that are inverted become intersections, and twice inverted merges.
#include "stage.inc"
#declare U=union{sphere{<-.3,0,0>,.5} sphere{<.3,0,0>,.5}}
intersection{ box{-.7,.7 pigment{rgb x}} object{U inverse} pigment{rgb <.3,.3,.9>} rotate y*30 translate <-1.8,.7,0>}
difference{ box{-.7,.7 pigment{rgb x}} union{object{U} cylinder{-y*2,y*2,.2 pigment{rgb y}}} pigment{rgb <.3,.3,.9>} rotate y*30 translate <0,.7,0>}
difference{ sphere{0,.8} sphere{0,.7} plane{<1,0,-1>,0 inverse} pigment{rgbf <.9,1,.9,.85>} interior{ior 1.4} finish{phong 1} translate <1.8,.8,0>}
intersection{ sphere{<-.2,0,0>,.5} sphere{<.2,0,0>,.5} pigment{rgbf <1,.9,.8,.9>} interior{ior 1.5 fade_distance .5 fade_power 2 fade_color <1,.3,.2>} translate <-.6,.5,-2>}
merge{ difference{sphere{0,.5} box{0,1}} cylinder{-.5*y,.6*y,.1} pigment{rgbt <.9,.8,.3,.5>} translate <.8,.5,-2>}
intersection{ union{sphere{0,.3} sphere{.2*x,.3}} union{box{-.2,.2} box{<0,-.3,-.3>,<.3,.3,0>}} pigment{rgbt <.4,.8,.3,.5>} translate <-1.6,.5,-2>}
object{U inverse inverse pigment{rgbt <.9,.2,.2,.5>} scale .4 translate <.1,.3,-2.5>}
