// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <3, 4, -5> look_at <0, 0.5, 0> right x * 16 / 3 up y * 4 }
light_source { <4, 7, -5> rgb 1 }
plane { y, 0 pigment { rgb 0.7 } }
box { <-1, 0, -1>, <1, 1, 1> pigment { rgb <0.8, 0.4, 0.3> } rotate y * 20 }
sphere { <0, 1.5, 0>, 0.5 pigment { rgb <0.2, 0.4, 0.8> } }
