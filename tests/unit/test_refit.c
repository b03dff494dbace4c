/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Accelerators that are told that their primitives have moved: what they find then, and when they want to be built
 * anew instead.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "accel_fixture.h"

#define RAYS 251u /* no multiple of what goes side by side */
#define HOPELESS 1e-9 /* so few rays that no tree is too bad */

/* As mesh_soup(), but all can be hit. */
static void soup(struct mesh *m, uint32_t n, uint64_t seed)
{
	mesh_group(m);
	for (uint32_t i = 0; i < n; i++) {
		double c[3], e = 0.01 + pow(random_unit(&seed), 4);
		uint32_t v[3];

		for (unsigned k = 0; k < 3; k++)
			c[k] = 10 * random_unit(&seed) - 5;
		for (unsigned k = 0; k < 3; k++) {
			double size = i % 4 || k < 2 ? e : 1e-3 * e;

			v[k] = mesh_vertex(m, c[0] + size * random_unit(&seed), c[1] + size * random_unit(&seed),
					   c[2] + size * random_unit(&seed));
		}
		mesh_triangle(m, v[0], v[1], v[2]);
	}
}

/* Of each kind some, and long thin triangles, which are cut. In exact order balls are more than rays.c can do. */
static void make(struct mesh *m, bool balls)
{
	*m = (struct mesh){ 0 };
	mesh_field(m, 12, 10, 1, 3);
	mesh_torus(m, (ald_vec){ 1, 2, 3 }, 1, 0.2, 30, 20);
	soup(m, 300, 11);
	mesh_group(m);
	for (unsigned i = 0; i < 150; i++) {
		double x = i % 50 * 0.02, y = i / 50 * 0.02;

		mesh_triangle(m, mesh_vertex(m, x, y, 0), mesh_vertex(m, x + 0.01, y, 0),
			      mesh_vertex(m, x + 0.7, y + 0.8, 0.9));
	}
	if (balls)
		mesh_balls(m, 20, 0.5, 7);
}

struct kind {
	bool as_float, mask, exact;
};

/* Vertices as floats can hold them; arrays stand elsewhere, too. */
static void finish_again(struct mesh *m, const struct kind *k)
{
	free(m->vertex_float);
	free(m->origin);
	free(m->mask);
	for (uint32_t i = 0; i < 3 * m->vertices; i++) {
		float f = (float)(&m->vertex[0].x)[i];

		(&m->vertex[0].x)[i] = (double)f;
	}
	m->vertex_float = NULL;
	m->origin = NULL;
	m->mask = NULL;
	m->prims.pad = 0;
	mesh_finish(m, k->as_float, k->mask, k->exact);
	for (uint32_t i = 0; m->mask && i < m->prims.count; i++)
		m->mask[i] = 1u << i % 4; /* of which mesh_finish() has three */
}

enum move { MOVE_LITTLE, MOVE_NOT, MOVE_SCATTER, MOVE_FAR, MOVE_FLAT, MOVE_ALL_FAR, MOVE_TINY, MOVE_APART, MOVES };

static void move_vertex(struct mesh *m, uint32_t i, enum move how, uint64_t *seed)
{
	double *v = &m->vertex[i].x;

	for (unsigned k = 0; k < 3; k++) {
		double r = 2 * random_unit(seed) - 1;

		if (how == MOVE_LITTLE)
			v[k] += 0.1 * r;
		else if (how == MOVE_SCATTER || (how == MOVE_FAR && i % 4))
			v[k] = 5 * r;
		else if (how == MOVE_FAR)
			v[k] = 1e15 * r;
		else if (how == MOVE_FLAT)
			v[k] = k == 2 ? 0.25 : 3 * r;
		else if (how == MOVE_ALL_FAR)
			v[k] = 1e15 + 1e10 * r; /* in floats, too */
		else if (how == MOVE_TINY)
			v[k] = 1e-20 * r;
		else if (how == MOVE_APART)
			v[k] = ldexp(r, (int)(i % 90) - 60);
	}
}

static void move(struct mesh *m, enum move how, uint64_t seed)
{
	for (uint32_t i = 0; i < m->vertices; i++)
		move_vertex(m, i, how, &seed);
	for (uint32_t i = 0; i < m->balls && how != MOVE_NOT; i++) {
		ald_vec *c = &m->ball[i].centre;

		*c = m->vertex[i];
		m->ball[i].radius = how == MOVE_TINY ? 1e-20 : 0.4;
	}
}

static void settle(const struct mesh *m, const ald_ray *ray, struct accel *a)
{
	for (uint32_t i = 0; i < RAYS; i++)
		mesh_settle(m, &ray[i], &a->hit[i]);
}

static void compare_now(const struct mesh *m, const char *spec, struct test_host *h, struct accel *got, enum move how)
{
	struct accel *none = malloc(sizeof(*none));
	ald_ray *ray = malloc(RAYS * sizeof(*ray));
	char what[40];

	snprintf(what, sizeof(what), "after move %d", (int)how);
	accel_open(none, "none", h, m);
	for (uint32_t i = 0; i < RAYS; i++)
		ray_make(m, 1 + how, i, &ray[i]);
	for (int same = 0; same <= (m->mask ? 1 : 0); same++) {
		for (uint32_t i = 0; same && i < RAYS; i++)
			ray[i].mask = 7;
		ask(none, ray, RAYS, ASK_ALL, 0);
		settle(m, ray, none);
		for (int way = ASK_ALL; way <= ASK_EACH; way++) {
			ask(got, ray, RAYS, way, 0);
			settle(m, ray, got);
			compare(what, spec, none, got, ray, RAYS);
		}
	}
	accel_close(none);
	free(none);
	free(ray);
}

static void all_moves(const char *spec, const struct kind *k)
{
	struct accel *a = malloc(sizeof(*a));
	struct test_host h;
	struct mesh m;

	make(&m, !k->exact);
	mesh_finish(&m, k->as_float, k->mask, k->exact);
	test_host_init(&h, 2, 0);
	h.host.rays = 1e6; /* built well */
	if (accel_open(a, spec, &h, &m)) { /* not on this machine */
		free(a);
		test_host_release(&h);
		mesh_release(&m);
		return;
	}
	h.host.rays = HOPELESS;
	for (enum move how = 0; how < MOVES; how++) {
		ald_error err = { "" };

		move(&m, how, 100 + how);
		finish_again(&m, k);
		assert_int_equal(a->choice.plugin->refit(a->it, &err), ALD_OK);
		compare_now(&m, spec, &h, a, how);
	}
	accel_close(a);
	assert_int_equal(h.book.now, 0);
	test_host_release(&h);
	mesh_release(&m);
	free(a);
}

static void test_hits(void **state)
{
	static const char *const spec[] = { "bvh8:build=sah", "bvh8:build=fast", "bvh8:build=sah,split=1,leaf=28",
					    "bvh8:isa=plain", "bvh8:isa=sse", "bvh8:isa=avx2", "bvh8:isa=avx512",
					    "bvh8:interleave=1" };
	static const struct kind kind[] = {
		{ false, false, false }, { true, true, false }, { false, false, true }
	};

	(void)state;
	for (unsigned i = 0; i < sizeof(spec) / sizeof(spec[0]); i++) {
		for (unsigned k = 0; k < sizeof(kind) / sizeof(kind[0]); k++)
			all_moves(spec[i], &kind[k]);
	}
}

/* One triangle, no triangle, and one leaf of other things. */
static void test_small(void **state)
{
	static const struct kind kind = { false, false, false };

	(void)state;
	for (unsigned n = 0; n < 20; n++) {
		struct accel *a = malloc(sizeof(*a));
		ald_error err = { "" };
		struct mesh m = { 0 };
		struct test_host h;

		soup(&m, n % 10, 11);
		mesh_balls(&m, n / 10 * 3, 0.5, 7);
		mesh_finish(&m, false, false, false);
		test_host_init(&h, 1, 0);
		h.host.rays = HOPELESS;
		accel_open(a, "bvh8", &h, &m);
		for (uint32_t i = 0; i < m.vertices; i++)
			m.vertex[i].x += 3 + i % 3;
		for (uint32_t i = 0; i < m.balls; i++)
			m.ball[i].centre.y += 3;
		finish_again(&m, &kind);
		assert_int_equal(a->choice.plugin->refit(a->it, &err), ALD_OK);
		if (m.prims.count)
			compare_now(&m, "bvh8", &h, a, MOVE_LITTLE);
		accel_close(a);
		test_host_release(&h);
		mesh_release(&m);
		free(a);
	}
}

/* The tree is large enough to be refitted in parts. */
static void test_threads(void **state)
{
	static const uint32_t threads[] = { 1, 2, 5 };
	static const char *const spec[] = { "bvh8:build=sah", "bvh8:build=fast" };
	static const struct kind kind = { false, false, false };
	struct accel *a = malloc(sizeof(*a));

	(void)state;
	for (unsigned i = 0; i < 6; i++) {
		static uint64_t sum[6];
		ald_error err = { "" };
		struct test_host h;
		struct mesh m = { 0 };

		mesh_field(&m, 130, 10, 1, 3);
		mesh_torus(&m, (ald_vec){ 1, 2, 3 }, 1, 0.2, 200, 100);
		mesh_finish(&m, false, false, false);
		test_host_init(&h, threads[i % 3], 0);
		accel_open(a, spec[i / 3], &h, &m);
		for (uint32_t k = 0; k < m.vertices; k++)
			m.vertex[k].y += 0.1 * sin(2 * m.vertex[k].x);
		finish_again(&m, &kind);
		assert_int_equal(a->choice.plugin->refit(a->it, &err), ALD_OK);
		a->choice.plugin->walk(a->it, NULL, fold_volume, &sum[i]);
		assert_true(sum[i] == sum[i / 3 * 3]);
		if (i % 3 == 0)
			compare_now(&m, spec[i / 3], &h, a, MOVE_LITTLE);
		accel_close(a);
		test_host_release(&h);
		mesh_release(&m);
	}
	free(a);
}

static int refit_torus(double rays, double by, enum move how)
{
	static const struct kind kind = { false, false, false };
	struct accel *a = malloc(sizeof(*a));
	ald_error err = { "" };
	struct mesh m = { 0 };
	struct test_host h;
	int status;

	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1, 0.2, 80, 60);
	mesh_finish(&m, false, false, false);
	test_host_init(&h, 2, 0);
	h.host.rays = rays;
	accel_open(a, "bvh8:build=sah", &h, &m);
	for (uint32_t i = 0; i < m.vertices; i++)
		m.vertex[i].z = by * m.vertex[i].z + m.vertex[i].x;
	move(&m, how, 1);
	finish_again(&m, &kind);
	status = a->choice.plugin->refit(a->it, &err);
	accel_close(a);
	assert_int_equal(h.book.now, 0);
	test_host_release(&h);
	mesh_release(&m);
	free(a);
	return status;
}

/* Shears are no reason; chaos is one, the sooner the more rays there are. */
static void test_worse(void **state)
{
	(void)state;
	assert_int_equal(refit_torus(0, 1.5, MOVE_NOT), ALD_OK);
	assert_int_equal(refit_torus(1e3, 1.5, MOVE_NOT), ALD_OK);
	assert_int_equal(refit_torus(0, 1, MOVE_SCATTER), ALD_UNSUPPORTED);
	assert_int_equal(refit_torus(1e6, 1, MOVE_SCATTER), ALD_UNSUPPORTED);
	assert_int_equal(refit_torus(HOPELESS, 1, MOVE_SCATTER), ALD_OK);
}

/* What can't be hit is in no tree, and what is in one has to be hit. */
static void test_vanish(void **state)
{
	static const struct kind kind = { false, false, false };
	struct accel *a = malloc(sizeof(*a));
	struct test_host h;

	(void)state;
	for (unsigned i = 0; i < 4; i++) {
		ald_error err = { "" };
		struct mesh m = { 0 };
		ald_vec *v, was;

		mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1, 0.2, 20, 10);
		v = &m.vertex[m.index[0]];
		was = *v;
		if (i == 0)
			*v = m.vertex[m.index[1]];
		mesh_finish(&m, false, false, false);
		test_host_init(&h, 1, 0);
		h.host.rays = HOPELESS;
		accel_open(a, "bvh8", &h, &m);
		*v = i == 1 ? m.vertex[m.index[1]] : was;
		if (i == 2)
			v->y = (double)NAN;
		finish_again(&m, &kind);
		assert_int_equal(a->choice.plugin->refit(a->it, &err), i < 3 ? ALD_UNSUPPORTED : ALD_OK);
		accel_close(a);
		assert_int_equal(h.book.now, 0);
		test_host_release(&h);
		mesh_release(&m);
	}
	free(a);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_hits),  cmocka_unit_test(test_small),  cmocka_unit_test(test_threads),
		cmocka_unit_test(test_worse), cmocka_unit_test(test_vanish),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
