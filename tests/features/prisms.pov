// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// prism: all kinds of spline and both of sweep, holes, without ends, cut, clear, across the tip of the cone.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8}
camera { location <0,3.5,-6> look_at <0,.6,0> angle 50 right 4/3*x }
light_source { <-10,20,-10>, 1 }
light_source { <5,6,-10>, .5 shadowless }
plane { y, 0 pigment { checker rgb 1 rgb <1,0,0> scale .3 } finish { ambient .3 diffuse .6 } }
prism { linear_sweep linear_spline 0, .6, 10, <-.7,-.7>,<.7,-.7>,<.7,.7>,<-.7,.7>,<-.7,-.7>, <-.3,-.4>,<.4,0>,<0,.3>,<-.4,.2>,<-.3,-.4> pigment { rgb <.2,.8,.3> } finish { phong .5 } rotate 20*y translate <-2,0.1,.8> }
prism { quadratic_spline 0, .5, 6, <-.5,-.8>,<-.6,-.4>,<.4,-.5>,<.6,.5>,<-.3,.4>,<-.6,-.4> pigment { rgb <.9,.6,.2> } rotate -40*x translate <0,.5,.9> }
prism { cubic_spline 0, .8, 7, <-.5,.6>,<-.6,-.4>,<.4,-.5>,<.6,.5>,<-.3,.4>,<-.6,-.4>,<.3,-.3> open pigment { rgb <.3,.6,1> } translate <1.8,0.01,.8> interior_texture { pigment{rgb <1,1,0>}} }
prism { conic_sweep linear_spline -.6, 1, 5, <-.6,-.5>,<.4,-.6>,<.5,.6>,<-.6,.4>,<-.6,-.5> pigment { rgb <.8,.3,.9> } translate <-1.4,.65,-1.2> }
prism { bezier_spline conic_sweep .3, 1, 12, <-.6,-.4>,<-.2,-.9>,<.3,-.2>,<.5,-.4>, <.5,-.4>,<.9,.2>,<.2,.4>,<.1,.6>, <.1,.6>,<-.3,.2>,<-.9,.3>,<-.6,-.4> pigment { rgbf <.8,.9,1,.8> } finish { reflection .1 } interior { ior 1.2 } rotate 180*x translate <.2,1.05,-1.2> }
difference { prism { linear_spline 0,1,5, <-.5,-.5>,<.5,-.5>,<.7,.5>,<-.5,.7>,<-.5,-.5> } prism { bezier_spline .5, 1.1, 4, <-.3,-.2>,<.8,-.6>,<.6,.8>,<-.3,-.2> pigment { rgb <1,.2,.2> } } pigment { rgb .8 } rotate 25*y translate <1.7,0.02,-1.2> }
