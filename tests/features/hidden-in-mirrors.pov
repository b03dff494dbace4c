// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// no_image and no_reflection, seen in a mirror through glass.
#version 3.7; global_settings{assumed_gamma 1 max_trace_level 10}
camera{location <0,1,-6> look_at <0,.8,0> angle 45}
background{rgb <.3,.5,.8>}
plane{y,-.3 pigment{rgb <.8,.3,.2>} finish{ambient 1 diffuse 0}}
box{<-2,-.2,1>,<2,2.4,1.2> pigment{rgb .1} finish{ambient .3 reflection .7}}
box{<-2,-.2,-1>,<0.2,2,-.9> pigment{rgbt <.9,.9,.9,.8>} finish{ambient 1 diffuse 0} interior{ior 1.3}}
sphere{<0,.8,-2>,.4 pigment{rgb <1,1,.1>} finish{ambient 1 diffuse 0} no_reflection}
sphere{<-1.4,.8,-2>,.4 pigment{rgb <1,.1,1>} finish{ambient 1 diffuse 0} no_image}
