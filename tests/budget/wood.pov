// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Patterns and bumps finer than a pixel, highlights, and grain that is random by itself.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.2, -3> direction z right 4/3*x up y }
light_source { <2, 5, -3> rgb 1 }
plane { y, 0 pigment { wood turbulence 0.2 
		color_map { [0 rgb <0.5, 0.3, 0.1>] [1 rgb <0.9, 0.7, 0.4>] } scale 0.06 rotate 80*x }
	finish { ambient 0.05 diffuse 0.7 } }
sphere { <-0.6, 0.7, 0>, 0.7 pigment { rgb <0.3, 0.5, 0.8> } normal { bumps 0.6 scale 0.03 }
	finish { ambient 0.1 diffuse 0.6 specular 0.6 roughness 0.02 } }
sphere { <0.8, 0.6, 0.5>, 0.6 pigment { rgb 0.7 } finish { ambient 0.1 diffuse 0.6 crand 0.3 } }
