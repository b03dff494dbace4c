/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Strings (manual 3.3.1.9): literals, identifiers, and functions that give one. They are bytes; chr()
 * and \u give UTF-8.
 */
#include <config.h>

#include "read/pov/internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "read/pov/number.h"

/* Room for a string of that length, and its price; NULL: reported. */
static char *new_string(struct pov *p, uint64_t length)
{
	if (length > p->limit.string_bytes) {
		struct diag_pos pos = pov_pos(p);

		pov_limit(p, &pos, "string_bytes", (double)p->limit.string_bytes, "the string is too long");
		return NULL;
	}
	if (!pov_charge(p, length / 64))
		return NULL;
	return pov_alloc(p, (size_t)length + 1);
}

static char *put_utf8(char *out, uint32_t c)
{
	if (c < 0x80) {
		*out++ = (char)c;
	} else if (c < 0x800) {
		*out++ = (char)(0xc0 | c >> 6);
		*out++ = (char)(0x80 | (c & 0x3f));
	} else {
		*out++ = (char)(0xe0 | c >> 12);
		*out++ = (char)(0x80 | (c >> 6 & 0x3f));
		*out++ = (char)(0x80 | (c & 0x3f));
	}
	return out;
}

static int hex(char c)
{
	if (c >= '0' && c <= '9')
		return c - '0';
	if (c >= 'a' && c <= 'f')
		return c - 'a' + 10;
	if (c >= 'A' && c <= 'F')
		return c - 'A' + 10;
	return -1;
}

static char escape(char c)
{
	switch (c) {
	case 'a': return '\a';
	case 'b': return '\b';
	case 'f': return '\f';
	case 'n': return '\n';
	case 'r': return '\r';
	case 't': return '\t';
	case 'v': return '\v';
	case '0': return 0;
	default: return c;
	}
}

/* The current token, a literal; escapes are resolved unless it is a path. */
static char *literal(struct pov *p, bool path)
{
	const char *at = p->tok.begin, *end = p->tok.end;
	char *out = new_string(p, (uint64_t)(end - at)), *to = out;

	while (out && at < end) {
		if (*at != '\\' || at + 1 >= end || (path && at[1] != '"')) {
			*to++ = *at++;
			continue;
		}
		at++;
		if (*at == 'u' && end - at >= 5 && hex(at[1]) >= 0 && hex(at[2]) >= 0 &&
		    hex(at[3]) >= 0 && hex(at[4]) >= 0) {
			to = put_utf8(to, (uint32_t)(hex(at[1]) << 12 | hex(at[2]) << 8 | hex(at[3]) << 4 |
						     hex(at[4])));
			at += 5;
		} else {
			*to++ = escape(*at++);
		}
	}
	pov_next(p);
	return out;
}

static char *concat(struct pov *p, bool path)
{
	char *a = pov_string(p), *b, *c;
	size_t n, m;

	while (a && pov_accept(p, TOK_COMMA)) {
		b = path ? pov_path(p) : pov_string(p);
		if (!b)
			return NULL;
		n = strlen(a);
		m = strlen(b);
		c = new_string(p, n + m);
		if (!c)
			return NULL;
		memcpy(c, a, n);
		memcpy(c + n, b, m);
		a = c;
	}
	return a;
}

/* Width and digits of str() and vstr(). */
static void read_format(struct pov *p, int *width, int *digits)
{
	double w, d;

	pov_comma(p);
	w = expr_float(p);
	pov_comma(p);
	d = expr_float(p);
	if (!(fabs(w) <= 1000 && d <= 1000 && d >= -1000)) {
		pov_fail(p, "str() and vstr() make numbers of at most 1000 characters");
		w = d = 0;
	}
	*width = (int)w;
	*digits = (int)d;
}

static char *print_vector(struct pov *p, const double *c, uint32_t n, const char *between, int width,
			  int digits)
{
	size_t gap = strlen(between), used = 0, room;
	char number[2048], *out;
	int length;

	room = n * (sizeof(number) + gap);
	if (room > p->limit.string_bytes)
		room = (size_t)p->limit.string_bytes;
	out = new_string(p, room);
	for (uint32_t i = 0; out && i < n; i++) {
		length = number_print(number, sizeof(number), width, digits, c[i]);
		if (length < 0 || length >= (int)sizeof(number) || used + (size_t)length + gap > room) {
			pov_fail(p, "the string is too long");
			return NULL;
		}
		if (i) {
			memcpy(out + used, between, gap);
			used += gap;
		}
		memcpy(out + used, number, (size_t)length);
		used += (size_t)length;
	}
	return out;
}

static char *str(struct pov *p)
{
	double v = expr_float(p);
	int width, digits, length;
	char number[2048], *out;

	read_format(p, &width, &digits);
	if (p->failed)
		return NULL;
	length = number_print(number, sizeof(number), width, digits, v);
	if (length >= (int)sizeof(number))
		length = (int)sizeof(number) - 1;
	out = new_string(p, (uint64_t)length);
	if (out)
		memcpy(out, number, (size_t)length);
	return out;
}

static char *vstr(struct pov *p)
{
	struct pov_value v = { POV_VECTOR, 5, { 0 } };
	uint32_t n = pov_count(p, "components in vstr()", 2, 5);
	int width, digits;
	char *between;

	pov_comma(p);
	expr_number(p, &v, 1);
	pov_comma(p);
	between = pov_string(p);
	read_format(p, &width, &digits);
	return p->failed ? NULL : print_vector(p, v.c, n, between, width, digits);
}

static char *substr(struct pov *p)
{
	char *s = pov_string(p), *out;
	double first, count;
	size_t length;

	pov_comma(p);
	first = expr_float(p);
	pov_comma(p);
	count = expr_float(p);
	if (p->failed || !s)
		return NULL;
	length = strlen(s);
	if (!(first >= 1 && count >= 0 && trunc(first) - 1 + trunc(count) <= (double)length)) {
		pov_fail(p, "substr: characters %g to %g of a string of %zu", first, first + count - 1, length);
		return NULL;
	}
	out = new_string(p, (uint64_t)count);
	if (out)
		memcpy(out, s + (size_t)first - 1, (size_t)count);
	return out;
}

static char *chr(struct pov *p)
{
	double c = expr_float(p);
	char *out;

	if (!(c > -1 && c < 65536)) {
		pov_fail(p, "chr(%g): there are the characters 0 to 65535", c);
		return NULL;
	}
	out = new_string(p, 4);
	if (out)
		put_utf8(out, (uint32_t)c);
	return out;
}

static char *change_case(struct pov *p, bool upper)
{
	char *s = pov_string(p), *out = s ? new_string(p, strlen(s)) : NULL;

	for (char *to = out; out && *s; s++) {
		if (upper && *s >= 'a' && *s <= 'z')
			*to++ = (char)(*s - 'a' + 'A');
		else if (!upper && *s >= 'A' && *s <= 'Z')
			*to++ = (char)(*s - 'A' + 'a');
		else
			*to++ = *s;
	}
	return out;
}

static char *function(struct pov *p, enum pov_token_kind kind, bool path)
{
	struct diag_pos pos = pov_pos(p);
	char *s = NULL;

	pov_next(p);
	if (!pov_expect(p, TOK_LEFT_PAREN, "after the function's name") || !pov_nest(p))
		return NULL;
	switch (kind) {
	case TOK_CONCAT: s = concat(p, path); break;
	case TOK_STR: s = str(p); break;
	case TOK_VSTR: s = vstr(p); break;
	case TOK_SUBSTR: s = substr(p); break;
	case TOK_CHR: s = chr(p); break;
	case TOK_STRUPR: s = change_case(p, true); break;
	case TOK_STRLWR: s = change_case(p, false); break;
	default:
		if (!pov_unsupported(p, &pos, "the function datetime",
				     "a scene gives the same picture whenever it is rendered"))
			return NULL;
		expr_float(p);
		if (pov_accept(p, TOK_COMMA))
			pov_string(p);
		s = new_string(p, 0);
	}
	pov_expect(p, TOK_RIGHT_PAREN, "after the function's arguments");
	pov_unnest(p);
	return p->failed ? NULL : s;
}

bool starts_string(struct pov *p)
{
	enum pov_token_kind kind = pov_token(p);

	return kind == TOK_STRING || (kind == TOK_IDENT && p->tok.value.kind == SLOT_STRING) ||
	       (kind != TOK_IDENT && kind != TOK_NEW_IDENT && kind != TOK_UNSET && kind != TOK_END &&
		p->tok.atom && p->tok.atom->class == KEYWORD_STRING);
}

char *string_or_null(struct pov *p, bool path)
{
	bool hold = p->hold;
	char *s;

	p->hold = false;
	pov_token(p);
	if (!starts_string(p)) {
		s = NULL;
	} else if (p->tok.kind == TOK_STRING) {
		s = literal(p, path);
	} else if (p->tok.kind == TOK_IDENT) {
		s = p->tok.value.u.string;
		pov_next(p);
	} else {
		s = function(p, p->tok.kind, path);
	}
	p->hold = hold;
	return s;
}

static char *required(struct pov *p, bool path)
{
	char *s = string_or_null(p, path);

	if (!s)
		pov_fail(p, "expected a string, found %s", pov_text(p));
	return p->failed ? NULL : s;
}

char *pov_string(struct pov *p)
{
	return required(p, false);
}

char *pov_path(struct pov *p)
{
	return required(p, true);
}
