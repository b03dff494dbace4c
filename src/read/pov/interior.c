/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Interiors and materials (manual 3.4.8.1 and 3.4.7).
 */
#include <config.h>

#include "read/pov/items.h"

static void read_dispersion(struct pov *p, struct pov_interior *in)
{
	struct pov_lack lack = { 0 };
	double x;

	pov_lack_note(p, &lack, "dispersion", "remove dispersion from the interior");
	pov_next(p);
	x = pov_finite_float(p, "dispersion");
	if (x != 1 && x != 0)
		pov_lack_add(&in->lack, &lack);
}

static bool read_word(struct pov *p, struct pov_interior *in)
{
	struct interior *i = &in->interior;

	switch (pov_token(p)) {
	case TOK_IOR:
		pov_next(p);
		i->ior = pov_positive(p, "ior");
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
		read_dispersion(p, in);
		return true;
	case TOK_DISPERSION_SAMPLES:
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
	struct pov_interior in = { .interior = { .ior = 1 } };
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
