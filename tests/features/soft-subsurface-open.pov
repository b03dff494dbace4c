// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces that enclose nothing are brighter by the rays that find nothing; area lamps are points but for their shadows,
// and cones and fading count where light comes in.
#version 3.7;
global_settings { assumed_gamma 1 mm_per_unit 10 subsurface { samples 400, 25 } }
camera { location <0, 1.5, -5> look_at 0 angle 40 }
background { rgb <0.05, 0.1, 0.2> }
light_source {
	<-3, 4, -5> rgb <1.6, 2, 1.8>
	area_light 3 * x, 3 * z, 3, 3
	area_illumination
	spotlight point_at 0 radius 8 falloff 14 fade_distance 6 fade_power 2
}
plane { y, -0.8 pigment { rgb <0.8, 0.5, 0.3> } finish { ambient 0 diffuse 0.8 subsurface { translucency 3 } } }
disc {
	<-0.8, 0, 0>, <0.3, 0.4, -1>, 0.5
	pigment { rgb <0.8, 0.7, 0.6> }
	finish { ambient 0 diffuse 0.8 subsurface { translucency 3 } }
	interior { ior 1.2 }
}
sphere { <-0.6, 1, -1>, 0.2 pigment { rgb 1 } }
sphere {
	<0.7, 0, 0>, 0.5
	pigment { rgb <0.8, 0.7, 0.6> }
	finish { ambient 0 diffuse 0.8 subsurface { translucency 3 } }
	interior { ior 1.2 }
}
