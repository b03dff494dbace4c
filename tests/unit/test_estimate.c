/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Means of sets and what they say of their error. Whole pictures over many seeds are looked at in tests/budget.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/rng.h"
#include "image/image.h"
#include "render/estimate.h"

#define CLOSE(a, b, e) assert_true(fabs((a) - (b)) < (e))

/* n independent numbers of mean 1/2 and variance 1/12 a set. */
static void add_set(struct moments *m, uint64_t key, uint32_t n)
{
	double mean[ESTIMATE_VALUES] = { 0 };

	for (uint32_t i = 0; i < n; i++)
		mean[0] += rng_unit(rng_child(key, i)) / n;
	mean[1] = 3;
	moments_add(m, n, mean);
}

/* Over many trials the variance that is told is that of the means, with sets of one size and of several. */
static void variance_has_no_bias(void **state)
{
	static const uint32_t size[2][8] = { { 4, 4, 4, 4, 4, 4, 4, 4 }, { 2, 2, 2, 2, 4, 4, 8, 16 } };

	(void)state;
	for (int way = 0; way < 2; way++) {
		double told = 0, square = 0, trials = 20000, n = way ? 40 : 32;

		for (uint64_t t = 0; t < (uint64_t)trials; t++) {
			struct moments m;

			memset(&m, 0, sizeof(m));
			for (int i = 0; i < 8; i++)
				add_set(&m, rng_mix(16 * t + (uint64_t)i + ((uint64_t)way << 40)), size[way][i]);
			told += moments_variance(&m, 0) / trials;
			square += (moments_mean(&m, 0) - 0.5) * (moments_mean(&m, 0) - 0.5) / trials;
			CLOSE(moments_mean(&m, 1), 3, 1e-6);
			assert_true(moments_variance(&m, 1) < 1e-6);
		}
		CLOSE(told * 12 * n, 1, 0.03);
		CLOSE(square * 12 * n, 1, 0.05);
	}
}

static void one_set_tells_nothing(void **state)
{
	struct moments m;

	(void)state;
	memset(&m, 0, sizeof(m));
	assert_true(moments_variance(&m, 0) < 0);
	add_set(&m, 1, 16);
	assert_true(moments_variance(&m, 0) < 0);
	CLOSE(moments_sets(&m), 1, 1e-6);
	add_set(&m, 2, 16);
	assert_true(moments_variance(&m, 0) > 0);
	CLOSE(moments_sets(&m), 2, 1e-6);
}

/* Two halves together are the whole. */
static void merging_is_adding(void **state)
{
	struct moments all, a, b;

	(void)state;
	memset(&all, 0, sizeof(all));
	a = b = all;
	for (uint64_t i = 0; i < 10; i++) {
		add_set(&all, i, 3);
		add_set(i & 1 ? &a : &b, i, 3);
	}
	moments_merge(&a, &b);
	assert_int_equal(a.n, all.n);
	CLOSE(moments_mean(&a, 0), moments_mean(&all, 0), 1e-6);
	CLOSE(moments_variance(&a, 0) / moments_variance(&all, 0), 1, 1e-4);
}

static void light_without_bounds_is_not_sure(void **state)
{
	const double huge[ESTIMATE_VALUES] = { 1e30, 1e30, 1e30, 0 }, none[ESTIMATE_VALUES] = { 0 };
	struct moments m;

	(void)state;
	memset(&m, 0, sizeof(m));
	moments_add(&m, 2, none);
	moments_add(&m, 2, huge);
	assert_true(moments_variance(&m, 0) > 1e30);
}

static void errors_are_seen_along_the_curve(void **state)
{
	const struct estimate_view clips = { 1, true }, open = { 1, false }, gamma = { 2.2, true };

	(void)state;
	assert_true(estimate_seen(&clips, 0.5, 0) == 0);
	CLOSE(estimate_seen(&clips, 0.2, 0.01), 0.5 * (srgb_encode(0.21) - srgb_encode(0.19)), 1e-12);
	assert_true(estimate_seen(&clips, 0.02, 0.01) > 2 * estimate_seen(&clips, 0.2, 0.01));
	assert_true(estimate_seen(&clips, 4, 1) == 0);
	assert_true(estimate_seen(&open, 4, 1) > 0.1);
	assert_true(estimate_seen(&clips, 1.1, 0.3) > 0);
	assert_true(isinf(estimate_seen(&clips, 1, HUGE_VAL)));
	/* What is stored along a curve of its own is seen along nearly that. */
	CLOSE(estimate_seen(&gamma, 0.5, 0.01), 0.01, 0.001);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(variance_has_no_bias),	      cmocka_unit_test(one_set_tells_nothing),
		cmocka_unit_test(merging_is_adding),	      cmocka_unit_test(light_without_bounds_is_not_sure),
		cmocka_unit_test(errors_are_seen_along_the_curve),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
