/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What octree's two halves share: octree_build.c makes it, octree.c walks through it.
 */
#ifndef OCTREE_H
#define OCTREE_H

#include <alidade/accel.h>
#include <alidade/fast.h>
#include <alidade/kernel.h>

#define DEPTH_MAX 21

#if defined __x86_64__ && defined __GNUC__ && !defined __AVX2__ && !defined __SANITIZE_ADDRESS__
#define WIDE __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define WIDE
#endif

struct leaf {
	uint32_t block, tris; /* first of its blocks; how many triangles they hold */
	uint32_t other, others; /* primitives that are no triangles, in other[] */
};

struct ald_accel {
	const ald_host *host;
	const ald_prims *prims;
	ald_frame frame;
	ald_box box; /* around the primitives */
	double middle[3], reach[3]; /* its centre and half size, and a little more */
	double centre[3], half[3]; /* of the root cell */
	/* Child k of node n is index[8 n + k]: 0 none; below inner a node, else leaf index - inner. */
	uint32_t *wide; /* one of these two is NULL */
	uint16_t *narrow;
	uint8_t *kids; /* of each node: one bit for each child there is */
	struct leaf *leaf;
	/* ALD_LANES triangles each, in the order of the leaves; fast with ALD_PRECISION_FAST, else NULL. */
	ald_triangles *block;
	ald_fast_triangles *fast;
	uint32_t (*id)[ALD_LANES];
	uint32_t *other;
	uint32_t inner, leaves, blocks, others, depth;
	uint64_t refs, bytes;
	double ball, ball_pad; /* nodes are spheres: the root's radius, each level's is half, and what is added; or 0 */
	int root_is_leaf;
	int calls; /* the walk calls itself */
};

/* Plain loops over eight lanes: unlike vector types, which gcc takes apart before it makes clones, they
 * become as wide as each clone can be. */
#define EACH(i) for (unsigned i = 0; i < 8; i++)

/* Bit k of each child's number. */
#define CHILD_BITS                                                                                   \
	{ { 0, 1, 0, 1, 0, 1, 0, 1 }, { 0, 0, 1, 1, 0, 0, 1, 1 }, { 0, 0, 0, 0, 1, 1, 1, 1 } }

/* The lanes that are not 0. */
ALD_INLINE uint32_t lanes(const int64_t in[8])
{
	uint32_t bits = 0;

	EACH(i)
		bits |= (uint32_t)in[i] << i;
	return bits;
}

enum octree_param { P_DEPTH, P_LEAF, P_PRICE, P_INDEX, P_SHAPE, P_NODE, P_WALK };
enum { INDEX_AUTO, INDEX_16, INDEX_32 };
enum { SHAPE_CUBE, SHAPE_BOX };
enum { NODE_BOX, NODE_SPHERE };

/* value[] is in the order of enum octree_param. */
int octree_build(const ald_host *, const ald_prims *, const double *value, ald_accel **out,
		 ald_error *);
void octree_destroy(ald_accel *);

#endif
