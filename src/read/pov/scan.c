/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The numbers that exporters write have a handful of digits, and then digits and power of ten are both
 * exact doubles, so that one division rounds correctly (W. D. Clinger, How to read floating point
 * numbers accurately, 1990). All others go to number_parse(), which is exact too.
 */
#include <config.h>

#include "read/pov/scan.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/wide.h"
#include "read/pov/number.h"

/* Numbers are shorter; with so much left, most tests for the end can be left out. */
#define MARGIN 64
#define STEP 32u /* bytes that are counted together */

static const double power_of_ten[] = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10,
				       1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19 };

static inline unsigned digit(char c)
{
	return (unsigned)(unsigned char)c - '0';
}

static inline bool word_char(char c)
{
	return digit(c) < 10 || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/* The end of the comment that begins at at; NULL: it has none, or there is no comment. Block comments
 * nest in SDL: one within another is left to the lexer. */
static const char *skip_comment(const char *at, const char *end)
{
	const char *close;

	if (end - at < 2)
		return NULL;
	if (at[1] == '/') {
		close = memchr(at, '\n', (size_t)(end - at));
		return close ? close + 1 : end;
	}
	if (at[1] != '*')
		return NULL;
	for (close = at + 2; end - close >= 2; close++) {
		if (close[0] == '*' && close[1] == '/')
			return close + 2;
		if (close[0] == '/' && close[1] == '*')
			return NULL;
	}
	return NULL;
}

static const char *skip_blanks_slowly(const char *at, const char *end)
{
	while (at && at < end) {
		if (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t')
			at++;
		else if (*at == '/')
			at = skip_comment(at, end);
		else
			break;
	}
	return at;
}

/* NULL: something that is no blank and no number follows; at end there is nothing to read. */
static inline const char *skip_blanks(const char *at, const char *end)
{
	while (at < end && (*at == ' ' || *at == '\n'))
		at++;
	if (at < end && (*at == '\r' || *at == '\t' || *at == '/'))
		at = skip_blanks_slowly(at, end);
	return at && at < end ? at : NULL;
}

const char *scan_blanks(const char *at, const char *end)
{
	return skip_blanks(at, end);
}

static const char *scan_hard_number(const char *at, const char *end, bool negative, double *out)
{
	double x;

	at = number_parse(at, end, &x);
	if (!at || !isfinite(x) || (at < end && word_char(*at)))
		return NULL;
	*out = negative ? -x : x;
	return at;
}

static inline const char *scan_number(const char *at, const char *end, double *out)
{
	const char *begin, *point, *p;
	bool negative = *at == '-';
	uint64_t digits = 0;
	double x;

	at += negative || *at == '+';
	if (end - at < MARGIN)
		return scan_hard_number(at, end, negative, out);
	begin = at;
	for (p = at; digit(*p) < 10 && p - begin < 20; p++)
		digits = 10 * digits + digit(*p);
	point = p;
	if (*p == '.') {
		for (p++; digit(*p) < 10 && p - begin < 20; p++)
			digits = 10 * digits + digit(*p);
		/* 19 digits fit, and below 2^53 they are a double. */
		if (p - begin == 1 || p - begin >= 20 || digits >> 53 || word_char(*p))
			return scan_hard_number(begin, end, negative, out);
		x = (double)digits / power_of_ten[p - point - 1];
	} else {
		if (p == begin || p - begin >= 19 || digits >> 53 || word_char(*p))
			return scan_hard_number(begin, end, negative, out);
		x = (double)digits;
	}
	*out = negative ? -x : x;
	return p;
}

/* Between two numbers: the comma. */
static inline const char *scan_comma(const char *at, const char *end)
{
	at = skip_blanks(at, end);
	if (!at || *at != ',')
		return NULL;
	return skip_blanks(at + 1, end);
}

static inline const char *scan_open(const char *at, const char *end)
{
	at = skip_blanks(at, end);
	if (!at || *at != '<')
		return NULL;
	return skip_blanks(at + 1, end);
}

/* The > and, if the element ends there, its comma. digits: a number may follow too. */
static inline const char *scan_close(const char *at, const char *end, bool digits)
{
	at = skip_blanks(at, end);
	if (!at || *at != '>')
		return NULL;
	at = skip_blanks(at + 1, end);
	if (!at)
		return NULL;
	if (*at == ',')
		return at + 1;
	return *at == '<' || *at == '}' || (digits && digit(*at) < 10) ? at : NULL;
}

const char *scan_vector(const char *at, const char *end, double out[3])
{
	if (!(at = scan_open(at, end)) || !(at = scan_number(at, end, &out[0])) ||
	    !(at = scan_comma(at, end)) || !(at = scan_number(at, end, &out[1])) ||
	    !(at = scan_comma(at, end)) || !(at = scan_number(at, end, &out[2])))
		return NULL;
	return scan_close(at, end, false);
}

const char *scan_vector2(const char *at, const char *end, double out[2])
{
	if (!(at = scan_open(at, end)) || !(at = scan_number(at, end, &out[0])) ||
	    !(at = scan_comma(at, end)) || !(at = scan_number(at, end, &out[1])))
		return NULL;
	return scan_close(at, end, false);
}

static inline const char *scan_index(const char *at, const char *end, uint32_t *out)
{
	const char *begin = at;
	uint64_t x = 0;

	for (; at < end && digit(*at) < 10 && at - begin < 11; at++)
		x = 10 * x + digit(*at);
	if (at == begin || at == end || x >= UINT32_MAX || *at == '.' || word_char(*at))
		return NULL;
	*out = (uint32_t)x;
	return at;
}

static inline const char *scan_three(const char *at, const char *end, uint32_t out[3])
{
	if (!(at = scan_open(at, end)) || !(at = scan_index(at, end, &out[0])) ||
	    !(at = scan_comma(at, end)) || !(at = scan_index(at, end, &out[1])) ||
	    !(at = scan_comma(at, end)) || !(at = scan_index(at, end, &out[2])))
		return NULL;
	return at;
}

const char *scan_indices3(const char *at, const char *end, uint32_t out[3])
{
	at = scan_three(at, end, out);
	return at ? scan_close(at, end, false) : NULL;
}

const char *scan_face(const char *at, const char *end, uint32_t out[3], uint32_t extra[3], int *count)
{
	*count = 0;
	at = scan_three(at, end, out);
	if (at)
		at = scan_close(at, end, true);
	while (at) {
		at = skip_blanks(at, end);
		/* A name or an operator here might be the next number, so the whole face is not plain. */
		if (!at || *at == '<' || *at == '}')
			return at;
		if (*count == 3)
			return NULL;
		at = scan_index(at, end, &extra[(*count)++]);
		if (!at || !(at = skip_blanks(at, end)))
			return NULL;
		if (*at == ',')
			at++;
		else if (*at != '<' && *at != '}')
			return NULL;
	}
	return NULL;
}

static WIDE size_t count_steps(const char *at, size_t steps, char what)
{
	size_t n = 0;

	while (steps) {
		uint8_t seen[STEP] = { 0 };
		size_t some = steps < 255 ? steps : 255;

		steps -= some;
		for (; some; some--, at += STEP) {
			for (unsigned i = 0; i < STEP; i++)
				seen[i] = (uint8_t)(seen[i] + (at[i] == what));
		}
		for (unsigned i = 0; i < STEP; i++)
			n += seen[i];
	}
	return n;
}

size_t scan_count(const char *at, const char *end, char what)
{
	size_t bytes = (size_t)(end - at), n = count_steps(at, bytes / STEP, what);

	for (const char *p = end - bytes % STEP; p < end; p++)
		n += *p == what;
	return n;
}
