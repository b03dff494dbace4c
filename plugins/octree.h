/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What octree's two halves share: octree_build.c makes it, octree_walk.h goes through it.
 */
#ifndef OCTREE_H
#define OCTREE_H

#include <alidade/accel.h>
#include <alidade/fast.h>
#include <alidade/kernel.h>

#define DEPTH_MAX 21

struct octree_isa { /* the walk, for an instruction set */
	void (*nearest)(const ald_accel *, ald_query *, const ald_ray *, ald_hit *, uint32_t n);
	void (*occluded)(const ald_accel *, ald_query *, const ald_ray *, uint8_t *, uint32_t n);
};

extern const struct octree_isa octree_plain, octree_sse, octree_avx2, octree_avx512;

struct leaf {
	uint32_t block, tris; /* first of its blocks; how many triangles they hold */
	uint32_t other, others; /* primitives that are no triangles, in other[] */
};

struct ald_accel {
	const ald_host *host;
	const ald_prims *prims;
	const struct octree_isa *isa;
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

/* Plain loops over eight lanes become as wide as the instruction set they are compiled for. */
#define EACH(i) for (unsigned i = 0; i < 8; i++)

/* Bit k of each child's number. */
#define CHILD_BITS                                                                                   \
	{ { 0, 1, 0, 1, 0, 1, 0, 1 }, { 0, 0, 1, 1, 0, 0, 1, 1 }, { 0, 0, 0, 0, 1, 1, 1, 1 } }

enum octree_param { P_DEPTH, P_LEAF, P_PRICE, P_INDEX, P_SHAPE, P_NODE, P_WALK, P_ISA };
enum { INDEX_AUTO, INDEX_16, INDEX_32 };
enum { SHAPE_CUBE, SHAPE_BOX };
enum { NODE_BOX, NODE_SPHERE };

/* value[] is in the order of enum octree_param. */
int octree_build(const ald_host *, const ald_prims *, const double *value, ald_accel **out,
		 ald_error *);
void octree_destroy(ald_accel *);

#endif
