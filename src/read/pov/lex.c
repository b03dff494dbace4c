/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Bytes to tokens (manual 3.3.1.1 to 3.3.1.3), and skipping what a directive leaves out.
 */
#include <config.h>

#include "read/pov/internal.h"

#include <math.h>
#include <string.h>

#include "read/pov/number.h"

struct diag_pos source_pos(const struct pov *p)
{
	const struct source *s = p->source;

	if (!s)
		return (struct diag_pos){ NULL, 0, 0 };
	return (struct diag_pos){ s->file, s->p.line, (uint32_t)(s->p.at - s->p.line_start) + 1 };
}

static inline bool is_name_start(char c)
{
	return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static inline bool is_digit(char c)
{
	return c >= '0' && c <= '9';
}

static inline void newline(struct source *s)
{
	s->p.at++;
	s->p.line++;
	s->p.line_start = s->p.at;
}

/* At the slash of a slash and a star: comments nest in SDL. */
static void skip_comment(struct pov *p)
{
	struct source *s = p->source;
	struct diag_pos pos = source_pos(p);
	uint32_t depth = 1;

	s->p.at += 2;
	while (s->p.at < s->end) {
		char c = *s->p.at, d = s->p.at + 1 < s->end ? s->p.at[1] : 0;

		if (c == '\n') {
			newline(s);
		} else if (c == '*' && d == '/') {
			s->p.at += 2;
			if (!--depth)
				return;
		} else if (c == '/' && d == '*') {
			s->p.at += 2;
			depth++;
		} else {
			s->p.at++;
		}
	}
	pov_fail_at(p, &pos, "the comment that begins here has no end (comments nest: each /* needs "
		    "its own */)");
}

/* Comments are cheaper than tokens, but in a loop not free. */
static void charge_blank(struct pov *p, const char *from)
{
	size_t n = (size_t)(p->source->p.at - from);

	if (n >= 64)
		pov_charge(p, n / 16);
}

void lex_blank(struct pov *p)
{
	struct source *s = p->source;
	const char *from = s->p.at;

	while (s->p.at < s->end) {
		char c = *s->p.at;

		if (c == '\n') {
			newline(s);
		} else if (c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v' || c == 0x1a) {
			s->p.at++;
		} else if (c == '/' && s->p.at + 1 < s->end && s->p.at[1] == '/') {
			const char *n = memchr(s->p.at, '\n', (size_t)(s->end - s->p.at));

			s->p.at = n ? n : s->end;
		} else if (c == '/' && s->p.at + 1 < s->end && s->p.at[1] == '*') {
			skip_comment(p);
			if (p->failed)
				return;
		} else {
			break;
		}
	}
	charge_blank(p, from);
}

/* At the opening quote. A quote behind a backslash does not end it; a string may hold newlines. */
static bool lex_string(struct pov *p, const char **begin, const char **end)
{
	struct source *s = p->source;
	struct diag_pos pos = source_pos(p);

	*begin = ++s->p.at;
	while (s->p.at < s->end && *s->p.at != '"') {
		if (*s->p.at == '\\' && s->p.at + 1 < s->end && s->p.at[1] != '\n')
			s->p.at += 2;
		else if (*s->p.at == '\n')
			newline(s);
		else
			s->p.at++;
	}
	*end = s->p.at;
	if (s->p.at >= s->end) {
		pov_fail_at(p, &pos, "the string that begins here has no closing quote");
		return false;
	}
	s->p.at++;
	return true;
}

static void lex_number(struct pov *p)
{
	struct source *s = p->source;
	struct token *t = &p->tok;

	s->p.at = number_parse(s->p.at, s->end, &t->number);
	t->kind = TOK_NUMBER;
	if (!isfinite(t->number))
		pov_fail_at(p, &t->pos, "the number %.*s is too large for a double",
			    (int)(s->p.at - t->begin > 40 ? 40 : s->p.at - t->begin), t->begin);
}

static void lex_name(struct pov *p)
{
	struct source *s = p->source;
	const char *at = s->p.at;

	while (at < s->end && (is_name_start(*at) || is_digit(*at)))
		at++;
	p->tok.atom = atom_get(p, s->p.at, (size_t)(at - s->p.at));
	s->p.at = at;
	p->tok.kind = p->tok.atom ? p->tok.atom->kind : TOK_END;
}

static enum pov_token_kind sign(char c)
{
	switch (c) {
	case '{': return TOK_LEFT_BRACE;
	case '}': return TOK_RIGHT_BRACE;
	case '(': return TOK_LEFT_PAREN;
	case ')': return TOK_RIGHT_PAREN;
	case '[': return TOK_LEFT_SQUARE;
	case ']': return TOK_RIGHT_SQUARE;
	case '<': return TOK_LEFT_ANGLE;
	case '>': return TOK_RIGHT_ANGLE;
	case ',': return TOK_COMMA;
	case ';': return TOK_SEMICOLON;
	case ':': return TOK_COLON;
	case '.': return TOK_PERIOD;
	case '+': return TOK_PLUS;
	case '-': return TOK_DASH;
	case '*': return TOK_STAR;
	case '/': return TOK_SLASH;
	case '!': return TOK_BANG;
	case '?': return TOK_QUESTION;
	case '&': return TOK_AMPERSAND;
	case '|': return TOK_BAR;
	case '=': return TOK_EQUALS;
	case '#': return TOK_HASH;
	case '%': return TOK_PERCENT;
	case '^': return TOK_HAT;
	case '~': return TOK_TILDE;
	case '@': return TOK_AT;
	case '$': return TOK_DOLLAR;
	case '`': return TOK_BACKQUOTE;
	case '\'': return TOK_QUOTE;
	case '\\': return TOK_BACKSLASH;
	default: return TOK_END;
	}
}

static void lex_sign(struct pov *p)
{
	struct source *s = p->source;
	char c = *s->p.at;

	p->tok.kind = sign(c);
	if (p->tok.kind == TOK_END) {
		if ((unsigned char)c >= 0x80 || c < ' ')
			pov_fail_at(p, &p->tok.pos, "the byte 0x%02x cannot stand here (outside strings "
				    "and comments only ASCII is allowed)", (unsigned char)c);
		else
			pov_fail_at(p, &p->tok.pos, "the character %c cannot stand here", c);
		return;
	}
	s->p.at++;
	if (s->p.at >= s->end || *s->p.at != '=')
		return;
	if (c == '<')
		p->tok.kind = TOK_LESS_EQUAL;
	else if (c == '>')
		p->tok.kind = TOK_GREATER_EQUAL;
	else if (c == '!')
		p->tok.kind = TOK_NOT_EQUAL;
	else
		return;
	s->p.at++;
}

void lex(struct pov *p)
{
	struct source *s = p->source;
	struct token *t = &p->tok;
	char c;

	lex_blank(p);
	t->pos = source_pos(p);
	t->begin = s->p.at;
	t->atom = NULL;
	t->where = NULL;
	t->element = false;
	if (p->failed || s->p.at >= s->end) {
		t->kind = TOK_END;
		t->end = t->begin;
		return;
	}
	c = *s->p.at;
	if (is_name_start(c)) {
		lex_name(p);
	} else if (is_digit(c) || (c == '.' && s->p.at + 1 < s->end && is_digit(s->p.at[1]))) {
		lex_number(p);
	} else if (c == '"') {
		t->kind = TOK_STRING;
		lex_string(p, &t->begin, &t->end);
		return;
	} else {
		lex_sign(p);
	}
	t->end = s->p.at;
}

/* The word of a directive, after its #; NULL: none. */
static struct atom *directive_word(struct pov *p)
{
	struct source *s = p->source;
	struct atom *a;

	lex_blank(p);
	if (p->failed || s->p.at >= s->end || !is_name_start(*s->p.at))
		return NULL;
	lex_name(p);
	a = p->tok.atom;
	return a && a->directive ? a : NULL;
}

/* Skip to the #else, #elseif, #case, #range or #end that belongs to the directive whose body this is,
 * and past its word. p->tok.pos and begin are then the place of its #. */
enum pov_token_kind lex_skip(struct pov *p, struct diag_pos opened, const char *what)
{
	struct source *s = p->source;
	uint32_t depth = 0;
	const char *a, *b, *from = s->p.at;
	struct diag_pos pos;
	struct atom *word;

	for (;;) {
		lex_blank(p);
		if (p->failed)
			return TOK_END;
		if (s->p.at >= s->end)
			break;
		if (*s->p.at == '"') {
			if (!lex_string(p, &a, &b))
				return TOK_END;
		} else if (*s->p.at == '#') {
			pos = source_pos(p);
			a = s->p.at++;
			word = directive_word(p);
			p->tok.pos = pos;
			p->tok.begin = a;
			switch (word ? word->kind : TOK_END) {
			case TOK_IF: case TOK_IFDEF: case TOK_IFNDEF: case TOK_WHILE: case TOK_FOR:
			case TOK_SWITCH: case TOK_MACRO:
				depth++;
				break;
			case TOK_END_WORD:
				if (!depth--)
					goto found;
				break;
			case TOK_ELSE: case TOK_ELSEIF: case TOK_CASE: case TOK_RANGE:
				if (!depth)
					goto found;
				break;
			default:
				break;
			}
		} else {
			for (s->p.at++; s->p.at < s->end && (is_name_start(*s->p.at) || *s->p.at == ' ');)
				s->p.at++;
		}
	}
	pov_fail_at(p, &opened, "%s has no #end", what);
	return TOK_END;
found:
	/* Skipped text is cheaper than tokens, but not free. */
	return pov_charge(p, (uint64_t)(s->p.at - from) / 16 + 1) ? word->kind : TOK_END;
}
