/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's fast builder: what bvh8_fast.c, which puts references in order and joins the trees of single jobs, and
 * bvh8_crop.h, which makes those, know of each other.
 */
#ifndef BVH8_FAST_H
#define BVH8_FAST_H

#include "bvh8_hull.h"

#define CROP 2048u /* references that one job makes trees of, at most */
#define CELLS 128.0f /* to a side, to sort all by */
#define TIPS 16u /* trees that it leaves, at most, */
#define DEEP 28u /* and how many levels they have */

struct crop {
	uint32_t first, count; /* of the keys, and of the references in order */
	uint32_t tips;
};

struct fast {
	struct builder *b;
	uint64_t *spare; /* of keys, for sorting */
	struct crop *crop;
	uint32_t crops, room;
	struct twig *tip; /* [TIPS * crops] roots */
};

struct grid { /* of middles, doubled */
	q4 lo, scale;
};

/* Bits of x, y and z in turns (Morton). at: whole numbers below 2^10. */
V uint32_t morton(const int32_t at[4])
{
	typedef uint32_t four __attribute__((vector_size(16)));
	four x;

	memcpy(&x, at, sizeof(x));
	x = (x | x << 16) & 0x030000ffu;
	x = (x | x << 8) & 0x0300f00fu;
	x = (x | x << 4) & 0x030c30c3u;
	x = (x | x << 2) & 0x09249249u;
	return x[0] | x[1] << 1 | x[2] << 2;
}

/* cells: to a side of that size. */
V struct grid grid_of(q4 lo, float size, float cells)
{
	return (struct grid){ lo, q4_all(size > 0x1p-60f ? 0.99999f * cells / size : 0) };
}

V uint64_t grid_key(const struct grid *g, q4 mid, uint32_t id)
{
	int32_t at[4] __attribute__((aligned(16)));

	q4_whole(q4_mul(q4_sub(mid, g->lo), g->scale), at);
	return (uint64_t)morton(at) << 32 | id;
}

#endif
