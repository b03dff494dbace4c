/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * rainbow { ... } (manual 3.4.3.5).
 */
#include <config.h>

#include "read/pov/items.h"

#include <math.h>
#include <string.h>

#define RADIANS (3.14159265358979323846 / 180)

static struct pov_rainbow default_rainbow(void)
{
	return (struct pov_rainbow){ .rainbow = { .distance = 1e7, .arc = 360, .falloff = 360, .up = { 0, 1, 0 } } };
}

static bool read_rainbow_word(struct pov *p, struct pov_rainbow *r)
{
	const struct {
		enum pov_token_kind token;
		double *to;
	} word[] = { { TOK_ANGLE, &r->rainbow.angle }, { TOK_WIDTH, &r->rainbow.width },
		     { TOK_DISTANCE, &r->rainbow.distance }, { TOK_ARC_ANGLE, &r->rainbow.arc },
		     { TOK_FALLOFF_ANGLE, &r->rainbow.falloff } };
	enum pov_token_kind t = pov_token(p);

	for (size_t i = 0; i < sizeof(word) / sizeof(word[0]); i++) {
		if (t != word[i].token)
			continue;
		pov_next(p);
		*word[i].to = pov_finite_float(p, keyword_text(t));
		return true;
	}
	switch (t) {
	case TOK_DIRECTION:
		pov_next(p);
		r->rainbow.direction = pov_finite_vector(p, "direction");
		return true;
	case TOK_UP:
		pov_next(p);
		r->rainbow.up = pov_finite_vector(p, "up");
		return true;
	case TOK_COLOUR_MAP:
		r->map = pov_read_map(p, false);
		return true;
	case TOK_JITTER:
		pov_lack_note(p, &r->lack, "jitter of a rainbow", NULL);
		pov_next(p);
		pov_finite_float(p, "jitter");
		return true;
	default:
		return false;
	}
}

static void check_rainbow(struct pov *p, const struct diag_pos *at, struct pov_rainbow *r)
{
	struct rainbow *b = &r->rainbow;
	vec right = vec_cross(b->direction, b->up);

	if (pov_failed(p))
		return;
	if (!(vec_length(b->direction) > 0)) {
		pov_fail_at(p, at, "the rainbow's direction is missing: where its middle is");
	} else if (!(vec_length(right) > 1e-9 * vec_length(b->direction) * vec_length(b->up))) {
		pov_fail_at(p, at, "the rainbow's up points along its direction");
	} else if (b->distance < 0 || b->width < 0) {
		pov_fail_at(p, at, "the rainbow's %s is negative", b->width < 0 ? "width" : "distance");
	} else if (b->falloff > b->arc && b->falloff != 360) {
		pov_fail_at(p, at, "the rainbow's falloff_angle, %g, is more than its arc_angle, %g", b->falloff,
			    b->arc);
	} else {
		b->direction = vec_unit(b->direction);
		b->right = vec_unit(right);
		b->up = vec_cross(b->right, b->direction);
	}
}

struct pov_rainbow *pov_read_rainbow(struct pov *p)
{
	struct diag_pos at = pov_here(p);
	struct pov_rainbow r = default_rainbow(), *named;

	if (!pov_open(p))
		return NULL;
	named = pov_take(p, ITEM_RAINBOW);
	if (named)
		r = *named;
	while (!pov_failed(p) && read_rainbow_word(p, &r))
		;
	check_rainbow(p, &at, &r);
	return pov_close(p, "rainbow") ? pov_copy(p, &r, sizeof(r)) : NULL;
}

void pov_use_rainbow(struct pov *p, const struct pov_rainbow *from)
{
	struct rainbow *to;
	uint32_t i, n;

	if (!from || pov_failed(p) || !pov_lack_use(p, &from->lack) || from->lack.construct)
		return;
	if (!from->map || from->rainbow.width == 0 || from->rainbow.distance == 0) {
		pov_warn(p, NULL, "a rainbow without %s is not seen",
			 !from->map ? "a color_map" : from->rainbow.width == 0 ? "width" : "distance");
		return;
	}
	n = from->map->map.count;
	i = scene_add_rainbow(pov_scene(p), n);
	if (i == SCENE_NONE) {
		pov_no_memory(p);
		return;
	}
	to = &pov_scene(p)->rainbow[i];
	memcpy(to->entry, from->map->map.entry, n * sizeof(*to->entry));
	*to = (struct rainbow){ .angle = from->rainbow.angle * RADIANS, .width = from->rainbow.width * RADIANS,
				.distance = from->rainbow.distance, .arc = from->rainbow.arc / 2 * RADIANS,
				.falloff = from->rainbow.falloff / 2 * RADIANS,
				.direction = from->rainbow.direction, .up = from->rainbow.up,
				.right = from->rainbow.right, .count = n, .entry = to->entry };
}
