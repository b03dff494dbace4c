/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The dipole of light below surfaces: its sum over a plane is the reflectance that its albedo was made of, for
 * which Jensen and Buhler's equation and the profile have to agree; and the law of Fresnel at its ends.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "shade/pov/dipole.h"

#define PI 3.14159265358979323846

/* The integral over a plane, in logarithms of the radius. */
static double total(const struct dipole *d)
{
	double sum = 0, step = 1e-3;

	for (double x = log(d->real) - 12; x < log(d->mirrored) + 12; x += step) {
		double r = exp(x);

		sum += 2 * PI * r * r * dipole_profile(d, r * r) * step;
	}
	return sum;
}

static void test_total(void **unused)
{
	static const double ior[] = { 1, 1.3, 2, 0.9 };

	(void)unused;
	for (size_t i = 0; i < sizeof(ior) / sizeof(ior[0]); i++) {
		for (int k = 1; k < 10; k += 2) {
			struct dipole d = dipole_make(3, dipole_albedo(k / 10.0, ior[i]), ior[i]);

			assert_true(d.albedo > 0 && d.albedo < 1);
			assert_true(fabs(total(&d) - k / 10.0) < 1e-4);
			assert_true(fabs(d.scatter - 1.0 / 3) < 1e-12);
			assert_true(fabs(d.scatter + d.absorb - d.extinct) < 1e-12);
		}
	}
}

static void test_albedo(void **unused)
{
	double below = 0;

	(void)unused;
	assert_true(dipole_albedo(0, 1.3) == 0 && dipole_albedo(-1, 1.3) == 0);
	assert_true(dipole_albedo(1, 1.3) == 1 && dipole_albedo(2, 1.3) == 1);
	for (int i = 1; i < 1000; i++) {
		double a = dipole_albedo(i / 1000.0, 1.5);

		assert_true(a > below && a < 1);
		below = a;
	}
	/* a table of hundredths, with straight lines between: 0.555 is the mean of its neighbours */
	assert_true(fabs(dipole_albedo(0.555, 1.3) - (dipole_albedo(0.55, 1.3) + dipole_albedo(0.56, 1.3)) / 2) <
		    1e-9);
	/* black is nothing at all, not an endless coefficient */
	assert_true(dipole_profile(&(struct dipole){ .albedo = 0 }, 1) == 0);
}

static void test_fresnel(void **unused)
{
	(void)unused;
	assert_true(fabs(dipole_fresnel(1, 1.5) - 0.96) < 1e-12);
	assert_true(fabs(dipole_fresnel(0.5, 1) - 1) < 1e-12);
	assert_true(dipole_fresnel(0, 1.5) < 1e-12);
	assert_true(dipole_fresnel(0.1, 0.8) == 1); /* as POV-Ray has it, though nothing passes */
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_total),
		cmocka_unit_test(test_albedo),
		cmocka_unit_test(test_fresnel),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
