// Functions as patterns: of coordinates, of pigments and patterns, of transforms and splines, with waves and
// maps; values outside of 0 to 1 wrap around.
// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#version 3.7;
global_settings { assumed_gamma 1 }
#include "functions.inc"
camera { orthographic location <0, 0, -10> right 8*x up 6*y look_at 0 }
#default { finish { ambient 1 diffuse 0 } }
#declare Pig = function { pigment { bozo color_map { [0 rgb <1, 0.2, 0>] [1 rgb <0, 0.4, 1>] } scale 0.5 } }
#declare Wood = function { pattern { wood turbulence 0.2 scale 0.4 } }
#declare Bend = function (a, b) { sin(a * 4) * 0.5 + b * b }
#declare Move = function { transform { rotate z*30 scale 2 } }
#declare Path = function { spline { natural_spline 0, <0, 1> 1, <1, 0> 2, <0.3, 0.7> 3, <1, 0> } }
#declare Row = function { sum(i, 1, 4, sin(i * i * x) / i) + prod(k, 1, 3, cos(k * y)) }
#declare Tile = box { <-0.95, -0.95, 0>, <0.95, 0.95, 0.1> }
#macro At(I, J) translate <I * 2 - 3, J * 2 - 2, 0> #end
#macro Fire() color_map { [0 rgb 0] [0.5 rgb <1, 0.5, 0>] [1 rgb 1] } #end
object { Tile pigment { function { x * x + y * y } Fire() } At(0, 0) }
object { Tile pigment { function { Bend(x + f_sphere(x, y, z, 0.5), y) } triangle_wave Fire() } At(1, 0) }
object { Tile pigment { function { Pig(x, y, z).blue } color_map { [0 rgb 0] [1 rgb 1] } } At(2, 0) }
object { Tile pigment { function { Wood(y, x, z) } frequency 2 phase 0.3 Fire() } At(3, 0) }
object { Tile pigment { function { abs(Move(x, y, z).y - Move(x, y, z).x) } sine_wave color_map { [0 rgb x] [1 rgb z] } } At(0, 1) }
object { Tile pigment { function { Path(x + 1).x * Path(y + 1).y } turbulence 0.1 Fire() } At(1, 1) }
object { Tile pigment { function { Row(x, y, z) } scale 0.5 Fire() } At(2, 1) }
object { Tile pigment { function { f_ridged_mf(x * 2, y * 2, z, 0.4, 2, 4, 0.9, 0.8, 2) } Fire() } At(3, 1) }
object { Tile pigment { function { select(x - y, x * x, 0.5, 1 - y * 2) } Fire() } At(0, 2) }
object { Tile pigment { function { min(mod(x * 4, 1), max(f_torus(x, z, y, 0.5, 0.2), 0.1)) } cubic_wave Fire() } At(1, 2) }
object { Tile pigment { function { Pig(x, y, z).gray * (x > 0 & y < 0.5 | x < -0.5) } scallop_wave Fire() } At(2, 2) }
object { Tile pigment { function { f_noise3d(x * 4, y * 4, z) + atan2(y, x) / pi } poly_wave 2 Fire() } At(3, 2) }
