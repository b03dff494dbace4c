// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// What is asked at (u, v, 0): meshes with and without coordinates, the shapes that have some of their own, those
// that have not (x and y of the scene); transforms behind uv_mapping change nothing.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,3,-6> look_at 0 angle 50 }
light_source { <5,10,-10> rgb 1 }
#declare P = pigment { uv_mapping checker rgb <1,.9,.8> rgb <.1,.2,.8> scale .1 }
#declare M = mesh2 { vertex_vectors { 4, <-1,-1,0>,<1,-1,0>,<1,1,0>,<-1,1,0> } uv_vectors { 5, <0,0>,<1,0>,<1,.7>,<.1,1.2>,<.5,.5> } face_indices { 2, <0,1,2>,<0,2,3> } uv_indices { 2, <0,1,2>,<4,2,3> } }
object { M pigment { P } scale <1,.7,1> rotate y*30 translate <-1.5,1,0> }
object { M texture { uv_mapping gradient x texture_map { [0.3 pigment { rgb x } ][.6 pigment { P } ] } scale .5 } rotate y*-30 translate <1.5,1,0> }
sphere { 0, .8 pigment { P } rotate z*20 translate <-1.5,-.7,0> }
box { -.6, .7 texture { pigment { P } scale 3 } rotate y*30 translate <0,-.7,0> scale <1,1,1> }
torus { .6, .25 pigment { P } rotate x*-50 translate <1.7,-.7,0> }
cylinder { <0,1.2,0>, <0,1.9,0>, .3 pigment { P } }
plane { y, -2 pigment { P } }
mesh { triangle { <-3,-1,1>,<3,-1,1>,<0,4,1> uv_vectors <0,0>,<3,0>,<0,3> } triangle { <-3,-1,3>,<3,-1,3>,<6,4,3> } pigment { P scale 3 } }
triangle { <-3,-1,-1>,<-2,-1,-1>,<-3,1,0> pigment { P } rotate y*10 }
