/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "render/fold.h"

#include "shade/indirect.h"
#include "shade/pov/spectrum.h"

/* POV-Ray's reflection exponent changes what a mirror shows (manual 3.4.6.3.6). Less than no light, as where
 * filter and transmit are more than 1 together, has no such power: POV-Ray's pixel is no number then. */
static struct rgb bend(struct rgb c, double exponent)
{
	if (exponent == 1)
		return c;
	return rgb_make(pow(fmax(c.r, 0), exponent), pow(fmax(c.g, 0), exponent), pow(fmax(c.b, 0), exponent));
}

/* What a part makes of its children, with how sure it is. */
struct folded {
	struct rgb colour, variance;
	double transmit;
};

static struct rgb squared(struct rgb a)
{
	return rgb_mul(a, a);
}

static struct folded folded_node(const struct node *n)
{
	return (struct folded){ n->colour, n->variance, n->transmit };
}

static void add_bands(struct folded *out, const struct tree *t, uint32_t child, struct rgb share)
{
	const struct node *n = BUF_AT(&t->node, struct node, child);

	out->colour = rgb_add(out->colour, rgb_mul(share, n->colour));
	out->variance = rgb_add(out->variance, rgb_mul(squared(share), n->variance));
}

/* Light that was split, put together again. Nothing of the background's transparency is left of it. */
static struct folded fold_bands(const struct tree *t, const struct part *p)
{
	struct folded out = { .transmit = 0 };
	uint32_t next = p->through;

	for (uint32_t i = 0; i < p->bands; i++) {
		if (i < p->total_from || i >= p->total_to)
			add_bands(&out, t, next++, spectrum_colour(i, i + 1, p->bands));
	}
	if (p->total_from < p->total_to)
		add_bands(&out, t, next, spectrum_colour(p->total_from, p->total_to, p->bands));
	return out;
}

/* What comes through the surface, with the part's filter and the fading of the way in. */
static void fold_through(const struct tree *t, const struct part *p, struct folded *out)
{
	struct rgb c = p->fade;
	struct folded from;

	if (p->through == TREE_NONE)
		return;
	from = p->bands ? fold_bands(t, p) : folded_node(BUF_AT(&t->node, struct node, p->through));
	if (!p->total) {
		c = rgb_mul(c, p->filter);
		out->transmit = rgb_grey(p->fade) * from.transmit * p->clear;
	}
	out->colour = rgb_add(out->colour, rgb_mul(c, from.colour));
	out->variance = rgb_add(out->variance, rgb_mul(squared(c), from.variance));
}

/* What rays bring that were sent from below the surface. */
static void fold_scatter(const struct radiosity *r, const struct tree *t, const struct part *p, struct folded *out)
{
	for (uint32_t i = 0; i < p->scatter_count; i++) {
		const struct scatter *s = BUF_AT(&t->scatter, struct scatter, p->first_scatter + i);
		const struct node *child = BUF_AT(&t->node, struct node, s->child);
		struct rgb c = s->gathered ? indirect_one(r, child->colour) : child->colour;

		out->colour = rgb_add(out->colour, rgb_mul(s->factor, c));
		out->variance = rgb_add(out->variance, rgb_mul(squared(s->factor), child->variance));
	}
}

static void fold_part(const struct radiosity *r, const struct tree *t, const struct part *p, struct folded *out)
{
	*out = (struct folded){ .colour = p->own };
	fold_through(t, p, out);
	fold_scatter(r, t, p, out);
	for (uint32_t i = 0; i < p->mirror_count; i++) {
		const struct mirror *m = BUF_AT(&t->mirror, struct mirror, p->first_mirror + i);
		const struct node *child;

		if (m->child == TREE_NONE)
			continue;
		child = BUF_AT(&t->node, struct node, m->child);
		out->colour = rgb_add(out->colour, rgb_mul(m->reflectivity, bend(child->colour, m->exponent)));
		out->variance = rgb_add(out->variance, rgb_mul(squared(m->reflectivity), child->variance));
	}
}

/* Paths after the first bounce are part of what its replications tell. */
static void fold_gathers(const struct shader *sh, struct tree *t, struct node *n)
{
	for (uint32_t i = 0; i < n->gather_count; i++) {
		const struct gather *g = BUF_AT(&t->gather, struct gather, n->first_gather + i);
		const struct radiosity *r = &sh->scene->radiosity;
		struct rgb variance, light;

		if (g->recorded && g->count)
			indirect_record(r, &sh->indirect, t, n, i);
		light = indirect_fold(r, t, g, n->bounce ? NULL : &variance);
		n->colour = rgb_add(n->colour, rgb_mul(g->factor, light));
		if (!n->bounce)
			n->variance = rgb_add(n->variance, rgb_mul(squared(g->factor), variance));
	}
}

void fold_nodes(const struct shader *sh, struct tree *t, uint32_t first, uint32_t count)
{
	for (uint32_t i = first; i < first + count; i++) {
		struct node *n = BUF_AT(&t->node, struct node, i);

		if (!n->part_count && !n->veil) /* it left the scene: all is said */
			continue;
		for (uint32_t j = 0; j < n->part_count; j++) {
			const struct part *p = BUF_AT(&t->part, struct part, n->first_part + j);
			struct folded f;

			fold_part(&sh->scene->radiosity, t, p, &f);
			n->colour = rgb_add(n->colour, rgb_scale(f.colour, p->share));
			n->variance = rgb_add(n->variance, rgb_scale(f.variance, p->share * p->share));
			n->transmit += f.transmit * p->share;
		}
		fold_gathers(sh, t, n);
		if (n->veil) {
			const struct veil *v = BUF_AT(&t->veil, struct veil, n->veil - 1);

			n->colour = rgb_add(rgb_mul(n->colour, v->clear), v->glow);
			n->variance = rgb_mul(n->variance, squared(v->clear));
			n->transmit *= rgb_grey(v->clear);
		}
		/* What shares it errs together: the sum's variance may be k times the k variances' sum. */
		n->variance = rgb_scale(n->variance, n->sharers + 1);
	}
}
