/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Noise and the patterns made of it, against what POV-Ray 3.7 prints for f_noise_generator(), vturbulence()
 * and functions of patterns.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/rng.h"
#include "pattern/random.h"

#define SIX_OCTAVES { .octaves = 6, .lambda = 2, .omega = 0.5 }
enum { POINTS = 5 };

static const vec points[POINTS] = { { 0.3, 0.2, 0.7 },
				    { -3.75, 11.5, 0.125 },
				    { 4, -7, 2 },
				    { -1234.5, 0.0625, 987.25 },
				    { 0.5, 0.5, -0.999 } };

static const double values[3][POINTS] = {
	{ 0.38871649622969551, 0.46829127503814699, 0.7367515,
		    0.17376670712757114, 0.50975725767163238 },
	{ 0.46102119009252435, 0.50000135861705697, 0.63150816225313,
		    0.35572678489307619, 0.52031371154208883 },
	{ 0.67476184732930067, 0.83028855162595439, 0.50039286138124028,
		    0.71211975112965198, 0.36524808148749471 },
};

static const double turbulences[3][POINTS] = {
	{ -0.095483243946774016, -0.22777320552701352, -0.076529038085937515,
		    -0.10647413376477065, 0.19231622418025401 },
	{ -0.47675163068221366, -0.13968426207236345, -0.37349778417968754,
		    -0.11137231966715698, 0.23110218366411792 },
	{ 0.23269048720544874, -0.74271400049178005, -0.19323555175781254,
		    -0.2995578380541597, 0.25005569013145579 },
};

static const struct {
	struct pattern pattern;
	double value[POINTS];
} patterns[] = {
	{ { .kind = PATTERN_AGATE, .turbulence = SIX_OCTAVES, .of.agate_turb = 1 },
	  { 0.10672822214106278, 0.9620131611834899, 0.44566097818909006,
		    0.31438720404645215, 0.99999517349129652 } },
	{ { .kind = PATTERN_BOZO },
	  { 0.46102119009252435, 0.50000135861705697, 0.63150816225313,
		    0.35572678489307619, 0.52031371154208883 } },
	{ { .kind = PATTERN_CELLS },
	  { 0.71181891532614827, 0.57605346222408116, 0.37502464954741299,
		    0.98190272971987724, 0.82424170547164977 } },
	{ { .kind = PATTERN_CRACKLE, .of.crackle = { { -1, 1, 0 }, 2, 0, false } },
	  { 0.1045105502284851, 0.23010693929041237, 0.030528260961491971,
		    0.029622946520275532, 0.059931903057868878 } },
	{ { .kind = PATTERN_CRACKLE, .of.crackle = { { -1, 1, 0 }, 2, 0, true } },
	  { 0.43251568694695441, 0.38440780131052621, 0.54463216917955914,
		    0.41583688328602969, 0.56975099290321873 } },
	{ { .kind = PATTERN_CRACKLE, .of.crackle = { { -1, 0.5, 0.5 }, 1, 0.25, false } },
	  { 0.058868599426932677, 0.62956925563048571, 0.17043575795833021,
		    0.34002138569485396, 0.31501331005711108 } },
	{ { .kind = PATTERN_CRACKLE, .of.crackle = { { 1, 0, 0 }, 3, 0, false } },
	  { 0.4982105863327464, 0.58869653691181645, 0.81434927194961382,
		    0.56981257655276474, 0.70770356117726119 } },
	{ { .kind = PATTERN_DENTS, .noise = 1 },
	  { 0.05873526255204535, 0.10269473981354901, 0.39991075702937928,
		    0.0052468628724305104, 0.13246167830034355 } },
	{ { .kind = PATTERN_GRANITE },
	  { 0.33905663176958467, 0.56645605827458889, 0.34606872946237116,
		    0.51672818389327635, 0.45063773690824205 } },
	{ { .kind = PATTERN_GRANITE, .noise = 1 },
	  { 0.32402860018895968, 0.55341190625000014, 0.364136121875,
		    0.49012476171875002, 0.50654603254603248 } },
	{ { .kind = PATTERN_GRANITE, .noise = 3 },
	  { 0.57513520952116137, 0.53182161117183635, 0.057089557987783403,
		    0.55965994534584085, 0.070405119261184951 } },
	{ { .kind = PATTERN_WRINKLES },
	  { 0.41615051029204508, 0.46104851937374092, 0.68128624635998714,
		    0.36383752587423135, 0.52368691507382881 } },
	{ { .kind = PATTERN_WRINKLES, .noise = 1 },
	  { 0.3837013565791349, 0.42857147394485479, 0.65336999423828113,
		    0.3293473864373207, 0.49250701695839694 } },
	{ { .kind = PATTERN_RIPPLES },
	  { 0.22656732669238921, 0.49559543196758049, 0.39679227231676933,
		    0.42983376591121436, 0.51981839558505538 } },
	{ { .kind = PATTERN_WAVES },
	  { 0.70387436090831068, 0.35271230237819068, 0.49213308176585085,
		    0.61890684458117284, 0.66649605366064923 } },
};

static void near(double a, double b)
{
	assert_float_equal(a, b, 1e-12);
}

static void values_are_povrays(void **state)
{
	(void)state;
	for (uint32_t i = 0; i < POINTS; i++) {
		vec turbulence = noise_vector_turbulence(points[i], 10, 3, 0.5);

		for (uint32_t generator = 1; generator <= 3; generator++)
			near(noise_value(points[i], generator), values[generator - 1][i]);
		near(turbulence.x, turbulences[0][i]);
		near(turbulence.y, turbulences[1][i]);
		near(turbulence.z, turbulences[2][i]);
	}
}

static void patterns_are_povrays(void **state)
{
	struct scene scene = { .version = 370, .number_of_waves = 10 };

	(void)state;
	for (size_t k = 0; k < sizeof(patterns) / sizeof(patterns[0]); k++) {
		struct pattern pattern = patterns[k].pattern;

		pattern.frequency = 1;
		for (uint32_t i = 0; i < POINTS; i++)
			near(random_pattern(&scene, &pattern, points[i]), patterns[k].value[i]);
	}
}

/* Neighbouring cells have to meet, and values must not leave 0 to 1, anywhere that a scene may reach. */
static void continuous_and_bounded(void **state)
{
	(void)state;
	for (uint64_t i = 0; i < 20000; i++) {
		double size = i % 2 ? 1e7 : 10;
		vec p = { (rng_unit(4 * i) - 0.5) * size, (rng_unit(4 * i + 1) - 0.5) * size, 0 }, q;

		p.z = floor((rng_unit(4 * i + 2) - 0.5) * size);
		for (uint32_t generator = 1; generator <= 3; generator++) {
			double v = noise_value(p, generator);

			q = vec_make(p.x, p.y, p.z - 1e-7);
			assert_true(v >= 0 && v <= 1);
			assert_float_equal(noise_value(q, generator), v, 1e-6);
		}
	}
}

static void no_place_is_too_far(void **state)
{
	static const double far[] = { 1e18, -1e18, 1e300, -1e300, 2147483647.5, -2147483648.5 };

	(void)state;
	for (unsigned i = 0; i < sizeof(far) / sizeof(far[0]); i++) {
		for (uint32_t generator = 1; generator <= 3; generator++) {
			double v = noise_value(vec_make(far[i], 0.5, 0.5), generator);

			assert_true(v >= 0 && v <= 1);
		}
		noise_cell(vec_make(far[i], far[i], far[i]));
	}
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(values_are_povrays),
		cmocka_unit_test(patterns_are_povrays),
		cmocka_unit_test(continuous_and_bounded),
		cmocka_unit_test(no_place_is_too_far),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
