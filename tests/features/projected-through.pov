// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Lights that are projected through things shine only where those are between, and only what is nearer than they are
// casts shadows, be the things themselves in the scene or not. The light's later transforms move them.
#declare No_lamp = 1;
#include "stage.inc"
fog { distance 60 rgb <0.4, 0.4, 0.5> }
#declare Ring = torus { 0.8, 0.2 rotate <70, 20, 0> }
light_source { <-2, 6, -5> rgb <1, 0.8, 0.6> projected_through { Ring translate <-1.2, 2, -1> } }
object { Ring translate <-1.2, 2, -1> pigment { rgb <0.8, 0.3, 0.2> } no_image }
sphere { <-1.3, 2.9, -2>, 0.4 no_image } // farther: casts none
light_source { <0, 6, -2> rgb <0.2, 0.5, 1> area_light x, z, 3, 3 adaptive 0 projected_through { box { <-0.6, 2.5, -0.6>, <0.6, 3, 0.6> } rotate y * 30 } translate <1.3, 0, 0> }
light_source { <3, 3, -8> rgb 0.25 shadowless projected_through { plane { z, -4 } } }
light_source { <0, 0, 0> rgb 0.1 parallel point_at <0, -1, 0.5> projected_through { sphere { <0, -2, 1>, 1 } } translate <0, 7, 0> }
sphere { <-0.6, 0.5, 0>, 0.5 pigment { rgb 0.9 } finish { specular 0.5 } }
sphere { <1.2, 0.6, 0>, 0.6 pigment { rgbf <0.9, 0.5, 0.5, 0.7> } interior { ior 1.3 } }
box { <-3.5, 0, 1.8>, <3.5, 2.5, 2> pigment { rgb 0.7 } }
