// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// sphere_sweep: linear_spline, b_spline and cubic_spline, stretched too; of a clear linear one the surface is
// that of the whole, without what lies inside (of curved ones it is not: sweeps-clear.pov).
#include "stage.inc"
sphere_sweep { linear_spline 4, <-2.5,.3,0>,.3, <-2,1.8,0>,.15 <-1.2,1,.6>,.4 <-1.3,.4,-1>,.05 pigment{rgb <.9,.3,.2>} finish{phong .5}}
sphere_sweep { b_spline, 6, <-1.5,.3,0>,.3, <-.5,2.8,0>,.15 <-.2,.1,.6>,.6 <.5,2.5,-.6>,.05 <1,.3,0>,.3 <1.5,.2,0>,.3 pigment{rgb <.3,.9,.2>} finish{phong .5} scale <1,.8,1>}
sphere_sweep { cubic_spline 6, <.5,.3,0>,.3, <1,1.8,0>,.15 <1.2,.5,.6>,.4 <1.5,1.5,-.6>,.05 <2.3,.3,0>,.3 <2.5,.2,0>,.3 tolerance 1e-5 pigment{rgb <.3,.3,.9>} finish{phong .5} rotate y*20}
sphere_sweep { linear_spline 5, <.2,.3,-2>,.3, <.8,1.1,-2>,.2 <1.6,.4,-1.5>,.3 <1.9,.4,-2>,.2 <1,.5,-2>, .1
	pigment{rgbf <.9,.8,.4,.8>} finish{phong .5} interior{ior 1.3}}
