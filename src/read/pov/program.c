/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Writing programs for the machine of pattern/function.c. Registers are a stack: the arguments, the counters of
 * open sums, then what an expression has computed so far. What is known is computed at once.
 */
#include <config.h>

#include "read/pov/program.h"

#include <math.h>
#include <string.h>

#include "pattern/function.h"

/* Each call takes as many registers at least, so that their number bounds the depth of the C stack too. */
#define CALL_LEAST 4u

static bool room(struct program *g, struct buf *b)
{
	if (b->count >= FUNCTION_OPS) {
		pov_fail(g->p, "the function is too long: it needs more than %u steps", FUNCTION_OPS);
		return false;
	}
	if (!pov_charge_memory(g->p, b->size) || !buf_reserve(b, g->p->book, "reading", 1)) {
		pov_no_memory(g->p);
		return false;
	}
	return true;
}

void program_emit(struct program *g, enum function_code code, uint32_t to, uint32_t a, uint32_t b)
{
	if (!pov_failed(g->p) && room(g, &g->op))
		*BUF_AT(&g->op, struct function_op, g->op.count++) =
			(struct function_op){ (uint16_t)code, (uint16_t)to, (uint16_t)a, (uint16_t)b };
}

uint32_t program_here(const struct program *g)
{
	return g->op.count;
}

uint16_t program_register(struct program *g)
{
	if (g->top >= FUNCTION_REGISTERS / 4) {
		pov_fail(g->p, "the function's expressions are nested too deeply");
		return 0;
	}
	if (++g->top > g->most)
		g->most = g->top;
	return (uint16_t)(g->top - 1);
}

struct operand program_number(double k)
{
	return (struct operand){ .constant = true, .k = k };
}

struct operand program_in(uint32_t reg)
{
	return (struct operand){ .reg = (uint16_t)reg };
}

static uint32_t constant(struct program *g, double k)
{
	const double *have = g->constant.data;

	for (uint32_t i = g->constant.count; i > 0 && i + 16 > g->constant.count; i--) {
		if (!memcmp(&have[i - 1], &k, sizeof(k)))
			return i - 1;
	}
	if (pov_failed(g->p) || !room(g, &g->constant))
		return 0;
	*BUF_AT(&g->constant, double, g->constant.count) = k;
	return g->constant.count++;
}

void program_put(struct program *g, uint16_t reg, struct operand v)
{
	if (v.constant)
		program_emit(g, OP_LOAD, reg, 0, constant(g, v.k));
	else if (v.reg != reg)
		program_emit(g, OP_MOVE, reg, v.reg, 0);
}

uint16_t program_load(struct program *g, struct operand v)
{
	uint16_t reg;

	if (!v.constant)
		return v.reg;
	reg = program_register(g);
	program_put(g, reg, v);
	return reg;
}

/* By the machine itself, so that it makes no difference. */
static double fold(struct program *g, enum function_code code, double a, double b)
{
	struct function_op op = { (uint16_t)code, 0, 0, 1 };
	struct function f = { .kind = FUNCTION_PROGRAM, .params = 2, .results = 1, .registers = 2, .total = 2 };
	double out[FUNCTION_RESULTS];

	f.is.program.op_count = 1;
	f.is.program.op = &op;
	function_eval(pov_scene(g->p), &f, (double[2]){ a, b }, out);
	return out[0];
}

static struct operand result(struct program *g, uint32_t base)
{
	g->top = base;
	return program_in(program_register(g));
}

struct operand program_two(struct program *g, enum function_code code, struct operand a, struct operand b,
			   uint32_t base)
{
	struct operand to;
	uint32_t ra, rb;

	if (code == OP_DIV && !a.constant && b.constant && b.k == 0)
		pov_fail(g->p, "division by zero");
	if (a.constant && b.constant) {
		g->top = base;
		return program_number(fold(g, code, a.k, b.k));
	}
	if (code <= OP_DIV && b.constant) {
		to = result(g, base);
		program_emit(g, (enum function_code)(code - OP_ADD + OP_ADD_K), to.reg, a.reg, constant(g, b.k));
		return to;
	}
	if (code <= OP_DIV && a.constant) {
		to = result(g, base);
		if (code == OP_ADD || code == OP_MUL)
			program_emit(g, code == OP_ADD ? OP_ADD_K : OP_MUL_K, to.reg, b.reg, constant(g, a.k));
		else
			program_emit(g, code == OP_SUB ? OP_K_SUB : OP_K_DIV, to.reg, constant(g, a.k), b.reg);
		return to;
	}
	ra = program_load(g, a);
	rb = program_load(g, b);
	to = result(g, base);
	program_emit(g, code, to.reg, ra, rb);
	return to;
}

struct operand program_one(struct program *g, enum function_code code, struct operand a, uint32_t base)
{
	struct operand to;

	if (a.constant) {
		g->top = base;
		return program_number(fold(g, code, a.k, 0));
	}
	to = result(g, base);
	program_emit(g, code, to.reg, a.reg, 0);
	return to;
}

struct operand program_call(struct program *g, const struct pov_function *f, uint32_t first, uint32_t member,
			    uint32_t base)
{
	struct operand to = result(g, base);

	pov_lack_add(&g->out->lack, &f->lack);
	if (f->depth > g->out->depth)
		g->out->depth = f->depth;
	if (f->function.total > g->called)
		g->called = f->function.total;
	if (pov_failed(g->p) || !room(g, &g->call))
		return to;
	*BUF_AT(&g->call, struct function_call, g->call.count) = (struct function_call){ &f->function, member };
	program_emit(g, OP_CALL, to.reg, first, g->call.count++);
	return to;
}

static void *keep(struct program *g, const struct buf *b)
{
	void *to = pov_alloc(g->p, (size_t)b->count * b->size + 1);

	if (to && b->count)
		memcpy(to, b->data, (size_t)b->count * b->size);
	return to;
}

bool program_finish(struct program *g, struct operand v)
{
	struct function *f = &g->out->function;

	f->is.program.result = program_load(g, v);
	f->kind = FUNCTION_PROGRAM;
	f->params = g->param_count;
	f->results = 1;
	f->registers = g->most < CALL_LEAST ? CALL_LEAST : g->most;
	f->total = f->registers + g->called;
	if (f->total > FUNCTION_REGISTERS)
		pov_fail(g->p, "the function, with what it calls, needs %u registers, of which there are %u", f->total,
			 FUNCTION_REGISTERS);
	f->is.program.op_count = g->op.count;
	f->is.program.op = keep(g, &g->op);
	f->is.program.constant_count = g->constant.count;
	f->is.program.constant = keep(g, &g->constant);
	f->is.program.call_count = g->call.count;
	f->is.program.call = keep(g, &g->call);
	return !pov_failed(g->p);
}

void program_release(struct program *g)
{
	buf_release(&g->op);
	buf_release(&g->constant);
	buf_release(&g->call);
}
