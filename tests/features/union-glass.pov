// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#version 3.7; global_settings{assumed_gamma 1 max_trace_level 12}
camera{location <0,1,-6> look_at 0 angle 35}
light_source{<3,6,-5> rgb 1} background{rgb <.3,.5,.8>}
plane{y,-1 pigment{rgb <.8,.3,.2>}}
union{sphere{0,.9 translate <-.4,0,0>} sphere{0,.9 translate <.4,0,0>} pigment{rgbf <1,.9,.8,.9>} interior{ior 1.4}}
