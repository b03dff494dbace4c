// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers share what the first that is worth it gathers; light of the far side; thin things through which
// light falls; a part too dark to be worth it.
#version 3.7;
#declare Recursion = 2;
#macro Block() adc_bailout 0.02 #end
#include "room.inc"
Room()
Lamp()
sphere { <-0.6, 0.5, 0.3>, 0.5
  texture { pigment { rgb <0.8, 0.7, 0.3> } finish { diffuse 0.8 } }
  texture { pigment { rgbt <0.2, 0.3, 0.9, 0.6> } finish { diffuse 0.6 } }
  texture { pigment { rgbt <0.005, 0.005, 0.005, 0.5> } finish { diffuse 0.6 } } }
mesh { triangle { <0.2, 0, 0.2>, <1.2, 0, -0.2>, <0.7, 1.3, 0.1> }
  pigment { rgb <0.9, 0.8, 0.7> } finish { diffuse 0.4, 0.5 } }
box { <-0.3, 0, -0.9>, <0.1, 0.4, -0.5> pigment { rgb <0.002, 0.004, 0.003> } finish { diffuse 0.8 } }
