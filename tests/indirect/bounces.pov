// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Two bounces; light of lamps, of a surface that glows and of the background; ambient counts no more, and
// highlights are not gathered.
#version 3.7;
#declare Recursion = 2;
#include "room.inc"
Room()
Lamp()
sphere { <-0.6, 0.5, 0.3>, 0.5 Matt(<0.8, 0.7, 0.3>) }
box { <-0.4, 0, -0.4>, <0.4, 0.9, 0.4> rotate 25*y translate <0.65, 0, 0.2>
  pigment { rgb <0.4, 0.5, 0.8> } finish { diffuse 0.5 phong 2 phong_size 5 specular 1 roughness 0.1 } }
sphere { <0.1, 0.2, -0.7>, 0.2 pigment { rgb 1 } finish { emission <2, 1.5, 0.6> diffuse 0 ambient 9 } }
