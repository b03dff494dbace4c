// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Indirect light, a lens, a soft spotlight, a mirror and fog together, from solids cut out of each other.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { recursion_limit 2 } }
camera { location <0, 1.3, -3.4> direction 1.1*z right 4/3*x up y aperture 0.15 focal_point <0, 0.6, 0> blur_samples 16 }
light_source { <1.5, 3, -2> rgb 1.2 spotlight point_at <0, 0, 0> radius 25 falloff 35
	area_light 0.6*x, 0.6*z, 2, 2 jitter }
plane { y, 0 pigment { checker rgb 0.8, rgb <0.7, 0.4, 0.3> } finish { ambient 0 diffuse 0.8 } }
plane { z, 3 pigment { rgb <0.5, 0.6, 0.7> } finish { ambient 0 diffuse 0.8 } }
difference {
	box { <-1, 0, -0.4>, <0.2, 1.2, 0.8> }
	cylinder { <-0.4, 0.6, -1>, <-0.4, 0.6, 1>, 0.4 }
	pigment { rgb <0.9, 0.8, 0.4> } finish { ambient 0 diffuse 0.8 }
}
sphere { <0.9, 0.5, 0.3>, 0.5 pigment { rgb 0.9 } finish { ambient 0 diffuse 0.2 reflection 0.6 } }
background { rgb <0.3, 0.4, 0.5> }
fog { distance 12 rgb <0.4, 0.45, 0.5> }
