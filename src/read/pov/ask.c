/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What readers of items ask for: numbers, vectors, colours, flags, transforms (manual 3.3.1.4, 3.3.1.8,
 * 3.3.1.12.4).
 */
#include <config.h>

#include "read/pov/internal.h"
#include "base/single.h"

#include <math.h>

bool pov_starts_number(struct pov *p)
{
	switch (pov_token(p)) {
	case TOK_NUMBER: case TOK_LEFT_PAREN: case TOK_LEFT_ANGLE: case TOK_DASH: case TOK_PLUS:
	case TOK_BANG:
		return true;
	case TOK_IDENT:
		return p->tok.value.kind == SLOT_NUMBER ||
		       (p->tok.value.kind == SLOT_ITEM && (p->tok.value.item_kind == ITEM_FUNCTION ||
							   p->tok.value.item_kind == ITEM_SPLINE));
	case TOK_NEW_IDENT: case TOK_UNSET: case TOK_END:
		return false;
	default:
		return p->tok.atom && (p->tok.atom->class == KEYWORD_FLOAT ||
				       p->tok.atom->class == KEYWORD_VECTOR);
	}
}

bool pov_starts_vector(struct pov *p)
{
	switch (pov_token(p)) {
	case TOK_LEFT_ANGLE:
		return true;
	case TOK_IDENT:
		return p->tok.value.kind == SLOT_NUMBER && p->tok.value.u.number.count > 1;
	case TOK_NEW_IDENT: case TOK_UNSET: case TOK_END:
		return false;
	default:
		return p->tok.atom && p->tok.atom->class == KEYWORD_VECTOR;
	}
}

void pov_comma(struct pov *p)
{
	pov_accept(p, TOK_COMMA);
}

static void check_finite(struct pov *p, const struct diag_pos *pos, const double *c, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++) {
		if (!isfinite(c[i]))
			pov_fail_at(p, pos, "the value here is not a finite number, or too large");
	}
}

/* The place of the expression that begins here. */
static struct diag_pos next_pos(struct pov *p)
{
	pov_token(p);
	return pov_pos(p);
}

double pov_float(struct pov *p)
{
	struct diag_pos pos = next_pos(p);
	double f = expr_float(p);

	check_finite(p, &pos, &f, 1);
	return f;
}

double pov_float_full(struct pov *p)
{
	struct pov_value v = { POV_FLOAT, 1, { 0 } };

	expr_full(p, &v, 1);
	if (v.count > 1)
		pov_fail(p, "expected a float, but the expression before %s is a vector or a colour",
			 pov_text(p));
	return v.c[0];
}

vec pov_vector(struct pov *p)
{
	struct pov_value v = { POV_VECTOR, 3, { 0 } };
	struct diag_pos pos = next_pos(p);

	expr_number(p, &v, 3);
	if (v.count > 3)
		pov_fail_at(p, &pos, "expected a vector of 3 components, but this one has %u", v.count);
	check_finite(p, &pos, v.c, 3);
	return vec_make(v.c[0], v.c[1], v.c[2]);
}

void pov_vector2(struct pov *p, double *a, double *b)
{
	struct pov_value v = { POV_VECTOR, 2, { 0 } };
	struct diag_pos pos = next_pos(p);

	expr_number(p, &v, 2);
	if (v.count > 2)
		pov_fail_at(p, &pos, "expected a vector of 2 components, but this one has %u", v.count);
	check_finite(p, &pos, v.c, 2);
	*a = v.c[0];
	*b = v.c[1];
}

struct pov_value pov_value(struct pov *p)
{
	struct pov_value v = { POV_FLOAT, 1, { 0 } };
	struct rgbft c;

	if (pov_token(p) == TOK_COLOUR || (p->tok.atom && p->tok.kind != TOK_NEW_IDENT &&
					   p->tok.atom->class == KEYWORD_COLOUR)) {
		c = pov_colour(p);
		return (struct pov_value){ POV_COLOUR, 5, { c.r, c.g, c.b, c.filter, c.transmit } };
	}
	expr_number(p, &v, 1);
	v.kind = v.count == 1 ? POV_FLOAT : v.count == 5 ? POV_COLOUR : POV_VECTOR;
	return v;
}

/* From sRGB's encoding to the working space (manual 3.4.1.3), in float as POV-Ray does it. */
static double srgb_decode(struct pov *p, double value)
{
	float v = (float)value, linear;
	double g = pov_gamma(p);

	if (v < 0.04045f)
		linear = v / 12.92f;
	else
		linear = (float)pow((double)((v + 0.055f) / 1.055f), (double)2.4f);
	if (g == 1)
		return (double)linear;
	return linear > 0 ? as_single(pow((double)linear, (double)(1.0f / (float)g))) : 0;
}

/* rgbft and its like: the current token is the word; terms: how many components it takes. */
static void colour_word(struct pov *p, double c[5], uint32_t terms, bool srgb, bool transmit_only)
{
	struct pov_value v = { POV_COLOUR, terms, { 0 } };

	if (srgb && !(pov_gamma(p) > 0)) {
		pov_fail(p, "%s needs assumed_gamma to be set before: write global_settings { "
			 "assumed_gamma 1.0 } above", pov_text(p));
		return;
	}
	pov_next(p);
	expr_full(p, &v, terms);
	for (uint32_t i = 0; i < v.count; i++)
		c[i] = as_single(v.c[i]);
	for (uint32_t i = 0; srgb && i < 3; i++)
		c[i] = srgb_decode(p, c[i]);
	if (transmit_only) {
		c[4] = c[3];
		c[3] = 0;
	}
}

/* A colour given by a value: one identifier, vector or float for all five. */
static void colour_value(struct pov *p, double c[5])
{
	struct pov_value v = { POV_COLOUR, 5, { 0 } };

	expr_full(p, &v, 5);
	for (uint32_t i = 0; i < v.count; i++)
		c[i] = as_single(v.c[i]);
}

static uint32_t colour_component(enum pov_token_kind kind)
{
	switch (kind) {
	case TOK_RED: return 0;
	case TOK_GREEN: return 1;
	case TOK_BLUE: return 2;
	case TOK_FILTER: case TOK_ALPHA: return 3;
	case TOK_TRANSMIT: return 4;
	default: return 5;
	}
}

struct rgbft pov_colour(struct pov *p)
{
	double c[5] = { 0 };
	struct diag_pos pos = next_pos(p);
	bool started = false, more = true;
	uint32_t i;

	pov_accept(p, TOK_COLOUR);
	while (more && !p->failed) {
		enum pov_token_kind kind = pov_token(p);

		i = colour_component(kind);
		if (i < 5) {
			pov_next(p);
			c[i] = as_single(expr_float(p));
			started = true;
			continue;
		}
		if (started)
			break;
		started = true;
		switch (kind) {
		case TOK_RGB: colour_word(p, c, 3, false, false); break;
		case TOK_RGBF: colour_word(p, c, 4, false, false); break;
		case TOK_RGBT: colour_word(p, c, 4, false, true); break;
		case TOK_RGBFT: colour_word(p, c, 5, false, false); break;
		case TOK_SRGB: colour_word(p, c, 3, true, false); break;
		case TOK_SRGBF: colour_word(p, c, 4, true, false); break;
		case TOK_SRGBT: colour_word(p, c, 4, true, true); break;
		case TOK_SRGBFT: colour_word(p, c, 5, true, false); break;
		default:
			more = pov_starts_number(p);
			if (more)
				colour_value(p, c);
			else
				pov_fail(p, "expected a colour, found %s", pov_text(p));
		}
	}
	check_finite(p, &pos, c, 5);
	return (struct rgbft){ c[0], c[1], c[2], c[3], c[4] };
}

bool pov_bool(struct pov *p, bool if_absent)
{
	return pov_starts_number(p) ? expr_float(p) > 0 : if_absent;
}

uint32_t pov_count(struct pov *p, const char *what, uint32_t min, uint64_t max)
{
	struct diag_pos pos = next_pos(p);
	double n = expr_float(p);

	if (max > UINT32_MAX - 1)
		max = UINT32_MAX - 1;
	if (p->failed)
		return min;
	if (!(n + POV_EPSILON >= min && n <= (double)max)) {
		pov_fail_at(p, &pos, "%.15g %s: there can be %u to %.0f", n, what, min, (double)max);
		return min;
	}
	return (uint32_t)(n + POV_EPSILON);
}

static struct xform read_scale(struct pov *p)
{
	struct diag_pos pos = next_pos(p);
	vec s = pov_vector(p);

	if (!p->failed && (s.x == 0 || s.y == 0 || s.z == 0))
		pov_warn(p, &pos, "scale by 0 changed to 1");
	return xform_scale(vec_make(s.x == 0 ? 1 : s.x, s.y == 0 ? 1 : s.y, s.z == 0 ? 1 : s.z));
}

static struct xform read_matrix(struct pov *p)
{
	struct diag_pos pos = next_pos(p);
	struct xform x = xform_identity;
	struct mat m;

	pov_expect(p, TOK_LEFT_ANGLE, "before the matrix's 12 numbers");
	for (int row = 0; row < 4; row++) {
		for (int col = 0; col < 3; col++) {
			m.m[row][col] = pov_float(p);
			pov_comma(p);
		}
	}
	pov_expect(p, TOK_RIGHT_ANGLE, "after the matrix's 12 numbers");
	if (!p->failed && !xform_from_mat(&m, &x)) {
		x = xform_identity;
		pov_fail_at(p, &pos, "this matrix flattens space and has no inverse (in Blender: a scale of "
			    "0); give the object a small thickness");
	}
	return x;
}

/* transform NAME or transform { ... } */
static struct xform read_transform(struct pov *p)
{
	struct xform x = xform_identity, swap;
	bool inverse = false;

	if (pov_ident_kind(p) == ITEM_TRANSFORM) {
		x = *(const struct xform *)pov_ident_item(p);
		pov_next(p);
		return x;
	}
	if (!pov_expect(p, TOK_LEFT_BRACE, "or a transform's identifier after transform") || !pov_nest(p))
		return x;
	while (!p->failed && pov_token(p) != TOK_RIGHT_BRACE) {
		if (pov_ident_kind(p) == ITEM_TRANSFORM) {
			x = xform_mul(&x, pov_ident_item(p));
			pov_next(p);
		} else if (pov_accept(p, TOK_INVERSE)) {
			inverse = true;
		} else if (!pov_transform(p, &x)) {
			pov_expect(p, TOK_RIGHT_BRACE, "at the end of the transform");
		}
	}
	pov_next(p);
	pov_unnest(p);
	if (!inverse)
		return x;
	swap.fwd = x.inv;
	swap.inv = x.fwd;
	return swap;
}

bool pov_transform(struct pov *p, struct xform *x)
{
	enum pov_token_kind kind = pov_token(p);
	struct xform t;

	switch (kind) {
	case TOK_TRANSLATE: case TOK_ROTATE: case TOK_SCALE: case TOK_MATRIX: case TOK_TRANSFORM:
		break;
	default:
		return false;
	}
	pov_next(p);
	switch (kind) {
	case TOK_TRANSLATE: t = xform_translate(pov_vector(p)); break;
	case TOK_ROTATE: t = xform_rotate(pov_vector(p)); break;
	case TOK_SCALE: t = read_scale(p); break;
	case TOK_MATRIX: t = read_matrix(p); break;
	default: t = read_transform(p); break;
	}
	if (!p->failed)
		*x = xform_mul(x, &t);
	return true;
}
