/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "render/estimate.h"

#include <math.h>

#include "film/tone.h"
#include "image/image.h"

void moments_add(struct moments *m, uint32_t n, const double mean[ESTIMATE_VALUES])
{
	double size = n;

	m->n += n;
	m->q0 += (float)(size * size);
	for (int i = 0; i < ESTIMATE_VALUES; i++) {
		m->s[i] += (float)(size * mean[i]);
		m->q1[i] += (float)(size * size * mean[i]);
		m->q2[i] += (float)(size * size * mean[i] * mean[i]);
	}
}

void moments_merge(struct moments *m, const struct moments *with)
{
	m->n += with->n;
	m->q0 += with->q0;
	for (int i = 0; i < ESTIMATE_VALUES; i++) {
		m->s[i] += with->s[i];
		m->q1[i] += with->q1[i];
		m->q2[i] += with->q2[i];
	}
}

double moments_mean(const struct moments *m, int i)
{
	return m->n ? (double)m->s[i] / m->n : 0;
}

double moments_sets(const struct moments *m)
{
	return m->n ? (double)m->n * m->n / (double)m->q0 : 0;
}

/* With weights w (a set's share of the samples) and v the variance of a set's mean, the expectation of
 * sum w^2 (x - mean)^2 is sum w^2 v (1 - 2 w + sum w^2); it is (1 - sum w^2) times the mean's variance if v goes
 * with 1 / w. */
double moments_variance(const struct moments *m, int i)
{
	double sets = moments_sets(m), mean = moments_mean(m, i), n = m->n, v;

	if (sets < 1.01)
		return -1;
	v = ((double)m->q2[i] - 2 * mean * (double)m->q1[i] + mean * mean * (double)m->q0) / (n * n);
	if (!isfinite(v))
		return HUGE_VAL;
	return fmax(0, v) / (1 - 1 / sets);
}

/* The curve goes on beyond white as it came. */
static double seen(const struct estimate_view *view, double value)
{
	double x = tone_linear(value, view->gamma);

	if (x > 1)
		return view->clips ? 1 : 1.055 * pow(x, 1 / 2.4) - 0.055;
	return srgb_encode(x);
}

double estimate_seen(const struct estimate_view *view, double mean, double error)
{
	if (!(error > 0))
		return 0;
	if (!isfinite(error))
		return HUGE_VAL;
	return 0.5 * (seen(view, mean + error) - seen(view, mean - error));
}
