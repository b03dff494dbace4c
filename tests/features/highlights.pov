// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
#include "stage.inc"
sphere { <-1.6, 1, 0>, 0.9 pigment { rgb <0.6, 0.1, 0.1> } finish { phong 0.8 phong_size 20 } }
sphere { <0.3, 1, 0>, 0.9 pigment { rgb <0.7, 0.5, 0.1> } finish { specular 0.6 roughness 0.02 metallic } }
sphere { <2.1, 1, 0>, 0.9 pigment { rgb <0.1, 0.4, 0.6> } finish { phong 1 phong_size 90 metallic 0.5 diffuse 0.3 } }
