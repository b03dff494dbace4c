/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What fills the world besides, up to a wall. */
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <0,2,-7> look_at <0,0.8,0> angle 45 right x*1.3333}
light_source { <4,6,-3> rgb 1.2 }
light_source { <-3,5,0> rgb <0.5,0.8,1.5> spotlight point_at <0,0.5,0> radius 10 falloff 18 }
sphere { 0, 30 hollow pigment { rgb <0.1,0.12,0.2> } }
media { scattering { 2, 0.03 } intervals 3 samples 4 }
plane { y,-0.02 pigment { rgb 0.6 } }
#declare Clear = texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 } }
sphere { <-1.6,0.8,0>, 0.8 texture { Clear } hollow interior { media { absorption <0.3,0.8,1.2> } } }
sphere { 0, 0.8 texture { Clear } hollow interior { media { emission <0.6,0.3,0.1> density { spherical color_map { [0 rgb 0][1 rgb <1,1,0.5>*2] } } } } translate <0,0.8,0> }
sphere { 0, 0.8 texture { Clear } hollow interior { media { scattering { 1, <0.5,0.6,0.9> } } } translate <1.6,0.8,0> }
box { -0.5,0.5 texture { Clear } hollow interior { ior 1.3 media { scattering { 5, 0.7 eccentricity 0.4 extinction 0.8 } absorption 0.2 method 2 samples 3 intervals 4 density { cylindrical rotate 90*x color_map { [0 rgb <.83,.45,.35>][0.5 rgb <.8,.8,.4>][1 rgb 1] } scale 0.8 } } } rotate 30*y translate <0.2,0.6,-2> }
