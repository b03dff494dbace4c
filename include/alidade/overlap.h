/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * alidade/overlap.h - does a triangle touch a closed box? For building structures.
 *
 * Included by alidade/kernel.h, which is what plugins include.
 * Akenine-Moeller: Fast 3D Triangle-Box Overlap Testing, 2001.
 */
#ifndef ALIDADE_OVERLAP_H
#define ALIDADE_OVERLAP_H

#include "kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Is the axis (x, y, z) surely separating corners q (relative to the box's centre) from half sizes h? */
ALD_INLINE int ald_separates(double x, double y, double z, const double q[3][3], const double h[3])
{
	double reach = h[0] * fabs(x) + h[1] * fabs(y) + h[2] * fabs(z);
	double lo = ALD_INF, hi = -ALD_INF, size = reach;

	for (unsigned k = 0; k < 3; k++) {
		double s = q[k][0] * x + q[k][1] * y + q[k][2] * z;

		size += fabs(q[k][0] * x) + fabs(q[k][1] * y) + fabs(q[k][2] * z);
		lo = ald_min(s, lo);
		hi = ald_max(s, hi);
	}
	size *= 16 * ALD_U;
	return lo > reach + size || hi < -reach - size;
}

/* 0 only if they surely have no point in common, by the 13 axes; rounding errs towards 1, by some 16
 * roundoffs of the sizes met. */
ALD_INLINE int ald_triangle_box(const ald_vec v[3], const ald_box *b)
{
	double cx = b->lo.x + (b->hi.x - b->lo.x) / 2, cy = b->lo.y + (b->hi.y - b->lo.y) / 2;
	double cz = b->lo.z + (b->hi.z - b->lo.z) / 2;
	double far = fabs(cx) + fabs(cy) + fabs(cz);
	double h[3], q[3][3], e[3][3];

	/* Moving to the centre rounds: half sizes grow by that. */
	for (unsigned k = 0; k < 3; k++) {
		q[k][0] = v[k].x - cx, q[k][1] = v[k].y - cy, q[k][2] = v[k].z - cz;
		far = ald_max(fabs(v[k].x) + fabs(v[k].y) + fabs(v[k].z), far);
	}
	far *= 8 * ALD_U;
	h[0] = ald_max(b->hi.x - cx, cx - b->lo.x) + far;
	h[1] = ald_max(b->hi.y - cy, cy - b->lo.y) + far;
	h[2] = ald_max(b->hi.z - cz, cz - b->lo.z) + far;
	if (ald_separates(1, 0, 0, q, h) || ald_separates(0, 1, 0, q, h) ||
	    ald_separates(0, 0, 1, q, h))
		return 0;
	for (unsigned k = 0; k < 3; k++) {
		unsigned n = k == 2 ? 0 : k + 1;

		for (unsigned j = 0; j < 3; j++)
			e[k][j] = q[n][j] - q[k][j];
		if (ald_separates(0, -e[k][2], e[k][1], q, h) ||
		    ald_separates(e[k][2], 0, -e[k][0], q, h) ||
		    ald_separates(-e[k][1], e[k][0], 0, q, h))
			return 0;
	}
	return !ald_separates(e[0][1] * e[1][2] - e[0][2] * e[1][1],
			      e[0][2] * e[1][0] - e[0][0] * e[1][2],
			      e[0][0] * e[1][1] - e[0][1] * e[1][0], q, h);
}

#ifdef __cplusplus
}
#endif
#endif
