/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * From binary trees to nodes of eight (Wald, Benthin, Boulos: Getting Rid of Packets, 2008), for trees of which
 * all twigs are at hand, and whose leaves know already what rays go down to.
 */
#ifndef BVH8_FOLD_H
#define BVH8_FOLD_H

#include "bvh8_fast.h"

struct folded {
	struct sprig *sprig;
	uint32_t n; /* how many there are */
	uint32_t depth; /* of the last tree, in nodes */
	double area; /* of all boxes around nodes */
};

/* Without what stands behind them, which as a float could be anything, and slow. */
V q4 twig_lo(const struct twig *t)
{
	return q4_three(q4_load(t->lo));
}

V q4 twig_hi(const struct twig *t)
{
	return q4_three(q4_load(t->hi));
}

V float twig_area(const struct twig *t)
{
	return q4_area(q4_sub(twig_hi(t), twig_lo(t)));
}

struct unfolded { /* children in the making; size and open are below 0 where there is none, or none to open */
	q4 size[2], open[2];
	uint32_t kid[WIDTH], n;
};

V void fold_add(struct unfolded *o, const struct twig *twig, uint32_t i, uint32_t kid)
{
	static const uint32_t lane[2 * WIDTH] = { [WIDTH] = UINT32_MAX };
	float area = twig_area(&twig[kid]);
	q4 size = q4_all(area), open = q4_all(twig[kid].count ? -1 : area);

	o->kid[i] = kid;
	UNROLL for (unsigned half = 0; half < 2; half++) {
		const uint32_t *mask = &lane[WIDTH - i + 4 * half];

		o->size[half] = q4_put(o->size[half], size, mask);
		o->open[half] = q4_put(o->open[half], open, mask);
	}
}

/* The largest are opened, of equal ones the first, until there are eight; then in the order of size. */
static void fold_open(const struct twig *twig, uint32_t root, uint32_t out[WIDTH])
{
	struct unfolded o;
	uint32_t next = twig[root].kid;
	float size[WIDTH] __attribute__((aligned(16)));

	o.size[0] = o.size[1] = o.open[0] = o.open[1] = q4_all(-1);
	for (unsigned k = 0; k < WIDTH; k++)
		out[k] = EMPTY;
	fold_add(&o, twig, 0, next);
	fold_add(&o, twig, 1, next + 1);
	for (o.n = 2; o.n < WIDTH; o.n++) {
		q4 most = q4_most(q4_max(o.open[0], o.open[1]));
		unsigned best;

		if (!q4_above(most, q4_all(-0.5f)))
			break;
		best = (unsigned)__builtin_ctz(q4_same(o.open[0], most) | q4_same(o.open[1], most) << 4 | 1u << WIDTH);
		best = best < WIDTH ? best : 0;
		next = twig[o.kid[best]].kid;
		fold_add(&o, twig, best, next);
		fold_add(&o, twig, o.n, next + 1);
	}
	q4_store(size, o.size[0]);
	q4_store(size + 4, o.size[1]);
	for (uint32_t i = 0; i < o.n; i++) {
		q4 x = q4_all(size[i]);
		unsigned before = (1u << i) - 1, same = q4_same(o.size[0], x) | q4_same(o.size[1], x) << 4;
		unsigned above = q4_above(o.size[0], x) | q4_above(o.size[1], x) << 4;

		out[__builtin_popcount(above | (same & before))] = o.kid[i];
	}
}

/* The nodes of a tree whose root is no leaf, behind those that are there; siblings stand side by side. What was
 * opened has the number of its sprig as its kid. */
static void fold(struct folded *f, struct twig *twig, uint32_t root)
{
	struct place {
		uint32_t from, to; /* sprigs that are still to be opened: kid[0] is of what */
	} stack[LEVELS_MAX + 1];
	uint32_t top = 0;

	f->sprig[f->n].kid[0] = root;
	f->depth = 0;
	stack[top++] = (struct place){ f->n, f->n + 1 };
	f->n++;
	while (top) {
		struct place *s = &stack[top - 1], next = { f->n, 0 };
		uint32_t *kid;

		if (s->from == s->to) {
			top--;
			continue;
		}
		f->depth = top > f->depth ? top : f->depth;
		kid = f->sprig[s->from].kid;
		root = kid[0];
		f->area += (double)twig_area(&twig[root]);
		fold_open(twig, root, kid);
		twig[root].kid = s->from++;
		for (unsigned k = 0; k < WIDTH && kid[k] != EMPTY; k++) {
			if (!twig[kid[k]].count)
				f->sprig[f->n++].kid[0] = kid[k];
		}
		next.to = f->n;
		if (next.to > next.from)
			stack[top++] = next;
	}
}

/* first: where the first sprig's node is. */
static void fold_node(struct node *n, const struct twig *twig, const struct sprig *s, uint32_t first)
{
	static const struct twig none __attribute__((aligned(32))) = {
		.lo = { INFINITY, INFINITY, INFINITY },
		.kid = EMPTY,
		.hi = { -INFINITY, -INFINITY, -INFINITY },
		.count = 1,
	};

	for (unsigned half = 0; half < WIDTH; half += 4) {
		q4 lo[4], hi[4];

		UNROLL for (unsigned k = 0; k < 4; k++) {
			uint32_t kid = s->kid[half + k];
			const struct twig *t = kid == EMPTY ? &none : &twig[kid];

			lo[k] = twig_lo(t);
			hi[k] = twig_hi(t);
			n->child[half + k] = t->kid + (t->count ? 0 : first);
		}
		q4_turn(lo);
		q4_turn(hi);
		UNROLL for (unsigned k = 0; k < 3; k++) {
			q4_store(&n->plane[2 * k][half], lo[k]);
			q4_store(&n->plane[2 * k + 1][half], hi[k]);
		}
	}
	memset(n->order, 0, sizeof(n->order));
}

#endif
