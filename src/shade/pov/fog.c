/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Fog along rays (manual 3.4.3.3).
 *
 * Of light that comes distance far through a fog, 1/e is left, never less than the fog's transmit; the
 * rest is replaced by the fog's colour. Ground fog's density is 1 up to its offset and 1 / (1 + y^2) at y
 * alts above it, so the optical depth of a ray is an arc tangent. Several fogs each add their colour as
 * if alone and take their share from what is behind, as POV-Ray does it (measured), so their sum may be
 * brighter than any. Light of lamps is dimmed by fog only with media_attenuation, and then along shadow
 * rays, stretch by stretch. (POV-Ray's area lights are dimmed twice if their grid's side is such that its
 * recursion shares points: not 1, 2, 4 ... This is taken for a mistake.)
 */
#include "shade/pov/fog.h"

#include "pattern/random.h"

#define LEVEL 1e-10 /* of alts: less rise than this is none */

/* The mean density between heights a and b, in alts above the offset. */
static double ground_density(double a, double b)
{
	if (a <= 0 && b <= 0)
		return 1;
	if (a <= 0)
		return (atan(b) - a) / (b - a);
	if (b <= 0)
		return (atan(a) - b) / (a - b);
	if (fabs(a - b) > LEVEL)
		return (atan(a) - atan(b)) / (a - b);
	return 1 / (a * a + 1);
}

/* Turbulence, asked for at the middle of the way, thins the fog, and less so the more of it there is. */
static double turbulent(const struct scene *s, const struct fog *f, vec org, vec dir, double length)
{
	const struct pattern any = { .noise = 0 }; /* the scene's */
	vec p = vec_mad(org, dir, length / 2);
	double noise;

	p = vec_make(p.x * f->turbulence.x, p.y * f->turbulence.y, p.z * f->turbulence.z);
	noise = noise_turbulence(p, pattern_generator(s, &any), f->octaves, f->lambda, f->omega);
	return length * (1 - exp(-length / f->distance) * fmin(1, noise * f->turb_depth));
}

static double one_clear(const struct scene *s, const struct fog *f, vec org, vec dir, double length)
{
	double density = 1, height, rise;

	if (f->ground) {
		height = vec_dot(org, f->up) - f->offset;
		rise = vec_dot(dir, f->up) * length;
		density = ground_density(height / f->alt, (height + rise) / f->alt);
	}
	if (f->turbulence.x != 0 || f->turbulence.y != 0 || f->turbulence.z != 0)
		length = turbulent(s, f, org, dir, length);
	return fmax(exp(-length * density / f->distance), f->colour.transmit);
}

struct rgb fog_clear(const struct scene *s, vec org, vec dir, double length, struct rgb *glow)
{
	struct rgb clear = { 1, 1, 1 }, sum = { 0, 0, 0 };

	if (!isfinite(length))
		length = SHADE_WORLD_END;
	for (uint32_t i = 0; i < s->fog_count; i++) {
		const struct fog *f = &s->fog[i];
		struct rgb colour = rgbft_rgb(f->colour);
		double left = one_clear(s, f, org, dir, length), k = f->colour.filter;

		sum = rgb_add(sum, rgb_scale(colour, 1 - left));
		colour = rgb_make(1 - k + k * colour.r, 1 - k + k * colour.g, 1 - k + k * colour.b);
		clear = rgb_mul(clear, rgb_scale(colour, left));
	}
	if (glow)
		*glow = sum;
	return clear;
}

void shade_fog(const struct shader *sh, struct tree *t, uint32_t first, uint32_t n)
{
	for (uint32_t i = first; i < first + n && !t->no_memory; i++) {
		const struct node *node = BUF_AT(&t->node, struct node, i);
		struct rgb clear, glow;

		if (node->nowhere || !shade_sees_air(sh, node) || !inside_hollow(t, node->inside))
			continue;
		clear = fog_clear(sh->scene, node->org, node->dir, node->length, &glow);
		tree_veil(t, i, clear, glow);
	}
}
