/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A register machine. Arithmetic is IEEE's, as POV-Ray's was measured to be: 1/0 is infinite, sqrt(-1) is NaN,
 * comparisons are exact (those outside of functions are not).
 */
#include <config.h>

#include "pattern/function.h"

#include <math.h>

#include "base/single.h"
#include "pattern/pattern.h"

#define FEW 128u
#define PI 3.14159265358979323846

struct machine {
	const struct scene *scene;
	uint64_t turns;
	bool endless;
};

static void evaluate(struct machine *, const struct function *, double *reg, double *out);

/* POV-Ray's colours are single precision. */
static double single(double v)
{
	return as_single(v);
}

static double member(const double *v, uint32_t m)
{
	if (m < FUNCTION_RESULTS)
		return v[m];
	if (m == MEMBER_GREY)
		return single(rgb_grey(rgb_make(v[0], v[1], v[2])));
	return single(0.996093 * v[0] + 0.003906 * v[1]); /* hf: red as the high, green as the low byte */
}

/* A call, or a turn of a loop, was made; false: there were too many. */
static bool turn(struct machine *m)
{
	if (++m->turns <= FUNCTION_TURNS)
		return true;
	m->endless = true;
	return false;
}

static double call(struct machine *m, const struct function_call *c, const double *arg, double *free_reg)
{
	double out[FUNCTION_RESULTS] = { 0 };

	/* A function that calls another twice, which calls another twice ... */
	if (!turn(m))
		return (double)NAN;
	for (uint32_t i = 0; i < c->function->params; i++)
		free_reg[i] = arg[i];
	evaluate(m, c->function, free_reg, out);
	return c->function->results > 1 ? member(out, c->member) : out[0];
}

static double math_one(enum function_code code, double v)
{
	switch (code) {
	case OP_ABS: return fabs(v);
	case OP_ACOS: return acos(v);
	case OP_ACOSH: return acosh(v);
	case OP_ASIN: return asin(v);
	case OP_ASINH: return asinh(v);
	case OP_ATAN: return atan(v);
	case OP_ATANH: return atanh(v);
	case OP_CEIL: return ceil(v);
	case OP_COS: return cos(v);
	case OP_COSH: return cosh(v);
	case OP_DEGREES: return v * 180 / PI;
	case OP_EXP: return exp(v);
	case OP_FLOOR: return floor(v);
	case OP_INT: return trunc(v);
	case OP_LN: return log(v);
	case OP_LOG: return log10(v);
	case OP_RADIANS: return v * PI / 180;
	case OP_SIN: return sin(v);
	case OP_SINH: return sinh(v);
	case OP_SQRT: return sqrt(v);
	case OP_TAN: return tan(v);
	default: return tanh(v);
	}
}

static double math_two(enum function_code code, double a, double b)
{
	switch (code) {
	case OP_ATAN2: return atan2(a, b);
	case OP_INT_DIV: return trunc(a / b);
	case OP_MAX: return a < b ? b : a;
	case OP_MIN: return b < a ? b : a;
	case OP_MOD: return fmod(a, b);
	default: return pow(a, b);
	}
}

static double run(struct machine *m, const struct function *f, double *r)
{
	const struct function_op *op = f->is.program.op, *end = op + f->is.program.op_count;
	const double *k = f->is.program.constant;

	for (; op < end; op++) {
		switch (op->code) {
		case OP_LOAD: r[op->to] = k[op->b]; break;
		case OP_MOVE: r[op->to] = r[op->a]; break;
		case OP_ADD: r[op->to] = r[op->a] + r[op->b]; break;
		case OP_SUB: r[op->to] = r[op->a] - r[op->b]; break;
		case OP_MUL: r[op->to] = r[op->a] * r[op->b]; break;
		case OP_DIV: r[op->to] = r[op->a] / r[op->b]; break;
		case OP_ADD_K: r[op->to] = r[op->a] + k[op->b]; break;
		case OP_SUB_K: r[op->to] = r[op->a] - k[op->b]; break;
		case OP_MUL_K: r[op->to] = r[op->a] * k[op->b]; break;
		case OP_DIV_K: r[op->to] = r[op->a] / k[op->b]; break;
		case OP_K_SUB: r[op->to] = k[op->a] - r[op->b]; break;
		case OP_K_DIV: r[op->to] = k[op->a] / r[op->b]; break;
		case OP_NEG: r[op->to] = -r[op->a]; break;
		case OP_LESS: r[op->to] = r[op->a] < r[op->b]; break;
		case OP_LESS_EQUAL: r[op->to] = r[op->a] <= r[op->b]; break;
		case OP_EQUAL: r[op->to] = r[op->a] == r[op->b]; break;
		case OP_NOT_EQUAL: r[op->to] = r[op->a] != r[op->b]; break;
		case OP_AND: r[op->to] = r[op->a] != 0 && r[op->b] != 0; break;
		case OP_OR: r[op->to] = r[op->a] != 0 || r[op->b] != 0; break;
		case OP_SELECT: r[op->to] = r[op->b + !(r[op->a] < 0)]; break;
		case OP_SELECT_ZERO:
			r[op->to] = r[op->b + (r[op->a] < 0 ? 0 : r[op->a] == 0 ? 1 : 2)];
			break;
		case OP_CALL:
			r[op->to] = call(m, &f->is.program.call[op->b], r + op->a, r + f->registers);
			break;
		case OP_UNLESS:
			op += r[op->a] <= r[op->b];
			break;
		case OP_JUMP:
			op = f->is.program.op + op->a - 1;
			break;
		case OP_LOOP:
			r[op->a] += 1;
			if (r[op->a] <= r[op->b]) {
				if (!turn(m))
					return (double)NAN;
				op = f->is.program.op + op->to - 1;
			}
			break;
		default:
			if (op->code < OP_ATAN2)
				r[op->to] = math_one((enum function_code)op->code, r[op->a]);
			else
				r[op->to] = math_two((enum function_code)op->code, r[op->a], r[op->b]);
		}
		if (m->endless)
			return (double)NAN;
	}
	return r[f->is.program.result];
}

static void pigment(const struct machine *m, const struct function *f, const double *arg, double *out)
{
	const struct pattern_point at = { .p = vec_make(arg[0], arg[1], arg[2]), .n = { 0, 0, 1 },
					  .dir = { 0, 0, -1 } };
	struct rgbft c = pigment_at(m->scene, f->is.pigment, &at);

	out[0] = single(c.r);
	out[1] = single(c.g);
	out[2] = single(c.b);
	out[3] = single(c.filter);
	out[4] = single(c.transmit);
}

static double pattern(const struct machine *m, const struct function *f, const double *arg)
{
	const struct pattern_point at = { .p = vec_make(arg[0], arg[1], arg[2]), .n = { 0, 0, 1 },
					  .dir = { 0, 0, -1 } };

	return pattern_value(m->scene, f->is.pattern, &at);
}

static void evaluate(struct machine *m, const struct function *f, double *reg, double *out)
{
	vec p;

	switch (f->kind) {
	case FUNCTION_PROGRAM: out[0] = run(m, f, reg); return;
	case FUNCTION_INTERNAL: out[0] = internal_eval(m->scene, f->is.internal, reg); return;
	case FUNCTION_PATTERN: out[0] = pattern(m, f, reg); return;
	case FUNCTION_PIGMENT: pigment(m, f, reg, out); return;
	case FUNCTION_TRANSFORM:
		p = mat_point(&f->is.place, vec_make(reg[0], reg[1], reg[2]));
		out[0] = p.x;
		out[1] = p.y;
		out[2] = p.z;
		return;
	case FUNCTION_SPLINE: spline_eval(f->is.spline, f->is.spline->kind, reg[0], out); return;
	}
}

/* Few need many registers, and the stack's pages would be strewn about the cache. */
static uint64_t eval_large(const struct scene *s, const struct function *f, const double *arg, double *out)
{
	struct machine m = { .scene = s };
	double reg[FUNCTION_REGISTERS];

	for (uint32_t i = 0; i < f->params; i++)
		reg[i] = arg[i];
	evaluate(&m, f, reg, out);
	return m.turns;
}

uint64_t function_eval(const struct scene *s, const struct function *f, const double *arg,
		       double out[FUNCTION_RESULTS])
{
	struct machine m = { .scene = s };
	double reg[FEW];

	if (f->total > FEW)
		return eval_large(s, f, arg, out);
	for (uint32_t i = 0; i < f->params; i++)
		reg[i] = arg[i];
	evaluate(&m, f, reg, out);
	return m.turns;
}

double function_at(const struct scene *s, const struct function *f, vec p)
{
	double out[FUNCTION_RESULTS];

	function_eval(s, f, (double[3]){ p.x, p.y, p.z }, out);
	return out[0];
}
