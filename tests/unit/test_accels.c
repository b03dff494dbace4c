/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Every accelerator answers as none does, to the bit: nearest hits, shadows and next-hit walks, on rays
 * of which most are hostile.
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

/* ALIDADE_TEST_ACCEL may name another one, in place of the last. */
static const char *spec[] = {
	"none:isa=plain", "box:isa=avx2", "sphere:isa=sse", "octree", "octree:index=32,walk=recursion",
	"octree:node=sphere,leaf=8", "octree:depth=0", "octree:leaf=1,depth=5,price=0",
	"octree:leaf=1,depth=6,price=0,shape=box", "octree:isa=avx2", "octree:isa=sse",
	"octree:isa=plain", "bvh8", "bvh8:isa=plain,leaf=1,interleave=1",
	"bvh8:isa=sse,leaf=28,interleave=3,split=1",
	"bvh8:isa=avx2,split=100", "bvh8:isa=avx512,leaf=5,interleave=8",
	"bvh8:build=fast", "bvh8:build=fast,isa=plain,leaf=1", "bvh8:build=fast,isa=sse,leaf=3",
#ifdef HAVE_EMBREE
	"embree", "embree:packet=16,isa=avx2,quality=high", "embree:packet=stream,isa=sse4.2,quality=low",
#endif
	"octree:leaf=30",
};
enum { SPECS = sizeof(spec) / sizeof(spec[0]) };

/* Step behind the hits (R2); returns how many rays still had one. */
static uint32_t step_behind(ald_ray *ray, const ald_hit *hit, uint32_t n)
{
	uint32_t live = 0;

	for (uint32_t i = 0; i < n; i++) {
		if (hit[i].prim == ALD_NONE)
			continue;
		ray[i].tmin = hit[i].t;
		ray[i].after = hit[i].prim;
		live++;
	}
	return live;
}

/* Rays in bundles: of each sixteen all go about the way of the first, some the very same. */
static void bundle(ald_ray *ray, uint32_t n)
{
	uint64_t seed = 9;

	for (uint32_t i = 0; i < n; i++) {
		const ald_ray *first = &ray[i & ~15u];
		double wide = 0.3 / (double)(1u << (i / 16 % 16));

		ray[i].org = first->org;
		ray[i].dir = first->dir;
		if (i % 16 < 3)
			continue;
		ray[i].org.x += i & 1 ? 0 : wide * random_unit(&seed);
		ray[i].dir.x += wide * fabs(first->dir.x) * (random_unit(&seed) - 0.5);
		ray[i].dir.y += wide * fabs(first->dir.y) * (random_unit(&seed) - 0.5);
		ray[i].dir.z += wide * fabs(first->dir.z) * (random_unit(&seed) - 0.5);
	}
}

static void same_hits(const char *mesh, struct mesh *m, uint32_t rays, uint32_t steps)
{
	struct accel *none = malloc(sizeof(*none)), *other = malloc(SPECS * sizeof(*other));
	ald_ray *ray = malloc(BATCH * sizeof(*ray));
	struct test_host h;
	bool there[SPECS];
	uint64_t hits = 0;

	if (getenv("ALIDADE_ALL") && *getenv("ALIDADE_ALL"))
		rays *= 16;
	rays /= FEWER;
	test_host_init(&h, 2, 0);
	accel_open(none, "none", &h, m);
	for (unsigned k = 0; k < SPECS; k++)
		there[k] = accel_open(&other[k], spec[k], &h, m) == ALD_OK; /* else: not on this processor */
	for (uint32_t first = 0; first < rays; first += BATCH) {
		uint32_t step = 0, hints = first / BATCH % 4 == 2 ? ALD_COHERENT : 0;

		for (uint32_t i = 0; i < BATCH; i++)
			ray_make(m, 1, first + i, &ray[i]);
		if (hints)
			bundle(ray, BATCH);
		do {
			int how = first % (8 * BATCH) == 0 && step < 2 ? ASK_EACH :
				  first / BATCH % 2		       ? ASK_PIECES :
									 ASK_ALL;

			/* Counting is other code: it has to give the same. */
			for (unsigned k = 0; k < SPECS; k++)
				other[k].q.count = first / BATCH % 4 == 1 ? other[k].count : NULL;
			ask(none, ray, BATCH, how, hints);
			for (unsigned k = 0; k < SPECS; k++) {
				if (!there[k])
					continue;
				ask(&other[k], ray, BATCH, how, hints);
				compare(mesh, spec[k], none, &other[k], ray, BATCH);
			}
			for (uint32_t i = 0; i < BATCH; i++) {
				hits += none->hit[i].prim != ALD_NONE;
				mesh_settle(m, &ray[i], &none->hit[i]);
			}
		} while (step_behind(ray, none->hit, BATCH) && ++step < (first % (16 * BATCH) ? 1 : steps));
	}
	assert_true(hits > rays / 20);
	for (unsigned k = 0; k < SPECS; k++) {
		if (there[k])
			accel_close(&other[k]);
	}
	accel_close(none);
	assert_int_equal(h.book.now, 0);
	test_host_release(&h);
	free(none);
	free(other);
	free(ray);
	mesh_release(m);
}

static void test_torus(void **state)
{
	struct mesh m = { 0 };

	(void)state;
	mesh_torus(&m, (ald_vec){ 0.1, 0.2, -0.3 }, 1, 0.25, 48, 32);
	mesh_finish(&m, false, false, false);
	same_hits("torus", &m, 16 * 1024, 4);
}

static void test_objects(void **state)
{
	struct mesh m = { 0 };

	(void)state;
	for (unsigned i = 0; i < 12; i++)
		mesh_torus(&m, (ald_vec){ i % 3, i / 3, i % 5 * 0.2 }, 0.3, 0.1, 8, 6);
	mesh_soup(&m, 100, 2, 3, 4);
	mesh_balls(&m, 40, 0.2, 7);
	mesh_finish(&m, true, true, false);
	same_hits("objects", &m, 16 * 1024, 12);
}

static void test_field(void **state)
{
	struct mesh m = { 0 };

	(void)state;
	mesh_field(&m, 24, 10, 1, 3);
	mesh_finish(&m, true, false, false);
	same_hits("field", &m, 16 * 1024, 4);
}

static void test_soup(void **state)
{
	struct mesh m = { 0 };

	(void)state;
	mesh_soup(&m, 1000, 1, 1, 11);
	mesh_finish(&m, false, true, false);
	same_hits("soup", &m, 16 * 1024, 20);
}

static void test_sheets(void **state)
{
	struct mesh m = { 0 };

	(void)state;
	mesh_sheets(&m, 8, 4, 0); /* on top of each other: the order is that of the ids */
	mesh_finish(&m, false, false, false);
	same_hits("coincident sheets", &m, 16 * 1024, 5);
}

static void test_close_sheets(void **state)
{
	struct mesh m = { 0 };

	(void)state;
	mesh_sheets(&m, 8, 3, 0x1p-22);
	mesh_finish(&m, false, false, false);
	same_hits("close sheets", &m, 16 * 1024, 8);
}

static void test_balls(void **state)
{
	struct mesh m = { 0 };

	(void)state;
	mesh_balls(&m, 300, 0.2, 5);
	mesh_finish(&m, false, true, false);
	same_hits("balls", &m, 16 * 1024, 12);
}

/* Two in the very same place, and a third a little off. */
static void test_exact(void **state)
{
	struct mesh m = { 0 };

	(void)state;
	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1, 0.25, 16, 12);
	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1, 0.25, 16, 12);
	mesh_torus(&m, (ald_vec){ 0x1p-53, 0, 0x1p-54 }, 1, 0.25, 16, 12);
	mesh_finish(&m, false, true, true);
	same_hits("in exact order", &m, 16 * 1024, 4);
}

static void test_one(void **state)
{
	struct mesh m = { 0 };

	(void)state;
	mesh_soup(&m, 1, 1, 5, 2);
	m.index[2] = 2; /* not the degenerate one that soups begin with */
	mesh_finish(&m, false, false, false);
	same_hits("one triangle", &m, 8 * 1024, 2);
}

/* With none, tests are rays times primitives; an octree counts its repeats apart. */
static void test_counts(void **state)
{
	struct accel *a = malloc(sizeof(*a));
	ald_ray *ray = malloc(BATCH * sizeof(*ray));
	struct mesh m = { 0 };
	struct test_host h;
	const uint64_t *n = a->count;

	(void)state;
	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1, 0.25, 13, 7);
	mesh_torus(&m, (ald_vec){ 3, 0, 0 }, 1, 0.25, 9, 7);
	mesh_balls(&m, 3, 0.5, 5);
	mesh_finish(&m, false, false, false);
	test_host_init(&h, 2, 0);
	for (uint32_t i = 0; i < BATCH; i++)
		ray_make(&m, 2, i, &ray[i]);
	for (unsigned k = 0; k < 5; k++) {
		const char *const name[] = { "none", "box", "sphere", "octree:leaf=1,depth=5,price=0", "bvh8" };

		accel_open(a, name[k], &h, &m);
		a->q.count = a->count;
		fresh(a->hit, ray, BATCH);
		a->choice.plugin->intersect_n(a->it, &a->q, ray, a->hit, BATCH, 0);
		if (k == 0) {
			assert_int_equal(n[ALD_COUNT_PRIMS], BATCH * m.prims.count);
			assert_int_equal(n[ALD_COUNT_VOLUME_TESTS], 0);
		} else {
			assert_true(n[ALD_COUNT_PRIMS] < BATCH * m.prims.count);
			assert_true(n[ALD_COUNT_VOLUME_TESTS] >= BATCH);
			assert_true(n[ALD_COUNT_VOLUME_HITS] < n[ALD_COUNT_VOLUME_TESTS]);
			assert_true(n[ALD_COUNT_VOLUME_USEFUL] <= n[ALD_COUNT_VOLUME_HITS]);
			assert_true(n[ALD_COUNT_VOLUME_USEFUL] > 0);
		}
		if (k == 1 || k == 2)
			assert_int_equal(n[ALD_COUNT_VOLUME_TESTS], BATCH * m.prims.group_count);
		assert_true(k < 3 || n[ALD_COUNT_NODES] > 0);
		if (k == 3) {
			assert_true(n[ALD_COUNT_REPEATS] > 0);
			assert_true(n[ALD_COUNT_REPEATS] < n[ALD_COUNT_PRIMS]);
		}
		accel_close(a);
	}
	assert_int_equal(h.book.now, 0);
	test_host_release(&h);
	mesh_release(&m);
	free(ray);
	free(a);
}

/* Thin triangles askew from one side of a cube to the other, at most a hundred. */
static void mesh_beams(struct mesh *m, uint32_t n)
{
	mesh_group(m);
	for (uint32_t i = 0; i < n; i++) {
		double u = 0.2 * (i % 10) - 0.9, v = 0.2 * (i / 10) - 0.9;
		uint32_t a = mesh_vertex(m, -1, u, v), b = mesh_vertex(m, 1, v, -u);

		mesh_triangle(m, a, b, mesh_vertex(m, -1, u + 0.005, v));
	}
}

static void mesh_cube(struct mesh *m)
{
	static const unsigned side[6][4] = {
		{ 0, 1, 3, 2 }, { 4, 6, 7, 5 }, { 0, 4, 5, 1 }, { 2, 3, 7, 6 }, { 0, 2, 6, 4 }, { 1, 5, 7, 3 },
	};
	uint32_t v[8];

	mesh_group(m);
	for (unsigned i = 0; i < 8; i++)
		v[i] = mesh_vertex(m, i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
	for (unsigned i = 0; i < 6; i++) {
		mesh_triangle(m, v[side[i][0]], v[side[i][1]], v[side[i][2]]);
		mesh_triangle(m, v[side[i][0]], v[side[i][2]], v[side[i][3]]);
	}
}

/* Of each ray that is asked alone, tests but repeats are no more than there are primitives. */
static uint64_t repeats_of(const char *name, struct mesh *m)
{
	struct accel *a = malloc(sizeof(*a));
	struct test_host h;
	uint64_t repeats = 0;

	mesh_finish(m, false, false, false);
	test_host_init(&h, 2, 0);
	accel_open(a, name, &h, m);
	a->q.count = a->count;
	for (uint32_t i = 0; i < 4 * BATCH; i++) {
		const uint64_t *n = a->count;
		ald_ray ray;

		ray_make(m, 2, i, &ray);
		memset(a->count, 0, sizeof(a->count));
		fresh(a->hit, &ray, 1);
		a->choice.plugin->intersect(a->it, &a->q, &ray, a->hit);
		assert_true(n[ALD_COUNT_REPEATS] <= n[ALD_COUNT_PRIMS]);
		assert_true(n[ALD_COUNT_PRIMS] - n[ALD_COUNT_REPEATS] <= m->prims.count);
		repeats += n[ALD_COUNT_REPEATS];
	}
	accel_close(a);
	assert_int_equal(h.book.now, 0);
	test_host_release(&h);
	mesh_release(m);
	*m = (struct mesh){ 0 };
	free(a);
	return repeats;
}

static void test_repeats(void **state)
{
	static const char *const name[] = { "octree:leaf=1,depth=5,price=0", "bvh8", "bvh8:isa=plain,leaf=1" };
	struct mesh m = { 0 };

	(void)state;
	for (unsigned k = 0; k < sizeof(name) / sizeof(name[0]); k++) {
		mesh_beams(&m, 100);
		assert_true(repeats_of(name[k], &m) > 0);
	}
	mesh_beams(&m, 100);
	assert_int_equal(repeats_of("bvh8:split=1", &m), 0);
	mesh_beams(&m, 100);
	assert_int_equal(repeats_of("bvh8:build=fast", &m), 0);
	mesh_cube(&m);
	assert_int_equal(repeats_of("bvh8", &m), 0);
	mesh_cube(&m);
	assert_int_equal(repeats_of("none", &m), 0);
}

/* A build that runs out of memory anywhere, or is cancelled, leaves nothing behind (R7). */
static void test_failed_builds(void **state)
{
	const char *const name[] = { "none", "box", "sphere", "octree", "bvh8", "bvh8:build=fast" };
	struct accel *a = malloc(sizeof(*a));
	struct mesh m = { 0 };
	struct test_host h;

	(void)state;
	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1, 0.25, 40, 30);
	mesh_finish(&m, false, false, false);
	for (unsigned k = 0; k < sizeof(name) / sizeof(name[0]); k++) {
		int status = ALD_NO_MEMORY;

		for (uint64_t limit = 1; status; limit += limit / 8 + 1) {
			test_host_init(&h, 2, limit);
			status = accel_open(a, name[k], &h, &m);
			if (!status)
				accel_close(a);
			else
				assert_int_equal(status, ALD_NO_MEMORY);
			assert_int_equal(h.book.now, 0);
			test_host_release(&h);
			assert_true(limit < 1u << 30);
		}
	}
	for (double at = 0; at < 0.2; at += 0.02) {
		test_host_init(&h, 2, 0);
		h.cancel_at = at;
		assert_int_equal(accel_open(a, "octree:depth=16", &h, &m), ALD_CANCELLED);
		assert_int_equal(h.book.now, 0);
		test_host_release(&h);
	}
	mesh_release(&m);
	free(a);
}

struct holder {
	const struct mesh *m;
	uint32_t volumes, leaves, prims;
	double volume; /* of all leaves */
};

static int hold(void *arg, const ald_volume *v)
{
	struct holder *h = arg;

	h->volumes++;
	h->leaves += v->prims > 0;
	h->prims += v->prims;
	return 1;
}

static double stat_of(const struct accel *a, const char *what)
{
	const char *name;
	double value;

	for (uint32_t i = 0; a->choice.plugin->stat(a->it, i, &name, &value); i++) {
		if (!strcmp(name, what))
			return value;
	}
	return -1;
}

static void test_octree_figures(void **state)
{
	struct accel *a = malloc(sizeof(*a));
	struct mesh m = { 0 };
	struct test_host h;

	(void)state;
	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1, 0.25, 40, 30);
	mesh_finish(&m, false, false, false);
	test_host_init(&h, 2, 0);
	for (unsigned depth = 0; depth <= 6; depth++) {
		struct holder got = { .m = &m };
		char name[64];

		snprintf(name, sizeof(name), "octree:depth=%u,leaf=1,price=0", depth);
		accel_open(a, name, &h, &m);
		a->choice.plugin->walk(a->it, NULL, hold, &got);
		assert_int_equal(got.volumes, (int)stat_of(a, "nodes"));
		assert_int_equal(got.leaves, (int)stat_of(a, "leaves"));
		assert_int_equal(got.prims, (int)stat_of(a, "references"));
		assert_int_equal((int)stat_of(a, "depth"), (int)depth);
		assert_int_equal((int)stat_of(a, "index bits"), 16);
		assert_true(stat_of(a, "memory") <= (double)h.book.now);
		if (!depth)
			assert_int_equal(got.prims, m.prims.count);
		accel_close(a);
	}
	assert_int_equal(accel_open(a, "octree:depth=9,leaf=1,price=0,index=16", &h, &m), ALD_BAD_PARAM);
	assert_int_equal(accel_open(a, "octree:depth=9,leaf=1,price=0", &h, &m), ALD_OK);
	assert_int_equal((int)stat_of(a, "index bits"), 32);
	accel_close(a);
	assert_int_equal(h.book.now, 0);
	test_host_release(&h);
	mesh_release(&m);
	free(a);
}

static void test_bvh8_figures(void **state)
{
	static const char *const name[] = { "bvh8", "bvh8:leaf=1", "bvh8:leaf=28,split=1", "bvh8:build=fast",
					    "bvh8:build=fast,leaf=2" };
	struct accel *a = malloc(sizeof(*a));
	struct mesh m = { 0 };
	struct test_host h;

	(void)state;
	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1, 0.25, 40, 30);
	mesh_balls(&m, 50, 0.2, 5);
	mesh_finish(&m, false, false, false);
	test_host_init(&h, 2, 0);
	for (unsigned k = 0; k < sizeof(name) / sizeof(name[0]); k++) {
		struct holder got = { .m = &m };

		accel_open(a, name[k], &h, &m);
		a->choice.plugin->walk(a->it, NULL, hold, &got);
		assert_int_equal(got.volumes, (int)stat_of(a, "nodes"));
		assert_int_equal(got.leaves, (int)stat_of(a, "leaves"));
		assert_int_equal(got.prims, (int)stat_of(a, "references"));
		assert_true(stat_of(a, "expected cost") > 1);
		assert_true(stat_of(a, "memory") <= (double)h.book.now);
		accel_close(a);
	}
	assert_int_equal(h.book.now, 0);
	test_host_release(&h);
	mesh_release(&m);
	free(a);
}

/* An argument picks tests by name, * and ? stand for others. */
int main(int argc, char **argv)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_torus),	     cmocka_unit_test(test_objects),
		cmocka_unit_test(test_field),	     cmocka_unit_test(test_soup),
		cmocka_unit_test(test_sheets),	     cmocka_unit_test(test_close_sheets),
		cmocka_unit_test(test_balls),	     cmocka_unit_test(test_exact),
		cmocka_unit_test(test_one),	     cmocka_unit_test(test_counts),
		cmocka_unit_test(test_failed_builds), cmocka_unit_test(test_octree_figures),
		cmocka_unit_test(test_bvh8_figures),
		cmocka_unit_test(test_repeats),
	};

	if (getenv("ALIDADE_TEST_ACCEL"))
		spec[SPECS - 1] = getenv("ALIDADE_TEST_ACCEL");
	if (argc > 1)
		cmocka_set_test_filter(argv[1]);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
