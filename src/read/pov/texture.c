/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pigments, normals and textures (manual 3.4.6), up to plain colours in layers. Patterns are passed over
 * and noted as lacking, to be reported where the texture is used.
 */
#include <config.h>

#include "read/pov/items.h"

#include <stdio.h>
#include <string.h>

/* "checker in a pigment", in the parser's arena. */
static const char *pattern_name(struct pov *p, const char *block)
{
	const char *word = pov_text(p);
	size_t size = strlen(word) + strlen(block) + 16;
	char *name = pov_new(p, size);

	if (!name)
		return block;
	snprintf(name, size, "%s in a %s", word, block);
	return name;
}

static void skip_pattern(struct pov *p, struct pov_lack *lack, const char *block, const char *remedy)
{
	if (pov_token(p) != TOK_IDENT && pov_token(p) <= TOK_BACKSLASH)
		return; /* neither a word nor a name that stands for something */
	pov_lack_note(p, lack, pattern_name(p, block), remedy);
	pov_skip_rest(p);
}

struct pov_pigment *pov_read_pigment(struct pov *p, const struct pov_pigment *base)
{
	struct pov_pigment pigment = *base, *named;
	struct xform unused = xform_identity;

	if (!pov_open(p))
		return NULL;
	named = pov_take(p, ITEM_PIGMENT);
	if (named)
		pigment = *named;
	while (!pov_failed(p)) {
		if (pov_accept(p, TOK_UV_MAPPING) || pov_transform(p, &unused)) {
			continue; /* the same colour everywhere */
		} else if (pov_accept(p, TOK_QUICK_COLOUR)) {
			pov_finite_colour(p, "quick_color"); /* for previews only */
		} else if (pov_starts_colour(p)) {
			pigment.colour = pov_finite_colour(p, "the pigment's colour");
			pigment.lack = (struct pov_lack){ 0 };
		} else {
			skip_pattern(p, &pigment.lack, "pigment", "give the pigment a plain colour");
			break;
		}
	}
	return pov_close(p, "pigment") ? pov_copy(p, &pigment, sizeof(pigment)) : NULL;
}

struct pov_normal *pov_read_normal(struct pov *p)
{
	struct pov_normal normal = { 0 }, *named;
	struct xform unused = xform_identity;

	if (!pov_open(p))
		return NULL;
	named = pov_take(p, ITEM_NORMAL);
	if (named)
		normal = *named;
	while (!pov_failed(p) && (pov_accept(p, TOK_UV_MAPPING) || pov_transform(p, &unused)))
		;
	skip_pattern(p, &normal.lack, "normal", "remove normal { }");
	return pov_close(p, "normal") ? pov_copy(p, &normal, sizeof(normal)) : NULL;
}

static struct pov_texture *texture_new(struct pov *p, uint32_t layers)
{
	struct pov_texture *t = pov_new(p, sizeof(*t));

	if (!t)
		return NULL;
	t->count = layers;
	t->index = SCENE_NONE;
	t->layer = pov_new(p, layers * sizeof(*t->layer));
	return t->layer ? t : NULL;
}

static struct pov_texture *texture_copy(struct pov *p, const struct pov_texture *from)
{
	struct pov_texture *t = texture_new(p, from->count);

	if (!t)
		return NULL;
	t->lack = from->lack;
	memcpy(t->layer, from->layer, from->count * sizeof(*t->layer));
	return t;
}

struct pov_texture *pov_texture_over(struct pov *p, struct pov_texture *upper, struct pov_texture *lower)
{
	struct pov_texture *t;

	if (!upper || !lower)
		return upper ? upper : lower;
	if (lower->count > 4096) {
		pov_fail(p, "a texture has more than 4096 layers");
		return NULL;
	}
	t = texture_new(p, upper->count + lower->count);
	if (!t)
		return NULL;
	memcpy(t->layer, upper->layer, upper->count * sizeof(*t->layer));
	memcpy(t->layer + upper->count, lower->layer, lower->count * sizeof(*t->layer));
	t->lack = upper->lack;
	pov_lack_add(&t->lack, &lower->lack);
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
		normal = pov_read_normal(p);
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

	if (*t && (*t)->lack.construct)
		changed = pov_texture_over(p, pov_default_texture(p), *t);
	else
		changed = texture_copy(p, *t ? *t : pov_default_texture(p));
	if (!changed || !read_part(p, changed->layer, false))
		return false;
	*t = changed;
	return true;
}

static bool texture_words(struct pov *p, struct pov_texture *t)
{
	struct xform unused = xform_identity;
	bool changed = false;

	while (!pov_failed(p)) {
		if (read_part(p, t->layer, true) || pov_transform(p, &unused))
			changed = true;
		else if (!pov_accept(p, TOK_NO_BUMP_SCALE) && !pov_accept(p, TOK_UV_MAPPING))
			break;
	}
	return changed;
}

struct pov_texture *pov_read_texture(struct pov *p)
{
	struct pov_texture *named, *t;
	bool changed;

	if (!pov_open(p))
		return NULL;
	named = pov_take(p, ITEM_TEXTURE);
	/* texture { NAME } and texture { } alone, as in most exports, need no copy. */
	if (pov_token(p) == TOK_RIGHT_BRACE)
		return pov_close(p, "texture") ? (named ? named : pov_default_texture(p)) : NULL;
	t = texture_copy(p, named ? named : pov_default_texture(p));
	if (!t)
		return NULL;
	changed = texture_words(p, t);
	if (!named && !changed)
		skip_pattern(p, &t->lack, "texture", "use a texture with one pigment");
	return pov_close(p, "texture") ? t : NULL;
}

static bool use_layer(struct pov *p, const struct pov_layer *from, struct layer *to)
{
	struct pov_state *s = pov_state(p);

	if (!pov_lack_use(p, &from->pigment.lack) || !pov_lack_use(p, &from->normal.lack) ||
	    !pov_lack_use(p, &from->finish.lack))
		return false;
	if (from->finish.subsurface && !s->finish_subsurface.construct)
		pov_lack_note(p, &s->finish_subsurface, "subsurface light transport",
			      "remove subsurface { } from global_settings");
	to->pigment.colour = from->pigment.colour;
	to->finish = from->finish.finish;
	return true;
}

uint32_t pov_use_texture(struct pov *p, struct pov_texture *t)
{
	struct scene *s = pov_scene(p);
	uint32_t index;

	if (t->index != SCENE_NONE || pov_failed(p))
		return t->index;
	if (!pov_lack_use(p, &t->lack))
		return SCENE_NONE;
	index = scene_add_texture(s, t->count);
	if (index == SCENE_NONE) {
		pov_no_memory(p);
		return SCENE_NONE;
	}
	for (uint32_t i = 0; i < t->count; i++) {
		if (!use_layer(p, &t->layer[i], &s->texture[index].layer[i]))
			return SCENE_NONE;
	}
	t->index = index;
	return index;
}
