/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * DW rays and DW triangles, pair by pair, decided as alidade/kernel.h decides one (Woop, Benthin, Wald: Watertight
 * Ray/Triangle Intersection, 2013): by its very operations, each in its order, so that the bits are the same (R1).
 * Where its filter is undecided the pair is in doubt, and ald_triangle() is to be asked. To be included by one file
 * for each instruction set, after ISA_LEVEL.
 */
#ifndef LANE_TRIANGLE_H
#define LANE_TRIANGLE_H

#include "doubles.h"

struct pairs { /* by axis; v: corner, axis */
	dv o[3], d[3], inv[3], v[3][3]; /* inv: 1 / d */
	dv x[3], y[3]; /* of each corner, as seen along the ray: sheared, along its kx and ky */
	dv pad; /* as ald_prep has it */
	dv first, last; /* a t beyond does not count */
};

struct answer { /* bits of lanes: this is a hit within the ray; the kernel has to be asked */
	double t[DW], u[DW], v[DW];
	uint32_t hit, doubt;
};

V dv cross2(dv a, dv b, dv c, dv d)
{
	return dv_sub(dv_mul(a, b), dv_mul(c, d));
}

V dv sum3(dv a, dv b, dv c)
{
	return dv_add(dv_add(a, b), c);
}

/* ald_triangle_t() */
V dv pairs_t(const struct pairs *s)
{
	dv e[3], g[3], t, across, t0 = dv_all(-ALD_INF), t1 = dv_all(ALD_INF), n[3], q[3];

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		e[k] = dv_sub(s->v[1][k], s->v[0][k]);
		g[k] = dv_sub(s->v[2][k], s->v[0][k]);
		q[k] = dv_sub(s->v[0][k], s->o[k]);
	}
	n[0] = cross2(e[1], g[2], e[2], g[1]);
	n[1] = cross2(e[2], g[0], e[0], g[2]);
	n[2] = cross2(e[0], g[1], e[1], g[0]);
	t = sum3(dv_mul(n[0], q[0]), dv_mul(n[1], q[1]), dv_mul(n[2], q[2]));
	across = sum3(dv_mul(n[0], s->d[0]), dv_mul(n[1], s->d[1]), dv_mul(n[2], s->d[2]));
	t = dv_div(t, across);
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		dv lo = dv_min(dv_min(s->v[0][k], s->v[1][k]), s->v[2][k]);
		dv hi = dv_max(dv_max(s->v[0][k], s->v[1][k]), s->v[2][k]);
		dm down = dv_sign(s->d[k]);

		t0 = dv_max(dv_mul(dv_sub(dv_pick(down, hi, lo), s->o[k]), s->inv[k]), t0);
		t1 = dv_min(dv_mul(dv_sub(dv_pick(down, lo, hi), s->o[k]), s->inv[k]), t1);
	}
	return dv_max(dv_min(t, t1), t0);
}

/* ald_triangle_line(), as far as rounding lets tell, and t, u, v. */
V void pairs_answer(const struct pairs *s, struct answer *r)
{
	const dv *x = s->x, *y = s->y;
	dv w[3], e, minus, sum, t;
	dm up, down, in;

	e = dv_add(dv_add(dv_add(dv_size(x[0]), dv_size(y[0])), dv_add(dv_size(x[1]), dv_size(y[1]))),
		   dv_add(dv_size(x[2]), dv_size(y[2])));
	e = dv_mul(s->pad, e);
	minus = dv_sub(dv_all(0), e);
	w[0] = cross2(x[2], y[1], y[2], x[1]);
	w[1] = cross2(x[0], y[2], y[0], x[2]);
	w[2] = cross2(x[1], y[0], y[1], x[0]);
	sum = sum3(w[0], w[1], w[2]);
	up = dm_and(dm_and(dv_gt(w[0], e), dv_gt(w[1], e)), dv_gt(w[2], e));
	down = dm_and(dm_and(dv_gt(minus, w[0]), dv_gt(minus, w[1])), dv_gt(minus, w[2]));
	in = dm_and(dm_or(up, down), dv_gt(dv_all(ALD_INF), dv_size(sum)));
	up = dm_or(dm_or(dv_gt(w[0], e), dv_gt(w[1], e)), dv_gt(w[2], e));
	down = dm_or(dm_or(dv_gt(minus, w[0]), dv_gt(minus, w[1])), dv_gt(minus, w[2]));
	r->doubt = ~(dm_bits(in) | dm_bits(dm_and(up, down))) & ((1u << DW) - 1);
	t = pairs_t(s);
	in = dm_less(dm_less(in, dv_gt(s->first, t)), dv_gt(t, s->last));
	r->hit = dm_bits(in);
	dv_store(r->t, t);
	dv_store(r->u, dv_div(w[1], sum));
	dv_store(r->v, dv_div(w[2], sum));
}

#endif
