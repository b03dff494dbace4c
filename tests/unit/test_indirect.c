/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Directions of gathered rays, and the cache's records: their gradients against lights whose irradiance is
 * known in closed form. Whole pictures are compared in tests/indirect.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/rng.h"
#include "shade/cache.h"
#include "shade/frame.h"
#include "shade/indirect.h"

#define CLOSE(a, b, e) assert_true(fabs((a) - (b)) < (e))

/* A frame is right-handed and of unit vectors, also where the normal is an axis. */
static void frames_are_frames(void **state)
{
	static const vec normal[] = { { 0, 0, 1 }, { 0, 0, -1 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0.6, 0, -0.8 },
				      { 0.48, 0.6, 0.64 }, { 0, 1e-9, -1 } };

	(void)state;
	for (size_t i = 0; i < sizeof(normal) / sizeof(normal[0]); i++) {
		vec x = frame_around(normal[i], 1, 0, 0), y = frame_around(normal[i], 0, 1, 0);
		vec z = vec_cross(x, y);

		CLOSE(vec_dot(x, x), 1, 1e-12);
		CLOSE(vec_dot(x, y), 0, 1e-12);
		CLOSE(vec_dot(z, normal[i]), 1, 1e-12);
	}
}

/* Cosine-weighted: the mean of the cosine is 2/3 and of its square 1/2, and it is even all around. */
static void directions_have_the_cosine(void **state)
{
	const vec n = { 0.48, 0.6, 0.64 };
	double one = 0, two = 0;
	vec sum = { 0, 0, 0 };

	(void)state;
	for (uint32_t i = 0; i < 4096; i++) {
		vec d = indirect_direction(n, i, 99);
		double c = vec_dot(d, n);

		assert_true(c >= 0);
		CLOSE(vec_dot(d, d), 1, 1e-12);
		one += c / 4096;
		two += c * c / 4096;
		sum = vec_mad(sum, d, 1.0 / 4096);
	}
	CLOSE(one, 2.0 / 3, 1e-3);
	CLOSE(two, 0.5, 1e-3);
	CLOSE(vec_dot(sum, frame_around(n, 1, 0, 0)), 0, 2e-3);
	CLOSE(vec_dot(sum, frame_around(n, 0, 1, 0)), 0, 2e-3);
}

/* What a place at (x, 0, 0) that looks along z sees of a wall of light 1, at x = 1, of height 1 and without end to
 * its sides: (1 - cos a) / 2 with a the angle to its upper edge. */
static double wall(double x)
{
	double d = 1 - x;

	return 0.5 * (1 - d / sqrt(d * d + 1));
}

static void gradients_are_the_slopes(void **state)
{
	struct cache_grid g = cache_grid(40000);
	static struct cache_ray ray[41000];
	struct cache_record r = { .p = { 0, 0, 0 }, .n = { 0, 0, 1 } };
	double e = 1e-4, slope = (wall(e) - wall(-e)) / (2 * e);

	(void)state;
	assert_true(g.rows * g.columns <= 41000);
	for (uint32_t i = 0; i < g.rows * g.columns; i++) {
		vec d = cache_direction(&g, r.n, i, rng_unit(2 * i), rng_unit(2 * i + 1));
		double t = d.x > 0 ? 1 / d.x : HUGE_VAL;

		if (d.z * t > 1)
			t = HUGE_VAL;
		ray[i] = (struct cache_ray){ { isfinite(t), isfinite(t), 0 }, t };
	}
	cache_make(&r, &g, ray, &(struct cache_limits){ 1e-3, 100, 1 });
	CLOSE(r.light.r, wall(0), 0.003);
	CLOSE(r.light.b, 0, 1e-12);
	CLOSE(r.move[0].x, slope, 0.03 * slope);
	CLOSE(r.move[0].y, 0, 0.03 * slope);
	CLOSE(r.move[2].x, 0, 1e-12);
	assert_true(r.radius > 0.1 && r.radius <= 1);
	/* Turned by a small angle a towards the wall: of its upper edge at 45 degrees the mean gains. */
	assert_true(r.turn[0].y > 0.1);
	CLOSE(r.turn[0].x, 0, 0.01);
}

/* With light that falls off with the cosine to z, turning changes the mean as its derivative says. */
static void turning_is_foreseen(void **state)
{
	struct cache_grid g = cache_grid(40000);
	static struct cache_ray ray[41000];
	vec light = { 0.6, 0, 0.8 };
	struct cache_record r = { .n = { 0, 0, 1 } };
	double mean = 0, turned = 0, a = 0.02;
	vec n = { sin(a), 0, cos(a) };

	(void)state;
	for (uint32_t i = 0; i < g.rows * g.columns; i++) {
		vec d = cache_direction(&g, r.n, i, rng_unit(2 * i), rng_unit(2 * i + 1));
		double c = fmax(0, vec_dot(d, light));

		ray[i] = (struct cache_ray){ { c, c, c }, 5 };
		c = fmax(0, vec_dot(cache_direction(&g, n, i, rng_unit(2 * i), rng_unit(2 * i + 1)), light));
		turned += c / (g.rows * g.columns);
		mean += ray[i].light.r / (g.rows * g.columns);
	}
	cache_make(&r, &g, ray, &(struct cache_limits){ 1e-3, 100, 1 });
	CLOSE(r.light.r, mean, 1e-12);
	CLOSE(r.light.r + vec_dot(vec_cross(r.n, n), r.turn[0]), turned, 0.1 * fabs(turned - mean));
}

/* A record answers near itself and not beyond, nor around other normals; two are blended. */
static void answers_are_near(void **state)
{
	struct mem_book book;
	struct cache c;
	struct cache_record r[2] = {
		{ .p = { 3, 0, 0 }, .n = { 0, 0, 1 }, .light = { 2, 2, 2 }, .radius = 1, .key = 2, .nearest = 9 },
		{ .p = { 1, 0, 0 }, .n = { 0, 0, 1 }, .light = { 1, 1, 1 }, .radius = 1.5, .key = 1, .nearest = 9 },
	};
	const vec up = { 0, 0, 1 }, down = { 0, 0, -1 };
	struct rgb light;

	(void)state;
	mem_book_init(&book, 0);
	cache_init(&c, 1, &book);
	assert_false(cache_find(&c, vec_make(0, 0, 0), up, 1, &light));
	assert_true(cache_add(&c, r, 2));
	assert_int_equal(BUF_AT(&c.record, struct cache_record, 0)->key, 1);
	assert_true(cache_find(&c, vec_make(1, 0, 0), up, 1, &light));
	CLOSE(light.g, 1, 1e-12);
	assert_false(cache_find(&c, vec_make(-0.6, 0, 0), up, 1, &light));
	assert_true(cache_find(&c, vec_make(-0.6, 0, 0), up, CACHE_REACH, &light));
	assert_false(cache_find(&c, vec_make(1, 0, 0), down, CACHE_REACH, &light));
	assert_true(cache_find(&c, vec_make(2.25, 0, 0), up, 1, &light));
	CLOSE(light.g, (1.0 / 6 * 1 + 0.25 * 2) / (1.0 / 6 + 0.25), 1e-12);
	cache_release(&c);
	assert_int_equal(book.now, 0);
}

/* What a record knows to be near, all know that would answer for its place. */
static void neighbours_are_warned(void **state)
{
	struct mem_book book;
	struct cache c;
	struct cache_record r[4] = {
		{ .p = { 0, 0, 0 }, .n = { 0, 0, 1 }, .radius = 2, .nearest = 4, .key = 1 },
		{ .p = { 1, 0, 0 }, .n = { 0, 0, 1 }, .radius = 0.1, .nearest = 0.2, .key = 2 },
		{ .p = { 3, 0, 0 }, .n = { 0, 0, 1 }, .radius = 0.1, .nearest = 0.2, .key = 3 },
		{ .p = { 0, 0, 0 }, .n = { 1, 0, 0 }, .radius = 2, .nearest = 4, .key = 4 },
	};
	const vec up = { 0, 0, 1 };
	struct rgb light;

	(void)state;
	r[0].least = 0.8;
	r[0].move[0] = vec_make(4, 0, 0);
	mem_book_init(&book, 0);
	cache_init(&c, 1, &book);
	assert_true(cache_add(&c, r, 4));
	CLOSE(BUF_AT(&c.record, struct cache_record, 0)->nearest, 1.2, 1e-12);
	CLOSE(BUF_AT(&c.record, struct cache_record, 0)->radius, 0.8, 1e-12); /* its least */
	CLOSE(BUF_AT(&c.record, struct cache_record, 0)->move[0].x, 4 * 0.6 / 0.8, 1e-12);
	CLOSE(BUF_AT(&c.record, struct cache_record, 1)->radius, 0.1, 1e-12);
	CLOSE(BUF_AT(&c.record, struct cache_record, 3)->radius, 2, 1e-12); /* turned away */
	assert_true(cache_find(&c, vec_make(-0.7, 0, 0), up, 1, &light));
	assert_false(cache_find(&c, vec_make(-1.7, 0, 0), up, 1, &light));
	cache_release(&c);
	assert_int_equal(book.now, 0);
}

/* The same by going through all records. */
static double ask_all(const struct cache_record *r, uint32_t n, vec p, vec normal, struct rgb *light)
{
	double weights = 0;

	*light = rgb_make(0, 0, 0);
	for (uint32_t i = 0; i < n; i++) {
		vec d = vec_sub(p, r[i].p);
		double far = vec_length(d) / r[i].radius;
		double turned = sqrt(fmax(0, 1 - vec_dot(normal, r[i].n)) / 0.0603);
		double w = (1 - fmax(far, turned) / CACHE_REACH) *
			   (vec_dot(d, vec_add(normal, r[i].n)) >= -0.2 * r[i].radius);
		double red = r[i].light.r + vec_dot(vec_cross(r[i].n, normal), r[i].turn[0]) +
			     vec_dot(d, r[i].move[0]);

		if (!(w > 0))
			continue;
		light->r += w * fmax(0, red);
		light->g += w * r[i].light.g;
		weights += w;
	}
	*light = rgb_scale(*light, 1 / weights);
	return weights;
}

static double chance(uint64_t i)
{
	return 2 * rng_unit(rng_mix(i)) - 1;
}

/* However many cells and levels there are. */
static void no_record_is_lost(void **state)
{
	enum { RECORDS = 3000, PLACES = 5000 };
	static struct cache_record r[RECORDS];
	struct mem_book book;
	struct cache c;
	uint32_t answered = 0;

	(void)state;
	for (uint32_t i = 0; i < RECORDS; i++) {
		uint64_t k = 16 * (uint64_t)i;

		r[i] = (struct cache_record){ .p = { 4 * chance(k), 4 * chance(k + 1), 0.05 * chance(k + 2) },
					      .n = vec_unit(vec_make(0.1 * chance(k + 3), 0.1 * chance(k + 4), 1)),
					      .light = { 1 + chance(k + 5), 1 + chance(k + 6), 0 },
					      .turn[0] = { chance(k + 7), chance(k + 8), 0 },
					      .move[0] = { 3 * chance(k + 9), 0, chance(k + 10) },
					      .radius = 0.005 * exp(4 * (1 + chance(k + 11)) / 2),
					      .nearest = 9,
					      .key = i };
	}
	mem_book_init(&book, 0);
	cache_init(&c, 1, &book);
	assert_true(cache_add(&c, r, RECORDS / 2));
	assert_true(cache_add(&c, r + RECORDS / 2, RECORDS / 2));
	for (uint32_t i = 0; i < PLACES; i++) {
		uint64_t k = ((uint64_t)i << 32) + 1;
		vec p = { 4 * chance(k), 4 * chance(k + 1), 0.05 * chance(k + 2) };
		vec n = vec_unit(vec_make(0.2 * chance(k + 3), 0.2 * chance(k + 4), 1));
		struct rgb want, got;
		double weights = ask_all(r, RECORDS, p, n, &want);

		if (weights > 0 && weights < 1e-9)
			continue; /* at a border: rounding decides */
		assert_int_equal(cache_find(&c, p, n, CACHE_REACH, &got), weights > 0);
		answered += weights > 0;
		if (weights > 0) {
			CLOSE(got.r, want.r, 1e-9);
			CLOSE(got.g, want.g, 1e-9);
		}
	}
	assert_in_range(answered, PLACES / 4, PLACES);
	cache_release(&c);
	assert_int_equal(book.now, 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(frames_are_frames),	    cmocka_unit_test(directions_have_the_cosine),
		cmocka_unit_test(gradients_are_the_slopes), cmocka_unit_test(turning_is_foreseen),
		cmocka_unit_test(answers_are_near),	    cmocka_unit_test(no_record_is_lost),
		cmocka_unit_test(neighbours_are_warned),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
