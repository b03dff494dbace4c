/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * alidade/exact.h - sums and products of doubles without rounding, and with them where a line meets a triangle.
 *
 * Included by alidade/kernel.h, which is what plugins include. Expansions are sums of doubles that do not
 * overlap, the largest last (Shewchuk: Adaptive Precision Floating-Point Arithmetic, Discrete Comput. Geom. 18,
 * 1997). A triangle's t is a fraction of two of them, num / den, and fractions are compared by cross
 * multiplication. All is exact unless something underflows, which takes sizes of more than 1e45 to 1 in a scene.
 */
#ifndef ALIDADE_EXACT_H
#define ALIDADE_EXACT_H

#include <float.h>
#include <math.h>
#include <string.h>

#include "accel.h"

#ifdef __FAST_MATH__
#error "alidade/exact.h: -ffast-math would make accelerators disagree"
#endif
#if defined __clang__
#pragma STDC FP_CONTRACT OFF
#endif

#ifdef __cplusplus
extern "C" {
#endif

#ifdef __GNUC__
#define ALD_INLINE static inline __attribute__((always_inline, unused))
#define ALD_APART static __attribute__((noinline, unused)) /* kept out of loops */
#define ALD_RARE static __attribute__((noinline, cold, unused))
#else
#define ALD_INLINE static inline
#define ALD_APART static
#define ALD_RARE static
#endif

#define ALD_U (DBL_EPSILON / 2) /* unit roundoff */

enum {
	ALD_TERMS = 200, /* of an expansion with as many products added, or fewer */
	/* Components have a bit each that no other has, and a double's reach from 2^4 down to 2^-1074. */
	ALD_TERMS_MAX = 1080
};

/* e += x. e has room for one more (GROW-EXPANSION, zeros left out). */
ALD_INLINE void ald_expansion_add(double *e, uint32_t *n, double x)
{
	uint32_t kept = 0;

	for (uint32_t i = 0; i < *n; i++) {
		double s = x + e[i], v = s - x, tail = (x - (s - v)) + (e[i] - v);

		x = s;
		if (tail != 0)
			e[kept++] = tail;
	}
	if (x != 0)
		e[kept++] = x;
	*n = kept;
}

/* a * b as high + *low, exactly (Dekker, Veltkamp): no fma, for it is not everywhere. */
ALD_INLINE double ald_product(double a, double b, double *low)
{
	double p = a * b, ca = 0x1.0000002p27 * a, cb = 0x1.0000002p27 * b;
	double ah = ca - (ca - a), bh = cb - (cb - b), al = a - ah, bl = b - bh;

	*low = al * bl - (((p - ah * bh) - al * bh) - ah * bl);
	return p;
}

/* The same; fused: by an fma, which makes the same of it. Only for callers that know the processor. */
ALD_INLINE double ald_product_by(double a, double b, double *low, int fused)
{
#ifdef __GNUC__
	if (fused) {
		*low = __builtin_fma(a, b, -(a * b));
		return a * b;
	}
#endif
	(void)fused;
	return ald_product(a, b, low);
}

/* a - b as high + *low, exactly. */
ALD_INLINE double ald_difference(double a, double b, double *low)
{
	double s = a - b, v = a - s;

	*low = (a - (s + v)) + (v - b);
	return s;
}

/* e += a * b * c, exactly. */
ALD_INLINE void ald_expansion_product(double *e, uint32_t *n, double a, double b, double c)
{
	double low, high, tail;

	if (a == 0 || b == 0 || c == 0)
		return;
	high = ald_product(a, b, &low);
	high = ald_product(high, c, &tail);
	ald_expansion_add(e, n, tail);
	ald_expansion_add(e, n, high);
	if (low != 0) {
		high = ald_product(low, c, &tail);
		ald_expansion_add(e, n, tail);
		ald_expansion_add(e, n, high);
	}
}

/* e += f * x, exactly. */
ALD_INLINE void ald_expansion_scaled(double *e, uint32_t *n, const double *f, uint32_t m, double x)
{
	for (uint32_t i = 0; i < m && x != 0; i++) {
		double low, high = ald_product(f[i], x, &low);

		ald_expansion_add(e, n, low);
		ald_expansion_add(e, n, high);
	}
}

/* As few components as may be, the largest of which is all but its last bit (COMPRESS). */
ALD_INLINE void ald_expansion_compress(double *e, uint32_t *n)
{
	uint32_t bottom = *n, top = 0;
	double q;

	if (!*n)
		return;
	q = e[--bottom];
	for (uint32_t i = bottom; i-- > 0;) {
		double s = q + e[i], low = e[i] - (s - q);

		q = s;
		if (low != 0) {
			e[bottom--] = q;
			q = low;
		}
	}
	e[bottom] = q;
	for (uint32_t i = bottom + 1; i < *n; i++) {
		double s = e[i] + q, low = q - (s - e[i]);

		q = s;
		if (low != 0)
			e[top++] = low;
	}
	e[top++] = q;
	*n = top;
}

/* Times a power of two, so that the largest component is in [0.5, 1); the power taken out. 0 stays. */
ALD_INLINE int ald_expansion_normalise(double *e, uint32_t n)
{
	int power = 0;

	if (n)
		(void)frexp(e[n - 1], &power);
	for (uint32_t i = 0; i < n; i++)
		e[i] = ldexp(e[i], -power);
	return power;
}

/* ---- where a line meets the plane of a triangle: t = num / den 2^power ---- */

typedef struct {
	double num[ALD_TERMS], den[ALD_TERMS]; /* compressed, normalised; den > 0 unless there is none */
	uint32_t nums, dens;
	int power;
} ald_ratio;

ALD_RARE void ald_ratio_of(const double *o, const double *d, const ald_vec *v, ald_ratio *r)
{
	const double *a = &v[0].x, *b = &v[1].x, *c = &v[2].x;
	double e[3][2], g[3][2], q[3][2], n[16];
	int power;

	r->nums = r->dens = 0;
	for (unsigned k = 0; k < 3; k++) {
		e[k][0] = ald_difference(b[k], a[k], &e[k][1]);
		g[k][0] = ald_difference(c[k], a[k], &g[k][1]);
		q[k][0] = ald_difference(a[k], o[k], &q[k][1]);
	}
	(void)frexp(fabs(d[0]) + fabs(d[1]) + fabs(d[2]), &power);
	for (unsigned k = 0; k < 3; k++) {
		unsigned i = (k + 1) % 3, j = (k + 2) % 3;
		uint32_t m = 0;

		for (unsigned s = 0; s < 4; s++) {
			ald_expansion_product(n, &m, e[i][s & 1], g[j][s >> 1], 1);
			ald_expansion_product(n, &m, -e[j][s & 1], g[i][s >> 1], 1);
		}
		ald_expansion_compress(n, &m);
		ald_expansion_scaled(r->num, &r->nums, n, m, q[k][0]);
		ald_expansion_scaled(r->num, &r->nums, n, m, q[k][1]);
		ald_expansion_scaled(r->den, &r->dens, n, m, ldexp(d[k], -power));
	}
	ald_expansion_compress(r->num, &r->nums);
	ald_expansion_compress(r->den, &r->dens);
	r->power = ald_expansion_normalise(r->num, r->nums);
	r->power -= ald_expansion_normalise(r->den, r->dens) + power;
	for (uint32_t i = 0; r->dens && r->den[r->dens - 1] < 0 && i < r->nums; i++)
		r->num[i] = -r->num[i];
	for (uint32_t i = 0, flip = r->dens && r->den[r->dens - 1] < 0; flip && i < r->dens; i++)
		r->den[i] = -r->den[i];
}

/* The sign of a * b - c * d 2^power, where each is 0 or its last component in [0.5, 1) but for the sign. */
ALD_RARE int ald_cross_sign(const double *a, uint32_t na, const double *b, uint32_t nb, const double *c,
			    uint32_t nc, const double *d, uint32_t nd, int power)
{
	double e[ALD_TERMS_MAX], first, second;
	uint32_t n = 0;

	first = na && nb ? a[na - 1] * b[nb - 1] : 0;
	second = nc && nd ? c[nc - 1] * d[nd - 1] : 0;
	if (first == 0 || second == 0 || (first > 0) != (second > 0))
		return first > second ? 1 : first < second ? -1 : 0;
	if (power > 4 || power < -4)
		return (power < 0) == (first > 0) ? 1 : -1;
	for (uint32_t i = 0; i < nb; i++)
		ald_expansion_scaled(e, &n, a, na, b[i]);
	for (uint32_t i = 0; i < nd; i++)
		ald_expansion_scaled(e, &n, c, nc, -ldexp(d[i], power));
	return !n ? 0 : e[n - 1] > 0 ? 1 : -1;
}

/* The sign of x - y. */
ALD_INLINE int ald_ratio_compare(const ald_ratio *x, const ald_ratio *y)
{
	return ald_cross_sign(x->num, x->nums, y->den, y->dens, y->num, y->nums, x->den, x->dens,
			      y->power - x->power);
}

/* The sign of x - (s + t) / 2; s and t are near each other or the same, and may be infinite. */
ALD_INLINE int ald_ratio_against(const ald_ratio *x, double s, double t)
{
	const double half = 0.5;
	double e[2];
	uint32_t n = 0;
	int power, up;

	if (!(fabs(s) <= DBL_MAX) || !(fabs(t) <= DBL_MAX))
		return s + t > 0 ? -1 : 1;
	(void)frexp(fabs(s) > fabs(t) ? s : t, &up);
	ald_expansion_add(e, &n, ldexp(s, -up - 1));
	ald_expansion_add(e, &n, ldexp(t, -up - 1));
	power = ald_expansion_normalise(e, n) + up;
	return ald_cross_sign(x->num, x->nums, &half, 1, e, n, x->den, x->dens, power - x->power - 1);
}

/* Do they lie in one plane across an axis, or have the same corners? Then they are met at one t. */
ALD_INLINE int ald_same_plane(const ald_vec v[3], const ald_vec w[3])
{
	unsigned same = 0;

	for (unsigned i = 0; i < 9; i++) {
		const ald_vec *a = &v[i / 3], *b = &w[i % 3];

		same += a->x == b->x && a->y == b->y && a->z == b->z;
	}
	if (same == 3) /* those of a triangle that is hit differ from each other */
		return 1;
	for (unsigned k = 0; k < 3; k++) {
		double x = (&v[0].x)[k];

		if ((&v[1].x)[k] == x && (&v[2].x)[k] == x && (&w[0].x)[k] == x &&
		    (&w[1].x)[k] == x && (&w[2].x)[k] == x)
			return 1;
	}
	return 0;
}

/* ---- t, correctly rounded ---- */

/* a + b and a * b, each of two doubles; off by at most 8 u^2 of |a| + |b| or of the product. */
ALD_INLINE void ald_pair_add(double a[2], double high, double low)
{
	double s = a[0] + high, v = s - a[0], e = (a[0] - (s - v)) + (high - v);

	e += a[1] + low;
	a[0] = s + e;
	a[1] = e - (a[0] - s);
}

ALD_INLINE void ald_pair_product(const double a[2], const double b[2], double out[2], int fused)
{
	double low, high = ald_product_by(a[0], b[0], &low, fused);

	low += a[0] * b[1] + a[1] * b[0];
	out[0] = high + low;
	out[1] = low - (out[0] - high);
}

/* By the fraction itself, where pairs of doubles do not tell. */
ALD_RARE double ald_ratio_round(const ald_ratio *x)
{
	double t, next;
	int sign;

	if (!x->nums || !x->dens)
		return 0;
	t = ldexp(x->num[x->nums - 1] / x->den[x->dens - 1], x->power);
	for (unsigned i = 0; i < 16; i++) {
		next = nextafter(t, ald_ratio_against(x, t, t) > 0 ? (double)INFINITY : -(double)INFINITY);
		sign = ald_ratio_against(x, t, next);
		if (sign == 0) { /* halfway: to the even one */
			uint64_t bits;

			memcpy(&bits, &t, sizeof(bits));
			return bits & 1 ? next : t;
		}
		if ((sign > 0) != (next > t))
			return t;
		t = next;
	}
	return t;
}

/* One axis of ald_try_t(): that component of the normal, e[0] g[1] - e[1] g[0], times q and times d, added to sum[0]
 * and sum[1]; to of[] the sizes of what was added. */
ALD_INLINE void ald_try_axis(const double *e0, const double *e1, const double *g0, const double *g1, const double *q,
			     double d, double sum[2][2], double of[2], int fused)
{
	double x[2], y[2], low, high, size;

	ald_pair_product(e0, g1, x, fused);
	ald_pair_product(e1, g0, y, fused);
	size = fabs(x[0]) + fabs(y[0]);
	ald_pair_add(x, -y[0], -y[1]);
	ald_pair_product(x, q, y, fused);
	ald_pair_add(sum[0], y[0], y[1]);
	high = ald_product_by(x[0], d, &low, fused);
	ald_pair_add(sum[1], high, low + x[1] * d);
	of[0] += size * fabs(q[0]);
	of[1] += size * fabs(d);
}

/* The double that is nearest to the t of the triangle abc, in pairs of doubles; not 0 if it surely is. Without a
 * branch or a loop, for lanes. fused: see ald_product_by(). */
ALD_INLINE int ald_try_t(const double *o, const double *d, const double *a, const double *b, const double *c, int fused,
			 double *rounded)
{
	double e[3][2], g[3][2], q[3][2], sum[2][2] = { { 0, 0 }, { 0, 0 } }, of[2] = { 0, 0 };
	double t, rest, high, low, off, across;

	e[0][0] = ald_difference(b[0], a[0], &e[0][1]);
	e[1][0] = ald_difference(b[1], a[1], &e[1][1]);
	e[2][0] = ald_difference(b[2], a[2], &e[2][1]);
	g[0][0] = ald_difference(c[0], a[0], &g[0][1]);
	g[1][0] = ald_difference(c[1], a[1], &g[1][1]);
	g[2][0] = ald_difference(c[2], a[2], &g[2][1]);
	q[0][0] = ald_difference(a[0], o[0], &q[0][1]);
	q[1][0] = ald_difference(a[1], o[1], &q[1][1]);
	q[2][0] = ald_difference(a[2], o[2], &q[2][1]);
	ald_try_axis(e[1], e[2], g[1], g[2], q[0], d[0], sum, of, fused);
	ald_try_axis(e[2], e[0], g[2], g[0], q[1], d[1], sum, of, fused);
	ald_try_axis(e[0], e[1], g[0], g[1], q[2], d[2], sum, of, fused);
	across = sum[1][0];
	t = sum[0][0] / across;
	high = ald_product_by(t, across, &low, fused);
	rest = (((sum[0][0] - high) - low) + sum[0][1] - t * sum[1][1]) / across;
	off = 256 * ALD_U * ALD_U * (of[0] + of[1] * fabs(t)) / fabs(across);
	high = t + rest;
	low = rest - (high - t);
	*rounded = high;
	return (fabs(across) > 256 * ALD_U * of[1]) & (of[1] > 0x1p-900) & (of[0] > 0x1p-900) &
	       (high + (low + off) == high) & (high + (low - off) == high);
}

/* The double that is nearest to the t of a triangle that the line meets. */
ALD_INLINE double ald_exact_t(const double *o, const double *d, const ald_vec *v, int fused)
{
	ald_ratio exact;
	double t;

	if (ald_try_t(o, d, &v[0].x, &v[1].x, &v[2].x, fused, &t))
		return t;
	ald_ratio_of(o, d, v, &exact);
	return ald_ratio_round(&exact);
}

#ifdef __cplusplus
}
#endif
#endif
