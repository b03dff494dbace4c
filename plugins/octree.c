/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * octree: space cut in eight, again and again.
 *
 * Cells are open to every primitive that really touches them. A walk keeps one frame a level instead of
 * calling itself; a cell's box is never stored, only the distances at which the ray crosses its planes
 * are handed down (after Revelles, Urena, Lastra: An Efficient Parametric Algorithm for Octree
 * Traversal, 2000), and all eight children are tested in one go, with the pads of rule R4. In the ray's
 * own octant order, a child that another one hides has the greater number, so that counting upwards is
 * going front to back.
 */
#include "octree.h"
#include "seen.h"

static const char *const index_label[] = { "auto", "16", "32", NULL };
static const char *const shape_label[] = { "cube", "box", NULL };
static const char *const node_label[] = { "box", "sphere", NULL };
static const char *const walk_label[] = { "loop", "recursion", NULL };
static const ald_param params[] = {
	{ "depth", "levels below the root at most", ALD_INT, 16, 0, DEPTH_MAX, NULL },
	{ "leaf", "a cell with as many primitives is not split", ALD_INT, 32, 1, 65535, NULL },
	{ "price", "cost of a step in primitive tests: split where that pays; 0: always", ALD_REAL, 1, 0,
	  1000, NULL },
	{ "index", "bits of a node's index", ALD_CHOICE, INDEX_AUTO, 0, 2, index_label },
	{ "shape", "cells are cubes, or shaped as the scene's box", ALD_CHOICE, SHAPE_CUBE, 0, 1,
	  shape_label },
	{ "node", "what a cell is tested by: its box, or a sphere around it", ALD_CHOICE, NODE_BOX, 0, 1, node_label },
	{ "walk", "how the tree is gone through: in a loop, or by a function that calls itself", ALD_CHOICE, 0, 0, 1,
	  walk_label },
	{ NULL, NULL, 0, 0, 0, 0, NULL },
};

static size_t octree_scratch_size(const ald_accel *a)
{
	return seen_size(a->prims->count);
}

static void count_leaf(const ald_accel *a, struct seen *s, uint64_t *count, const struct leaf *leaf)
{
	count[ALD_COUNT_PRIMS] += leaf->tris + leaf->others;
	if (a->root_is_leaf)
		return;
	for (uint32_t i = 0; i < leaf->tris; i++)
		count[ALD_COUNT_REPEATS] += seen_again(s, a->prims->count,
						       a->id[leaf->block + i / ALD_LANES][i % ALD_LANES]);
	for (uint32_t i = 0; i < leaf->others; i++)
		count[ALD_COUNT_REPEATS] += seen_again(s, a->prims->count, a->other[leaf->other + i]);
}

#define CHUNK 256u /* rays that are looked at together */

#define FAST 0
#include "octree_walk.h"
#undef FAST
#define FAST 1
#include "octree_walk.h"

/* Counting is a second copy of the walk, so that it costs nothing when it is off; so are floats. */
ALD_INLINE int trace_one(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, int any, uint64_t *count)
{
	return a->fast ? trace_fast(a, q, ray, hit, any, count) : trace_right(a, q, ray, hit, any, count);
}

ALD_INLINE int trace_any(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	ald_hit hit = { .t = ray->tmax, .prim = ALD_NONE };

	return q->count ? trace_one(a, q, ray, &hit, 1, q->count) : trace_one(a, q, ray, &hit, 1, NULL);
}

/* 1: the line passes the scene's box, surely. m is its moment about the box's centre c; seen along an axis across
 * it and one of the box's, the box is as large as reach. far is more than all that rounding and pads (R4) may
 * shift. A NaN does not pass. */
ALD_INLINE int passes(const ald_accel *a, const ald_ray *r)
{
	const double *c = a->middle, *h = a->reach;
	double ox = r->org.x - c[0], oy = r->org.y - c[1], oz = r->org.z - c[2];
	double x = r->dir.x, y = r->dir.y, z = r->dir.z;
	double far = (fabs(ox) + fabs(oy) + fabs(oz) + a->frame.radius) * 0x1p-44;
	double hx = h[0] + far, hy = h[1] + far, hz = h[2] + far, dx = fabs(x), dy = fabs(y), dz = fabs(z);

	return (fabs(oy * z - oz * y) > hy * dz + hz * dy) | (fabs(oz * x - ox * z) > hz * dx + hx * dz) |
	       (fabs(ox * y - oy * x) > hx * dy + hy * dx);
}

/* The rays that do not: most of a batch may never come near. Returns how many; and how many have gone by. */
ALD_INLINE uint32_t near_box(const ald_accel *a, const ald_ray *ray, uint32_t n, uint16_t near[CHUNK])
{
	uint8_t past[CHUNK];
	uint32_t found = 0;

	for (uint32_t i = 0; i < n; i++)
		past[i] = a->ball > 0 ? 0 : (uint8_t)passes(a, &ray[i]);
	for (uint32_t i = 0; i < n; i++) {
		near[found] = (uint16_t)i;
		found += !past[i];
	}
	return found;
}

WIDE static void octree_intersect_n(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit,
				    uint32_t n, uint32_t hints)
{
	uint16_t near[CHUNK];

	(void)hints;
	for (uint32_t at = 0; at < n; at += CHUNK) {
		uint32_t some = n - at < CHUNK ? n - at : CHUNK, m = near_box(a, ray + at, some, near);

		if (q->count)
			q->count[ALD_COUNT_VOLUME_TESTS] += some - m;
		for (uint32_t i = 0; i < m && !q->count; i++)
			trace_one(a, q, &ray[at + near[i]], &hit[at + near[i]], 0, NULL);
		for (uint32_t i = 0; i < m && q->count; i++)
			trace_one(a, q, &ray[at + near[i]], &hit[at + near[i]], 0, q->count);
	}
}

WIDE static void octree_occluded_n(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden,
				   uint32_t n, uint32_t hints)
{
	uint16_t near[CHUNK];

	(void)hints;
	memset(hidden, 0, n);
	for (uint32_t at = 0; at < n; at += CHUNK) {
		uint32_t some = n - at < CHUNK ? n - at : CHUNK, m = near_box(a, ray + at, some, near);

		if (q->count)
			q->count[ALD_COUNT_VOLUME_TESTS] += some - m;
		for (uint32_t i = 0; i < m; i++)
			hidden[at + near[i]] = (uint8_t)trace_any(a, q, &ray[at + near[i]]);
	}
}

static int octree_intersect(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	double t = hit->t;
	uint32_t prim = hit->prim;

	octree_intersect_n(a, q, ray, hit, 1, 0);
	return hit->t != t || hit->prim != prim;
}

static int octree_occluded(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	uint8_t hidden;

	octree_occluded_n(a, q, ray, &hidden, 1, 0);
	return hidden;
}

/* ---- what it looks like ---- */

static int octree_stat(const ald_accel *a, uint32_t i, const char **name, double *value)
{
	const struct {
		const char *name;
		double value;
	} list[] = {
		{ "nodes", (double)a->inner + a->leaves },
		{ "leaves", a->leaves },
		{ "depth", a->depth },
		{ "references", (double)a->refs },
		{ "index bits", a->wide ? 32 : 16 },
		{ "memory", (double)a->bytes },
	};

	if (i >= sizeof(list) / sizeof(list[0]))
		return 0;
	*name = list[i].name;
	*value = list[i].value;
	return 1;
}

static int octree_walk(const ald_accel *a, const ald_ray *only, ald_visit *visit, void *arg)
{
	struct {
		double c[3];
		uint32_t index, depth;
	} stack[8 * DEPTH_MAX + 1], s;
	uint32_t top = 0;
	ald_prep p;

	if (only)
		ald_ray_prep(&a->frame, only, &p);
	memcpy(stack[0].c, a->centre, sizeof(s.c));
	stack[0].index = stack[0].depth = 0;
	for (top = 1; top;) {
		ald_volume v = { .kind = ALD_VOLUME_BOX };
		double enter, h[3];
		int more;

		s = stack[--top];
		for (unsigned k = 0; k < 3; k++) {
			h[k] = ldexp(a->half[k], -(int)s.depth);
			(&v.box.lo.x)[k] = s.c[k] - h[k];
			(&v.box.hi.x)[k] = s.c[k] + h[k];
		}
		if (a->ball > 0) {
			v.kind = ALD_VOLUME_SPHERE;
			v.box.lo = (ald_vec){ s.c[0], s.c[1], s.c[2] };
			v.box.hi = (ald_vec){ ldexp(a->ball, -(int)s.depth) + a->ball_pad, 0, 0 };
			if (only && !ald_sphere_ray(&p, &v.box.lo, v.box.hi.x, only->tmin, only->tmax, &enter))
				continue;
		} else if (only && !ald_box_ray(&p, &v.box, only->tmin, only->tmax, &enter)) {
			continue;
		}
		v.depth = s.depth;
		if (s.index >= a->inner)
			v.prims = a->leaf[s.index - a->inner].tris + a->leaf[s.index - a->inner].others;
		more = visit(arg, &v);
		if (more < 0)
			return -1;
		for (unsigned k = 8; k-- > 0 && more && s.index < a->inner;) {
			size_t at = 8 * (size_t)s.index + k;

			if (!(a->kids[s.index] >> k & 1))
				continue;
			for (unsigned i = 0; i < 3; i++)
				stack[top].c[i] = k >> i & 1 ? s.c[i] + h[i] / 2 : s.c[i] - h[i] / 2;
			stack[top].index = a->wide ? a->wide[at] : a->narrow[at];
			stack[top++].depth = s.depth + 1;
		}
	}
	return 0;
}

const ald_accel_plugin ald_accel_entry = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "octree",
	.version = "1",
	.license = "Apache-2.0",
	.summary = "octree of cells that hold what really touches them",
	.params = params,
	.precisions = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT | ALD_PRECISION_FAST,
	.build = octree_build,
	.intersect = octree_intersect,
	.destroy = octree_destroy,
	.scratch_size = octree_scratch_size,
	.occluded = octree_occluded,
	.intersect_n = octree_intersect_n,
	.occluded_n = octree_occluded_n,
	.stat = octree_stat,
	.walk = octree_walk,
};
