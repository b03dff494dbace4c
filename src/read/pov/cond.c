/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Conditions and loops (manual 3.3.2.4). What is not taken is skipped at once, so an open condition is
 * always one whose text is being read.
 */
#include <config.h>

#include "read/pov/internal.h"

#include <math.h>

static struct cond *top(struct pov *p)
{
	return BUF_AT(&p->conds, struct cond, p->conds.count - 1);
}

/* NULL: reported. */
static struct cond *push(struct pov *p, enum cond_kind kind, struct diag_pos pos)
{
	if (p->conds.count + p->nest >= p->limit.nesting) {
		pov_limit(p, &pos, "nesting", p->limit.nesting, "directives are nested too deeply");
		return NULL;
	}
	if (!buf_reserve(&p->conds, p->book, "reading", 1)) {
		pov_no_memory(p);
		return NULL;
	}
	p->conds.count++;
	*top(p) = (struct cond){ .kind = kind, .source = p->source, .pos = pos };
	return top(p);
}

double paren_full(struct pov *p)
{
	struct pov_value v = { POV_FLOAT, 1, { 0 } };

	if (!pov_expect(p, TOK_LEFT_PAREN, "before the condition"))
		return 0;
	expr_full(p, &v, 1);
	if (v.count > 1)
		pov_fail(p, "a vector cannot be a condition");
	pov_expect(p, TOK_RIGHT_PAREN, "after the condition");
	return v.c[0];
}

/* (a, b) of #range. */
static void paren_range(struct pov *p, double *a, double *b)
{
	pov_expect(p, TOK_LEFT_PAREN, "after #range");
	*a = expr_float(p);
	pov_comma(p);
	*b = expr_float(p);
	pov_expect(p, TOK_RIGHT_PAREN, "after the range");
}

bool cond_defined(struct pov *p)
{
	bool yes;

	if (!pov_expect(p, TOK_LEFT_PAREN, "before the identifier") || !token_raw_name(p))
		return false;
	yes = p->tok.kind == TOK_IDENT;
	p->have = false;
	pov_expect(p, TOK_RIGHT_PAREN, "after the identifier");
	return yes;
}

static bool test(struct pov *p, enum pov_token_kind word)
{
	switch (word) {
	case TOK_IFDEF:
		return cond_defined(p);
	case TOK_IFNDEF:
		return !cond_defined(p);
	default:
		return truth(paren_full(p));
	}
}

void cond_if(struct pov *p, enum pov_token_kind word, struct diag_pos pos)
{
	bool yes = test(p, word);

	while (!p->failed) {
		if (yes) {
			push(p, COND_IF, pos);
			return;
		}
		word = lex_skip(p, pos, "this #if");
		if (word == TOK_END_WORD)
			return;
		if (word == TOK_ELSE)
			yes = true;
		else if (word == TOK_ELSEIF)
			yes = test(p, word);
		else if (!p->failed)
			pov_fail_at(p, &p->tok.pos, "#case and #range belong into a #switch");
	}
}

/* Skip to the #end of what is open here and close it. */
static void leave(struct pov *p)
{
	struct cond c = *top(p);

	while (!p->failed && lex_skip(p, c.pos, "this directive") != TOK_END_WORD)
		;
	if (!p->failed)
		p->conds.count--;
}

static bool none_open(struct pov *p)
{
	return p->conds.count <= p->source->conds;
}

/* The end of the taken part of an #if; in a #switch, the case before falls through into the #else. */
void cond_else(struct pov *p, enum pov_token_kind word, struct diag_pos pos)
{
	const char *name = keyword_text(word);

	if (none_open(p) || top(p)->kind == COND_WHILE || top(p)->kind == COND_FOR ||
	    (top(p)->kind == COND_SWITCH && word == TOK_ELSEIF))
		pov_fail_at(p, &pos, "#%s without an #if before it", name);
	else if (top(p)->kind == COND_IF)
		leave(p);
}

static bool count_step(struct pov *p, const struct diag_pos *pos)
{
	if (++p->loop_steps <= p->limit.loop_steps)
		return true;
	pov_limit(p, pos, "loop_steps", (double)p->limit.loop_steps, "the scene's loops run too long");
	return false;
}

static void skip_loop(struct pov *p, struct diag_pos pos)
{
	while (!p->failed && lex_skip(p, pos, "this loop") != TOK_END_WORD)
		;
}

static void begin_while(struct pov *p, struct diag_pos pos)
{
	struct place loop = p->source->p;
	struct cond *c;

	if (!truth(paren_full(p))) {
		skip_loop(p, pos);
		return;
	}
	c = push(p, COND_WHILE, pos);
	if (c)
		c->loop = loop;
}

static bool past_end(double value, double end, double step)
{
	return (step > 0 && value > end + POV_EPSILON) || (step < 0 && value < end - POV_EPSILON);
}

/* ( identifier, first, last [, step] ) */
static void begin_for(struct pov *p, struct diag_pos pos)
{
	struct atom *var;
	struct binding *b;
	struct cond *c;
	double first, end, step = 1;

	if (!pov_expect(p, TOK_LEFT_PAREN, "after #for") || !token_raw_name(p))
		return;
	if ((p->tok.kind != TOK_IDENT && p->tok.kind != TOK_NEW_IDENT) || p->tok.element) {
		pov_fail(p, "expected the name of the loop's variable, found %s", pov_text(p));
		return;
	}
	var = p->tok.atom;
	p->have = false;
	pov_comma(p);
	first = expr_float(p);
	pov_comma(p);
	end = expr_float(p);
	if (pov_accept(p, TOK_COMMA))
		step = expr_float(p);
	if (!truth(step))
		pov_fail_at(p, &pos, "the step of this #for is 0: it would never end");
	pov_expect(p, TOK_RIGHT_PAREN, "after the loop's bounds");
	if (p->failed)
		return;
	b = bind(p, var, scope_depth(p));
	if (!b)
		return;
	b->slot = (struct slot){ .kind = SLOT_NUMBER };
	b->slot.u.number = (struct pov_value){ POV_FLOAT, 1, { first } };
	if (past_end(first, end, step)) {
		skip_loop(p, pos);
		return;
	}
	c = push(p, COND_FOR, pos);
	if (!c)
		return;
	c->var = var;
	c->end = end;
	c->step = step;
	c->loop = p->source->p;
}

void cond_loop(struct pov *p, enum pov_token_kind word, struct diag_pos pos)
{
	if (word == TOK_WHILE)
		begin_while(p, pos);
	else
		begin_for(p, pos);
}

static void again_while(struct pov *p)
{
	struct cond c = *top(p);
	uint32_t index = p->conds.count - 1;

	p->source->p = c.loop;
	if (!truth(paren_full(p)) && !p->failed) {
		skip_loop(p, c.pos);
		p->conds.count = index;
	}
}

static void again_for(struct pov *p, struct diag_pos pos)
{
	struct cond c = *top(p);
	struct slot *s = c.var->top ? slot_follow(&c.var->top->slot) : NULL;

	if (!s || s->kind != SLOT_NUMBER || s->u.number.count != 1) {
		pov_fail_at(p, &pos, "the variable %s of the #for in line %u is no number any more",
			    c.var->text, c.pos.line);
		return;
	}
	s->u.number.c[0] += c.step;
	if (past_end(s->u.number.c[0], c.end, c.step))
		p->conds.count--; /* we are at its #end already */
	else
		p->source->p = c.loop;
}

void cond_end(struct pov *p, struct diag_pos pos)
{
	struct cond *c;

	if (none_open(p)) {
		pov_fail_at(p, &pos, "#end without anything that it could end");
		return;
	}
	c = top(p);
	if (c->kind == COND_IF || c->kind == COND_SWITCH)
		p->conds.count--;
	else if (!count_step(p, &c->pos))
		return;
	else if (c->kind == COND_WHILE)
		again_while(p);
	else
		again_for(p, pos);
}

/* After the word #case or #range: does it take the value? */
static bool case_takes(struct pov *p, enum pov_token_kind word, double value)
{
	double a, b;

	if (word == TOK_CASE)
		return fabs(paren_full(p) - value) < POV_EPSILON;
	paren_range(p, &a, &b);
	return value >= a && value <= b;
}

void cond_switch(struct pov *p, struct diag_pos pos)
{
	double value = paren_full(p);
	enum pov_token_kind word;
	struct cond *c;

	while (!p->failed) {
		word = lex_skip(p, pos, "this #switch");
		if (word == TOK_END_WORD || p->failed)
			return;
		if (word == TOK_ELSEIF) {
			pov_fail_at(p, &p->tok.pos, "#elseif belongs into an #if");
			return;
		}
		if (word == TOK_ELSE || case_takes(p, word, value)) {
			c = push(p, COND_SWITCH, pos);
			if (c)
				c->value = value;
			return;
		}
	}
}

/* A case that was taken falls through into the next one. */
void cond_case(struct pov *p, enum pov_token_kind word, struct diag_pos pos)
{
	if (none_open(p) || top(p)->kind != COND_SWITCH)
		pov_fail_at(p, &pos, "#%s without a #switch before it", keyword_text(word));
	else
		case_takes(p, word, 0);
}

/* Leaves the innermost loop, #switch or macro of this text. */
void cond_break(struct pov *p, struct diag_pos pos)
{
	while (!none_open(p) && !p->failed) {
		bool done = top(p)->kind != COND_IF;

		leave(p);
		if (done)
			return;
	}
	if (p->failed)
		return;
	if (p->source->macro)
		source_pop(p);
	else
		pov_fail_at(p, &pos, "#break without a loop, #switch or macro around it");
}
