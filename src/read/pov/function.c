/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * User functions (manual 3.3.1.8). What may stand in one was measured: + - * / and comparisons, & and |, a
 * sign before an operand but not two, constants that are floats, and fewer functions than elsewhere.
 */
#include <config.h>

#include "read/pov/pattern.h"
#include "read/pov/program.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "pattern/function.h"
#include "scene/hash.h"

#define PI 3.14159265358979323846

static struct operand expression(struct program *g, unsigned level);

/* x, y, z, and u and v for the first two, where the parameters were not named. */
static int plain_param(enum pov_token_kind kind)
{
	switch (kind) {
	case TOK_X: case TOK_U: return 0;
	case TOK_Y: case TOK_V: return 1;
	case TOK_Z: return 2;
	default: return -1;
	}
}

/* The register that the current token names, or -1. A parameter comes before a sum's counter of its name, and
 * of two parameters the last, as in POV-Ray. */
static int variable(const struct program *g)
{
	const struct token *t = &g->p->tok;

	if (!t->atom)
		return -1;
	if (g->plain && plain_param(t->kind) >= 0)
		return plain_param(t->kind);
	for (uint32_t i = g->param_count; i > 0 && !g->plain; i--) {
		if (g->param[i - 1] == t->atom)
			return (int)i - 1;
	}
	for (uint32_t i = g->loop_count; i > 0; i--) {
		if (g->loop[i - 1].atom == t->atom)
			return g->loop[i - 1].reg;
	}
	return -1;
}

/* Arguments into registers of their own, one behind the other. Returns how many; the ( is next. */
static uint32_t arguments(struct program *g, uint32_t *first)
{
	uint32_t n = 0;

	*first = g->top;
	if (!pov_expect(g->p, TOK_LEFT_PAREN, "after the function's name") || !pov_nest(g->p))
		return 0;
	do {
		uint32_t base = g->top;
		struct operand v = expression(g, 0);

		g->top = base;
		program_put(g, program_register(g), v);
		n++;
	} while (!pov_failed(g->p) && pov_accept(g->p, TOK_COMMA));
	pov_expect(g->p, TOK_RIGHT_PAREN, "after the function's arguments");
	pov_unnest(g->p);
	return n;
}

static void wrong_number(struct program *g, const struct diag_pos *pos, const char *name, uint32_t want,
			 uint32_t got)
{
	pov_fail_at(g->p, pos, "%s takes %u argument%s, not %u", name, want, want == 1 ? "" : "s", got);
}

static uint32_t read_member(struct program *g, uint32_t results)
{
	struct pov *p = g->p;
	size_t length;
	uint32_t m;

	if (!pov_expect(p, TOK_PERIOD, "after a function that gives several numbers: say which"))
		return 0;
	switch (pov_token(p)) {
	case TOK_X: case TOK_U: case TOK_RED: m = 0; break;
	case TOK_Y: case TOK_V: case TOK_GREEN: m = 1; break;
	case TOK_Z: case TOK_BLUE: m = 2; break;
	case TOK_T: case TOK_FILTER: m = 3; break;
	case TOK_TRANSMIT: m = 4; break;
	case TOK_GRAY: m = MEMBER_GREY; break;
	default:
		length = p->tok.atom ? p->tok.atom->length : 0;
		m = UINT32_MAX;
		if (length == 4 && !memcmp(p->tok.atom->text, "grey", 4))
			m = MEMBER_GREY;
		else if (length == 2 && !memcmp(p->tok.atom->text, "hf", 2))
			m = MEMBER_HF;
	}
	if (m == UINT32_MAX || (m >= results && (m < MEMBER_GREY || results < 3)))
		pov_fail(p, "expected a component of the function's %u after the point, found %s", results,
			 pov_text(p));
	pov_next(p);
	return m;
}

static struct operand call_user(struct program *g)
{
	const struct pov_function *f = g->p->tok.value.u.item;
	struct diag_pos pos = pov_pos(g->p);
	uint32_t base = g->top, first, n, member = 0;
	char name[64];

	snprintf(name, sizeof(name), "%s", pov_text(g->p));
	pov_next(g->p);
	n = arguments(g, &first);
	if (!pov_failed(g->p) && n != f->function.params)
		wrong_number(g, &pos, name, f->function.params, n);
	if (!pov_failed(g->p) && f->function.results > 1)
		member = read_member(g, f->function.results);
	return program_call(g, f, first, member, base);
}

static const struct {
	enum pov_token_kind token;
	enum function_code code;
} math_word[] = {
	{ TOK_ABS, OP_ABS }, { TOK_ACOS, OP_ACOS }, { TOK_ACOSH, OP_ACOSH }, { TOK_ASIN, OP_ASIN },
	{ TOK_ASINH, OP_ASINH }, { TOK_ATAN, OP_ATAN }, { TOK_ATANH, OP_ATANH }, { TOK_CEIL, OP_CEIL },
	{ TOK_COS, OP_COS }, { TOK_COSH, OP_COSH }, { TOK_DEGREES, OP_DEGREES }, { TOK_EXP, OP_EXP },
	{ TOK_FLOOR, OP_FLOOR }, { TOK_INT, OP_INT }, { TOK_LN, OP_LN }, { TOK_LOG, OP_LOG },
	{ TOK_RADIANS, OP_RADIANS }, { TOK_SIN, OP_SIN }, { TOK_SINH, OP_SINH }, { TOK_SQRT, OP_SQRT },
	{ TOK_TAN, OP_TAN }, { TOK_TANH, OP_TANH },
	{ TOK_ATAN2, OP_ATAN2 }, { TOK_DIV, OP_INT_DIV }, { TOK_MAX, OP_MAX }, { TOK_MIN, OP_MIN },
	{ TOK_MOD, OP_MOD }, { TOK_POW, OP_POW },
};

/* One argument, two, or for min and max two and more; constants among them are folded. */
static struct operand math(struct program *g, enum function_code code)
{
	struct diag_pos pos = pov_pos(g->p);
	const char *name = keyword_text(pov_token(g->p));
	uint32_t base = g->top, n = 1, want = code < OP_ATAN2 ? 1 : 2;
	struct operand v;

	pov_next(g->p);
	if (!pov_expect(g->p, TOK_LEFT_PAREN, "after the function's name") || !pov_nest(g->p))
		return program_number(0);
	v = expression(g, 0);
	if (want == 1)
		v = program_one(g, code, v, base);
	for (; !pov_failed(g->p) && pov_accept(g->p, TOK_COMMA); n++)
		v = program_two(g, code, v, expression(g, 0), base);
	pov_expect(g->p, TOK_RIGHT_PAREN, "after the function's arguments");
	pov_unnest(g->p);
	if (!pov_failed(g->p) && (n < want || (n > want && code != OP_MIN && code != OP_MAX)))
		wrong_number(g, &pos, name, want, n);
	return v;
}

static struct operand select_one(struct program *g)
{
	struct diag_pos pos = pov_pos(g->p);
	uint32_t base = g->top, first, n, to;

	pov_next(g->p);
	n = arguments(g, &first);
	if (!pov_failed(g->p) && n != 3 && n != 4)
		pov_fail_at(g->p, &pos, "select takes 3 or 4 arguments, not %u", n);
	g->top = base;
	to = program_register(g);
	program_emit(g, n == 3 ? OP_SELECT : OP_SELECT_ZERO, to, first, first + 1);
	return program_in(to);
}

/* i, from, to, of what: the counter, the end, and the sum have registers; the value follows. */
static struct operand sum_body(struct program *g, uint32_t base, bool product)
{
	struct pov *p = g->p;
	struct operand total = program_in(base), value;
	uint32_t again, leave;

	pov_expect(p, TOK_COMMA, "before what is added up");
	program_put(g, (uint16_t)base, program_number(product ? 1 : 0));
	leave = program_here(g) + 1;
	program_emit(g, OP_UNLESS, 0, base + 1, base + 2);
	program_emit(g, OP_JUMP, 0, 0, 0);
	again = program_here(g);
	value = expression(g, 0);
	total = program_two(g, product ? OP_MUL : OP_ADD, total, value, base + 3);
	program_put(g, (uint16_t)base, total);
	program_emit(g, OP_LOOP, again, base + 1, base + 2);
	if (!pov_failed(p) && program_here(g) < FUNCTION_OPS)
		BUF_AT(&g->op, struct function_op, leave)->a = (uint16_t)program_here(g);
	g->top = base + 1;
	return program_in(base);
}

static struct operand sum(struct program *g, bool product)
{
	struct pov *p = g->p;
	uint32_t base = g->top;
	struct atom *counter;
	struct operand v;

	pov_next(p);
	program_register(g);
	if (g->loop_count == PROGRAM_LOOPS)
		pov_fail(p, "sums stand in sums more than %d deep", PROGRAM_LOOPS);
	if (!pov_expect(p, TOK_LEFT_PAREN, "after the function's name") || !pov_nest(p) || !token_raw_name(p))
		return program_number(0);
	counter = p->tok.atom;
	if (!counter || (counter->kind != TOK_NEW_IDENT && plain_param(counter->kind) < 0))
		pov_fail(p, "expected the name of a counter, found %s", pov_text(p));
	pov_next(p);
	pov_expect(p, TOK_COMMA, "after the counter");
	for (uint32_t i = 0; i < 2; i++) {
		if (i)
			pov_expect(p, TOK_COMMA, "after the first number");
		v = expression(g, 0);
		g->top = base + 1 + i;
		program_put(g, program_register(g), v);
	}
	g->loop[g->loop_count].atom = counter;
	g->loop[g->loop_count++].reg = (uint16_t)(base + 1);
	v = sum_body(g, base, product);
	g->loop_count--;
	pov_expect(p, TOK_RIGHT_PAREN, "after what is added up");
	pov_unnest(p);
	return v;
}

static struct operand word(struct program *g)
{
	struct pov *p = g->p;
	enum pov_token_kind kind = pov_token(p);

	for (size_t i = 0; i < sizeof(math_word) / sizeof(math_word[0]); i++) {
		if (math_word[i].token == kind)
			return math(g, math_word[i].code);
	}
	switch (kind) {
	case TOK_PI:
		pov_next(p);
		return program_number(PI);
	case TOK_CLOCK:
		return program_number(func_float(p));
	case TOK_SELECT:
		return select_one(g);
	case TOK_SUM: case TOK_PROD:
		return sum(g, kind == TOK_PROD);
	default:
		if (plain_param(kind) >= 0)
			pov_fail(p, "%s is no parameter of this function", pov_text(p));
		else
			pov_fail(p, "expected a number, a parameter or a function, found %s", pov_text(p));
		return program_number(0);
	}
}

static struct operand identifier(struct program *g)
{
	struct pov *p = g->p;
	const struct slot *s = &p->tok.value;

	if (s->kind == SLOT_ITEM && s->item_kind == ITEM_FUNCTION)
		return call_user(g);
	if (s->kind != SLOT_NUMBER || s->u.number.count != 1) {
		pov_fail(p, "%s is neither a float nor a function", pov_text(p));
		return program_number(0);
	}
	pov_next(p);
	return program_number(s->u.number.c[0]);
}

static struct operand operand(struct program *g)
{
	struct pov *p = g->p;
	struct operand v = program_number(0);
	int reg;

	pov_token(p);
	reg = variable(g);
	if (reg >= 0) {
		pov_next(p);
		return program_in((uint32_t)reg);
	}
	switch (p->tok.kind) {
	case TOK_NUMBER:
		v = program_number(p->tok.number);
		pov_next(p);
		return v;
	case TOK_IDENT:
		return identifier(g);
	case TOK_LEFT_PAREN:
		pov_next(p);
		if (pov_nest(p))
			v = expression(g, 0);
		pov_expect(p, TOK_RIGHT_PAREN, "");
		pov_unnest(p);
		return v;
	case TOK_NEW_IDENT:
		pov_fail(p, "%s is no parameter of this function either", pov_text(p));
		return v;
	default:
		return word(g);
	}
}

static struct operand signed_operand(struct program *g)
{
	uint32_t base = g->top;

	if (pov_accept(g->p, TOK_DASH))
		return program_one(g, OP_NEG, operand(g), base);
	pov_accept(g->p, TOK_PLUS);
	return operand(g);
}

struct operator {
	unsigned level;
	enum function_code code;
	bool swap;
};

static struct operator operator_of(enum pov_token_kind kind)
{
	switch (kind) {
	case TOK_BAR: return (struct operator){ 1, OP_OR, false };
	case TOK_AMPERSAND: return (struct operator){ 2, OP_AND, false };
	case TOK_EQUALS: return (struct operator){ 3, OP_EQUAL, false };
	case TOK_NOT_EQUAL: return (struct operator){ 3, OP_NOT_EQUAL, false };
	case TOK_LEFT_ANGLE: return (struct operator){ 3, OP_LESS, false };
	case TOK_LESS_EQUAL: return (struct operator){ 3, OP_LESS_EQUAL, false };
	case TOK_RIGHT_ANGLE: return (struct operator){ 3, OP_LESS, true };
	case TOK_GREATER_EQUAL: return (struct operator){ 3, OP_LESS_EQUAL, true };
	case TOK_PLUS: return (struct operator){ 4, OP_ADD, false };
	case TOK_DASH: return (struct operator){ 4, OP_SUB, false };
	case TOK_STAR: return (struct operator){ 5, OP_MUL, false };
	case TOK_SLASH: return (struct operator){ 5, OP_DIV, false };
	default: return (struct operator){ 0, OP_ADD, false };
	}
}

/* Operators that bind tighter than level. */
static struct operand expression(struct program *g, unsigned level)
{
	uint32_t base = g->top;
	struct operand a = signed_operand(g), b;
	struct operator o;

	while (!pov_failed(g->p) && (o = operator_of(pov_token(g->p))).level > level) {
		pov_next(g->p);
		b = expression(g, o.level);
		a = o.swap ? program_two(g, o.code, b, a, base) : program_two(g, o.code, a, b, base);
	}
	return a;
}

/* (a, b, ...) */
static bool read_parameters(struct program *g)
{
	struct pov *p = g->p;

	pov_next(p);
	do {
		if (!token_raw_name(p))
			return false;
		if (!p->tok.atom || (p->tok.atom->kind != TOK_NEW_IDENT && plain_param(p->tok.atom->kind) < 0)) {
			pov_fail(p, "expected a parameter's name, found %s", pov_text(p));
			return false;
		}
		if (g->param_count == FUNCTION_PARAMS) {
			pov_fail(p, "a function has at most %d parameters", FUNCTION_PARAMS);
			return false;
		}
		g->param[g->param_count++] = p->tok.atom;
		pov_next(p);
	} while (pov_accept(p, TOK_COMMA));
	return pov_expect(p, TOK_RIGHT_PAREN, "after the function's parameters");
}

/* internal(N). Of one that is not here, the declaration is no error, but its use. */
static void read_internal(struct program *g)
{
	struct pov *p = g->p;
	struct function *f = &g->out->function;
	struct diag_pos pos = pov_pos(p);
	const char *name;
	char text[80];
	double n;

	pov_next(p);
	pov_expect(p, TOK_LEFT_PAREN, "after internal");
	n = trunc(pov_float(p));
	pov_expect(p, TOK_RIGHT_PAREN, "after the number of an internal function");
	if (pov_failed(p))
		return;
	if (!(n >= 0 && n < 1000) || !internal_name((uint32_t)n)) {
		pov_fail_at(p, &pos, "there is no internal function %g", n);
		return;
	}
	name = internal_name((uint32_t)n);
	f->kind = FUNCTION_INTERNAL;
	f->is.internal = (uint32_t)n;
	f->params = internal_params((uint32_t)n);
	if (!internal_here(f->is.internal)) {
		snprintf(text, sizeof(text), "the internal function %s", name);
		name = arena_strdup(&p->arena, text);
		pov_lack_note(p, &g->out->lack, name ? name : "an internal function", NULL);
	}
}

static void read_transform(struct program *g)
{
	struct function *f = &g->out->function;
	struct xform x = xform_identity;

	f->kind = FUNCTION_TRANSFORM;
	f->results = 3;
	pov_transform(g->p, &x);
	f->is.place = x.fwd;
}

static void read_pigment(struct program *g)
{
	struct function *f = &g->out->function;
	struct pov_pigment *pigment;

	pigment = pov_read_pigment(g->p, &pov_default_texture(g->p)->layer[0].pigment);
	if (!pigment)
		return;
	f->kind = FUNCTION_PIGMENT;
	f->results = 5;
	f->is.pigment = &pigment->pigment;
	pov_lack_add(&g->out->lack, &pigment->lack);
	g->out->depth = pigment->depth + 1;
}

/* pattern { ... }: the value alone, so there is no map. */
static void read_pattern(struct program *g)
{
	struct function *f = &g->out->function;
	struct pov *p = g->p;
	struct pattern_draft d;

	if (!pov_open(p))
		return;
	pattern_draft_init(&d, IN_PIGMENT, NULL);
	if (!pattern_word(p, &d) && !pov_failed(p))
		pov_fail(p, "expected a pattern, found %s", pov_text(p));
	pattern_modifiers(p, &d);
	if (!pov_close(p, "pattern"))
		return;
	f->kind = FUNCTION_PATTERN;
	f->is.pattern = pattern_finish(p, &d);
	pov_lack_add(&g->out->lack, &d.lack);
	g->out->depth = d.map.depth + 1;
}

static void read_body(struct program *g)
{
	struct pov *p = g->p;
	struct function *f = &g->out->function;

	f->params = 3;
	f->results = 1;
	switch (pov_token(p)) {
	case TOK_INTERNAL:
		read_internal(g);
		break;
	case TOK_TRANSFORM:
		read_transform(g);
		break;
	case TOK_SPLINE:
		f->kind = FUNCTION_SPLINE;
		f->params = 1;
		f->is.spline = spline_read(p);
		f->results = f->is.spline ? f->is.spline->terms : 0;
		break;
	case TOK_PIGMENT:
		read_pigment(g);
		break;
	case TOK_PATTERN:
		read_pattern(g);
		break;
	default:
		program_finish(g, expression(g, 0));
		return;
	}
	f->registers = f->total = f->params;
}

/* Of what is called, the hash is known: it may be called more often than there is time to follow. */
static uint64_t hash_program(uint64_t h, const struct function *f)
{
	h = hash_bytes(h, f->is.program.op, f->is.program.op_count * sizeof(*f->is.program.op));
	h = hash_bytes(h, f->is.program.constant, f->is.program.constant_count * sizeof(*f->is.program.constant));
	for (uint32_t i = 0; i < f->is.program.call_count; i++) {
		h = HASH(h, f->is.program.call[i].function->hash);
		h = HASH(h, f->is.program.call[i].member);
	}
	return HASH(h, f->is.program.result);
}

static uint64_t hash_spline(uint64_t h, const struct spline *s)
{
	h = HASH(h, s->kind);
	h = HASH(h, s->terms);
	h = hash_bytes(h, s->at, s->count * sizeof(*s->at));
	return hash_bytes(h, s->value, s->count * FUNCTION_RESULTS * sizeof(*s->value));
}

static uint64_t hash_function(const struct function *f)
{
	uint64_t h = 14695981039346656037u;

	h = HASH(h, f->kind);
	h = HASH(h, f->params);
	switch (f->kind) {
	case FUNCTION_PROGRAM: return hash_program(h, f);
	case FUNCTION_INTERNAL: return HASH(h, f->is.internal);
	case FUNCTION_TRANSFORM: return HASH(h, f->is.place);
	case FUNCTION_SPLINE: return hash_spline(h, f->is.spline);
	default: return h;
	}
}

struct pov_function *function_read(struct pov *p)
{
	struct program g = {
		.p = p, .op = { .size = sizeof(struct function_op) }, .constant = { .size = sizeof(double) },
		.call = { .size = sizeof(struct function_call) }
	};
	bool named = pov_token(p) == TOK_LEFT_PAREN;

	g.out = pov_alloc(p, sizeof(*g.out));
	if (!g.out || (named && !read_parameters(&g)))
		return NULL;
	if (!named) {
		g.plain = true;
		g.param_count = 3;
	}
	g.top = g.most = g.param_count;
	if (!pov_expect(p, TOK_LEFT_BRACE, "before what the function is") || !pov_nest(p))
		return NULL;
	read_body(&g);
	pov_expect(p, TOK_RIGHT_BRACE, "at the end of the function");
	pov_unnest(p);
	program_release(&g);
	if (pov_failed(p))
		return NULL;
	g.out->function.hash = hash_function(&g.out->function);
	return g.out;
}

bool function_of_points(struct pov *p, const struct diag_pos *pos, const struct pov_function *f)
{
	uint32_t params = f->function.params, results = f->function.results;

	if (params == 3 && results == 1)
		return true;
	pov_fail_at(p, pos, "this function takes %u argument%s and gives %u number%s; here it has to take x, y and z "
		    "and give one", params, params == 1 ? "" : "s", results, results == 1 ? "" : "s");
	return false;
}

void function_call(struct pov *p, struct pov_value *v)
{
	const struct pov_function *f = p->tok.value.u.item;
	double arg[FUNCTION_PARAMS], out[FUNCTION_RESULTS] = { 0 };
	uint32_t wanted = v->count;

	if (!pov_lack_use(p, &f->lack))
		return;
	pov_next(p);
	pov_expect(p, TOK_LEFT_PAREN, "after the function's name");
	for (uint32_t i = 0; i < f->function.params && !pov_failed(p) && pov_nest(p); i++) {
		if (i && !pov_accept(p, TOK_COMMA))
			pov_fail(p, "expected a comma and argument %u of the %u that the function takes, found %s",
				 i + 1, f->function.params, pov_text(p));
		arg[i] = expr_float(p);
		pov_unnest(p);
	}
	pov_expect(p, TOK_RIGHT_PAREN, "after the function's arguments");
	if (pov_failed(p))
		return;
	if (!f->lack.construct)
		pov_charge(p, function_eval(pov_scene(p), &f->function, arg, out) / 16);
	v->count = f->function.results > 1 ? f->function.results : wanted;
	for (uint32_t i = 0; i < v->count; i++)
		v->c[i] = out[f->function.results > 1 ? i : 0];
}
