/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Which function a pattern's value comes from, and what becomes of it (manual 3.4.7.5.6, 3.4.7.5.7).
 */
#include "pattern/family.h"
#include "pattern/random.h"

static double random_value(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	return random_pattern(s, q, at->p);
}

static pattern_function *const value_of[PATTERN_KINDS] = {
	[PATTERN_CHECKER] = block_checker,
	[PATTERN_BRICK] = block_brick,
	[PATTERN_HEXAGON] = block_hexagon,
	[PATTERN_SQUARE] = block_square,
	[PATTERN_TRIANGULAR] = block_triangular,
	[PATTERN_CUBIC] = block_cubic,
	[PATTERN_MATERIAL_MAP] = picture_material,
	[PATTERN_GRADIENT] = solid_gradient,
	[PATTERN_AOI] = surface_aoi,
	[PATTERN_BOXED] = solid_boxed,
	[PATTERN_CYLINDRICAL] = solid_cylindrical,
	[PATTERN_IMAGE] = picture_value,
	[PATTERN_FRACTAL] = fractal_value,
	[PATTERN_LEOPARD] = solid_leopard,
	[PATTERN_ONION] = solid_onion,
	[PATTERN_FUNCTION] = surface_function,
	[PATTERN_PIGMENT] = surface_pigment,
	[PATTERN_PLANAR] = solid_planar,
	[PATTERN_QUILTED] = solid_quilted,
	[PATTERN_RADIAL] = solid_radial,
	[PATTERN_SLOPE] = surface_slope,
	[PATTERN_SPHERICAL] = solid_spherical,
	[PATTERN_SPIRAL1] = solid_spiral1,
	[PATTERN_SPIRAL2] = solid_spiral2,
	[PATTERN_WRINKLES] = random_value,
	[PATTERN_WOOD] = random_value,
	[PATTERN_WAVES] = random_value,
	[PATTERN_SPOTTED] = random_value,
	[PATTERN_RIPPLES] = random_value,
	[PATTERN_MARBLE] = random_value,
	[PATTERN_GRANITE] = random_value,
	[PATTERN_DENTS] = random_value,
	[PATTERN_CRACKLE] = random_value,
	[PATTERN_CELLS] = random_value,
	[PATTERN_BUMPS] = random_value,
	[PATTERN_BOZO] = random_value,
	[PATTERN_AGATE] = random_value,
};

/* Patterns that bring colours rather than a value. */
static colour_function *const colour_of[PATTERN_KINDS] = {
	[PATTERN_IMAGE_MAP] = picture_colour,
};

bool pattern_known(enum pattern_kind k)
{
	return k == PATTERN_AVERAGE || value_of[k] || colour_of[k];
}

bool pattern_known_slope(enum pattern_kind k)
{
	return k == PATTERN_AVERAGE || k == PATTERN_FACETS || k == PATTERN_BUMP_MAP || value_of[k];
}

double wave_triangle(double x)
{
	double offset = x - floor(x);

	return offset >= 0.5 ? 2 * (1 - offset) : 2 * offset;
}

static double apply_wave(const struct pattern *q, double value)
{
	switch (q->wave) {
	case WAVE_SINE:
		return (1 + cycloidal(value)) * 0.5;
	case WAVE_TRIANGLE:
		return wave_triangle(value);
	case WAVE_SCALLOP:
		return fabs(cycloidal(value * 0.5));
	case WAVE_CUBIC:
		return value * value * (3 - 2 * value);
	case WAVE_POLY:
		return pow(value, q->exponent);
	default:
		return value;
	}
}

double pattern_value_warped(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	double value = value_of[q->kind](s, q, at);

	/* Blocks have a frequency of 0 unless one is given, and then are values like others: measured. A
	 * little more than 1, so that a value of exactly 1 stays 1: measured. */
	if (q->frequency != 0)
		value = fmod(value * q->frequency + q->phase, 1.00001);
	if (value < 0)
		value -= floor(value);
	return apply_wave(q, value);
}

double pattern_value(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	struct pattern_point inner = *at;

	inner.p = pattern_warp(q, at->p);
	return pattern_value_warped(s, q, &inner);
}

struct rgbft pattern_colour(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	return colour_of[q->kind](s, q, at);
}

bool pattern_brings_colour(enum pattern_kind k)
{
	return colour_of[k] != NULL;
}

void map_find(const struct map *m, double value, uint32_t *a, uint32_t *b, double *t)
{
	uint32_t last = m->count - 1, i = 0;

	*t = 0;
	if (value >= m->entry[last].at) {
		*a = *b = last;
		return;
	}
	/* Entries need not rise: the first that is not below the value counts, as in POV-Ray. */
	while (i < last && value > m->entry[i].at)
		i++;
	*a = *b = i;
	if (i == 0 || value == m->entry[i].at)
		return;
	*a = i - 1;
	*t = (value - m->entry[i - 1].at) / (m->entry[i].at - m->entry[i - 1].at);
}
