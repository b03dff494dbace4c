// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Nothing that is gathered is brighter than max_sample, in its brightest channel.
#version 3.7;
#macro Block() max_sample 0.7 #end
#include "room.inc"
Room()
Lamp()
sphere { <-0.6, 0.5, 0.3>, 0.5 Matt(<0.8, 0.7, 0.3>) }
sphere { <0.5, 0.5, -0.3>, 0.4 pigment { rgb 1 } finish { emission <3, 1.5, 0.6> diffuse 0 } }
