/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Which lines surely miss which triangles: many lines against sixteen triangles, in floats.
 *
 * Everything is in coordinates of its own: X = (x - centre) * scale, scale a power of two, so that all
 * triangles lie within [-1, 1]. A line has a direction d, of components up to 1 and 1 along its main axis, and
 * a moment m = o x d about 0 (Pluecker). Of a triangle a, b, c the line passes on the same side of all edges,
 * or misses: the weights are
 *	w_b = d . (c x a) + m . (a - c),  w_c = d . (a x b) + m . (b - a),  w_a = d . n - (w_b + w_c)
 * with n = a x b + b x c + c x a. That is 14 multiplications and additions, as d's main component costs none;
 * Havel and Herout's planes (Yet Faster Ray-Triangle Intersection, 2010) are 17. If all lines pass through one
 * point, which is then where moments are taken, there are no terms of m, and 6 are left (Kensler and
 * Shirley: Optimizing Ray-Triangle Intersection via Automated Search, 2006).
 *
 * A triangle's numbers are scaled by a power of two until its longest difference between corners is in
 * (1/2, 1], which changes no sign; so one bound on rounding, the line's, serves all triangles. With u = 2^-24
 * the roundoff of floats, M the largest component of m:
 * - stored differences are off by u, products (up to 2, as a x b = a x (b - a)) and n by 2 u, d by u, m by u M;
 * - d . n: from these 10 u, and 14 u by rounding; w_b: 10 u + 6 M u, and by rounding, without any fma,
 *   (20 + 15 M) u; so w_a, with three additions more, is off by less than (102 + 51 M) u: LINE_ERROR.
 * Through a point P, of components up to R: w_b's product becomes c x a + (a - c) x P, off by (10 R + 4) u, and
 * w_a's, n less the two, by (26 R + 16) u; then the weights are off by less than (96 R + 66) u: POINT_ERROR.
 * Lines may pass the point at a distance: what their moments about it are, times 4.
 * What the doubles err, from which all this is made, is less than 2^-44 of the line's origin's distance.
 *
 * So if one weight is less than -e and another more than e, the line surely misses; all else has to be decided
 * by alidade/kernel.h (R1). Comparisons are such that a bound of infinity or a NaN rejects nothing.
 */
#ifndef LINES_H
#define LINES_H

#include <alidade/kernel.h>

#define GROUP 16u /* triangles of a block */
#define LINE_ERROR(m) ((112 + 56 * (m)) * 0x1p-24)
#define POINT_ERROR(r) ((72 + 104 * (r)) * 0x1p-24)
#define POINT_FAR 64 /* R, from where on the other way is better */

struct space { /* to X */
	double centre[3], scale;
	int usable; /* 0: the scene's numbers are such that floats can't serve */
};

/* 64-aligned. Rows: n, c x a, a x b, a - c, b - a, by axis. */
enum { ROW_N = 0, ROW_B = 3, ROW_C = 6, ROW_DB = 9, ROW_DC = 12, ROWS = 15 };
struct group {
	float row[ROWS][GROUP];
};

struct line {
	float shear[2], m[3]; /* along kx, ky, kz; d is (shear, 1) */
	float least, most; /* -e and e */
	uint32_t ray;
};

static inline __attribute__((unused)) void space_of(const ald_box *all, double pad, struct space *s)
{
	double half = 0;
	int power;

	for (unsigned k = 0; k < 3; k++) {
		double lo = (&all->lo.x)[k], hi = (&all->hi.x)[k];

		s->centre[k] = lo + (hi - lo) / 2;
		half = ald_max(ald_max(hi - s->centre[k], s->centre[k] - lo) + pad, half);
	}
	frexp(half, &power);
	s->usable = half > 0x1p-400 && half < 0x1p400;
	s->scale = s->usable ? ldexp(1, -power) : 1;
}

/* Seat k of a group. A seat that stays empty gets another triangle once more: it is not to be asked about. */
static inline __attribute__((unused)) void group_set(const struct space *s, struct group *g, unsigned k,
						     const ald_vec v[3])
{
	double x[3][3], e[3][3], longest = 0, grow;
	int power;

	for (unsigned i = 0; i < 3; i++) {
		for (unsigned j = 0; j < 3; j++) {
			x[i][j] = (ald_get(&v[i], j) - s->centre[j]) * s->scale;
			e[i][j] = (ald_get(&v[i == 2 ? 0 : i + 1], j) - ald_get(&v[i], j)) * s->scale;
			longest = ald_max(fabs(e[i][j]), longest);
		}
	}
	frexp(longest, &power);
	grow = longest > 0x1p-200 ? ldexp(1, -power) : 1;
	for (unsigned i = 0; i < 3; i++) {
		for (unsigned j = 0; j < 3; j++)
			e[i][j] *= grow;
	}
	for (unsigned j = 0; j < 3; j++) {
		unsigned p = (j + 1) % 3, q = (j + 2) % 3;

		g->row[ROW_N + j][k] = (float)((e[0][p] * e[1][q] - e[0][q] * e[1][p]) / grow);
		g->row[ROW_B + j][k] = (float)(x[2][p] * e[2][q] - x[2][q] * e[2][p]);
		g->row[ROW_C + j][k] = (float)(x[0][p] * e[0][q] - x[0][q] * e[0][p]);
		g->row[ROW_DB + j][k] = (float)e[2][j];
		g->row[ROW_DC + j][k] = (float)e[0][j];
	}
}

#endif
