// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// One of each shape, some with extremes: what bits.sh holds every compiler and every accelerator against.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 4 }
background { rgb <0.2, 0.3, 0.5> }
camera { location <0, 7, -16> look_at <0, 0.5, 0> angle 40 right x*4/3 }
light_source { <-12, 15, -10>, rgb 0.8 }
light_source { <9, 8, -12>, rgb 0.5 area_light x, y, 3, 3 adaptive 1 }
#default { texture { pigment { rgb <0.9, 0.7, 0.5> } finish { ambient 0.1 diffuse 0.6 specular 0.3 reflection 0.1 } } }

plane { y, -1 pigment { checker rgb 0.3, rgb 0.7 } }
sphere { <-7, 0, -3>, 0.9 }
sphere { 0, 1 scale <0.9, 0.5, 1e-3> rotate 30 translate <-5, 0, -3> }
box { <-3.8, -0.8, -3.7>, <-2.4, 0.6, -2.2> rotate 12*y pigment { bozo scale 0.3 } }
cylinder { <-1.5, -0.9, -3>, <-0.6, 0.8, -2.6>, 0.6 }
cylinder { <-1.5, 1.4, -3>, <-0.6, 1.6, -2.6>, 0.2 open }
cone { <1, -0.9, -3>, 0.8, <1.1, 0.9, -3>, 0.1 }
cone { <1, 1, -3>, 0, <1.1, 1.7, -3>, 0.3 open }
torus { 0.7, 0.25 rotate <60, 0, 20> translate <3, 0, -3> }
disc { <5, 0, -3>, <0.3, 0.5, -1>, 0.9, 0.3 }
superellipsoid { <0.3, 1.7> scale 0.8 translate <7, 0, -3> }
prism { linear_spline -0.7, 0.7, 10, <-0.7, -0.7>, <0.7, -0.7>, <0.7, 0.7>, <-0.7, 0.7>, <-0.7, -0.7>,
	<-0.3, -0.3>, <0.3, -0.3>, <0.3, 0.3>, <-0.3, 0.3>, <-0.3, -0.3> rotate <30, 20, 0> translate <-7, 0, 0> }
lathe { cubic_spline 6, <0.2, -1.2>, <0.6, -0.9>, <0.9, -0.2>, <0.3, 0.3>, <0.6, 0.9>, <0.4, 1.2> translate <-5, 0, 0> }
blob { threshold 0.5 sphere { <-0.3, 0, 0>, 0.9, 1 } cylinder { <0, 0, 0>, <0.7, 0.4, 0.2>, 0.6, 1 } sphere { <0.2, 0.5, 0>, 0.6, -0.7 }
	translate <-1, 0, 0> }
sphere_sweep { b_spline 5, <-0.6, -0.6, 0>, 0.3 <-0.6, 0.6, 0>, 0.4 <0.6, 0.6, 0>, 0.2 <0.6, -0.6, 0>, 0.3 <0, -0.7, 0.5>, 0.3
	translate <1, 0, 0> }
triangle { <4.3, -0.6, 0>, <5.6, -0.5, 0.3>, <5, 0.8, 0> }
smooth_triangle { <4.3, 0.6, 0>, <-0.2, 0, -1>, <5.6, 0.7, 0.3>, <0.2, 0.1, -1>, <5, 1.8, 0>, <0, 0.3, -1> }
isosurface { function { x*x + y*y*y*y + z*z - 0.5 + 0.1*sin(9*x) } contained_by { sphere { 0, 1.2 } } max_gradient 6 accuracy 1e-4
	translate <7, 0, 0> }
mesh2 { vertex_vectors { 8, <-1, -1, -1>, <1, -1, -1>, <1, 1, -1>, <-1, 1, -1>, <-1, -1, 1>, <1, -1, 1>, <1, 1, 1>, <-1, 1, 1> }
	face_indices { 12, <0, 1, 2>, <0, 2, 3>, <4, 6, 5>, <4, 7, 6>, <0, 4, 5>, <0, 5, 1>, <3, 2, 6>, <3, 6, 7>, <0, 3, 7>, <0, 7, 4>,
	<1, 5, 6>, <1, 6, 2> } inside_vector y scale 0.6 rotate <20, 30, 10> translate <-7, 0, 3> }
#declare Crumb = mesh { #for (I, 0, 11) triangle { <0, 0, 0>, <cos(I), sin(I), 0.3>, <cos(I+1), sin(I+1), -0.3> } #end inside_vector z }
object { Crumb scale 0.7 rotate 20 translate <-5, 0, 3> }
object { Crumb scale <1e-3, 0.9, 0.5> rotate 50*z translate <-4, 0, 3> }
difference { box { -0.7, 0.7 } sphere { <0.5, 0.5, -0.5>, 0.7 } cylinder { -x, x, 0.3 } rotate 25*y translate <-2, 0, 3> }
intersection { sphere { <-0.3, 0, 0>, 0.8 } sphere { <0.3, 0, 0>, 0.8 } plane { y, 0.3 } translate <0, 0, 3> }
merge { sphere { -0.3*x, 0.6 } sphere { 0.3*x, 0.6 } texture { pigment { rgbt <0.8, 1, 0.9, 0.7> } finish { reflection 0.1 } }
	interior { ior 1.4 } translate <2, 0, 3> }
union { torus { 0.6, 0.2 } cone { -0.5*y, 0.4, 0.7*y, 0 } rotate -40*x translate <4, 0, 3> }
// Numbers that are subnormal: lost by whoever takes them for 0.
mesh2 { vertex_vectors { 3, <0, 0, 0>, <1, 0, 1e-310>, <1e-311, 1, 0> } face_indices { 1, <0, 1, 2> } translate <6, 0, 3> }
