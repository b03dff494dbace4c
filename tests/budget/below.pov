// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Light below a surface, beside a soft shadow and a glowing thing whose light is gathered.
#version 3.7;
global_settings { assumed_gamma 1 mm_per_unit 10
	subsurface { samples 50, 5 } radiosity { recursion_limit 1 subsurface on } }
camera { location <0, 1.2, -3> direction z right 4/3*x up y }
light_source { <2, 4, -2> rgb 0.8 area_light 0.8*x, 0.8*z, 2, 2 jitter }
plane { y, 0 pigment { rgb 0.6 } finish { ambient 0 diffuse 0.8 } }
sphere { <-0.5, 0.7, 0.2>, 0.7 pigment { rgb <0.9, 0.8, 0.7> } 
	finish { ambient 0 diffuse 0.7 subsurface { translucency <1, 0.6, 0.4> } } interior { ior 1.4 } }
sphere { <1.2, 0.8, 0.6>, 0.5 pigment { rgb 1 } finish { ambient 0 diffuse 0 emission <1.6, 1.2, 0.8> } }
