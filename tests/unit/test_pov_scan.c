/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Scanning plain lists: the same numbers as the C library gives, and nothing that is not plain.
 */
#include <config.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "read/pov/scan.h"

static uint64_t state = 88172645463325252u;

static uint64_t next_random(void)
{
	state ^= state << 13;
	state ^= state >> 7;
	state ^= state << 17;
	return state;
}

/* A decimal of a random form: what exporters write, and the hard ones. */
static void random_decimal(char *out, size_t size)
{
	uint64_t r = next_random(), m = next_random();
	union {
		uint64_t bits;
		double x;
	} any = { .bits = m };

	switch (r % 8) {
	case 0:
		snprintf(out, size, "%.6f", ((double)m / 1.8e19 - 0.5) * 200);
		break;
	case 1:
		snprintf(out, size, "%lld", (long long)m >> (r >> 8 & 63));
		break;
	case 2:
		snprintf(out, size, "%.*g", (int)(r >> 8 & 15) + 3, ((double)m / 1.8e19 - 0.5) * 1e4);
		break;
	case 3:
		if (!(fabs(any.x) < 1e308)) /* rounded it might be infinite */
			any.x = 0.1;
		snprintf(out, size, "%.*g", (int)(r >> 8 & 15) + 3, any.x);
		break;
	case 4: /* many digits in front of and behind the point */
		snprintf(out, size, "%llu.%llu", (unsigned long long)(m >> (r >> 8 & 63)),
			 (unsigned long long)(r >> 20));
		break;
	case 5: /* halves between two doubles, nearly */
		snprintf(out, size, "%llu.5", (unsigned long long)((m >> 11) | 1ull << 52));
		break;
	case 6:
		snprintf(out, size, "%s.%0*llu", r & 256 ? "-" : "", (int)(r >> 9 & 15) + 1,
			 (unsigned long long)(m % 100000));
		break;
	default:
		snprintf(out, size, "%.*f", (int)(r >> 8 & 31), ((double)m / 1.8e19 - 0.5));
	}
}

static void same(double got, const char *text)
{
	double want = strtod(text, NULL);

	if (memcmp(&got, &want, sizeof(got)) != 0)
		fail_msg("%s gave %.17g, not %.17g", text, got, want);
}

static void test_numbers(void **unused)
{
	const char *end;
	char text[400], a[100], b[100], c[100];
	double v[3];
	long count = getenv("ALIDADE_ALL") ? 33400000 : 100000; /* three numbers each */

	(void)unused;
	for (long i = 0; i < count; i++) {
		random_decimal(a, sizeof(a));
		random_decimal(b, sizeof(b));
		random_decimal(c, sizeof(c));
		/* With and without enough bytes behind it for the fast way. */
		snprintf(text, sizeof(text), " <%s, %s,%s>,%*s<", a, b, c, i & 1 ? 100 : 0, "");
		end = scan_vector(text, text + strlen(text), v);
		if (!end)
			fail_msg("%s was not read", text);
		assert_int_equal(end[-1], ',');
		same(v[0], a);
		same(v[1], b);
		same(v[2], c);
	}
}

static const char *vector(const char *text, double v[3])
{
	return scan_vector(text, text + strlen(text), v);
}

#define PADDING "                                                                 "

static void test_vectors(void **unused)
{
	static const char *const good[] = {
		"<1,2,3>,<", "<1,2,3>}", "<1,2,3> <4", "\r\n\t< 1 , 2 ,\n3 >,", "<+1,2.,3.0e0>,",
		"// comment\n<1,/* another */2,3>,", "<1,2,3>/* no comma */<", "<1.,2.0,3>,",
	};
	static const char *const bad[] = {
		"", "<", "<1,2,3", "<1,2,3>", "<1,2>,", "<1,2,3,4>,", "<1,2,x>,", "<1,2,3>*2,",
		"<1,2,3>.x,", "<1,2,3>-<1,1,1>,", "<1,2,3>+1,", "#<1,2,3>,", "<1,2,1e400>,", "<1,2,nan>,",
		"<1,2,inf>,", "<1,2,-1e999>,", "<1 2 3>,", "<1-1,2,3>,", "<1,2,3x>,", "<.,2,3>,", "<1,2,->,",
		"<1,2,0x10>,", "<1,2,3 /* open >,", "<1,2,3> /* /* nested */ */,", "A,<1,2,3>,", "<--1,2,3>,",
	};
	char text[200];
	double v[3];

	(void)unused;
	for (size_t i = 0; i < sizeof(good) / sizeof(good[0]); i++) {
		for (int pad = 0; pad < 2; pad++) {
			snprintf(text, sizeof(text), "%s%s", good[i], pad ? PADDING : "");
			if (!vector(text, v))
				fail_msg("'%s' was not read", text);
			assert_true(v[0] == 1 && v[1] == 2 && v[2] == 3);
		}
	}
	for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
		for (int pad = 0; pad < 2; pad++) {
			snprintf(text, sizeof(text), "%s%s", bad[i], pad ? PADDING : "");
			if (vector(text, v))
				fail_msg("'%s' was read", text);
		}
	}
}

/* Nothing beyond end may decide anything. */
static void test_ends(void **unused)
{
	const char *text = "<11,22,33>,<";
	double v[3];

	(void)unused;
	for (size_t n = 0; n < 11; n++)
		assert_null(scan_vector(text, text + n, v));
	assert_non_null(scan_vector(text, text + 11, v));
}

static void test_faces(void **unused)
{
	static const struct {
		const char *text;
		int count; /* -1: not read */
		uint32_t extra[3];
	} row[] = {
		{ "<7,8,9>,<", 0, { 0 } },
		{ "<7,8,9>}", 0, { 0 } },
		{ "<7,8,9>,5,<", 1, { 5 } },
		{ "<7,8,9>,5}", 1, { 5 } },
		{ "<7,8,9>5,<", 1, { 5 } },
		{ "<7,8,9>, 5, 6, 7, <", 3, { 5, 6, 7 } },
		{ "<7,8,9>,5,6,7}", 3, { 5, 6, 7 } },
		{ "<7,8,9>,5,6,<", 2, { 5, 6 } },
		{ "<7,8,9>,5,6,7,8,<", -1, { 0 } },
		{ "<7,8,9>,NAME,<", -1, { 0 } },
		{ "<7,8,9>,5+1,<", -1, { 0 } },
		{ "<7,8,9>,5", -1, { 0 } },
		{ "<7,8,9>,", -1, { 0 } },
		{ "<7,8,-9>,<", -1, { 0 } },
		{ "<7,8,9.0>,<", -1, { 0 } },
		{ "<7,8,4294967295>,<", -1, { 0 } },
		{ "<7,8,99999999999999999999>,<", -1, { 0 } },
	};
	uint32_t v[3], extra[3];
	int count;

	(void)unused;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++) {
		const char *text = row[i].text;
		const char *end = scan_face(text, text + strlen(text), v, extra, &count);

		if (!end != (row[i].count < 0))
			fail_msg("'%s' was%s read", text, end ? "" : " not");
		if (!end)
			continue;
		assert_int_equal(count, row[i].count);
		assert_true(v[0] == 7 && v[1] == 8 && v[2] == 9);
		assert_true(*end == '<' || *end == '}' || end == text + strlen(text) || *end == ' ');
		for (int k = 0; k < count; k++)
			assert_int_equal(extra[k], row[i].extra[k]);
	}
}

/* Of all lengths around those that are counted together, and of many more than a byte can count. */
static void test_count(void **unused)
{
	static char text[40000];
	size_t n = 0;

	(void)unused;
	memset(text, '\n', sizeof(text));
	for (size_t i = 0; i < 200; i++)
		assert_int_equal(scan_count(text + 7, text + 7 + i, '\n'), i);
	assert_int_equal(scan_count(text, text + sizeof(text), '\n'), sizeof(text));
	assert_int_equal(scan_count(text, text + sizeof(text), '<'), 0);
	for (size_t i = 0; i < sizeof(text); i++) {
		text[i] = i * i % 7 == 2 ? '<' : (char)i;
		n += text[i] == '<';
	}
	assert_int_equal(scan_count(text, text + sizeof(text), '<'), n);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_numbers),
		cmocka_unit_test(test_vectors),
		cmocka_unit_test(test_ends),
		cmocka_unit_test(test_faces),
		cmocka_unit_test(test_count),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
