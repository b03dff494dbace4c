/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Numeric expressions (manual 3.3.1.4 to 3.3.1.7).
 *
 * As in POV-Ray, whoever asks says how many components are wanted, and a float becomes that many equal
 * ones at once: 5 + <1,2> is <6,7,5> where a vector is wanted. Outside parentheses an expression has
 * + - * / only, since < and > also end vectors.
 */
#include <config.h>

#include "read/pov/function.h"
#include "read/pov/internal.h"

#include <math.h>

/* A float where v->count components are wanted. */
static void fill(struct pov_value *v, double f)
{
	for (uint32_t i = 0; i < v->count; i++)
		v->c[i] = f;
}

/* Makes v as long as other: a float is repeated, a vector gets zeros. */
static void promote(struct pov_value *v, uint32_t count)
{
	if (v->count >= count)
		return;
	for (uint32_t i = v->count; i < count; i++)
		v->c[i] = v->count == 1 ? v->c[0] : 0;
	v->count = count;
}

static void promote_both(struct pov_value *a, struct pov_value *b)
{
	promote(a, b->count);
	promote(b, a->count);
}

/* < a, b, ... > with 2 to 5 components. */
static void vector_literal(struct pov *p, struct pov_value *v)
{
	uint32_t n = 0;

	pov_next(p);
	if (!pov_nest(p))
		return;
	do {
		v->c[n++] = expr_float(p);
		pov_comma(p);
	} while (!p->failed && n < 5 && (n < 2 || pov_starts_number(p)));
	v->count = n;
	pov_expect(p, TOK_RIGHT_ANGLE, "at the end of the vector");
	pov_unnest(p);
}

static void identifier(struct pov *p, struct pov_value *v)
{
	const struct slot *s = &p->tok.value;

	if (s->kind == SLOT_ITEM && s->item_kind == ITEM_FUNCTION) {
		function_call(p, v);
		return;
	}
	if (s->kind == SLOT_ITEM && s->item_kind == ITEM_SPLINE) {
		spline_call(p, v);
		return;
	}
	if (s->kind != SLOT_NUMBER) {
		pov_fail(p, "expected a number, but %s is %s", pov_text(p),
			 s->kind == SLOT_STRING ? "a string" : s->kind == SLOT_ARRAY ? "an array" :
			 s->kind == SLOT_FILE ? "a file" : "no numeric identifier");
		return;
	}
	if (s->u.number.count == 1) {
		fill(v, s->u.number.c[0]);
	} else {
		v->count = s->u.number.count;
		for (uint32_t i = 0; i < v->count; i++)
			v->c[i] = s->u.number.c[i];
	}
	pov_next(p);
}

static void operand(struct pov *p, struct pov_value *v)
{
	switch (pov_token(p)) {
	case TOK_NUMBER:
		fill(v, p->tok.number);
		pov_next(p);
		return;
	case TOK_IDENT:
		identifier(p, v);
		return;
	case TOK_LEFT_PAREN:
		pov_next(p);
		if (pov_nest(p))
			expr_full(p, v, v->count);
		pov_expect(p, TOK_RIGHT_PAREN, "");
		pov_unnest(p);
		return;
	case TOK_LEFT_ANGLE:
		vector_literal(p, v);
		return;
	default:
		break;
	}
	if (p->tok.atom && p->tok.kind != TOK_NEW_IDENT && p->tok.kind != TOK_UNSET) {
		if (p->tok.atom->class == KEYWORD_FLOAT) {
			fill(v, func_float(p));
			return;
		}
		if (p->tok.atom->class == KEYWORD_VECTOR) {
			func_vector(p, v, v->count);
			return;
		}
	}
	pov_fail(p, "expected a number, found %s", pov_text(p));
}

static double grey(const struct pov_value *v)
{
	return rgb_grey(rgb_make(v->c[0], v->c[1], v->c[2]));
}

/* .x and its like. What is left in the other components is POV-Ray's: a lone V.z where a vector is
 * wanted is <V.z, V.y, V.z>. */
static void member(struct pov *p, struct pov_value *v)
{
	uint32_t i;

	switch (pov_token(p)) {
	case TOK_X: case TOK_U: case TOK_RED: i = 0; break;
	case TOK_Y: case TOK_V: case TOK_GREEN: i = 1; break;
	case TOK_Z: case TOK_BLUE: i = 2; break;
	case TOK_T: case TOK_FILTER: i = 3; break;
	case TOK_TRANSMIT: i = 4; break;
	case TOK_GRAY:
		v->c[0] = grey(v);
		v->count = 1;
		pov_next(p);
		return;
	default:
		pov_fail(p, "expected a component such as x, u, red, filter or gray after the point, found %s",
			 pov_text(p));
		return;
	}
	if (i >= v->count) {
		pov_fail(p, "there is no component %s: the value has only %u", pov_text(p), v->count);
		return;
	}
	v->c[0] = v->c[i];
	v->count = 1;
	pov_next(p);
}

static void factor(struct pov *p, struct pov_value *v)
{
	bool hold = p->hold;
	enum pov_token_kind kind;

	p->hold = false;
	while (pov_accept(p, TOK_PLUS))
		;
	kind = pov_token(p);
	if (kind == TOK_DASH || kind == TOK_BANG) {
		pov_next(p);
		p->hold = hold;
		if (!pov_nest(p))
			return;
		factor(p, v);
		for (uint32_t i = 0; i < v->count; i++)
			v->c[i] = kind == TOK_DASH ? -v->c[i] : !truth(v->c[i]);
		pov_unnest(p);
		return;
	}
	operand(p, v);
	p->hold = hold;
	if (pov_accept(p, TOK_PERIOD))
		member(p, v);
}

static void divide(struct pov *p, struct pov_value *a, const struct pov_value *b)
{
	struct diag_pos pos = pov_pos(p);
	bool zero = false;

	for (uint32_t i = 0; i < a->count; i++) {
		if (b->c[i] == 0) {
			a->c[i] = HUGE_VAL;
			zero = true;
		} else {
			a->c[i] /= b->c[i];
		}
	}
	if (zero)
		pov_warn(p, &pos, "division by zero");
}

static void term(struct pov *p, struct pov_value *v)
{
	struct pov_value b = { POV_FLOAT, 1, { 0 } };
	enum pov_token_kind op;

	factor(p, v);
	b.count = v->count;
	while ((op = pov_token(p)) == TOK_STAR || op == TOK_SLASH) {
		pov_next(p);
		factor(p, &b);
		promote_both(v, &b);
		if (op == TOK_SLASH)
			divide(p, v, &b);
		for (uint32_t i = 0; op == TOK_STAR && i < v->count; i++)
			v->c[i] *= b.c[i];
	}
}

void expr_number(struct pov *p, struct pov_value *v, uint32_t terms)
{
	struct pov_value b = { POV_FLOAT, 1, { 0 } };
	enum pov_token_kind op;

	v->count = terms;
	term(p, v);
	b.count = v->count;
	while ((op = pov_token(p)) == TOK_PLUS || op == TOK_DASH) {
		pov_next(p);
		term(p, &b);
		promote_both(v, &b);
		for (uint32_t i = 0; i < v->count; i++)
			v->c[i] = op == TOK_PLUS ? v->c[i] + b.c[i] : v->c[i] - b.c[i];
	}
}

static bool is_comparison(enum pov_token_kind op)
{
	return op == TOK_LEFT_ANGLE || op == TOK_LESS_EQUAL || op == TOK_EQUALS ||
	       op == TOK_NOT_EQUAL || op == TOK_GREATER_EQUAL || op == TOK_RIGHT_ANGLE;
}

static bool compare(enum pov_token_kind op, double a, double b)
{
	switch (op) {
	case TOK_LEFT_ANGLE: return a < b;
	case TOK_LESS_EQUAL: return a <= b || !truth(a - b);
	case TOK_EQUALS: return !truth(a - b);
	case TOK_NOT_EQUAL: return truth(a - b);
	case TOK_GREATER_EQUAL: return a >= b || !truth(a - b);
	default: return a > b;
	}
}

/* Strings can only be compared, with one operator. */
static void compare_strings(struct pov *p, struct pov_value *v)
{
	char *a = pov_string(p), *b;
	enum pov_token_kind op = pov_token(p);
	int difference = 0;

	if (!is_comparison(op)) {
		pov_fail(p, "a string can only be compared here; expected <, <=, =, !=, >= or >, found %s",
			 pov_text(p));
		return;
	}
	pov_next(p);
	b = pov_string(p);
	if (!a || !b)
		return;
	while (*a && *a == *b) {
		a++;
		b++;
	}
	difference = (unsigned char)*a - (unsigned char)*b;
	fill(v, compare(op, difference, 0));
}

static void relation(struct pov *p, struct pov_value *v)
{
	struct pov_value b = { POV_FLOAT, 1, { 0 } };
	enum pov_token_kind op;
	bool hold = p->hold;

	p->hold = false;
	pov_token(p);
	p->hold = hold;
	if (starts_string(p)) {
		compare_strings(p, v);
		return;
	}
	expr_number(p, v, v->count);
	while (is_comparison(op = pov_token(p))) {
		pov_next(p);
		expr_number(p, &b, v->count);
		promote_both(v, &b);
		for (uint32_t i = 0; i < v->count; i++)
			v->c[i] = compare(op, v->c[i], b.c[i]);
	}
}

static void logical(struct pov *p, struct pov_value *v)
{
	struct pov_value b = { POV_FLOAT, 1, { 0 } };
	enum pov_token_kind op;

	relation(p, v);
	while ((op = pov_token(p)) == TOK_AMPERSAND || op == TOK_BAR) {
		pov_next(p);
		b.count = v->count;
		relation(p, &b);
		promote_both(v, &b);
		for (uint32_t i = 0; i < v->count; i++) {
			if (op == TOK_AMPERSAND)
				v->c[i] = truth(v->c[i]) && truth(b.c[i]);
			else
				v->c[i] = truth(v->c[i]) || truth(b.c[i]);
		}
	}
}

void expr_full(struct pov *p, struct pov_value *v, uint32_t terms)
{
	struct pov_value b = { POV_FLOAT, 1, { 0 } };
	bool yes;

	v->count = 1;
	logical(p, v);
	if (!pov_accept(p, TOK_QUESTION)) {
		promote(v, terms);
		return;
	}
	if (v->count != 1)
		pov_fail(p, "the condition before ? is a vector");
	yes = truth(v->c[0]);
	if (!pov_nest(p))
		return;
	expr_full(p, v, terms);
	pov_expect(p, TOK_COLON, "between the two values of a ? :");
	expr_full(p, &b, terms);
	if (!yes)
		*v = b;
	pov_unnest(p);
}

double expr_float(struct pov *p)
{
	struct pov_value v = { POV_FLOAT, 1, { 0 } };

	expr_number(p, &v, 1);
	if (v.count > 1)
		pov_fail(p, "expected a float, but the expression before %s is a vector or a colour",
			 pov_text(p));
	return v.c[0];
}
