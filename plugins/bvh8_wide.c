/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * From a binary tree to nodes of eight (Wald, Benthin, Boulos: Getting Rid of Packets, 2008; what is opened is decided
 * by bvh8_fill.h), and triangles to blocks: one pass gives every node and leaf its place, depth first and siblings side
 * by side; a second one, parallel, fills them.
 */
#include "bvh8_corner.h"

const float bvh8_row_leaf[2 * WIDTH] __attribute__((aligned(32))) = { 0 };

struct widener {
	struct builder *b;
	const struct rows *rows; /* of a task's tree; NULL: the largest are opened first */
	uint32_t *owner; /* of the top's twigs: the part below, or 0 */
};

static float area(const struct twig *t)
{
	float x = t->hi[0] - t->lo[0], y = t->hi[1] - t->lo[1], z = t->hi[2] - t->lo[2];

	return x * y + y * z + z * x;
}

/* Of a twig at the top that is the root of a task's tree: which; else 0. */
static uint32_t part_below(const struct widener *w, const struct part *p, uint32_t twig)
{
	return p == w->b->part ? w->owner[twig - w->b->root] : 0;
}

/* The children of a node. */
struct opened {
	float size[WIDTH] __attribute__((aligned(32)));
	uint32_t kid[WIDTH], n;
	uint32_t inner; /* the first that was opened; EMPTY: none was */
};

/* Which of the eight is the largest, the first of them. */
V unsigned largest(const float size[WIDTH])
{
	q4 a = q4_load(size), b = q4_load(size + 4), most = q4_most(q4_max(a, b));

	return (unsigned)__builtin_ctz(q4_same(a, most) | q4_same(b, most) << 4 | 1u << WIDTH);
}

/* In the order of size. */
V void sort_kids(struct opened *o)
{
	q4 a = q4_load(o->size), b = q4_load(o->size + 4);
	uint32_t kid[WIDTH];

	memcpy(kid, o->kid, sizeof(kid));
	for (uint32_t i = 0; i < o->n; i++) {
		q4 x = q4_all(o->size[i]);
		unsigned before = (1u << i) - 1, same = q4_same(a, x) | q4_same(b, x) << 4;
		unsigned above = q4_above(a, x) | q4_above(b, x) << 4;

		o->kid[__builtin_popcount(above | (same & before))] = kid[i];
	}
}

V void add_kid(const struct widener *w, const struct part *p, struct opened *o, float open[WIDTH], uint32_t i,
	       uint32_t twig)
{
	const struct twig *t = &w->b->twig[twig];

	o->kid[i] = twig;
	o->size[i] = area(t);
	open[i] = t->count || part_below(w, p, twig) ? -1 : o->size[i];
}

/* The largest are opened until there are eight; then in the order of size. */
static void open_twig(const struct widener *w, const struct part *p, uint32_t root, struct opened *o)
{
	float open[WIDTH] __attribute__((aligned(32)));
	uint32_t next = w->b->twig[root].kid;

	for (unsigned k = 0; k < WIDTH; k++) {
		o->size[k] = open[k] = -1;
		o->kid[k] = EMPTY;
	}
	o->inner = EMPTY;
	add_kid(w, p, o, open, 0, next);
	add_kid(w, p, o, open, 1, next + 1);
	for (o->n = 2; o->n < WIDTH; o->n++) {
		unsigned best = largest(open);

		if (open[best] < 0)
			break;
		if (o->inner == EMPTY)
			o->inner = o->kid[best];
		next = w->b->twig[o->kid[best]].kid;
		add_kid(w, p, o, open, best, next);
		add_kid(w, p, o, open, o->n, next + 1);
	}
	sort_kids(o);
}

V const float *row_of(const struct rows *r, const struct twig *t)
{
	return t->count ? bvh8_row_leaf + WIDTH : r->row + (size_t)WIDTH * (1 + (t->kid - r->base) / 2);
}

struct places { /* that a twig may take up */
	uint32_t twig, n;
};

/* The two children of a twig that may take up s->n, so that the sum of what they cost is the least. */
static void share_places(const struct widener *w, const struct places *s, struct places *left, struct places *right)
{
	uint32_t kid = w->b->twig[s->twig].kid, best = 1;
	const float *a = row_of(w->rows, &w->b->twig[kid]), *b = row_of(w->rows, &w->b->twig[kid + 1]);

	for (uint32_t k = 2; k < s->n; k++) {
		if (a[k - 1] + b[s->n - k - 1] < a[best - 1] + b[s->n - best - 1])
			best = k;
	}
	*left = (struct places){ kid, best };
	*right = (struct places){ kid + 1, s->n - best };
}

/* As the rows say; then in the order of size. */
static void open_best(const struct widener *w, uint32_t root, struct opened *o)
{
	struct places stack[WIDTH], s = { root, WIDTH };
	uint32_t top = 2;

	o->n = 0;
	o->inner = EMPTY;
	for (unsigned k = 0; k < WIDTH; k++) {
		o->size[k] = -1;
		o->kid[k] = EMPTY;
	}
	share_places(w, &s, &stack[1], &stack[0]);
	while (top) {
		const struct twig *t;
		const float *row;

		s = stack[--top];
		t = &w->b->twig[s.twig];
		row = row_of(w->rows, t);
		while (s.n > 1 && !(row[s.n - 1] < row[s.n - 2]))
			s.n--;
		if (t->count || s.n == 1) {
			o->kid[o->n] = s.twig;
			o->size[o->n++] = area(t);
			continue;
		}
		if (o->inner == EMPTY)
			o->inner = s.twig;
		share_places(w, &s, &stack[top + 1], &stack[top]);
		top += 2;
	}
	sort_kids(o);
}

/* Children that were found once are noted where one of those is that were opened and serve nobody any more: the
 * twig of a seat is then that place, and this. */
#define NOTED 0x80000000u

static void note_kids(const struct widener *w, const struct part *p, struct seat *s, const struct opened *o)
{
	if (o->inner == EMPTY || p == w->b->part)
		return;
	memcpy(&w->b->twig[o->inner], o->kid, sizeof(o->kid));
	s->twig = o->inner | NOTED;
}

/* Neither of its children. */
static void open_only(const struct widener *w, uint32_t root, struct opened *o)
{
	for (unsigned k = 0; k < WIDTH; k++) {
		o->kid[k] = k < 2 ? w->b->twig[root].kid + k : EMPTY;
		o->size[k] = k < 2 ? area(&w->b->twig[o->kid[k]]) : -1;
	}
	o->n = 2;
	o->inner = EMPTY;
	sort_kids(o);
}

static void open_again(const struct widener *w, const struct part *p, const struct seat *s, struct opened *o)
{
	if (p == w->b->part) {
		open_twig(w, p, s->twig, o);
		return;
	}
	if (!(s->twig & NOTED)) { /* no child was opened that it could have been noted in */
		open_only(w, s->twig, o);
		return;
	}
	memcpy(o->kid, &w->b->twig[s->twig & ~NOTED], sizeof(o->kid));
	for (o->n = 3; o->n < WIDTH && o->kid[o->n] != EMPTY;)
		o->n++;
}

V uint32_t id_of(const struct builder *b, uint32_t ref)
{
	return b->id[ref];
}

static int holds_others(const struct builder *b, const struct twig *t)
{
	return b->prims->tri_count < b->prims->count && id_of(b, t->kid) >= b->prims->tri_count;
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
static void seat_children(const struct widener *w, struct part *p, uint32_t i, uint32_t depth)
{
	struct builder *b = w->b;
	struct seat *s = &p->seat[i];
	struct opened o;

	if (w->rows)
		open_best(w, s->twig, &o);
	else
		open_twig(w, p, s->twig, &o);
	s->node = p->seats;
	s->block = p->blocks;
	s->other = p->others;
	p->cost += (double)(area(&b->twig[s->twig]) / w->b->whole);
	for (uint32_t k = 0; k < o.n; k++) {
		const struct twig *t = &b->twig[o.kid[k]];
		uint32_t below = part_below(w, p, o.kid[k]);

		if (!t->count && below) {
			if (depth + w->b->part[below].depth > p->depth)
				p->depth = depth + w->b->part[below].depth;
		} else if (!t->count) {
			p->seat[p->seats++].twig = o.kid[k];
		} else {
			place_leaf(b, t, &p->blocks, &p->others);
			p->leaves++;
			p->refs += t->count;
			p->cost += (double)(area(t) / w->b->whole) * (holds_others(b, t) ? t->count : blocks_of(t));
		}
	}
	note_kids(w, p, s, &o);
}

static void seat_part(const struct widener *w, struct part *p, uint32_t root)
{
	struct place {
		uint32_t from, to, depth; /* seats that are still to be opened */
	} stack[LEVELS_MAX + 1];
	uint32_t top = 0;

	p->seat[p->seats++].twig = root;
	stack[top++] = (struct place){ 0, 1, 1 };
	while (top) {
		struct place *s = &stack[top - 1], next;

		if (s->from == s->to) {
			top--;
			continue;
		}
		if (s->depth > p->depth)
			p->depth = s->depth;
		next = (struct place){ p->seats, 0, s->depth + 1 };
		seat_children(w, p, s->from++, s->depth);
		next.to = p->seats;
		if (next.to > next.from)
			stack[top++] = next;
	}
}

/* While its twigs are at hand. */
void bvh8_seat(struct builder *b, struct part *p, const struct rows *rows, uint32_t root)
{
	const struct widener w = { .b = b, .rows = rows };

	seat_part(&w, p, root);
}

static void fill_block(const struct builder *b, struct block *n, uint32_t ref, uint32_t count)
{
	struct to_x to = to_x(b->a);
	q4 v[3][SEATS];

	UNROLL for (unsigned i = 0; i < SEATS; i++) {
		d4 c[3];
		q4 x[3];

		if (i >= count) {
			block_empty(n, v, i);
			continue;
		}
		read_corners(b->prims, id_of(b, ref + i), c);
		corners_x(&to, c, x);
		block_seat(n, v, i, id_of(b, ref + i), x);
	}
	block_close(n, v);
}

static void fill_leaf(const struct builder *b, uint32_t ref, const struct twig *t)
{
	ald_accel *a = b->a;

	if (ref >= REF_OTHERS) {
		uint32_t *to = &a->other[ref & REF_INDEX];

		*to++ = t->count;
		for (uint32_t i = 0; i < t->count; i++)
			*to++ = id_of(b, t->kid + i);
		return;
	}
	for (uint32_t i = 0; i < t->count; i += SEATS)
		fill_block(b, &a->block[(ref & REF_INDEX) + i / SEATS], t->kid + i,
			   t->count - i < SEATS ? t->count - i : SEATS);
}

static void fill_node(const struct widener *w, const struct part *p, uint32_t i, const struct opened *o)
{
	struct builder *b = w->b;
	struct seat s = p->seat[i];
	struct node *node = &b->a->node[p->node + i];
	uint32_t n = o->n;

	s.node += p->node;
	s.block += p->block;
	s.other += p->other;
	memset(node->order, 0, sizeof(node->order));
	for (unsigned k = 0; k < WIDTH; k++) {
		const struct twig *t = &b->twig[o->kid[k < n ? k : 0]];
		uint32_t below = part_below(w, p, o->kid[k < n ? k : 0]);

		for (unsigned j = 0; j < 3; j++) {
			node->plane[2 * j][k] = k < n ? t->lo[j] : INFINITY;
			node->plane[2 * j + 1][k] = k < n ? t->hi[j] : -INFINITY;
		}
		node->child[k] = EMPTY;
		if (k >= n)
			continue;
		if (t->count) {
			node->child[k] = place_leaf(b, t, &s.block, &s.other);
			fill_leaf(b, node->child[k], t);
		} else {
			node->child[k] = below ? w->b->part[below].node : s.node++;
		}
	}
}

/* What the triangles below a node will be read from: step 0, their numbers; 1, the corners' numbers; 2, the
 * corners. */
static void fetch_leaves(const struct builder *b, const struct opened *o, unsigned step)
{
	const ald_prims *p = b->prims;
	size_t each = p->vertex_double ? 24 : 12;

	for (uint32_t k = 0; k < o->n; k++) {
		const struct twig *t = &b->twig[o->kid[k]];

		for (uint32_t i = 0; i < t->count; i++) {
			uint32_t ref = t->kid + i, id;

			if (!step) {
				__builtin_prefetch(&b->id[ref]);
			} else if ((id = id_of(b, ref)) < p->tri_count) {
				const uint32_t *v = p->index + 3 * (size_t)id;

				if (step == 1)
					__builtin_prefetch(v);
				for (unsigned j = 0; j < 3 && step == 2; j++)
					__builtin_prefetch((const char *)p->vertex + each * v[j]);
			}
		}
	}
}

/* Nodes stand in a row of four, each a step nearer to being filled. */
static void fill_job(void *arg, uint32_t job)
{
	const struct widener *w = arg;
	const struct part *p = &w->b->part[job];
	struct opened row[4];

	/* A part's twigs stand together, read in no order. */
	for (uint32_t i = 0; p != w->b->part && i < p->seats; i++)
		__builtin_prefetch(&w->b->twig[p->seat[i].twig & ~NOTED]);
	for (uint32_t i = 0; i < p->seats + 3 && p->seats; i++) {
		struct opened *o = &row[i % 4];

		if (i < p->seats) {
			open_again(w, p, &p->seat[i], o);
			fetch_leaves(w->b, o, 0);
		}
		if (i >= 1 && i - 1 < p->seats)
			fetch_leaves(w->b, &row[(i - 1) % 4], 1);
		if (i >= 2 && i - 2 < p->seats)
			fetch_leaves(w->b, &row[(i - 2) % 4], 2);
		if (i >= 3)
			fill_node(w, p, i - 3, &row[(i - 3) % 4]);
	}
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
	a->refs = t->count;
	a->block = keep(b, a->blocks, sizeof(*a->block), "bvh8: triangles");
	a->other = keep(b, a->others, sizeof(*a->other), "bvh8: references");
	if (!a->block || !a->other)
		return ALD_NO_MEMORY;
	fill_leaf(b, a->root, t);
	a->cost = a->blocks + a->others;
	return ALD_OK;
}

static int seat_top(struct widener *w)
{
	struct builder *b = w->b;
	const ald_host *h = b->host;
	uint32_t twigs = 2 * b->top + 1;

	w->owner = bvh8_take(h, twigs, sizeof(*w->owner), "bvh8: building");
	if (!w->owner)
		return ALD_NO_MEMORY;
	memset(w->owner, 0, twigs * sizeof(*w->owner));
	for (uint32_t i = 0; i < b->tasks; i++)
		w->owner[b->part[i + 1].twig - b->root] = i + 1;
	if (b->top)
		seat_part(w, b->part, b->root);
	return ALD_OK;
}

/* Where the parts go, one behind the other. Returns 0 if there is too much of it. */
static int join_parts(const struct widener *w)
{
	ald_accel *a = w->b->a;
	uint64_t nodes = 0, blocks = 0, others = 0;

	for (uint32_t i = 0; i <= w->b->tasks; i++) {
		struct part *p = &w->b->part[i];

		p->node = (uint32_t)nodes;
		p->block = (uint32_t)blocks;
		p->other = (uint32_t)others;
		nodes += p->seats;
		blocks += p->blocks;
		others += p->others;
		a->leaves += p->leaves;
		a->refs += p->refs;
		a->cost += p->cost;
		if (p->depth > a->depth)
			a->depth = p->depth;
	}
	a->nodes = (uint32_t)nodes;
	a->blocks = (uint32_t)blocks;
	a->others = (uint32_t)others;
	return nodes < REF_LEAF && blocks <= REF_INDEX && others <= REF_INDEX;
}

int bvh8_widen(struct builder *b)
{
	ald_accel *a = b->a;
	const ald_host *h = b->host;
	struct widener w = { .b = b };
	const struct twig *root = &b->twig[b->root];
	int status;

	a->root = EMPTY;
	if (!b->refs)
		return ALD_OK;
	if (root->count)
		return widen_leaf(b, root);
	status = seat_top(&w);
	if (!status && !join_parts(&w))
		status = ALD_NO_MEMORY;
	if (!status) {
		a->root = 0;
		a->node = keep(b, a->nodes, sizeof(*a->node), "bvh8: nodes");
		a->block = keep(b, a->blocks, sizeof(*a->block), "bvh8: triangles");
		a->other = keep(b, a->others, sizeof(*a->other), "bvh8: references");
		if (a->node && a->block && a->other)
			h->parallel(h->ctx, b->tasks + 1, fill_job, &w);
		else
			status = ALD_NO_MEMORY;
	}
	h->free(h->ctx, w.owner);
	return status;
}
