/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * One ray made ready for bvh8's walk, and one triangle decided for it, axes side by side: what bvh8_lot.h and
 * lane_triangle.h do for many rays, lane by lane. See these for what is computed and why. Most calls of one ray open
 * some five nodes, so that all around these counts as much.
 */
#ifndef BVH8_LONE_H
#define BVH8_LONE_H

#include "bvh8_beam.h"

struct line;

#if ISA_LEVEL >= 2
typedef __m256d axes; /* x, y, z; the fourth means nothing */

struct line { /* a ray as the doubles want it: see struct pairs */
	axes o, d, inv;
	double pad;
	/* From the first leaf on. */
	axes shear; /* of kx and ky */
	__m256i turn; /* lanes kx, ky, kz */
	/* What leaves are going to want to know. */
	float at[4] __attribute__((aligned(16))), slope[4]; /* where it enters the scene's box; 1 over the direction */
	double last, up; /* nothing behind last counts; up: a power of two, see lot_doubles() */
};

struct path { /* a ray as nodes want it */
	f4 inverse, near_o, far_o; /* x, y, z; plane * inverse + near_o is the entrance */
	uint32_t down; /* bits: the direction goes down */
};

V axes axes_three(const double *p) { return _mm256_maskload_pd(p, _mm256_set_epi64x(0, -1, -1, -1)); }
V axes axes_floats(const float *p) { return _mm256_cvtps_pd(_mm_maskload_ps(p, _mm_set_epi32(0, -1, -1, -1))); }
V axes axes_all(double x) { return _mm256_set1_pd(x); }
V axes axes_sign(axes a) { return _mm256_and_pd(a, axes_all(-0.0)); }
V axes axes_size(axes a) { return _mm256_andnot_pd(axes_all(-0.0), a); }
V axes axes_turned(axes a, __m256i turn)
{
	return _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(a), turn));
}
V __m128d axes_xy(axes a) { return _mm256_castpd256_pd128(a); }
V __m128d axes_z(axes a) { return _mm256_extractf128_pd(a, 1); }
V __m128d pair_turned(__m128d a) { return _mm_unpackhi_pd(a, a); }

/* (x + y) + z, (x max y) max z, and the least; of numbers. */
V double axes_sum(axes a)
{
	return _mm_cvtsd_f64(axes_xy(a)) + _mm_cvtsd_f64(pair_turned(axes_xy(a))) + _mm_cvtsd_f64(axes_z(a));
}

V double axes_most(axes a)
{
	return _mm_cvtsd_f64(_mm_max_sd(_mm_max_sd(axes_xy(a), pair_turned(axes_xy(a))), axes_z(a)));
}

V double axes_least(axes a)
{
	return _mm_cvtsd_f64(_mm_min_sd(_mm_min_sd(axes_xy(a), pair_turned(axes_xy(a))), axes_z(a)));
}

/* kz of the sizes of a direction: bits x > y, y > z, x > z. */
V uint32_t axes_main(axes size)
{
	axes x = _mm256_permute4x64_pd(size, 0x04), y = _mm256_permute4x64_pd(size, 0x29);
	uint32_t more = (uint32_t)_mm256_movemask_pd(_mm256_cmp_pd(x, y, _CMP_GT_OQ)) & 7;

	return 0x129au >> 2 * more & 3;
}

static const uint32_t axes_turns[3][8] __attribute__((aligned(32), unused)) = {
	{ 2, 3, 4, 5, 0, 1, 6, 7 }, { 4, 5, 0, 1, 2, 3, 6, 7 }, { 0, 1, 2, 3, 4, 5, 6, 7 } };

/* walk_t() */
V float lone_time(double t, double shift, double tscale)
{
	__m128d x = _mm_max_sd(_mm_set_sd((t - shift) * tscale), _mm_set_sd(-8));

	return (float)_mm_cvtsd_f64(_mm_min_sd(x, _mm_set_sd(8)));
}

/* Of a beam, what triangles want to know. Many rays come to none. */
V void lone_aim(struct line *l, struct beam *b)
{
	const ald_ray *r = b->ray;
	const uint32_t kz = axes_main(axes_size(l->d));
	const double down = (&r->dir.x)[kz];
	const float first = lone_time(r->tmin, b->shift, b->tscale), end = lone_time(l->last, b->shift, b->tscale);
	const float side = copysignf(1, (float)down);
	struct aim *m = &b->aim;
	const float far = far_of(m->pad);
	float lowest, highest;
	axes main;

	l->turn = _mm256_load_si256((const __m256i *)axes_turns[kz]);
	main = axes_turned(l->d, l->turn);
	l->shear = _mm256_div_pd(main, _mm256_permute4x64_pd(main, 0xaa));
	m->axis[0] = kz == 2 ? 0 : kz + 1;
	m->axis[1] = m->axis[0] == 2 ? 0 : m->axis[0] + 1;
	m->axis[2] = kz;
	m->o[0] = l->at[m->axis[0]];
	m->o[1] = l->at[m->axis[1]];
	m->o[2] = l->at[kz] * side;
	m->side = side;
	m->shear[0] = (float)_mm_cvtsd_f64(axes_xy(l->shear)) * side;
	m->shear[1] = (float)_mm_cvtsd_f64(pair_turned(axes_xy(l->shear))) * side;
	m->back = l->slope[kz] * side;
	m->zerror = depth_error(m->pad);
	m->grow = far * far;
	b->depth = (float)(fabs(down) / l->up);
	lowest = first * b->depth;
	highest = end * b->depth;
	m->before = lowest - fabsf(lowest) * DEPTH_LEAST;
	m->sure_lo = lowest + fabsf(lowest) * DEPTH_LEAST;
	m->sure_hi = highest - fabsf(highest) * DEPTH_LEAST;
	beam_cut(b, b->tfar);
}

enum lone { LONE_MISSES, LONE_ODD, LONE_GOES };

/* A ray that nothing behind last counts for: is there anything to be seen? LONE_ODD: no triangle stands its numbers.
 * See lot_doubles() and lot_singles(). */
V enum lone lone_begin(const ald_accel *a, const ald_ray *r, double last, struct line *l, struct path *p,
		       struct beam *b)
{
	const axes huge = axes_all(0x1p400), lo = axes_three(&a->box.lo.x), hi = axes_three(&a->box.hi.x);
	axes o = _mm256_loadu_pd(&r->org.x), d = _mm256_loadu_pd(&r->dir.x), size = axes_size(d), pad, n, f;
	double far = axes_sum(axes_size(_mm256_sub_pd(o, axes_three(&a->frame.centre.x)))) + a->frame.radius;
	double t0, t1, most;
	const f4 limit = f4_all(0x1p40f);
	f4 at, v, e;
	uint64_t bits;

	l->pad = 16 * ALD_U * far;
	l->o = o;
	l->d = l->shear = d;
	l->turn = _mm256_setzero_si256();
	l->inv = _mm256_div_pd(axes_all(1), d);
	pad = _mm256_xor_pd(axes_all(l->pad), axes_sign(d));
	n = _mm256_sub_pd(_mm256_blendv_pd(lo, hi, d), _mm256_add_pd(o, pad));
	f = _mm256_sub_pd(_mm256_blendv_pd(hi, lo, d), _mm256_sub_pd(o, pad));
	t0 = axes_most(_mm256_max_pd(_mm256_mul_pd(n, l->inv), axes_all(r->tmin)));
	t1 = axes_least(_mm256_min_pd(_mm256_mul_pd(f, l->inv), axes_all(last)));
	if (t0 > t1)
		return LONE_MISSES;
	most = axes_most(size);
	if ((_mm256_movemask_pd(_mm256_cmp_pd(size, huge, _CMP_LT_OQ)) & 7) != 7 || !(far < 0x1p400) ||
	    !(most > 0x1p-400))
		return LONE_ODD;
	memcpy(&bits, &most, sizeof(bits));
	bits = (bits & 0x7ffull << 52) + (1ull << 52);
	memcpy(&l->up, &bits, sizeof(bits));
	b->shift = t0;
	b->tscale = l->up * a->scale;
	l->last = last;
	b->tfar = lone_time(last, t0, b->tscale) * (1 + 0x1p-20f) + 0x1p-30f;
	b->depth = b->aim.zerror = 0;
	b->aim.pad = (float)((4 * l->pad + 2 * a->prims->pad) * a->scale);
	o = _mm256_add_pd(_mm256_sub_pd(o, axes_three(a->centre)), _mm256_mul_pd(axes_all(t0), d));
	at = _mm256_cvtpd_ps(_mm256_mul_pd(o, axes_all(a->scale)));
	v = _mm256_cvtpd_ps(_mm256_mul_pd(l->inv, axes_all(l->up)));
	v = f4_max(f4_min(v, limit), f4_negate(limit));
	f4_store(l->at, at);
	f4_store(l->slope, v);
	e = f4_signed(f4_all(BOX_ERROR + b->aim.pad), v);
	p->inverse = v;
	p->near_o = f4_mul(f4_negate(f4_add(at, e)), v);
	p->far_o = f4_mul(f4_negate(f4_sub(at, e)), v);
	p->down = (uint32_t)_mm256_movemask_pd(d) & 7;
	return LONE_GOES;
}

/* ---- one triangle, as the kernel decides it ---- */

V void lone_corners(const ald_prims *p, uint32_t id, axes v[3])
{
	const uint32_t *index = p->index + 3 * (size_t)id;

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		if (p->vertex_double)
			v[k] = axes_three((const double *)p->vertex + 3 * (size_t)index[k]);
		else
			v[k] = axes_floats((const float *)p->vertex + 3 * (size_t)index[k]);
	}
	if (p->origin) {
		const axes origin = axes_three(&p->origin[ald_group_of(p, id)].x);

		UNROLL
		for (unsigned k = 0; k < 3; k++)
			v[k] = _mm256_add_pd(v[k], origin);
	}
}

/* ald_triangle_t() */
V double lone_t(const struct line *l, const axes v[3])
{
	axes e = _mm256_sub_pd(v[1], v[0]), g = _mm256_sub_pd(v[2], v[0]), q = _mm256_sub_pd(v[0], l->o), n, up, across;
	axes lo = _mm256_min_pd(_mm256_min_pd(v[0], v[1]), v[2]), hi = _mm256_max_pd(_mm256_max_pd(v[0], v[1]), v[2]);
	axes in = _mm256_mul_pd(_mm256_sub_pd(_mm256_blendv_pd(lo, hi, l->d), l->o), l->inv);
	axes out = _mm256_mul_pd(_mm256_sub_pd(_mm256_blendv_pd(hi, lo, l->d), l->o), l->inv);
	__m128d both, t, t0, t1;

	/* y, z, x and z, x, y */
	n = _mm256_sub_pd(_mm256_mul_pd(_mm256_permute4x64_pd(e, 0xc9), _mm256_permute4x64_pd(g, 0xd2)),
			  _mm256_mul_pd(_mm256_permute4x64_pd(e, 0xd2), _mm256_permute4x64_pd(g, 0xc9)));
	up = _mm256_mul_pd(n, q);
	across = _mm256_mul_pd(n, l->d);
	both = _mm_add_pd(_mm_unpacklo_pd(axes_xy(up), axes_xy(across)), _mm_unpackhi_pd(axes_xy(up), axes_xy(across)));
	both = _mm_add_pd(both, _mm_unpacklo_pd(axes_z(up), axes_z(across)));
	t = _mm_div_sd(both, pair_turned(both));
	t0 = _mm_max_sd(axes_xy(in), _mm_set_sd(-ALD_INF));
	t0 = _mm_max_sd(axes_z(in), _mm_max_sd(pair_turned(axes_xy(in)), t0));
	t1 = _mm_min_sd(axes_xy(out), _mm_set_sd(ALD_INF));
	t1 = _mm_min_sd(axes_z(out), _mm_min_sd(pair_turned(axes_xy(out)), t1));
	return _mm_cvtsd_f64(_mm_max_sd(_mm_min_sd(t, t1), t0));
}

/* A corner as seen along the ray: x and y. */
V __m128d lone_sheared(const struct line *l, axes corner)
{
	axes c = axes_turned(_mm256_sub_pd(corner, l->o), l->turn), z = _mm256_permute4x64_pd(c, 0xaa);

	return _mm_sub_pd(axes_xy(c), _mm_mul_pd(axes_xy(l->shear), axes_xy(z)));
}

V __m128d pair_size(__m128d a) { return _mm_andnot_pd(_mm_set1_pd(-0.0), a); }
/* x y' and y x' */
V __m128d pair_cross(__m128d a, __m128d b) { return _mm_mul_pd(a, _mm_shuffle_pd(b, b, 1)); }

/* The whole of prims->intersect() for a triangle, ald_sees() apart. */
V int lone_triangle(const ald_accel *a, const ald_ray *r, const struct line *l, uint32_t id, ald_hit *hit)
{
	__m128d x, y, z, p, q, s, w, sum;
	double e, w0, w1, w2, t;
	axes v[3];
	int up, down;

	if (a->frame.exact)
		return ask_kernel(a, r, id, hit);
	lone_corners(a->prims, id, v);
	x = lone_sheared(l, v[0]);
	y = lone_sheared(l, v[1]);
	z = lone_sheared(l, v[2]);
	/* |x| + |y| of each */
	w = _mm_add_pd(_mm_unpacklo_pd(pair_size(x), pair_size(y)), _mm_unpackhi_pd(pair_size(x), pair_size(y)));
	s = _mm_add_sd(pair_size(z), pair_turned(pair_size(z)));
	e = l->pad * _mm_cvtsd_f64(_mm_add_sd(_mm_add_sd(w, pair_turned(w)), s));
	p = pair_cross(z, y);
	q = pair_cross(x, z);
	s = pair_cross(y, x);
	w = _mm_sub_pd(_mm_unpacklo_pd(p, q), _mm_unpackhi_pd(p, q));
	w0 = _mm_cvtsd_f64(w);
	w1 = _mm_cvtsd_f64(pair_turned(w));
	w2 = _mm_cvtsd_f64(_mm_sub_sd(s, pair_turned(s)));
	up = (w0 > e) & (w1 > e) & (w2 > e);
	down = (w0 < -e) & (w1 < -e) & (w2 < -e);
	sum = _mm_set_sd(w0 + w1 + w2);
	if (!(up | down)) {
		up = (w0 > e) | (w1 > e) | (w2 > e);
		down = (w0 < -e) | (w1 < -e) | (w2 < -e);
		return up & down ? 0 : ask_kernel(a, r, id, hit);
	}
	if (!(fabs(_mm_cvtsd_f64(sum)) <= DBL_MAX))
		return 0;
	t = lone_t(l, v);
	if (!ald_counts(r, t, id, hit))
		return 0;
	w = _mm_div_pd(_mm_set_pd(w2, w1), _mm_unpacklo_pd(sum, sum));
	hit->t = t;
	_mm_storeu_pd(&hit->u, w);
	hit->prim = id;
	hit->part = 0;
	hit->sub[0] = hit->sub[1] = 0;
	return 1;
}

/* Ask the doubles about what is pending and still in reach. */
V void lone_settle(const ald_accel *a, const struct line *l, struct beam *b, int any)
{
	for (uint32_t i = 0; i < b->pending && !(any && b->found); i++) {
		if (b->low[i] > b->tfar || !lone_triangle(a, b->ray, l, b->id[i], b->hit))
			continue;
		if (any)
			b->found = 1;
		else
			beam_limit(b);
	}
	b->pending = 0;
}

/* A triangle's corners. */
V void lone_fetch(const ald_prims *p, uint32_t id)
{
	const uint32_t *index = p->index + 3 * (size_t)id;
	const size_t each = 3 * (p->vertex_double ? sizeof(double) : sizeof(float));

	UNROLL
	for (unsigned k = 0; k < 3; k++)
		__builtin_prefetch((const char *)p->vertex + each * index[k]);
}

/* As beam_meet(). What is likely to be asked for is fetched. */
V void lone_meet(const ald_accel *a, const struct line *l, struct beam *b, const struct block *n,
		 const struct meeting *m, int any)
{
	f4 high = high_t(&b->aim, m), low = low_t(&b->aim, m->low);
	uint32_t from = b->pending;
	float least;

	f4_pack((float *)&b->id[from], f4_load((const float *)n->id), m->maybe);
	f4_pack(&b->low[from], low, m->maybe);
	f4_pack(&b->high[from], high, m->maybe);
	b->pending = from + (uint32_t)__builtin_popcount(m->maybe);
	if (any) {
		b->found |= m->sure != 0;
	} else {
		least = f4_least(high);
		beam_cut(b, least < b->tfar ? least : b->tfar);
	}
	if (a->far && !any)
		lone_fetch(a->prims, b->id[from]);
	if (b->pending > PENDING) {
		lone_settle(a, l, b, any);
		b->asked = 1;
	}
}
#endif

#endif
