/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Interiors and materials (manual 3.4.8.1 and 3.4.7).
 */
#include <config.h>

#include "read/pov/items.h"

#define BANDS 7 /* that POV-Ray splits light into when nobody says how many */
#define MOST_BANDS 1000

/* Of POV-Ray's fractions of a band only whole ones count: measured. */
static void read_bands(struct pov *p, struct interior *i)
{
	struct diag_pos at = pov_here(p);
	double x = pov_finite_float(p, "dispersion_samples");

	if (!pov_failed(p) && !(x >= 2 && x < MOST_BANDS + 1)) {
		pov_fail_at(p, &at, "dispersion_samples is %g, but has to be from 2 to %d", x, MOST_BANDS);
		return;
	}
	i->dispersion_samples = (uint32_t)x;
}

/* 0 is as good as none: measured. */
static double read_ior(struct pov *p)
{
	struct diag_pos at = pov_here(p);
	double x = pov_finite_float(p, "ior");

	if (x < 0)
		pov_fail_at(p, &at, "ior is %g, but has to be at least 0", x);
	return x > 0 ? x : 1;
}

static bool read_word(struct pov *p, struct pov_interior *in)
{
	struct interior *i = &in->interior;

	switch (pov_token(p)) {
	case TOK_IOR:
		pov_next(p);
		i->ior = read_ior(p);
		in->bends = true;
		return true;
	case TOK_CAUSTICS:
		pov_next(p);
		i->caustics = pov_finite_float(p, "caustics");
		return true;
	case TOK_FADE_DISTANCE:
		pov_next(p);
		i->fade_distance = pov_finite_float(p, "fade_distance");
		return true;
	case TOK_FADE_POWER:
		pov_next(p);
		i->fade_power = pov_finite_float(p, "fade_power");
		return true;
	case TOK_FADE_COLOUR:
		pov_next(p);
		i->fade_colour = rgbft_rgb(pov_finite_colour(p, "fade_color"));
		return true;
	case TOK_DISPERSION:
		in->splits = pov_here(p);
		pov_next(p);
		i->dispersion = pov_positive(p, "dispersion");
		return true;
	case TOK_DISPERSION_SAMPLES:
		pov_next(p);
		read_bands(p, i);
		return true;
	case TOK_REFRACTION:
		pov_next(p);
		pov_float(p);
		return true;
	case TOK_MEDIA:
		return pov_add_media(p, &in->media_count, &in->media);
	default:
		return false;
	}
}

struct pov_interior *pov_read_interior(struct pov *p, const struct pov_interior *base)
{
	struct pov_interior in = { .interior = { .ior = 1, .dispersion = 1, .dispersion_samples = BANDS } };
	struct pov_interior *named;

	if (base)
		in = *base;
	if (!pov_open(p))
		return NULL;
	named = pov_take(p, ITEM_INTERIOR);
	if (named && pov_token(p) == TOK_RIGHT_BRACE)
		return pov_close(p, "interior") ? named : NULL;
	if (named)
		in = *named;
	while (!pov_failed(p) && read_word(p, &in))
		;
	in.index = SCENE_NONE;
	return pov_close(p, "interior") ? pov_copy(p, &in, sizeof(in)) : NULL;
}

bool pov_read_material(struct pov *p, struct pov_material *m)
{
	struct pov_material *named;
	struct xform x;
	struct pov_texture *t;

	if (!pov_open(p))
		return false;
	named = pov_take(p, ITEM_MATERIAL);
	if (named) {
		m->texture = pov_texture_over(p, named->texture, m->texture);
		m->interior_texture =
			pov_texture_over(p, named->interior_texture, m->interior_texture);
		if (named->interior)
			m->interior = named->interior;
	}
	while (!pov_failed(p)) {
		if (pov_token(p) == TOK_TEXTURE) {
			t = pov_read_texture(p);
			m->texture = pov_texture_over(p, t, m->texture);
		} else if (pov_token(p) == TOK_INTERIOR_TEXTURE) {
			t = pov_read_texture(p);
			m->interior_texture = pov_texture_over(p, t, m->interior_texture);
		} else if (pov_token(p) == TOK_INTERIOR) {
			m->interior = pov_read_interior(p, m->interior);
		} else if (pov_token(p) == TOK_PIGMENT || pov_token(p) == TOK_NORMAL ||
			   pov_token(p) == TOK_FINISH) {
			pov_texture_part(p, &m->texture);
		} else {
			x = xform_identity;
			if (pov_transform(p, &x))
				m->texture = pov_texture_transform(p, m->texture, &x);
			else if (!pov_accept(p, TOK_UV_MAPPING))
				break;
		}
	}
	return pov_close(p, "material");
}
