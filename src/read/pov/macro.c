/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Macros (manual 3.3.2.8): their bodies stay where they are in the file and are read at each call.
 */
#include <config.h>

#include "read/pov/internal.h"

#include <string.h>

static bool read_params(struct pov *p, struct atom **param, uint32_t *count)
{
	uint32_t n = 0;

	if (!pov_expect(p, TOK_LEFT_PAREN, "after the macro's name"))
		return false;
	while (token_raw_name(p) && p->tok.kind != TOK_RIGHT_PAREN) {
		if (!p->tok.atom || p->tok.atom->kind != TOK_NEW_IDENT) {
			pov_fail(p, "expected the name of a parameter, found %s", pov_text(p));
			return false;
		}
		if (n == POV_MACRO_PARAMS) {
			pov_fail(p, "a macro has at most %d parameters", POV_MACRO_PARAMS);
			return false;
		}
		param[n++] = p->tok.atom;
		p->have = false;
		if (token_raw_name(p) && p->tok.kind == TOK_COMMA)
			p->have = false;
	}
	*count = n;
	pov_next(p); /* the ) */
	return !p->failed;
}

void macro_define(struct pov *p, struct diag_pos pos)
{
	struct atom *name, *param[POV_MACRO_PARAMS];
	struct binding *b;
	struct macro *m;
	uint32_t count = 0;

	if (!token_raw_name(p))
		return;
	name = p->tok.atom;
	if (!name || name->kind != TOK_NEW_IDENT) {
		pov_fail(p, "expected the macro's name, found %s", pov_text(p));
		return;
	}
	p->have = false;
	if (!read_params(p, param, &count))
		return;
	m = pov_alloc(p, sizeof(*m) + count * sizeof(m->param[0]));
	if (!m)
		return;
	m->name = name->text;
	m->file = p->source->file;
	m->body = p->source->p;
	m->count = count;
	memcpy(m->param, param, count * sizeof(param[0]));
	while (lex_skip(p, pos, "this macro") != TOK_END_WORD) {
		if (p->failed)
			return;
	}
	m->end = p->tok.begin;
	b = name->top ? name->top : bind(p, name, 0);
	if (!b)
		return;
	b->slot = (struct slot){ .kind = SLOT_MACRO };
	b->slot.u.macro = m;
}

/* One argument. An identifier alone is passed by reference; but not one that another macro left as its
 * value: what it stands for ends with that macro. */
static bool read_argument(struct pov *p, struct macro *m, uint32_t i, struct slot *out)
{
	const struct source *caller = p->source;
	enum pov_token_kind kind = pov_token(p);

	if (kind == TOK_RIGHT_PAREN) {
		pov_fail(p, "macro %s has %u parameters, but only %u are given here", m->name, m->count, i);
		return false;
	}
	if (kind == TOK_UNSET && p->source == caller) {
		*out = (struct slot){ .kind = SLOT_REF };
		out->u.ref = p->tok.where;
		pov_next(p);
		return true;
	}
	return right_side(p, out, p->source == caller);
}

void macro_call(struct pov *p, struct macro *m, struct diag_pos pos)
{
	struct slot arg[POV_MACRO_PARAMS];
	struct binding *b;
	bool hold = p->hold;

	if (!pov_nest(p))
		return;
	p->have = false;
	p->hold = false;
	if (pov_token(p) != TOK_LEFT_PAREN && !p->failed)
		pov_fail_at(p, &pos, "macro %s must be followed by its arguments in parentheses", m->name);
	pov_next(p);
	for (uint32_t i = 0; i < m->count && !p->failed; i++) {
		if (!read_argument(p, m, i, &arg[i]))
			break;
		pov_comma(p);
	}
	if (!p->failed && pov_token(p) != TOK_RIGHT_PAREN)
		pov_fail(p, "macro %s has %u parameters; expected ) here, found %s", m->name, m->count,
			 pov_text(p));
	pov_next(p);
	p->hold = hold;
	pov_unnest(p);
	if (p->failed || !pov_charge(p, 8) || !source_push_macro(p, m))
		return;
	for (uint32_t i = 0; i < m->count; i++) {
		b = bind(p, m->param[i], scope_depth(p));
		if (!b)
			return;
		b->slot = arg[i];
	}
}
