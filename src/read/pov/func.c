/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Functions that give a float or a vector (manual 3.3.1.5, 3.3.1.6), and random numbers.
 */
#include <config.h>

#include "read/pov/internal.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/single.h"
#include "pattern/noise.h"
#include "read/pov/number.h"

#define PI 3.14159265358979323846
#define RADIANS (PI / 180)

static void open_paren(struct pov *p)
{
	pov_expect(p, TOK_LEFT_PAREN, "after the function's name");
	pov_nest(p);
}

static void close_paren(struct pov *p)
{
	pov_expect(p, TOK_RIGHT_PAREN, "after the function's arguments");
	pov_unnest(p);
}

static double one(struct pov *p)
{
	double a;

	open_paren(p);
	a = expr_float(p);
	close_paren(p);
	return a;
}

static void two(struct pov *p, double *a, double *b)
{
	open_paren(p);
	*a = expr_float(p);
	pov_comma(p);
	*b = expr_float(p);
	close_paren(p);
}

static vec vector(struct pov *p)
{
	struct pov_value v = { POV_VECTOR, 3, { 0 } };

	expr_number(p, &v, 3);
	if (v.count > 3)
		pov_fail(p, "expected a vector of 3 components before %s", pov_text(p));
	return vec_make(v.c[0], v.c[1], v.c[2]);
}

static void two_vectors(struct pov *p, vec *a, vec *b)
{
	open_paren(p);
	*a = vector(p);
	pov_comma(p);
	*b = vector(p);
	close_paren(p);
}

/* As a cast to int in POV-Ray, whose result for what does not fit is that of x86. */
static int to_int(double v)
{
	return v > -2147483649.0 && v < 2147483648.0 ? (int)v : INT_MIN;
}

static double domain(struct pov *p, const struct diag_pos *pos, const char *name, double v)
{
	if (v >= -1 && v <= 1)
		return v;
	pov_warn(p, pos, "%s of %g, which is outside -1 to 1", name, v);
	return v > 1 ? 1 : -1;
}

static double positive(struct pov *p, const struct diag_pos *pos, const char *name, double v, bool zero)
{
	if (v > 0 || (zero && v == 0))
		return v;
	pov_fail_at(p, pos, "%s of %g", name, v);
	return 1;
}

/* bitwise_and(), min() and others with any number of arguments. */
static double many(struct pov *p, enum pov_token_kind kind)
{
	double a, b;

	open_paren(p);
	a = expr_float(p);
	if (kind != TOK_MIN && kind != TOK_MAX)
		a = to_int(a);
	while (pov_accept(p, TOK_COMMA)) {
		b = expr_float(p);
		switch (kind) {
		case TOK_MIN: a = b < a ? b : a; break;
		case TOK_MAX: a = b > a ? b : a; break;
		case TOK_BITWISE_AND: a = to_int(a) & to_int(b); break;
		case TOK_BITWISE_OR: a = to_int(a) | to_int(b); break;
		default: a = to_int(a) ^ to_int(b); break;
		}
	}
	close_paren(p);
	return a;
}

static double select_value(struct pov *p)
{
	double v, less, equal, greater;

	open_paren(p);
	v = expr_float(p);
	pov_comma(p);
	less = expr_float(p);
	pov_comma(p);
	equal = expr_float(p);
	greater = pov_accept(p, TOK_COMMA) ? expr_float(p) : equal;
	close_paren(p);
	return v < 0 ? less : v == 0 ? equal : greater;
}

static double dimensions(struct pov *p, bool size)
{
	const struct array *a;
	uint32_t dims, sizes[POV_ARRAY_DIMS];
	double i;

	open_paren(p);
	if (pov_token(p) != TOK_IDENT || p->tok.value.kind != SLOT_ARRAY) {
		pov_fail(p, "expected an array's identifier, found %s", pov_text(p));
		return 0;
	}
	a = p->tok.value.u.array;
	dims = a->dims;
	memcpy(sizes, a->size, sizeof(sizes));
	pov_next(p);
	if (!size) {
		close_paren(p);
		return dims;
	}
	pov_comma(p);
	i = trunc(expr_float(p));
	close_paren(p);
	return i >= 1 && i <= dims ? sizes[(uint32_t)i - 1] : 0;
}

/* Functions that need the scene's geometry, a clock or noise: their arguments are passed over. */
static bool unsupported(struct pov *p, const struct diag_pos *pos, const char *name)
{
	int depth = 0;
	char what[64] = "the function ";
	const char *remedy = "declare the value itself";

	strncat(what, name, sizeof(what) - strlen(what) - 1);
	if (!strcmp(name, "now"))
		remedy = "a scene gives the same picture whenever it is rendered";
	if (!pov_unsupported(p, pos, what, remedy))
		return false;
	if (pov_token(p) != TOK_LEFT_PAREN)
		return true;
	do {
		if (pov_token(p) == TOK_LEFT_PAREN)
			depth++;
		else if (p->tok.kind == TOK_RIGHT_PAREN)
			depth--;
		pov_next(p);
	} while (depth && !p->failed);
	return true;
}

static char *string_one(struct pov *p)
{
	char *s;

	open_paren(p);
	s = pov_string(p);
	close_paren(p);
	return s;
}

/* atof(): what does not begin with a number is 0. */
static double string_value(const char *s)
{
	bool negative = false;
	double v = 0;

	while (*s == ' ' || (*s >= '\t' && *s <= '\r'))
		s++;
	if (*s == '+' || *s == '-')
		negative = *s++ == '-';
	number_parse(s, s + strlen(s), &v);
	return negative ? -v : v;
}

static double compare_function(struct pov *p)
{
	char *a, *b;

	open_paren(p);
	a = pov_string(p);
	pov_comma(p);
	b = pov_string(p);
	close_paren(p);
	if (!a || !b)
		return 0;
	for (; *a && *a == *b; a++, b++)
		;
	return (unsigned char)*a - (unsigned char)*b;
}

static double string_float(struct pov *p, enum pov_token_kind kind)
{
	char *s;

	if (kind == TOK_STRCMP)
		return compare_function(p);
	if (kind == TOK_FILE_EXISTS) {
		open_paren(p);
		s = pov_path(p);
		close_paren(p);
		return s && source_exists(p, s);
	}
	s = string_one(p);
	if (!s)
		return 0;
	pov_charge(p, strlen(s) / 64);
	return kind == TOK_VAL ? string_value(s) : kind == TOK_ASC ? (unsigned char)s[0] : (double)strlen(s);
}

/* POV-Ray's streams are one linear congruential generator each. */
double stream_seed(struct pov *p, uint32_t seed)
{
	if (p->streams.count >= POV_STREAMS_MAX) {
		pov_fail(p, "more than %d calls of seed()", POV_STREAMS_MAX);
		return 0;
	}
	if (!buf_reserve(&p->streams, p->book, "reading", 1)) {
		pov_no_memory(p);
		return 0;
	}
	*BUF_AT(&p->streams, uint32_t, p->streams.count) = seed;
	return p->streams.count++;
}

double stream_rand(struct pov *p, double stream)
{
	uint32_t *s;

	if (!(stream > -1 && stream < p->streams.count)) {
		pov_fail(p, "there is no random number stream %g; get one from seed()", stream);
		return 0;
	}
	s = BUF_AT(&p->streams, uint32_t, (uint32_t)stream);
	*s = *s * 1812433253u + 12345u;
	return *s / 4294967295.0;
}

static double arithmetic(struct pov *p, enum pov_token_kind kind, const struct diag_pos *pos)
{
	double a, b;

	switch (kind) {
	case TOK_ABS: return fabs(one(p));
	case TOK_ACOS: return acos(domain(p, pos, "acos", one(p)));
	case TOK_ASIN: return asin(domain(p, pos, "asin", one(p)));
	case TOK_ACOSH: return acosh(one(p));
	case TOK_ASINH: return asinh(one(p));
	case TOK_ATANH: return atanh(one(p));
	case TOK_ATAN: return atan(one(p));
	case TOK_CEIL: return ceil(one(p));
	case TOK_COS: return cos(one(p));
	case TOK_COSH: return cosh(one(p));
	case TOK_DEGREES: return one(p) / RADIANS;
	case TOK_EXP: return exp(one(p));
	case TOK_FLOOR: return floor(one(p));
	case TOK_INT: return to_int(one(p));
	case TOK_LN: return log(positive(p, pos, "ln", one(p), false));
	case TOK_LOG: return log10(positive(p, pos, "log", one(p), false));
	case TOK_RADIANS: return one(p) * RADIANS;
	case TOK_SIN: return sin(one(p));
	case TOK_SINH: return sinh(one(p));
	case TOK_SQR: a = one(p); return a * a;
	case TOK_SQRT: return sqrt(positive(p, pos, "sqrt", one(p), true));
	case TOK_TAN: return tan(one(p));
	case TOK_TANH: return tanh(one(p));
	case TOK_ATAN2:
		two(p, &a, &b);
		if (!truth(a) && !truth(b))
			pov_fail_at(p, pos, "atan2 of 0, 0");
		return atan2(a, b);
	case TOK_DIV:
		two(p, &a, &b);
		return to_int(a / b);
	case TOK_MOD:
		two(p, &a, &b);
		return fmod(a, b);
	default: /* pow */
		two(p, &a, &b);
		if (a == 0 && b == 0)
			pov_fail_at(p, pos, "pow of 0, 0");
		return pow(a, b);
	}
}

/* The frames that are drawn are taken for the whole animation where nobody says how long that is; a scene
 * that asks is drawn all the same, but its author should know. */
static double clock_value(struct pov *p, const struct diag_pos *pos)
{
	if (p->options->frame.guessed && !p->clock_warned) {
		p->clock_warned = true;
		pov_warn(p, pos, "clock runs from 0 to 1 over the frames %u to %u that were asked for; if they "
			 "are part of an animation, --range=FIRST..LAST says how long that is",
			 p->options->frame.initial, p->options->frame.final);
	}
	return p->options->frame.clock;
}

double func_float(struct pov *p)
{
	enum pov_token_kind kind = pov_token(p);
	struct diag_pos pos = pov_pos(p);
	vec a, b;

	pov_next(p);
	switch (kind) {
	case TOK_CLOCK: return clock_value(p, &pos);
	case TOK_CLOCK_ON: return p->options->frame.clock_on;
	case TOK_PI: return PI;
	case TOK_TRUE: case TOK_YES: case TOK_ON: return 1;
	case TOK_FALSE: case TOK_NO: case TOK_OFF: return 0;
	case TOK_VERSION: return p->version / 100.0;
	case TOK_DEFINED: return cond_defined(p);
	case TOK_DIMENSIONS: case TOK_DIMENSION_SIZE: return dimensions(p, kind == TOK_DIMENSION_SIZE);
	case TOK_BITWISE_AND: case TOK_BITWISE_OR: case TOK_BITWISE_XOR: case TOK_MIN: case TOK_MAX:
		return many(p, kind);
	case TOK_SELECT: return select_value(p);
	case TOK_SEED: return stream_seed(p, (uint32_t)to_int(one(p)));
	case TOK_RAND: return stream_rand(p, one(p));
	case TOK_VAL: case TOK_ASC: case TOK_STRLEN: case TOK_STRCMP: case TOK_FILE_EXISTS:
		return string_float(p, kind);
	case TOK_VDOT:
		two_vectors(p, &a, &b);
		return vec_dot(a, b);
	case TOK_VLENGTH:
		open_paren(p);
		a = vector(p);
		close_paren(p);
		return vec_length(a);
	case TOK_INSIDE: case TOK_NOW: case TOK_SUM: case TOK_PROD:
		unsupported(p, &pos, keyword_text(kind));
		return 0;
	default:
		return arithmetic(p, kind, &pos);
	}
}

static vec axis_rotate(struct pov *p)
{
	vec a, axis;
	struct xform x;
	double angle;

	open_paren(p);
	a = vector(p);
	pov_comma(p);
	axis = vector(p);
	pov_comma(p);
	angle = expr_float(p);
	close_paren(p);
	x = xform_axis_rotate(axis, angle);
	return mat_point(&x.fwd, a);
}

/* Lambda and omega are single precision in POV-Ray, as its digits show. */
static vec vturbulence(struct pov *p)
{
	double lambda, omega, octaves;
	vec a;

	open_paren(p);
	lambda = expr_float(p);
	pov_comma(p);
	omega = expr_float(p);
	pov_comma(p);
	octaves = expr_float(p);
	pov_comma(p);
	a = vector(p);
	close_paren(p);
	octaves = octaves > 1 ? octaves < 10 ? octaves : 10 : 1;
	return noise_vector_turbulence(a, (uint32_t)octaves, as_single(lambda), as_single(omega));
}

void func_vector(struct pov *p, struct pov_value *v, uint32_t terms)
{
	enum pov_token_kind kind = pov_token(p);
	struct diag_pos pos = pov_pos(p);
	struct xform turn;
	vec a = { 0, 0, 0 }, b;

	pov_next(p);
	v->count = terms < 3 ? 3 : terms;
	switch (kind) {
	case TOK_X: a.x = 1; break;
	case TOK_Y: a.y = 1; break;
	case TOK_Z: a.z = 1; break;
	case TOK_U: case TOK_V:
		v->count = 2;
		v->c[0] = kind == TOK_U;
		v->c[1] = kind == TOK_V;
		return;
	case TOK_T:
		v->count = 4;
		memcpy(v->c, (double[4]){ 0, 0, 0, 1 }, 4 * sizeof(double));
		return;
	case TOK_VCROSS:
		two_vectors(p, &a, &b);
		a = vec_cross(a, b);
		break;
	case TOK_VNORMALIZE:
		open_paren(p);
		a = vector(p);
		close_paren(p);
		if (a.x == 0 && a.y == 0 && a.z == 0)
			pov_warn(p, &pos, "vnormalize of a vector of length 0");
		else
			a = vec_scale(a, 1 / vec_length(a));
		break;
	case TOK_VROTATE:
		two_vectors(p, &a, &b);
		turn = xform_rotate(b);
		a = mat_point(&turn.fwd, a);
		break;
	case TOK_VTURBULENCE:
		a = vturbulence(p);
		break;
	case TOK_VAXIS_ROTATE:
		a = axis_rotate(p);
		break;
	default:
		unsupported(p, &pos, keyword_text(kind));
		break;
	}
	v->c[0] = a.x;
	v->c[1] = a.y;
	v->c[2] = a.z;
}
