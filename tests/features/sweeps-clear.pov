// SPDX-FileCopyrightText: 2026 The Alidade authors
// SPDX-License-Identifier: Apache-2.0
//
// Clear sweeps along curves show pieces of surfaces inside (every surface takes half of the light that is
// left): those that remain of a count of balls and discs that is not quite that of a solid's surfaces, and
// starts anew with every ray.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 30 }
camera { orthographic location <0, 0, -5> right 4 * x up 3 * y direction z }
#default { pigment { rgbt <1, 0.8, 0.6, 0.5> } finish { ambient 0 diffuse 0 emission 1 } }
sphere_sweep {
	b_spline 6, <-1.8, -1.2, 0>, 0.3, <-1.8, -1.2, 0>, 0.3, <-1.8, -1.2, 0>, 0.3, <-0.8, 0, 0.5>, 0.25,
		<0.2, 0.5, -0.5>, 0.2, <0, 1.2, 1>, 0.15
}
sphere_sweep {
	cubic_spline 6, <0.2, -1.2, 0>, 0.3, <0.5, -1.2, 0>, 0.3, <1.8, -0.9, 1>, 0.25, <1.1, 0, 0.5>, 0.1,
		<1.3, 0.5, -0.5>, 0.2, <1, 1, 1>, 0.15
}
