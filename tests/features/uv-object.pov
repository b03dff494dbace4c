// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// uv_mapping of an object: all its textures, those of faces too, are asked at (u, v, 0) behind their own transforms; the
// object's do not move them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,3,-6> look_at 0 angle 50 }
light_source { <5,10,-10> rgb 1 }
sphere { 0, .8 uv_mapping pigment { checker rgb <1,.9,.8> rgb <.1,.2,.8> scale .1 }  rotate z*20 translate <-1.5,-.7,0> }
sphere { 0, .8 uv_mapping texture { pigment { checker rgb <1,.9,.8> rgb <.1,.2,.8> scale .1 } scale 2} scale 1.3  translate <1.5,-.7,0> }
mesh2 { vertex_vectors { 4, <-1,-1,0>,<1,-1,0>,<1,1,0>,<-1,1,0> } uv_vectors { 5, <0,0>,<1,0>,<1,.7>,<.1,1.2>,<.5,.5> } texture_list { 2, texture { pigment { gradient x scale .3 } } texture { pigment { checker scale .2 } scale .7 } } face_indices { 2, <0,1,2>,0,<0,2,3>,1 } uv_indices { 2, <0,1,2>,<4,2,3> }
uv_mapping scale <1,.7,1> rotate y*30 translate <-1.5,1,0> }
