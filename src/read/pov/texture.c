/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Textures (manual 3.4.6): layers of pigment, normal and finish, or a pattern of textures.
 */
#include <config.h>

#include "read/pov/pattern.h"
#include "read/pov/picture.h"

#include <string.h>

static struct pov_texture *texture_new(struct pov *p, uint32_t layers)
{
	struct pov_texture *t = pov_new(p, sizeof(*t));

	if (!t)
		return NULL;
	t->count = layers;
	t->index = SCENE_NONE;
	if (!layers)
		return t;
	t->layer = pov_new(p, layers * sizeof(*t->layer));
	return t->layer ? t : NULL;
}

static struct pov_texture *texture_copy(struct pov *p, const struct pov_texture *from)
{
	struct pov_texture *t = texture_new(p, from->count);

	if (!t)
		return NULL;
	if (from->count)
		memcpy(t->layer, from->layer, from->count * sizeof(*t->layer));
	t->lack = from->lack;
	t->uv = from->uv;
	t->pattern = from->pattern;
	t->map = from->map;
	return t;
}

static bool moves(const struct pigment *pigment)
{
	return pigment->pattern && !pigment->uv;
}

static bool bends(const struct normal *n)
{
	return n && n->pattern;
}

static bool move_layer(struct pov *p, struct pov_layer *l, const struct xform *x)
{
	struct normal *n;

	if (moves(&l->pigment.pigment)) {
		l->pigment.pigment.pattern = pattern_transform(p, l->pigment.pigment.pattern, x);
		if (!l->pigment.pigment.pattern)
			return false;
	}
	if (!bends(l->normal.normal) || l->normal.normal->uv)
		return true;
	n = pov_copy(p, l->normal.normal, sizeof(*n));
	if (!n)
		return false;
	n->pattern = pattern_transform(p, n->pattern, x);
	l->normal.normal = n;
	return n->pattern != NULL;
}

/* Transforms change patterns that are not asked at (u, v, 0). */
static bool texture_moves(const struct pov_texture *t)
{
	if (t->pattern)
		return true;
	for (uint32_t i = 0; i < t->count; i++) {
		if (moves(&t->layer[i].pigment.pigment) ||
		    (bends(t->layer[i].normal.normal) && !t->layer[i].normal.normal->uv))
			return true;
	}
	return false;
}

struct pov_texture *pov_texture_transform(struct pov *p, struct pov_texture *from, const struct xform *x)
{
	struct pov_texture *t;

	if (!from || from->uv || !texture_moves(from) || mat_is_identity(&x->fwd))
		return from;
	t = texture_copy(p, from);
	if (!t)
		return NULL;
	if (t->pattern) {
		t->pattern = pattern_transform(p, t->pattern, x);
		return t->pattern ? t : NULL;
	}
	for (uint32_t i = 0; i < t->count; i++) {
		if (!move_layer(p, &t->layer[i], x))
			return NULL;
	}
	return t;
}

struct pov_texture *pov_texture_with_uv(struct pov *p, struct pov_texture *from)
{
	struct pov_texture *t = from->with_uv;

	if (from->uv || !texture_moves(from))
		return from;
	if (t)
		return t;
	t = texture_copy(p, from);
	if (t)
		t->uv = true;
	from->with_uv = t;
	return t;
}

struct texture *pov_texture_made(struct pov *p, struct pov_texture *from)
{
	struct texture *t = from->made;

	if (t)
		return t;
	t = pov_new(p, sizeof(*t));
	if (!t)
		return NULL;
	*t = (struct texture){ .count = from->count,
			       .uv = from->uv,
			       .pattern = from->pattern,
			       .map = from->map.map };
	if (t->count) {
		t->layer = pov_new(p, t->count * sizeof(*t->layer));
		if (!t->layer)
			return NULL;
	}
	for (uint32_t i = 0; i < t->count; i++) {
		const struct pov_layer *l = &from->layer[i];

		t->layer[i] = (struct layer){ .pigment = l->pigment.pigment,
					      .normal = bends(l->normal.normal) ? l->normal.normal : NULL,
					      .finish = l->finish.finish };
	}
	texture_examine(t);
	from->made = t;
	return t;
}

struct pov_texture *pov_texture_over(struct pov *p, struct pov_texture *upper, struct pov_texture *lower)
{
	struct pov_texture *t;

	if (!upper || !lower)
		return upper ? upper : lower;
	if (upper->pattern || lower->pattern || upper->uv || lower->uv) {
		pov_fail(p, "a texture that is a pattern of textures can be no layer");
		return NULL;
	}
	if (lower->count > 4096) {
		pov_fail(p, "a texture has more than 4096 layers");
		return NULL;
	}
	t = texture_new(p, upper->count + lower->count);
	if (!t)
		return NULL;
	memcpy(t->layer, upper->layer, upper->count * sizeof(*t->layer));
	memcpy(t->layer + upper->count, lower->layer, lower->count * sizeof(*t->layer));
	return t;
}

struct pov_texture *pov_default_texture(struct pov *p)
{
	return pov_state(p)->base;
}

/* pigment, normal and finish blocks, and identifiers of such, change the topmost layer. */
static bool read_part(struct pov *p, struct pov_layer *layer, bool idents)
{
	struct pov_pigment *pigment = NULL;
	struct pov_normal *normal = NULL;
	struct pov_finish *finish = NULL;

	switch (pov_token(p)) {
	case TOK_PIGMENT:
		pigment = pov_read_pigment(p, &layer->pigment);
		break;
	case TOK_NORMAL:
		normal = pov_read_normal(p, &layer->normal);
		break;
	case TOK_FINISH:
		finish = pov_read_finish(p, &layer->finish);
		break;
	default:
		if (!idents)
			return false;
		pigment = pov_take(p, ITEM_PIGMENT);
		normal = pigment ? NULL : pov_take(p, ITEM_NORMAL);
		finish = pigment || normal ? NULL : pov_take(p, ITEM_FINISH);
	}
	if (pigment)
		layer->pigment = *pigment;
	if (normal)
		layer->normal = *normal;
	if (finish)
		layer->finish = *finish;
	return pigment || normal || finish;
}

bool pov_texture_part(struct pov *p, struct pov_texture **t)
{
	struct pov_texture *changed;

	if (*t && !(*t)->count) {
		pov_fail(p, "%s cannot change a texture that is a pattern of textures", pov_text(p));
		return false;
	}
	changed = texture_copy(p, *t ? *t : pov_default_texture(p));
	if (!changed || !read_part(p, changed->layer, false))
		return false;
	*t = changed;
	return true;
}

static bool transform_words(struct pov *p, struct pov_texture **t)
{
	struct xform x = xform_identity;
	bool any = false;

	while (pov_transform(p, &x))
		any = true;
	if (any && !pov_failed(p))
		*t = pov_texture_transform(p, *t, &x);
	return any;
}

static bool bump_word(struct pov *p, struct pov_texture **t)
{
	if (!pov_accept(p, TOK_NO_BUMP_SCALE))
		return false;
	*t = texture_copy(p, *t);
	if (*t && !pov_texture_keep_bumps(p, *t))
		*t = NULL;
	return true;
}

/* What changes a texture of layers; false: nothing was there. */
static bool layer_words(struct pov *p, struct pov_texture **t)
{
	bool changed = false, own = false; /* own: *t is ours alone */
	struct pov_texture *copy;

	while (!pov_failed(p) && *t) {
		if (transform_words(p, t) || bump_word(p, t)) {
			changed = true;
			own = false;
			continue;
		}
		copy = own ? *t : texture_copy(p, *t);
		if (!copy || !read_part(p, copy->layer, true))
			break;
		*t = copy;
		changed = own = true;
	}
	return changed;
}

static struct pov_texture *read_tile(struct pov *p)
{
	struct pov_texture *all = NULL;

	while (!pov_failed(p) && pov_token(p) == TOK_TEXTURE)
		all = pov_texture_over(p, pov_read_texture(p), all);
	if (!all && !pov_failed(p))
		pov_fail(p, "tiles needs a texture { } here, not %s", pov_text(p));
	return pov_failed(p) ? NULL : all;
}

/* tiles { texture ... tile2 texture ... }: checker as before version 3; the first is number 1. */
static void read_tiles(struct pov *p, struct pattern_draft *d)
{
	struct pov_texture *tile[2];

	d->given = true;
	d->pattern = (struct pattern){ .kind = PATTERN_CHECKER, .exponent = 1 };
	if (!pov_open(p))
		return;
	tile[1] = read_tile(p);
	if (!tile[1] || !pov_expect(p, TOK_TILE2, "between the textures of tiles"))
		return;
	tile[0] = read_tile(p);
	if (tile[0] && pov_close(p, "tiles"))
		pattern_textures(p, d, tile, 2);
}

static void read_material_map(struct pov *p, struct pattern_draft *d)
{
	d->given = true;
	d->pattern = (struct pattern){ .kind = PATTERN_MATERIAL_MAP, .exponent = 1 };
	if (!pov_open(p) || !pov_picture_read(p, PICTURE_OF_DATA, &d->pattern.of.image, NULL))
		return;
	pattern_materials(p, d);
	(void)pov_close(p, "material_map");
}

/* texture { PATTERN texture_map { ... } ... } */
static struct pov_texture *read_pattern(struct pov *p)
{
	struct pov_texture *t = pov_new(p, sizeof(*t));
	struct pattern_draft d;
	bool keep = false;

	if (!t)
		return NULL;
	pattern_draft_init(&d, IN_TEXTURE, NULL);
	if (pov_token(p) == TOK_TILES)
		read_tiles(p, &d);
	else if (pov_token(p) == TOK_MATERIAL_MAP)
		read_material_map(p, &d);
	else if (!pattern_word(p, &d))
		return NULL;
	d.average = d.pattern.kind == PATTERN_AVERAGE;
	pattern_modifiers(p, &d);
	while (pov_accept(p, TOK_NO_BUMP_SCALE)) {
		keep = true;
		pattern_modifiers(p, &d);
	}
	if (!d.map.map.count && !d.lack.construct && !pov_failed(p))
		pov_fail(p, "a texture with a pattern needs a texture_map");
	t->index = SCENE_NONE;
	t->map = d.map;
	t->pattern = pattern_finish(p, &d);
	t->lack = d.lack;
	if (keep && t->pattern && !pov_texture_keep_bumps(p, t))
		return NULL;
	return t->pattern ? t : NULL;
}

static struct pov_texture *read_uv(struct pov *p)
{
	struct pov_texture *t;

	if (!pov_nest(p))
		return NULL;
	t = pov_texture_body(p);
	pov_unnest(p);
	if (t)
		t = texture_copy(p, t);
	if (t)
		t->uv = true;
	return t;
}

struct pov_texture *pov_texture_body(struct pov *p)
{
	struct pov_texture *named = pov_take(p, ITEM_TEXTURE), *t;

	t = named ? named : pov_default_texture(p);
	/* texture { NAME } and texture { } alone, as in most exports, need no copy. */
	if (pov_token(p) == TOK_RIGHT_BRACE || pov_token(p) == TOK_RIGHT_SQUARE)
		return t;
	if (!t->count || t->uv) {
		while (t && (transform_words(p, &t) || bump_word(p, &t)))
			;
		return pov_failed(p) ? NULL : t;
	}
	if (layer_words(p, &t) || named || pov_failed(p))
		return pov_failed(p) ? NULL : t;
	return pov_accept(p, TOK_UV_MAPPING) ? read_uv(p) : read_pattern(p);
}

struct pov_texture *pov_read_texture(struct pov *p)
{
	struct pov_texture *t;

	if (!pov_open(p))
		return NULL;
	t = pov_texture_body(p);
	return pov_close(p, "texture") ? t : NULL;
}

static bool use_layer(struct pov *p, const struct pov_layer *from)
{
	struct pov_state *s = pov_state(p);

	if (from->finish.opaque && !s->opaque) {
		s->opaque = true;
		s->opaque_at = from->finish.opaque_at;
	}
	return pov_lack_use(p, &from->pigment.lack) && pov_lack_use(p, &from->normal.lack) &&
	       pov_lack_use(p, &from->finish.lack);
}

/* What cannot be drawn is reported here, where it is used. */
static bool use_all(struct pov *p, const struct pov_texture *t)
{
	pov_scene(p)->subsurface.used |= t->map.subsurface;

	if (!pov_lack_use(p, &t->lack) || !pov_lack_use(p, &t->map.lack))
		return false;
	for (uint32_t i = 0; i < t->count; i++) {
		if (!use_layer(p, &t->layer[i]))
			return false;
		pov_scene(p)->subsurface.used |= t->layer[i].finish.finish.subsurface;
	}
	return true;
}

/* With --lenient, what lacks something is drawn in plain colours. */
static void make_plain(struct pov_texture *t)
{
	if (t->lack.construct || t->map.lack.construct) {
		t->pattern = NULL;
		t->map.map = (struct map){ .kind = MAP_NONE };
	}
	for (uint32_t i = 0; i < t->count; i++) {
		struct pov_layer *l = &t->layer[i];

		if (l->pigment.lack.construct)
			l->pigment.pigment = (struct pigment){ .colour = l->pigment.pigment.colour };
		if (l->normal.lack.construct)
			l->normal.normal = NULL;
	}
}

static bool lacks(const struct pov_texture *t)
{
	bool any = t->lack.construct || t->map.lack.construct;

	for (uint32_t i = 0; i < t->count; i++)
		any |= t->layer[i].pigment.lack.construct || t->layer[i].normal.lack.construct;
	return any;
}

uint32_t pov_use_texture(struct pov *p, struct pov_texture *t)
{
	struct scene *s = pov_scene(p);
	struct pov_texture *from = t;
	struct texture *made;
	uint32_t index;

	if (t->index != SCENE_NONE || pov_failed(p))
		return t->index;
	if (!use_all(p, t))
		return SCENE_NONE;
	if (lacks(t)) {
		from = texture_copy(p, t->count ? t : pov_default_texture(p));
		if (!from)
			return SCENE_NONE;
		make_plain(from);
	}
	made = pov_texture_made(p, from);
	index = made ? scene_add_texture(s, 0) : SCENE_NONE;
	if (index == SCENE_NONE || !scene_adopt_texture(s, &pov_state(p)->copies, made, &s->texture[index])) {
		pov_no_memory(p);
		return SCENE_NONE;
	}
	s->wants_uv |= made->wants_uv;
	t->index = index;
	return index;
}
