/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8: what its files share.
 *
 * Everything is in floats and in coordinates of its own: X = (x - centre) * scale, scale a power of two, so
 * that the scene lies within [-1, 1] wherever and however large it is. A ray is moved to where it enters the
 * scene's box, and t is counted from there. Planes of boxes are rounded outward; what the rest of the float
 * arithmetic may err, BOX_ERROR and EDGE_ERROR bound, and rays are grown by it. So what the walk rejects is
 * surely not hit, and what is left is decided by alidade/kernel.h in doubles (R1).
 *
 * BOX_ERROR: with |X| <= 1 and directions scaled to a largest component in [1/2, 1), the origin's rounding is
 * 2^-25, that of origin * inverse 2^-24 and so is that of plane * inverse where there is no fma; the inverse
 * and the sum are off by 2^-24 of a distance <= 2 each: less than 2^-21 in all, as seen from the plane.
 *
 * EDGE_ERROR: corner and origin are off by 2^-25, their difference by 2^-24 more, and shearing adds the
 * same of z, the slope's 2^-23, the product's and the sum's 2^-23: a sheared coordinate is off by h <=
 * 5 * 2^-23. Where the line meets the triangle, no sheared coordinate is more than twice its extent x. Then a
 * weight, c d - e f, is off by at most 8 x h + 2 h h + 3 * 2^-24 * 8 x x < 2^-20 (12 x + 4 * 2^-20). Nothing
 * is lost by using this where the line misses. That is a block's slack, for corners at any distance; most are
 * nearer, and block_slack() tells less for them.
 *
 * With --precision=fast all bounds are 0 and nothing is asked of the doubles: what being right costs is the
 * difference.
 */
#ifndef BVH8_H
#define BVH8_H

#include <alidade/accel.h>
#include <alidade/kernel.h>

#include "isa.h"

#define WIDTH 8u /* children of a node */
#define SEATS 4u /* triangles of a block */
#define BLOCKS_MAX 7u /* blocks of a leaf */
#define BOX_ERROR 0x1p-21f
#define EDGE_ERROR 0x1p-20f
#define LEVELS_MAX 56u /* of wide nodes, whatever the scene is */
#define INTERLEAVE_MAX 48u
#define HUGE_PAGE ((size_t)2 << 20)
#define STACK_MAX ((WIDTH - 1) * LEVELS_MAX + 2)

/* A reference to a child: a node's number; or a leaf's first block and how many it has; or where in
 * other[] there is a count and so many ids. EMPTY: no child. */
#define REF_LEAF 0x80000000u
#define REF_OTHERS 0xf0000000u
#define REF_SHIFT 28
#define REF_INDEX 0x0fffffffu
#define EMPTY UINT32_MAX

struct node { /* 64-aligned, four cache lines */
	float plane[6][WIDTH]; /* low x, high x, low y, high y, low z, high z; low > high: no child */
	uint32_t child[WIDTH]; /* the larger a child's box, the earlier it stands */
	/* By the signs of a direction, bits 0 to 2 set where x, y, z go down: children as a ray mostly meets them, the
	 * nearest last, three bits each. A guess, filled by bvh8_order.h where an instruction set goes by it. */
	uint32_t order[WIDTH];
};

struct block { /* of a leaf */
	float v[3][3][SEATS]; /* corner, axis */
	float slack[SEATS]; /* the bound on a weight; an empty seat has -1 */
	uint32_t id[SEATS];
};

struct isa; /* the walk, compiled for an instruction set */

#define MASKS 8u /* different ones of primitives that are noted */

struct ald_accel {
	const ald_host *host;
	const ald_prims *prims;
	const struct isa *isa;
	struct node *node;
	struct block *block;
	uint32_t *other;
	uint32_t root; /* a reference */
	uint32_t nodes, blocks, others, leaves, depth, interleave;
	int parts; /* triangles were split, so a ray can meet one again in another leaf */
	int herds; /* where rays go together, so do they */
	int lone; /* single rays that nobody counts have a shorter way */
	int hasty; /* it was built fast */
	int far; /* the tree is larger than a cache; 2: far larger */
	uint32_t mask[MASKS], masks; /* that primitives have; 0: nobody looked, or too many */
	int fast; /* ALD_PRECISION_FAST: no bounds, and floats have the last word */
	double centre[3], scale; /* to X */
	ald_box box; /* around the primitives, grown (R4) */
	ald_frame frame;
	uint64_t refs, bytes;
	uint32_t held; /* primitives that are in it */
	double built_sum, lost; /* see bvh8_refit.c: how good it was, and what rays have lost since; 0: not known yet */
	double cost; /* expected, of a ray that meets the scene's box: nodes and blocks it opens */
};

struct isa {
	const char *name;
	void (*nearest)(const ald_accel *, ald_query *, const ald_ray *, ald_hit *, uint32_t n,
			uint32_t hints);
	void (*occluded)(const ald_accel *, ald_query *, const ald_ray *, uint8_t *, uint32_t n,
			 uint32_t hints);
	/* One ray, where ald_accel.lone says so. */
	void (*nearest_one)(const ald_accel *, ald_query *, const ald_ray *, ald_hit *);
	uint32_t (*occluded_one)(const ald_accel *, ald_query *, const ald_ray *);
	void (*order)(struct node *, uint32_t n); /* of children; NULL: rays sort them */
};

extern const uint8_t bvh8_lanes[256][8]; /* of each set of lanes, which they are, the last first */
extern const struct isa bvh8_plain, bvh8_sse, bvh8_avx2, bvh8_avx512;

enum bvh8_param { P_SPLIT, P_LEAF, P_ISA, P_INTERLEAVE, P_BUILD };
enum { BUILD_AUTO, BUILD_SAH, BUILD_FAST };

/* ---- building ---- */

struct ref { /* a box, of a primitive or a part of one */
	float lo[3];
	uint32_t id;
	float minus_hi[3];
	float zero; /* 1: has to stay whole */
};

struct twig { /* a node of the binary tree; its children stand side by side */
	float lo[3];
	uint32_t kid; /* of an inner node: the first child; of a leaf: its first reference */
	float hi[3];
	uint32_t count; /* references of a leaf; 0: inner */
};

struct seat { /* of a node: the twig it is made of, and where its first of each kind of child is */
	uint32_t twig, node, block, other;
};

struct part { /* of the wide tree: what one job makes, numbered from 0 each */
	struct seat *seat;
	uint32_t twig; /* its root, among the top's */
	uint32_t seats, blocks, others, leaves, depth;
	uint32_t node, block, other; /* where those are in the whole */
	uint64_t refs;
	double cost;
};

struct builder {
	const ald_host *host;
	const ald_prims *prims;
	const double *value;
	ald_accel *a;
	struct ref *ref, *spare; /* spare: of the same size, for parallel sorting */
	uint32_t *id; /* of ref[], once that is in order and gone */
	uint64_t *key; /* instead of ref, building fast: a place on a curve, and below that a primitive */
	struct twig *twig;
	void *task; /* ranges that were one job each */
	float *corner; /* of triangles, three times x, y, z, 0; NULL: none is to be cut */
	float whole; /* half the area of the scene's box */
	struct part *part; /* the top, and then the tasks */
	struct seat *seat;
	int fast; /* for few rays */
	uint32_t refs, room; /* room: how many refs there may be */
	uint32_t twigs_a_ref, root, top, tasks; /* top: twigs above the tasks */
};

void *bvh8_take(const ald_host *, uint64_t n, size_t each, const char *what);
/* These bytes of p, fresh memory, are got and cleared, before two threads come to one page together and both do it. */
void bvh8_touch(const void *p, size_t from, size_t to);
void bvh8_touch_all(const ald_host *, const void *p, size_t bytes); /* each page by one thread */
int bvh8_refs(struct builder *); /* what all is measured by, and ref[] from the primitives unless it is built fast */
int bvh8_is_thin(struct builder *); /* are triangles long and thin, so that cutting them would pay? */
int bvh8_split(struct builder *); /* corner[] and room, if triangles are to be cut */
int bvh8_is_fast(struct builder *); /* by value, or by how many rays there will be */
/* Of the references, of which id[n] is a sample: for how many there would be room; *wanted: what triangles cut in
 * thought came to. */
double bvh8_room(struct builder *, const uint32_t *id, uint32_t n, double *wanted);
/* Around all bounds(): as the host says, or an older one doesn't. */
int bvh8_find_box(const ald_host *, const ald_prims *, ald_box *);
void bvh8_place(ald_accel *, const ald_box *); /* the coordinates X, from the scene's box */
int bvh8_can_be_hit(const ald_prims *, uint32_t id);
int bvh8_predict(const ald_host *, const ald_prims *, const double *value, ald_memory *out);
int bvh8_tree(struct builder *, int (*make)(struct builder *)); /* ref[] to id[] in order, and twig[] */
uint32_t bvh8_top_twigs(uint32_t refs);
int bvh8_sah_base(struct builder *);
int bvh8_sah_avx2(struct builder *);
/* Jobs of the fast builder, for an instruction set. */
struct bvh8_crop {
	void (*key)(void *coder, uint32_t piece);
	void (*crop)(void *fast, uint32_t desk);
	size_t desk; /* what a thread works at */
};
int bvh8_fast(struct builder *, const struct bvh8_crop *); /* from the primitives to all that rays walk through */
extern const struct bvh8_crop bvh8_crop_base, bvh8_crop_avx2;
struct rows { /* what twigs of a task's tree cost, see bvh8_fill.h */
	float *row; /* behind what row 0 would be there is one for each pair of twigs, the first pair being base */
	uint32_t base;
	float more; /* what a node costs besides its area */
};
extern const float bvh8_row_leaf[2 * WIDTH]; /* the second half */
void bvh8_seat(struct builder *, struct part *, const struct rows *, uint32_t root); /* its nodes get places */
int bvh8_widen(struct builder *); /* twig[] to what rays walk through */
void bvh8_note_masks(ald_accel *);
int bvh8_refit(ald_accel *, ald_error *);
void bvh8_destroy(ald_accel *);

#endif
