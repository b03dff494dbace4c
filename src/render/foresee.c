/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "render/foresee.h"

#include <math.h>

#include "shade/camera.h"

#define ENOUGH 1e12 /* rays: of pictures that are drawn until they are good, or time is over */
#define EDGES 0.2 /* of the pixels: which adaptive anti-aliasing looks at again */
#define AREA_RAYS 16.0 /* of a hit to an adaptive area lamp */
#define SHADOWS_CLEAR 0.5 /* of shadow rays, which are asked again behind what is clear */
#define VEIL_STEPS 10.0 /* places along a ray where media ask for light */
#define DEEP_RAYS 100.0 /* of a hit, for light below surfaces */
#define LENS_RAYS 32.0 /* of a sample, for focal blur */
#define GATHERED 512.0 /* rays a pixel of indirect light, where nobody says how many */
#define GATHERED_CACHE 32.0 /* of a cache */

/* Camera rays to a pixel. */
static double samples(const struct scene *s, const struct render_options *o)
{
	double n = render_pixel_samples(o), side = o->aa_n;

	if (o->budget && !o->spp)
		return ENOUGH;
	if (!o->spp && o->aa == RENDER_AA_POV1 && o->aa_threshold > 0)
		n = 1 + EDGES * side * side;
	else if (!o->spp && o->aa == RENDER_AA_POV2)
		n = 1 + EDGES * (1u << (side < 15 ? 2 * (unsigned)side : 30));
	if (camera_has_lens(&s->camera) && !o->spp)
		n *= o->blur_samples ? o->blur_samples : LENS_RAYS;
	return n;
}

/* Shadow rays of a place that is lit. */
static double lamps(const struct scene *s, const struct render_options *o)
{
	double n = 0;

	for (uint32_t i = 0; i < s->light_count; i++) {
		const struct light *l = &s->light[i];
		double points = (double)l->size1 * l->size2;

		if (l->shadowless)
			continue;
		if (!l->area || o->spp)
			n += 1;
		else
			n += l->adaptive == LIGHT_NOT_ADAPTIVE || points < AREA_RAYS ? points : AREA_RAYS;
	}
	return n;
}

/* Some of the textures mirror, or let light through. */
static void find_textures(const struct scene *s, double *mirrors, double *clear)
{
	*mirrors = *clear = 0;

	for (uint32_t i = 0; i < s->texture_count; i++) {
		const struct texture *t = &s->texture[i];

		*clear = t->clear ? 1 : *clear;
		for (uint32_t k = 0; k < t->count; k++) {
			const struct finish *f = &t->layer[k].finish;

			if (rgb_max(f->reflection_max) > 0 || rgb_max(f->reflection_min) > 0)
				*mirrors = 1;
		}
	}
}

/* Surfaces that are lit for each one that the camera sees: what mirrors show, and what is behind glass, which where it
 * mirrors as well makes trees. */
static double depth(const struct scene *s, double mirrors, double clear)
{
	double most = s->max_trace_level < 8 ? s->max_trace_level : 8;

	return mirrors + clear > 0 ? fmin(1 + mirrors + 2 * clear + 2 * mirrors * clear, most) : 1;
}

static bool has_media(const struct scene *s)
{
	for (uint32_t i = 0; i < s->interior_count; i++) {
		if (s->interior[i].media_count)
			return true;
	}
	return s->media_count > 0;
}

static double gathered(const struct scene *s, const struct render_options *o, double each)
{
	double n = o->indirect_samples;

	if (!s->radiosity.given || o->indirect == INDIRECT_OFF)
		return 0;
	if (o->indirect == INDIRECT_CACHE)
		return n > 0 ? fmin(n, GATHERED_CACHE) : GATHERED_CACHE;
	n = n > 0 ? n : GATHERED;
	return (o->spp ? 1 : fmax(n / each, 1)) * s->radiosity.recursion_limit;
}

double render_foresee(const struct scene *s, const struct render_options *o)
{
	double pixels = o->crop_width ? (double)o->crop_width * o->crop_height : (double)o->width * o->height;
	double each = samples(s, o), lit = lamps(s, o), veils = has_media(s) ? VEIL_STEPS : 0;
	double mirrors, clear, shadows;
	double deep = s->subsurface.given && s->subsurface.used ? DEEP_RAYS : 0;

	if (o->camera_only)
		return pixels * each;
	find_textures(s, &mirrors, &clear);
	shadows = lit * (1 + SHADOWS_CLEAR * clear);
	return fmin(ENOUGH, pixels * each * depth(s, mirrors, clear) * (1 + shadows) *
				    (1 + veils + deep + gathered(s, o, each)));
}
