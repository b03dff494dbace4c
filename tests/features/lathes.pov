// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// lathe: all kinds of spline, cut, and clear.
#include "stage.inc"
lathe{linear_spline 5 <.1,.1>,<.5,.2>,<.2,.8>,<.45,1.1>,<.1,1.3> rotate <20,0,10> translate <-2.2,.2,0> pigment{rgb <.9,.3,.2>} finish{phong .5}}
lathe{quadratic_spline 6 <.1,0>,<.5,.1>,<.2,.5>,<.45,.8>,<.2,1.1>,<.2,1.5> translate <-.9,0,0> pigment{rgb <.3,.9,.2>} finish{phong .5}}
lathe{cubic_spline 7 <0,0>,<0.02,.1>,<.5,.3>,<.2,.7>,<.45,1>,<.01,1.4>,<0,2> translate <.5,0,0> pigment{rgb <.3,.3,.9>} finish{phong .5}}
lathe{bezier_spline 8 <.1,0>,<.6,0>,<.5,.4>,<.3,.6> <.3,.6>,<.1,.8>,<.5,1>,<.3,1.3> sturm translate <1.9,.1,0> pigment{rgb <.8,.8,.2>} finish{phong .5}}
difference{lathe{cubic_spline 7 <.0,-.5>,<.3,-.4>,<.5,-.1>,<.35,.1>,<.5,.3>,<.3,-.4>,<0,-.5> rotate <-30,40,0> } sphere{<.1,.2,-.5>,.3} translate <-.4,.5,-2> pigment{rgb <.8,.8,.8>}}
lathe{linear_spline 5 <.0,.05>,<.3,.1>,<.4,.5>,<.1,.6>,<0,.05> translate <.8,0,-2> pigment{rgbf <.8,.9,.8,.8>} interior{ior 1.3}}
