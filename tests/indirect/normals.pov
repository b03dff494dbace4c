// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// With normal on, light is gathered around a layer's bent normal, but from no direction below the surface.
#version 3.7;
#macro Block() normal on #end
#include "room.inc"
Room()
Lamp()
sphere { <-0.6, 0.5, 0.3>, 0.5 Matt(<0.8, 0.7, 0.3>) normal { gradient y 2 slope_map { [0 <0, 1>] [1 <1, 1>] } scale 0.25 } }
plane { y, 0.01 Matt(<0.8, 0.7, 0.6>) normal { gradient x 1 slope_map { [0 <0, 1>] [1 <1, 1>] } scale 0.6 } }
