/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What alidade-trade concludes from runs that are made up here.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "accel/load.h"
#include "trade/trade.h"

#define SETTINGS 8

static int setup(void **state)
{
	struct trade *t = calloc(1, sizeof(*t));

	mem_book_init(&t->book, 0);
	arena_init(&t->arena, &t->book, "test");
	t->setting = arena_zalloc(&t->arena, SETTINGS * sizeof(*t->setting));
	t->clock = TRADE_PROCESS;
	t->error = TRADE_RMSE;
	t->max_error = t->max_time = (double)NAN;
	*state = t;
	return 0;
}

static int teardown(void **state)
{
	struct trade *t = *state;

	arena_release(&t->arena);
	free(t);
	return 0;
}

/* A setting whose runs take time - spread .. time + spread. */
static struct trade_setting *add(struct trade *t, double time, double spread, double error, uint32_t runs)
{
	struct trade_setting *s = &t->setting[t->settings++];

	s->run = arena_zalloc(&t->arena, TRADE_RUNS * sizeof(*s->run));
	snprintf(s->label, sizeof(s->label), "setting %u", t->settings);
	for (s->runs = 0; s->runs < runs; s->runs++) {
		double *value = s->run[s->runs].value;

		for (int v = 0; v < TRADE_VALUES; v++)
			value[v] = (double)NAN;
		value[TRADE_PROCESS] = time + spread * (2.0 * s->runs / (runs > 1 ? runs - 1 : 1) - 1);
		value[TRADE_RMSE] = error;
	}
	return s;
}

/* From the tables of the binomial distribution. */
static void test_intervals(void **state)
{
	const double v[] = { 8, 1, 7, 2, (double)NAN, 6, 3, 5, 4 };
	const double nine[] = { 1, 2, 3, 4, 5, 6, 7, 8, 9 };
	struct trade_range r;

	(void)state;
	trade_range_of(v, 0, &r);
	assert_true(isnan(r.median) && r.count == 0);
	trade_range_of(v, 1, &r);
	assert_true(r.median == 8 && r.low == 8 && r.high == 8 && r.confidence == 0);
	trade_range_of(v, 3, &r);
	assert_true(r.median == 7 && r.low == 1 && r.high == 8 && r.confidence == 0.75);
	trade_range_of(v, 6, &r);
	assert_true(r.count == 5 && r.median == 6 && r.low == 1 && r.high == 8 && r.confidence == 0.9375);
	trade_range_of(v, 9, &r);
	assert_true(r.count == 8 && r.median == 4.5 && r.low == 2 && r.high == 7);
	assert_true(fabs(r.confidence - (1 - 2 * 9.0 / 256)) < 1e-15);
	trade_range_of(nine, 9, &r);
	assert_true(r.median == 5 && r.low == 2 && r.high == 8);
	assert_true(fabs(r.confidence - (1 - 2 * 10.0 / 512)) < 1e-15);
}

static void test_front(void **state)
{
	struct trade *t = *state;
	struct trade_setting *base = add(t, 2, 0, 0.1, 3), *slow = add(t, 3, 0, 0.1, 3);
	struct trade_setting *alike = add(t, 3, 0, 0.0995, 3), *fine = add(t, 4, 0, 0.01, 3);
	struct trade_setting *fast = add(t, 1, 0, 0.3, 3), *none = add(t, 1, 0, 0.1, 0);
	struct trade_setting *exact = add(t, 9, 0, 0, 3), *later = add(t, 10, 0, 0, 3);

	trade_summarise(t);
	assert_true(base->front && fine->front && fast->front && exact->front);
	assert_false(slow->front || alike->front || none->front || later->front);
	assert_true(trade_far_behind(t, slow, 1.4) && !trade_far_behind(t, slow, 1.6));
	assert_false(trade_far_behind(t, alike, 1.4)); /* it is more accurate, if by little */
	assert_false(trade_measured(t, none));
}

static const struct trade_verdict *ask(struct trade *t, double max_error, double max_time)
{
	t->max_error = max_error;
	t->max_time = max_time;
	trade_summarise(t);
	assert_int_equal(trade_decide(t), STATUS_OK);
	return &t->verdict[0];
}

static void test_fastest(void **state)
{
	struct trade *t = *state;
	struct trade_setting *base = add(t, 2, 0.1, 0.05, 5), *other = add(t, 1, 0.1, 0.05, 5);
	struct trade_setting *near = add(t, 1.1, 0.1, 0.05, 5), *finer = add(t, 1.1, 0.1, 0.01, 5);
	const struct trade_verdict *v;

	t->settings = 2;
	v = ask(t, 0.05, (double)NAN);
	assert_true(v->outcome == TRADE_CLEAR && v->pick == other && v->ties == 0 && !v->ask.own);
	v = ask(t, 0.04, (double)NAN);
	assert_true(v->outcome == TRADE_NOTHING && v->pick == other); /* as accurate as any, and faster */
	t->settings = 3; /* intervals overlap */
	v = ask(t, 0.05, (double)NAN);
	assert_true(v->outcome == TRADE_TIED && v->ties == 1 && v->pick == other && v->tied[0] == near);
	t->settings = 4; /* of those that may be as fast, the most accurate */
	v = ask(t, 0.05, (double)NAN);
	assert_true(v->outcome == TRADE_TIED && v->ties == 2 && v->pick == finer);
	v = ask(t, 0.01, (double)NAN);
	assert_true(v->outcome == TRADE_CLEAR && v->pick == finer);
	finer->runs = 2;
	v = ask(t, 0.01, (double)NAN);
	assert_int_equal(v->outcome, TRADE_UNSURE);
	/* Nobody asked: what is as good as the default, and better. */
	finer->runs = 5;
	v = ask(t, (double)NAN, (double)NAN);
	assert_int_equal(t->verdicts, 2);
	assert_true(v[0].ask.own && v[0].ask.kind == TRADE_FASTEST && v[0].ask.bound == 0.05);
	assert_true(v[1].ask.kind == TRADE_MOST_ACCURATE && v[1].pick == finer);
	assert_true(v[1].ask.bound == base->range[TRADE_PROCESS].high);
}

static void test_most_accurate(void **state)
{
	struct trade *t = *state;
	struct trade_setting *base = add(t, 1, 0.1, 0.1, 5), *finer = add(t, 2, 0.1, 0.01, 5);
	struct trade_setting *finest = add(t, 5, 0.1, 0.001, 5), *faster = add(t, 1.5, 0.1, 0.01, 5);
	const struct trade_verdict *v;

	v = ask(t, (double)NAN, 3);
	assert_true(v->outcome == TRADE_CLEAR && v->pick == faster);
	v = ask(t, (double)NAN, 1.55); /* the interval's upper end counts */
	assert_true(v->pick == base);
	v = ask(t, (double)NAN, 0.5);
	assert_true(v->outcome == TRADE_NOTHING && v->pick == base);
	v = ask(t, (double)NAN, 5.2);
	assert_true(v->pick == finest);
	faster->runs = 0;
	v = ask(t, (double)NAN, 3);
	assert_true(v->pick == finer);
	/* What differs by less than a hundredth is as accurate, and the simpler of two that are as fast is better. */
	t->settings = 2;
	for (uint32_t i = 0; i < finer->runs; i++) {
		finer->run[i].value[TRADE_PROCESS] = base->run[i].value[TRADE_PROCESS];
		finer->run[i].value[TRADE_RMSE] = 0.0995;
	}
	v = ask(t, (double)NAN, 3);
	assert_true(v->outcome == TRADE_TIED && v->pick == base);
	for (uint32_t i = 0; i < finer->runs; i++)
		finer->run[i].value[TRADE_RMSE] = 0.0985;
	v = ask(t, (double)NAN, 3);
	assert_true(v->outcome == TRADE_CLEAR && v->pick == finer);
	t->settings = 4;
	/* An error below 0, as biases have, is as bad as one above. */
	for (uint32_t i = 0; i < finest->runs; i++)
		finest->run[i].value[TRADE_RMSE] = -0.5;
	v = ask(t, (double)NAN, 9);
	assert_true(v->pick == finer && !finest->front);
}

/* What goes together and what is inexact is what accelerators say of themselves. */
static bool goes(struct trade *t, const char *accel, const char *precision)
{
	static struct trade_served known;
	char one[64], two[64];
	char *option[] = { one, two };
	bool first;

	snprintf(one, sizeof(one), "--accel=%s", accel);
	snprintf(two, sizeof(two), "--precision=%s", precision);
	first = trade_goes(t, option, 2, &known);
	assert_int_equal(trade_goes(t, option, 2, &known), first);
	return first;
}

static const char *inexact(struct trade *t, const char *options)
{
	char one[64];
	char *option[] = { one };

	snprintf(one, sizeof(one), "--%s", options);
	return trade_inexact(t, option, 1);
}

static bool embree_there(void)
{
	struct accel_choice c;
	struct diag silent = { 0 };
	bool there = !accel_load(&c, "embree", &silent);

	if (there)
		accel_unload(&c);
	return there;
}

static void test_together(void **state)
{
	struct trade *t = *state;
	struct trade_setting *base = add(t, 1, 0.1, 0.1, 5), *fast = add(t, 0.99, 0.1, 0.1, 5);
	const struct trade_verdict *v;

	t->scene = "scene.pov";
	assert_true(goes(t, "octree", "fast") && goes(t, "octree:leaf=4", "exact") && goes(t, "octree", "default"));
	assert_true(goes(t, "nosuch", "fast")); /* nobody knows */
	assert_string_equal(inexact(t, "accel=octree:leaf=4"), "");
	assert_string_equal(inexact(t, "aa=4"), "");
	assert_string_equal(inexact(t, "precision=fast"), "--precision=fast");
	/* Of two that are as fast and as accurate the one whose hits are right. */
	v = ask(t, 0.1, (double)NAN);
	assert_true(v->outcome == TRADE_TIED && v->pick == fast && !trade_caution_text(t, fast));
	fast->inexact = "something";
	v = ask(t, 0.1, (double)NAN);
	assert_true(v->outcome == TRADE_TIED && v->pick == base && !trade_caution_text(t, base));
	assert_non_null(strstr(trade_caution_text(t, fast), "inexact: something. How many"));
	fast->checked = 1e6;
	fast->different = 7;
	trade_summarise(t);
	assert_non_null(strstr(trade_caution_text(t, fast), "inexact: something. Wrong here: 7 /M"));
	if (!embree_there())
		return;
	assert_false(goes(t, "embree", "fast") || goes(t, "embree:native=1", "exact"));
	assert_true(goes(t, "embree", "exact") && goes(t, "embree:native=1", "default"));
	assert_string_equal(inexact(t, "accel=embree:native=0,quality=low"), "");
	assert_non_null(strstr(inexact(t, "accel=embree:quality=low,native=1"), "native of embree ("));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_intervals, setup, teardown),
		cmocka_unit_test_setup_teardown(test_front, setup, teardown),
		cmocka_unit_test_setup_teardown(test_fastest, setup, teardown),
		cmocka_unit_test_setup_teardown(test_most_accurate, setup, teardown),
		cmocka_unit_test_setup_teardown(test_together, setup, teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
