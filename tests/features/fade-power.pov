// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// What is seen through an interior with a fade_distance fades whatever its fade_power is: none and 0 give a
// half, negative ones less near than far. Its shadow fades only for a positive one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 20, 0> look_at 0 right 10*x up 7.5*y }
light_source { <-20, 20, -3>, 1 }
plane { y, -1.5 pigment { rgb 1 } finish { ambient 0.2 diffuse 0.6 } }
sphere {
	<-3, 0, 1.5>, 1 pigment { rgbf <1, 1, 1, 0.7> } finish { ambient 0 diffuse 0 }
	interior { ior 1.1 fade_distance 1.5 fade_color rgb <0.4, 0.2, 0> }
}
sphere {
	<1, 0, 1.5>, 1 pigment { rgbf <1, 1, 1, 0.7> } finish { ambient 0 diffuse 0 }
	interior { ior 1.1 fade_distance 1.5 fade_power 0 fade_color rgb <0.4, 0.2, 0> }
}
sphere {
	<-3, 0, -1.5>, 1 pigment { rgbf <1, 1, 1, 0.7> } finish { ambient 0 diffuse 0 }
	interior { ior 1.1 fade_distance 1.5 fade_power 1 fade_color rgb <0.4, 0.2, 0> }
}
sphere {
	<1, 0, -1.5>, 1 pigment { rgbf <1, 1, 1, 0.7> } finish { ambient 0 diffuse 0 }
	interior { ior 1.1 fade_distance 1.5 fade_power -1 fade_color rgb <0.4, 0.2, 0> }
}
