/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What bvh8's floats leave to the doubles: pairs of a ray and a triangle, collected and then decided DW at a
 * time. The few that are in doubt there too are given to ald_triangle().
 */
#ifndef BVH8_ASK_H
#define BVH8_ASK_H

#include "bvh8_lot.h"
#include "lane_triangle.h"

#define ASKED_MAX 64u

struct asked { /* in any order: of two hits of a ray the better is kept */
	uint32_t n, ray[ASKED_MAX + 1], id[ASKED_MAX + 1];
};

struct question { /* DW pairs, by component */
	double o[3][DW], d[3][DW], v[3][3][DW]; /* v: corner, axis */
	double first[DW], last[DW]; /* a t beyond does not count */
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

V void question_answer(const ald_accel *a, const struct question *s, struct answer *r)
{
	const double *middle = &a->frame.centre.x;
	struct pairs p;
	dv size[3], oo[3], dd[3], far, shear[2];
	dm main[3];

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		p.o[k] = dv_load(s->o[k]);
		p.d[k] = dv_load(s->d[k]);
		p.inv[k] = dv_div(dv_all(1), p.d[k]);
		size[k] = dv_size(p.d[k]);
		UNROLL
		for (unsigned j = 0; j < 3; j++)
			p.v[j][k] = dv_load(s->v[j][k]);
	}
	p.first = dv_load(s->first);
	p.last = dv_load(s->last);
	far = sum3(dv_size(dv_sub(p.o[0], dv_all(middle[0]))), dv_size(dv_sub(p.o[1], dv_all(middle[1]))),
		   dv_size(dv_sub(p.o[2], dv_all(middle[2]))));
	p.pad = dv_mul(dv_all(16 * ALD_U), dv_add(far, dv_all(a->frame.radius)));
	main_axis(size, main);
	along_main(main, p.o, oo);
	along_main(main, p.d, dd);
	shear[0] = dv_div(dd[0], dd[2]);
	shear[1] = dv_div(dd[1], dd[2]);
	UNROLL
	for (unsigned j = 0; j < 3; j++) {
		dv c[3], z;

		along_main(main, p.v[j], c);
		z = dv_sub(c[2], oo[2]);
		p.x[j] = dv_sub(dv_sub(c[0], oo[0]), dv_mul(shear[0], z));
		p.y[j] = dv_sub(dv_sub(c[1], oo[1]), dv_mul(shear[1], z));
	}
	pairs_answer(&p, r);
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
		question_answer(a, &s, &r);
		for (uint32_t bits = (r.hit | r.doubt) & ((1u << n) - 1); bits; bits &= bits - 1) {
			unsigned j = (unsigned)__builtin_ctz(bits);

			answer_take(a, b, &r, j, q->ray[i + j], q->id[i + j]);
		}
	}
	if (alone)
		ask_alone(a, b, q);
	q->n = 0;
}

/* ---- rays of a lot ---- */

struct corners { /* of triangles, DW of them: corner, axis */
	double v[3][3][DW];
};

/* That of lane j. */
V void corners_set(struct corners *c, unsigned j, const ald_prims *p, uint32_t id)
{
	ald_vec v[3];

	ald_corners(p, id, p->origin ? ald_group_of(p, id) : 0, v);
	UNROLL
	for (unsigned i = 0; i < 3; i++) {
		c->v[i][0][j] = v[i].x;
		c->v[i][1][j] = v[i].y;
		c->v[i][2][j] = v[i].z;
	}
}

struct due { /* of a lot, pairs that are to be decided once what they need has been fetched */
	const struct lines *lines;
	uint64_t some; /* lanes */
	uint32_t axis[3]; /* kx, ky, kz of all */
	uint32_t id[LOT] __attribute__((aligned(64))), ray[LOT], corner[3][LOT]; /* corners always are some */
} __attribute__((aligned(64)));

#if ISA_LEVEL >= 3
/* x, y and z of eight corners, as doubles, and as floats; nothing behind them is read. */
V void corners_doubles(const double *vertex, const uint32_t *corner, dv out[3])
{
	const __m512i x = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
	const __m512i z = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
	dv row[4], even[2], odd[2];

	UNROLL
	for (unsigned i = 0; i < 4; i++) {
		__m256d lo = _mm256_maskz_loadu_pd(7, vertex + 3 * (size_t)corner[i]);
		__m256d hi = _mm256_maskz_loadu_pd(7, vertex + 3 * (size_t)corner[i + 4]);

		row[i] = _mm512_insertf64x4(_mm512_castpd256_pd512(lo), hi, 1);
	}
	UNROLL
	for (unsigned i = 0; i < 2; i++) {
		even[i] = _mm512_unpacklo_pd(row[2 * i], row[2 * i + 1]);
		odd[i] = _mm512_unpackhi_pd(row[2 * i], row[2 * i + 1]);
	}
	out[0] = _mm512_permutex2var_pd(even[0], x, even[1]);
	out[1] = _mm512_permutex2var_pd(odd[0], x, odd[1]);
	out[2] = _mm512_permutex2var_pd(even[0], z, even[1]);
}

V void corners_floats(const float *vertex, const uint32_t *corner, dv out[3])
{
	__m256 row[4], even[2], odd[2];

	UNROLL
	for (unsigned i = 0; i < 4; i++) {
		__m128 lo = _mm_maskz_loadu_ps(7, vertex + 3 * (size_t)corner[i]);
		__m128 hi = _mm_maskz_loadu_ps(7, vertex + 3 * (size_t)corner[i + 4]);

		row[i] = _mm256_insertf128_ps(_mm256_castps128_ps256(lo), hi, 1);
	}
	UNROLL
	for (unsigned i = 0; i < 2; i++) {
		even[i] = _mm256_unpacklo_ps(row[2 * i], row[2 * i + 1]);
		odd[i] = _mm256_unpackhi_ps(row[2 * i], row[2 * i + 1]);
	}
	out[0] = _mm512_cvtps_pd(_mm256_shuffle_ps(even[0], even[1], 0x44));
	out[1] = _mm512_cvtps_pd(_mm256_shuffle_ps(even[0], even[1], 0xee));
	out[2] = _mm512_cvtps_pd(_mm256_shuffle_ps(odd[0], odd[1], 0x44));
}
#endif

/* Lanes at and on, those of row. */
V void due_corners(struct corners *c, const ald_prims *p, const struct due *d, unsigned at, uint32_t row)
{
#if ISA_LEVEL >= 3
	for (unsigned i = 0; i < 3 && !p->origin; i++) {
		dv v[3];

		if (p->vertex_double)
			corners_doubles(p->vertex, d->corner[i] + at, v);
		else
			corners_floats(p->vertex, d->corner[i] + at, v);
		UNROLL
		for (unsigned k = 0; k < 3; k++)
			dv_store(c->v[i][k], v[k]);
	}
	if (!p->origin)
		return;
#endif
	for (; row; row &= row - 1)
		corners_set(c, (unsigned)__builtin_ctz(row), p, d->id[at + (unsigned)__builtin_ctz(row)]);
}

/* Lines at and on, DW of them, with a triangle each; all of them have the same axes, kx, ky and kz. */
V void lines_answer(const struct lines *e, unsigned at, const struct corners *c, const uint32_t axis[3],
		    struct answer *r)
{
	dv sx = dv_load(e->shear[0] + at), sy = dv_load(e->shear[1] + at), o[3];
	struct pairs p;

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		p.o[k] = dv_load(e->o[k] + at);
		p.d[k] = dv_load(e->d[k] + at);
		p.inv[k] = dv_load(e->inv[k] + at);
		o[k] = dv_load(e->o[axis[k]] + at);
		UNROLL
		for (unsigned i = 0; i < 3; i++)
			p.v[i][k] = dv_load(c->v[i][k]);
	}
	UNROLL
	for (unsigned i = 0; i < 3; i++) {
		dv z = dv_sub(dv_load(c->v[i][axis[2]]), o[2]);

		p.x[i] = dv_sub(dv_sub(dv_load(c->v[i][axis[0]]), o[0]), dv_mul(sx, z));
		p.y[i] = dv_sub(dv_sub(dv_load(c->v[i][axis[1]]), o[1]), dv_mul(sy, z));
	}
	p.pad = dv_load(e->pad + at);
	p.first = dv_load(e->first + at);
	p.last = dv_load(e->last + at);
	pairs_answer(&p, r);
}

/* Decide all that is asked. */
V void ask(const ald_accel *a, const struct batch *b, struct asked *q)
{
	if (q->n)
		ask_some(a, b, q);
}

#endif
