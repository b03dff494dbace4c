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

static enum status run_again(struct trade *t, struct trade_verdict *v)
{
	double time[TRADE_RUNS], error[TRADE_RUNS];
	uint32_t n = 0;
	enum status st = STATUS_OK;

	while (n < t->repeat && !st) {
		struct trade_run r = { .seed = t->seed ? t->seed : SEED_FIRST + n };
		struct trade_child c = { .seed = r.seed };

		st = interrupt_asked() ? STATUS_SIGINT : trade_run_once(t, v->pick, &c, &r);
		if (st || c.message[0])
			break;
		time[n] = r.value[t->clock];
		error[n++] = fabs(r.value[t->error]);
	}
	trade_range_of(time, n, &v->time_again);
	trade_range_of(error, n, &v->error_again);
	return st;
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
		v->time_holds = agree(&v->time_again, &v->pick->range[t->clock], 1);
		v->error_holds = agree(&v->error_again, &v->pick->range[t->error], TRADE_GAIN);
		v->bound_holds = (v->ask.kind == TRADE_FASTEST ? v->error_again.median : v->time_again.median) <=
				 v->ask.bound;
	}
	progress_end(&t->progress, clock_seconds());
	return st;
}
