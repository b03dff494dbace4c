/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Constructive solid geometry as a forest (manual 3.4.5.6).
 *
 * Every surface of every object in it stays a primitive of its own, with a box that the solids around it
 * bound; what the tree adds is the question whether a crossing of that surface shows. It shows if, on the
 * way up, all siblings in an intersection hold the place, and no sibling in a merge does (Roth: Ray Casting
 * for Modeling Solids, 1982). accel/csg.c asks it.
 */
#ifndef ALIDADE_PRIM_CSG_H
#define ALIDADE_PRIM_CSG_H

#include "alidade/accel.h"
#include "base/buf.h"

enum csg_op { CSG_LEAF, CSG_UNION, CSG_MERGE, CSG_INTERSECTION };

struct csg_node {
	enum csg_op op;
	uint32_t parent, first, last, next; /* SCENE_NONE: there is none */
	uint32_t leaf; /* of the set's */
	ald_box box; /* holds the solid; in world coordinates, later those of level 0; may be infinite */
	ald_box clip; /* of a leaf: what shows of its surface is in here; in world coordinates */
};

struct csg {
	struct buf node; /* parents before their children */
};

/* The new node's index, SCENE_NONE: no memory. */
uint32_t csg_add(struct csg *, struct mem_book *, enum csg_op, uint32_t parent);
/* From the leaves' boxes to those of all other nodes. */
void csg_join_boxes(struct csg *);
/* What the nodes above a leaf leave of its own box. */
ald_box csg_clip(const struct csg *, uint32_t node, ald_box own);

static inline struct csg_node *csg_at(const struct csg *c, uint32_t i)
{
	return BUF_AT(&c->node, struct csg_node, i);
}

#endif
