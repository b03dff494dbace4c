// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// What fills the world takes from the light of lamps that ask for it, and not from that of others.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <1, 2, -7> look_at <0, 0.8, 0> angle 50 right x*4/3 }
media { scattering { 1, 0.04 } absorption <0.05, 0.02, 0> intervals 2 samples 4 }
light_source { <4, 6, -3> rgb <1.5, 1, 0.7> media_attenuation on }
light_source { <-3, 5, 0> rgb <0.5, 0.8, 1.5>*1.5 spotlight point_at <0, 0.5, 0> radius 10 falloff 18 media_attenuation on }
light_source { <-6, 3, -3> rgb 0.3 }
sphere { 0, 30 hollow pigment { rgb <0.1, 0.12, 0.2> } }
plane { y, -0.02 pigment { rgb 0.6 } }
sphere { <-1.6, 0.8, 0>, 0.8 pigment { rgbf <0.9, 0.5, 0.4, 0.7> } hollow interior { media { absorption <0.3, 0.8, 1.2> } } }
sphere { <1.2, 0.8, 0>, 0.8 pigment { rgb 0.7 } }
