/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Vectors of bvh8's builders. A hull is a box with its high sides negated: joining two is one minimum of eight
 * floats. To be included by one file for each instruction set; a minimum, a difference and a product round
 * alike on all of them, so all build the same tree.
 */
#ifndef BVH8_HULL_H
#define BVH8_HULL_H

#include <string.h>

#include "bvh8.h"
#include "f4.h"

#define FAR 0x1p100f

#if defined __SSE2__
typedef __m128 q4;

V q4 q4_all(float x) { return _mm_set1_ps(x); }
V q4 q4_load(const float *p) { return _mm_load_ps(p); }
V void q4_store(float *p, q4 a) { _mm_store_ps(p, a); }
V q4 q4_add(q4 a, q4 b) { return _mm_add_ps(a, b); }
V q4 q4_sub(q4 a, q4 b) { return _mm_sub_ps(a, b); }
V q4 q4_mul(q4 a, q4 b) { return _mm_mul_ps(a, b); }
V q4 q4_min(q4 a, q4 b) { return _mm_min_ps(a, b); }
V q4 q4_max(q4 a, q4 b) { return _mm_max_ps(a, b); }
V void q4_whole(q4 a, int32_t n[4]) { _mm_storeu_si128((__m128i *)(void *)n, _mm_cvttps_epi32(a)); }
/* The fourth lane 0. */
V q4 q4_three(q4 a) { return _mm_and_ps(a, _mm_castsi128_ps(_mm_set_epi32(0, -1, -1, -1))); }
V unsigned q4_same(q4 a, q4 b) { return (unsigned)_mm_movemask_ps(_mm_cmpeq_ps(a, b)); }
V unsigned q4_above(q4 a, q4 b) { return (unsigned)_mm_movemask_ps(_mm_cmpgt_ps(a, b)); }
/* The largest, in all four. */
V q4 q4_most(q4 a)
{
	a = _mm_max_ps(a, _mm_shuffle_ps(a, a, 0x4e));
	return _mm_max_ps(a, _mm_shuffle_ps(a, a, 0xb1));
}
/* The least, in all four. */
V q4 q4_least(q4 a)
{
	a = _mm_min_ps(a, _mm_shuffle_ps(a, a, 0x4e));
	return _mm_min_ps(a, _mm_shuffle_ps(a, a, 0xb1));
}
/* The last lane, in all four. */
V q4 q4_last(q4 a) { return _mm_shuffle_ps(a, a, 0xff); }
V q4 q4_size(q4 a) { return _mm_andnot_ps(_mm_set1_ps(-0.0f), a); }
/* Each lane one further up, and below them b's first. */
V q4 q4_push(q4 a, q4 b) { return _mm_move_ss(_mm_shuffle_ps(a, a, 0x90), b); }
/* b where the mask, of all ones or zeros, says so. */
V q4 q4_put(q4 a, q4 b, const uint32_t mask[4])
{
	q4 m = _mm_loadu_ps((const float *)(const void *)mask);

	return _mm_or_ps(_mm_and_ps(m, b), _mm_andnot_ps(m, a));
}
V void q4_turn(q4 a[4]) { _MM_TRANSPOSE4_PS(a[0], a[1], a[2], a[3]); }
#else
typedef f4 q4;

#define EACHQ for (unsigned i = 0; i < 4; i++)

V q4 q4_all(float x) { return f4_all(x); }
V q4 q4_load(const float *p) { return f4_load(p); }
V void q4_store(float *p, q4 a) { f4_store(p, a); }
V q4 q4_add(q4 a, q4 b) { return a + b; }
V q4 q4_sub(q4 a, q4 b) { return a - b; }
V q4 q4_mul(q4 a, q4 b) { return a * b; }
V q4 q4_min(q4 a, q4 b) { return f4_min(a, b); }
V q4 q4_max(q4 a, q4 b) { return f4_max(a, b); }
V void q4_whole(q4 a, int32_t n[4]) { EACHQ n[i] = (int32_t)a[i]; }
V q4 q4_three(q4 a) { a[3] = 0; return a; }
V unsigned q4_same(q4 a, q4 b) { return i4_bits(a == b); }
V unsigned q4_above(q4 a, q4 b) { return i4_bits(a > b); }
V q4 q4_most(q4 a)
{
	a = f4_max(a, (q4){ a[2], a[3], a[0], a[1] });
	return f4_max(a, (q4){ a[1], a[0], a[3], a[2] });
}
V q4 q4_least(q4 a)
{
	a = f4_min(a, (q4){ a[2], a[3], a[0], a[1] });
	return f4_min(a, (q4){ a[1], a[0], a[3], a[2] });
}
V q4 q4_last(q4 a) { return f4_all(a[3]); }
V q4 q4_size(q4 a) { return f4_size(a); }
V q4 q4_push(q4 a, q4 b) { return (q4){ b[0], a[0], a[1], a[2] }; }
V q4 q4_put(q4 a, q4 b, const uint32_t mask[4])
{
	return f4_where((i4){ (int32_t)mask[0], (int32_t)mask[1], (int32_t)mask[2], (int32_t)mask[3] }, b, a);
}
V void q4_turn(q4 a[4])
{
	q4 b[4] = { a[0], a[1], a[2], a[3] };

	for (unsigned k = 0; k < 4; k++)
		EACHQ a[k][i] = b[i][k];
}
#endif

V q4 q4_negate(q4 a) { return q4_sub(q4_all(-0.0f), a); }

#if ISA_LEVEL >= 2
typedef __m256 hull;

V hull hull_load(const float *p) { return _mm256_load_ps(p); }
V void hull_store(float *p, hull a) { _mm256_store_ps(p, a); }
V hull hull_join(hull a, hull b) { return _mm256_min_ps(a, b); }
V hull hull_common(hull a, hull b) { return _mm256_max_ps(a, b); }
V q4 hull_lo(hull a) { return _mm256_castps256_ps128(a); }
V q4 hull_minus_hi(hull a) { return _mm256_extractf128_ps(a, 1); }
V hull hull_make(q4 lo, q4 minus_hi) { return _mm256_insertf128_ps(_mm256_castps128_ps256(lo), minus_hi, 1); }
/* As eight floats of any kind. */
V hull hull_loose(const float *p) { return _mm256_loadu_ps(p); }
V hull hull_all(float x) { return _mm256_set1_ps(x); }
V hull hull_add(hull a, hull b) { return _mm256_add_ps(a, b); }
V hull hull_mul(hull a, hull b) { return _mm256_mul_ps(a, b); }
#else
typedef struct {
	q4 lo, minus_hi;
} hull;

V hull hull_load(const float *p) { return (hull){ q4_load(p), q4_load(p + 4) }; }
V void hull_store(float *p, hull a) { q4_store(p, a.lo), q4_store(p + 4, a.minus_hi); }
V hull hull_join(hull a, hull b) { return (hull){ q4_min(a.lo, b.lo), q4_min(a.minus_hi, b.minus_hi) }; }
V hull hull_common(hull a, hull b) { return (hull){ q4_max(a.lo, b.lo), q4_max(a.minus_hi, b.minus_hi) }; }
V q4 hull_lo(hull a) { return a.lo; }
V q4 hull_minus_hi(hull a) { return a.minus_hi; }
V hull hull_make(q4 lo, q4 minus_hi) { return (hull){ lo, minus_hi }; }
V hull hull_loose(const float *p)
{
	hull r;

	memcpy(&r, p, sizeof(r));
	return r;
}
V hull hull_all(float x) { return (hull){ q4_all(x), q4_all(x) }; }
V hull hull_add(hull a, hull b) { return (hull){ q4_add(a.lo, b.lo), q4_add(a.minus_hi, b.minus_hi) }; }
V hull hull_mul(hull a, hull b) { return (hull){ q4_mul(a.lo, b.lo), q4_mul(a.minus_hi, b.minus_hi) }; }
#endif

/* Numbers that are not negative, with the lowest bits replaced. */
V hull hull_mark(hull a, uint32_t mask, const uint32_t bits[8])
{
#if ISA_LEVEL >= 2
	__m256 x = _mm256_andnot_ps(_mm256_castsi256_ps(_mm256_set1_epi32((int)mask)), a);

	return _mm256_or_ps(x, _mm256_load_ps((const float *)(const void *)bits));
#else
	const i4 *b = (const i4 *)(const void *)bits;

	return (hull){ (f4)(((i4)a.lo & ~(int32_t)mask) | b[0]), (f4)(((i4)a.minus_hi & ~(int32_t)mask) | b[1]) };
#endif
}

/* The bits of the least of the eight. */
V uint32_t hull_least(hull a)
{
	return (uint32_t)((i4)q4_least(q4_min(hull_lo(a), hull_minus_hi(a))))[0];
}

V hull hull_none(void)
{
	return hull_make(q4_all(FAR), q4_all(FAR));
}

V float q4_area(q4 size)
{
	float d[4] __attribute__((aligned(16)));

	q4_store(d, size);
	return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

/* Half of it. */
V float hull_area(hull a)
{
	return q4_area(q4_add(hull_lo(a), hull_minus_hi(a))); /* both negative */
}

V hull ref_hull(const struct ref *r)
{
	return hull_load((const float *)(const void *)r);
}

/* With its id. */
V void ref_store(struct ref *r, hull h)
{
	hull_store((float *)(void *)r, h);
}

/* Twice the middle; its last lane is 0, which with an id in it could be anything, and slow. */
V q4 hull_mid(hull a)
{
	return q4_sub(q4_three(hull_lo(a)), q4_three(hull_minus_hi(a)));
}

struct range {
	uint32_t first, count, end; /* end: of the room that there is for it */
	uint32_t twig, depth, twigs; /* twigs: as many as may be made below it */
	hull box;
	q4 lo, hi; /* of the middles, doubled */
};

V void range_clear(struct range *r)
{
	r->box = hull_none();
	r->lo = q4_all(FAR);
	r->hi = q4_all(-FAR);
}

V void range_add(struct range *r, hull h, q4 mid)
{
	r->box = hull_join(r->box, h);
	r->lo = q4_min(r->lo, mid);
	r->hi = q4_max(r->hi, mid);
}

V void range_join(struct range *r, const struct range *s)
{
	r->box = hull_join(r->box, s->box);
	r->lo = q4_min(r->lo, s->lo);
	r->hi = q4_max(r->hi, s->hi);
}

V void set_twig(struct twig *t, const struct range *r, uint32_t kid, uint32_t count)
{
	float lo[4] __attribute__((aligned(16))), hi[4] __attribute__((aligned(16)));

	q4_store(lo, hull_lo(r->box));
	q4_store(hi, hull_minus_hi(r->box));
	UNROLL for (unsigned k = 0; k < 3; k++) {
		t->lo[k] = lo[k];
		t->hi[k] = -hi[k];
	}
	t->kid = kid;
	t->count = count;
}

#endif
