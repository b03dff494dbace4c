/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Items: which reader a keyword goes to, at the top level, in #declare and in #default (manual 3.3.2.8
 * and 3.4), and what all readers of blocks share.
 */
#include <config.h>

#include "read/pov/items.h"

#include <string.h>

#include "read/limits.h"

bool pov_open(struct pov *p)
{
	const char *word = keyword_text(pov_token(p));

	pov_next(p);
	return pov_expect(p, TOK_LEFT_BRACE, word) && pov_nest(p);
}

bool pov_close(struct pov *p, const char *block)
{
	if (pov_failed(p))
		return false;
	if (pov_token(p) == TOK_END) {
		pov_fail(p, "the file ends inside %s { ... }: a } is missing", block);
		return false;
	}
	if (pov_token(p) != TOK_RIGHT_BRACE) {
		pov_fail(p, "%s is not expected in %s { ... } here", pov_text(p), block);
		return false;
	}
	pov_unnest(p);
	pov_next(p);
	return !pov_failed(p);
}

void pov_skip_rest(struct pov *p)
{
	while (!pov_failed(p)) {
		enum pov_token_kind t = pov_token(p);

		if (t == TOK_RIGHT_BRACE || t == TOK_END)
			return;
		if (t == TOK_LEFT_BRACE)
			pov_skip_block(p);
		else
			pov_next(p);
	}
}

void *pov_take(struct pov *p, enum pov_item_kind kind)
{
	void *item;

	if (pov_token(p) != TOK_IDENT || pov_ident_kind(p) != kind)
		return NULL;
	item = pov_ident_item(p);
	pov_next(p);
	return item;
}

bool pov_starts_colour(struct pov *p)
{
	switch (pov_token(p)) {
	case TOK_COLOUR:
	case TOK_RGB:
	case TOK_RGBF:
	case TOK_RGBT:
	case TOK_RGBFT:
	case TOK_SRGB:
	case TOK_SRGBF:
	case TOK_SRGBT:
	case TOK_SRGBFT:
	case TOK_RED:
	case TOK_GREEN:
	case TOK_BLUE:
	case TOK_FILTER:
	case TOK_TRANSMIT:
	case TOK_ALPHA:
	case TOK_GRAY:
		return true;
	default:
		return pov_starts_number(p);
	}
}

struct diag_pos pov_here(struct pov *p)
{
	pov_token(p);
	return pov_pos(p);
}

void *pov_new(struct pov *p, size_t bytes)
{
	void *item = arena_zalloc(pov_arena(p), bytes);

	if (!item)
		pov_no_memory(p);
	return item;
}

void *pov_copy(struct pov *p, const void *item, size_t bytes)
{
	void *copy = pov_new(p, bytes);

	if (copy)
		memcpy(copy, item, bytes);
	return copy;
}

double pov_finite_float(struct pov *p, const char *what)
{
	struct diag_pos at = pov_here(p);
	double x = pov_float(p);

	if (!isfinite(x)) {
		pov_fail_at(p, &at, "%s is not a finite number", what);
		return 0;
	}
	return x;
}

double pov_positive(struct pov *p, const char *what)
{
	struct diag_pos at = pov_here(p);
	double x = pov_finite_float(p, what);

	if (!pov_failed(p) && !(x > 0)) {
		pov_fail_at(p, &at, "%s is %g, but has to be greater than 0", what, x);
		return 1;
	}
	return x;
}

vec pov_finite_vector(struct pov *p, const char *what)
{
	struct diag_pos at = pov_here(p);
	vec v = pov_vector(p);

	if (!vec_finite(v)) {
		pov_fail_at(p, &at, "%s has a component that is not a finite number", what);
		return vec_make(0, 0, 0);
	}
	return v;
}

struct rgbft pov_finite_colour(struct pov *p, const char *what)
{
	struct diag_pos at = pov_here(p);
	struct rgbft c = pov_colour(p);

	if (!isfinite(c.r) || !isfinite(c.g) || !isfinite(c.b) || !isfinite(c.filter) ||
	    !isfinite(c.transmit)) {
		pov_fail_at(p, &at, "%s has a component that is not a finite number", what);
		return (struct rgbft){ 0 };
	}
	return c;
}

static void *read_transform(struct pov *p)
{
	struct xform *x = pov_copy(p, &xform_identity, sizeof(*x));

	return x && pov_transform(p, x) && !pov_failed(p) ? x : NULL;
}

/* texture { } texture { } after #declare are the layers of one texture. */
static struct pov_texture *read_layers(struct pov *p)
{
	struct pov_texture *all = NULL;

	while (pov_token(p) == TOK_TEXTURE) {
		struct pov_texture *t = pov_read_texture(p);

		all = t ? pov_texture_over(p, t, all) : NULL;
		if (!all)
			return NULL;
	}
	return all;
}

static enum pov_item_kind map_item(enum pov_token_kind t)
{
	switch (t) {
	case TOK_COLOUR_MAP:
		return ITEM_COLOUR_MAP;
	case TOK_PIGMENT_MAP:
		return ITEM_PIGMENT_MAP;
	case TOK_NORMAL_MAP:
		return ITEM_NORMAL_MAP;
	case TOK_TEXTURE_MAP:
		return ITEM_TEXTURE_MAP;
	case TOK_DENSITY_MAP:
		return ITEM_DENSITY_MAP;
	default:
		return ITEM_SLOPE_MAP;
	}
}

static void *read_declared(struct pov *p, enum pov_item_kind *kind)
{
	struct pov_material m = { 0 };

	switch (pov_token(p)) {
	case TOK_PIGMENT:
		*kind = ITEM_PIGMENT;
		return pov_read_pigment(p, &pov_default_texture(p)->layer[0].pigment);
	case TOK_NORMAL:
		*kind = ITEM_NORMAL;
		return pov_read_normal(p, &pov_default_texture(p)->layer[0].normal);
	case TOK_FINISH:
		*kind = ITEM_FINISH;
		return pov_read_finish(p, &pov_default_texture(p)->layer[0].finish);
	case TOK_TEXTURE:
		*kind = ITEM_TEXTURE;
		return read_layers(p);
	case TOK_INTERIOR:
		*kind = ITEM_INTERIOR;
		return pov_read_interior(p, NULL);
	case TOK_MEDIA:
		*kind = ITEM_MEDIA;
		return pov_read_media(p);
	case TOK_DENSITY:
		*kind = ITEM_DENSITY;
		return pov_read_density(p);
	case TOK_MATERIAL:
		*kind = ITEM_MATERIAL;
		return pov_read_material(p, &m) ? pov_copy(p, &m, sizeof(m)) : NULL;
	case TOK_SKY_SPHERE:
		*kind = ITEM_SKY_SPHERE;
		return pov_read_sky(p);
	case TOK_FOG:
		*kind = ITEM_FOG;
		return pov_read_fog(p);
	case TOK_RAINBOW:
		*kind = ITEM_RAINBOW;
		return pov_read_rainbow(p);
	case TOK_CAMERA:
		*kind = ITEM_CAMERA;
		return pov_read_camera(p);
	case TOK_TRANSFORM:
	case TOK_TRANSLATE:
	case TOK_ROTATE:
	case TOK_SCALE:
	case TOK_MATRIX:
		*kind = ITEM_TRANSFORM;
		return read_transform(p);
	case TOK_COLOUR_MAP:
	case TOK_PIGMENT_MAP:
	case TOK_NORMAL_MAP:
	case TOK_TEXTURE_MAP:
	case TOK_SLOPE_MAP:
	case TOK_DENSITY_MAP:
		*kind = map_item(pov_token(p));
		return pov_read_map(p, false);
	default:
		*kind = ITEM_OBJECT;
		if (pov_starts_object(p)) {
			struct pov_object *o = pov_read_object(p);

			if (o)
				o->declared = true;
			return o;
		}
		pov_fail(p, "%s cannot be declared", pov_text(p));
		return NULL;
	}
}

void *pov_read_item(struct pov *p, enum pov_item_kind *kind)
{
	void *item;

	if (pov_token(p) == TOK_IDENT && pov_ident_kind(p) != ITEM_NONE) {
		*kind = pov_ident_kind(p);
		return pov_take(p, *kind);
	}
	item = read_declared(p, kind);
	return pov_failed(p) ? NULL : item;
}

static void top_camera(struct pov *p)
{
	struct pov_camera *c = pov_read_camera(p);

	if (!c)
		return;
	/* The last camera of a file is the one that counts, so only that one can lack something. */
	pov_state(p)->camera = c;
	pov_scene(p)->camera = c->camera;
	pov_scene(p)->has_camera = true;
}

/* Nobody refers to what a block at the top level was read into: the next one may have its memory. */
static void top_object(struct pov *p)
{
	bool own = pov_token(p) != TOK_IDENT;
	struct pov_object *o = pov_read_object(p);

	pov_use_object(p, o);
	if (o && own && !o->light)
		pov_state(p)->spare = o;
}

bool pov_top_item(struct pov *p)
{

	switch (pov_token(p)) {
	case TOK_GLOBAL_SETTINGS:
		pov_read_settings(p);
		return true;
	case TOK_BACKGROUND:
		pov_read_background(p);
		return true;
	case TOK_CAMERA:
		top_camera(p);
		return true;
	case TOK_SKY_SPHERE:
		pov_use_sky(p, pov_read_sky(p));
		return true;
	case TOK_FOG:
		pov_use_fog(p, pov_read_fog(p));
		return true;
	case TOK_MEDIA:
		pov_add_media(p, &pov_state(p)->media_count, &pov_state(p)->media);
		return true;
	case TOK_RAINBOW:
		pov_use_rainbow(p, pov_read_rainbow(p));
		return true;
	default:
		if (!pov_starts_object(p))
			return false;
		top_object(p);
		return true;
	}
}

/* #default { ... }: always one plain layer, as in POV-Ray. */
static void set_default(struct pov *p, struct pov_texture *t, const struct diag_pos *at)
{
	if (!t || pov_failed(p))
		return;
	if (t->count != 1)
		pov_fail_at(p, at, "#default takes no layered texture");
	pov_state(p)->base = t;
}

void pov_default(struct pov *p)
{
	while (!pov_failed(p)) {
		struct pov_texture *t = pov_default_texture(p);
		struct diag_pos at = pov_here(p);
		struct pov_camera *c;

		switch (pov_token(p)) {
		case TOK_TEXTURE:
			set_default(p, pov_read_texture(p), &at);
			break;
		case TOK_PIGMENT:
		case TOK_NORMAL:
		case TOK_FINISH:
			if (pov_texture_part(p, &t))
				set_default(p, t, &at);
			break;
		case TOK_RADIOSITY:
			pov_read_importance(p);
			break;
		case TOK_CAMERA:
			c = pov_read_camera(p);
			if (c)
				pov_warn(p, &at, "a #default camera is not used: write a camera block");
			break;
		default:
			return;
		}
	}
}

static void note_legacy(struct pov *p)
{
	struct scene *s = pov_scene(p);

	if (s->version >= 370)
		return;
	if (!pov_state(p)->gamma_given)
		pov_warn(p, NULL, "the scene is written for version %d.%d and gives no assumed_gamma: no "
			 "gamma correction is done, as in POV-Ray; add global_settings { assumed_gamma "
			 "1.0 } or #version 3.7 if the picture looks too dark or too bright",
			 s->version / 100, s->version / 10 % 10);
}

/* POV-Ray starts from black pigment and the default finish (manual 3.3.2.8). */
struct pov_state *pov_items_begin(struct pov *p)
{
	struct pov_state *s = pov_new(p, sizeof(*s));

	if (!s)
		return NULL;
	s->first_layer.finish.finish = finish_default();
	s->first = (struct pov_texture){ .count = 1, .layer = &s->first_layer, .index = SCENE_NONE };
	s->base = &s->first;
	s->copies.book = pov_book(p);
	s->object_limit = read_limits_fill(&pov_options(p)->limits).objects;
	pov_scene(p)->assumed_gamma = 0; /* until it is given */
	return s;
}

/* Texture coordinates that no texture asks for. */
static void drop_uvs(struct scene *s)
{
	for (uint32_t i = 0; i < s->mesh_count; i++) {
		mem_free(s->mesh[i].uv);
		mem_free(s->mesh[i].uv_index);
		s->mesh[i].uv = NULL;
		s->mesh[i].uv_index = NULL;
		s->mesh[i].uv_count = 0;
	}
}

void pov_items_end(struct pov *p)
{
	struct pov_state *s = pov_state(p);

	if (!pov_failed(p) && s->media_count &&
	    pov_use_media(p, s->media_count, s->media, &xform_identity, &pov_scene(p)->media))
		pov_scene(p)->media_count = s->media_count;
	if (!pov_failed(p) && !scene_adopt_normal(pov_scene(p), &s->copies, &pov_scene(p)->camera.normal))
		pov_no_memory(p);
	copies_release(&s->copies);
	if (!pov_scene(p)->wants_uv)
		drop_uvs(pov_scene(p));
	if (pov_failed(p))
		return;
	/* Version 3.7 takes linear light where nothing is said, older ones do no correction. */
	if (!s->gamma_given && pov_scene(p)->version >= 370)
		pov_scene(p)->assumed_gamma = 1;
	if (s->camera)
		pov_lack_use(p, &s->camera->lack);
	if (s->photons.construct && s->object_photons.construct)
		pov_lack_use(p, &s->photons);
	if (s->opaque && pov_scene(p)->subsurface.given)
		pov_warn(p, &s->opaque_at, "translucency is not positive in every colour: POV-Ray cannot "
			 "draw this; light goes a hundredth as far as in the clearest colour, or not below at "
			 "all if there is none");
	note_legacy(p);
}
