/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "render/fold.h"

/* POV-Ray's reflection exponent changes what a mirror shows (manual 3.4.6.3.6). */
static struct rgb bend(struct rgb c, double exponent)
{
	if (exponent == 1)
		return c;
	return rgb_make(pow(c.r, exponent), pow(c.g, exponent), pow(c.b, exponent));
}

/* What comes through the surface, with the part's filter and the fading of the way in. */
static void fold_through(const struct tree *t, const struct part *p, struct rgb *colour,
			 double *transmit)
{
	const struct node *child;
	struct rgb c;

	if (p->through == TREE_NONE)
		return;
	child = BUF_AT(&t->node, struct node, p->through);
	c = rgb_mul(p->fade, child->colour);
	if (!p->total) {
		c = rgb_mul(c, p->filter);
		*transmit = rgb_grey(p->fade) * child->transmit * p->clear;
	}
	*colour = rgb_add(*colour, c);
}

static void fold_part(const struct tree *t, const struct part *p, struct rgb *colour, double *transmit)
{
	*colour = p->own;
	*transmit = 0;
	fold_through(t, p, colour, transmit);
	for (uint32_t i = 0; i < p->mirror_count; i++) {
		const struct mirror *m = BUF_AT(&t->mirror, struct mirror, p->first_mirror + i);
		const struct node *child;

		if (m->child == TREE_NONE)
			continue;
		child = BUF_AT(&t->node, struct node, m->child);
		*colour = rgb_add(*colour, rgb_mul(m->reflectivity, bend(child->colour, m->exponent)));
	}
}

void fold_nodes(struct tree *t, uint32_t first, uint32_t count)
{
	for (uint32_t i = first; i < first + count; i++) {
		struct node *n = BUF_AT(&t->node, struct node, i);

		for (uint32_t j = 0; j < n->part_count; j++) {
			const struct part *p = BUF_AT(&t->part, struct part, n->first_part + j);
			struct rgb colour;
			double transmit;

			fold_part(t, p, &colour, &transmit);
			n->colour = rgb_add(n->colour, rgb_scale(colour, p->share));
			n->transmit += transmit * p->share;
		}
		if (n->veil) {
			const struct veil *v = BUF_AT(&t->veil, struct veil, n->veil - 1);

			n->colour = rgb_add(rgb_mul(n->colour, v->clear), v->glow);
			n->transmit *= rgb_grey(v->clear);
		}
	}
}
