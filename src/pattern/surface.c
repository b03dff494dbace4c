/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Patterns of how a surface lies, in the world's directions, and of another pigment's grey.
 */
#include "pattern/family.h"
#include "pattern/function.h"

#define PI 3.14159265358979323846
#define TINY 1e-10

double surface_aoi(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	(void)s;
	(void)q;
	return acos(fmax(-1, fmin(1, vec_dot(at->n, at->dir)))) / PI;
}

/* Into 0 to 1, where 1 itself stays at the upper end. */
static double fold(double x)
{
	return x < 0 ? 1 + fmod(x, 1) : fmod(x, 1);
}

double surface_slope(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	vec to = q->of.slope.slope;
	double x, y, weight = q->of.slope.slope_weight;

	(void)s;
	if (q->of.slope.point_at)
		to = vec_unit(vec_sub(to, at->world));
	x = fmax(-1, fmin(1, vec_dot(at->n, to)));
	x = (asin(x) / PI * 2 + 1) * 0.5;
	if (q->of.slope.slope_width != 0)
		x = (x - q->of.slope.slope_low) / q->of.slope.slope_width;
	if (weight == 1)
		return x == 1 ? x - TINY : fold(x);
	y = vec_dot(at->p, q->of.slope.altitude);
	if (q->of.slope.altitude_width != 0)
		y = (y - q->of.slope.altitude_low) / q->of.slope.altitude_width;
	x = weight * x + (1 - weight) * y;
	return x >= 1 && x - 1 < TINY ? x - TINY : fold(x);
}

double surface_pigment(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	return rgb_grey(rgbft_rgb(pigment_at(s, q->of.pigment, at)));
}

double surface_function(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	return function_at(s, q->of.function, at->p);
}
