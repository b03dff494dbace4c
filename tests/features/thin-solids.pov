// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Cones and cylinders whose radii are all 0 are there and are not seen, and a lathe's curve may lie beyond its
// axis: the Blender add-on writes both (curves without bevel as swept spheres, its own lathe ending at radius
// -4.371e-08).
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -6> look_at <0, 0.4, 0> angle 50 }
light_source { <3, 5, -5> rgb 1 }
#default { pigment { rgb <0.8, 0.5, 0.3> } finish { diffuse 0.8 phong 0.3 } }
cone { <-2, -1, -1>, 0, <2, 1.5, -1>, 0 }
cylinder { <-2, 1.5, -1>, <2, -1, -1>, 0 open }
lathe { bezier_spline 4, <4.371e-08, 1> <0.5, 0.5> <0, 0> <-4.371e-08, -1> translate -1.2 * x }
lathe { linear_spline 4, <-0.01, -0.8>, <0.6, -0.5>, <0.6, 0.4>, <-1e-6, 1> rotate -30 * x translate 1.2 * x }
plane { y, -1 pigment { checker rgb 0.3, rgb 0.7 } }
