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

#include "base/json.h"

struct text {
	struct json json;
	char *data;
	size_t size;
	FILE *file;
};

static void text_open(struct text *t, enum json_layout layout)
{
	t->file = open_memstream(&t->data, &t->size);
	assert_non_null(t->file);
	json_init(&t->json, t->file, layout);
}

static bool text_is(struct text *t, const char *want)
{
	bool ok = json_finish(&t->json);

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
	text_open(&t, JSON_LINE);
	json_object(&t.json, NULL);
	json_string(&t.json, "kind", "tile");
	json_array(&t.json, "rays");
	json_uint(&t.json, NULL, UINT64_MAX);
	json_int(&t.json, NULL, INT64_MIN);
	json_end(&t.json);
	json_object(&t.json, "none");
	json_end(&t.json);
	json_bool(&t.json, "done", false);
	json_string(&t.json, "gone", NULL);
	json_end(&t.json);
	assert_true(text_is(&t, "{\"kind\": \"tile\", \"rays\": [18446744073709551615, "
				"-9223372036854775808], \"none\": {}, \"done\": false, "
				"\"gone\": null}\n"));
}

static void test_indent(void **state)
{
	struct text t;

	(void)state;
	text_open(&t, JSON_INDENT);
	json_array(&t.json, NULL);
	json_object(&t.json, NULL);
	json_null(&t.json, "a");
	json_end(&t.json);
	json_array(&t.json, NULL);
	json_end(&t.json);
	json_end(&t.json);
	assert_true(text_is(&t, "[\n\t{\n\t\t\"a\": null\n\t},\n\t[]\n]\n"));
}

static void test_text(void **state)
{
	struct text t;

	(void)state;
	text_open(&t, JSON_LINE);
	json_string(
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
		struct json j;
		double back;

		json_init(&j, f, JSON_LINE);
		json_double(&j, NULL, value[i]);
		assert_true(json_finish(&j));
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
	text_open(&t, JSON_LINE);
	json_array(&t.json, NULL);
	json_double(&t.json, NULL, (double)NAN);
	json_double(&t.json, NULL, -(double)INFINITY);
	json_end(&t.json);
	assert_true(text_is(&t, "[null, null]\n"));
}

static void test_misuse(void **state)
{
	struct text t;

	(void)state;
	text_open(&t, JSON_LINE);
	json_object(&t.json, NULL);
	json_null(&t.json, NULL);
	json_end(&t.json);
	assert_false(text_is(&t, ""));
	text_open(&t, JSON_LINE);
	json_array(&t.json, NULL);
	assert_false(text_is(&t, ""));
	text_open(&t, JSON_LINE);
	assert_false(text_is(&t, ""));
	text_open(&t, JSON_LINE);
	for (int i = 0; i < 2 * JSON_DEPTH; i++)
		json_array(&t.json, NULL);
	for (int i = 0; i < 2 * JSON_DEPTH; i++)
		json_end(&t.json);
	assert_false(text_is(&t, ""));
}

static void test_full_disk(void **state)
{
	FILE *f = fopen("/dev/full", "w");
	struct json j;

	(void)state;
	if (!f)
		skip();
	json_init(&j, f, JSON_LINE);
	json_null(&j, NULL);
	assert_false(json_finish(&j));
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
