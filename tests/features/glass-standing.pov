// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Glass that stands on a floor, without a gap: of two surfaces that are met at the same place the plane
// counts. And the camera lies in a wall of the room, which it does not see.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 10 }
camera { location <0.5, 4, -5> look_at <0, 0.2, 0> right 4/3*x }
light_source { <-4, 6, -3>, 1 }
box { <-6, -1, -5>, <6, 8, 5> pigment { rgb <0.6, 0.7, 1> } finish { ambient 0.3 } hollow }
plane { y, 0 pigment { checker rgb 1 rgb <1, 0.2, 0> scale 0.4 } finish { ambient 0.2 } }
#declare Glass = texture { pigment { rgbf <0.9, 1, 0.9, 0.8> } finish { ambient 0 diffuse 0.1 } }
box { -1, 1 texture { Glass } interior { ior 1.3 } translate <-1.3, 1, 0> }
box { <-1, -0.3, -0.8>, <0.8, 0.7, 0.8> texture { Glass } interior { ior 1.5 } scale 0.7 rotate -25*y translate <1.7, 0.21, -1> }
