/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The reports, with a geometry that has known figures in place of the tracer's.
 */
#include <config.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "accel/verify.h"
#include "look/stats.h"

void geometry_get_counts(const struct geometry *g, struct geometry_counts *c)
{
	(void)g;
	*c = (struct geometry_counts){ .triangles = 3072, .primitives = 3073, .effective_triangles = 6144,
				       .instances = 2, .unbounded = 1, .dropped = 4 };
}

void geometry_get_counters(const struct geometry *g, uint64_t count[ALD_COUNT_MAX])
{
	(void)g;
	count[ALD_COUNT_PRIMS] = 1000;
	count[ALD_COUNT_REPEATS] = 10;
	count[ALD_COUNT_NODES] = 700;
	count[ALD_COUNT_VOLUME_TESTS] = 400;
	count[ALD_COUNT_VOLUME_HITS] = 200;
	count[ALD_COUNT_VOLUME_USEFUL] = 50;
}

int geometry_stat(const struct geometry *g, uint32_t i, const char **name, double *value)
{
	(void)g;
	*name = i ? "depth" : "nodes";
	*value = i ? 4 : 585;
	return i < 2;
}

void geometry_get_trees(const struct geometry *g, struct geometry_trees *t)
{
	(void)g;
	*t = (struct geometry_trees){ .kept = 1, .refitted = 2, .built = 3 };
}

double geometry_build_seconds(const struct geometry *g)
{
	(void)g;
	return 0.25;
}

void geometry_get_memory(const struct geometry *g, struct geometry_memory *m)
{
	(void)g;
	*m = (struct geometry_memory){ .predicted = true, .predicted_most = 3 << 20, .predicted_kept = 2 << 20,
				       .most = 5 << 19, .kept = 3 << 19 };
}

void verify_get(const struct geometry *g, struct verify_counts *c)
{
	(void)g;
	*c = (struct verify_counts){ .every = 0 };
}

int verify_describe(const struct geometry *g, const struct verify_difference *d, char *out, size_t size)
{
	(void)g;
	(void)d;
	(void)size;
	*out = 0;
	return 0;
}

static char *report(bool json)
{
	static const struct render_counts counts = { .cast = { 300, 60, 30, 10 }, .hit = { 200, 20, 15, 5 },
						     .pixels = 300, .samples = 300, .seconds = 0.5 };
	struct mem_book *book = calloc(1, sizeof(*book));
	struct stats s = { .version = "1.2.3", .scene = "a \"b\".pov", .output = "o.png",
			   .options = "20x15 aa none", .accel = "octree:leaf=8", .scene_hash = 0xabc,
			   .process_most = 8 << 20, .threads = 2, .width = 20, .height = 15,
			   .render = &counts, .book = book,
			   .read_seconds = 0.125, .write_seconds = 0.5, .complete = true };
	char *text = NULL;
	size_t size;
	FILE *out = open_memstream(&text, &size);
	void *block;

	assert_non_null(out);
	mem_book_init(book, 0);
	block = mem_alloc(book, "scene", 1 << 20);
	if (json)
		assert_true(stats_json(&s, out));
	else
		stats_text(&s, out);
	fclose(out);
	mem_free(block);
	free(book);
	return text;
}

static void has(const char *text, const char *part)
{
	if (!strstr(text, part))
		fail_msg("\"%s\" is not in\n%s", part, text);
}

static void test_text(void **state)
{
	char *text = report(false);

	(void)state;
	has(text, "alidade 1.2.3: a \"b\".pov, 20x15 aa none, octree:leaf=8, 2 threads\n");
	has(text, "  camera                                 300             200             100   66.7 % hit\n");
	has(text, "  all                                    400             240             160   60.0 % hit\n");
	has(text, "  intersection tests                    1000  2.50 a ray\n");
	has(text, "  volume misses                          200\n");
	has(text, "  volume hits real                      25.0 %\n");
	has(text, "  with all instances                    6144\n");
	has(text, "  degenerate, left out                     4\n");
	has(text, "  nodes                                  585\n  depth                                    4\n");
	has(text, "  scene                                 1.00            1.00\n");
	has(text, "  process                                               8.00\n");
	has(text, "  most, with the scene                  3.00            2.50\n");
	has(text, "  kept, with the scene                  2.00            1.50\n");
	has(text, "  read                                 0.125\n  build                                0.250\n");
	has(text, "  rays per second                        800\n");
	free(text);
}

static void test_json(void **state)
{
	char *text = report(true);

	(void)state;
	has(text, "\"scene\": \"a \\\"b\\\".pov\"");
	has(text, "\"scene_hash\": \"0000000000000abc\"");
	has(text, "\"all\": {\n\t\t\t\"cast\": 400,\n\t\t\t\"hit\": 240,\n\t\t\t\"missed\": 160\n");
	has(text, "\"volume_misses\": 200,\n\t\t\"volume_hits_useful_percent\": 25\n");
	has(text, "\"structure\": {\n\t\t\"nodes\": 585,\n\t\t\"depth\": 4\n");
	has(text, "\"process_most\": 8388608,\n\t\t\"building\": {\n\t\t\t\"predicted_most\": 3145728,\n");
	has(text, "\"purpose\": \"scene\",\n\t\t\t\t\"now\": 1048576,");
	has(text, "\"rays_per_second\": 800\n}\n");
	free(text);
}

int main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(test_text), cmocka_unit_test(test_json) };

	return cmocka_run_group_tests(tests, NULL, NULL);
}
