/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What surrounds a scene: background, sky sphere and fog (manual 3.4.3).
 */
#include <config.h>

#include "read/pov/items.h"

void pov_read_background(struct pov *p)
{
	struct rgbft c = { 0 };

	if (!pov_open(p))
		return;
	while (!pov_failed(p) && pov_starts_colour(p))
		c = pov_finite_colour(p, "the background's colour");
	if (pov_close(p, "background"))
		pov_scene(p)->background = c;
}

/* A list that identifiers share is never changed: a new pigment goes to the end of a copy. */
static void add_pigment(struct pov *p, struct pov_sky *sky)
{
	const struct pov_pigment black = { .depth = 0 };
	struct pov_pigment *pigment = pov_read_pigment(p, &black);
	struct pov_sky_pigment *list = NULL, **end = &list;

	if (!pigment)
		return;
	for (const struct pov_sky_pigment *s = sky->first; s; s = s->next) {
		*end = pov_copy(p, s, sizeof(*s));
		if (!*end)
			return;
		end = &(*end)->next;
	}
	*end = pov_new(p, sizeof(**end));
	if (!*end)
		return;
	(*end)->pigment = *pigment;
	sky->first = list;
	sky->count++;
}

static bool read_sky_word(struct pov *p, struct pov_sky *sky)
{
	if (pov_token(p) == TOK_PIGMENT) {
		add_pigment(p, sky);
		return true;
	}
	if (pov_accept(p, TOK_EMISSION)) {
		sky->emission = rgbft_rgb(pov_finite_colour(p, "emission"));
		return true;
	}
	return pov_transform(p, &sky->place);
}

struct pov_sky *pov_read_sky(struct pov *p)
{
	struct diag_pos at = pov_here(p);
	struct pov_sky sky = { .emission = { 1, 1, 1 }, .place = xform_identity }, *named;

	if (!pov_open(p))
		return NULL;
	named = pov_take(p, ITEM_SKY_SPHERE);
	if (named)
		sky = *named;
	while (!pov_failed(p) && read_sky_word(p, &sky))
		;
	if (!pov_failed(p) && !sky.count)
		pov_fail_at(p, &at, "sky_sphere needs a pigment");
	return pov_close(p, "sky_sphere") ? pov_copy(p, &sky, sizeof(sky)) : NULL;
}

/* The last one of a file is the one that counts. */
void pov_use_sky(struct pov *p, const struct pov_sky *from)
{
	struct copies copies = { .book = pov_book(p) };
	struct scene *s = pov_scene(p);
	struct sky_sphere *sky;

	if (!from || pov_failed(p))
		return;
	sky = arena_zalloc(&s->arena, sizeof(*sky));
	if (sky)
		sky->pigment = arena_zalloc(&s->arena, from->count * sizeof(struct pigment *));
	for (const struct pov_sky_pigment *f = from->first; sky && sky->pigment && f; f = f->next) {
		if (!pov_lack_use(p, &f->pigment.lack))
			break;
		if (f->pigment.lack.construct)
			continue;
		sky->pigment[sky->count] = scene_adopt_pigment(s, &copies, &f->pigment.pigment);
		if (!sky->pigment[sky->count++])
			sky->pigment = NULL;
	}
	copies_release(&copies);
	if (pov_failed(p))
		return;
	if (!sky || !sky->pigment) {
		pov_no_memory(p);
		return;
	}
	sky->emission = from->emission;
	sky->place = from->place;
	s->sky = sky;
}

static struct pov_fog default_fog(void)
{
	return (struct pov_fog){ .fog = { .up = { 0, 1, 0 },
					  .turb_depth = 0.5,
					  .lambda = 2,
					  .omega = 0.5,
					  .octaves = 6 } };
}

static void read_type(struct pov *p, struct pov_fog *f)
{
	struct diag_pos at;
	double type;

	pov_next(p);
	at = pov_here(p);
	type = pov_finite_float(p, "fog_type");
	if (!pov_failed(p) && (type < 1 || type >= 3))
		pov_fail_at(p, &at, "fog_type is %g, but has to be 1 (everywhere) or 2 (ground)", type);
	f->fog.ground = type >= 2;
}

static void read_octaves(struct pov *p, struct pov_fog *f)
{
	double n;

	pov_next(p);
	n = pov_finite_float(p, "octaves");
	f->fog.octaves = n < 1 ? 1 : n > 10 ? 10 : (uint32_t)n; /* POV-Ray's limits */
}

static bool read_number(struct pov *p, struct pov_fog *f)
{
	const struct {
		enum pov_token_kind token;
		double *to;
	} word[] = { { TOK_DISTANCE, &f->fog.distance },     { TOK_FOG_OFFSET, &f->fog.offset },
		     { TOK_FOG_ALT, &f->fog.alt },	     { TOK_TURB_DEPTH, &f->fog.turb_depth },
		     { TOK_LAMBDA, &f->fog.lambda },	     { TOK_OMEGA, &f->fog.omega } };
	enum pov_token_kind t = pov_token(p);

	for (size_t i = 0; i < sizeof(word) / sizeof(word[0]); i++) {
		if (t != word[i].token)
			continue;
		pov_next(p);
		*word[i].to = pov_finite_float(p, keyword_text(t));
		return true;
	}
	return false;
}

static bool read_fog_word(struct pov *p, struct pov_fog *f)
{
	struct xform x = xform_identity;

	switch (pov_token(p)) {
	case TOK_FOG_TYPE:
		read_type(p, f);
		return true;
	case TOK_OCTAVES:
		read_octaves(p, f);
		return true;
	case TOK_UP:
		pov_next(p);
		f->fog.up = pov_finite_vector(p, "up");
		return true;
	case TOK_TURBULENCE:
		pov_next(p);
		f->fog.turbulence = pov_finite_vector(p, "turbulence");
		return true;
	default:
		if (read_number(p, f))
			return true;
	}
	if (pov_transform(p, &x)) { /* turns the fog; its offset stays, as in POV-Ray */
		f->fog.up = mat_dir(&x.fwd, f->fog.up);
		return true;
	}
	if (pov_starts_number(p) && !pov_starts_vector(p)) { /* as POV-Ray 1 had it */
		f->fog.distance = pov_finite_float(p, "the fog's distance");
		return true;
	}
	if (!pov_starts_colour(p))
		return false;
	f->fog.colour = pov_finite_colour(p, "the fog's colour");
	return true;
}

static void check_fog(struct pov *p, const struct diag_pos *at, struct pov_fog *f)
{
	double up = vec_length(f->fog.up);

	if (pov_failed(p))
		return;
	if (f->fog.distance < 0)
		pov_fail_at(p, at, "the fog's distance is %g, but cannot be negative", f->fog.distance);
	if (f->fog.ground && f->fog.alt == 0)
		pov_fail_at(p, at, "ground fog needs fog_alt, the height above fog_offset at which it is "
			    "half as dense");
	if (!(up > 0) || !isfinite(up))
		pov_fail_at(p, at, "the fog's up has no direction");
	else
		f->fog.up = vec_scale(f->fog.up, 1 / up);
}

struct pov_fog *pov_read_fog(struct pov *p)
{
	struct diag_pos at = pov_here(p);
	struct pov_fog f = default_fog(), *named;

	if (!pov_open(p))
		return NULL;
	named = pov_take(p, ITEM_FOG);
	if (named)
		f = *named;
	while (!pov_failed(p) && read_fog_word(p, &f))
		;
	check_fog(p, &at, &f);
	return pov_close(p, "fog") ? pov_copy(p, &f, sizeof(f)) : NULL;
}

void pov_use_fog(struct pov *p, const struct pov_fog *f)
{
	uint32_t i;

	if (!f || pov_failed(p))
		return;
	if (fabs(f->fog.distance) <= 1e-10) { /* POV-Ray's way to have none */
		pov_warn(p, NULL, "a fog without distance is not seen");
		return;
	}
	i = scene_add_fog(pov_scene(p));
	if (i == SCENE_NONE)
		pov_no_memory(p);
	else
		pov_scene(p)->fog[i] = f->fog;
}
