/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The table of reserved words (manual 3.3.1.2), made from keywords.def.
 */
#include "read/pov/keywords.h"

#define DIRECTIVE 1
const struct keyword keyword_table[] = {
#define WORD(name, text, class, directive) { TOK_##name, KEYWORD_##class, text, directive },
#define ALIAS(name, text, class) { TOK_##name, KEYWORD_##class, text, 0 },
#include "read/pov/keywords.def"
#undef WORD
#undef ALIAS
};
#undef DIRECTIVE

const size_t keyword_count = sizeof(keyword_table) / sizeof(keyword_table[0]);

const char *keyword_text(enum pov_token_kind kind)
{
	static const char *const text[TOK_KINDS] = {
		[TOK_END] = "end of file", [TOK_NUMBER] = "number", [TOK_STRING] = "string",
		[TOK_IDENT] = "identifier", [TOK_NEW_IDENT] = "undeclared identifier",
		[TOK_UNSET] = "array element without a value",
		[TOK_LEFT_BRACE] = "{", [TOK_RIGHT_BRACE] = "}", [TOK_LEFT_PAREN] = "(",
		[TOK_RIGHT_PAREN] = ")", [TOK_LEFT_SQUARE] = "[", [TOK_RIGHT_SQUARE] = "]",
		[TOK_LEFT_ANGLE] = "<", [TOK_RIGHT_ANGLE] = ">", [TOK_COMMA] = ",",
		[TOK_SEMICOLON] = ";", [TOK_COLON] = ":", [TOK_PERIOD] = ".", [TOK_PLUS] = "+",
		[TOK_DASH] = "-", [TOK_STAR] = "*", [TOK_SLASH] = "/", [TOK_BANG] = "!",
		[TOK_QUESTION] = "?", [TOK_AMPERSAND] = "&", [TOK_BAR] = "|", [TOK_EQUALS] = "=",
		[TOK_LESS_EQUAL] = "<=", [TOK_GREATER_EQUAL] = ">=", [TOK_NOT_EQUAL] = "!=",
		[TOK_HASH] = "#", [TOK_PERCENT] = "%", [TOK_HAT] = "^", [TOK_TILDE] = "~",
		[TOK_AT] = "@", [TOK_DOLLAR] = "$", [TOK_BACKQUOTE] = "`", [TOK_QUOTE] = "'",
		[TOK_BACKSLASH] = "\\",
#define WORD(name, text, class, directive) [TOK_##name] = text,
#define ALIAS(name, text, class)
#include "read/pov/keywords.def"
#undef WORD
#undef ALIAS
	};

	return kind < TOK_KINDS ? text[kind] : "?";
}
