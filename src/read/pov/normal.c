/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Normals (manual 3.4.6.2): a pattern that bends them, by how much, and its map.
 */
#include <config.h>

#include "read/pov/pattern.h"

static bool blocks(enum pattern_kind k)
{
	return k < PATTERN_OBJECT;
}

static void draft_from(struct pattern_draft *d, const struct pov_normal *from)
{
	pattern_draft_init(d, IN_NORMAL, from->normal ? from->normal->pattern : NULL);
	d->map = (struct pov_map){ .lack = from->lack, .depth = from->depth };
	d->amount = 0.5;
	d->accuracy = 0.02;
	if (!from->normal)
		return;
	d->map.map = from->normal->map;
	d->amount = from->normal->amount;
	d->accuracy = from->normal->accuracy;
	d->no_bump_scale = from->normal->no_bump_scale;
}

static bool finish(struct pov *p, struct pov_normal *out, struct pattern_draft *d, bool uv)
{
	struct normal n = { .uv = uv,
			    .no_bump_scale = d->no_bump_scale,
			    .amount = d->amount,
			    .accuracy = d->accuracy,
			    .map = d->map.map };

	n.pattern = pattern_finish(p, d);
	out->lack = d->lack;
	pov_lack_add(&out->lack, &d->map.lack);
	out->depth = d->map.depth;
	normal_examine(&n);
	out->normal = pov_copy(p, &n, sizeof(n));
	return !pov_failed(p);
}

bool pov_normal_body(struct pov *p, struct pov_normal *out)
{
	struct pov_normal *named = pov_take(p, ITEM_NORMAL);
	struct pattern_draft d;
	struct normal *n;
	bool uv;

	if (named)
		*out = *named;
	if (pov_accept(p, TOK_UV_MAPPING)) {
		*out = pov_default_texture(p)->layer[0].normal;
		if (!pov_nest(p) || !pov_normal_body(p, out))
			return false;
		pov_unnest(p);
		if (!out->normal)
			return true;
		n = pov_copy(p, out->normal, sizeof(*n));
		if (!n)
			return false;
		n->uv = true;
		normal_examine(n);
		out->normal = n;
		return true;
	}
	draft_from(&d, out);
	uv = out->normal && out->normal->uv;
	if (pattern_word(p, &d)) {
		uv = false;
		if (blocks(d.pattern.kind))
			d.accuracy = 0.02;
	}
	pov_comma(p);
	if (!pov_failed(p) && pov_starts_number(p))
		d.amount = pov_finite_float(p, "the normal's depth");
	d.average = d.given && d.pattern.kind == PATTERN_AVERAGE;
	pattern_modifiers(p, &d);
	if (d.average && !d.map.map.count && !pov_failed(p))
		pov_fail(p, "average needs a normal_map");
	return finish(p, out, &d, uv);
}

struct pov_normal *pov_read_normal(struct pov *p, const struct pov_normal *base)
{
	struct pov_normal normal = *base;

	if (!pov_open(p) || !pov_normal_body(p, &normal))
		return NULL;
	return pov_close(p, "normal") ? pov_copy(p, &normal, sizeof(normal)) : NULL;
}

static bool keep_normal(struct pov *p, struct normal **n)
{
	struct normal *copy;

	if (!*n)
		return true;
	copy = pov_copy(p, *n, sizeof(*copy));
	if (!copy)
		return false;
	copy->no_bump_scale = true; /* and so have those in its map */
	*n = copy;
	return true;
}

static bool keep_map(struct pov *p, struct map *m);

static bool keep_tree(struct pov *p, struct texture **t)
{
	struct texture *copy = pov_copy(p, *t, sizeof(*copy));

	if (!copy)
		return false;
	*t = copy;
	if (!copy->count)
		return keep_map(p, &copy->map);
	copy->layer = pov_copy(p, copy->layer, copy->count * sizeof(*copy->layer));
	for (uint32_t i = 0; copy->layer && i < copy->count; i++) {
		if (!keep_normal(p, &copy->layer[i].normal))
			return false;
	}
	return copy->layer != NULL;
}

static bool keep_map(struct pov *p, struct map *m)
{
	m->entry = pov_copy(p, m->entry, m->count * sizeof(*m->entry));
	for (uint32_t i = 0; m->entry && i < m->count; i++) {
		if (!keep_tree(p, &m->entry[i].is.texture))
			return false;
	}
	return m->entry != NULL;
}

bool pov_texture_keep_bumps(struct pov *p, struct pov_texture *t)
{
	if (!t->count)
		return !t->map.map.count || keep_map(p, &t->map.map);
	for (uint32_t i = 0; i < t->count; i++) {
		if (!keep_normal(p, &t->layer[i].normal.normal))
			return false;
	}
	return true;
}
