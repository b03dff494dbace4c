// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// brightness and gray_threshold act at each bounce; diffuse albedo does not raise indirect light; an object's
// importance changes nothing.
#version 3.7;
#declare Recursion = 2;
#macro Block() brightness 1.5 gray_threshold 0.6 #end
#include "room.inc"
Room()
Lamp()
sphere { <-0.6, 0.5, 0.3>, 0.5 pigment { rgb <0.8, 0.7, 0.3> } finish { diffuse albedo 0.7 brilliance 3 } }
box { <-0.4, 0, -0.4>, <0.4, 0.9, 0.4> rotate 25*y translate <0.65, 0, 0.2> Matt(<0.4, 0.5, 0.8>)
  radiosity { importance 0.4 } }
