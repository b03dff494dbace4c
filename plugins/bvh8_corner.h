/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Primitives as bvh8's builders read them: a triangle's corners, its box, and both in the coordinates X.
 */
#ifndef BVH8_CORNER_H
#define BVH8_CORNER_H

#include "bvh8_hull.h"

#if ISA_LEVEL >= 2
typedef __m256d d4; /* the fourth is 0 */

V d4 d4_three(const double *p) { return _mm256_maskload_pd(p, _mm256_set_epi64x(0, -1, -1, -1)); }
V d4 d4_floats(const float *p) { return _mm256_cvtps_pd(_mm_maskload_ps(p, _mm_set_epi32(0, -1, -1, -1))); }
V d4 d4_all(double x) { return _mm256_set_pd(0, x, x, x); }
V d4 d4_add(d4 a, d4 b) { return _mm256_add_pd(a, b); }
V d4 d4_sub(d4 a, d4 b) { return _mm256_sub_pd(a, b); }
V d4 d4_mul(d4 a, d4 b) { return _mm256_mul_pd(a, b); }
V d4 d4_min(d4 a, d4 b) { return _mm256_min_pd(a, b); }
V d4 d4_max(d4 a, d4 b) { return _mm256_max_pd(a, b); }
V int d4_same(d4 a, d4 b) { return _mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_EQ_OQ)) == 15; }
V q4 d4_round(d4 a) { return _mm256_cvtpd_ps(a); }
V void d4_whole(d4 a, int32_t n[4]) { _mm_storeu_si128((__m128i *)(void *)n, _mm256_cvttpd_epi32(a)); }
#elif defined __SSE2__
typedef struct {
	__m128d xy, z; /* z and 0 */
} d4;

V d4 d4_three(const double *p) { return (d4){ _mm_loadu_pd(p), _mm_load_sd(p + 2) }; }
V d4 d4_floats(const float *p)
{
	return (d4){ _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64((const __m128i *)(const void *)p))),
		     _mm_set_sd((double)p[2]) };
}
V d4 d4_all(double x) { return (d4){ _mm_set1_pd(x), _mm_set_sd(x) }; }
V d4 d4_add(d4 a, d4 b) { return (d4){ _mm_add_pd(a.xy, b.xy), _mm_add_pd(a.z, b.z) }; }
V d4 d4_sub(d4 a, d4 b) { return (d4){ _mm_sub_pd(a.xy, b.xy), _mm_sub_pd(a.z, b.z) }; }
V d4 d4_mul(d4 a, d4 b) { return (d4){ _mm_mul_pd(a.xy, b.xy), _mm_mul_pd(a.z, b.z) }; }
V d4 d4_min(d4 a, d4 b) { return (d4){ _mm_min_pd(a.xy, b.xy), _mm_min_pd(a.z, b.z) }; }
V d4 d4_max(d4 a, d4 b) { return (d4){ _mm_max_pd(a.xy, b.xy), _mm_max_pd(a.z, b.z) }; }
V int d4_same(d4 a, d4 b)
{
	return _mm_movemask_pd(_mm_and_pd(_mm_cmpeq_pd(a.xy, b.xy), _mm_cmpeq_pd(a.z, b.z))) == 3;
}
V q4 d4_round(d4 a) { return _mm_movelh_ps(_mm_cvtpd_ps(a.xy), _mm_cvtpd_ps(a.z)); }
V void d4_whole(d4 a, int32_t n[4])
{
	__m128i x = _mm_unpacklo_epi64(_mm_cvttpd_epi32(a.xy), _mm_cvttpd_epi32(a.z));

	_mm_storeu_si128((__m128i *)(void *)n, x);
}
#else
typedef double d2 __attribute__((vector_size(16)));
typedef int64_t d2_mask __attribute__((vector_size(16)));
typedef struct {
	d2 xy, z; /* z and 0 */
} d4;

V d2 d2_where(d2_mask m, d2 a, d2 b) { return (d2)((m & (d2_mask)a) | (~m & (d2_mask)b)); }
V d4 d4_three(const double *p) { return (d4){ { p[0], p[1] }, { p[2], 0 } }; }
V d4 d4_floats(const float *p) { return (d4){ { (double)p[0], (double)p[1] }, { (double)p[2], 0 } }; }
V d4 d4_all(double x) { return (d4){ { x, x }, { x, 0 } }; }
V d4 d4_add(d4 a, d4 b) { return (d4){ a.xy + b.xy, a.z + b.z }; }
V d4 d4_sub(d4 a, d4 b) { return (d4){ a.xy - b.xy, a.z - b.z }; }
V d4 d4_mul(d4 a, d4 b) { return (d4){ a.xy * b.xy, a.z * b.z }; }
V d4 d4_min(d4 a, d4 b) { return (d4){ d2_where(a.xy < b.xy, a.xy, b.xy), d2_where(a.z < b.z, a.z, b.z) }; }
V d4 d4_max(d4 a, d4 b) { return (d4){ d2_where(a.xy > b.xy, a.xy, b.xy), d2_where(a.z > b.z, a.z, b.z) }; }
V int d4_same(d4 a, d4 b)
{
	d2_mask m = (a.xy == b.xy) & (a.z == b.z);

	return (m[0] & m[1]) != 0;
}
V q4 d4_round(d4 a) { return (q4){ (float)a.xy[0], (float)a.xy[1], (float)a.z[0], (float)a.z[1] }; }
V void d4_whole(d4 a, int32_t n[4])
{
	n[0] = (int32_t)a.xy[0], n[1] = (int32_t)a.xy[1], n[2] = (int32_t)a.z[0], n[3] = 0;
}
#endif

V void read_corners(const ald_prims *p, uint32_t id, d4 v[3])
{
	const uint32_t *index = p->index + 3 * (size_t)id;

	if (p->vertex_double) {
		UNROLL for (unsigned k = 0; k < 3; k++)
			v[k] = d4_three((const double *)p->vertex + 3 * (size_t)index[k]);
	} else {
		UNROLL for (unsigned k = 0; k < 3; k++)
			v[k] = d4_floats((const float *)p->vertex + 3 * (size_t)index[k]);
	}
	if (p->origin) {
		const ald_vec *o = &p->origin[ald_group_of(p, id)];

		UNROLL for (unsigned k = 0; k < 3; k++)
			v[k] = d4_add(v[k], d4_three(&o->x));
	}
}

/* 0: it can't be hit: some number is none, or two corners are one, and no line meets that. */
V int can_be_hit(const d4 v[3])
{
	d4 none = d4_add(d4_add(d4_sub(v[0], v[0]), d4_sub(v[1], v[1])), d4_sub(v[2], v[2]));

	return d4_same(none, d4_all(0)) & !(d4_same(v[0], v[1]) | d4_same(v[1], v[2]) | d4_same(v[2], v[0]));
}

struct to_x { /* the way to X */
	d4 centre, scale;
};

V struct to_x to_x(const ald_accel *a)
{
	return (struct to_x){ d4_three(a->centre), d4_all(a->scale) };
}

/* The corners' X, rounded to the next floats; each has 0 behind it. */
V void corners_x(const struct to_x *x, const d4 v[3], q4 out[3])
{
	UNROLL for (unsigned k = 0; k < 3; k++)
		out[k] = d4_round(d4_mul(d4_sub(v[k], x->centre), x->scale));
}

/* Two units in the last place further out at most, one at least. */
V q4 q4_less(q4 a)
{
	return q4_sub(a, q4_mul(q4_size(a), q4_all(0x1p-23f)));
}

V hull corners_hull(const q4 v[3])
{
	q4 hi = q4_max(q4_max(v[0], v[1]), v[2]);

	return hull_make(q4_less(q4_min(q4_min(v[0], v[1]), v[2])), q4_less(q4_sub(q4_all(0), hi)));
}

V hull triangle_hull(const struct to_x *x, const ald_prims *p, uint32_t id)
{
	d4 c[3];
	q4 v[3];

	read_corners(p, id, c);
	corners_x(x, c, v);
	return corners_hull(v);
}

/* The bound on a weight of these corners. */
V float corners_slack(const q4 x[3])
{
	float size[4] __attribute__((aligned(16)));
	q4 d = q4_max(q4_size(q4_sub(x[0], x[1])), q4_size(q4_sub(x[1], x[2])));

	q4_store(size, q4_max(d, q4_size(q4_sub(x[2], x[0]))));
	size[0] = size[0] > size[1] ? size[0] : size[1];
	size[0] = size[0] > size[2] ? size[0] : size[2];
	return EDGE_ERROR * (12 * (size[0] + 4 * EDGE_ERROR) + 4 * EDGE_ERROR);
}

V void block_empty(struct block *n, q4 v[3][SEATS], unsigned i)
{
	n->id[i] = ALD_NONE;
	n->slack[i] = -1;
	v[0][i] = v[1][i] = v[2][i] = q4_all(0);
}

V void block_seat(struct block *n, q4 v[3][SEATS], unsigned i, uint32_t id, const q4 x[3])
{
	n->id[i] = id;
	n->slack[i] = corners_slack(x);
	UNROLL for (unsigned k = 0; k < 3; k++)
		v[k][i] = x[k];
}

V void block_close(struct block *n, q4 v[3][SEATS])
{
	UNROLL for (unsigned k = 0; k < 3; k++) {
		q4_turn(v[k]);
		UNROLL for (unsigned j = 0; j < 3; j++)
			q4_store(n->v[k][j], v[k][j]);
	}
}

V hull prim_hull(const ald_accel *a, const struct to_x *x, const ald_prims *p, uint32_t id)
{
	float side[8] __attribute__((aligned(32)));
	ald_box box;

	if (id < p->tri_count)
		return triangle_hull(x, p, id);
	p->bounds(p, id, &box);
	for (unsigned k = 0; k < 3; k++) {
		side[k] = ald_float_down((ald_get(&box.lo, k) - a->centre[k]) * a->scale);
		side[4 + k] = -ald_float_up((ald_get(&box.hi, k) - a->centre[k]) * a->scale);
	}
	side[3] = side[7] = 0;
	return hull_load(side);
}

#endif
