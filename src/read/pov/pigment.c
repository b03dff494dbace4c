/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pigments (manual 3.4.6.1): a colour, or a pattern with a map.
 */
#include <config.h>

#include "read/pov/pattern.h"

static void examine(struct pov *p, struct pov_pigment *out, struct pattern_draft *d)
{
	out->pigment.map = d->map.map;
	out->pigment.pattern = pattern_finish(p, d);
	out->lack = d->lack;
	out->depth = 0;
	if (d->given) {
		pov_lack_add(&out->lack, &d->map.lack);
		out->depth = d->map.depth;
	}
	pigment_examine(&out->pigment);
}

static bool read_pattern(struct pov *p, struct pov_pigment *out, enum pattern_use use)
{
	const struct pov_pigment before = *out;
	struct pattern_draft d;

	pattern_draft_init(&d, use, out->pigment.pattern);
	d.map = (struct pov_map){ .map = out->pigment.map, .lack = out->lack, .depth = out->depth };
	if (pattern_word(p, &d)) {
		out->pigment.uv = false;
	} else if (!pov_failed(p) && pov_starts_colour(p)) {
		out->pigment.uv = false;
		out->pigment.colour = pov_finite_colour(p, "the pigment's colour");
		d.given = false;
		d.map = (struct pov_map){ .map = { .kind = MAP_NONE } };
	}
	d.average = d.given && d.pattern.kind == PATTERN_AVERAGE;
	pattern_modifiers(p, &d);
	if (d.average && !d.map.map.count && !pov_failed(p))
		pov_fail(p, "average needs a %s", use == IN_DENSITY ? "density_map" : "pigment_map");
	if (out->pigment.uv) /* it ignores what comes after it, as in POV-Ray */
		*out = before;
	else
		examine(p, out, &d);
	return !pov_failed(p);
}

bool pov_pigment_body(struct pov *p, struct pov_pigment *out)
{
	struct pov_pigment *named = pov_take(p, ITEM_PIGMENT);

	if (named)
		*out = *named;
	if (!pov_accept(p, TOK_UV_MAPPING))
		return read_pattern(p, out, IN_PIGMENT);
	/* All that follows belongs to what is asked at (u, v, 0). */
	*out = pov_default_texture(p)->layer[0].pigment;
	if (!pov_nest(p) || !pov_pigment_body(p, out))
		return false;
	pov_unnest(p);
	out->pigment.uv = out->pigment.pattern != NULL;
	pigment_examine(&out->pigment);
	return true;
}

bool pov_density_body(struct pov *p, struct pov_pigment *out)
{
	struct pov_pigment *named = pov_take(p, ITEM_DENSITY);

	*out = (struct pov_pigment){ .pigment = { .colour = { 1, 1, 1, 0, 0 } } };
	if (named)
		*out = *named;
	return read_pattern(p, out, IN_DENSITY);
}

struct pov_pigment *pov_read_density(struct pov *p)
{
	struct pov_pigment density;

	if (!pov_open(p) || !pov_density_body(p, &density))
		return NULL;
	return pov_close(p, "density") ? pov_copy(p, &density, sizeof(density)) : NULL;
}

struct pov_pigment *pov_read_pigment(struct pov *p, const struct pov_pigment *base)
{
	struct pov_pigment pigment = *base;

	if (!pov_open(p) || !pov_pigment_body(p, &pigment))
		return NULL;
	return pov_close(p, "pigment") ? pov_copy(p, &pigment, sizeof(pigment)) : NULL;
}
