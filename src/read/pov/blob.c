/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * blob (manual 3.4.5.1.1): components with transforms and textures of their own.
 */
#include <config.h>

#include "read/pov/items.h"

#include <string.h>

#include "base/buf.h"

struct draft {
	struct blob_part part;
	struct pov_texture *texture;
	struct xform texture_place;
};

static struct draft *add_part(struct pov *p, struct buf *parts)
{
	struct draft *d;

	if (!buf_reserve(parts, pov_book(p), "scene", 1)) {
		pov_no_memory(p);
		return NULL;
	}
	d = BUF_AT(parts, struct draft, parts->count++);
	*d = (struct draft){ .part.texture = SCENE_NONE, .texture_place = xform_identity };
	return d;
}

static double read_radius(struct pov *p)
{
	return fabs(pov_finite_float(p, "the blob component's radius")); /* its square counts */
}

/* component STRENGTH, RADIUS, CENTRE */
static void read_old(struct pov *p, struct blob_part *part)
{
	pov_next(p);
	part->strength = pov_finite_float(p, "the blob component's strength");
	pov_comma(p);
	part->radius = read_radius(p);
	pov_comma(p);
	part->base = part->apex = pov_finite_vector(p, "the blob component's centre");
}

static bool read_texture(struct pov *p, struct draft *d)
{
	struct pov_material m = { .texture = d->texture };

	switch (pov_token(p)) {
	case TOK_TEXTURE:
		d->texture = pov_texture_over(p, pov_read_texture(p), d->texture);
		return true;
	case TOK_PIGMENT:
	case TOK_NORMAL:
	case TOK_FINISH:
		return pov_texture_part(p, &d->texture);
	case TOK_MATERIAL:
		if (!pov_read_material(p, &m))
			return false;
		d->texture = m.texture;
		return true;
	default:
		return false;
	}
}

/* What moves a component moves the textures that it has by then. */
static void read_modifiers(struct pov *p, struct draft *d)
{
	struct xform x = xform_identity, all = xform_identity;

	while (!pov_failed(p)) {
		if (pov_transform(p, &x)) {
			all = xform_mul(&all, &x);
			d->texture_place = xform_mul(&d->texture_place, &x);
			x = xform_identity;
			continue;
		}
		if (d->texture && !mat_is_identity(&d->texture_place.fwd))
			d->texture = pov_texture_transform(p, d->texture, &d->texture_place);
		d->texture_place = xform_identity;
		if (!read_texture(p, d))
			break;
	}
	if (pov_failed(p) || mat_is_identity(&all.fwd))
		return;
	d->part.place = (void *)arena_memdup(&pov_scene(p)->arena, &all, sizeof(all));
	if (!d->part.place)
		pov_no_memory(p);
}

/* sphere { CENTRE, RADIUS, [strength] STRENGTH ... } and cylinder { END, END, ... } */
static void read_part(struct pov *p, struct draft *d, const char *word)
{
	struct blob_part *part = &d->part;

	if (!pov_open(p))
		return;
	part->base = part->apex = pov_finite_vector(p, "the blob component's centre");
	if (part->cylinder) {
		pov_comma(p);
		part->apex = pov_finite_vector(p, "the blob component's second end");
	}
	pov_comma(p);
	part->radius = read_radius(p);
	pov_comma(p);
	pov_accept(p, TOK_STRENGTH);
	part->strength = pov_finite_float(p, "the blob component's strength");
	read_modifiers(p, d);
	pov_close(p, word);
}

static void read_parts(struct pov *p, struct buf *parts, double *threshold)
{
	while (!pov_failed(p)) {
		enum pov_token_kind t = pov_token(p);
		struct draft *d;

		if (t == TOK_THRESHOLD) {
			pov_next(p);
			*threshold = pov_finite_float(p, "the blob's threshold");
		} else if (t == TOK_SPHERE || t == TOK_CYLINDER || t == TOK_COMPONENT) {
			d = add_part(p, parts);
			if (!d)
				return;
			d->part.cylinder = t == TOK_CYLINDER;
			if (t == TOK_COMPONENT)
				read_old(p, &d->part);
			else
				read_part(p, d, keyword_text(t));
			if (d->part.radius == 0 || d->part.strength == 0)
				parts->count--; /* reaches nowhere */
		} else {
			return;
		}
		pov_comma(p);
	}
}

/* What is drawn of many textures at one point is not all of them: say so, once. */
static void warn_blend(struct pov *p, const struct diag_pos *at, const struct pov_blob *b, uint32_t count)
{
	const struct pov_texture *seen[SCENE_BLOB_BLEND];
	uint32_t n = 0, k;

	for (uint32_t i = 0; i < count; i++) {
		for (k = 0; k < n && seen[k] != b->texture[i]; k++)
			;
		if (k < n)
			continue;
		if (n == SCENE_BLOB_BLEND) {
			pov_warn(p, at, "the blob has more than %d textures; where more than that meet, the "
					"faintest are left out", SCENE_BLOB_BLEND);
			return;
		}
		seen[n++] = b->texture[i];
	}
}

static bool keep(struct pov *p, struct pov_object *o, const struct buf *parts, double threshold)
{
	struct scene *s = pov_scene(p);
	uint32_t i = scene_add_blob(s, parts->count);
	struct pov_blob *b = pov_new(p, sizeof(*b));

	if (i == SCENE_NONE || !b)
		return pov_no_memory(p);
	b->texture = pov_new(p, parts->count * sizeof(*b->texture));
	b->texture_place = pov_new(p, parts->count * sizeof(*b->texture_place));
	if (!b->texture || !b->texture_place)
		return false;
	s->blob[i].threshold = threshold;
	for (uint32_t k = 0; k < parts->count; k++) {
		s->blob[i].part[k] = BUF_AT(parts, struct draft, k)->part;
		b->texture[k] = BUF_AT(parts, struct draft, k)->texture;
		b->texture_place[k] = BUF_AT(parts, struct draft, k)->texture_place;
	}
	warn_blend(p, &o->object.pos, b, parts->count);
	b->index = i;
	o->blob = b;
	o->object.kind = SHAPE_BLOB;
	o->object.shape.blob = i;
	return true;
}

struct pov_object *pov_read_blob(struct pov *p, struct pov_object *o)
{
	struct buf parts = { .size = sizeof(struct draft) };
	double threshold = 1;
	bool ok = false;

	read_parts(p, &parts, &threshold);
	if (!pov_failed(p) && !parts.count)
		pov_fail_at(p, &o->object.pos, "a blob needs at least one component that reaches somewhere");
	if (!pov_failed(p))
		ok = keep(p, o, &parts, threshold);
	buf_release(&parts);
	return ok ? o : NULL;
}
