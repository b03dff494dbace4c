/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/json_write.h"

struct text {
	struct json_writer json;
	char *data;
	size_t size;
	FILE *file;
};

static void text_open(struct text *t, enum jw_layout layout)
{
	t->file = open_memstream(&t->data, &t->size);
	assert_non_null(t->file);
	jw_init(&t->json, t->file, layout);
}

static bool text_is(struct text *t, const char *want)
{
	bool ok = jw_finish(&t->json);

	fclose(t->file);
	if (ok)
		assert_string_equal(t->data, want);
	free(t->data);
	return ok;
}

static void test_line(void **state)
{
	struct text t;

	(void)state;
	text_open(&t, JW_LINE);
	jw_object(&t.json, NULL);
	jw_string(&t.json, "kind", "tile");
	jw_array(&t.json, "rays");
	jw_uint(&t.json, NULL, UINT64_MAX);
	jw_int(&t.json, NULL, INT64_MIN);
	jw_end(&t.json);
	jw_object(&t.json, "none");
	jw_end(&t.json);
	jw_bool(&t.json, "done", false);
	jw_string(&t.json, "gone", NULL);
	jw_end(&t.json);
	assert_true(text_is(&t, "{\"kind\": \"tile\", \"rays\": [18446744073709551615, "
				"-9223372036854775808], \"none\": {}, \"done\": false, "
				"\"gone\": null}\n"));
}

static void test_indent(void **state)
{
	struct text t;

	(void)state;
	text_open(&t, JW_INDENT);
	jw_array(&t.json, NULL);
	jw_object(&t.json, NULL);
	jw_null(&t.json, "a");
	jw_end(&t.json);
	jw_array(&t.json, NULL);
	jw_end(&t.json);
	jw_end(&t.json);
	assert_true(text_is(&t, "[\n\t{\n\t\t\"a\": null\n\t},\n\t[]\n]\n"));
}

static void test_text(void **state)
{
	struct text t;

	(void)state;
	text_open(&t, JW_LINE);
	jw_string(
		&t.json, NULL,
		"\"\\\b\f\n\r\t\x01\x7f/\xc3\xa4\xf0\x9f\x98\x80|\xff\xc3|\xed\xa0\x80|\xc0\x80");
	assert_true(text_is(&t, "\"\\\"\\\\\\b\\f\\n\\r\\t\\u0001\\u007f/\xc3\xa4\xf0\x9f\x98\x80|"
				"\xef\xbf\xbd\xef\xbf\xbd|\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd|"
				"\xef\xbf\xbd\xef\xbf\xbd\"\n"));
}

static void test_numbers(void **state)
{
	static const double value[] = { 0.1, 1.0 / 3.0, DBL_MAX, DBL_MIN, 5e-324, -0.0, 1e21 };
	char *data;
	size_t size;

	(void)state;
	for (size_t i = 0; i < sizeof(value) / sizeof(*value); i++) {
		FILE *f = open_memstream(&data, &size);
		struct json_writer j;
		double back;

		jw_init(&j, f, JW_LINE);
		jw_double(&j, NULL, value[i]);
		assert_true(jw_finish(&j));
		fclose(f);
		back = strtod(data, NULL);
		assert_memory_equal(&back, &value[i], sizeof(back));
		if (!i)
			assert_string_equal(data, "0.1\n");
		free(data);
	}
}

static void test_nonfinite(void **state)
{
	struct text t;

	(void)state;
	text_open(&t, JW_LINE);
	jw_array(&t.json, NULL);
	jw_double(&t.json, NULL, (double)NAN);
	jw_double(&t.json, NULL, -(double)INFINITY);
	jw_end(&t.json);
	assert_true(text_is(&t, "[null, null]\n"));
}

static void test_misuse(void **state)
{
	struct text t;

	(void)state;
	text_open(&t, JW_LINE);
	jw_object(&t.json, NULL);
	jw_null(&t.json, NULL);
	jw_end(&t.json);
	assert_false(text_is(&t, ""));
	text_open(&t, JW_LINE);
	jw_array(&t.json, NULL);
	assert_false(text_is(&t, ""));
	text_open(&t, JW_LINE);
	assert_false(text_is(&t, ""));
	text_open(&t, JW_LINE);
	for (int i = 0; i < 2 * JW_DEPTH; i++)
		jw_array(&t.json, NULL);
	for (int i = 0; i < 2 * JW_DEPTH; i++)
		jw_end(&t.json);
	assert_false(text_is(&t, ""));
}

static void test_full_disk(void **state)
{
	FILE *f = fopen("/dev/full", "w");
	struct json_writer j;

	(void)state;
	if (!f)
		skip();
	jw_init(&j, f, JW_LINE);
	jw_null(&j, NULL);
	assert_false(jw_finish(&j));
	fclose(f);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_line),	 cmocka_unit_test(test_indent),
		cmocka_unit_test(test_text),	 cmocka_unit_test(test_numbers),
		cmocka_unit_test(test_nonfinite), cmocka_unit_test(test_misuse),
		cmocka_unit_test(test_full_disk),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
