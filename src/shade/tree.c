/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "shade/tree.h"

#include <string.h>

#include "shade/cache.h"

#include "shade/pov/media.h"
#include "shade/pov/subsurface.h"

void tree_init(struct tree *t, struct mem_book *book)
{
	memset(t, 0, sizeof(*t));
	t->book = book;
	t->node.size = sizeof(struct node);
	t->part.size = sizeof(struct part);
	t->mirror.size = sizeof(struct mirror);
	t->inside.size = sizeof(struct inside);
	t->veil.size = sizeof(struct veil);
	t->gather.size = sizeof(struct gather);
	t->scatter.size = sizeof(struct scatter);
	t->beneath.size = sizeof(struct beneath);
	t->met.size = sizeof(struct met);
	t->lift.size = sizeof(struct lift);
	t->layer.size = sizeof(struct lit_layer);
	t->lit.size = sizeof(struct lit);
	t->shadow.size = sizeof(struct shadow);
	t->soft.size = sizeof(struct soft);
	t->cell.size = sizeof(struct cell);
	t->asked.size = sizeof(uint32_t);
	t->plain.size = sizeof(struct plain);
	t->plain_light.size = sizeof(struct plain_light);
	t->ray.size = sizeof(ald_ray);
	t->hit.size = sizeof(ald_hit);
	t->hidden.size = sizeof(uint8_t);
	t->record.size = sizeof(struct cache_record);
	t->strata.size = sizeof(struct cache_ray);
	media_sizes(t);
	subsurface_sizes(t);
}

void tree_reset_wave(struct tree *t)
{
	t->met.count = t->lift.count = t->layer.count = t->lit.count = t->shadow.count = 0;
	t->soft.count = t->cell.count = t->asked.count = t->plain.count = 0;
}

void tree_reset(struct tree *t)
{
	t->node.count = t->part.count = t->mirror.count = t->inside.count = t->veil.count = 0;
	t->gather.count = t->scatter.count = t->beneath.count = 0;
	tree_reset_wave(t);
}

void tree_release(struct tree *t)
{
	struct buf *all[] = { &t->node, &t->part,  &t->mirror, &t->inside, &t->veil, &t->gather, &t->met, &t->layer,
			      &t->lift, &t->plain, &t->plain_light,
			      &t->lit, &t->shadow, &t->soft, &t->cell, &t->asked, &t->ray,	   &t->hit, &t->hidden,
			      &t->record, &t->strata,
			      &t->media.segment, &t->media.span, &t->media.reach, &t->media.sample,
			      &t->media.slot, &t->scatter, &t->beneath, &t->below.place, &t->below.probe,
			      &t->below.sample };

	for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); i++)
		buf_release(all[i]);
}

bool tree_grow(struct tree *t, struct buf *b, uint32_t n)
{
	if (buf_reserve(b, t->book, "render", n))
		return true;
	t->no_memory = true;
	return false;
}

void tree_veil(struct tree *t, uint32_t node, struct rgb clear, struct rgb glow)
{
	uint32_t i = BUF_AT(&t->node, struct node, node)->veil;
	struct veil *v;

	if (!i) {
		i = tree_push(t, &t->veil, 1);
		if (i == TREE_NONE)
			return;
		*BUF_AT(&t->veil, struct veil, i) = (struct veil){ clear, glow };
		BUF_AT(&t->node, struct node, node)->veil = i + 1;
		return;
	}
	v = BUF_AT(&t->veil, struct veil, i - 1);
	v->glow = rgb_add(rgb_mul(clear, v->glow), glow);
	v->clear = rgb_mul(clear, v->clear);
}

bool inside_contains(const struct tree *t, uint32_t list, uint32_t object)
{
	for (; list != TREE_NONE; list = BUF_AT(&t->inside, struct inside, list)->outer) {
		if (BUF_AT(&t->inside, struct inside, list)->object == object)
			return true;
	}
	return false;
}

bool inside_hollow(const struct tree *t, uint32_t list)
{
	for (; list != TREE_NONE; list = BUF_AT(&t->inside, struct inside, list)->outer) {
		if (!BUF_AT(&t->inside, struct inside, list)->hollow)
			return false;
	}
	return true;
}

uint32_t inside_enter(struct tree *t, uint32_t list, uint32_t object, uint32_t interior, bool hollow)
{
	uint32_t i = tree_push(t, &t->inside, 1);

	if (i == TREE_NONE)
		return list;
	*BUF_AT(&t->inside, struct inside, i) =
		(struct inside){ .object = object, .interior = interior, .outer = list, .hollow = hollow };
	return i;
}

uint32_t inside_leave(struct tree *t, uint32_t list, uint32_t object)
{
	struct inside head;

	if (list == TREE_NONE)
		return list;
	head = *BUF_AT(&t->inside, struct inside, list);
	if (head.object == object)
		return head.outer;
	/* Overlapping solids are few, so the entries further in are simply made anew. */
	return inside_enter(t, inside_leave(t, head.outer, object), head.object, head.interior, head.hollow);
}
