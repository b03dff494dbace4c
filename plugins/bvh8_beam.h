/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A ray as bvh8's floats see it, and what it does with nodes and blocks. See bvh8.h for coordinates and
 * error bounds.
 *
 * Boxes: Ize: Robust BVH Ray Traversal, JCGT 2(2), 2013, but with absolute bounds. Blocks: the sheared edge
 * functions of Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, JCGT 2(1), 2013.
 *
 * Most triangles that are hit are so beyond the doubt of floats. Then the upper bound of the distance culls
 * what lies behind at once, and the doubles are asked at the walk's end, for the nearest only; where any hit
 * will do they are not asked at all.
 */
#ifndef BVH8_BEAM_H
#define BVH8_BEAM_H

#include "bvh8.h"
#include "bvh8_vec.h"

#define PENDING 8u
#define DEPTH_ERROR (4 * EDGE_ERROR) /* of a distance along the main axis */

struct beam {
	float inverse[3], near_o[3], far_o[3]; /* plane * inverse + near_o is the entrance */
	uint32_t near[3], far[3]; /* which planes of a node */
	float tfar; /* nothing beyond counts */
	/* By kx, ky, kz; distances along kz, those called z, count the way the ray goes. */
	float o[3], shear[2], side;
	float zfar, zerror; /* zfar: as tfar, and zerror more */
	float sure_lo, sure_hi; /* a z between is of a t that counts */
	float depth, back; /* z = t depth, t = z back */
	float grow, reach; /* of slacks, for rays from far away; twice a triangle's extent is slack * reach */
	uint32_t axis[3];
	uint32_t pending; /* triangles that may be hit, to be asked about at the end */
	uint32_t id[PENDING];
	float low[PENDING]; /* no t of theirs is less */
	float high[PENDING]; /* of those that are hit for sure, none is more; else infinite */
	double shift, tscale; /* t of the walk = (t - shift) * tscale */
	const ald_ray *ray;
	ald_hit *hit;
	ald_prep prep;
};

/* 2^-exponent and 2^exponent of x, a normal number, as frexp() has it. */
V void units(double x, double *down, double *up)
{
	uint64_t b, c;

	memcpy(&b, &x, sizeof(b));
	b = b >> 52 & 2047;
	c = (b + 1) << 52;
	b = (2045 - b) << 52;
	memcpy(down, &b, sizeof(b));
	memcpy(up, &c, sizeof(c));
}

V float walk_t(const struct beam *b, double t)
{
	t = (t - b->shift) * b->tscale;
	return (float)(t < 8 ? (t > -8 ? t : -8) : 8);
}

V void beam_cut(struct beam *b, float t)
{
	b->tfar = t;
	b->zfar = t * b->depth + b->zerror;
}

/* hit->t is new. */
V void beam_limit(struct beam *b)
{
	float t = walk_t(b, b->hit->t) * (1 + 0x1p-20f) + 0x1p-30f;

	if (t < b->tfar)
		beam_cut(b, t);
}

V void beam_axes(struct beam *b, const ald_accel *a, double unit, double back)
{
	const ald_prep *p = &b->prep;
	float pad = (float)((4 * p->pad + 2 * a->prims->pad) * a->scale), error = a->fast ? 0 : BOX_ERROR + pad;
	float o[3];

	for (unsigned k = 0; k < 3; k++) {
		float i = (float)(p->inv[k] * back);

		o[k] = (float)(((p->o[k] - a->centre[k]) + b->shift * p->d[k]) * a->scale);
		/* Over all the way there is, 2^-40 is less than rounding. */
		i = i < 0x1p40f ? (i > -0x1p40f ? i : -0x1p40f) : 0x1p40f;
		b->inverse[k] = i;
		b->near_o[k] = -(o[k] + (p->sign[k] ? -error : error)) * i;
		b->far_o[k] = -(o[k] + (p->sign[k] ? error : -error)) * i;
		b->near[k] = 2 * k + p->sign[k];
		b->far[k] = b->near[k] ^ 1;
	}
	b->axis[1] = p->ky;
	b->axis[2] = p->kz;
	b->side = p->sign[p->kz] ? -1.0f : 1.0f;
	b->o[0] = o[p->kx];
	b->o[1] = o[p->ky];
	b->o[2] = o[p->kz] * b->side;
	b->shear[0] = (float)p->shear[0] * b->side;
	b->shear[1] = (float)p->shear[1] * b->side;
	b->depth = (float)(p->d[p->kz] * unit) * b->side;
	b->back = b->inverse[p->kz] * b->side;
	b->zerror = 1 + 4 * pad / EDGE_ERROR;
	b->grow = b->zerror * b->zerror;
	b->zerror *= DEPTH_ERROR;
	b->reach = 1 / (6 * EDGE_ERROR) / b->grow;
	if (a->fast)
		b->grow = b->zerror = 0;
}

/* 0: the ray misses everything. A ray that misses all triangles by its numbers alone has axis[0] > 2. */
V int beam_begin(const ald_accel *a, struct beam *b, const ald_ray *ray, ald_hit *hit)
{
	ald_prep *p = &b->prep;
	double unit, back;

	b->ray = ray;
	b->hit = hit;
	b->pending = 0;
	ald_ray_prep(&a->frame, ray, p);
	b->axis[0] = p->shear[0] == p->shear[0] ? p->kx : 3;
	if (!ald_box_ray(p, &a->box, ray->tmin, hit->t, &b->shift))
		return 0;
	if (b->axis[0] > 2)
		return 1;
	units(p->d[p->kz], &unit, &back);
	b->tscale = a->scale * back;
	beam_axes(b, a, unit, back);
	b->sure_lo = walk_t(b, ray->tmin) * b->depth + b->zerror;
	b->sure_hi = walk_t(b, hit->t) * b->depth - b->zerror;
	b->tfar = INFINITY;
	beam_limit(b);
	return 1;
}

/* The children that the ray enters, and where. */
V uint32_t beam_node(const struct beam *b, const struct node *n, float enter[WIDTH])
{
	f8 t0 = f8_mul_add(f8_load(n->plane[b->near[0]]), f8_all(b->inverse[0]), f8_all(b->near_o[0]));
	f8 t1 = f8_mul_add(f8_load(n->plane[b->far[0]]), f8_all(b->inverse[0]), f8_all(b->far_o[0]));
	f8 y0 = f8_mul_add(f8_load(n->plane[b->near[1]]), f8_all(b->inverse[1]), f8_all(b->near_o[1]));
	f8 y1 = f8_mul_add(f8_load(n->plane[b->far[1]]), f8_all(b->inverse[1]), f8_all(b->far_o[1]));
	f8 z0 = f8_mul_add(f8_load(n->plane[b->near[2]]), f8_all(b->inverse[2]), f8_all(b->near_o[2]));
	f8 z1 = f8_mul_add(f8_load(n->plane[b->far[2]]), f8_all(b->inverse[2]), f8_all(b->far_o[2]));

	t0 = f8_max(f8_max(t0, y0), f8_max(z0, f8_all(0)));
	t1 = f8_min(f8_min(t1, y1), f8_min(z1, f8_all(b->tfar)));
	f8_store(enter, t0);
	return f8_le(t0, t1);
}

struct meeting { /* of a ray with the triangles of a block */
	f4 a, b, c, az, bz, cz, slack; /* weights of the corners; z of the corners */
	f4 zmin, wide; /* wide: the largest sheared coordinate */
	uint32_t maybe; /* the lanes that may be hit before tfar */
};

V void beam_block(const struct beam *b, const struct block *n, struct meeting *m)
{
	const float(*v0)[SEATS] = n->v[0], (*v1)[SEATS] = n->v[1], (*v2)[SEATS] = n->v[2];
	uint32_t x = b->axis[0], y = b->axis[1], z = b->axis[2];
	f4 ox = f4_all(b->o[0]), oy = f4_all(b->o[1]), oz = f4_all(b->o[2]), side = f4_all(b->side);
	f4 sx = f4_all(b->shear[0]), sy = f4_all(b->shear[1]), ax, ay, bx, by, cx, cy;

	m->az = f4_mul_sub(f4_load(v0[z]), side, oz);
	m->bz = f4_mul_sub(f4_load(v1[z]), side, oz);
	m->cz = f4_mul_sub(f4_load(v2[z]), side, oz);
	ax = f4_sub_mul(f4_sub(f4_load(v0[x]), ox), sx, m->az);
	ay = f4_sub_mul(f4_sub(f4_load(v0[y]), oy), sy, m->az);
	bx = f4_sub_mul(f4_sub(f4_load(v1[x]), ox), sx, m->bz);
	by = f4_sub_mul(f4_sub(f4_load(v1[y]), oy), sy, m->bz);
	cx = f4_sub_mul(f4_sub(f4_load(v2[x]), ox), sx, m->cz);
	cy = f4_sub_mul(f4_sub(f4_load(v2[y]), oy), sy, m->cz);
	m->a = f4_mul_sub(cx, by, f4_mul(cy, bx));
	m->b = f4_mul_sub(ax, cy, f4_mul(ay, cx));
	m->c = f4_mul_sub(bx, ay, f4_mul(by, ax));
	m->wide = f4_max(f4_max(f4_max(f4_size(ax), f4_size(ay)), f4_max(f4_size(bx), f4_size(by))),
			 f4_max(f4_size(cx), f4_size(cy)));
	m->slack = f4_mul(f4_load(n->slack), f4_all(b->grow));
	m->zmin = f4_min(m->az, f4_min(m->bz, m->cz));
	m->maybe = f4_le(f4_negate(m->slack), f4_min(m->a, f4_min(m->b, m->c)));
	m->maybe |= f4_le(f4_max(m->a, f4_max(m->b, m->c)), m->slack);
	m->maybe &= f4_le(m->zmin, f4_all(b->zfar));
}

/* Bounds on the z of a hit, low[1] for the lanes that are hit for sure, at a t that counts: those that are
 * returned.
 *
 * Where a coordinate is wider than a hit's can be, slack is no bound.
 * z is the mean of the corners' by weights that are off by slack each; with S the spread of the corners, D the
 * sum of the weights, it is off by at most 3 slack S / (D - 3 slack), and a few roundings, which zerror
 * covers, as it does what the kernel's own t may be off by, in doubles and with D > 3 slack. */
V uint32_t beam_sure(const struct beam *b, const struct meeting *m, float low[2][SEATS], float high[SEATS])
{
	f4 sum = f4_add(f4_add(m->a, m->b), m->c), three = f4_mul(m->slack, f4_all(3));
	f4 z = f4_mul_add(m->a, m->az, f4_mul_add(m->b, m->bz, f4_mul(m->c, m->cz)));
	f4 zmax = f4_max(m->az, f4_max(m->bz, m->cz)), off, lo, hi, unsure;
	uint32_t sure;

	z = f4_div(z, sum);
	off = f4_mul(three, f4_sub(zmax, m->zmin));
	off = f4_div(off, f4_max(f4_sub(f4_size(sum), three), f4_all(0x1p-100f)));
	off = f4_add(off, f4_all(b->zerror));
	lo = f4_sub(z, off);
	hi = f4_add(z, off);
	unsure = f4_sub(m->zmin, f4_all(b->zerror));
	sure = f4_le(m->slack, f4_min(m->a, f4_min(m->b, m->c)));
	sure |= f4_le(f4_max(m->a, f4_max(m->b, m->c)), f4_negate(m->slack));
	sure &= f4_le(m->wide, f4_mul(m->slack, f4_all(b->reach)));
	sure &= f4_le(hi, f4_all(b->sure_hi)) & f4_le(f4_all(b->sure_lo), lo);
	f4_store(high, hi);
	f4_store(low[0], unsure);
	f4_store(low[1], f4_max(lo, unsure));
	return sure;
}

V int beam_triangle(const ald_accel *a, struct beam *b, uint32_t id)
{
	const ald_prims *prims = a->prims;
	ald_vec v[3];

	ald_corners(prims, id, prims->origin ? ald_group_of(prims, id) : 0, v);
	if (!ald_triangle(&b->prep, b->ray, v, id, b->hit))
		return 0;
	beam_limit(b);
	return 1;
}

/* In exact order the host rounds the winner's t. So where floats alone tell that a triangle is hit, at a t that
 * counts and before all else, it need not be asked about: their bounds on t do, rounded outward. */
V int beam_certain(struct beam *b)
{
	double low, high, back = 1 / b->tscale;
	uint32_t best = 0;

	if (b->hit->prim != ALD_NONE)
		return 0;
	for (uint32_t i = 1; i < b->pending; i++)
		best = b->low[i] < b->low[best] ? i : best;
	if (!(b->high[best] < INFINITY))
		return 0;
	for (uint32_t i = 0; i < b->pending; i++) {
		if (b->id[i] != b->id[best] && !(b->low[i] > b->high[best]))
			return 0;
	}
	low = (double)b->low[best] * back + b->shift;
	high = (double)b->high[best] * back + b->shift;
	*b->hit = (ald_hit){ .t = high + 4 * ALD_U * fabs(high), .u = low - 4 * ALD_U * fabs(low),
			     .prim = b->id[best] };
	b->pending = 0;
	return 1;
}

/* Ask the kernel about what is pending, the nearest first. */
V void beam_settle(const ald_accel *a, struct beam *b)
{
	if (a->frame.exact && b->pending && beam_certain(b))
		return;
	while (b->pending) {
		uint32_t best = 0, id;

		for (uint32_t i = 1; i < b->pending; i++)
			best = b->low[i] < b->low[best] ? i : best;
		id = b->id[best];
		if (b->low[best] > b->tfar)
			b->pending = 1; /* all others are farther still */
		else
			beam_triangle(a, b, id);
		b->id[best] = b->id[--b->pending];
		b->low[best] = b->low[b->pending]; /* high is of no use any more */
	}
}

V void beam_pend(const ald_accel *a, struct beam *b, uint32_t id, float low, float high)
{
	uint32_t kept = 0;

	if (b->pending == PENDING) {
		for (uint32_t i = 0; i < PENDING; i++) {
			if (b->low[i] > b->tfar)
				continue;
			b->id[kept] = b->id[i];
			b->high[kept] = b->high[i];
			b->low[kept++] = b->low[i];
		}
		b->pending = kept;
		if (kept == PENDING)
			beam_settle(a, b);
	}
	b->id[b->pending] = id;
	b->high[b->pending] = high;
	b->low[b->pending++] = low;
}

V int beam_blocks(const ald_accel *a, struct beam *b, uint32_t ref, int any)
{
	const struct block *n = &a->block[ref & REF_INDEX];
	const struct block *end = n + (ref >> REF_SHIFT & 7) + 1;
	float low[2][SEATS] __attribute__((aligned(16))), high[SEATS] __attribute__((aligned(16)));
	int found = 0;

	for (; n < end; n++) {
		struct meeting m;
		uint32_t sure;

		beam_block(b, n, &m);
		if (!m.maybe)
			continue;
		sure = beam_sure(b, &m, low, high);
		for (; m.maybe; m.maybe &= m.maybe - 1) {
			unsigned k = (unsigned)__builtin_ctz(m.maybe);
			uint32_t id = n->id[k];
			float z = low[sure >> k & 1][k], t = INFINITY;

			if (!ald_sees(a->prims, b->ray, id))
				continue;
			if (any) {
				if (sure >> k & 1 || beam_triangle(a, b, id))
					return 1;
				continue;
			}
			found = 1;
			if (sure >> k & 1) {
				t = high[k] * b->back * (1 + 0x1p-20f);
				if (t < b->tfar)
					beam_cut(b, t);
			}
			beam_pend(a, b, id, z * b->back * (z > 0 ? 1 - 0x1p-20f : 1 + 0x1p-20f), t);
		}
	}
	return found;
}

/* Where the line meets a triangle's plane, as the ray has it: the beam's own z goes with where the ray is
 * entered from, and one that goes on behind a hit would meet that again. */
V double beam_plane(const ald_accel *a, const struct beam *b, const struct block *n, unsigned k)
{
	double e[3], g[3], up = 0, across = 0;

	for (unsigned i = 0; i < 3; i++) {
		e[i] = (double)n->v[1][i][k] - (double)n->v[0][i][k];
		g[i] = (double)n->v[2][i][k] - (double)n->v[0][i][k];
	}
	for (unsigned i = 0; i < 3; i++) {
		unsigned x = i == 2 ? 0 : i + 1, y = x == 2 ? 0 : x + 1;
		double normal = e[x] * g[y] - e[y] * g[x];

		up += normal * ((double)n->v[0][i][k] - (b->prep.o[i] - a->centre[i]) * a->scale);
		across += normal * b->prep.d[i];
	}
	return up / (across * a->scale);
}

/* For --precision=fast: what the floats say. With their bounds at 0, a lane that may be hit is. */
V int beam_blocks_fast(const ald_accel *a, struct beam *b, uint32_t ref, int any)
{
	const struct block *n = &a->block[ref & REF_INDEX];
	const struct block *end = n + (ref >> REF_SHIFT & 7) + 1;
	float w[3][SEATS] __attribute__((aligned(16)));
	int found = 0;

	for (; n < end; n++) {
		struct meeting m;

		beam_block(b, n, &m);
		if (!m.maybe)
			continue;
		f4_store(w[0], m.b);
		f4_store(w[1], m.c);
		f4_store(w[2], f4_add(f4_add(m.a, m.b), m.c));
		for (; m.maybe; m.maybe &= m.maybe - 1) {
			unsigned k = (unsigned)__builtin_ctz(m.maybe);
			double t = beam_plane(a, b, n, k);
			ald_hit *h = b->hit;

			if (n->id[k] == ALD_NONE || !(fabsf(w[2][k]) > FLT_MIN) || !(fabs(t) <= DBL_MAX) ||
			    !ald_counts(b->ray, t, n->id[k], h) || !ald_sees(a->prims, b->ray, n->id[k]))
				continue;
			if (any)
				return 1;
			*h = (ald_hit){ .t = t, .u = (double)(w[0][k] / w[2][k]), .v = (double)(w[1][k] / w[2][k]),
					.prim = n->id[k] };
			beam_limit(b);
			found = 1;
		}
	}
	return found;
}

V int beam_others(const ald_accel *a, ald_query *q, struct beam *b, uint32_t ref, int any)
{
	const uint32_t *list = &a->other[ref & REF_INDEX];
	int found = 0;

	for (uint32_t i = 1; i <= list[0]; i++) {
		if (!ald_sees(a->prims, b->ray, list[i]) ||
		    !a->prims->intersect(a->prims, list[i], q, b->ray, b->hit))
			continue;
		found = 1;
		if (any)
			return 1;
		beam_limit(b);
	}
	return found;
}

V int beam_leaf(const ald_accel *a, ald_query *q, struct beam *b, uint32_t ref, int any)
{
	if (ref >= REF_OTHERS)
		return beam_others(a, q, b, ref, any);
	return a->fast ? beam_blocks_fast(a, b, ref, any) : beam_blocks(a, b, ref, any);
}

/* A ray whose numbers no triangle stands. */
V int beam_odd(const ald_accel *a, ald_query *q, struct beam *b, int any)
{
	int found = 0;

	for (uint32_t id = a->prims->tri_count; id < a->prims->count && !(found && any); id++) {
		if (ald_sees(a->prims, b->ray, id))
			found |= a->prims->intersect(a->prims, id, q, b->ray, b->hit);
	}
	return found;
}

#endif
