/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's binary tree: what its builders have in common, and the one for any processor. Twigs of a range of
 * references stand where the references do, those of the top behind all.
 */
#include "bvh8_sah.h"

/* Ranges at the top are larger than SMALL, and no two share a reference: fewer than this at each level, and
 * twice as many twigs. */
uint32_t bvh8_top_twigs(uint32_t refs)
{
	return 2 * 64 * (refs / SMALL + 1);
}

int bvh8_tree(struct builder *b, int (*make)(struct builder *))
{
	const ald_host *h = b->host;
	int one = b->value[P_LEAF] < SEATS || b->prims->tri_count < b->prims->count;
	uint32_t top = bvh8_top_twigs(b->room);
	uint64_t twigs;
	int status;

	b->twigs_a_ref = one ? 2 : 1;
	twigs = b->twigs_a_ref * (uint64_t)b->room;
	if (twigs > UINT32_MAX / 2)
		return ALD_NO_MEMORY;
	b->root = (uint32_t)twigs;
	b->twig = bvh8_take(h, twigs + top + 1, sizeof(*b->twig), "bvh8: building");
	b->task = bvh8_take(h, top, sizeof(struct range), "bvh8: building");
	b->part = bvh8_take(h, top + 1, sizeof(*b->part), "bvh8: building");
	b->seat = bvh8_take(h, twigs / 2 + top + 1, sizeof(*b->seat), "bvh8: building");
	b->id = bvh8_take(h, b->room, sizeof(*b->id), "bvh8: building");
	b->spare = (struct ref *)(void *)b->twig; /* until the tasks begin */
	if (!b->twig || !b->task || !b->part || !b->seat || !b->id)
		return ALD_NO_MEMORY;
	b->part[0] = (struct part){ .seat = b->seat + twigs / 2 };
	status = make(b);
	/* Room for what is kept. */
	h->free(h->ctx, b->ref);
	h->free(h->ctx, b->corner);
	b->ref = NULL;
	b->corner = NULL;
	return status;
}

int bvh8_sah_base(struct builder *b)
{
	return sah(b);
}
