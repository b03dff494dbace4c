/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Refraction and total reflection by bent normals, some of which look away from the ray. */
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 5 }
camera { location <0,0,-4> look_at 0 right x*1.333 angle 35}
light_source { <4,6,-8> rgb 1 }
plane { z,2 pigment { checker rgb 1 rgb <.3,.4,.7> scale 0.7 } }
plane { -z, 6 pigment { checker rgb <1,.8,.3> rgb <.3,.4,.7> scale 0.7 } }
sphere { 0,1 pigment { rgbf <1,1,1,.8> } normal { bumps 3 scale .3 } interior { ior 1.4 } finish { diffuse .6,.3 } }
