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
#include "isa.h"
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
	ISA_PARAM,
	{ NULL, NULL, 0, 0, 0, 0, NULL },
};

static size_t octree_scratch_size(const ald_accel *a)
{
	return seen_size(a->prims->count);
}

static void octree_intersect_n(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n,
			       uint32_t hints)
{
	(void)hints;
	a->isa->nearest(a, q, ray, hit, n);
}

static void octree_occluded_n(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden, uint32_t n,
			      uint32_t hints)
{
	(void)hints;
	a->isa->occluded(a, q, ray, hidden, n);
}

static int octree_intersect(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	double t = hit->t;
	uint32_t prim = hit->prim;

	a->isa->nearest(a, q, ray, hit, 1);
	return hit->t != t || hit->prim != prim;
}

static int octree_occluded(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	uint8_t hidden;

	a->isa->occluded(a, q, ray, &hidden, 1);
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
