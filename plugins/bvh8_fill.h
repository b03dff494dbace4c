/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Which twigs of a binary tree nodes of eight are to be made of, so that these have the least area together: for each
 * twig, what it costs at least if it may take up one place of a node, two, and so on (Ylitie, Karras, Laine: Efficient
 * Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, 2017). Opening the largest first instead leaves nodes
 * at the bottom with few children.
 *
 * A row has seven of these costs; a leaf's are 0. That of an inner twig has the number of its pair of children.
 */
#ifndef BVH8_FILL_H
#define BVH8_FILL_H

#include "bvh8_hull.h"

/* Numbers that are too large where two rows are added and one of them begins later: what stands before it then is of
 * another one. */
static const float fill_late[2 * WIDTH] __attribute__((aligned(32))) = { FAR, FAR, FAR, FAR, FAR, FAR, FAR, FAR };

V float *fill_at(const struct rows *r, const struct twig *t)
{
	return r->row + (size_t)WIDTH * (1 + (t->kid - r->base) / 2);
}

V const float *fill_row(const struct rows *r, const struct twig *t)
{
	return t->count ? bvh8_row_leaf + WIDTH : fill_at(r, t);
}

V void fill_one(const struct rows *r, const struct twig *t, const struct twig *twig)
{
	const struct twig *a = &twig[t->kid], *b = a + 1;
	const float *left = fill_row(r, a), *right = fill_row(r, b);
	float x = t->hi[0] - t->lo[0], y = t->hi[1] - t->lo[1], z = t->hi[2] - t->lo[2];
	float own = x * y + y * z + z * x + r->more, *to = fill_at(r, t);
	float sum[8] __attribute__((aligned(32)));
	hull least;

	if (a->count && b->count) {
		memset(to, 0, WIDTH * sizeof(*to));
		to[0] = own;
		return;
	}
	least = hull_add(hull_all(left[0]), hull_load(right));
	UNROLL for (unsigned k = 1; k < WIDTH - 1; k++)
		least = hull_join(least, hull_add(hull_add(hull_all(left[k]), hull_loose(right - k)),
						  hull_loose(fill_late + WIDTH - k)));
	hull_store(sum, least); /* of two places, three, .. eight */
	own += sum[6];
	hull_store(sum, hull_join(least, hull_all(own)));
	to[0] = own;
	memcpy(to + 1, sum, 6 * sizeof(*to));
	to[7] = sum[5];
}

/* base..end: the twigs of a task, children behind their parents. The first row is the root's, of no use. */
static void fill_rows(const struct rows *r, const struct twig *twig, uint32_t end)
{
	memset(r->row, 0, 2 * WIDTH * sizeof(*r->row));
	for (uint32_t i = end; i-- > r->base;) {
		if (!twig[i].count)
			fill_one(r, &twig[i], twig);
	}
}

#endif
