/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Is it true? Recommended settings were chosen among many for having come out best, so part of what they
 * show is luck; fresh runs have none of that.
 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/interrupt.h"
#include "trade.h"

#define SEED_FIRST 2000001 /* neither of runs nor of references */

/* Intervals that overlap are what two samples of the same give, but once in a hundred with five runs each;
 * the new median would be outside of the old interval once in six. slack: what is the same all the same. */
static bool agree(const struct trade_range *again, const struct trade_range *first, double slack)
{
	double low = fmin(fabs(first->low), fabs(first->high)), high = fmax(fabs(first->low), fabs(first->high));

	return again->high >= low * slack && again->low * slack <= high;
}

/* Machines are faster or slower by some hundredths from one hour to the next, for all settings alike. That is in no
 * interval of runs that were made within minutes, but another setting, which takes turns with the pick, shows how much
 * it may be. Not all of a time drifts alike, so anything from none to all of it is allowed for. */
static void compare_times(const struct trade *t, struct trade_verdict *v)
{
	struct trade_range r = v->time_again;

	r.low = fmin(r.low, r.low / v->drift);
	r.high = fmax(r.high, r.high / v->drift);
	v->time_holds = agree(&r, &v->pick->range[t->clock], 1);
}

/* The other one: the default; and for the default, what takes most nearly as long. NULL: there is none. */
static const struct trade_setting *pacer_of(const struct trade *t, const struct trade_setting *pick)
{
	const struct trade_setting *best = NULL;
	double own = pick->range[t->clock].median, least = HUGE_VAL;

	if (pick != t->setting)
		return t->setting;
	for (uint32_t i = 1; i < t->settings; i++) {
		const struct trade_setting *s = &t->setting[i];
		double off = fabs(s->range[t->clock].median - own);

		if (!s->failure && s->range[t->clock].count && off < least) {
			best = s;
			least = off;
		}
	}
	return best;
}

static enum status run_again(struct trade *t, struct trade_verdict *v)
{
	double time[TRADE_RUNS], error[TRADE_RUNS], base[TRADE_RUNS];
	struct trade_range base_again;
	uint32_t n = 0;
	enum status st = STATUS_OK;

	v->pacer = pacer_of(t, v->pick);
	while (n < t->repeat && !st) {
		struct trade_run r = { .seed = t->seed ? t->seed : SEED_FIRST + n }, other = r;
		struct trade_child c = { .seed = r.seed }, d = c;

		st = interrupt_asked() ? STATUS_SIGINT : trade_run_once(t, v->pick, &c, &r);
		if (!st && v->pacer)
			st = trade_run_once(t, v->pacer, &d, &other);
		if (st || c.message[0] || d.message[0])
			break;
		time[n] = r.value[t->clock];
		base[n] = other.value[t->clock];
		error[n++] = fabs(r.value[t->error]);
	}
	trade_range_of(time, n, &v->time_again);
	trade_range_of(error, n, &v->error_again);
	trade_range_of(base, n, &base_again);
	v->drift = v->pacer ? base_again.median / v->pacer->range[t->clock].median : 1;
	if (!(v->drift > 0))
		v->drift = 1;
	return st;
}

/* A bound in seconds that was asked for is one by the clock; one that the default set moves with it. */
static bool keeps_bound(const struct trade_verdict *v)
{
	if (v->ask.kind == TRADE_FASTEST)
		return v->error_again.median <= v->ask.bound;
	return v->time_again.median <= v->ask.bound * (v->ask.own ? fmax(v->drift, 1) : 1);
}

enum status trade_confirm(struct trade *t)
{
	enum status st = STATUS_OK;

	progress_begin(&t->progress, "confirming", clock_seconds());
	for (uint32_t i = 0; i < t->verdicts && !st; i++) {
		struct trade_verdict *v = &t->verdict[i];
		uint32_t k = 0;

		if (!v->pick || v->outcome == TRADE_NOTHING)
			continue;
		while (k < i && t->verdict[k].pick != v->pick)
			k++;
		if (k == i)
			st = run_again(t, v);
		v->time_again = t->verdict[k].time_again;
		v->error_again = t->verdict[k].error_again;
		v->pacer = t->verdict[k].pacer;
		v->drift = t->verdict[k].drift;
		compare_times(t, v);
		v->error_holds = agree(&v->error_again, &v->pick->range[t->error], TRADE_GAIN);
		v->bound_holds = keeps_bound(v);
	}
	progress_end(&t->progress, clock_seconds());
	return st;
}
