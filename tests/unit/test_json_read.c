/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/json.h"
#include "base/json_read.h"

struct fixture {
	struct mem_book book;
	struct arena arena;
	const char *fault;
};

static int setup(void **state)
{
	struct fixture *f = calloc(1, sizeof(*f));

	mem_book_init(&f->book, 0);
	arena_init(&f->arena, &f->book, "test");
	*state = f;
	return 0;
}

static int teardown(void **state)
{
	struct fixture *f = *state;

	arena_release(&f->arena);
	free(f);
	return 0;
}

static const struct json_value *get(struct fixture *f, const char *text)
{
	/* Exactly as long as it is, so that a tool sees a byte read too far. */
	size_t n = strlen(text);
	char *copy = malloc(n ? n : 1);
	const struct json_value *v;

	memcpy(copy, text, n);
	v = json_read(copy, n, &f->arena, &f->fault);
	free(copy);
	return v;
}

static void test_values(void **state)
{
	struct fixture *f = *state;
	const struct json_value *v = get(f, " { \"a\" : { \"b\": [1, -2.5e3, \"x\"], \"c\": true },\n"
					    "\"ab\": null, \"s\": \"t\" } ");
	const struct json_value *b;

	assert_non_null(v);
	assert_null(f->fault);
	b = json_at(v, "a.b");
	assert_int_equal(b->kind, JSON_ARRAY);
	assert_true(b->child->number == 1 && b->child->next->number == -2500);
	assert_string_equal(b->child->next->next->text, "x");
	assert_null(b->child->next->next->next);
	assert_int_equal(json_at(v, "a.c")->kind, JSON_TRUE);
	assert_int_equal(json_at(v, "ab")->kind, JSON_NULL);
	assert_null(json_at(v, "b"));
	assert_null(json_at(v, "a.b.c"));
	assert_null(json_at(NULL, "a"));
	assert_string_equal(json_text_at(v, "s", ""), "t");
	assert_string_equal(json_text_at(v, "a", "no"), "no");
	assert_true(json_number_at(v, "s", 7) == 7);
}

static void test_text(void **state)
{
	struct fixture *f = *state;

	assert_string_equal(get(f, "\"\\\"\\\\\\/\\b\\f\\n\\r\\t\"")->text, "\"\\/\b\f\n\r\t");
	assert_string_equal(get(f, "\"\\u0041\\u00e9\\u20AC\\ud83d\\ude00z\"")->text,
			    "A\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80z");
	assert_string_equal(get(f, "\"\"")->text, "");
}

static void test_faults(void **state)
{
	static const char *const bad[] = {
		"", " ", "{", "[", "[1", "[1,", "[1,]", "{\"a\"}", "{\"a\":}", "{\"a\":1,}", "{a:1}", "01", "1.",
		".5", "+1", "1e", "1e+", "-", "tru", "nulll", "1 2", "\"", "\"\\", "\"\\x\"", "\"\\u12\"",
		"\"\\u12g4\"", "\"\\ud800\"", "\"\\udc00\"", "\"\\ud800\\u0041\"", "\"a\nb\"", "1e999", "NaN",
		"[1}", "{\"a\" 1}", "\"\\u", "[\"a",
	};
	struct fixture *f = *state;

	for (size_t i = 0; i < sizeof(bad) / sizeof(*bad); i++) {
		if (get(f, bad[i]) || !f->fault)
			fail_msg("taken for JSON: %s", bad[i]);
	}
}

static void test_depth(void **state)
{
	struct fixture *f = *state;
	char text[4 * JSON_DEPTH + 1];

	memset(text, '[', 2 * JSON_DEPTH);
	memset(text + 2 * JSON_DEPTH, ']', 2 * JSON_DEPTH);
	text[4 * JSON_DEPTH] = 0;
	assert_null(get(f, text));
	assert_non_null(get(f, "[[[[[[[[[[]]]]]]]]]]"));
}

/* What the writer writes the reader reads, to the bit. */
static void test_both(void **state)
{
	static const double number[] = { 0, 1, -1.0 / 3, 5e-324, 1.7976931348623157e308, 6.02214076e23 };
	static const char tricky[] = "tab\t \"quoted\" \\ \x01 \xe2\x82\xac";
	struct fixture *f = *state;
	const struct json_value *v, *n;
	struct json j;
	char *data;
	size_t size;
	FILE *out = open_memstream(&data, &size);

	json_init(&j, out, JSON_INDENT);
	json_object(&j, NULL);
	json_string(&j, tricky, tricky);
	json_array(&j, "n");
	for (size_t i = 0; i < sizeof(number) / sizeof(*number); i++)
		json_double(&j, NULL, number[i]);
	json_end(&j);
	json_end(&j);
	assert_true(json_finish(&j));
	fclose(out);
	v = json_read(data, size, &f->arena, &f->fault);
	assert_non_null(v);
	assert_string_equal(v->child->key, tricky);
	assert_string_equal(v->child->text, tricky);
	n = json_at(v, "n")->child;
	for (size_t i = 0; i < sizeof(number) / sizeof(*number); i++, n = n->next)
		assert_memory_equal(&n->number, &number[i], sizeof(double));
	free(data);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_values, setup, teardown),
		cmocka_unit_test_setup_teardown(test_text, setup, teardown),
		cmocka_unit_test_setup_teardown(test_faults, setup, teardown),
		cmocka_unit_test_setup_teardown(test_depth, setup, teardown),
		cmocka_unit_test_setup_teardown(test_both, setup, teardown),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
