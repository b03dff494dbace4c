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

#include "base/options.h"

static const struct option_spec table[] = {
	{ "output", 'o', OPTION_ARG, "FILE", COMPLETE_FILE, NULL, "write there; or not", "Group" },
	{ "stats", 300, OPTION_MAYBE_ARG, "FILE", COMPLETE_FILE, NULL, "count: it's [free]", NULL },
	{ "quiet", 'q', OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL, "say nothing", NULL },
	{ "how", 301, OPTION_ARG, "HOW", COMPLETE_WORDS, "auto bar", "choose", "Other" },
	{ "secret", 302, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL, NULL, NULL },
	{ 0 },
};
static const struct option_program program = { "prog-x", "FILE", "Do it", "pov ini", table };

/* What was set, as "output=a;quiet;" */
struct log {
	char set[256], message[512];
};

static enum status note(void *arg, const struct option_spec *o, const char *value, struct diag *d)
{
	struct log *log = arg;
	size_t n = strlen(log->set);

	(void)d;
	snprintf(log->set + n, sizeof(log->set) - n, "%s%s%s;", o->name, value ? "=" : "", value ? value : "");
	return STATUS_OK;
}

static void hear(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	struct log *log = arg;

	(void)level;
	(void)pos;
	snprintf(log->message, sizeof(log->message), "%s", text);
}

static enum status parse(struct log *log, const char *line, int *operand)
{
	struct diag d = { hear, log, 0, 0 };
	static char text[256];
	char *argv[16] = { "prog-x" }, *save = NULL;
	int argc = 1;

	memset(log, 0, sizeof(*log));
	snprintf(text, sizeof(text), "%s", line);
	for (char *w = strtok_r(text, " ", &save); w; w = strtok_r(NULL, " ", &save))
		argv[argc++] = w;
	return options_parse(&program, argc, argv, note, log, operand, &d);
}

static void test_parse(void **state)
{
	struct log log;
	int operand;

	(void)state;
	assert_int_equal(parse(&log, "a -qo b --stats --stats=c --how=bar --secret d", &operand), STATUS_OK);
	assert_string_equal(log.set, "quiet;output=b;stats;stats=c;how=bar;secret;");
	assert_int_equal(operand, 7);
	assert_int_equal(parse(&log, "-- -q", &operand), STATUS_OK);
	assert_string_equal(log.set, "");
	assert_int_equal(operand, 2);
}

static void test_mistakes(void **state)
{
	static const struct {
		const char *line, *message;
	} wrong[] = {
		{ "--ouptut=x", "there is no option --ouptut; did you mean --output?" },
		{ "--nothing-like-it", "there is no option --nothing-like-it; see prog-x --help" },
		{ "-q -z", "there is no option -z; see prog-x --help" },
		{ "--s", "--s could be one of 2 options; see prog-x --help" },
		{ "-o", "option -o needs a value: --output=FILE" },
		{ "--quiet=x", "option --quiet takes no value" },
	};
	struct log log;
	int operand;

	(void)state;
	for (size_t i = 0; i < sizeof(wrong) / sizeof(*wrong); i++) {
		assert_int_equal(parse(&log, wrong[i].line, &operand), STATUS_USAGE);
		assert_string_equal(log.message, wrong[i].message);
	}
}

static char *written(const char *shell)
{
	char *text = NULL;
	size_t size;
	FILE *out = open_memstream(&text, &size);

	assert_non_null(out);
	if (shell)
		assert_true(options_completion(&program, shell, out));
	else
		options_help(&program, out);
	fclose(out);
	return text;
}

static void test_help(void **state)
{
	char *text = written(NULL);

	(void)state;
	assert_string_equal(text, "Usage: prog-x [option ...] FILE\nDo it.\n"
				  "\nGroup:\n"
				  "  -o, --output=FILE         write there; or not\n"
				  "      --stats[=FILE]        count: it's [free]\n"
				  "  -q, --quiet               say nothing\n"
				  "\nOther:\n"
				  "      --how=HOW             choose\n");
	free(text);
}

static void test_completion(void **state)
{
	char *text = written("zsh");

	(void)state;
	assert_non_null(strstr(text, "#compdef prog-x\n"));
	assert_non_null(strstr(text, "\\*{-o+,--output=}'[write there]:FILE:_files'"));
	assert_non_null(strstr(text, "'*--stats=-[count\\: it'\\''s \\[free\\]]::FILE:_files'"));
	assert_null(strstr(text, "secret"));
	free(text);
	text = written("fish");
	assert_non_null(strstr(text, "complete -c prog-x -s o -l output -d 'write there' -r -F\n"));
	assert_non_null(strstr(text, "complete -c prog-x -l how -d 'choose' -x -a 'auto bar'\n"));
	free(text);
	text = written("bash");
	assert_non_null(strstr(text, "complete -F _prog_x prog-x\n"));
	assert_non_null(strstr(text, "'--output= --stats --quiet --how= '"));
	free(text);
	assert_false(options_completion(&program, "csh", stdout));
}

static void test_numbers(void **state)
{
	uint64_t n;
	double x;

	(void)state;
	assert_true(option_integer("18446744073709551615", 0, UINT64_MAX, &n) && n == UINT64_MAX);
	assert_false(option_integer("18446744073709551616", 0, UINT64_MAX, &n));
	assert_false(option_integer("-1", 0, UINT64_MAX, &n));
	assert_false(option_integer(" 1", 0, 9, &n));
	assert_false(option_integer("1x", 0, 9, &n));
	assert_false(option_integer("", 0, 9, &n));
	assert_false(option_integer("0", 1, 9, &n));
	assert_true(option_real("-1.5e1", -20, 0, &x) && x == -15);
	assert_false(option_real("nan", -1, 1, &x));
	assert_false(option_real("inf", -1, 1, &x));
	assert_false(option_real("1.", 2, 3, &x));
	assert_false(option_real("", 0, 1, &x));
	assert_true(option_bytes("512", &n) && n == 512);
	assert_true(option_bytes("3.5G", &n) && n == 7ull << 29);
	assert_true(option_bytes("2k", &n) && n == 2048);
	assert_false(option_bytes("1MB", &n));
	assert_false(option_bytes("1Q", &n));
	assert_false(option_bytes("99999999T", &n));
	assert_false(option_bytes("-1K", &n));
}

static void test_extent(void **state)
{
	uint32_t w, h;

	(void)state;
	assert_true(option_extent("640x480", 1000, &w, &h) && w == 640 && h == 480);
	assert_false(option_extent("640x", 1000, &w, &h));
	assert_false(option_extent("x480", 1000, &w, &h));
	assert_false(option_extent("640", 1000, &w, &h));
	assert_false(option_extent("640x480x1", 1000, &w, &h));
	assert_false(option_extent("0x480", 1000, &w, &h));
	assert_false(option_extent("1001x1", 1000, &w, &h));
	assert_false(option_extent("00000000000000000000001x1", 1000, &w, &h));
}

static void test_pairs(void **state)
{
	const char *cursor = "a=1,b,c=x=y";
	struct option_pair p;

	(void)state;
	assert_true(option_next_pair(&cursor, &p));
	assert_string_equal(p.key, "a");
	assert_string_equal(p.value, "1");
	assert_true(option_next_pair(&cursor, &p));
	assert_string_equal(p.key, "b");
	assert_string_equal(p.value, "");
	assert_true(option_next_pair(&cursor, &p));
	assert_string_equal(p.key, "c");
	assert_string_equal(p.value, "x=y");
	assert_false(option_next_pair(&cursor, &p));
	cursor = NULL;
	assert_false(option_next_pair(&cursor, &p));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_parse),	   cmocka_unit_test(test_mistakes),
		cmocka_unit_test(test_help),	   cmocka_unit_test(test_completion),
		cmocka_unit_test(test_numbers),	   cmocka_unit_test(test_extent),
		cmocka_unit_test(test_pairs),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
