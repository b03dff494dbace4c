/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifndef TESTS_BENCH_DIRECTIONS_H
#define TESTS_BENCH_DIRECTIONS_H

#include <math.h>

#include "../unit/rays.h"

static inline ald_vec cross(ald_vec a, ald_vec b)
{
	return (ald_vec){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline double dot(ald_vec a, ald_vec b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline ald_vec minus(ald_vec a, ald_vec b)
{
	return (ald_vec){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline ald_vec times(ald_vec a, double s)
{
	return (ald_vec){ a.x * s, a.y * s, a.z * s };
}

static inline ald_vec unit(ald_vec a)
{
	return times(a, 1 / sqrt(dot(a, a)));
}

static inline ald_vec any_way(uint64_t *seed)
{
	for (;;) {
		ald_vec v = { 2 * random_unit(seed) - 1, 2 * random_unit(seed) - 1,
			      2 * random_unit(seed) - 1 };
		double d = dot(v, v);

		if (d > 0.01 && d < 1)
			return unit(v);
	}
}

#endif
