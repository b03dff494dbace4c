// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#version 3.7;
global_settings { assumed_gamma 2.2 ambient_light rgb <0.5, 0.7, 1> }
camera { location <0, 2, -5> look_at <0, 0.7, 0> sky <0.2, 1, 0> right x * 4 / 3 }
light_source { <4, 7, -5> rgb 1.2 }
plane { y, 0 pigment { rgb <0.8, 0.75, 0.6> } }
sphere { <0, 1, 0>, 0.9 pigment { srgb <1, 0.3, 0.2> } finish { ambient 0.3 } }
