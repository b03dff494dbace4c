/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "base/json_write.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Bytes of the well-formed UTF-8 character at s (Unicode's table 3-7), 0 if it is none. */
static size_t utf8_length(const unsigned char *s)
{
	unsigned char low = 0x80, high = 0xbf;
	size_t n;

	if (s[0] < 0x80)
		return 1;
	if (s[0] < 0xc2 || s[0] > 0xf4)
		return 0;
	n = s[0] < 0xe0 ? 2 : s[0] < 0xf0 ? 3 : 4;
	if (s[0] == 0xe0)
		low = 0xa0; /* shorter forms exist */
	else if (s[0] == 0xed)
		high = 0x9f; /* surrogates */
	else if (s[0] == 0xf0)
		low = 0x90;
	else if (s[0] == 0xf4)
		high = 0x8f; /* above U+10FFFF */
	if (s[1] < low || s[1] > high)
		return 0;
	for (size_t i = 2; i < n; i++) {
		if ((s[i] & 0xc0) != 0x80)
			return 0;
	}
	return n;
}

static void put_text(FILE *out, const char *text)
{
	static const char plain[] = "\"\\\b\f\n\r\t", letter[] = "\"\\bfnrt";
	const unsigned char *s = (const unsigned char *)text;
	const char *p;
	size_t n;

	fputc('"', out);
	for (; *s; s += n) {
		n = utf8_length(s);
		p = strchr(plain, *s);
		if (!n) {
			fputs("\xef\xbf\xbd", out);
			n = 1;
		} else if (p) {
			fputc('\\', out);
			fputc(letter[p - plain], out);
		} else if (*s < 0x20 || *s == 0x7f) {
			fprintf(out, "\\u%04x", *s);
		} else {
			fwrite(s, 1, n, out);
		}
	}
	fputc('"', out);
}

static void put_break(struct json_writer *j)
{
	if (j->layout == JW_LINE)
		return;
	fputc('\n', j->out);
	for (uint32_t i = 0; i < j->depth; i++)
		fputc('\t', j->out);
}

/* What stands before a value: comma, line break, key. */
static void begin_value(struct json_writer *j, const char *key)
{
	uint64_t bit = (uint64_t)1 << j->depth;
	bool inside = j->depth > 0;

	if (!!key != (inside && (j->object & bit)) || (!inside && (j->filled & bit)))
		j->misused = true;
	if (j->filled & bit)
		fputs(j->layout == JW_LINE ? ", " : ",", j->out);
	if (inside)
		put_break(j);
	j->filled |= bit;
	if (!key)
		return;
	put_text(j->out, key);
	fputs(": ", j->out);
}

static void begin_level(struct json_writer *j, const char *key, bool object)
{
	uint64_t bit;

	begin_value(j, key);
	fputc(object ? '{' : '[', j->out);
	if (j->depth + 1 >= JW_DEPTH) {
		j->misused = true;
		return;
	}
	bit = (uint64_t)1 << ++j->depth;
	j->filled &= ~bit;
	j->object = object ? j->object | bit : j->object & ~bit;
}

void jw_init(struct json_writer *j, FILE *out, enum jw_layout layout)
{
	*j = (struct json_writer){ .out = out, .layout = layout };
}

void jw_object(struct json_writer *j, const char *key)
{
	begin_level(j, key, true);
}

void jw_array(struct json_writer *j, const char *key)
{
	begin_level(j, key, false);
}

void jw_end(struct json_writer *j)
{
	uint64_t bit = (uint64_t)1 << j->depth;

	if (!j->depth) {
		j->misused = true;
		return;
	}
	j->depth--;
	if (j->filled & bit)
		put_break(j);
	fputc(j->object & bit ? '}' : ']', j->out);
}

void jw_string(struct json_writer *j, const char *key, const char *value)
{
	if (!value) {
		jw_null(j, key);
		return;
	}
	begin_value(j, key);
	put_text(j->out, value);
}

void jw_double(struct json_writer *j, const char *key, double value)
{
	char text[40];

	if (!isfinite(value)) {
		jw_null(j, key);
		return;
	}
	for (int digits = 15; digits <= 17; digits++) {
		snprintf(text, sizeof(text), "%.*g", digits, value);
		if (strtod(text, NULL) == value)
			break;
	}
	/* Whatever the locale's decimal sign is, JSON's is the point. */
	for (char *s = text; *s; s++) {
		if (!strchr("0123456789+-e", *s))
			*s = '.';
	}
	begin_value(j, key);
	fputs(text, j->out);
}

void jw_uint(struct json_writer *j, const char *key, uint64_t value)
{
	begin_value(j, key);
	fprintf(j->out, "%" PRIu64, value);
}

void jw_int(struct json_writer *j, const char *key, int64_t value)
{
	begin_value(j, key);
	fprintf(j->out, "%" PRId64, value);
}

void jw_bool(struct json_writer *j, const char *key, bool value)
{
	begin_value(j, key);
	fputs(value ? "true" : "false", j->out);
}

void jw_null(struct json_writer *j, const char *key)
{
	begin_value(j, key);
	fputs("null", j->out);
}

bool jw_finish(struct json_writer *j)
{
	fputc('\n', j->out);
	return !fflush(j->out) && !ferror(j->out) && !j->misused && !j->depth && (j->filled & 1);
}
