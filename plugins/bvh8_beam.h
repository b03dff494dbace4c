/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A ray as bvh8's floats see it, and what it does with nodes and blocks. See bvh8.h for coordinates and
 * error bounds.
 *
 * Boxes: Ize: Robust BVH Ray Traversal, JCGT 2(2), 2013, but with absolute bounds. Blocks: the sheared edge
 * functions of Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, JCGT 2(1), 2013.
 */
#ifndef BVH8_BEAM_H
#define BVH8_BEAM_H

#include "bvh8.h"
#include "bvh8_vec.h"

#define INTERLEAVE_MAX 16u

struct beam {
	float inverse[3], near_o[3], far_o[3]; /* plane * inverse + near_o is the entrance */
	uint32_t near[3], far[3]; /* which planes of a node */
	float tfar; /* nothing beyond counts */
	float o[3], shear[2]; /* by kx, ky, kz; o[2] and zfar count along the ray: times side */
	float side, zfar, depth, grow;
	uint32_t axis[3];
	double shift, tscale; /* t of the walk = (t - shift) * tscale */
	const ald_ray *ray;
	ald_hit *hit;
	ald_prep prep;
};

/* 2^-exponent of x, a normal number, as frexp() has it. */
V double unscale(double x)
{
	uint64_t b;

	memcpy(&b, &x, sizeof(b));
	b = (2045 - (b >> 52 & 2047)) << 52;
	memcpy(&x, &b, sizeof(x));
	return x;
}

/* hit->t is new. */
V void beam_limit(struct beam *b)
{
	double t = (b->hit->t - b->shift) * b->tscale;

	b->tfar = (float)(t < 8 ? t : 8) * (1 + 0x1p-20f) + 0x1p-30f;
	b->zfar = b->tfar * b->depth + 4 * EDGE_ERROR * b->grow;
}

/* 0: the ray misses everything. A ray that misses all triangles by its numbers alone has axis[0] > 2. */
V int beam_begin(const ald_accel *a, struct beam *b, const ald_ray *ray, ald_hit *hit)
{
	ald_prep *p = &b->prep;
	float error, pad;
	double unit;

	b->ray = ray;
	b->hit = hit;
	ald_ray_prep(&a->frame, ray, p);
	b->axis[0] = p->shear[0] == p->shear[0] ? p->kx : 3;
	if (!ald_box_ray(p, &a->box, ray->tmin, hit->t, &b->shift))
		return 0;
	if (b->axis[0] > 2)
		return 1;
	unit = unscale(p->d[p->kz]);
	b->tscale = a->scale / unit;
	pad = (float)((4 * p->pad + 2 * a->prims->pad) * a->scale);
	error = BOX_ERROR + pad;
	for (unsigned k = 0; k < 3; k++) {
		double o = ((p->o[k] - a->centre[k]) + b->shift * p->d[k]) * a->scale;
		float d = (float)(p->d[k] * unit), f = (float)o;

		/* Over all the way there is, 2^-40 is less than rounding. */
		d = p->sign[k] ? (d > -0x1p-40f ? -0x1p-40f : d) : (d < 0x1p-40f ? 0x1p-40f : d);
		b->inverse[k] = 1 / d;
		b->near_o[k] = -(p->sign[k] ? f - error : f + error) * b->inverse[k];
		b->far_o[k] = -(p->sign[k] ? f + error : f - error) * b->inverse[k];
		b->near[k] = 2 * k + p->sign[k];
		b->far[k] = b->near[k] ^ 1;
		b->o[k == p->kx ? 0 : k == p->ky ? 1 : 2] = f;
	}
	b->axis[1] = p->ky;
	b->axis[2] = p->kz;
	b->side = p->sign[p->kz] ? -1.0f : 1.0f;
	b->shear[0] = (float)p->shear[0] * b->side;
	b->shear[1] = (float)p->shear[1] * b->side;
	b->o[2] *= b->side;
	b->depth = (float)fabs(p->d[p->kz] * unit);
	b->grow = 1 + 4 * pad / EDGE_ERROR;
	b->grow *= b->grow;
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

/* The triangles of a block that may be hit before tfar. */
V uint32_t beam_block(const struct beam *b, const struct block *n)
{
	const float(*v0)[SEATS] = n->v[0], (*v1)[SEATS] = n->v[1], (*v2)[SEATS] = n->v[2];
	uint32_t x = b->axis[0], y = b->axis[1], z = b->axis[2];
	f4 ox = f4_all(b->o[0]), oy = f4_all(b->o[1]), oz = f4_all(b->o[2]), side = f4_all(b->side);
	f4 sx = f4_all(b->shear[0]), sy = f4_all(b->shear[1]);
	f4 az = f4_mul_sub(f4_load(v0[z]), side, oz);
	f4 bz = f4_mul_sub(f4_load(v1[z]), side, oz);
	f4 cz = f4_mul_sub(f4_load(v2[z]), side, oz);
	f4 ax = f4_sub_mul(f4_sub(f4_load(v0[x]), ox), sx, az), ay = f4_sub_mul(f4_sub(f4_load(v0[y]), oy), sy, az);
	f4 bx = f4_sub_mul(f4_sub(f4_load(v1[x]), ox), sx, bz), by = f4_sub_mul(f4_sub(f4_load(v1[y]), oy), sy, bz);
	f4 cx = f4_sub_mul(f4_sub(f4_load(v2[x]), ox), sx, cz), cy = f4_sub_mul(f4_sub(f4_load(v2[y]), oy), sy, cz);
	f4 wa = f4_mul_sub(cx, by, f4_mul(cy, bx));
	f4 wb = f4_mul_sub(ax, cy, f4_mul(ay, cx));
	f4 wc = f4_mul_sub(bx, ay, f4_mul(by, ax));
	f4 slack = f4_mul(f4_load(n->slack), f4_all(b->grow));
	uint32_t front = f4_le(f4_negate(slack), f4_min(wa, f4_min(wb, wc)));
	uint32_t back = f4_le(f4_max(wa, f4_max(wb, wc)), slack);

	return (front | back) & f4_le(f4_min(az, f4_min(bz, cz)), f4_all(b->zfar));
}

V int beam_triangle(const ald_accel *a, struct beam *b, uint32_t id)
{
	const ald_prims *prims = a->prims;
	ald_vec v[3];

	if (!ald_sees(prims, b->ray, id))
		return 0;
	ald_corners(prims, id, prims->origin ? ald_group_of(prims, id) : 0, v);
	if (!ald_triangle(&b->prep, b->ray, v, id, b->hit))
		return 0;
	beam_limit(b);
	return 1;
}

V int beam_blocks(const ald_accel *a, struct beam *b, uint32_t ref, int any)
{
	const struct block *n = &a->block[ref & REF_INDEX];
	const struct block *end = n + (ref >> REF_SHIFT & 7) + 1;
	int found = 0;

	for (; n < end; n++) {
		for (uint32_t m = beam_block(b, n); m; m &= m - 1) {
			found |= beam_triangle(a, b, n->id[__builtin_ctz(m)]);
			if (found && any)
				return 1;
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
	return ref >= REF_OTHERS ? beam_others(a, q, b, ref, any) : beam_blocks(a, b, ref, any);
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
