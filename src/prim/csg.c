/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "prim/csg.h"

#include "alidade/kernel.h"
#include "scene/scene.h"

static const ald_box everywhere = { { -ALD_INF, -ALD_INF, -ALD_INF }, { ALD_INF, ALD_INF, ALD_INF } };

uint32_t csg_add(struct csg *c, struct mem_book *book, enum csg_op op, uint32_t parent)
{
	uint32_t i = c->node.count;
	struct csg_node *up;

	c->node.size = sizeof(struct csg_node);
	if (!buf_reserve(&c->node, book, "geometry", 1))
		return SCENE_NONE;
	c->node.count++;
	*csg_at(c, i) = (struct csg_node){ op, parent, SCENE_NONE, SCENE_NONE, SCENE_NONE, SCENE_NONE,
					   everywhere, everywhere };
	if (parent == SCENE_NONE)
		return i;
	up = csg_at(c, parent);
	if (up->last == SCENE_NONE)
		up->first = i;
	else
		csg_at(c, up->last)->next = i;
	up->last = i;
	return i;
}

static ald_box common(const ald_box *a, const ald_box *b)
{
	return (ald_box){ { ald_max(a->lo.x, b->lo.x), ald_max(a->lo.y, b->lo.y), ald_max(a->lo.z, b->lo.z) },
			  { ald_min(a->hi.x, b->hi.x), ald_min(a->hi.y, b->hi.y),
			    ald_min(a->hi.z, b->hi.z) } };
}

void csg_join_boxes(struct csg *c)
{
	for (uint32_t i = c->node.count; i--;) {
		struct csg_node *n = csg_at(c, i);

		if (n->op == CSG_LEAF)
			continue;
		n->box = n->op == CSG_INTERSECTION ? everywhere : ald_box_empty();
		for (uint32_t k = n->first; k != SCENE_NONE; k = csg_at(c, k)->next) {
			if (n->op == CSG_INTERSECTION)
				n->box = common(&n->box, &csg_at(c, k)->box);
			else
				ald_box_join(&n->box, &csg_at(c, k)->box);
		}
	}
}

ald_box csg_clip(const struct csg *c, uint32_t node, ald_box own)
{
	for (uint32_t i = csg_at(c, node)->parent; i != SCENE_NONE; i = csg_at(c, i)->parent)
		own = common(&own, &csg_at(c, i)->box);
	return own;
}
