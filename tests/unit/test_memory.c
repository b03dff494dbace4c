/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Memory that is said to be needed, and that is: accelerators' predictions against what the host counts, and what a
 * system says is left.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "accel/load.h"
#include "base/room.h"
#include "rays.h"

struct forecast {
	const char *name;
	double kept, peak; /* how much of it a prediction may be off by */
};

static void within(const char *mesh, const char *name, const char *what, double said, double taken, double off)
{
	if (fabs(said - taken) <= off * taken)
		return;
	print_message("%s, %s: %s: %.0f bytes were predicted, %.0f taken\n", mesh, name, what, said, taken);
	fail();
}

static void print_text(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	(void)arg;
	(void)level;
	(void)pos;
	print_message("%s\n", text);
}

static void foretell(const char *mesh, const struct forecast *f, struct mesh *m)
{
	struct diag d = { .sink = print_text };
	ald_error err = { "" };
	ald_memory said = { 0 };
	struct accel_choice c;
	struct test_host h;
	ald_accel *a;

	test_host_init(&h, 2, 0);
	assert_int_equal(accel_load(&c, f->name, &d), STATUS_OK);
	assert_non_null(c.plugin->predict);
	assert_int_equal(c.plugin->predict(&h.host, &m->prims, c.value, &said), ALD_OK);
	assert_int_equal(h.book.now, 0);
	mem_book_mark(&h.book);
	assert_int_equal(c.plugin->build(&h.host, &m->prims, c.value, &a, &err), ALD_OK);
	within(mesh, f->name, "peak", (double)said.peak, (double)h.book.recent, f->peak);
	within(mesh, f->name, "kept", (double)said.kept, (double)h.book.now, f->kept);
	assert_int_equal(said.scratch, c.plugin->scratch_size ? c.plugin->scratch_size(a) : 0);
	c.plugin->destroy(a);
	accel_unload(&c);
	test_host_release(&h);
}

static void foretell_all(const char *mesh, struct mesh *m, const struct forecast *list, size_t n)
{
	for (size_t i = 0; i < n; i++)
		foretell(mesh, &list[i], m);
	mesh_release(m);
}

#define COUNT(list) (sizeof(list) / sizeof(*(list)))

/* What each triangle takes is known. */
static const struct forecast known[] = {
	{ "none", 0.01, 0.01 }, { "box:isa=plain", 0.01, 0.01 }, { "sphere", 0.01, 0.01 },
};

/* Of trees of even meshes. */
static const struct forecast even[] = {
	{ "bvh8", 0.1, 0.06 },
	{ "bvh8:split=1,leaf=4", 0.1, 0.06 },
	{ "bvh8:leaf=1", 0.1, 0.1 },
	{ "bvh8:build=fast", 0.15, 0.1 },
	{ "bvh8:build=fast,leaf=1", 0.1, 0.1 },
/* LeakSanitizer crashes now and then where it stops TBB's threads. */
#if defined HAVE_EMBREE && !defined __SANITIZE_ADDRESS__
	{ "embree", 0.35, 0.35 }, { "embree:quality=low", 0.35, 0.35 }, /* which takes it in large pieces */
#endif
};

static void make_torus(struct mesh *m)
{
	*m = (struct mesh){ 0 };
	mesh_torus(m, (ald_vec){ 0.1, 0.2, -0.3 }, 1, 0.25, 200, 100);
	mesh_finish(m, false, false, false);
}

static void test_torus(void **state)
{
	struct mesh m;

	(void)state;
	make_torus(&m);
	foretell_all("torus", &m, known, COUNT(known));
	make_torus(&m);
	foretell_all("torus", &m, even, COUNT(even));
}

static void test_field(void **state)
{
	struct mesh m = { 0 };

	(void)state;
	mesh_field(&m, 200, 10, 1, 3);
	mesh_finish(&m, true, false, false);
	foretell_all("field", &m, even, COUNT(even));
}

/* Triangles on a stage of two large ones, which a sample may miss. */
static void test_stage(void **state)
{
	static const struct forecast list[] = { { "bvh8", 0.1, 0.06 } };
	struct mesh m = { 0 };

	(void)state;
	mesh_sheets(&m, 1, 1, 0);
	mesh_torus(&m, (ald_vec){ 0, 0, 0 }, 0.05, 0.01, 200, 100);
	mesh_finish(&m, false, false, false);
	foretell_all("stage", &m, list, COUNT(list));
}

/* Triangles that are cut, and of which a twelfth can't be hit. How many parts pay shows only in building; there has to
 * be room for them all. */
static void test_soup(void **state)
{
	static const struct forecast list[] = {
		{ "bvh8", 0.4, 0.1 }, { "bvh8:split=1", 0.1, 0.1 }, { "bvh8:split=2", 0.4, 0.1 },
		{ "bvh8:build=fast", 0.15, 0.1 }, { "none", 0.01, 0.01 },
	};
	struct mesh m = { 0 };

	(void)state;
	mesh_soup(&m, 50000, 1, 0.12, 3);
	mesh_finish(&m, false, false, false);
	foretell_all("soup", &m, list, COUNT(list));
}

static void test_mixed(void **state)
{
	static const struct forecast list[] = {
		{ "none", 0.01, 0.01 }, { "box", 0.01, 0.01 }, { "sphere", 0.01, 0.01 }, { "bvh8", 0.2, 0.2 },
		{ "bvh8:build=fast", 0.2, 0.2 },
	};
	struct mesh m = { 0 };

	(void)state;
	for (unsigned i = 0; i < 12; i++)
		mesh_torus(&m, (ald_vec){ i % 3, i / 3, i % 5 * 0.2 }, 0.3, 0.1, 60, 30);
	mesh_balls(&m, 10000, 0.01, 7);
	mesh_finish(&m, false, true, false);
	foretell_all("tori and balls", &m, list, COUNT(list));
}

static void test_nothing(void **state)
{
	static const struct forecast list[] = { { "none", 0.01, 0.01 }, { "bvh8", 0.01, 0.1 } };
	struct mesh m = { 0 };

	(void)state;
	mesh_group(&m);
	mesh_finish(&m, false, false, false);
	foretell_all("nothing", &m, list, COUNT(list));
}

/* ---- what is left ---- */

static void put(const char *root, const char *path, const char *text)
{
	char name[512], *slash;
	FILE *f;

	snprintf(name, sizeof(name), "%s%s", root, path);
	for (slash = strchr(name + strlen(root) + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
		*slash = 0;
		mkdir(name, 0700);
		*slash = '/';
	}
	f = fopen(name, "w");
	assert_non_null(f);
	fputs(text, f);
	fclose(f);
}

static void left(const char *root, uint64_t bytes, const char *what)
{
	struct room r;

	room_find(&r, root);
	assert_int_equal(r.bytes, bytes);
	assert_string_equal(r.what, what);
}

static void test_room(void **state)
{
	static const char cgroup[] = "of what its control group allows";
	char root[] = "/tmp/alidade-room.XXXXXX", command[64];

	(void)state;
	assert_non_null(mkdtemp(root));
	put(root, "/proc/meminfo", "MemTotal:  9000 kB\nMemFree:  1000 kB\nMemAvailable:   4000 kB\n");
	left(root, 4000 << 10, "on this machine");
	/* Version 2: the group has no limit of its own, the one above it has. Pages of files count as left. */
	put(root, "/proc/self/cgroup", "0::/above/own\n");
	put(root, "/sys/fs/cgroup/above/own/memory.max", "max\n");
	put(root, "/sys/fs/cgroup/above/own/memory.current", "1000\n");
	left(root, 4000 << 10, "on this machine");
	put(root, "/sys/fs/cgroup/above/memory.max", "3000000\n");
	put(root, "/sys/fs/cgroup/above/memory.current", "2000000\n");
	put(root, "/sys/fs/cgroup/above/memory.stat", "anon 5\ninactive_file 500000\nactive_file 9\n");
	left(root, 1500000, cgroup);
	put(root, "/sys/fs/cgroup/above/memory.current", "4000000\n");
	put(root, "/sys/fs/cgroup/above/memory.stat", "");
	left(root, 0, cgroup);
	/* Version 1, from inside a container: the path is not there, the mount is its own group. */
	put(root, "/proc/self/cgroup", "5:cpu:/\n4:cpuset,memory:/x\n3:memory:/docker/abc\n");
	put(root, "/sys/fs/cgroup/memory/memory.limit_in_bytes", "2000000\n");
	put(root, "/sys/fs/cgroup/memory/memory.usage_in_bytes", "1500000\n");
	put(root, "/sys/fs/cgroup/memory/memory.stat", "cache 5\ntotal_inactive_file 100\n");
	left(root, 500100, cgroup);
	put(root, "/proc/meminfo", "MemAvailable:   7 kB\n");
	left(root, 7 << 10, "on this machine");
	snprintf(command, sizeof(command), "rm -rf %s", root);
	assert_int_equal(system(command), 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_torus), cmocka_unit_test(test_field),   cmocka_unit_test(test_stage),
		cmocka_unit_test(test_soup),  cmocka_unit_test(test_mixed),   cmocka_unit_test(test_nothing),
		cmocka_unit_test(test_room),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
