// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Constructive solid geometry with meshes that have an inside_vector, blobs, sphere_sweeps, unions, open
// cones and discs (half a space, seen from inside); clipped_by, bounded_by.
#include "stage.inc"
#declare C=mesh2{vertex_vectors{4,<-.5,-.5,-1>,<.5,-.5,-1>,<0,.7,-1>,<0,0,.5>} face_indices{4,<0,1,2>,<0,1,3>,<1,2,3>,<0,2,3>} inside_vector z};
difference { box{<-2.6,0,-.6>,<-1.4,1.2,.6>} object{C scale 1.2 translate <-2,.8,.2> pigment{rgb y}} pigment{rgb <.9,.3,.2>} rotate y*10}
intersection { object{C scale 2 translate <0,.8,0>} sphere{<0,.8,-1>,.8 inverse} pigment{rgb <.3,.3,.9>} finish{phong .6}}
sphere { <1.5,.7,0>,.7 clipped_by{plane{z,-.3 inverse} box{-1,1 rotate 45*z scale .5 translate <1.5,.7,0>}} pigment{rgb <.2,.7,.3>} rotate y*10 }
union { sphere{<2.5,1,0>,.5} torus{.5,.1 translate <2.4,1,0>} clipped_by{plane{x,2.5}} pigment{rgb <.6,.6,.1>} bounded_by{clipped_by} }
difference { union{sphere{<-.5,.3,-2>,.3} sphere{<-.2,.3,-2>,.3}} union{sphere{<-.5,.4,-2.3>,.2 pigment{rgb x}} sphere{<-.3,.4,-2.3>,.2 pigment{rgb y}}} pigment{rgb .8} }
difference { blob{threshold .4 sphere{<.5,.4,-2>,.6,1} sphere{<.9,.5,-2>,.5,1}} sphere_sweep{linear_spline 2,<.2,.6,-2.5>,.15,<1.2,.5,-2.3>,.2 pigment{rgb x}} pigment{rgb <.4,.8,.8>}}
object { difference { box{<1.6,0,-2>,<2.2,.6,-1.4>} cylinder{<1.9,-1,-1.7>,<1.9,2,-1.7>,.2 open} disc{<1.9,.5,-1.7>,y+x,.3} pigment{rgb <.9,.5,.5>} } }
