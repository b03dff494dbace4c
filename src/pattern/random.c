/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Patterns made of noise and of random points (manual 3.4.7.1). The formulas agree with what POV-Ray's
 * functions of patterns print to 1e-12.
 */
#include "pattern/random.h"

#include <stdlib.h>

#define TAU 6.28318530717958647693

uint32_t pattern_generator(const struct scene *s, const struct pattern *pattern)
{
	if (pattern->noise)
		return pattern->noise;
	if (s->noise_generator)
		return s->noise_generator;
	return s->version < 350 ? NOISE_ORIGINAL : NOISE_RANGED;
}

double cycloidal(double v)
{
	return v >= 0 ? sin((v - floor(v)) * TAU) : -sin((-v - floor(-v)) * TAU);
}

static inline double clip(double v)
{
	return v > 0 ? v < 1 ? v : 1 : 0; /* what is no number is 0 */
}

static bool turbulent(const struct pattern *t)
{
	return t->turbulence.amount.x != 0 || t->turbulence.amount.y != 0 || t->turbulence.amount.z != 0;
}

static double agate(const struct pattern *t, vec p, uint32_t generator)
{
	double turb = noise_turbulence(p, generator, t->turbulence.octaves, t->turbulence.lambda,
				       t->turbulence.omega);
	double v = 0.5 * (cycloidal(1.3 * t->of.agate_turb * turb + 1.1 * p.z) + 1);

	return v <= 0 ? 0 : pow(clip(v), 0.77);
}

static double granite(vec p, uint32_t generator)
{
	double sum = 0, frequency = 1;

	p = vec_scale(p, 4);
	for (int i = 0; i < 6; i++, frequency *= 2) {
		double v = noise_value(vec_scale(p, frequency), generator);

		v = generator == NOISE_ORIGINAL ? fabs(0.5 - v) : fmin(fabs(1 - 2 * v), 0.5);
		sum += v / frequency;
	}
	return sum;
}

static double marble(const struct pattern *t, vec p, uint32_t generator)
{
	if (!turbulent(t))
		return p.x;
	return p.x + t->turbulence.amount.x * noise_turbulence(p, generator, t->turbulence.octaves,
							       t->turbulence.lambda, t->turbulence.omega);
}

static double wood(const struct pattern *t, vec p)
{
	vec amount = t->turbulence.amount, turb;

	if (turbulent(t)) {
		turb = noise_vector_turbulence(p, t->turbulence.octaves, t->turbulence.lambda,
					       t->turbulence.omega);
		turb = vec_make(cycloidal((p.x + turb.x) * amount.x), cycloidal((p.y + turb.y) * amount.y), 0);
		p = vec_add(p, turb);
	}
	return sqrt(p.x * p.x + p.y * p.y);
}

static double dents(vec p, uint32_t generator)
{
	double v = noise_value(p, generator);

	return v * v * v;
}

static double wrinkles(vec p, uint32_t generator)
{
	double sum = noise_contrast(p, generator), l = 2, o = 0.5;

	for (int i = 1; i < 10; i++, l *= 2, o *= 0.5)
		sum += o * noise_contrast(vec_scale(p, l), generator);
	return sum / 2;
}

static double ripples(const struct scene *s, const struct pattern *t, vec p)
{
	double sum = 0;

	for (uint32_t i = 0; i < s->number_of_waves; i++) {
		double l = vec_length(vec_sub(p, noise_wave(i).source));

		sum += cycloidal((l == 0 ? 1 : l) * t->frequency + t->phase);
	}
	return 0.5 * (1 + sum / s->number_of_waves);
}

static double waves(const struct scene *s, const struct pattern *t, vec p)
{
	double sum = 0;

	for (uint32_t i = 0; i < s->number_of_waves; i++) {
		struct noise_wave wave = noise_wave(i);
		double l = vec_length(vec_sub(p, wave.source));

		sum += cycloidal((l == 0 ? 1 : l) * t->frequency * wave.frequency + t->phase) / wave.frequency;
	}
	return 0.2 * (2.5 + sum / s->number_of_waves);
}

/* How far is far: |x|^m + |y|^m + |z|^m, before the root. offset: crackle's, as in a fourth dimension. With
 * facets and m = 1 POV-Ray leaves out the bars. */
struct yardstick {
	double metric, offset;
	bool facets;
};

static inline double measure(const struct yardstick *y, vec d)
{
	if (y->metric == 2)
		return vec_dot(d, d) + y->offset * y->offset;
	if (y->metric == 1 && y->facets)
		return d.x + d.y + d.z;
	if (y->metric == 1)
		return fabs(d.x) + fabs(d.y) + fabs(d.z) + y->offset;
	return pow(fabs(d.x), y->metric) + pow(fabs(d.y), y->metric) + pow(fabs(d.z), y->metric) +
	       pow(y->offset, y->metric);
}

static inline double root(double sum, double metric)
{
	return metric == 2 ? sqrt(sum) : metric == 1 ? sum : pow(sum, 1 / metric);
}

struct nearest {
	double distance[3];
	struct noise_cell first;
};

static void near_keep(struct nearest *near, const struct noise_cell *cell, double d)
{
	double *n = near->distance;

	if (d < n[0]) {
		n[2] = n[1];
		n[1] = n[0];
		n[0] = d;
		near->first = *cell;
	} else if (d < n[1]) {
		n[2] = n[1];
		n[1] = d;
	} else if (d < n[2]) {
		n[2] = d;
	}
}

enum { REACH = 5 };
/* How many cells away, the near ones first. */
static const int steps[REACH] = { 0, -1, 1, -2, 2 };

/* Squares of the least distances along one axis to cells that many steps away. from: in the cell, 0 to 1. */
static void gaps(double gap[REACH], double from)
{
	for (int i = 0; i < REACH; i++) {
		double d = steps[i] > 0 ? steps[i] - from : steps[i] < 0 ? from - steps[i] - 1 : 0;

		gap[i] = d * d;
	}
}

/* The three nearest of the random points, one a cell, in the 81 cells about p that can have them. */
static void nearest_find(struct nearest *near, vec p, const struct yardstick *yard)
{
	vec at = noise_cell(p).corner;
	double x[REACH], y[REACH], z[REACH];
	bool plain = yard->metric == 2;

	*near = (struct nearest){ .distance = { HUGE_VAL, HUGE_VAL, HUGE_VAL } };
	gaps(x, p.x - at.x);
	gaps(y, p.y - at.y);
	gaps(z, p.z - at.z);
	for (int i = 0; i < REACH; i++) {
		for (int j = 0; j < REACH; j++) {
			for (int k = 0; k < REACH; k++) {
				struct noise_cell cell;

				if ((i > 2) + (j > 2) + (k > 2) > 1 ||
				    (plain && x[i] + y[j] + z[k] > near->distance[2]))
					continue;
				cell = noise_cell_at(vec_add(at, vec_make(steps[i], steps[j], steps[k])));
				near_keep(near, &cell, measure(yard, vec_sub(vec_add(cell.corner, cell.random), p)));
			}
		}
	}
}

static double crackle(const struct pattern *t, vec p, uint32_t generator)
{
	struct nearest near;
	vec form = t->of.crackle.form;
	double metric = t->of.crackle.metric;
	struct yardstick yard = { metric, t->of.crackle.offset, false };

	nearest_find(&near, p, &yard);
	if (t->of.crackle.solid)
		return noise_value(vec_add(near.first.corner, near.first.random), generator);
	return clip(form.x * root(near.distance[0], metric) + form.y * root(near.distance[1], metric) +
		    form.z * root(near.distance[2], metric));
}

vec random_facet(vec p, double metric)
{
	struct nearest near;
	struct yardstick yard = { metric, 0, true };

	nearest_find(&near, p, &yard);
	return vec_add(near.first.corner, near.first.random);
}

double random_pattern(const struct scene *s, const struct pattern *t, vec p)
{
	uint32_t generator = pattern_generator(s, t);

	switch (t->kind) {
	case PATTERN_AGATE: return agate(t, p, generator);
	case PATTERN_BOZO: case PATTERN_BUMPS: case PATTERN_SPOTTED: return noise_value(p, generator);
	case PATTERN_CELLS: return noise_cell(p).random.x;
	case PATTERN_CRACKLE: return crackle(t, p, generator);
	case PATTERN_DENTS: return dents(p, generator);
	case PATTERN_GRANITE: return granite(p, generator);
	case PATTERN_MARBLE: return marble(t, p, generator);
	case PATTERN_RIPPLES: return ripples(s, t, p);
	case PATTERN_WAVES: return waves(s, t, p);
	case PATTERN_WOOD: return wood(t, p);
	default: return wrinkles(p, generator);
	}
}
