/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The same tree for primitives that have moved: from the leaves up, boxes, blocks and orders are made anew by what
 * made them (Wald, Boulos, Shirley: Ray Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies, 2007).
 * Of a triangle that stands in several leaves each holds the whole, as where it was cut has no meaning any more.
 *
 * A tree gets worse as its primitives leave those that they were near to. How much is told by what a ray is expected
 * to open from each node on (the surface area heuristic), summed over all nodes, each as often as there are references
 * below: so a small thing in a large scene counts by its triangles, and not by how seldom rays come there. What
 * rays lose in frame after frame is noted, and when it has come to what building takes, the tree is given up, as
 * nobody knows how often it is going to serve.
 */
#include <stdatomic.h>

#include "bvh8_corner.h"

#define JOBS 256u /* parts of the tree, about; no result depends on it */
#define TOP_MAX 4096u /* nodes above them, and they */

/* Measured, in nanoseconds of one thread: what rays lose where the sum has doubled, and what a reference of each kind
 * of tree takes longer to build than to refit. */
#define RAY_LOSES 200.0
#define SAVED_FAST 80.0
#define SAVED_WELL 300.0
#define SAVED_PARTS 1400.0
#define WORSE 2.0 /* than as it was built, where it is not known how many rays there will be */

struct told { /* of a node or leaf */
	hull box;
	double cost, was; /* of a ray that meets it; was: before */
	double sum, sum_was; /* of that, over all nodes below and it */
	double refs;
};

struct bough {
	uint32_t node;
	uint32_t kid; /* the first of its children's, that are no leaves */
	struct told told;
};

struct refit {
	ald_accel *a;
	struct to_x x;
	int compare; /* with what it was before */
	struct bough *bough;
	uint32_t boughs, top; /* the first few are above the others, of which each is a job */
	_Atomic int lost; /* there is a triangle that can't be hit */
};

/* ---- leaves ---- */

static hull refit_block(struct refit *r, struct block *n)
{
	const ald_prims *p = r->a->prims;
	hull all = hull_none();
	q4 v[3][SEATS];

	UNROLL for (unsigned i = 0; i < SEATS; i++) {
		d4 c[3];
		q4 x[3];

		if (n->id[i] == ALD_NONE) {
			block_empty(n, v, i);
			continue;
		}
		read_corners(p, n->id[i], c);
		if (!can_be_hit(c))
			r->lost = 1;
		corners_x(&r->x, c, x);
		all = hull_join(all, corners_hull(x));
		block_seat(n, v, i, n->id[i], x);
	}
	block_close(n, v);
	return all;
}

static void refit_leaf(struct refit *r, uint32_t ref, struct told *out)
{
	ald_accel *a = r->a;
	uint32_t at = ref & REF_INDEX, n;

	out->box = hull_none();
	out->sum = out->sum_was = out->refs = 0;
	if (ref >= REF_OTHERS) {
		n = a->other[at];
		for (uint32_t i = 0; i < n; i++)
			out->box = hull_join(out->box, prim_hull(a, &r->x, a->prims, a->other[at + 1 + i]));
		out->refs = n;
	} else {
		n = (ref >> REF_SHIFT & 7) + 1;
		for (uint32_t i = 0; i < n; i++) {
			struct block *b = &a->block[at + i];

			out->box = hull_join(out->box, refit_block(r, b));
			for (unsigned k = 0; k < SEATS; k++)
				out->refs += b->id[k] != ALD_NONE;
		}
	}
	out->cost = out->was = n;
}

/* What the leaves of a node will be read from, each line asked for before the first of them is needed. */
static void fetch_leaves(const ald_accel *a, const struct node *n)
{
	const ald_prims *p = a->prims;
	size_t each = p->vertex_double ? 24 : 12;

	for (unsigned step = 0; step < 3; step++) {
		for (unsigned k = 0; k < WIDTH && n->child[k] != EMPTY; k++) {
			uint32_t ref = n->child[k], blocks = (ref >> REF_SHIFT & 7) + 1;
			const struct block *b = &a->block[ref & REF_INDEX];

			for (uint32_t i = 0; i < blocks * SEATS && ref >= REF_LEAF && ref < REF_OTHERS; i++) {
				uint32_t id = b[i / SEATS].id[i % SEATS];
				const uint32_t *v = p->index + 3 * (size_t)id;

				if (!step)
					__builtin_prefetch(&b[i / SEATS].id);
				else if (id != ALD_NONE && step == 1)
					__builtin_prefetch(v);
				for (unsigned j = 0; j < 3 && id != ALD_NONE && step == 2; j++)
					__builtin_prefetch((const char *)p->vertex + each * v[j]);
			}
		}
	}
}

/* ---- nodes ---- */

static float kid_area(const struct node *n, unsigned k)
{
	float d[3];

	for (unsigned j = 0; j < 3; j++)
		d[j] = n->plane[2 * j + 1][k] - n->plane[2 * j][k];
	return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

static float whole_area(const struct node *n, unsigned count)
{
	float d[3];

	for (unsigned j = 0; j < 3; j++) {
		float lo = INFINITY, hi = -INFINITY;

		for (unsigned k = 0; k < count; k++) {
			lo = n->plane[2 * j][k] < lo ? n->plane[2 * j][k] : lo;
			hi = n->plane[2 * j + 1][k] > hi ? n->plane[2 * j + 1][k] : hi;
		}
		d[j] = hi - lo;
	}
	return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

/* How many of the rays that meet a box meet one in it. */
static double share(float inner, float outer)
{
	return outer > 0 ? (double)inner / (double)outer : 1;
}

/* What children say of themselves becomes the node, which has not been touched yet. */
static void close_node(const struct refit *r, struct node *n, const struct told kid[WIDTH], unsigned count,
		       struct told *out)
{
	float area[WIDTH], whole, before = r->compare ? whole_area(n, count) : 0;
	float side[8] __attribute__((aligned(32)));
	uint32_t child[WIDTH];

	*out = (struct told){ .box = hull_none(), .cost = 1, .was = 1 };
	for (unsigned k = 0; k < count; k++) {
		child[k] = n->child[k];
		area[k] = hull_area(kid[k].box);
		out->box = hull_join(out->box, kid[k].box);
		out->refs += kid[k].refs;
		out->sum += kid[k].sum;
		out->sum_was += kid[k].sum_was;
		if (r->compare)
			out->was += share(kid_area(n, k), before) * kid[k].was;
	}
	whole = hull_area(out->box);
	for (unsigned k = 0; k < count; k++) {
		unsigned at = 0; /* the larger the earlier, of equal ones as they stood */

		out->cost += share(area[k], whole) * kid[k].cost;
		for (unsigned j = 0; j < count; j++)
			at += area[j] > area[k] || (area[j] == area[k] && j < k);
		hull_store(side, kid[k].box);
		n->child[at] = child[k];
		for (unsigned j = 0; j < 3; j++) {
			n->plane[2 * j][at] = side[j];
			n->plane[2 * j + 1][at] = -side[4 + j];
		}
	}
	out->sum += out->refs * out->cost;
	out->sum_was += out->refs * out->was;
	if (r->a->isa->order)
		r->a->isa->order(n, 1);
}

static void refit_node(struct refit *r, uint32_t i, struct told *out)
{
	struct node *n = &r->a->node[i];
	struct told kid[WIDTH];
	unsigned count = 0;

	fetch_leaves(r->a, n);
	for (; count < WIDTH && n->child[count] != EMPTY; count++) {
		if (n->child[count] >= REF_LEAF)
			refit_leaf(r, n->child[count], &kid[count]);
		else
			refit_node(r, n->child[count], &kid[count]);
	}
	close_node(r, n, kid, count, out);
}

/* ---- the whole ---- */

static void refit_job(void *arg, uint32_t job)
{
	struct refit *r = arg;
	struct bough *b = &r->bough[r->top + job];

	refit_node(r, b->node, &b->told);
}

/* Parents before their children, until there are enough of those. */
static void divide(struct refit *r)
{
	r->bough[0].node = r->a->root;
	r->boughs = 1;
	for (r->top = 0; r->top < r->boughs && r->boughs - r->top < JOBS && r->boughs + WIDTH <= TOP_MAX; r->top++) {
		const struct node *n = &r->a->node[r->bough[r->top].node];

		r->bough[r->top].kid = r->boughs;
		for (unsigned k = 0; k < WIDTH && n->child[k] != EMPTY; k++) {
			if (n->child[k] < REF_LEAF)
				r->bough[r->boughs++].node = n->child[k];
		}
	}
}

static void refit_top(struct refit *r, struct bough *b)
{
	struct node *n = &r->a->node[b->node];
	const struct bough *next = &r->bough[b->kid];
	struct told kid[WIDTH];
	unsigned count = 0;

	for (; count < WIDTH && n->child[count] != EMPTY; count++) {
		if (n->child[count] >= REF_LEAF)
			refit_leaf(r, n->child[count], &kid[count]);
		else
			kid[count] = next++->told;
	}
	close_node(r, n, kid, count, &b->told);
}

static int refit_tree(struct refit *r, struct told *out)
{
	const ald_host *h = r->a->host;

	if (r->a->root >= REF_LEAF) {
		refit_leaf(r, r->a->root, out);
		return ALD_OK;
	}
	r->bough = bvh8_take(h, r->a->nodes < TOP_MAX ? r->a->nodes : TOP_MAX, sizeof(*r->bough), "bvh8: building");
	if (!r->bough)
		return ALD_NO_MEMORY;
	divide(r);
	h->parallel(h->ctx, r->boughs - r->top, refit_job, r);
	for (uint32_t i = r->top; i-- > 0;)
		refit_top(r, &r->bough[i]);
	*out = r->bough[0].told;
	h->free(h->ctx, r->bough);
	return ALD_OK;
}

/* Is it still good enough for the rays to come? */
static int serves(ald_accel *a, const struct told *t)
{
	const ald_host *h = a->host;
	double rays = h->size > offsetof(ald_host, rays) ? h->rays : 0, worse, saved;

	a->cost = t->cost;
	if (a->root >= REF_LEAF)
		return 1;
	if (!(a->built_sum > 0))
		a->built_sum = t->sum_was;
	worse = t->sum / a->built_sum;
	if (!(rays > 0))
		return worse < WORSE;
	saved = a->hasty ? SAVED_FAST : a->parts ? SAVED_PARTS : SAVED_WELL;
	a->lost += rays * RAY_LOSES * ald_max(worse - 1, 0);
	return a->lost < saved * (double)a->refs;
}

int bvh8_refit(ald_accel *a, ald_error *err)
{
	const ald_host *h = a->host;
	struct refit r = { .a = a, .compare = !(a->built_sum > 0) };
	struct told all;
	ald_box box;
	int status;

	(void)err;
	if (a->held < a->prims->count) /* who was left out may be one that can be hit now */
		return ALD_UNSUPPORTED;
	status = h->progress(h->ctx, 0) ? ALD_CANCELLED : bvh8_find_box(h, a->prims, &box);
	if (status || a->root == EMPTY)
		return status;
	bvh8_place(a, &box);
	bvh8_note_masks(a);
	r.x = to_x(a);
	status = refit_tree(&r, &all);
	if (status)
		return status;
	return r.lost || !serves(a, &all) ? ALD_UNSUPPORTED : ALD_OK;
}
