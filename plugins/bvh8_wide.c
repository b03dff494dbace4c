/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * From a binary tree to nodes of eight (Wald, Benthin, Boulos: Getting Rid of Packets, 2008), and
 * triangles to blocks: one pass gives every node and leaf its place, depth first and siblings side by side;
 * a second one, parallel, fills them.
 */
#include "bvh8.h"

#define NODES_A_JOB 256u

struct seat { /* of a node: the twig it is made of, and where its first of each kind of child is */
	uint32_t twig, node, block, other;
};

struct widener {
	struct builder *b;
	struct seat *seat;
	uint32_t seats, room;
};

static float area(const struct twig *t)
{
	float x = t->hi[0] - t->lo[0], y = t->hi[1] - t->lo[1], z = t->hi[2] - t->lo[2];

	return x * y + y * z + z * x;
}

/* The largest are opened until there are eight; then in the order of size. */
static uint32_t open_twig(const struct builder *b, uint32_t root, uint32_t kid[WIDTH])
{
	float size[WIDTH], swap;
	uint32_t n = 0, next = b->twig[root].kid;

	for (unsigned k = 0; k < 2; k++, n++) {
		kid[n] = next + k;
		size[n] = area(&b->twig[kid[n]]);
	}
	while (n < WIDTH) {
		uint32_t best = WIDTH;

		for (uint32_t i = 0; i < n; i++) {
			if (!b->twig[kid[i]].count && (best == WIDTH || size[i] > size[best]))
				best = i;
		}
		if (best == WIDTH)
			break;
		kid[n] = b->twig[kid[best]].kid + 1;
		kid[best] = b->twig[kid[best]].kid;
		size[best] = area(&b->twig[kid[best]]);
		size[n] = area(&b->twig[kid[n]]);
		n++;
	}
	for (uint32_t i = 1; i < n; i++) {
		for (uint32_t j = i; j > 0 && size[j] > size[j - 1]; j--) {
			uint32_t t = kid[j];

			kid[j] = kid[j - 1];
			kid[j - 1] = t;
			swap = size[j];
			size[j] = size[j - 1];
			size[j - 1] = swap;
		}
	}
	return n;
}

static int holds_others(const struct builder *b, const struct twig *t)
{
	return b->ref[t->kid].id >= b->prims->tri_count;
}

static uint32_t blocks_of(const struct twig *t)
{
	return (t->count + SEATS - 1) / SEATS;
}

/* A place for a leaf; its reference. */
static uint32_t place_leaf(struct builder *b, const struct twig *t, uint32_t *block, uint32_t *other)
{
	uint32_t at;

	if (holds_others(b, t)) {
		at = *other;
		*other += t->count + 1;
		return REF_OTHERS | at;
	}
	at = *block;
	*block += blocks_of(t);
	return REF_LEAF | (blocks_of(t) - 1) << REF_SHIFT | at;
}

/* Give the children of seat i places. */
static void seat_children(struct widener *w, uint32_t i, float whole)
{
	struct builder *b = w->b;
	ald_accel *a = b->a;
	struct seat *s = &w->seat[i];
	uint32_t kid[WIDTH], n = open_twig(b, s->twig, kid);

	s->node = w->seats;
	s->block = a->blocks;
	s->other = a->others;
	a->cost += (double)(area(&b->twig[s->twig]) / whole);
	for (uint32_t k = 0; k < n; k++) {
		const struct twig *t = &b->twig[kid[k]];

		if (!t->count) {
			w->seat[w->seats++].twig = kid[k];
			continue;
		}
		place_leaf(b, t, &a->blocks, &a->others);
		a->leaves++;
		a->cost += (double)(area(t) / whole) * (holds_others(b, t) ? t->count : blocks_of(t));
	}
}

static void seat_all(struct widener *w)
{
	struct place {
		uint32_t from, to, depth; /* seats that are still to be opened */
	} stack[LEVELS_MAX + 1];
	ald_accel *a = w->b->a;
	uint32_t top = 0;
	float whole = area(&w->b->twig[w->seat[0].twig]);

	whole = whole > 0 ? whole : 1;
	stack[top++] = (struct place){ 0, 1, 1 };
	while (top) {
		struct place *p = &stack[top - 1], next;

		if (p->from == p->to) {
			top--;
			continue;
		}
		if (p->depth > a->depth)
			a->depth = p->depth;
		next = (struct place){ w->seats, 0, p->depth + 1 };
		seat_children(w, p->from++, whole);
		next.to = w->seats;
		if (next.to > next.from)
			stack[top++] = next;
	}
}

static void fill_block(const struct builder *b, struct block *n, const struct ref *ref, uint32_t count)
{
	const ald_accel *a = b->a;
	const ald_prims *p = b->prims;

	memset(n, 0, sizeof(*n));
	for (unsigned i = 0; i < SEATS; i++) {
		float size = 0;
		ald_vec v[3];

		n->id[i] = ALD_NONE;
		n->slack[i] = -1;
		if (i >= count)
			continue;
		n->id[i] = ref[i].id;
		ald_corners(p, ref[i].id, p->origin ? ald_group_of(p, ref[i].id) : 0, v);
		for (unsigned k = 0; k < 3; k++) {
			float x[3];

			for (unsigned j = 0; j < 3; j++) {
				x[j] = (float)((ald_get(&v[j], k) - a->centre[k]) * a->scale);
				n->v[j][k][i] = x[j];
			}
			for (unsigned j = 0; j < 3; j++) {
				float d = fabsf(x[j] - x[(j + 1) % 3]);

				size = d > size ? d : size;
			}
		}
		n->slack[i] = EDGE_ERROR * (12 * (size + 4 * EDGE_ERROR) + 4 * EDGE_ERROR);
	}
}

static void fill_leaf(const struct builder *b, uint32_t ref, const struct twig *t)
{
	ald_accel *a = b->a;
	const struct ref *from = b->ref + t->kid;

	if (ref >= REF_OTHERS) {
		uint32_t *to = &a->other[ref & REF_INDEX];

		*to++ = t->count;
		for (uint32_t i = 0; i < t->count; i++)
			*to++ = from[i].id;
		return;
	}
	for (uint32_t i = 0; i < t->count; i += SEATS)
		fill_block(b, &a->block[(ref & REF_INDEX) + i / SEATS], from + i,
			   t->count - i < SEATS ? t->count - i : SEATS);
}

static void fill_node(const struct widener *w, uint32_t i)
{
	struct builder *b = w->b;
	struct seat s = w->seat[i];
	struct node *node = &b->a->node[i];
	uint32_t kid[WIDTH], n = open_twig(b, s.twig, kid);

	memset(node, 0, sizeof(*node));
	for (unsigned k = 0; k < WIDTH; k++) {
		const struct twig *t = &b->twig[kid[k < n ? k : 0]];

		for (unsigned j = 0; j < 3; j++) {
			node->plane[2 * j][k] = k < n ? t->lo[j] : INFINITY;
			node->plane[2 * j + 1][k] = k < n ? t->hi[j] : -INFINITY;
		}
		node->child[k] = EMPTY;
		if (k >= n)
			continue;
		node->child[k] = t->count ? place_leaf(b, t, &s.block, &s.other) : s.node++;
		if (t->count)
			fill_leaf(b, node->child[k], t);
	}
}

static void fill_job(void *arg, uint32_t job)
{
	const struct widener *w = arg;

	for (uint32_t i = job * NODES_A_JOB; i < w->seats && i < (job + 1) * NODES_A_JOB; i++)
		fill_node(w, i);
}

static void *keep(struct builder *b, uint64_t n, size_t each, const char *what)
{
	b->a->bytes += n * each;
	return bvh8_take(b->host, n, each, what);
}

/* Of trees that are no more than a leaf. */
static int widen_leaf(struct builder *b, const struct twig *t)
{
	ald_accel *a = b->a;

	a->root = place_leaf(b, t, &a->blocks, &a->others);
	a->leaves = 1;
	a->block = keep(b, a->blocks, sizeof(*a->block), "bvh8: triangles");
	a->other = keep(b, a->others, sizeof(*a->other), "bvh8: references");
	if (!a->block || !a->other)
		return ALD_NO_MEMORY;
	fill_leaf(b, a->root, t);
	a->cost = a->blocks + a->others;
	return ALD_OK;
}

int bvh8_widen(struct builder *b)
{
	ald_accel *a = b->a;
	const ald_host *h = b->host;
	struct widener w = { .b = b };
	const struct twig *root = &b->twig[2 * (size_t)b->refs];
	int status = ALD_NO_MEMORY;

	a->root = EMPTY;
	a->refs = b->refs;
	if (!b->refs)
		return ALD_OK;
	if (root->count)
		return widen_leaf(b, root);
	w.room = b->inner;
	w.seat = bvh8_take(h, w.room, sizeof(*w.seat), "bvh8: building");
	if (!w.seat)
		return ALD_NO_MEMORY;
	w.seat[w.seats++].twig = 2 * b->refs;
	seat_all(&w);
	a->root = 0;
	a->nodes = w.seats;
	if (a->blocks <= REF_INDEX && a->others <= REF_INDEX) {
		a->node = keep(b, a->nodes, sizeof(*a->node), "bvh8: nodes");
		a->block = keep(b, a->blocks, sizeof(*a->block), "bvh8: triangles");
		a->other = keep(b, a->others, sizeof(*a->other), "bvh8: references");
		if (a->node && a->block && a->other)
			status = ALD_OK;
	}
	if (!status)
		h->parallel(h->ctx, (a->nodes + NODES_A_JOB - 1) / NODES_A_JOB, fill_job, &w);
	h->free(h->ctx, w.seat);
	return status;
}
