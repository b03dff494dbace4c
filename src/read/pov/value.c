/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What can stand to the right of a #declare, in an array, or as a macro's argument (manual 3.3.1.9,
 * 3.3.2.2.2).
 */
#include <config.h>

#include "read/pov/function.h"
#include "base/single.h"
#include "read/pov/internal.h"

/* Reads the { } of an array's one dimension; at: index of the first element. */
static bool read_elements(struct pov *p, struct array *a, uint32_t dim, uint64_t at)
{
	uint64_t step = 1;

	for (uint32_t i = dim + 1; i < a->dims; i++)
		step *= a->size[i];
	if (!pov_expect(p, TOK_LEFT_BRACE, "before an array's elements") || !pov_nest(p))
		return false;
	for (uint32_t i = 0; pov_token(p) != TOK_RIGHT_BRACE; i++) {
		if (i == a->size[dim]) {
			pov_fail(p, "more than the %u elements that the array's dimension %u has",
				 a->size[dim], dim + 1);
			return false;
		}
		if (dim + 1 < a->dims ? !read_elements(p, a, dim + 1, at + i * step) :
					!right_side(p, &a->slot[at + i], false))
			return false;
		pov_comma(p);
	}
	pov_next(p);
	pov_unnest(p);
	return !p->failed;
}

/* array[n][m] { ... } */
bool array_read(struct pov *p, struct slot *out)
{
	uint32_t size[POV_ARRAY_DIMS], dims = 0;
	struct array *a;

	pov_next(p);
	while (pov_accept(p, TOK_LEFT_SQUARE)) {
		if (dims == POV_ARRAY_DIMS) {
			pov_fail(p, "an array has at most %d dimensions", POV_ARRAY_DIMS);
			return false;
		}
		size[dims++] = pov_count(p, "array elements", 1, p->limit.elements);
		if (!pov_expect(p, TOK_RIGHT_SQUARE, "after an array's size"))
			return false;
	}
	if (!dims) {
		pov_expect(p, TOK_LEFT_SQUARE, "after array");
		return false;
	}
	a = array_new(p, dims, size);
	if (!a)
		return false;
	out->kind = SLOT_ARRAY;
	out->u.array = a;
	return pov_token(p) != TOK_LEFT_BRACE || read_elements(p, a, 0, 0);
}

static bool read_function(struct pov *p, struct slot *out)
{
	bool spline = pov_token(p) == TOK_SPLINE;

	out->kind = SLOT_ITEM;
	out->item_kind = spline ? ITEM_SPLINE : ITEM_FUNCTION;
	if (spline) {
		out->u.item = spline_read(p);
	} else {
		pov_next(p);
		out->u.item = function_read(p);
	}
	return out->u.item && !p->failed;
}

static bool read_transform(struct pov *p, struct slot *out)
{
	struct xform *x = pov_alloc(p, sizeof(*x));

	if (!x)
		return false;
	*x = xform_identity;
	out->kind = SLOT_ITEM;
	out->item_kind = ITEM_TRANSFORM;
	out->u.item = x;
	return pov_transform(p, x);
}

static bool read_number(struct pov *p, struct slot *out, bool colour)
{
	out->kind = SLOT_NUMBER;
	if (colour) {
		struct rgbft c = pov_colour(p);

		out->u.number = (struct pov_value){ POV_COLOUR, 5,
						    { c.r, c.g, c.b, c.filter, c.transmit } };
	} else {
		out->u.number = pov_value(p);
		/* POV-Ray keeps colours in float. */
		for (uint32_t i = 0; out->u.number.count == 5 && i < 5; i++)
			out->u.number.c[i] = as_single(out->u.number.c[i]);
	}
	return !p->failed;
}

/* An identifier that is not part of an expression is copied, or a macro's parameter refers to it. */
static bool read_ident(struct pov *p, struct slot *out, bool parameter)
{
	struct slot *where = p->tok.where;

	if (p->tok.value.kind == SLOT_FILE) {
		pov_fail(p, "a file cannot be copied");
		return false;
	}
	if (parameter) {
		*out = (struct slot){ .kind = SLOT_REF };
		out->u.ref = where;
	} else if (!slot_copy(p, out, where)) {
		return false;
	}
	pov_next(p);
	return true;
}

static bool is_callable(const struct slot *s)
{
	return s->kind == SLOT_ITEM &&
	       (s->item_kind == ITEM_FUNCTION || s->item_kind == ITEM_SPLINE);
}

/* A function's name alone, or its call? Only the next byte tells. */
static bool called(struct pov *p)
{
	lex_blank(p);
	return p->source->p.at < p->source->end && *p->source->p.at == '(';
}

static bool read_expression(struct pov *p, struct slot *out, bool parameter, bool string, bool colour)
{
	struct slot *where = p->tok.kind == TOK_IDENT && parameter ? p->tok.where : NULL;
	uint64_t passed = p->passed;

	if (string) {
		out->kind = SLOT_STRING;
		out->u.string = pov_string(p);
		if (where)
			pov_token(p);
	} else {
		read_number(p, out, colour);
	}
	if (where && p->passed == passed + 1) {
		*out = (struct slot){ .kind = SLOT_REF };
		out->u.ref = where;
	}
	return !p->failed;
}

bool right_side(struct pov *p, struct slot *out, bool parameter)
{
	enum pov_token_kind kind = pov_token(p);
	bool colour = p->tok.atom && p->tok.atom->kind != TOK_NEW_IDENT &&
		      (p->tok.atom->class == KEYWORD_COLOUR || kind == TOK_COLOUR);

	if (starts_string(p))
		return read_expression(p, out, parameter, true, false);
	if (kind == TOK_IDENT && p->tok.value.kind != SLOT_NUMBER &&
	    !(is_callable(&p->tok.value) && called(p)))
		return read_ident(p, out, parameter);
	if (colour || pov_starts_number(p))
		return read_expression(p, out, parameter, false, colour);
	switch (kind) {
	case TOK_ARRAY:
		return array_read(p, out);
	case TOK_FUNCTION: case TOK_SPLINE:
		return read_function(p, out);
	case TOK_TRANSFORM:
		return read_transform(p, out);
	case TOK_NEW_IDENT: case TOK_UNSET: case TOK_END:
		pov_fail(p, "expected a value, found %s", pov_text(p));
		return false;
	default:
		if (p->tok.atom)
			break;
		pov_fail(p, "expected a value, found %s", pov_text(p));
		return false;
	}
	out->kind = SLOT_ITEM;
	out->u.item = pov_read_item(p, &out->item_kind);
	return !p->failed && out->u.item;
}
