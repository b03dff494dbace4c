/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Splines (manual 3.3.1.11), measured: outside of their points they stay at the first or the last; a quadratic
 * one is the parabola through the interval's ends and the point before it (behind it, in the first interval);
 * a cubic one is Catmull-Rom's with slopes that are means of the neighbours', which has no first and last
 * interval; a natural one has no curvature at its ends.
 */
#include <config.h>

#include "pattern/function.h"

struct stretch { /* between point i and the next */
	const struct spline *s;
	uint32_t i;
	double t; /* from the first of them */
};

static double at(const struct stretch *x, uint32_t i)
{
	return x->s->at[i];
}

static double value(const struct stretch *x, uint32_t i, uint32_t k)
{
	return x->s->value[(size_t)i * FUNCTION_RESULTS + k];
}

/* Slope of the line from point i to the next. */
static double slope(const struct stretch *x, uint32_t i, uint32_t k)
{
	return (value(x, i + 1, k) - value(x, i, k)) / (at(x, i + 1) - at(x, i));
}

static double linear(const struct stretch *x, uint32_t k)
{
	return value(x, x->i, k) + x->t * slope(x, x->i, k);
}

/* Newton's form: the line, bent by the second difference. */
static double quadratic(const struct stretch *x, uint32_t k)
{
	uint32_t i = x->i ? x->i - 1 : 0;
	double bend, t = x->t + at(x, x->i);

	if (x->s->count < 3)
		return linear(x, k);
	bend = (slope(x, i + 1, k) - slope(x, i, k)) / (at(x, i + 2) - at(x, i));
	return value(x, i, k) + (t - at(x, i)) * (slope(x, i, k) + (t - at(x, i + 1)) * bend);
}

/* Hermite's form. */
static double cubic(const struct stretch *x, uint32_t k)
{
	double width = at(x, x->i + 1) - at(x, x->i), u = x->t / width;
	double before = (slope(x, x->i - 1, k) + slope(x, x->i, k)) / 2 * width;
	double after = (slope(x, x->i, k) + slope(x, x->i + 1, k)) / 2 * width;
	double rise = value(x, x->i + 1, k) - value(x, x->i, k);

	return value(x, x->i, k) + u * (before + u * (3 * rise - 2 * before - after + u * (before + after - 2 * rise)));
}

static double natural(const struct stretch *x, uint32_t k)
{
	double width = at(x, x->i + 1) - at(x, x->i);
	const double *bend = x->s->bend + (size_t)x->i * FUNCTION_RESULTS + k;
	double b0 = bend[0], b1 = bend[FUNCTION_RESULTS];

	double first = slope(x, x->i, k) - width / 6 * (b1 + 2 * b0);

	return value(x, x->i, k) + x->t * (first + x->t * (b0 / 2 + x->t * (b1 - b0) / (6 * width)));
}

/* The point at or before t; 0 if there is none. */
static uint32_t find(const struct spline *s, double t)
{
	uint32_t lo = 0, hi = s->count - 1;

	while (hi - lo > 1) {
		uint32_t mid = lo + (hi - lo) / 2;

		if (t > s->at[mid])
			lo = mid;
		else
			hi = mid;
	}
	return lo;
}

static void copy(const struct stretch *x, uint32_t i, double *out)
{
	for (uint32_t k = 0; k < x->s->terms; k++)
		out[k] = value(x, i, k);
}

void spline_eval(const struct spline *s, enum spline_kind kind, double t, double out[FUNCTION_RESULTS])
{
	uint32_t first = 0, last = s->count - 1;
	struct stretch x = { .s = s };

	if (kind == SPLINE_CUBIC && s->count == 2) { /* POV-Ray's way with it */
		for (uint32_t k = 0; k < s->terms; k++)
			out[k] = (value(&x, 0, k) + value(&x, 1, k)) / 2;
		return;
	}
	if (kind == SPLINE_CUBIC && s->count > 2) {
		first++;
		last--;
	}
	if (!(t > s->at[first]) || !(t < s->at[last])) {
		copy(&x, t > s->at[first] ? last : first, out);
		return;
	}
	x.i = find(s, t);
	x.t = t - s->at[x.i];
	for (uint32_t k = 0; k < s->terms; k++) {
		switch (kind) {
		case SPLINE_LINEAR: out[k] = linear(&x, k); break;
		case SPLINE_QUADRATIC: out[k] = quadratic(&x, k); break;
		case SPLINE_CUBIC: out[k] = cubic(&x, k); break;
		case SPLINE_NATURAL: out[k] = natural(&x, k); break;
		}
	}
}
