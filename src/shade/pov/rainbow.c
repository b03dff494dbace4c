/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Rainbows (manual 3.4.3.5), as measured: rays that would see fog see them by their directions alone, before what
 * they hit and behind fog. A bow's colour takes the place of what is behind it but for the greater of its transmit
 * and of e^(-length / distance), less where its arc fades, smoothly; its filter counts as far as it is there. Of
 * several bows in one place the mean is seen.
 */
#include "shade/shade.h"

#include "pattern/pattern.h"

static struct rgbft map_colour(const struct rainbow *r, double at)
{
	const struct map m = { .count = r->count, .entry = r->entry };
	struct rgbft x, y;
	uint32_t a, b;
	double t;

	map_find(&m, at, &a, &b, &t);
	x = r->entry[a].is.colour;
	y = r->entry[b].is.colour;
	return (struct rgbft){ x.r + t * (y.r - x.r), x.g + t * (y.g - x.g), x.b + t * (y.b - x.b),
			       x.filter + t * (y.filter - x.filter), x.transmit + t * (y.transmit - x.transmit) };
}

/* False: the ray passes it by. */
static bool one_bow(const struct rainbow *r, vec dir, double length, struct rgb *clear, struct rgb *glow)
{
	double x = vec_dot(dir, r->right), y = vec_dot(dir, r->up), around = fabs(atan2(x, y));
	double at = (acos(fmax(-1, fmin(1, vec_dot(dir, r->direction)))) - r->angle) / r->width + 0.5;
	double fade = 1, there, f;
	struct rgbft c;

	if (!(at >= 0 && at <= 1) || around > r->arc)
		return false;
	c = map_colour(r, at);
	if (around > r->falloff && r->falloff < r->arc) {
		double u = (around - r->falloff) / (r->arc - r->falloff);

		fade = 1 - u * u * (3 - 2 * u);
	}
	there = fade * (1 - fmax(c.transmit, isfinite(length) ? exp(-length / r->distance) : 0));
	f = c.filter * there;
	*glow = rgb_scale(rgbft_rgb(c), there);
	*clear = rgb_scale(rgb_make(1 - f + f * c.r, 1 - f + f * c.g, 1 - f + f * c.b), 1 - there);
	return true;
}

void shade_rainbow(const struct shader *sh, struct tree *t, uint32_t first, uint32_t n)
{
	for (uint32_t i = first; i < first + n && !t->no_memory; i++) {
		const struct node *node = BUF_AT(&t->node, struct node, i);
		struct rgb clear = { 0, 0, 0 }, glow = { 0, 0, 0 };
		double bows = 0;

		if (node->nowhere || !shade_sees_air(sh, node) || !inside_hollow(t, node->inside))
			continue;
		for (uint32_t k = 0; k < sh->scene->rainbow_count; k++) {
			struct rgb c, g;

			if (!one_bow(&sh->scene->rainbow[k], node->dir, node->length, &c, &g))
				continue;
			clear = rgb_add(clear, c);
			glow = rgb_add(glow, g);
			bows++;
		}
		if (bows > 0)
			tree_veil(t, i, rgb_scale(clear, 1 / bows), rgb_scale(glow, 1 / bows));
	}
}
