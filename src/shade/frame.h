/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A frame around a normal (Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017).
 */
#ifndef ALIDADE_SHADE_FRAME_H
#define ALIDADE_SHADE_FRAME_H

#include "base/vec.h"

/* The vector whose coordinates are x and y along the surface and z along its unit normal. */
static inline vec frame_around(vec n, double x, double y, double z)
{
	double sign = copysign(1, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
	vec s = { 1 + sign * n.x * n.x * a, sign * b, -sign * n.x };
	vec t = { b, sign + n.y * n.y * a, -n.y };

	return vec_mad(vec_mad(vec_scale(n, z), s, x), t, y);
}

#endif
