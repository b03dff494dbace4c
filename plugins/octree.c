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

static const char *const index_label[] = { "auto", "16", "32", NULL };
static const char *const shape_label[] = { "cube", "box", NULL };
static const ald_param params[] = {
	{ "depth", "levels below the root at most", ALD_INT, 16, 0, DEPTH_MAX, NULL },
	{ "leaf", "a cell with as many primitives is not split", ALD_INT, 16, 1, 65535, NULL },
	{ "price", "cost of a step in primitive tests: split where that pays; 0: always", ALD_REAL, 1, 0,
	  1000, NULL },
	{ "index", "bits of a node's index", ALD_CHOICE, INDEX_AUTO, 0, 2, index_label },
	{ "shape", "cells are cubes, or shaped as the scene's box", ALD_CHOICE, SHAPE_CUBE, 0, 1,
	  shape_label },
	{ NULL, NULL, 0, 0, 0, 0, NULL },
};

struct frame { /* an inner cell on the way down; halves: 0 the nearer, 1 the farther along the ray */
	double enter[8]; /* its children: where the ray enters them */
	double en[2][3], ex[2][3]; /* where it enters and leaves the halves */
	double c[3];
	uint32_t node;
	uint8_t todo, useful; /* children still to visit, in the ray's order; was anything hit inside? */
};

struct walk {
	const ald_accel *a;
	ald_query *q;
	const ald_ray *ray;
	ald_hit *hit;
	uint64_t *count; /* NULL: do not */
	struct seen *seen;
	ald_prep p;
	double t0, t1; /* the part of the ray that is inside of everything's box */
	uint32_t flip;
	struct frame frame[DEPTH_MAX];
};

/* For counting only: which primitives this ray has met. A ray that meets more than half of SEEN different
 * ones has repeats of the others counted as first tests. */
#define SEEN 4096
struct seen {
	uint32_t ray, used;
	struct {
		uint32_t id, ray;
	} slot[]; /* seen_slots() */
};

static uint32_t seen_slots(const ald_accel *a)
{
	uint32_t n = 16;

	while (n < SEEN && n / 2 < a->prims->count)
		n *= 2;
	return n;
}

static size_t octree_scratch_size(const ald_accel *a)
{
	return sizeof(struct seen) + seen_slots(a) * (size_t)8;
}

static void seen_add(struct walk *w, uint32_t id)
{
	struct seen *s = w->seen;
	uint32_t n = seen_slots(w->a), i = (id * 2654435761u >> 16) & (n - 1);

	while (s->slot[i].ray == s->ray && s->slot[i].id != id)
		i = (i + 1) & (n - 1);
	if (s->slot[i].ray == s->ray) {
		w->count[ALD_COUNT_REPEATS]++;
	} else if (s->used < n / 2) {
		s->used++;
		s->slot[i].ray = s->ray;
		s->slot[i].id = id;
	}
}

static void count_leaf(struct walk *w, const struct leaf *leaf)
{
	w->count[ALD_COUNT_PRIMS] += leaf->tris + leaf->others;
	if (w->a->root_is_leaf)
		return;
	for (uint32_t i = 0; i < leaf->tris; i++)
		seen_add(w, w->a->id[leaf->block + i / ALD_LANES][i % ALD_LANES]);
	for (uint32_t i = 0; i < leaf->others; i++)
		seen_add(w, w->a->other[leaf->other + i]);
}

static void count_useful(struct walk *w, int depth)
{
	w->count[ALD_COUNT_VOLUME_USEFUL]++; /* the leaf */
	for (; depth >= 0 && !w->frame[depth].useful; depth--) {
		w->frame[depth].useful = 1;
		w->count[ALD_COUNT_VOLUME_USEFUL]++;
	}
}

ALD_INLINE int test_leaf(struct walk *w, const struct leaf *leaf, int any)
{
	const ald_accel *a = w->a;
	int found = 0;

	for (uint32_t at = leaf->block; at < leaf->block + (leaf->tris + ALD_LANES - 1) / ALD_LANES;
	     at++) {
		const ald_triangles *b = &a->block[at];

		for (uint32_t m = ald_triangle_n(&w->p, b); m; m &= m - 1) {
			unsigned i = (unsigned)__builtin_ctz(m);
			uint32_t id = a->id[at][i];
			ald_vec v[3];

			if (id == ALD_NONE || !ald_sees(a->prims, w->ray, id))
				continue;
			for (unsigned k = 0; k < 3; k++)
				v[k] = (ald_vec){ b->v[k][0][i], b->v[k][1][i], b->v[k][2][i] };
			found |= ald_triangle(&w->p, w->ray, v, id, w->hit);
			if (any && found)
				return 1;
		}
	}
	for (uint32_t i = 0; i < leaf->others; i++) {
		uint32_t id = a->other[leaf->other + i];

		if (ald_sees(a->prims, w->ray, id))
			found |= a->prims->intersect(a->prims, id, w->q, w->ray, w->hit);
		if (any && found)
			return 1;
	}
	return found;
}

/* f has its centre, and the ray's way into its nearer and out of its farther halves: the rest. */
ALD_INLINE void open_cell(const struct walk *w, struct frame *f, uint32_t node)
{
	static const int64_t far[3][8] = CHILD_BITS;
	double t0 = w->t0, t1 = ald_min(w->hit->t, w->t1), leave[8];
	uint32_t kids = w->a->kids[node];
	int64_t in[8];

	EACH(i) {
		f->enter[i] = t0;
		leave[i] = t1;
	}
	for (unsigned k = 0; k < 3; k++) {
		double en0 = f->en[0][k], en1 = (f->c[k] - w->p.near_o[k]) * w->p.inv[k];
		double ex0 = (f->c[k] - w->p.far_o[k]) * w->p.inv[k], ex1 = f->ex[1][k];

		f->en[1][k] = en1;
		f->ex[0][k] = ex0;
		EACH(i) {
			double en = far[k][i] ? en1 : en0, ex = far[k][i] ? ex1 : ex0;

			f->enter[i] = en > f->enter[i] ? en : f->enter[i]; /* a NaN is not kept */
			leave[i] = ex < leave[i] ? ex : leave[i];
		}
	}
	EACH(i)
		in[i] = !(f->enter[i] > leave[i]);
	if (w->flip & 1)
		kids = (kids >> 1 & 0x55) | (kids & 0x55) << 1;
	if (w->flip & 2)
		kids = (kids >> 2 & 0x33) | (kids & 0x33) << 2;
	if (w->flip & 4)
		kids = (kids >> 4 & 0x0f) | (kids & 0x0f) << 4;
	f->node = node;
	f->useful = 0;
	f->todo = (uint8_t)(kids & lanes(in));
	if (w->count) {
		w->count[ALD_COUNT_VOLUME_TESTS] += (unsigned)__builtin_popcount(kids);
		w->count[ALD_COUNT_NODES]++;
	}
}

ALD_INLINE void descend(const struct walk *w, const struct frame *f, struct frame *down, unsigned kid,
			   double scale)
{
	for (unsigned k = 0; k < 3; k++) {
		unsigned far = kid >> k & 1;
		double h = w->a->half[k] * scale;

		down->en[0][k] = f->en[far][k];
		down->ex[1][k] = f->ex[far][k];
		down->c[k] = (far ^ (w->flip >> k)) & 1 ? f->c[k] + h : f->c[k] - h;
	}
}

ALD_INLINE int walk_down(struct walk *w, int any)
{
	const ald_accel *a = w->a;
	struct frame *f = w->frame;
	double scale = 0.5;
	int depth = 0, found = 0;

	open_cell(w, f, 0);
	for (;;) {
		uint32_t next;
		unsigned kid;

		if (!f->todo) {
			if (!depth--)
				return found;
			f--;
			scale *= 2;
			continue;
		}
		kid = (unsigned)__builtin_ctz(f->todo);
		f->todo &= (uint8_t)(f->todo - 1);
		if (f->enter[kid] > w->hit->t)
			continue;
		if (w->count)
			w->count[ALD_COUNT_VOLUME_HITS]++;
		next = 8 * f->node + (kid ^ w->flip);
		next = a->wide ? a->wide[next] : a->narrow[next];
		if (next < a->inner) {
			descend(w, f, f + 1, kid, scale);
			open_cell(w, ++f, next);
			depth++;
			scale *= 0.5;
			continue;
		}
		if (w->count)
			count_leaf(w, &a->leaf[next - a->inner]);
		if (test_leaf(w, &a->leaf[next - a->inner], any)) {
			found = 1;
			if (w->count)
				count_useful(w, depth);
			if (any)
				return 1;
		}
	}
}

/* The ray's way through everything's box; 0: it misses it. */
ALD_INLINE int enter_root(struct walk *w)
{
	const ald_accel *a = w->a;
	const double *lo = &a->box.lo.x, *hi = &a->box.hi.x;
	struct frame *f = w->frame;

	ald_ray_prep(&a->frame, w->ray, &w->p);
	w->t0 = w->ray->tmin;
	w->t1 = w->hit->t;
	w->flip = w->p.sign[0] | w->p.sign[1] << 1 | w->p.sign[2] << 2;
	for (unsigned k = 0; k < 3; k++) {
		double near_o = w->p.near_o[k], far_o = w->p.far_o[k], inv = w->p.inv[k];
		double h = w->p.sign[k] ? -a->half[k] : a->half[k];

		w->t0 = ald_max(((w->p.sign[k] ? hi[k] : lo[k]) - near_o) * inv, w->t0);
		w->t1 = ald_min(((w->p.sign[k] ? lo[k] : hi[k]) - far_o) * inv, w->t1);
		f->c[k] = a->centre[k];
		f->en[0][k] = (a->centre[k] - h - near_o) * inv;
		f->ex[1][k] = (a->centre[k] + h - far_o) * inv;
	}
	return !(w->t0 > w->t1);
}

ALD_INLINE int trace(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, int any,
			uint64_t *count)
{
	struct walk w;
	int found;

	w.a = a;
	w.q = q;
	w.ray = ray;
	w.hit = hit;
	w.count = count;
	if (count) {
		count[ALD_COUNT_VOLUME_TESTS]++;
		w.seen = q->scratch;
		w.seen->used = 0;
		if (!++w.seen->ray) { /* 2^32 rays later: slots of old would look new */
			memset(w.seen, 0, octree_scratch_size(a));
			w.seen->ray = 1;
		}
	}
	if (!enter_root(&w))
		return 0;
	if (count)
		count[ALD_COUNT_VOLUME_HITS]++;
	if (!a->root_is_leaf)
		return walk_down(&w, any);
	if (count)
		count_leaf(&w, &a->leaf[0]);
	found = test_leaf(&w, &a->leaf[0], any);
	if (count && found)
		count_useful(&w, -1);
	return found;
}

/* Counting is a second copy of the walk, so that it costs nothing when it is off. */
ALD_INLINE int trace_any(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	ald_hit hit = { .t = ray->tmax, .prim = ALD_NONE };

	return q->count ? trace(a, q, ray, &hit, 1, q->count) : trace(a, q, ray, &hit, 1, NULL);
}

WIDE static void octree_intersect_n(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit,
				    uint32_t n, uint32_t hints)
{
	(void)hints;
	for (uint32_t i = 0; i < n && !q->count; i++)
		trace(a, q, &ray[i], &hit[i], 0, NULL);
	for (uint32_t i = 0; i < n && q->count; i++)
		trace(a, q, &ray[i], &hit[i], 0, q->count);
}

WIDE static void octree_occluded_n(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden,
				   uint32_t n, uint32_t hints)
{
	(void)hints;
	for (uint32_t i = 0; i < n; i++)
		hidden[i] = (uint8_t)trace_any(a, q, &ray[i]);
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
		if (only && !ald_box_ray(&p, &v.box, only->tmin, only->tmax, &enter))
			continue;
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
	.precisions = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT,
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
