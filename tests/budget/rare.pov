// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Light that comes seldom: small bright things, of which most pixels that have a part have a small one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> direction z right 4/3*x up y }
plane { -z, -4 pigment { rgb 0.02 } finish { ambient 1 diffuse 0 } }
#declare S = seed(3);
#declare I = 0;
#while (I < 40)
	sphere { <4*rand(S) - 2, 3*rand(S) - 1.5, 1.4*rand(S)>, 0.012 pigment { rgb 1 + 6*rand(S) }
		finish { ambient 1 diffuse 0 } }
	#declare I = I + 1;
#end
