/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What rays see that leave the scene: sky sphere and background (manual 3.4.3.2, 3.4.3.5).
 *
 * Pigments of a sky sphere are layers, the last one on top, and the background lies below as another; its
 * transparency counts only where the picture keeps an alpha channel, and then not in mirrors; without
 * alpha its transmit shows black, and its filter nothing (measured). Before version 3.7 the layers'
 * filters, transmits and colours were multiplied up each by itself, and alpha knew no sky at all.
 */
#include "pattern/pattern.h"
#include "shade/shade.h"

static struct rgbft sky_pigment(const struct scene *s, uint32_t i, vec dir)
{
	const struct sky_sphere *sky = s->sky;
	struct pattern_point at = { .p = mat_point(&sky->place.inv, dir),
				    .world = dir,
				    .n = vec_neg(dir),
				    .dir = dir,
				    .place = &sky->place };

	return pigment_at(s, sky->pigment[i], &at);
}

static double opacity(const struct rgbft *c)
{
	return 1 - c->filter - c->transmit;
}

/* One more layer below what is there. */
static void add_layer(struct rgb *colour, struct rgb *clear, struct rgbft c, struct rgb emission)
{
	struct rgb own = rgb_scale(rgbft_rgb(c), opacity(&c));

	*colour = rgb_add(*colour, rgb_mul(rgb_mul(own, *clear), emission));
	*clear = rgb_mul(*clear, rgbft_through(c));
}

static void sky(const struct shader *sh, struct node *n)
{
	const struct rgb one = { 1, 1, 1 };
	const struct scene *s = sh->scene;
	struct rgbft background = s->background;
	struct rgb colour = { 0, 0, 0 }, clear = one;

	for (uint32_t i = s->sky ? s->sky->count : 0; i-- > 0;)
		add_layer(&colour, &clear, sky_pigment(s, i, n->dir), s->sky->emission);
	if (!n->clear_sky)
		background.filter = 0;
	if (!n->clear_sky && sh->alpha)
		background.transmit = 0;
	add_layer(&colour, &clear, background, one);
	n->colour = colour;
	n->transmit = n->clear_sky ? fmin(1, fabs(rgb_grey(clear))) : 0;
}

static void old_sky(const struct shader *sh, struct node *n)
{
	const struct scene *s = sh->scene;
	struct rgb own = { 0, 0, 0 }, colours = { 1, 1, 1 }, clear;
	double filter = 1, transmit = 1, left = 1;

	n->transmit = n->clear_sky;
	n->colour = n->clear_sky ? own : rgbft_rgb(s->background);
	if (n->clear_sky || !s->sky)
		return;
	for (uint32_t i = s->sky->count; i-- > 0;) {
		struct rgbft c = sky_pigment(s, i, n->dir);

		own = rgb_add(own, rgb_scale(rgbft_rgb(c), left * opacity(&c)));
		colours = rgb_mul(colours, rgbft_rgb(c));
		filter *= c.filter;
		transmit *= c.transmit;
		left = fabs(filter) + fabs(transmit);
	}
	clear = rgb_add(rgb_scale(colours, filter), rgb_make(transmit, transmit, transmit));
	n->colour = rgb_add(rgb_mul(n->colour, clear), rgb_mul(own, s->sky->emission));
}

static void any_sky(const struct shader *sh, struct node *n)
{
	if (sh->scene->version < 370)
		old_sky(sh, n);
	else
		sky(sh, n);
}

void shade_sky_init(struct shader *sh)
{
	for (int i = 0; i < 2 && !sh->scene->sky; i++) {
		struct node n = { .clear_sky = i };

		any_sky(sh, &n);
		sh->open[i] = (struct open_sky){ n.colour, n.transmit };
	}
}

void shade_sky(const struct shader *sh, struct node *n)
{
	if (n->nowhere) {
		n->colour = rgb_make(0, 0, 0);
		n->transmit = sh->alpha ? 1 : 0;
	} else if (sh->scene->sky) {
		any_sky(sh, n);
	} else {
		n->colour = sh->open[n->clear_sky].colour;
		n->transmit = sh->open[n->clear_sky].transmit;
	}
}
