/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * User functions (POV-Ray's manual 3.3.1.8) as data: a short program for a register machine, or one of the
 * other things that can stand behind a function's name. pattern/function.h evaluates them.
 *
 * A function calls only functions that were there before it, so calls end; what a call needs in registers
 * and depth is known when it is compiled.
 */
#ifndef ALIDADE_SCENE_FUNCTION_H
#define ALIDADE_SCENE_FUNCTION_H

#include <stdint.h>

#include "base/vec.h"

#define FUNCTION_PARAMS 56
#define FUNCTION_RESULTS 5
#define FUNCTION_OPS 60000u /* of one program */
#define FUNCTION_REGISTERS 4096u /* of a function and all that it calls, one below the other */

struct pigment;
struct pattern;

/* to, a and b are registers unless said otherwise; k is constant[b], l is constant[a]. */
enum function_code {
	OP_LOAD, /* to = k */
	OP_MOVE, /* to = a */
	OP_ADD, OP_SUB, OP_MUL, OP_DIV,
	OP_ADD_K, OP_SUB_K, OP_MUL_K, OP_DIV_K, /* a op k */
	OP_K_SUB, OP_K_DIV, /* l op b */
	OP_NEG,
	OP_LESS, OP_LESS_EQUAL, OP_EQUAL, OP_NOT_EQUAL, OP_AND, OP_OR, /* give 0 or 1 */
	OP_ABS, OP_ACOS, OP_ACOSH, OP_ASIN, OP_ASINH, OP_ATAN, OP_ATANH, OP_CEIL, OP_COS, OP_COSH, OP_DEGREES,
	OP_EXP, OP_FLOOR, OP_INT, OP_LN, OP_LOG, OP_RADIANS, OP_SIN, OP_SINH, OP_SQRT, OP_TAN, OP_TANH,
	OP_ATAN2, OP_INT_DIV, OP_MAX, OP_MIN, OP_MOD, OP_POW,
	OP_SELECT, /* to = a < 0 ? b : b + 1 */
	OP_SELECT_ZERO, /* to = a < 0 ? b : a == 0 ? b + 1 : b + 2 */
	OP_CALL, /* to = call[b] with arguments from a on */
	OP_UNLESS, /* leave out the next op if a <= b, which are the counter and the end of a sum */
	OP_JUMP, /* to op a */
	OP_LOOP, /* back to op to while (a = a + 1) <= b */
	OP_CODES
};

struct function_op {
	uint16_t code, to, a, b;
};

/* What of a result a program uses. */
enum function_member { MEMBER_FIRST, MEMBER_GREY = FUNCTION_RESULTS, MEMBER_HF };

struct function_call {
	const struct function *function;
	uint32_t member; /* number of a component, or of enum function_member */
};

enum spline_kind { SPLINE_LINEAR, SPLINE_QUADRATIC, SPLINE_CUBIC, SPLINE_NATURAL };

struct spline {
	enum spline_kind kind;
	uint32_t count, terms; /* points; components of each, 2 to 5 */
	double *at; /* [count], rising */
	double *value; /* [count * FUNCTION_RESULTS] */
	double *bend; /* natural: second derivatives [count * FUNCTION_RESULTS]; else NULL */
};

enum function_kind {
	FUNCTION_PROGRAM,
	FUNCTION_INTERNAL, /* POV-Ray's own, by number: functions.inc */
	FUNCTION_PATTERN, FUNCTION_PIGMENT, FUNCTION_TRANSFORM, FUNCTION_SPLINE
};

struct function {
	enum function_kind kind;
	uint32_t params, results;
	uint32_t registers; /* of this one; the first are its arguments */
	uint32_t total; /* with those of what it calls */
	uint64_t hash; /* of all that it is and calls, but for patterns and pigments, which the scene lists */
	union {
		struct {
			uint32_t op_count, constant_count, call_count;
			uint16_t result; /* a register */
			struct function_op *op;
			double *constant;
			struct function_call *call;
		} program;
		uint32_t internal;
		struct pattern *pattern;
		struct pigment *pigment;
		struct mat place; /* of points */
		struct spline *spline;
	} is;
};

#endif
