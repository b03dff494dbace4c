/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "render/streams.h"

#include <math.h>

double streams_error(const struct streams *p, int stream, const struct estimate_view *view, uint32_t values)
{
	const struct moments *m = &p->run[stream];
	double most = 0;

	for (uint32_t k = 0; k < values; k++) {
		double v = moments_variance(m, (int)k), e = sqrt(fmax(0, v) / 2);

		if (v < 0)
			return HUGE_VAL;
		if (k < 3)
			e = estimate_seen(view, (double)p->origin[k] + moments_mean(m, (int)k), e);
		most = fmax(most, e);
	}
	return most * most;
}

void streams_keep(struct streams *p, int stream)
{
	const struct moments *m = &p->run[stream];

	for (int k = 0; k < ESTIMATE_VALUES; k++) {
		p->mean[k] = (float)moments_mean(m, k);
		p->variance[k] = (float)moments_variance(m, k);
	}
	p->sets = (float)moments_sets(m);
	p->kept_n = m->n;
	p->first = (uint8_t)stream;
	p->kept = true;
}

static struct stream_mean of_moments(const struct moments *m)
{
	struct stream_mean out = { .sets = moments_sets(m), .n = m->n };

	for (int k = 0; k < ESTIMATE_VALUES; k++) {
		out.mean[k] = moments_mean(m, k);
		out.variance[k] = moments_variance(m, k);
	}
	return out;
}

static struct stream_mean of_stream(const struct streams *p, int stream)
{
	struct stream_mean out = { .sets = (double)p->sets, .n = p->kept_n };

	if (!p->kept || p->first != stream)
		return of_moments(&p->run[stream]);
	for (int k = 0; k < ESTIMATE_VALUES; k++) {
		out.mean[k] = (double)p->mean[k];
		out.variance[k] = (double)p->variance[k];
	}
	return out;
}

/* Where nothing was decided all sets are alike. */
struct stream_mean streams_mean(const struct streams *p, bool decided)
{
	struct stream_mean a = of_stream(p, STREAM_A), c = of_stream(p, STREAM_B);
	struct moments all = p->run[STREAM_A];

	moments_merge(&all, &p->run[STREAM_B]);
	if (!decided || !a.n || !c.n)
		return of_moments(&all);
	if (a.variance[0] < 0 || c.variance[0] < 0) {
		struct stream_mean both = of_moments(&all);

		for (int k = 0; k < ESTIMATE_VALUES; k++)
			both.mean[k] = 0.5 * (a.mean[k] + c.mean[k]);
		return both;
	}
	for (int k = 0; k < ESTIMATE_VALUES; k++) {
		a.mean[k] = 0.5 * (a.mean[k] + c.mean[k]);
		a.variance[k] = 0.25 * (a.variance[k] + c.variance[k]);
	}
	a.sets += c.sets - 1; /* so that sets - 1 is what both have of freedom */
	a.n += c.n;
	return a;
}

/*
 * What makes 68 and 95 of 100 values be within one and 1.96 errors: the root of a variance from n values is too small
 * by 1 / (4 n - 4), and Student's distribution wider by twice that; the rest was measured (tests/budget), and is
 * for pixels that are seldom touched by what is bright.
 */
double streams_student(double sets)
{
	return 1 + 1 / (sets - 1);
}
