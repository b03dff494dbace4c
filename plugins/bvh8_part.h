/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Putting references of a range in order, in place: by a split, or in halves.
 */
#ifndef BVH8_PART_H
#define BVH8_PART_H

#include "bvh8_bins.h"

V void measure(const struct ref *ref, uint32_t n, struct range *r)
{
	range_clear(r);
	for (uint32_t i = 0; i < n; i++) {
		hull h = ref_hull(&ref[i]);

		range_add(r, h, hull_mid(h));
	}
}

/* Move what goes left to the front; returns how many. */
V uint32_t part(struct ref *ref, uint32_t n, const struct bins *b, const struct split *s, struct range *left,
		struct range *right)
{
	struct range l = *left, r = *right;
	uint32_t i = 0, j = n;
	hull h;

	range_clear(&l);
	range_clear(&r);
	h = ref_hull(&ref[0]);
	for (;;) {
		q4 mid = hull_mid(h);
		int32_t at[4];
		hull swap;

		bin_of(b, mid, at);
		if (at[s->axis] < (int32_t)s->bin) {
			range_add(&l, h, mid);
			if (++i == j)
				break;
			h = ref_hull(&ref[i]);
			continue;
		}
		range_add(&r, h, mid);
		if (i == --j)
			break;
		swap = ref_hull(&ref[j]); /* whole: what was written in pieces is read slowly */
		ref_store(&ref[j], h);
		ref_store(&ref[i], swap);
		h = swap;
	}
	*left = l;
	*right = r;
	return i;
}

V float mid_of(const struct ref *r, unsigned k)
{
	return r->lo[k] - r->minus_hi[k];
}

/* In order along the axis where middles are spread most, as far as is needed: after this, those before the
 * wanted one are no farther than those behind. */
V void halve(struct ref *ref, uint32_t n, uint32_t want, const struct range *r)
{
	float size[4] __attribute__((aligned(16)));
	uint32_t lo = 0, hi = n - 1;
	unsigned k;

	q4_store(size, q4_sub(r->hi, r->lo));
	k = size[0] > size[1] ? (size[0] > size[2] ? 0 : 2) : (size[1] > size[2] ? 1 : 2);
	while (lo < hi) {
		float x = mid_of(&ref[lo + (hi - lo) / 2], k);
		uint32_t i = lo, j = hi;

		for (;; i++, j--) {
			struct ref swap;

			while (mid_of(&ref[i], k) < x)
				i++;
			while (mid_of(&ref[j], k) > x)
				j--;
			if (i >= j)
				break;
			swap = ref[i];
			ref[i] = ref[j];
			ref[j] = swap;
		}
		if (want <= j)
			hi = j;
		else
			lo = j + 1;
	}
}

#endif
