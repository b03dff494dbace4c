// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Functions as heights, the way the stock Blender add-on writes procedural textures: a pigment, a function of
// it, and its grey; noise functions and vturbulence(); a normal asked at (u, v, 0).
#include "functions.inc"
#include "stage.inc"
#declare PAT_Clouds = pigment { wrinkles scale 0.25 color_map { [0 color rgbt <0, 0, 0, 1>] [1 color rgbt <1, 1, 1, 0>] } }
#declare fPAT_Clouds = function { pigment { PAT_Clouds } }
#declare PAT_Noise = pigment { average pigment_map {
	[1 bozo scale 0.25 turbulence 0.7 color_map { [0 color rgbt <1, 1, 1, 0>] [1 color rgbf <0, 0, 0, 1>] }]
	[1 crackle metric 2.5 scale 0.25 turbulence 0.35 color_map { [0 color rgbt <1, 1, 1, 0>] [1 color rgbf <0, 0, 0, 1>] }] } }
#declare fPAT_Noise = function { pigment { PAT_Noise } }
#declare Shift = vturbulence(2.2, 0.6, 5, <0.3, 1.2, -4.5>);
#default { pigment { rgb <0.7, 0.75, 0.9> } finish { specular 0.4 } }
sphere { <-1.6, 1.1, 0>, 0.7 normal { function { fPAT_Clouds(x, y, z).grey } bump_size -2.85 scale <1, 1, 1> } }
sphere { <0, 1.1, 0>, 0.7 normal { function { fPAT_Noise(x, y, z).grey } bump_size -1.5 scale <0.5, 0.5, 1> translate 0.2 } }
sphere { <1.6, 1.1, 0>, 0.7 normal { function { f_noise3d(7 * x, 7 * y, 7 * z) + f_noise_generator(3 * x, y, z, 3) } 0.6 } }
sphere { <-0.8, 2.2, 0>, 0.4 normal { uv_mapping bumps 0.7 scale 0.05 } }
sphere { <0.8, 2.2, 0>, 0.4 normal { uv_mapping gradient x normal_map { [0 uv_mapping ripples 0.7 frequency 30] [1 dents 2 scale 0.05] } } }
sphere { <Shift.x, 0.3, -1.5>, 0.3 normal { average normal_map { [0.025 bumps 12 scale 0.1 * 0.04] [0.025 bumps 12 scale 0.1 * 0.04 phase 0.1] [1 bumps 0.2 scale 0.1] } } }
