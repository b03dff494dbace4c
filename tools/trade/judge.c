/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * From runs to figures, the front and verdicts.
 *
 * The interval of a median is one of order statistics, which asks nothing of how times are distributed: the
 * true median lies between the (k+1)-th smallest and largest of n runs with probability
 * 1 - 2 P(B <= k), B the number of heads of n coins (Conover, Practical Nonparametric Statistics, 3.2).
 */
#include <config.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "trade.h"

#define SURE 0.9 /* of an interval; with fewer than 5 runs it is less, and all of them are the interval */
#define RUNS_LEAST 3 /* fewer say nothing of how times vary */

static int compare_doubles(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;

	return (x > y) - (x < y);
}

void trade_range_of(const double *value, uint32_t count, struct trade_range *r)
{
	double v[TRADE_RUNS], below, term;
	uint32_t n = 0, k = 0;

	for (uint32_t i = 0; i < count; i++) {
		if (!isnan(value[i]))
			v[n++] = value[i];
	}
	*r = (struct trade_range){ (double)NAN, (double)NAN, (double)NAN, 0, n };
	if (!n)
		return;
	qsort(v, n, sizeof(*v), compare_doubles);
	below = term = ldexp(1, -(int)n); /* P(B <= k), P(B = k) */
	r->confidence = 1 - 2 * below;
	for (;;) {
		term *= (double)(n - k) / (double)(k + 1);
		if (1 - 2 * (below + term) < SURE)
			break;
		below += term;
		r->confidence = 1 - 2 * below;
		k++;
	}
	r->median = n % 2 ? v[n / 2] : (v[n / 2 - 1] + v[n / 2]) / 2;
	r->low = v[k];
	r->high = v[n - 1 - k];
}

bool trade_measured(const struct trade *t, const struct trade_setting *s)
{
	return s->runs && !isnan(s->range[t->clock].median) && !isnan(s->range[t->error].median);
}

static double time_of(const struct trade *t, const struct trade_setting *s)
{
	return s->range[t->clock].median;
}

/* A bias is as bad below 0 as above. */
static struct trade_range error_of(const struct trade *t, const struct trade_setting *s)
{
	struct trade_range r = s->range[t->error];

	if (r.median < 0)
		r = (struct trade_range){ -r.median, -r.high, -r.low, r.confidence, r.count };
	return r;
}

static void summarise_one(struct trade *t, struct trade_setting *s)
{
	double value[TRADE_RUNS];

	for (int v = 0; v < TRADE_VALUES; v++) {
		for (uint32_t i = 0; i < s->runs; i++)
			value[i] = s->run[i].value[v];
		trade_range_of(value, s->runs, &s->range[v]);
	}
	if (s->checked > 0) {
		double wrong = 1e6 * s->different / s->checked;

		s->range[TRADE_WRONG] = (struct trade_range){ wrong, wrong, wrong, 0, 1 };
	}
	for (uint32_t i = 1; i < s->runs; i++)
		t->random = t->random || s->run[i].picture != s->run[0].picture;
}

/* From the fastest on: on the front is what is more accurate than all that is faster, by a hundredth at
 * least, since errors that come from random numbers differ by less from nothing at all. */
static void find_front(struct trade *t)
{
	const struct trade_setting *order[TRADE_SETTINGS];
	uint32_t n = trade_order(t, order);
	double least = HUGE_VAL;

	for (uint32_t i = 0; i < t->settings; i++)
		t->setting[i].front = false;
	for (uint32_t i = 0; i < n; i++) {
		double error = error_of(t, order[i]).median;

		if (!(error < TRADE_GAIN * least))
			continue;
		t->setting[order[i] - t->setting].front = true;
		least = error;
	}
}

void trade_summarise(struct trade *t)
{
	for (uint32_t i = 0; i < t->settings; i++)
		summarise_one(t, &t->setting[i]);
	find_front(t);
}

bool trade_far_behind(const struct trade *t, const struct trade_setting *s, double times)
{
	for (uint32_t i = 0; i < t->settings && trade_measured(t, s); i++) {
		const struct trade_setting *o = &t->setting[i];

		if (o->front && times * time_of(t, o) < time_of(t, s) &&
		    error_of(t, o).median <= error_of(t, s).median)
			return true;
	}
	return false;
}

/* With certainty, as far as its runs tell: the upper end of the interval counts. */
static bool within(const struct trade *t, const struct trade_setting *s, const struct trade_ask *a)
{
	if (!trade_measured(t, s))
		return false;
	return a->kind == TRADE_FASTEST ? error_of(t, s).high <= a->bound : s->range[t->clock].high <= a->bound;
}

static uint32_t options_of(const struct trade *t, const struct trade_setting *s)
{
	const char *option[TRADE_FACTORS * TRADE_LEVEL_OPTIONS + 1];

	return trade_options(t, s, option);
}

/* Of settings that take the same time: the more accurate, then the one whose hits are exact, then the simpler, then
 * the faster. */
static bool better(const struct trade *t, const struct trade_setting *a, const struct trade_setting *b)
{
	struct trade_range x = error_of(t, a), y = error_of(t, b);

	if (x.high < TRADE_GAIN * y.low || y.high < TRADE_GAIN * x.low)
		return x.median < y.median;
	if (!a->inexact != !b->inexact)
		return !a->inexact;
	if (options_of(t, a) != options_of(t, b))
		return options_of(t, a) < options_of(t, b);
	return time_of(t, a) < time_of(t, b);
}

/* From the n settings of list: the fastest, and those that may be as fast. */
static void choose_fastest(const struct trade *t, const struct trade_setting **list, uint32_t n,
			   struct trade_verdict *v)
{
	const struct trade_setting *fastest = list[0];

	for (uint32_t i = 1; i < n; i++) {
		if (time_of(t, list[i]) < time_of(t, fastest))
			fastest = list[i];
	}
	v->pick = fastest;
	v->ties = 0;
	for (uint32_t i = 0; i < n; i++) {
		if (list[i]->range[t->clock].low > fastest->range[t->clock].high)
			continue;
		v->tied[v->ties++] = list[i];
		if (better(t, list[i], v->pick))
			v->pick = list[i];
	}
	for (uint32_t i = 0; i < v->ties; i++) {
		if (v->tied[i] == v->pick)
			v->tied[i--] = v->tied[--v->ties];
	}
	v->outcome = v->ties ? TRADE_TIED : TRADE_CLEAR;
	if (v->pick->runs < RUNS_LEAST)
		v->outcome = TRADE_UNSURE;
}

/* Those that may be as accurate as the most accurate. */
static uint32_t keep_accurate(const struct trade *t, const struct trade_setting **list, uint32_t n)
{
	struct trade_range best = error_of(t, list[0]);
	uint32_t kept = 0;

	for (uint32_t i = 1; i < n; i++) {
		if (error_of(t, list[i]).median < best.median)
			best = error_of(t, list[i]);
	}
	for (uint32_t i = 0; i < n; i++) {
		if (TRADE_GAIN * error_of(t, list[i]).low <= best.high)
			list[kept++] = list[i];
	}
	return kept;
}

/* What is nearest to a bound that nothing keeps: one of the ends of the front. */
static const struct trade_setting *nearest(const struct trade *t, enum trade_kind kind)
{
	const struct trade_setting *best = NULL;

	for (uint32_t i = 0; i < t->settings; i++) {
		const struct trade_setting *s = &t->setting[i];

		if (s->front && (!best || (time_of(t, s) < time_of(t, best)) == (kind == TRADE_MOST_ACCURATE)))
			best = s;
	}
	return best;
}

static enum status decide(struct trade *t, const struct trade_ask *ask)
{
	struct trade_verdict *v = &t->verdict[t->verdicts];
	size_t bytes = 2 * (size_t)(t->settings + 1) * sizeof(*v->tied);
	const struct trade_setting **list = arena_alloc(&t->arena, bytes);
	uint32_t n = 0;

	if (!list)
		return diag_no_memory(&t->diag, "a verdict", bytes);
	*v = (struct trade_verdict){ .ask = *ask, .outcome = TRADE_NOTHING, .tied = list + t->settings + 1 };
	for (uint32_t i = 0; i < t->settings; i++) {
		if (within(t, &t->setting[i], ask))
			list[n++] = &t->setting[i];
	}
	if (n && ask->kind == TRADE_MOST_ACCURATE)
		n = keep_accurate(t, list, n);
	if (n)
		choose_fastest(t, list, n, v);
	else
		v->pick = nearest(t, ask->kind);
	t->verdicts++;
	return STATUS_OK;
}

/* What was asked for; and what a user who asked for nothing would like to know: is there something faster
 * that is as accurate as the default, or something more accurate that is as fast? */
enum status trade_decide(struct trade *t)
{
	const struct trade_setting *base = &t->setting[0];
	struct trade_ask ask[TRADE_ASKS];
	enum status st = STATUS_OK;
	int n = 0;

	t->verdicts = 0;
	if (!isnan(t->max_error))
		ask[n++] = (struct trade_ask){ TRADE_FASTEST, t->max_error, false };
	if (!isnan(t->max_time))
		ask[n++] = (struct trade_ask){ TRADE_MOST_ACCURATE, t->max_time, false };
	if (trade_measured(t, base)) {
		ask[n++] = (struct trade_ask){ TRADE_FASTEST, error_of(t, base).high, true };
		ask[n++] = (struct trade_ask){ TRADE_MOST_ACCURATE, base->range[t->clock].high, true };
	}
	for (int i = 0; i < n && !st; i++)
		st = decide(t, &ask[i]);
	return st;
}
