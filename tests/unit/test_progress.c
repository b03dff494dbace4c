/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include <config.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "look/progress.h"

struct text {
	struct progress progress;
	char *data;
	size_t size;
	FILE *file;
};

static void start(struct text *t, enum progress_mode mode)
{
	t->file = tmpfile();
	assert_non_null(t->file);
	progress_init(&t->progress, mode, t->file);
	t->progress.out = t->file; /* JSON would go to standard output */
}

static void finish(struct text *t, const char *want)
{
	char got[2048];
	size_t n;

	rewind(t->file);
	n = fread(got, 1, sizeof(got) - 1, t->file);
	got[n] = 0;
	fclose(t->file);
	assert_string_equal(got, want);
}

/* A file is no terminal, so auto means lines; a short job leaves none. */
static void test_short(void **state)
{
	struct text t;

	(void)state;
	start(&t, PROGRESS_AUTO);
	assert_int_equal(t.progress.mode, PROGRESS_LINES);
	progress_begin(&t.progress, "rendering", 100);
	for (int i = 1; i <= 10; i++)
		progress_update(&t.progress, (uint64_t)i, 10, 100 + 0.09 * i);
	progress_end(&t.progress, 101);
	finish(&t, "");
}

static void test_lines(void **state)
{
	struct text t;

	(void)state;
	start(&t, PROGRESS_LINES);
	progress_begin(&t.progress, "rendering", 100);
	progress_update(&t.progress, 99, 1000, 104); /* not yet 10 % */
	progress_update(&t.progress, 119, 1000, 105);
	progress_update(&t.progress, 199, 1000, 106); /* the same tenth */
	progress_update(&t.progress, 200, 1000, 116); /* 10 s later */
	progress_update(&t.progress, 999, 1000, 200);
	progress_update(&t.progress, 1000, 1000, 201);
	progress_end(&t.progress, 201);
	finish(&t, "rendering: 11 % after 5 s, about 0:37 left\n"
		   "rendering: 20 % after 16 s, about 1:04 left\n"
		   "rendering: 99 % after 100 s, about 0:00 left\n"
		   "rendering: 100 % after 101 s, about 0:00 left\n");
}

static void test_json(void **state)
{
	struct text t;

	(void)state;
	start(&t, PROGRESS_JSON);
	progress_begin(&t.progress, "rendering", 0);
	progress_update(&t.progress, 1, 4, 1);
	progress_update(&t.progress, 2, 4, 1.1); /* too soon */
	progress_end(&t.progress, 2.5);
	finish(&t, "{\"kind\": \"begin\", \"phase\": \"rendering\", \"elapsed\": 0}\n"
		   "{\"kind\": \"progress\", \"phase\": \"rendering\", \"done\": 1, \"total\": 4, "
		   "\"elapsed\": 1, \"eta\": 3}\n"
		   "{\"kind\": \"end\", \"phase\": \"rendering\", \"elapsed\": 2.5}\n");
}

/* One line that is drawn over, and at the end nothing is left of it. */
static void test_bar(void **state)
{
	struct text t;

	(void)state;
	start(&t, PROGRESS_BAR);
	t.progress.columns = 50;
	progress_begin(&t.progress, "rendering", 0);
	progress_update(&t.progress, 1, 2, 4);
	progress_update(&t.progress, 2, 4, 4.01); /* too soon */
	progress_end(&t.progress, 5);
	progress_erase(&t.progress);
	finish(&t, "\rrendering ..."
		   "\rrendering [########.........]  50 %  0:04 left   "
		   "\r                                                 \r");
}

static void test_none(void **state)
{
	struct text t;

	(void)state;
	start(&t, PROGRESS_NONE);
	progress_begin(&t.progress, "rendering", 0);
	progress_update(&t.progress, 1, 2, 40);
	progress_end(&t.progress, 50);
	finish(&t, "");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_short), cmocka_unit_test(test_lines), cmocka_unit_test(test_json),
		cmocka_unit_test(test_bar),   cmocka_unit_test(test_none),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
