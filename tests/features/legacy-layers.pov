// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers weigh by the rules of 3.6 in a scene for 3.6.
#version 3.6; global_settings{assumed_gamma 1}
camera{location <0,1,-6> look_at <0,.5,0> angle 35}
light_source{<3,6,-5> rgb 1} background{rgb <.3,.5,.8>}
plane{y,-1 pigment{rgb <.8,.3,.2>}}
sphere{0,1 texture{pigment{rgb <.2,.4,.9>}} texture{pigment{rgbft <.9,.6,.2,.5,.2>} finish{phong .5}}}
sphere{<2,0,0>,.7 pigment{rgbf <.9,.5,.3,.6>}}
