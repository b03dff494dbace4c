// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Gathered rays look through fog as if it were not there, unless the block says media on.
#version 3.7;
#include "room.inc"
Room()
Lamp()
fog { distance 4 rgb <0.8, 0.5, 0.2> }
sphere { <-0.6, 0.5, 0.3>, 0.5 Matt(<0.8, 0.7, 0.3>) }
