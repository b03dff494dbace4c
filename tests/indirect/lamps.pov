// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// To gathered rays an area light is a point, and a lamp that casts no highlights lights as others do.
#version 3.7;
#include "room.inc"
Room()
light_source { <0.6, 1.8, -0.6> rgb 0.5 area_light 1.2*x, 1.2*z, 9, 9 }
light_source { <-0.8, 1.5, -1> rgb 0.2 shadowless }
sphere { <-0.6, 0.5, 0.3>, 0.5 Matt(<0.8, 0.7, 0.3>) double_illuminate }
box { <-0.4, 0, -0.4>, <0.4, 1.3, 0.4> rotate 25*y translate <0.65, 0, 0.2> Matt(<0.4, 0.5, 0.8>) }
