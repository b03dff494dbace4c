// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// The interior's index: none (1), low, high, and in between. Millimetres are what the settings say.
#version 3.7;
global_settings { assumed_gamma 1 mm_per_unit 25 subsurface { samples 100, 25 } }
camera { location <0, 1, -5> look_at 0 angle 40 }
background { rgb <0.05, 0.1, 0.2> }
light_source { <-3, 4, -5> rgb <0.8, 1, 0.9> }
light_source { <2, 3, 6> rgb 1 }
plane { y, -0.8 pigment { rgb 0.5 } }
#declare Wax = texture {
	pigment { rgb <0.8, 0.5, 0.3> }
	finish { ambient 0 diffuse 0.8 subsurface { translucency <8, 6, 4> } }
}
sphere { <-1.2, 0, 0>, 0.4 texture { Wax } }
sphere { <-0.4, 0, 0>, 0.4 texture { Wax } interior { ior 1.2 } }
sphere { <0.4, 0, 0>, 0.4 texture { Wax } interior { ior 2.2 } }
sphere { <1.2, 0, 0>, 0.4 texture { Wax } interior { ior 1.6 } }
