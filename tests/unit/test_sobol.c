/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The low-discrepancy sequence: evenness of its first points, and that keys make it another.
 */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <string.h>

#include <cmocka.h>

#include "base/sobol.h"

/* Of 2^k points, every interval of length 2^-k has one, in each dimension. */
static void test_even(void **unused)
{
	(void)unused;
	for (uint64_t key = 1; key < 20; key++) {
		struct sobol s = sobol_make(key);

		for (uint32_t dim = 0; dim < SOBOL_DIMS; dim++) {
			uint8_t seen[256] = { 0 };

			for (uint32_t i = 0; i < 256; i++) {
				double x = sobol_at(&s, i, dim);

				assert_true(x >= 0 && x < 1);
				seen[(uint32_t)(x * 256)]++;
			}
			for (uint32_t i = 0; i < 256; i++)
				assert_int_equal(seen[i], 1);
		}
	}
}

/* In the first two dimensions every elementary rectangle of 256 has one too: a (0, 2)-sequence. */
static void test_net(void **unused)
{
	(void)unused;
	for (uint32_t bits = 0; bits <= 8; bits++) {
		struct sobol s = sobol_make(7 + bits);
		uint8_t seen[256] = { 0 };

		for (uint32_t i = 0; i < 256; i++) {
			uint32_t x = (uint32_t)(sobol_at(&s, i, 0) * (1u << bits));
			uint32_t y = (uint32_t)(sobol_at(&s, i, 1) * (1u << (8 - bits)));

			seen[x << (8 - bits) | y]++;
		}
		for (uint32_t i = 0; i < 256; i++)
			assert_int_equal(seen[i], 1);
	}
}

/* The mean of x y over many keys and points is a quarter: no bias, no dependence. */
static void test_unbiased(void **unused)
{
	double sum = 0;

	(void)unused;
	for (uint64_t key = 0; key < 4000; key++) {
		struct sobol s = sobol_make(key);

		for (uint32_t i = 0; i < 3; i++)
			sum += sobol_at(&s, i, 2) * sobol_at(&s, i, 3);
	}
	sum /= 12000;
	assert_true(sum > 0.245 && sum < 0.255);
}

static void test_keys(void **unused)
{
	struct sobol a = sobol_make(1), b = sobol_make(2), again = sobol_make(1);

	(void)unused;
	assert_true(sobol_at(&a, 5, 1) != sobol_at(&b, 5, 1));
	assert_true(sobol_at(&a, 5, 1) == sobol_at(&again, 5, 1));
}

int main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(test_even), cmocka_unit_test(test_net),
					    cmocka_unit_test(test_unbiased),
					    cmocka_unit_test(test_keys) };

	return cmocka_run_group_tests_name("sobol", tests, NULL, NULL);
}
