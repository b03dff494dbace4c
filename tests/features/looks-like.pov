// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// What lamps look like: it stands at the lamp, moves with it and with copies of it, and casts no shadow of any lamp.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 2.2, -6> look_at <0, 0.8, 0> right x * 4 / 3 up y angle 60 }
#default { finish { ambient 0.05 diffuse 0.7 } }
plane { y, 0 pigment { rgb <0.8, 0.75, 0.6> } }
light_source { <0,0,0> rgb .8 looks_like { sphere { 0, .3 pigment { rgb <1,.8,.3> } finish { ambient 1 } translate y*.2 } } translate <-1,1.5,0> rotate y*30 }
light_source { <1,1.5,0> rgb .5 looks_like { box { -.2, .2 texture { pigment { rgb <.3,.8,1> } } } } rotate z*20 scale <1,1.2,1> }
light_source { <3,5,-3> rgb .4 }
sphere { <0,.4,1> .4 pigment { rgb .8 } }
#declare L = light_source { <-2,1,1> rgb .3 spotlight point_at 0 looks_like { cylinder { 0, y, .1 pigment { rgb 1 } } } }
light_source { L translate <-.5,0,0> }
