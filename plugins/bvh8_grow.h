/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A binary tree over one range of references, in place, by one thread.
 *
 * There is room for as many twigs as there are references, half of what a tree of single ones would take: a
 * range is given how many it may make, and one that has no more to spare is cut into full blocks.
 */
#ifndef BVH8_GROW_H
#define BVH8_GROW_H

#include "bvh8_part.h"
#include "bvh8_spatial.h"

#define STEEP 28u /* levels after which ranges are halved, so that no tree is deeper than LEVELS_MAX */

struct grower {
	const struct builder *b;
	uint32_t kids; /* where the next two twigs go */
};

/* As many as there must be for that many references. */
V uint32_t twigs_least(const struct builder *b, uint32_t n)
{
	return b->twigs_a_ref == 1 ? 2 * ((n + SEATS - 1) / SEATS - 1) : 2 * n - 2;
}

/* How many of the range are no triangles. */
V uint32_t others_of(const struct builder *b, const struct ref *ref, uint32_t n)
{
	uint32_t others = 0;

	if (b->prims->tri_count == b->prims->count)
		return 0;
	for (uint32_t i = 0; i < n; i++)
		others += ref[i].id >= b->prims->tri_count;
	return others;
}

/* Triangles first. */
static uint32_t part_kinds(const struct builder *b, struct ref *ref, uint32_t n)
{
	uint32_t i = 0;

	for (uint32_t j = 0; j < n; j++) {
		struct ref r = ref[j];

		if (r.id < b->prims->tri_count) {
			ref[j] = ref[i];
			ref[i++] = r;
		}
	}
	return i;
}

/* By the place alone; returns where. */
static uint32_t cut_half(struct ref *ref, const struct range *r, struct range *left, struct range *right)
{
	uint32_t at = r->count / 2 < SEATS ? r->count / 2 : r->count / 2 / SEATS * SEATS;

	halve(ref, r->count, at, r);
	measure(ref, at, left);
	measure(ref + at, r->count - at, right);
	return at;
}

/* May the rest of the range's twigs go to its two sides? */
V int share_twigs(const struct builder *b, const struct range *r, uint32_t n, uint32_t m, struct range *left,
		  struct range *right)
{
	uint64_t least = (uint64_t)twigs_least(b, n) + twigs_least(b, m) + 2, rest;

	if (least > r->twigs)
		return 0;
	rest = (r->twigs - least) * n / (n + m);
	left->twigs = twigs_least(b, n) + (uint32_t)rest;
	right->twigs = r->twigs - 2 - left->twigs;
	return 1;
}

/* A plane that is worth more than the best way to sort the references. */
static int cut_plane(const struct builder *b, const struct range *r, const struct bins *bins, struct split *s,
		     struct range *left, struct range *right)
{
	uint32_t room = r->end - r->first, most, n, m;
	float leaf = (blocks(r->count) - STEP_COST) * hull_area(r->box);
	struct planes planes;
	struct split best;

	/* Two sides of n and m need (n + m) / 2 + 1 twigs at most, or 2 (n + m) - 2. */
	most = b->twigs_a_ref == 1 ? 2 * (r->twigs - 1) : r->twigs / 2;
	most = most < room ? most : room;
	if (s->axis < 3 && !sides_overlap(r, bins, s))
		return 0;
	best = best_spatial(b, r, &planes, most);
	if (!(best.cost < s->cost) || (r->count <= (uint32_t)b->value[P_LEAF] && !(best.cost < leaf)))
		return 0;
	n = part_plane(b, r, &planes, &best, left, right, &m);
	if (!n || !m) {
		*s = (struct split){ FAR, 3, 0 }; /* its bins are of other boxes */
		return 0;
	}
	share_room(b, r, n, m, left, right);
	share_twigs(b, r, n, m, left, right);
	return 1;
}

static void sides(const struct builder *b, const struct range *r, uint32_t at, struct range *left,
		  struct range *right)
{
	if (b->corner) {
		share_room(b, r, at, r->count - at, left, right);
		return;
	}
	left->first = r->first;
	left->count = at;
	left->end = right->first = r->first + at;
	right->count = r->count - at;
	right->end = r->end;
}

/* Cut the range in two, its references in order; 0: it is a leaf. */
static int cut(const struct builder *b, const struct range *r, struct range *left, struct range *right)
{
	struct ref *ref = b->ref + r->first;
	uint32_t others = others_of(b, ref, r->count), at = 0, most = (uint32_t)b->value[P_LEAF];
	struct split s = { FAR, 3, 0 };
	struct bins bins;
	float leaf, area = hull_area(r->box);

	if (others ? r->count == 1 : r->count <= (most < SEATS ? most : SEATS))
		return 0;
	if (others && others < r->count && r->count <= SEATS) {
		at = part_kinds(b, ref, r->count);
		measure(ref, at, left);
		measure(ref + at, r->count - at, right);
		share_twigs(b, r, at, r->count - at, left, right);
		sides(b, r, at, left, right);
		return 1;
	}
	if (r->depth < STEEP) {
		bins_begin(&bins, r);
		bins_add(&bins, ref, r->count);
		s = best_split(&bins);
		if (b->corner && cut_plane(b, r, &bins, &s, left, right))
			return 1;
	}
	leaf = blocks(r->count) * area;
	if (r->count <= most && (others ? others == r->count && r->count <= SEATS && s.axis > 2 :
					  !(s.cost + STEP_COST * area < leaf)))
		return 0;
	if (s.axis < 3)
		at = part(ref, r->count, &bins, &s, left, right);
	if (!at || !share_twigs(b, r, at, r->count - at, left, right)) {
		at = cut_half(ref, r, left, right);
		share_twigs(b, r, at, r->count - at, left, right);
	}
	sides(b, r, at, left, right);
	return 1;
}

/* Its references keep their places, and nothing but their numbers is needed of them any more. */
static void set_leaf(const struct builder *b, const struct range *r)
{
	set_twig(&b->twig[r->twig], r, r->first, r->count);
	for (uint32_t i = r->first; i < r->first + r->count; i++)
		b->id[i] = b->ref[i].id;
}

static void grow(struct grower *g, struct range *r)
{
	struct range left, right;
	uint32_t kid = g->kids;

	if (g->b->corner && r->count <= 2 * SEATS)
		join_parts_of(g->b, r);
	if (!cut(g->b, r, &left, &right)) {
		set_leaf(g->b, r);
		return;
	}
	set_twig(&g->b->twig[r->twig], r, kid, 0);
	g->kids += 2;
	left.twig = kid;
	right.twig = kid + 1;
	left.depth = right.depth = r->depth + 1;
	grow(g, &left);
	grow(g, &right);
}

#endif
