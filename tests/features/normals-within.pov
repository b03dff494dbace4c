// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// no_bump_scale goes for the transforms of its own normal, not for those of a pattern of textures around it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,3,-6> look_at 0 angle 50 }
light_source { <5,10,-10> rgb 1 }
sphere { <-1.6,0,0>, 1.1 texture { gradient x texture_map { [0 pigment { rgb 1 } normal { bumps .5 no_bump_scale scale .2 } scale .7 ] [1 pigment { rgb x } normal { quilted .6 no_bump_scale scale .4} ] } scale .4 rotate z*30 } scale 1.1 }
sphere { <1.6,0,0>, 1.1 texture { pigment { rgb 1 } normal { bumps .5 no_bump_scale scale .2 } scale .3 } rotate y*20 scale 1.1 }
