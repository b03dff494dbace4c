// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// area_illumination: to gathered rays such a lamp is a point that shines on both sides of a sheet, so that
// what is below is lit by it.
#version 3.7;
#include "room.inc"
Room()
light_source { <0.1, 1.9, -0.2> rgb 0.5 area_light 0.2*x, 0.2*z, 2, 2 area_illumination }
union {
	triangle { <-0.8, 1, -0.9>, <0.7, 1, -0.9>, <0.7, 1, 0.7> }
	triangle { <-0.8, 1, -0.9>, <0.7, 1, 0.7>, <-0.8, 1, 0.7> }
	Matt(<0.4, 0.6, 1>)
}
