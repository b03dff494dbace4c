// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// superellipsoid: round, sharp, pinched (exponents above 2), cut, and clear.
#include "stage.inc"
superellipsoid{<.25,.25> scale .6 rotate y*30 translate <-2,.7,0> pigment{rgb <.9,.3,.2>} finish{phong .5}}
superellipsoid{<1,.2> scale .6 rotate <60,10,0> translate <-.6,.7,0> pigment{rgb <.3,.9,.2>} finish{phong .5}}
superellipsoid{<1.6,1.2> scale .7 rotate <20,40,0> translate <.8,.7,0> pigment{rgb <.3,.3,.9>} finish{phong .5}}
superellipsoid{<2.5,2.2> scale .7 rotate <20,40,0> translate <2.1,.7,0> pigment{rgb <.8,.8,.2>} finish{phong .5}}
difference{superellipsoid{<.5,.5> scale .4 rotate <20,40,0> } sphere{<.1,.1,-.4>,.3} translate <0,.4,-2> pigment{rgb <.8,.8,.8>}}
superellipsoid{<.05,.01> scale .3 rotate <20,40,0> translate <1,.4,-2> pigment{rgbf <.8,.9,.8,.8>} interior{ior 1.3}}
