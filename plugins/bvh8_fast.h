/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's fast builder: what bvh8_fast.c, which puts references in order, bvh8_crop.h, which makes trees of some
 * thousands, and bvh8_crown.c, which makes one of these, know of each other.
 */
#ifndef BVH8_FAST_H
#define BVH8_FAST_H

#include <stdatomic.h>

#include "bvh8_hull.h"

#define PIECE 32768u /* references that one job sorts together */
#define CROP 2048u /* references that one tree is made of, at most */
#define CELLS 128.0f /* to a side, to sort all by */
#define LOW_BITS 11u /* of a cell's code, sorted by first */
/* Huge pages to be cleared before anybody writes there: other threads have less time for it than one takes. */
#define AHEAD_OF(threads) (1 + (threads) / 8)
#define TIPS 16u /* trees that a crop leaves, at most, */
#define DEEP 28u /* and how many levels they have */

struct grid { /* of middles, doubled */
	q4 lo, scale;
};

struct crop {
	uint32_t first, count; /* of the keys */
	uint32_t tips, leaves;
	uint32_t round; /* of one that is too large: how often it was divided */
	double cost; /* areas of nodes and of blocks */
};

struct sprig { /* a node in the making: its children, the largest first; EMPTY: none */
	uint32_t kid[WIDTH];
};

struct fast {
	struct builder *b;
	uint64_t *spare; /* of keys, for sorting: where triangles will be */
	uint32_t (*count)[1u << LOW_BITS]; /* of a piece of the keys: of each lower digit */
	int counted;
	struct crop *crop;
	uint32_t crops;
	/* [TIPS * crops] roots of trees that are done: kid is what rays go down to, count its levels and 1 */
	struct twig *tip;
	void *desk; /* where one thread makes trees, one for each */
	_Atomic uint32_t next; /* the crop that nobody has begun yet */
	/* What was asked for so far; there is room for less, perhaps, and then nothing is written behind it. */
	_Atomic uint64_t nodes, blocks, others;
	uint64_t node_room, block_room, other_room;
};

struct coder { /* to cells from doubled middles, less twice the centre */
	double scale, from[3];
	struct grid grid; /* the same of hulls */
	struct fast *f;
	uint32_t *valid; /* of a piece: primitives that can be hit */
	uint32_t pieces;
};

/* The tree's memory is taken before it is known how much of it is needed: for what most meshes take, and some. */
#define BLOCKS_MORE 1.5 /* blocks, to what full ones would be; there are 1.2 to 1.5 times as many */
#define NODES_MORE 0.36 /* nodes, to blocks; there are 0.27 to 0.34 */

V void fast_room(const struct builder *b, uint64_t *nodes, uint64_t *blocks, uint64_t *others)
{
	double leaf = b->value[P_LEAF] < SEATS ? b->value[P_LEAF] : SEATS;
	uint64_t other = b->prims->count - b->prims->tri_count;

	*blocks = (uint64_t)((leaf > BLOCKS_MORE ? BLOCKS_MORE / leaf : 1) * b->refs) + 16;
	*nodes = (uint64_t)(NODES_MORE * (double)(*blocks + other)) + 16;
	*others = 2 * other;
}

int bvh8_crown(struct fast *); /* from tips to the root */

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

/* How often there is which digit. Two lists: neighbours mostly have one digit, and would wait for each other. */
V void count_digits(const uint64_t *key, uint32_t n, uint32_t shift, uint32_t mask, uint32_t *out)
{
	uint32_t odd[1u << LOW_BITS];
	uint32_t i;

	memset(out, 0, (mask + 1) * sizeof(*out));
	memset(odd, 0, sizeof(odd));
	for (i = 0; i + 1 < n; i += 2) {
		out[key[i] >> shift & mask]++;
		odd[key[i + 1] >> shift & mask]++;
	}
	if (i < n)
		out[key[i] >> shift & mask]++;
	for (i = 0; i <= mask; i++)
		out[i] += odd[i];
}

#endif
