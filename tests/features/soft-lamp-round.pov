// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// A jittered, circular, turned area light, all its points asked.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#default { finish { ambient 0.05 diffuse 0.7 } }
background { rgb <0.2, 0.3, 0.5> }
camera { location <0, 2.2, -6> look_at <0, 0.8, 0> right x * 4 / 3 up y angle 40 }
plane { y, 0 pigment { rgb <0.8, 0.75, 0.6> } }
sphere { <-1.2, 1, 0>, 0.8 pigment { rgb <0.9, 0.3, 0.2> } finish { phong 0.5 } }
box { <0.5, 0, -0.5>, <1.3, 1.6, 0.3> pigment { rgb <0.3, 0.8, 0.3> } rotate y * 20 }
cylinder { <0, 0, 1.5>, <0, 2, 1.5>, 0.1 pigment { rgb <0.3, 0.3, 0.8> } }
sphere { <0.2, 0.3, -1.5>, 0.3 pigment { rgbf <0.9, 0.6, 0.3, 0.8> } }
light_source { <4, 5, -3> rgb 1 area_light <2, 0, 0>, <0, 0, 2>, 5, 5 jitter circular orient }
