/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's builders: one tree whoever made it, and input that they could stumble over.
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

/* The tree is large enough for the parallel part; the same whoever made it. */
static void test_threads(void **state)
{
	static const uint32_t threads[] = { 1, 2, 5 };
	static const char *const name[] = { "bvh8", "bvh8:build=fast", "bvh8:build=fast,isa=plain" };
	struct accel *a = malloc(sizeof(*a));
	struct mesh m = { 0 };
	struct test_host h;
	uint64_t before = 0;

	(void)state;
	mesh_field(&m, 130, 10, 1, 3);
	mesh_triangle(&m, 0, 1, 0); /* nobody hits this one */
	mesh_soup(&m, 20000, 5, 1, 11);
	mesh_torus(&m, (ald_vec){ 1, 2, 3 }, 1e-3, 2e-4, 80, 60); /* each in a cell of the first curve */
	mesh_torus(&m, (ald_vec){ -3, 2, 1 }, 1e-3, 2e-4, 200, 100);
	mesh_finish(&m, false, false, false);
	for (unsigned k = 0; k < sizeof(name) / sizeof(name[0]); k++) {
		uint64_t sum[4] = { 0 };

		for (unsigned i = 0; i < 4; i++) {
			test_host_init(&h, threads[i % 3], 0);
			m.prims.size = i < 3 ? (uint32_t)sizeof(m.prims) : offsetof(ald_prims, box); /* an older host */
			accel_open(a, name[k], &h, &m);
			a->choice.plugin->walk(a->it, NULL, fold_volume, &sum[i]);
			accel_close(a);
			test_host_release(&h);
			assert_true(sum[i] == sum[0]);
		}
		if (k == 2) /* one tree for all instruction sets */
			assert_true(sum[0] == before);
		before = sum[0];
	}
	mesh_release(&m);
	free(a);
}

static void same_hits(const char *mesh, const char *spec, struct mesh *m)
{
	struct accel *none = malloc(sizeof(*none)), *fast = malloc(sizeof(*fast));
	ald_ray *ray = malloc(BATCH * sizeof(*ray));
	struct test_host h;

	mesh_finish(m, false, false, false);
	test_host_init(&h, 2, 0);
	accel_open(none, "none", &h, m);
	accel_open(fast, spec, &h, m);
	for (uint32_t i = 0; i < BATCH; i++)
		ray_make(m, 1, i, &ray[i]);
	ask(none, ray, BATCH, ASK_PIECES, 0);
	ask(fast, ray, BATCH, ASK_PIECES, 0);
	compare(mesh, spec, none, fast, ray, BATCH);
	accel_close(none);
	accel_close(fast);
	assert_int_equal(h.book.now, 0);
	test_host_release(&h);
	mesh_release(m);
	*m = (struct mesh){ 0 };
	free(none);
	free(fast);
	free(ray);
}

/* Rays that see all there is go another way than those that do not, and whole batches do: of many sorts of primitives,
 * more than are noted. */
static void test_masks(void **state)
{
	static const uint32_t sorts[] = { 1, 3, 8, 9 }, seen[][2] = {
		{ 7, 7 }, { 3, 3 }, { 3, 7 }, { 0, 0 }, { 7, 0 }, { UINT32_MAX, UINT32_MAX }, { UINT32_MAX, 1 },
	};
	struct accel *none = malloc(sizeof(*none)), *other = malloc(sizeof(*other));
	ald_ray *ray = malloc(BATCH * sizeof(*ray));
	struct mesh m = { 0 };
	struct test_host h;

	(void)state;
	mesh_soup(&m, 500, 1, 1, 11);
	mesh_finish(&m, false, true, false);
	test_host_init(&h, 1, 0);
	for (unsigned k = 0; k < 4; k++) {
		for (uint32_t i = 0; i < m.prims.count; i++)
			m.mask[i] = 1u << i % sorts[k];
		accel_open(none, "none", &h, &m);
		accel_open(other, "bvh8", &h, &m);
		for (unsigned j = 0; j < sizeof(seen) / sizeof(seen[0]); j++) {
			for (uint32_t i = 0; i < BATCH; i++) {
				ray_make(&m, 1, i, &ray[i]);
				ray[i].mask = seen[j][i % 701 == 700];
			}
			ask(none, ray, BATCH, ASK_ALL, 0);
			ask(other, ray, BATCH, ASK_ALL, 0);
			compare("soup of many sorts", "bvh8", none, other, ray, BATCH);
		}
		accel_close(other);
		accel_close(none);
	}
	test_host_release(&h);
	mesh_release(&m);
	free(none);
	free(other);
	free(ray);
}

/* From beside a triangle to its middle. */
static void aim_at(const struct mesh *m, uint32_t id, ald_ray *r)
{
	ald_vec v[3], e, f, n, to;
	double size;

	ald_corners(&m->prims, id, 0, v);
	e = (ald_vec){ v[1].x - v[0].x, v[1].y - v[0].y, v[1].z - v[0].z };
	f = (ald_vec){ v[2].x - v[0].x, v[2].y - v[0].y, v[2].z - v[0].z };
	n = (ald_vec){ e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x };
	size = 0.1 * sqrt(e.x * e.x + e.y * e.y + e.z * e.z) / sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
	to = (ald_vec){ v[0].x + (e.x + f.x) / 3, v[0].y + (e.y + f.y) / 3, v[0].z + (e.z + f.z) / 3 };
	*r = (ald_ray){ .org = { to.x + size * n.x, to.y + size * n.y, to.z + size * n.z },
			.dir = { -size * n.x, -size * n.y, -size * n.z },
			.tmax = 2, .mask = UINT32_MAX, .skip = ALD_NONE, .after = ALD_NONE };
}

/* What is small adds nothing to what large things cost: whatever way it is split costs the same. */
static void test_small_in_large(void **state)
{
	static const char *const spec[] = { "bvh8:build=sah", "bvh8:build=sah,leaf=1", "bvh8:build=fast" };
	struct accel *none = malloc(sizeof(*none)), *other = malloc(sizeof(*other));
	ald_ray *ray = malloc(BATCH * sizeof(*ray));
	struct mesh m = { 0 };
	struct test_host h;

	(void)state;
	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1e15, 2.5e14, 30, 20);
	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1, 0.25, 30, 20);
	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1e-20, 2.5e-21, 30, 20);
	mesh_finish(&m, false, false, false);
	test_host_init(&h, 2, 0);
	accel_open(none, "none", &h, &m);
	for (unsigned k = 0; k < 3; k++) {
		accel_open(other, spec[k], &h, &m);
		for (uint32_t first = 0; first < m.prims.count; first += BATCH) {
			uint32_t n = m.prims.count - first < BATCH ? m.prims.count - first : BATCH;

			for (uint32_t i = 0; i < n; i++)
				aim_at(&m, first + i, &ray[i]);
			ask(none, ray, n, ASK_ALL, 0);
			ask(other, ray, n, ASK_ALL, 0);
			compare("tori in each other", spec[k], none, other, ray, n);
			for (uint32_t i = 0; i < n; i++)
				assert_int_equal(other->hit[i].prim, first + i);
		}
		accel_close(other);
	}
	accel_close(none);
	test_host_release(&h);
	mesh_release(&m);
	free(none);
	free(other);
	free(ray);
}

/* Batches of mostly short rays, of any size, of which some hit what they were aimed at, and some see far: through boxes
 * of thousands of needles, of which they hit few. */
static void test_short(void **state)
{
	static const char *const spec[] = { "bvh8", "bvh8:build=fast", "bvh8:isa=avx2" };
	static const double reach[] = { 2, 1e30, 1.0001, 1e30, 0.9999, 0.5, 1e30 };
	struct accel *none = malloc(sizeof(*none)), *other = malloc(sizeof(*other));
	ald_ray *ray = malloc(BATCH * sizeof(*ray));
	struct mesh m = { 0 };
	struct test_host h;

	(void)state;
	mesh_soup(&m, 2000, 1, 0.1, 4);
	mesh_group(&m);
	for (unsigned i = 0; i < 4000; i++) {
		double x = i % 63 * 0.016, y = i % 61 * 0.016, z = i % 59 * 0.016;

		mesh_triangle(&m, mesh_vertex(&m, x, y, z), mesh_vertex(&m, x + 1e-5, y, z),
			      mesh_vertex(&m, x + 0.7, y + 0.8, z + 0.9));
	}
	mesh_finish(&m, false, false, false);
	test_host_init(&h, 2, 0);
	accel_open(none, "none", &h, &m);
	for (uint32_t i = 0; i < BATCH; i++) {
		aim_at(&m, i < BATCH / 2 ? i * 3 : 2000 + i, &ray[i]);
		ray[i].tmax = reach[i % 7];
		ray[i].skip = i % 11 == 0 ? i * 3 : ALD_NONE;
	}
	for (unsigned k = 0; k < 3; k++) {
		accel_open(other, spec[k], &h, &m);
		for (uint32_t first = 0, n = 16; first + n <= BATCH; first += n, n += 1 + n / 3) {
			ask(none, ray + first, n, ASK_ALL, 0);
			ask(other, ray + first, n, ASK_ALL, 0);
			compare("short rays", spec[k], none, other, ray + first, n);
		}
		accel_close(other);
	}
	accel_close(none);
	test_host_release(&h);
	mesh_release(&m);
	free(none);
	free(other);
	free(ray);
}

/* Trees of all sizes: what one pass over them has decided the next one has to find again. */
static void test_sizes(void **state)
{
	static const char *const spec[] = { "bvh8:build=sah", "bvh8:build=sah,leaf=1", "bvh8:build=sah,split=2",
					    "bvh8:build=fast" };
	struct mesh m = { 0 };
	char name[40];

	(void)state;
	for (uint32_t i = 1; i <= 64; i += FEWER) {
		uint32_t n = i * i / 6 + 3;

		snprintf(name, sizeof(name), "%u", i);
		if (i % 3 == 0)
			mesh_sheets(&m, 2 + i / 3, 1 + i % 5, i % 2 ? 0x1p-22 : 0.01);
		else if (i % 3 == 1)
			mesh_soup(&m, n, 1, i % 2 ? 0.05 : 2, i);
		else
			mesh_field(&m, 2 + i / 3, 10, i % 2 ? 1 : 0.01, i);
		same_hits(name, spec[i / 3 % 4], &m);
	}
}

/* Far more in one place than a job takes, and nothing to sort by; sizes from 1 to 1e13, each next to a
 * smaller one; a small thing in a large scene; large numbers, and such as are none. */
static void test_fast_extremes(void **state)
{
	struct mesh m = { 0 };
	uint32_t a, b;
	double size = 1;

	(void)state;
	mesh_group(&m);
	a = mesh_vertex(&m, 0.5, 0, 0);
	b = mesh_vertex(&m, 0, 0.5, 0.25);
	for (unsigned i = 0; i < 5000; i++)
		mesh_triangle(&m, a, b, mesh_vertex(&m, 0, 0, 1e-3 * (i / 1000)));
	same_hits("one place", "bvh8:build=fast", &m);

	mesh_group(&m);
	for (unsigned i = 0; i < 3000; i++, size *= 1.01)
		mesh_triangle(&m, mesh_vertex(&m, size, 0, 0), mesh_vertex(&m, size * 1.01, size, 0),
			      mesh_vertex(&m, size, 0, size));
	same_hits("growing", "bvh8:build=fast", &m);

	mesh_torus(&m, (ald_vec){ 1, 2, 3 }, 1e-3, 2e-4, 80, 60);
	mesh_soup(&m, 500, 100, 40, 5);
	same_hits("small in large", "bvh8:build=fast", &m);

	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1e150, 2e149, 40, 30);
	mesh_triangle(&m, 0, 1, mesh_vertex(&m, (double)NAN, 0, 0));
	mesh_triangle(&m, 0, 1, 0);
	same_hits("huge", "bvh8:build=fast", &m);
}

/* Which builder it is that takes so many rays to a triangle. */
static bool is_fast(const struct mesh *m, const char *accel, double rays, uint32_t size)
{
	struct accel *a = malloc(sizeof(*a));
	const char *name = "";
	double value = -1;
	struct test_host h;

	test_host_init(&h, 1, 0);
	h.host.rays = rays * m->prims.count;
	h.host.size = size;
	assert_int_equal(accel_open(a, accel, &h, m), ALD_OK);
	for (uint32_t i = 0; strcmp(name, "built fast") != 0; i++)
		assert_true(a->choice.plugin->stat(a->it, i, &name, &value));
	accel_close(a);
	test_host_release(&h);
	free(a);
	return value != 0;
}

/* Few rays: soon; many: well; an older host, or one that doesn't know: well. Long thin triangles: well. */
static void test_choice(void **state)
{
	struct mesh m = { 0 };
	uint32_t size = sizeof(ald_host);

	(void)state;
	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 1, 0.3, 80, 60);
	mesh_finish(&m, false, false, false);
	assert_true(is_fast(&m, "bvh8", 1, size));
	assert_false(is_fast(&m, "bvh8", 100, size));
	assert_false(is_fast(&m, "bvh8", 0, size));
	assert_false(is_fast(&m, "bvh8", 1, offsetof(ald_host, rays)));
	assert_false(is_fast(&m, "bvh8:build=sah", 1, size));
	assert_true(is_fast(&m, "bvh8:build=fast", 100, size));
	mesh_release(&m);

	m = (struct mesh){ 0 };
	mesh_group(&m);
	for (unsigned i = 0; i < 3000; i++) {
		double x = i % 50 * 0.02, y = i / 50 * 0.02;

		mesh_triangle(&m, mesh_vertex(&m, x, y, 0), mesh_vertex(&m, x + 0.01, y, 0),
			      mesh_vertex(&m, x + 0.7, y + 0.8, 0.9));
	}
	mesh_finish(&m, false, false, false);
	assert_false(is_fast(&m, "bvh8", 3, size));
	assert_true(is_fast(&m, "bvh8", 0.5, size));
	assert_true(is_fast(&m, "bvh8:split=1", 3, size));
	mesh_release(&m);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_threads),
		cmocka_unit_test(test_masks),
		cmocka_unit_test(test_small_in_large),
		cmocka_unit_test(test_short),
		cmocka_unit_test(test_sizes),
		cmocka_unit_test(test_fast_extremes),
		cmocka_unit_test(test_choice),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
