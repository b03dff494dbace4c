/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * warp { ... } (manual 3.4.7.7).
 */
#include <config.h>

#include "read/pov/pattern.h"

#define TINY 1e-10 /* what POV-Ray takes for 0 */

static void read_turbulence(struct pov *p, struct warp *w)
{
	const struct turbulence_words t = { &w->w.turbulence.amount, &w->w.turbulence.octaves,
					    &w->w.turbulence.lambda, &w->w.turbulence.omega };

	w->kind = WARP_TURBULENCE;
	w->w.turbulence.octaves = 6;
	w->w.turbulence.lambda = 2;
	w->w.turbulence.omega = 0.5;
	w->w.turbulence.amount = pov_finite_vector(p, "turbulence");
	while (pov_token(p) != TOK_TURBULENCE && turbulence_word(p, &t))
		;
}

static double flipped(double x)
{
	return x != 0 ? -1 : 1;
}

static void read_repeat(struct pov *p, struct warp *w)
{
	struct diag_pos at = pov_here(p);
	vec v = pov_finite_vector(p, "repeat");
	int axes = (v.x != 0) + (v.y != 0) + (v.z != 0);

	if (pov_failed(p))
		return;
	if (axes != 1) {
		pov_fail_at(p, &at, "a warp repeats along one axis; x*2, for example");
		return;
	}
	w->kind = WARP_REPEAT;
	w->w.repeat.axis = v.x != 0 ? 0 : v.y != 0 ? 1 : 2;
	w->w.repeat.width = v.x + v.y + v.z;
	w->w.repeat.flip = vec_make(1, 1, 1);
	while (!pov_failed(p)) {
		if (pov_accept(p, TOK_OFFSET)) {
			w->w.repeat.offset = pov_finite_vector(p, "offset");
		} else if (pov_accept(p, TOK_FLIP)) {
			v = pov_finite_vector(p, "flip");
			w->w.repeat.flip = vec_make(flipped(v.x), flipped(v.y), flipped(v.z));
		} else {
			return;
		}
	}
}

/* Blocks of a repeated black hole must be large enough for it: POV-Ray moves and enlarges them. */
static void fit_hole(struct warp *w)
{
	for (int i = 0; i < 3; i++) {
		double *repeat = &(&w->w.hole.repeat.x)[i], *centre = &(&w->w.hole.centre.x)[i];
		double need;

		if (!w->w.hole.repeats || *repeat <= 0)
			continue;
		if (*centre < w->w.hole.radius)
			*centre = w->w.hole.radius;
		need = *centre + w->w.hole.radius + (&w->w.hole.uncertainty.x)[i];
		if (*repeat < need)
			*repeat = need;
		if (*repeat < TINY)
			*repeat = 0;
	}
}

static bool hole_word(struct pov *p, struct warp *w)
{
	switch (pov_token(p)) {
	case TOK_STRENGTH:
		pov_next(p);
		w->w.hole.strength = pov_finite_float(p, "strength");
		return true;
	case TOK_FALLOFF:
		pov_next(p);
		w->w.hole.power = pov_finite_float(p, "falloff");
		return true;
	case TOK_INVERSE:
		pov_next(p);
		w->w.hole.inverse = true;
		return true;
	case TOK_TYPE:
		pov_next(p);
		w->w.hole.none = trunc(pov_finite_float(p, "type")) != 0;
		return true;
	case TOK_REPEAT:
		pov_next(p);
		w->w.hole.repeat = pov_finite_vector(p, "repeat");
		w->w.hole.repeats = true;
		fit_hole(w);
		return true;
	case TOK_TURBULENCE:
		pov_next(p);
		w->w.hole.uncertainty = pov_finite_vector(p, "turbulence");
		w->w.hole.uncertain = true;
		fit_hole(w);
		return true;
	default:
		return false;
	}
}

static void read_hole(struct pov *p, struct warp *w)
{
	w->kind = WARP_BLACK_HOLE;
	w->w.hole.centre = pov_finite_vector(p, "the black hole's centre");
	pov_comma(p);
	w->w.hole.radius = pov_finite_float(p, "the black hole's radius");
	w->w.hole.strength = 1;
	w->w.hole.power = 2;
	while (!pov_failed(p) && hole_word(p, w))
		;
}

static vec read_orientation(struct pov *p)
{
	struct diag_pos at = pov_here(p);
	vec v = pov_finite_vector(p, "orientation");

	if (!pov_failed(p) && !(vec_length(v) > 0))
		pov_fail_at(p, &at, "orientation has no direction");
	return vec_unit(v);
}

static void read_map(struct pov *p, struct warp *w, enum warp_kind kind)
{
	w->kind = kind;
	w->w.map.orientation = vec_make(0, 0, 1);
	w->w.map.major = 1;
	if (kind == WARP_PLANAR) {
		if (pov_starts_number(p)) {
			w->w.map.orientation = read_orientation(p);
			pov_comma(p);
			w->w.map.distance = pov_finite_float(p, "the planar warp's distance");
		}
		return;
	}
	while (!pov_failed(p)) {
		if (pov_accept(p, TOK_ORIENTATION))
			w->w.map.orientation = read_orientation(p);
		else if (pov_accept(p, TOK_DIST_EXP))
			w->w.map.exponent = pov_finite_float(p, "dist_exp");
		else if (kind == WARP_TOROIDAL && pov_accept(p, TOK_MAJOR_RADIUS))
			w->w.map.major = pov_finite_float(p, "major_radius");
		else
			return;
	}
}

void pattern_warp_read(struct pov *p, struct pattern_draft *d)
{
	struct warp w = { .kind = WARP_CUBIC }, *to;

	if (!pov_open(p))
		return;
	if (pov_accept(p, TOK_TURBULENCE))
		read_turbulence(p, &w);
	else if (pov_accept(p, TOK_REPEAT))
		read_repeat(p, &w);
	else if (pov_accept(p, TOK_BLACK_HOLE))
		read_hole(p, &w);
	else if (pov_accept(p, TOK_CYLINDRICAL))
		read_map(p, &w, WARP_CYLINDRICAL);
	else if (pov_accept(p, TOK_SPHERICAL))
		read_map(p, &w, WARP_SPHERICAL);
	else if (pov_accept(p, TOK_PLANAR))
		read_map(p, &w, WARP_PLANAR);
	else if (pov_accept(p, TOK_TOROIDAL))
		read_map(p, &w, WARP_TOROIDAL);
	else if (!pov_accept(p, TOK_CUBIC))
		pov_fail(p, "%s is no kind of warp", pov_text(p));
	if (!pov_close(p, "warp"))
		return;
	to = pattern_warp_push(p, &d->pattern);
	if (to)
		*to = w;
}
