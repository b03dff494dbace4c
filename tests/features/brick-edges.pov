// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Faces that lie just where mortar begins or ends.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 1 diffuse 0 } }
camera { orthographic location <0, 0, -8> look_at 0 right 8*x up 6*y }
box { -1, 1 scale 0.75 pigment { brick scale 0.1 } rotate <-30, 30, 0> translate <-2, 1.5, 0> }
box { -1, 1 pigment { brick mortar 0.25 brick_size <2, 1, 1> scale 0.5 } rotate <-30, 30, 0> translate <2, 1.5, 0> }
box { -1, 1 pigment { brick scale 0.25 } rotate <-30, 120, 0> translate <-2, -1.5, 0> }
box { -0.8, 0.8 pigment { brick scale 0.1 } rotate <60, 30, 0> translate <2, -1.5, 0> }
