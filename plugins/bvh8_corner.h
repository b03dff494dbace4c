/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Primitives as bvh8's builders read them: a triangle's corners, its box, and both in the coordinates X.
 */
#ifndef BVH8_CORNER_H
#define BVH8_CORNER_H

#include "bvh8_hull.h"

#if defined __SSE2__
typedef __m128d d2;

V d2 d2_load(const double *p) { return _mm_loadu_pd(p); }
V d2 d2_two(double x, double y) { return _mm_set_pd(y, x); }
V d2 d2_floats(const float *p)
{
	return _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64((const __m128i *)(const void *)p)));
}
V d2 d2_add(d2 a, d2 b) { return _mm_add_pd(a, b); }
V d2 d2_sub(d2 a, d2 b) { return _mm_sub_pd(a, b); }
V d2 d2_mul(d2 a, d2 b) { return _mm_mul_pd(a, b); }
V d2 d2_min(d2 a, d2 b) { return _mm_min_pd(a, b); }
V d2 d2_max(d2 a, d2 b) { return _mm_max_pd(a, b); }
V unsigned d2_same(d2 a, d2 b) { return (unsigned)_mm_movemask_pd(_mm_cmpeq_pd(a, b)); }
V unsigned d2_less(d2 a, d2 b) { return (unsigned)_mm_movemask_pd(_mm_cmplt_pd(a, b)); }
V void d2_store(double *p, d2 a) { _mm_storeu_pd(p, a); }
V q4 q4_round(d2 a, d2 b) { return _mm_movelh_ps(_mm_cvtpd_ps(a), _mm_cvtpd_ps(b)); }
V q4 q4_size(q4 a) { return _mm_andnot_ps(_mm_set1_ps(-0.0f), a); }
#else
typedef double d2 __attribute__((vector_size(16)));
typedef int64_t d2_mask __attribute__((vector_size(16)));

V d2 d2_load(const double *p) { return (d2){ p[0], p[1] }; }
V d2 d2_two(double x, double y) { return (d2){ x, y }; }
V d2 d2_floats(const float *p) { return (d2){ (double)p[0], (double)p[1] }; }
V d2 d2_add(d2 a, d2 b) { return a + b; }
V d2 d2_sub(d2 a, d2 b) { return a - b; }
V d2 d2_mul(d2 a, d2 b) { return a * b; }
V d2 d2_where(d2_mask m, d2 a, d2 b) { return (d2)((m & (d2_mask)a) | (~m & (d2_mask)b)); }
V d2 d2_min(d2 a, d2 b) { return d2_where(a < b, a, b); }
V d2 d2_max(d2 a, d2 b) { return d2_where(a > b, a, b); }
V unsigned d2_same(d2 a, d2 b) { return (a[0] == b[0]) + 2u * (a[1] == b[1]); }
V unsigned d2_less(d2 a, d2 b) { return (a[0] < b[0]) + 2u * (a[1] < b[1]); }
V void d2_store(double *p, d2 a) { p[0] = a[0], p[1] = a[1]; }
V q4 q4_round(d2 a, d2 b) { return (q4){ (float)a[0], (float)a[1], (float)b[0], (float)b[1] }; }
V q4 q4_size(q4 a) { return f4_size(a); }
#endif

struct corners { /* x and y, z and 0 */
	d2 xy[3], z[3];
};

V void read_kind(const ald_prims *p, uint32_t id, struct corners *c, int as_double)
{
	const uint32_t *index = p->index + 3 * (size_t)id;

	UNROLL for (unsigned k = 0; k < 3; k++) {
		size_t i = 3 * (size_t)index[k];

		if (as_double) {
			const double *v = (const double *)p->vertex + i;

			c->xy[k] = d2_load(v);
			c->z[k] = d2_two(v[2], 0);
		} else {
			const float *v = (const float *)p->vertex + i;

			c->xy[k] = d2_floats(v);
			c->z[k] = d2_two((double)v[2], 0);
		}
	}
}

V void read_corners(const ald_prims *p, uint32_t id, struct corners *c)
{
	if (p->vertex_double)
		read_kind(p, id, c, 1);
	else
		read_kind(p, id, c, 0);
	if (p->origin) {
		const ald_vec *o = &p->origin[ald_group_of(p, id)];

		UNROLL for (unsigned k = 0; k < 3; k++) {
			c->xy[k] = d2_add(c->xy[k], d2_two(o->x, o->y));
			c->z[k] = d2_add(c->z[k], d2_two(o->z, 0));
		}
	}
}

struct to_x { /* the way to X */
	d2 centre_xy, centre_z, scale;
};

V struct to_x to_x(const ald_accel *a)
{
	return (struct to_x){ d2_two(a->centre[0], a->centre[1]), d2_two(a->centre[2], 0), d2_two(a->scale, a->scale) };
}

/* The corners' X, rounded to the next floats; each has 0 behind it. */
V void corners_x(const struct to_x *x, const struct corners *c, q4 out[3])
{
	UNROLL for (unsigned k = 0; k < 3; k++)
		out[k] = q4_round(d2_mul(d2_sub(c->xy[k], x->centre_xy), x->scale),
				  d2_mul(d2_sub(c->z[k], x->centre_z), x->scale));
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
	struct corners c;
	q4 v[3];

	read_corners(p, id, &c);
	corners_x(x, &c, v);
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
