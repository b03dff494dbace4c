// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Gathered rays see mirrors and glass, and what these show of the room: with its own levels, and of
// objects that hide from mirrors or from gathered rays.
#version 3.7;
#include "room.inc"
Room()
Lamp()
sphere { <-0.6, 0.5, 0.3>, 0.5 pigment { rgb 0.1 } finish { reflection { 0.9 } diffuse 0.2 } }
sphere { <0.7, 0.45, 0.3>, 0.45 pigment { rgbf <0.9, 0.95, 0.9, 0.9> } finish { reflection { 0.1 } diffuse 0.1 }
  interior { ior 1.4 } }
box { <-0.3, 0, -0.9>, <0.1, 0.4, -0.5> Matt(<0.9, 0.9, 0.1>) finish { emission 0.6 } no_radiosity }
box { <0.3, 0, -1.1>, <0.7, 0.4, -0.7> Matt(<0.1, 0.2, 0.9>) finish { emission 0.6 } no_reflection }
sphere { <0.2, 1.5, 0.4>, 0.25 pigment { rgb 1 } finish { emission 1.5 } no_image }
