/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Directives that are no conditions (manual 3.3.2): #declare and #local, #undef, #include, #default,
 * #version, and the text streams.
 */
#include <config.h>

#include "read/pov/internal.h"

#include <math.h>

/* From here to hold_end(), a directive at this depth of braces has to wait. */
struct hold hold_begin(struct pov *p, const struct source *source)
{
	struct hold before = { p->hold, p->hold_depth, p->hold_source };

	p->hold = true;
	p->hold_depth = p->depth;
	p->hold_source = source;
	return before;
}

void hold_end(struct pov *p, struct hold before)
{
	p->hold = before.on;
	p->hold_depth = before.depth;
	p->hold_source = before.source;
}

struct slot *declare_target(struct pov *p, const struct token *name, bool local, uint32_t depth)
{
	struct binding *b = name->atom->top;

	if (name->element)
		return name->where;
	if (!b || (local && b->depth != depth))
		b = bind(p, name->atom, local ? depth : 0);
	return b ? slot_follow(&b->slot) : NULL;
}

/* deprecated [once] ["what to use instead"]: said to authors of include files, not to users of ours. */
static void skip_deprecated(struct pov *p)
{
	p->have = false;
	if (token_raw_name(p) && p->tok.kind == TOK_ONCE)
		p->have = false;
	if (token_raw_name(p) && p->tok.kind == TOK_STRING)
		p->have = false;
}

static void declare(struct pov *p, bool local)
{
	struct slot value = { .kind = SLOT_EMPTY }, *to;
	struct token name;
	uint32_t depth = scope_depth(p);
	const struct source *source = p->source;
	struct hold before;

	if (!token_raw_name(p))
		return;
	if (p->tok.kind == TOK_DEPRECATED) {
		skip_deprecated(p);
		if (!token_raw_name(p))
			return;
	}
	name = p->tok;
	if (!name.atom || name.atom->kind != TOK_NEW_IDENT) {
		pov_fail(p, "expected an identifier to declare, found %s%s", pov_text(p),
			 name.atom ? ", a reserved word" : "");
		return;
	}
	pov_next(p);
	if (!pov_expect(p, TOK_EQUALS, "after the identifier") || !pov_nest(p))
		return;
	pov_token(p);
	before = hold_begin(p, source);
	if (right_side(p, &value, false)) {
		pov_accept(p, TOK_SEMICOLON);
		to = p->failed ? NULL : declare_target(p, &name, local, depth);
		if (to) {
			*to = value;
			token_again(p);
		}
	}
	hold_end(p, before);
	pov_unnest(p);
}

static void undef(struct pov *p)
{
	if (!token_raw_name(p))
		return;
	if (p->tok.kind == TOK_NEW_IDENT) {
		pov_warn(p, &p->tok.pos, "#undef: %.*s is not declared",
			 (int)(p->tok.end - p->tok.begin), p->tok.begin);
		if (p->tok.atom->top)
			unbind(p, p->tok.atom);
	} else if (p->tok.kind == TOK_IDENT || p->tok.kind == TOK_UNSET) {
		if (p->tok.element)
			p->tok.where->kind = SLOT_EMPTY;
		else
			unbind(p, p->tok.atom);
	} else {
		pov_fail(p, "expected an identifier, found %s", pov_text(p));
		return;
	}
	p->have = false;
	/* One ; is usual, but none is needed, and nothing may be read that comes after a directive. */
	lex_blank(p);
	if (p->source->p.at < p->source->end && *p->source->p.at == ';')
		p->source->p.at++;
}

static void set_version(struct pov *p)
{
	const struct source *source = p->source;
	struct hold before;
	double v;

	pov_token(p);
	if (!p->failed && p->tok.kind == TOK_NEW_IDENT) {
		pov_fail(p, "expected a number after #version, found %s", pov_text(p));
		return;
	}
	before = hold_begin(p, source);
	v = expr_float(p);
	pov_accept(p, TOK_SEMICOLON);
	hold_end(p, before);
	if (p->failed)
		return;
	if (!(v >= 0.1 && v < 100)) {
		pov_fail(p, "#version %g makes no sense; the newest that is known is 3.7", v);
		return;
	}
	p->version = (int)(v * 100 + 0.5);
}

static void include_file(struct pov *p)
{
	struct diag_pos pos;
	char *name;

	pov_token(p);
	pos = pov_pos(p);
	name = pov_path(p);
	if (name)
		source_include(p, name, &pos);
}

static void message(struct pov *p, enum pov_token_kind word, struct diag_pos pos)
{
	char *text = pov_string(p);
	size_t n;

	if (!text)
		return;
	if (word == TOK_ERROR) {
		pov_fail_at(p, &pos, "#error: %s", text);
	} else if (word == TOK_WARNING) {
		for (n = 0; text[n]; n++)
			;
		while (n && text[n - 1] == '\n')
			text[--n] = 0;
		pov_warn(p, &pos, "#warning: %s", text);
	} else {
		pov_debug(p, text);
	}
}

static void set_default(struct pov *p)
{
	if (!pov_expect(p, TOK_LEFT_BRACE, "after #default") || !pov_nest(p))
		return;
	pov_default(p);
	pov_expect(p, TOK_RIGHT_BRACE, "at the end of #default");
	pov_unnest(p);
}

/* A # that no directive follows means nothing, as in POV-Ray. */
static void no_directive(struct pov *p, const struct diag_pos *pos)
{
	if (!p->tok.atom) {
		pov_warn(p, pos, "# without a directive after it is ignored");
		p->have = p->tok.kind != TOK_END;
		return;
	}
	pov_fail_at(p, pos, "#%.*s is no directive",
		    (int)(p->tok.end - p->tok.begin > 30 ? 30 : p->tok.end - p->tok.begin), p->tok.begin);
}

static void carry_out_directive(struct pov *p, enum pov_token_kind word, struct diag_pos pos)
{
	switch (word) {
	case TOK_IF: case TOK_IFDEF: case TOK_IFNDEF:
		cond_if(p, word, pos);
		break;
	case TOK_ELSE: case TOK_ELSEIF:
		cond_else(p, word, pos);
		break;
	case TOK_WHILE: case TOK_FOR:
		cond_loop(p, word, pos);
		break;
	case TOK_SWITCH:
		cond_switch(p, pos);
		break;
	case TOK_CASE: case TOK_RANGE:
		cond_case(p, word, pos);
		break;
	case TOK_BREAK:
		cond_break(p, pos);
		break;
	case TOK_END_WORD:
		cond_end(p, pos);
		break;
	case TOK_DECLARE: case TOK_LOCAL:
		declare(p, word == TOK_LOCAL);
		break;
	case TOK_UNDEF:
		undef(p);
		break;
	case TOK_MACRO:
		macro_define(p, pos);
		break;
	case TOK_INCLUDE:
		include_file(p);
		break;
	case TOK_DEFAULT:
		set_default(p);
		break;
	case TOK_VERSION:
		set_version(p);
		break;
	case TOK_DEBUG: case TOK_WARNING: case TOK_ERROR: case TOK_RENDER: case TOK_STATISTICS:
		message(p, word, pos);
		break;
	case TOK_FOPEN:
		file_open(p, pos);
		break;
	case TOK_FCLOSE:
		file_close(p, pos);
		break;
	case TOK_READ:
		file_read(p);
		break;
	case TOK_WRITE:
		file_write(p);
		break;
	default:
		no_directive(p, &pos);
	}
}

/* At the top level these may be written without their #. */
bool bare_directive(struct pov *p)
{
	struct diag_pos pos = pov_pos(p);

	switch (pov_token(p)) {
	case TOK_DECLARE: case TOK_DEFAULT: case TOK_INCLUDE: case TOK_VERSION:
		pov_next(p);
		carry_out_directive(p, p->tok.kind, pos);
		return true;
	default:
		return false;
	}
}

void directive(struct pov *p)
{
	struct diag_pos pos = p->tok.pos;

	lex(p);
	carry_out_directive(p, p->tok.atom && p->tok.atom->directive ? p->tok.kind : TOK_END, pos);
}
