/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "base/json_read.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"

#define NUMBER_LONGEST 400 /* characters; 1e308 written out has 309 */

struct reading {
	const char *at, *end;
	struct arena *arena;
	const char *fault;
};

static bool read_value(struct reading *r, struct json_value *v, uint32_t depth);

static bool wrong(struct reading *r, const char *fault)
{
	if (!r->fault)
		r->fault = fault;
	return false;
}

static void skip_blanks(struct reading *r)
{
	while (r->at < r->end && strchr(" \t\n\r", *r->at) && *r->at)
		r->at++;
}

static bool take(struct reading *r, char c)
{
	if (r->at >= r->end || *r->at != c)
		return false;
	r->at++;
	return true;
}

static bool take_word(struct reading *r, const char *word)
{
	size_t n = strlen(word);

	if ((size_t)(r->end - r->at) < n || memcmp(r->at, word, n))
		return false;
	r->at += n;
	return true;
}

static bool take_digits(struct reading *r)
{
	const char *from = r->at;

	while (r->at < r->end && *r->at >= '0' && *r->at <= '9')
		r->at++;
	return r->at > from;
}

static bool read_number(struct reading *r, struct json_value *v)
{
	const char *from = r->at;
	char text[NUMBER_LONGEST + 1];
	size_t n;

	take(r, '-');
	if (!take(r, '0') && !take_digits(r))
		return wrong(r, "a value is missing or no value");
	if (take(r, '.') && !take_digits(r))
		return wrong(r, "digits are missing after a point");
	if (take(r, 'e') || take(r, 'E')) {
		if (!take(r, '+'))
			take(r, '-');
		if (!take_digits(r))
			return wrong(r, "an exponent has no digits");
	}
	n = (size_t)(r->at - from);
	if (n > NUMBER_LONGEST)
		return wrong(r, "a number is too long");
	memcpy(text, from, n);
	text[n] = 0;
	v->kind = JSON_NUMBER;
	v->number = strtod(text, NULL);
	return isfinite(v->number) || wrong(r, "a number is too large");
}

static bool read_hex(struct reading *r, uint32_t *out)
{
	static const char digit[] = "0123456789abcdef";

	*out = 0;
	for (int i = 0; i < 4; i++, r->at++) {
		const char *d = r->at < r->end && *r->at ? strchr(digit, *r->at | 0x20) : NULL;

		if (!d)
			return wrong(r, "\\u needs four hexadecimal digits");
		*out = *out << 4 | (uint32_t)(d - digit);
	}
	return true;
}

static char *put_utf8(char *out, uint32_t c)
{
	if (c < 0x80) {
		*out++ = (char)c;
		return out;
	}
	if (c < 0x800) {
		*out++ = (char)(0xc0 | c >> 6);
	} else {
		if (c < 0x10000) {
			*out++ = (char)(0xe0 | c >> 12);
		} else {
			*out++ = (char)(0xf0 | c >> 18);
			*out++ = (char)(0x80 | (c >> 12 & 0x3f));
		}
		*out++ = (char)(0x80 | (c >> 6 & 0x3f));
	}
	*out++ = (char)(0x80 | (c & 0x3f));
	return out;
}

/* After the backslash. Characters beyond 16 bits are two surrogates; one alone is none. */
static bool read_escape(struct reading *r, char **out)
{
	static const char letter[] = "\"\\/bfnrt", means[] = "\"\\/\b\f\n\r\t";
	const char *l = r->at < r->end && *r->at ? strchr(letter, *r->at) : NULL;
	uint32_t c, low;

	if (l) {
		*(*out)++ = means[l - letter];
		r->at++;
		return true;
	}
	if (!take(r, 'u'))
		return wrong(r, "an unknown character after a backslash");
	if (!read_hex(r, &c))
		return false;
	if (c >= 0xd800 && c < 0xdc00) {
		if (!take_word(r, "\\u") || !read_hex(r, &low) || low < 0xdc00 || low > 0xdfff)
			return wrong(r, "half a surrogate");
		c = 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00);
	} else if (c >= 0xdc00 && c <= 0xdfff) {
		return wrong(r, "half a surrogate");
	}
	*out = put_utf8(*out, c);
	return true;
}

/* What is written is never longer than what was read. */
static bool read_text(struct reading *r, const char **text)
{
	const char *from = r->at;
	size_t n;
	char *out;

	if (!take(r, '"'))
		return wrong(r, "a string is missing");
	for (n = 0; r->at + n < r->end && r->at[n] != '"'; n++) {
		if ((unsigned char)r->at[n] < 0x20)
			return wrong(r, "a control character in a string");
		n += r->at[n] == '\\';
	}
	if (r->at + n >= r->end)
		return wrong(r, "a string does not end");
	out = arena_alloc(r->arena, n + 1);
	if (!out)
		return wrong(r, "out of memory");
	*text = out;
	for (from = r->at + n; r->at < from;) {
		if (!take(r, '\\'))
			*out++ = *r->at++;
		else if (!read_escape(r, &out))
			return false;
	}
	*out = 0;
	return take(r, '"');
}

static bool read_members(struct reading *r, struct json_value *v, char close, uint32_t depth)
{
	const struct json_value **link = &v->child;

	if (depth >= JSON_DEPTH)
		return wrong(r, "too deep");
	skip_blanks(r);
	if (take(r, close))
		return true;
	do {
		struct json_value *m = arena_zalloc(r->arena, sizeof(*m));

		if (!m)
			return wrong(r, "out of memory");
		skip_blanks(r);
		if (close == '}') {
			if (!read_text(r, &m->key))
				return false;
			skip_blanks(r);
			if (!take(r, ':'))
				return wrong(r, "a colon is missing");
		}
		if (!read_value(r, m, depth + 1))
			return false;
		*link = m;
		link = &m->next;
		skip_blanks(r);
	} while (take(r, ','));
	return take(r, close) || wrong(r, "a comma or the end of a list is missing");
}

static bool read_value(struct reading *r, struct json_value *v, uint32_t depth)
{
	skip_blanks(r);
	if (take(r, '{')) {
		v->kind = JSON_OBJECT;
		return read_members(r, v, '}', depth);
	}
	if (take(r, '[')) {
		v->kind = JSON_ARRAY;
		return read_members(r, v, ']', depth);
	}
	if (r->at < r->end && *r->at == '"') {
		v->kind = JSON_STRING;
		return read_text(r, &v->text);
	}
	if (take_word(r, "true"))
		v->kind = JSON_TRUE;
	else if (take_word(r, "false"))
		v->kind = JSON_FALSE;
	else if (take_word(r, "null"))
		v->kind = JSON_NULL;
	else
		return read_number(r, v);
	return true;
}

const struct json_value *json_read(const char *text, size_t n, struct arena *arena, const char **fault)
{
	struct reading r = { .at = text, .end = text + n, .arena = arena };
	struct json_value *v = arena_zalloc(arena, sizeof(*v));
	bool good = v ? read_value(&r, v, 0) : wrong(&r, "out of memory");

	skip_blanks(&r);
	if (good && r.at < r.end)
		good = wrong(&r, "something follows the value");
	*fault = good ? NULL : r.fault;
	return good ? v : NULL;
}

const struct json_value *json_at(const struct json_value *v, const char *path)
{
	while (v && *path) {
		size_t n = strcspn(path, ".");
		const struct json_value *m = v->kind == JSON_OBJECT ? v->child : NULL;

		while (m && (strncmp(m->key, path, n) || m->key[n]))
			m = m->next;
		v = m;
		path += n + (path[n] == '.');
	}
	return v;
}

double json_number_at(const struct json_value *v, const char *path, double otherwise)
{
	v = json_at(v, path);
	return v && v->kind == JSON_NUMBER ? v->number : otherwise;
}

const char *json_text_at(const struct json_value *v, const char *path, const char *otherwise)
{
	v = json_at(v, path);
	return v && v->kind == JSON_STRING ? v->text : otherwise;
}
