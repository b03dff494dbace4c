/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What bvh8's floats leave to the doubles: pairs of a ray and a triangle, collected and then decided DW at a
 * time by the very operations of alidade/kernel.h, each in its order, so that the bits are the same (R1).
 * The few that are in doubt there too are given to ald_triangle().
 */
#ifndef BVH8_ASK_H
#define BVH8_ASK_H

#include "bvh8_lot.h"

#define ASKED_MAX 64u

struct asked { /* in any order: of two hits of a ray the better is kept */
	uint32_t n, ray[ASKED_MAX + 1], id[ASKED_MAX + 1];
};

struct question { /* DW pairs, by component */
	double o[3][DW], d[3][DW], v[3][3][DW]; /* v: corner, axis */
	double first[DW], last[DW]; /* a t beyond does not count */
};

struct answer {
	double t[DW], u[DW], v[DW];
	uint32_t hit, doubt;
};

V void question_set(struct question *s, unsigned i, const ald_prims *p, const ald_ray *r, double last, uint32_t id)
{
	ald_vec v[3];

	s->first[i] = r->tmin;
	s->last[i] = last;
	ald_corners(p, id, p->origin ? ald_group_of(p, id) : 0, v);
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		s->o[k][i] = ald_get(&r->org, k);
		s->d[k][i] = ald_get(&r->dir, k);
		UNROLL
		for (unsigned j = 0; j < 3; j++)
			s->v[j][k][i] = ald_get(&v[j], k);
	}
}

V dv cross2(dv a, dv b, dv c, dv d)
{
	return dv_sub(dv_mul(a, b), dv_mul(c, d));
}

V dv sum3(dv a, dv b, dv c)
{
	return dv_add(dv_add(a, b), c);
}

/* ald_triangle_t() */
V dv answer_t(const dv o[3], const dv d[3], const dv v[3][3])
{
	dv e[3], g[3], t, across, t0 = dv_all(-ALD_INF), t1 = dv_all(ALD_INF), n[3], q[3];

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		e[k] = dv_sub(v[1][k], v[0][k]);
		g[k] = dv_sub(v[2][k], v[0][k]);
		q[k] = dv_sub(v[0][k], o[k]);
	}
	n[0] = cross2(e[1], g[2], e[2], g[1]);
	n[1] = cross2(e[2], g[0], e[0], g[2]);
	n[2] = cross2(e[0], g[1], e[1], g[0]);
	t = sum3(dv_mul(n[0], q[0]), dv_mul(n[1], q[1]), dv_mul(n[2], q[2]));
	across = sum3(dv_mul(n[0], d[0]), dv_mul(n[1], d[1]), dv_mul(n[2], d[2]));
	t = dv_div(t, across);
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		dv lo = dv_min(dv_min(v[0][k], v[1][k]), v[2][k]);
		dv hi = dv_max(dv_max(v[0][k], v[1][k]), v[2][k]);
		dv inv = dv_div(dv_all(1), d[k]);
		dm down = dv_sign(d[k]);

		t0 = dv_max(dv_mul(dv_sub(dv_pick(down, hi, lo), o[k]), inv), t0);
		t1 = dv_min(dv_mul(dv_sub(dv_pick(down, lo, hi), o[k]), inv), t1);
	}
	return dv_max(dv_min(t, t1), t0);
}

/* ald_triangle_line(), as far as rounding lets tell. */
V void answer(const ald_accel *a, const struct question *s, struct answer *r)
{
	const double *middle = &a->frame.centre.x;
	dv o[3], d[3], v[3][3], size[3], oo[3], dd[3], w[3], x[3], y[3], far, e, minus, sum, shear[2], t;
	dm main[3], up, down, in;

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		o[k] = dv_load(s->o[k]);
		d[k] = dv_load(s->d[k]);
		size[k] = dv_size(d[k]);
		UNROLL
		for (unsigned j = 0; j < 3; j++)
			v[j][k] = dv_load(s->v[j][k]);
	}
	far = sum3(dv_size(dv_sub(o[0], dv_all(middle[0]))), dv_size(dv_sub(o[1], dv_all(middle[1]))),
		   dv_size(dv_sub(o[2], dv_all(middle[2]))));
	far = dv_add(far, dv_all(a->frame.radius));
	main_axis(size, main);
	along_main(main, o, oo);
	along_main(main, d, dd);
	shear[0] = dv_div(dd[0], dd[2]);
	shear[1] = dv_div(dd[1], dd[2]);
	UNROLL
	for (unsigned j = 0; j < 3; j++) {
		dv c[3], z;

		along_main(main, v[j], c);
		z = dv_sub(c[2], oo[2]);
		x[j] = dv_sub(dv_sub(c[0], oo[0]), dv_mul(shear[0], z));
		y[j] = dv_sub(dv_sub(c[1], oo[1]), dv_mul(shear[1], z));
	}
	e = dv_add(dv_add(dv_add(dv_size(x[0]), dv_size(y[0])), dv_add(dv_size(x[1]), dv_size(y[1]))),
		   dv_add(dv_size(x[2]), dv_size(y[2])));
	e = dv_mul(dv_mul(dv_all(16 * ALD_U), far), e);
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
	r->hit = dm_bits(in);
	r->doubt = ~(r->hit | dm_bits(dm_and(up, down))) & ((1u << DW) - 1);
	t = answer_t(o, d, v);
	in = dm_less(dm_less(in, dv_gt(dv_load(s->first), t)), dv_gt(t, dv_load(s->last)));
	r->hit = dm_bits(in);
	dv_store(r->t, t);
	dv_store(r->u, dv_div(w[1], sum));
	dv_store(r->v, dv_div(w[2], sum));
}

/* Triangle id alone, by the kernel. */
static __attribute__((noinline, unused)) int ask_kernel(const ald_accel *a, const ald_ray *r, uint32_t id,
							ald_hit *hit)
{
	const ald_prims *p = a->prims;
	ald_prep prep;
	ald_vec v[3];

	ald_ray_prep(&a->frame, r, &prep);
	ald_corners(p, id, p->origin ? ald_group_of(p, id) : 0, v);
	return ald_triangle(&prep, r, v, id, hit);
}

V void answer_take(const ald_accel *a, const struct batch *b, const struct answer *s, unsigned i, uint32_t ray,
		   uint32_t id)
{
	const ald_ray *r = &b->ray[ray];
	ald_hit own = { .t = r->tmax, .prim = ALD_NONE }, *h = b->hit ? &b->hit[ray] : &own;

	if (s->doubt >> i & 1) {
		if (ask_kernel(a, r, id, h) && !b->hit)
			b->hidden[ray] = 1;
	} else if (s->hit >> i & 1 && ald_counts(r, s->t[i], id, h)) {
		if (b->hit)
			*h = (ald_hit){ .t = s->t[i], .u = s->u[i], .v = s->v[i], .prim = id };
		else
			b->hidden[ray] = 1;
	}
}

static __attribute__((noinline, unused)) void ask_alone(const ald_accel *a, const struct batch *b,
							const struct asked *q)
{
	for (uint32_t i = 0; i < q->n; i++) {
		uint32_t ray = q->ray[i];
		ald_hit own = { .t = b->ray[ray].tmax, .prim = ALD_NONE };

		if (ask_kernel(a, &b->ray[ray], q->id[i], b->hit ? &b->hit[ray] : &own) && !b->hit)
			b->hidden[ray] = 1;
	}
}

static __attribute__((noinline)) void ask_some(const ald_accel *a, const struct batch *b, struct asked *q)
{
	const ald_prims *p = a->prims;
	const int alone = a->frame.exact || q->n == 1; /* one triangle is not worth the lanes */
	struct question s = { 0 }; /* lanes that nothing is asked of hold what others left, or this */

	for (uint32_t i = 0; i < q->n && a->far; i++)
		__builtin_prefetch(&p->index[3 * (size_t)q->id[i]]);
	for (uint32_t i = 0; i < 3 * q->n && a->far; i++) {
		size_t at = 3 * (size_t)p->index[3 * (size_t)q->id[i / 3] + i % 3] * (p->vertex_double ? 8 : 4);

		__builtin_prefetch((const char *)p->vertex + at);
	}
	for (uint32_t i = 0; i < q->n && !alone; i += DW) {
		uint32_t n = q->n - i < DW ? q->n - i : DW;
		struct answer r;

		for (unsigned j = 0; j < n; j++) {
			const ald_ray *ray = &b->ray[q->ray[i + j]];

			question_set(&s, j, p, ray, b->hit ? b->hit[q->ray[i + j]].t : ray->tmax, q->id[i + j]);
		}
		answer(a, &s, &r);
		for (uint32_t bits = (r.hit | r.doubt) & ((1u << n) - 1); bits; bits &= bits - 1) {
			unsigned j = (unsigned)__builtin_ctz(bits);

			answer_take(a, b, &r, j, q->ray[i + j], q->id[i + j]);
		}
	}
	if (alone)
		ask_alone(a, b, q);
	q->n = 0;
}

/* Decide all that is asked. */
V void ask(const ald_accel *a, const struct batch *b, struct asked *q)
{
	if (q->n)
		ask_some(a, b, q);
}

#endif
