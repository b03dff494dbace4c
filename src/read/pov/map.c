/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Maps (manual 3.4.6.1.3, 3.4.6.1.4, 3.4.6.2.3, 3.4.6.4): what values of a pattern stand for, and the lists of
 * block patterns.
 */
#include <config.h>

#include "read/pov/pattern.h"

#include "base/buf.h"
#include "base/single.h"
#include "pattern/pattern.h"

#define ENTRIES_MAX 100000

struct map_draft {
	struct buf entry; /* of struct map_entry */
	struct pov_map m;
	bool weights; /* of an average: may be left out */
	bool density; /* its pigments are densities */
};

static bool push(struct pov *p, struct map_draft *d, struct map_entry e)
{
	e.at = as_single(e.at); /* as POV-Ray keeps them: hard edges lie there */
	if (d->entry.count >= ENTRIES_MAX) {
		pov_fail(p, "a map has more than %d entries", ENTRIES_MAX);
		return false;
	}
	if (!buf_reserve(&d->entry, pov_book(p), "reader", 1))
		return pov_no_memory(p);
	*BUF_AT(&d->entry, struct map_entry, d->entry.count++) = e;
	return true;
}

static struct rgbft value_colour(const struct pov_value *v)
{
	struct rgbft c = { v->c[0], v->c[1], v->c[2], 0, 0 };

	if (v->count == 4 || v->count == 5)
		c.filter = v->c[3];
	if (v->count == 5)
		c.transmit = v->c[4];
	return c;
}

/* [at colour], or as before version 1.5 [from, to colour colour]. */
static bool read_colour(struct pov *p, struct map_draft *d, double at)
{
	struct diag_pos pos = pov_here(p);
	struct pov_value v = pov_value(p);
	struct map_entry e = { .at = at };
	bool two = v.kind == POV_FLOAT;

	for (uint32_t i = 0; i < v.count && i < 5; i++) {
		if (!isfinite(v.c[i])) {
			pov_fail_at(p, &pos, "a colour has a component that is not a finite number");
			return false;
		}
	}
	e.is.colour = two ? pov_finite_colour(p, "the colour") : value_colour(&v);
	if (!push(p, d, e) || !two)
		return !pov_failed(p);
	pov_comma(p);
	e.at = v.c[0];
	e.is.colour = pov_finite_colour(p, "the colour");
	return push(p, d, e);
}

static void below(struct pov_map *m, const struct pov_lack *lack, uint32_t depth)
{
	pov_lack_add(&m->lack, lack);
	if (m->depth < depth + 1)
		m->depth = depth + 1;
}

static struct pigment *keep_pigment(struct pov *p, struct map_draft *d, const struct pov_pigment *from)
{
	below(&d->m, &from->lack, from->depth);
	return pov_copy(p, &from->pigment, sizeof(from->pigment));
}

static struct pigment *read_pigment(struct pov *p, struct map_draft *d)
{
	struct pov_pigment pigment = pov_default_texture(p)->layer[0].pigment;
	bool read = d->density ? pov_density_body(p, &pigment) : pov_pigment_body(p, &pigment);

	return read ? keep_pigment(p, d, &pigment) : NULL;
}

static struct normal *keep_normal(struct pov *p, struct map_draft *d, const struct pov_normal *from)
{
	static const struct normal none = { .amount = 0 };

	below(&d->m, &from->lack, from->depth);
	return from->normal ? from->normal : pov_copy(p, &none, sizeof(none));
}

static struct normal *read_normal(struct pov *p, struct map_draft *d)
{
	struct pov_normal normal = pov_default_texture(p)->layer[0].normal;

	return pov_normal_body(p, &normal) ? keep_normal(p, d, &normal) : NULL;
}

static struct texture *keep_texture(struct pov *p, struct map_draft *d, struct pov_texture *from)
{
	below(&d->m, &from->lack, from->map.depth);
	pov_lack_add(&d->m.lack, &from->map.lack);
	d->m.subsurface |= from->map.subsurface;
	for (uint32_t i = 0; i < from->count; i++) {
		const struct pov_layer *l = &from->layer[i];

		below(&d->m, &l->pigment.lack, l->pigment.depth);
		below(&d->m, &l->normal.lack, l->normal.depth);
		pov_lack_add(&d->m.lack, &l->finish.lack);
		d->m.subsurface |= l->finish.finish.subsurface;
	}
	return pov_texture_made(p, from);
}

static struct texture *read_texture(struct pov *p, struct map_draft *d)
{
	struct pov_texture *t = pov_texture_body(p);

	return t ? keep_texture(p, d, t) : NULL;
}

static bool read_slope(struct pov *p, struct map_entry *e)
{
	pov_vector2(p, &e->is.slope.height, &e->is.slope.slope);
	if (!isfinite(e->is.slope.height) || !isfinite(e->is.slope.slope))
		pov_fail(p, "slope_map has a number that is not finite");
	return !pov_failed(p);
}

/* Between [ and ]. */
static bool read_entry(struct pov *p, struct map_draft *d)
{
	struct map_entry e = { .at = 1 };

	if (!d->weights || pov_starts_number(p))
		e.at = pov_finite_float(p, "the map's value");
	pov_comma(p);
	if (pov_failed(p))
		return false;
	switch (d->m.map.kind) {
	case MAP_COLOUR:
		return read_colour(p, d, e.at);
	case MAP_PIGMENT:
		e.is.pigment = read_pigment(p, d);
		return e.is.pigment && push(p, d, e);
	case MAP_NORMAL:
		e.is.normal = read_normal(p, d);
		return e.is.normal && push(p, d, e);
	case MAP_TEXTURE:
		e.is.texture = read_texture(p, d);
		return e.is.texture && push(p, d, e);
	default:
		return read_slope(p, &e) && push(p, d, e);
	}
}

static bool read_entries(struct pov *p, struct map_draft *d)
{
	while (!pov_failed(p) && pov_token(p) == TOK_LEFT_SQUARE) {
		pov_next(p);
		if (!read_entry(p, d) || !pov_expect(p, TOK_RIGHT_SQUARE, "at the end of the map's entry"))
			return false;
	}
	if (!d->entry.count && !pov_failed(p))
		pov_fail(p, "a map needs at least one entry: [ number ... ]");
	return !pov_failed(p);
}

static void finish(struct pov *p, struct map_draft *d)
{
	struct map *m = &d->m.map;

	m->count = d->entry.count;
	m->entry = pov_copy(p, d->entry.data, m->count * sizeof(*m->entry));
	if (!m->entry)
		m->count = 0;
	map_examine(m);
}

static enum map_kind kind_of(enum pov_token_kind t, enum pov_item_kind *item)
{
	switch (t) {
	case TOK_COLOUR_MAP:
		*item = ITEM_COLOUR_MAP;
		return MAP_COLOUR;
	case TOK_PIGMENT_MAP:
		*item = ITEM_PIGMENT_MAP;
		return MAP_PIGMENT;
	case TOK_DENSITY_MAP: /* of pigments whose colours are densities */
		*item = ITEM_DENSITY_MAP;
		return MAP_PIGMENT;
	case TOK_NORMAL_MAP:
		*item = ITEM_NORMAL_MAP;
		return MAP_NORMAL;
	case TOK_TEXTURE_MAP:
		*item = ITEM_TEXTURE_MAP;
		return MAP_TEXTURE;
	default:
		*item = ITEM_SLOPE_MAP;
		return MAP_SLOPE;
	}
}

struct pov_map *pov_read_map(struct pov *p, bool weights)
{
	struct map_draft d = { .entry = { .size = sizeof(struct map_entry) }, .weights = weights };
	enum pov_token_kind word = pov_token(p);
	enum pov_item_kind item;
	struct pov_map *named;

	d.m.map.kind = kind_of(word, &item);
	d.density = word == TOK_DENSITY_MAP;
	if (!pov_open(p))
		return NULL;
	named = pov_take(p, item);
	if (named)
		return pov_close(p, keyword_text(word)) ? named : NULL;
	if (read_entries(p, &d))
		finish(p, &d);
	buf_release(&d.entry);
	return pov_close(p, keyword_text(word)) ? pov_copy(p, &d.m, sizeof(d.m)) : NULL;
}

/* The lists of block patterns. */

static bool blocks_of_colours(struct pov *p, struct map_draft *d, enum pattern_kind kind, uint32_t count)
{
	const struct map *standard = pattern_default_map(kind);
	struct map_entry e;

	d->m.map.kind = MAP_COLOUR;
	while (d->entry.count < count && !pov_failed(p) && pov_starts_colour(p)) {
		e = (struct map_entry){ .at = d->entry.count };
		e.is.colour = pov_finite_colour(p, "the colour");
		pov_comma(p);
		if (!push(p, d, e))
			return false;
	}
	while (d->entry.count < count) {
		e = standard->entry[d->entry.count];
		e.at = d->entry.count;
		if (!push(p, d, e))
			return false;
	}
	return !pov_failed(p);
}

static bool block_item(struct pov *p, struct map_draft *d, enum pov_token_kind word, struct map_entry *e)
{
	bool given = pov_token(p) == word;
	void *made;

	if (given && !pov_open(p))
		return false;
	if (word == TOK_PIGMENT)
		made = e->is.pigment = given ? read_pigment(p, d) :
					       keep_pigment(p, d, &pov_default_texture(p)->layer[0].pigment);
	else if (word == TOK_NORMAL)
		made = e->is.normal = given ? read_normal(p, d) :
					      keep_normal(p, d, &pov_default_texture(p)->layer[0].normal);
	else
		made = e->is.texture = given ? read_texture(p, d) : keep_texture(p, d, pov_default_texture(p));
	if (!made || pov_failed(p))
		return false;
	if (given && !pov_close(p, keyword_text(word)))
		return false;
	pov_comma(p);
	return true;
}

static bool blocks_of_items(struct pov *p, struct map_draft *d, enum pov_token_kind word, uint32_t count)
{
	d->m.map.kind = word == TOK_PIGMENT ? MAP_PIGMENT : word == TOK_NORMAL ? MAP_NORMAL : MAP_TEXTURE;
	while (d->entry.count < count) {
		struct map_entry e = { .at = d->entry.count };

		if (!block_item(p, d, word, &e) || !push(p, d, e))
			return false;
	}
	return true;
}

void pattern_blocks(struct pov *p, struct pattern_draft *to, uint32_t count)
{
	struct map_draft d = { .entry = { .size = sizeof(struct map_entry) } };
	bool ok = true;

	if (to->use == IN_TEXTURE)
		ok = blocks_of_items(p, &d, TOK_TEXTURE, count);
	else if (to->use == IN_NORMAL && pov_token(p) == TOK_NORMAL)
		ok = blocks_of_items(p, &d, TOK_NORMAL, count);
	else if (to->use == IN_PIGMENT && pov_token(p) == TOK_PIGMENT)
		ok = blocks_of_items(p, &d, TOK_PIGMENT, count);
	else if (to->use != IN_NORMAL)
		ok = blocks_of_colours(p, &d, to->pattern.kind, count);
	if (ok && d.entry.count)
		finish(p, &d);
	to->map = d.m;
	buf_release(&d.entry);
}

void pattern_textures(struct pov *p, struct pattern_draft *to, struct pov_texture *const *t, uint32_t count)
{
	struct map_draft d = { .entry = { .size = sizeof(struct map_entry) }, .m = { .map = { .kind = MAP_TEXTURE } } };
	bool ok = true;

	for (uint32_t i = 0; ok && i < count; i++) {
		struct map_entry e = { .at = i };

		e.is.texture = keep_texture(p, &d, t[i]);
		ok = e.is.texture && push(p, &d, e);
	}
	if (ok)
		finish(p, &d);
	to->map = d.m;
	buf_release(&d.entry);
}

void pattern_materials(struct pov *p, struct pattern_draft *to)
{
	struct map_draft d = { .entry = { .size = sizeof(struct map_entry) }, .m = { .map = { .kind = MAP_TEXTURE } } };
	bool ok = true;

	while (ok && !pov_failed(p) && pov_token(p) == TOK_TEXTURE) {
		struct map_entry e = { .at = d.entry.count };

		ok = block_item(p, &d, TOK_TEXTURE, &e) && push(p, &d, e);
	}
	if (!d.entry.count && !pov_failed(p))
		pov_fail(p, "material_map needs at least one texture { }");
	if (!pov_failed(p))
		finish(p, &d);
	to->map = d.m;
	buf_release(&d.entry);
}
