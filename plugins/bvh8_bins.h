/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The surface area heuristic over bins (Wald: On fast Construction of SAH-based Bounding Volume Hierarchies,
 * 2007): where to cut a range of references so that a ray is expected to cost least.
 */
#ifndef BVH8_BINS_H
#define BVH8_BINS_H

#include "bvh8_hull.h"

#define BINS 16u
#define AHEAD 32u /* references to be fetched early */
#define STEP_COST 0.5f /* of a split, in blocks */

struct bins {
	hull box[3][BINS];
	uint32_t n[3][BINS];
	uint32_t used;
	q4 from, scale;
};

struct split {
	float cost; /* in blocks, times the area of the range; FAR: none */
	uint32_t axis, bin; /* the right side begins with this bin; axis 3: by the place alone */
};

V void bins_clear(struct bins *b)
{
	for (unsigned k = 0; k < 3; k++) {
		for (unsigned i = 0; i < b->used; i++) {
			b->box[k][i] = hull_none();
			b->n[k][i] = 0;
		}
	}
}

V void bins_begin(struct bins *b, const struct range *r)
{
	float size[4] __attribute__((aligned(16)));

	q4_store(size, q4_sub(r->hi, r->lo));
	b->used = 4 + r->count / 8 < BINS ? 4 + r->count / 8 : BINS;
	b->from = q4_three(r->lo);
	for (unsigned k = 0; k < 4; k++)
		size[k] = k < 3 && size[k] > 0x1p-60f ? (float)b->used * 0.99999f / size[k] : 0;
	b->scale = q4_load(size);
	bins_clear(b);
}

V void bin_of(const struct bins *b, q4 mid, int32_t at[4])
{
	q4_whole(q4_mul(q4_sub(mid, b->from), b->scale), at);
}

V void bin_add(struct bins *b, unsigned k, int32_t at, hull h)
{
	b->box[k][at] = hull_join(b->box[k][at], h);
	b->n[k][at]++;
}

V void bins_join(struct bins *b, const struct bins *c)
{
	for (unsigned k = 0; k < 3; k++) {
		for (unsigned i = 0; i < b->used; i++) {
			b->box[k][i] = hull_join(b->box[k][i], c->box[k][i]);
			b->n[k][i] += c->n[k][i];
		}
	}
}

V void bins_add_one(struct bins *b, const struct ref *r)
{
	hull h = ref_hull(r);
	int32_t at[4];

	bin_of(b, hull_mid(h), at);
	bin_add(b, 0, at[0], h);
	bin_add(b, 1, at[1], h);
	bin_add(b, 2, at[2], h);
}

/* Neighbours mostly go to the same bin, and would wait for each other: every fourth to a set of its own. */
V void bins_add(struct bins *b, const struct ref *ref, uint32_t n)
{
	uint32_t i = 0;

	if (n >= 512) {
		struct bins more[3] ;

		for (unsigned k = 0; k < 3; k++) {
			more[k].used = b->used;
			more[k].from = b->from;
			more[k].scale = b->scale;
			bins_clear(&more[k]);
		}
		for (; i + 3 < n; i += 4) {
			__builtin_prefetch(&ref[i + AHEAD]);
			__builtin_prefetch(&ref[i + AHEAD + 2]);
			bins_add_one(b, &ref[i]);
			for (unsigned k = 0; k < 3; k++)
				bins_add_one(&more[k], &ref[i + k + 1]);
		}
		for (unsigned k = 0; k < 3; k++)
			bins_join(b, &more[k]);
	}
	for (; i < n; i++)
		bins_add_one(b, &ref[i]);
}

V float blocks(uint32_t n)
{
	return (float)((n + SEATS - 1) / SEATS);
}

V void best_of_axis(const struct bins *b, unsigned k, struct split *best)
{
	float right[BINS];
	hull h = hull_none();
	uint32_t n = 0;

	for (unsigned i = b->used - 1; i > 0; i--) {
		h = hull_join(h, b->box[k][i]);
		n += b->n[k][i];
		right[i] = n ? hull_area(h) * blocks(n) : FAR;
	}
	h = hull_none();
	n = 0;
	for (unsigned i = 1; i < b->used; i++) {
		float cost;

		h = hull_join(h, b->box[k][i - 1]);
		n += b->n[k][i - 1];
		cost = n ? hull_area(h) * blocks(n) + right[i] : FAR;
		if (cost < best->cost)
			*best = (struct split){ cost, k, i };
	}
}

V struct split best_split(const struct bins *b)
{
	struct split best = { FAR, 3, 0 };
	float scale[4] __attribute__((aligned(16)));

	q4_store(scale, b->scale);
	for (unsigned k = 0; k < 3; k++) {
		if (scale[k] > 0)
			best_of_axis(b, k, &best);
	}
	return best;
}

#endif
