// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Glass, mirrors and a soft lamp: all at once, and a gamma.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <0, 1.2, -4> direction 1.1*z right 4/3*x up y aperture 0.1 focal_point <0, 0.7, 0> blur_samples 16 }
light_source { <-3, 5, -3> rgb 1 area_light 2*x, 2*z, 3, 3 jitter adaptive 0 }
plane { y, 0 pigment { checker rgb 0.8, rgb <0.3, 0.2, 0.2> } finish { ambient 0.05 diffuse 0.8 } }
sphere { <-0.6, 0.7, 0>, 0.7 pigment { rgbf <1, 1, 1, 0.9> } 
	finish { ambient 0 diffuse 0.1 reflection { 0.02, 1 fresnel } conserve_energy } interior { ior 1.5 } }
sphere { <0.9, 0.6, 0.6>, 0.6 pigment { rgb <0.8, 0.7, 0.4> } finish { ambient 0 diffuse 0.2 reflection 0.6 } }
background { rgb <0.3, 0.4, 0.6> }
