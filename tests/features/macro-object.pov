/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A macro whose last word is what it has just declared, without a ; between: as Blender writes Bezier curves. */
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5*z look_at 0 }
light_source { <4,6,-8> rgb 1 }
#macro M(_m)
  #local mock = #if (_m) merge { #else union { #end sphere { 0,1 } box { 0,1.2 } }
  mock
#end
object { M(1) pigment { rgb <1,.5,.2> } }
