/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Kinds of tokens: signs, literals, identifiers, and one for each reserved word of keywords.def.
 */
#ifndef ALIDADE_READ_POV_KEYWORDS_H
#define ALIDADE_READ_POV_KEYWORDS_H

#include <stdbool.h>
#include <stddef.h>

enum pov_token_kind {
	TOK_END, /* of the input, or after an error */
	TOK_NUMBER, /* a float literal */
	TOK_STRING, /* a string literal */
	TOK_IDENT, /* a declared identifier, or an array element that has a value */
	TOK_NEW_IDENT, /* an identifier not declared (or #undef-ed) */
	TOK_UNSET, /* an array element that has no value yet */
	TOK_LEFT_BRACE, TOK_RIGHT_BRACE, TOK_LEFT_PAREN, TOK_RIGHT_PAREN, TOK_LEFT_SQUARE,
	TOK_RIGHT_SQUARE, TOK_LEFT_ANGLE, TOK_RIGHT_ANGLE, TOK_COMMA, TOK_SEMICOLON, TOK_COLON,
	TOK_PERIOD, TOK_PLUS, TOK_DASH, TOK_STAR, TOK_SLASH, TOK_BANG, TOK_QUESTION, TOK_AMPERSAND,
	TOK_BAR, TOK_EQUALS, TOK_LESS_EQUAL, TOK_GREATER_EQUAL, TOK_NOT_EQUAL, TOK_HASH,
	TOK_PERCENT, TOK_HAT, TOK_TILDE, TOK_AT, TOK_DOLLAR, TOK_BACKQUOTE, TOK_QUOTE, TOK_BACKSLASH,
#define WORD(name, text, class, directive) TOK_##name,
#define ALIAS(name, text, class)
#include "read/pov/keywords.def"
#undef WORD
#undef ALIAS
	TOK_KINDS
};

/* What a word can begin in an expression. */
enum keyword_class {
	KEYWORD_PLAIN, KEYWORD_FLOAT, KEYWORD_VECTOR, KEYWORD_STRING, KEYWORD_COLOUR
};

struct keyword {
	enum pov_token_kind kind;
	enum keyword_class class;
	const char *text;
	bool directive; /* # may stand before it */
};

extern const struct keyword keyword_table[]; /* with the aliases, sorted by text */
extern const size_t keyword_count;

/* How a kind is written, for messages; a word's main spelling. */
const char *keyword_text(enum pov_token_kind);

#endif
