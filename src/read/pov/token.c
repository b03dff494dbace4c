/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The stream of tokens that readers of items see: names have become their values, macros their bodies,
 * and directives have been carried out.
 *
 * The next token is fetched when it is looked at, not when the last one is passed, so that a directive
 * takes effect as late as possible. One exception is POV-Ray's as well: while a #declare is not finished,
 * a directive right after its value has to wait ("hold"), or the #end of a loop would jump back before
 * the value is stored.
 */
#include <config.h>

#include "read/pov/internal.h"
#include "read/pov/scan.h"

#include <stdio.h>
#include <string.h>

/* A macro or an included file ends; false: the scene does. */
static bool end_of_source(struct pov *p)
{
	struct source *s = p->source;
	struct cond *c;

	if (p->conds.count > s->conds) {
		c = BUF_AT(&p->conds, struct cond, p->conds.count - 1);
		pov_fail_at(p, &c->pos, "this directive has no #end");
		return false;
	}
	if (!s->below)
		return false;
	source_pop(p);
	return true;
}

/* One index of an array, after its [. */
static bool read_index(struct pov *p, const struct array *a, uint32_t dim, uint64_t *at)
{
	struct diag_pos pos;
	double i;

	p->tok.kind = TOK_LEFT_SQUARE;
	if (!pov_expect(p, TOK_LEFT_SQUARE, "before an array's index"))
		return false;
	pov_token(p);
	pos = pov_pos(p);
	i = expr_float(p);
	if (!pov_expect(p, TOK_RIGHT_SQUARE, "after an array's index"))
		return false;
	if (!(i > -1 && i + POV_EPSILON < a->size[dim])) {
		pov_fail_at(p, &pos, "index %.0f is outside the array, whose dimension %u has %u elements",
			    i, dim + 1, a->size[dim]);
		return false;
	}
	*at = *at * a->size[dim] + (uint64_t)(i < 0 ? 0 : i + POV_EPSILON);
	return true;
}

/* name[1][2]...: the name has been lexed and stands for an array. Indices are read as part of the token,
 * so that an element is an identifier like any other. Returns the array itself without indices. */
static struct slot *find_element(struct pov *p, struct slot *slot)
{
	struct token name = p->tok;
	const struct source *source = p->source;
	int depth = p->depth;
	bool hold = p->hold, raw = p->raw_names;

	while (slot && slot->kind == SLOT_ARRAY) {
		struct array *a = slot->u.array;
		uint64_t at = 0;

		lex_blank(p);
		if (p->failed || p->source->p.at >= p->source->end || *p->source->p.at != '[')
			break;
		if (!pov_nest(p))
			return NULL;
		p->hold = false;
		p->raw_names = false;
		for (uint32_t i = 0; slot && i < a->dims; i++) {
			p->have = false;
			if (!read_index(p, a, i, &at))
				slot = NULL;
		}
		pov_unnest(p);
		if (!slot)
			break;
		slot = &a->slot[at];
		name.element = true;
	}
	if (p->source == source && name.element)
		name.end = source->p.at;
	p->tok = name;
	p->have = false;
	p->depth = depth;
	p->hold = hold;
	p->raw_names = raw;
	return p->failed ? NULL : slot;
}

/* While a declaration is not finished, directives and macros right after its value have to wait. */
static bool held(const struct pov *p)
{
	return p->hold && p->depth == p->hold_depth;
}

/* A name was lexed: find what it stands for. */
static void resolve(struct pov *p)
{
	struct binding *b = p->tok.atom->top;
	struct slot *s;

	if (!b)
		return;
	s = slot_follow(&b->slot);
	if (s->kind == SLOT_ARRAY)
		s = find_element(p, s);
	if (!s)
		return;
	p->tok.where = s;
	p->tok.value = *s;
	if (s->kind != SLOT_EMPTY)
		p->tok.kind = TOK_IDENT;
	else if (p->tok.element)
		p->tok.kind = TOK_UNSET;
	p->tok.waiting = s->kind == SLOT_MACRO && !p->raw_names;
}

void token_again(struct pov *p)
{
	bool name = p->tok.kind == TOK_NEW_IDENT || p->tok.kind == TOK_IDENT;

	if (!p->have || p->failed || !name || !p->tok.atom || p->tok.element)
		return;
	p->tok.kind = TOK_NEW_IDENT;
	resolve(p);
}

/* The current token is a # or a macro's name whose time has come. */
static void carry_out(struct pov *p)
{
	p->have = false;
	p->tok.waiting = false;
	if (p->tok.kind == TOK_END)
		end_of_source(p);
	else if (p->tok.kind == TOK_HASH)
		directive(p);
	else
		macro_call(p, p->tok.value.u.macro, p->tok.pos);
}

static void fetch(struct pov *p)
{
	while (!p->have || (p->tok.waiting && !held(p))) {
		if (p->have) {
			carry_out(p);
			continue;
		}
		p->tok.waiting = false;
		if (!p->failed)
			lex(p);
		if (p->failed || !pov_charge(p, 1)) {
			p->tok.kind = TOK_END;
			p->tok.atom = NULL;
		} else if (p->tok.kind == TOK_NEW_IDENT) {
			resolve(p);
		} else if (p->tok.kind == TOK_HASH) {
			p->tok.waiting = !p->raw_names;
		} else if (p->tok.kind == TOK_END && p->hold && p->source == p->hold_source && p->source->below) {
			p->tok.waiting = true;
		} else if (p->tok.kind == TOK_END && end_of_source(p)) {
			continue;
		}
		p->have = true;
	}
	if (p->failed) {
		p->tok.kind = TOK_END;
		p->tok.atom = NULL;
	}
}

enum pov_token_kind pov_token(struct pov *p)
{
	if (p->failed)
		return TOK_END;
	if (!p->have || p->tok.waiting)
		fetch(p);
	return p->tok.kind;
}

bool token_raw_name(struct pov *p)
{
	bool raw = p->raw_names;

	p->raw_names = true;
	pov_token(p);
	p->raw_names = raw;
	return !p->failed;
}

void pov_next(struct pov *p)
{
	if (pov_token(p) == TOK_END)
		return;
	switch (p->tok.kind) {
	case TOK_LEFT_BRACE: case TOK_LEFT_PAREN: case TOK_LEFT_SQUARE:
		p->depth++;
		break;
	case TOK_RIGHT_BRACE: case TOK_RIGHT_PAREN: case TOK_RIGHT_SQUARE:
		p->depth--;
		break;
	default:
		break;
	}
	p->have = false;
	p->passed++;
}

bool pov_accept(struct pov *p, enum pov_token_kind kind)
{
	if (pov_token(p) != kind || p->failed)
		return false;
	pov_next(p);
	return true;
}

bool pov_expect(struct pov *p, enum pov_token_kind kind, const char *context)
{
	if (pov_accept(p, kind))
		return true;
	pov_fail(p, "expected %s%s%s, found %s", keyword_text(kind), context && *context ? " " : "",
		 context ? context : "", pov_text(p));
	return false;
}

struct diag_pos pov_pos(const struct pov *p)
{
	return p->have || !p->source ? p->tok.pos : source_pos(p);
}

const char *pov_text(struct pov *p)
{
	const char *open = "", *close = "";
	int length;

	pov_token(p);
	switch (p->tok.kind) {
	case TOK_END:
		return "the end of the file";
	case TOK_STRING:
		open = "\"";
		close = "\"";
		break;
	case TOK_NEW_IDENT:
		open = "the undeclared identifier ";
		break;
	case TOK_UNSET:
		open = "the array element ";
		close = ", which has no value,";
		break;
	default:
		break;
	}
	length = (int)(p->tok.end - p->tok.begin > 30 ? 30 : p->tok.end - p->tok.begin);
	snprintf(p->text, sizeof(p->text), "%s%.*s%s", open, length, p->tok.begin, close);
	return p->text;
}

enum pov_item_kind pov_ident_kind(struct pov *p)
{
	return pov_token(p) == TOK_IDENT && p->tok.value.kind == SLOT_ITEM ? p->tok.value.item_kind :
									      ITEM_NONE;
}

void *pov_ident_item(struct pov *p)
{
	return pov_ident_kind(p) == ITEM_NONE ? NULL : p->tok.value.u.item;
}

void pov_skip_block(struct pov *p)
{
	struct diag_pos pos = pov_pos(p);
	uint32_t depth = 0;

	do {
		switch (pov_token(p)) {
		case TOK_LEFT_BRACE:
			depth++;
			break;
		case TOK_RIGHT_BRACE:
			depth--;
			break;
		case TOK_END:
			pov_fail_at(p, &pos, "this { is never closed");
			return;
		default:
			if (!depth) {
				pov_expect(p, TOK_LEFT_BRACE, "");
				return;
			}
		}
		pov_next(p);
	} while (depth);
}

/* Raw bytes are only given where nothing would be lost: no directive of a loop or #if that is open here
 * may be in them, which their reader sees as a # and leaves to us. */
bool pov_raw(struct pov *p, const char **begin, const char **end)
{
	if (p->failed || p->have || !p->source)
		return false;
	*begin = p->source->p.at;
	*end = p->source->end;
	return true;
}

void pov_raw_done(struct pov *p, const char *now)
{
	struct place *at = &p->source->p;
	size_t lines = scan_count(at->at, now, '\n');

	at->at = now;
	if (!lines)
		return;
	at->line += (uint32_t)lines;
	for (at->line_start = now; at->line_start[-1] != '\n'; at->line_start--)
		;
}
