// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// area_illumination of a lamp that is a point: it shines on both sides of what it is not hidden from, the
// far one as bright, whatever the second value of diffuse says.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 angle 50 }
light_source { <-1, 2, 3> rgb 1 area_illumination }
plane { y, -1 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }
triangle { <-2, 0, 0>, <0, 0, 0>, <-1, 2, 1> pigment { rgb <1, 0.6, 0.4> } finish { ambient 0 diffuse 1 phong 0.5 } }
triangle { <2, 0, 0>, <0, 0, 0>, <1, 2, 1> pigment { rgb <0.4, 0.6, 1> } finish { ambient 0 diffuse 0.2, 1 } }
