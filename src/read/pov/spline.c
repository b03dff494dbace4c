/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * spline { ... } and the values of splines (manual 3.3.1.11).
 */
#include <config.h>

#include "read/pov/function.h"
#include "read/pov/internal.h"

#include <stdlib.h>
#include <string.h>

#include "pattern/function.h"

struct draft {
	struct pov *p;
	enum spline_kind kind;
	uint32_t terms;
	struct buf point;
	double last[FUNCTION_RESULTS]; /* what a shorter point leaves out is the point's before it, as in POV-Ray */
};

struct point {
	double at, value[FUNCTION_RESULTS];
};

static bool kind_word(struct pov *p, enum spline_kind *kind)
{
	switch (pov_token(p)) {
	case TOK_LINEAR_SPLINE: *kind = SPLINE_LINEAR; break;
	case TOK_QUADRATIC_SPLINE: *kind = SPLINE_QUADRATIC; break;
	case TOK_CUBIC_SPLINE: *kind = SPLINE_CUBIC; break;
	case TOK_NATURAL_SPLINE: *kind = SPLINE_NATURAL; break;
	default: return false;
	}
	pov_next(p);
	return true;
}

/* In order; a point at the place of another replaces it, but for the last, which stays: measured. */
static void add(struct draft *d, const struct point *new)
{
	struct pov *p = d->p;
	struct point *list;
	uint32_t i, n = d->point.count;

	if (!pov_charge(p, 1) || !pov_charge_memory(p, sizeof(*new)))
		return;
	if (!buf_reserve(&d->point, p->book, "reading", 1)) {
		pov_no_memory(p);
		return;
	}
	list = d->point.data;
	for (i = n; i > 0 && list[i - 1].at > new->at; i--)
		;
	if (i > 0 && list[i - 1].at == new->at) {
		if (i < n || n == 1)
			list[i - 1] = *new;
		return;
	}
	/* Points in falling order would take the square of their number. */
	if (!pov_charge(p, (n - i) / 16))
		return;
	memmove(list + i + 1, list + i, (n - i) * sizeof(*list));
	list[i] = *new;
	d->point.count++;
}

static void read_point(struct draft *d)
{
	struct pov_value v = { POV_FLOAT, 1, { 0 } };
	struct point new = { .at = expr_float(d->p) };
	uint32_t terms;

	pov_comma(d->p);
	expr_number(d->p, &v, 1);
	pov_comma(d->p);
	if (v.count == 1)
		v.c[1] = v.c[0];
	terms = v.count < 2 ? 2 : v.count;
	memcpy(d->last, v.c, terms * sizeof(double));
	if (terms > d->terms)
		d->terms = terms;
	memcpy(new.value, d->last, sizeof(new.value));
	if (!pov_failed(d->p))
		add(d, &new);
}

static void copy_points(struct draft *d)
{
	const struct spline *s = d->p->tok.value.u.item;

	d->kind = s->kind;
	d->terms = s->terms;
	for (uint32_t i = 0; i < s->count; i++) {
		struct point new = { .at = s->at[i] };

		memcpy(new.value, s->value + (size_t)i * FUNCTION_RESULTS, sizeof(new.value));
		add(d, &new);
	}
	pov_next(d->p);
}

/* Second derivatives at the points: the tridiagonal system of a spline without curvature at its ends, solved by
 * Thomas' algorithm. */
static void bend(struct spline *s, double *diagonal, double *right, uint32_t k)
{
	const double *t = s->at, *y = s->value + k;
	double *b = s->bend + k, low;
	uint32_t n = s->count, w = FUNCTION_RESULTS;

	for (uint32_t i = 1; i + 1 < n; i++) {
		double before = t[i] - t[i - 1], after = t[i + 1] - t[i];

		diagonal[i] = 2 * (before + after);
		right[i] = 6 * ((y[(i + 1) * w] - y[i * w]) / after - (y[i * w] - y[(i - 1) * w]) / before);
		if (i > 1) {
			low = before / diagonal[i - 1];
			diagonal[i] -= low * before;
			right[i] -= low * right[i - 1];
		}
	}
	b[0] = b[(n - 1) * w] = 0;
	for (uint32_t i = n - 1; i-- > 1;)
		b[i * w] = (right[i] - (t[i + 1] - t[i]) * b[(i + 1) * w]) / diagonal[i];
}

/* Any spline may be asked as a natural one: S(t, natural_spline). */
static bool bend_all(struct pov *p, struct spline *s)
{
	double *room;

	if (s->bend)
		return true;
	s->bend = pov_alloc(p, mem_product(s->count, FUNCTION_RESULTS * sizeof(double)));
	room = pov_alloc(p, mem_product(s->count, 2 * sizeof(double)));
	if (!s->bend || !room)
		return false;
	for (uint32_t k = 0; k < s->terms; k++)
		bend(s, room, room + s->count, k);
	return true;
}

static struct spline *finish(struct draft *d)
{
	struct spline *s = pov_alloc(d->p, sizeof(*s));
	const struct point *list = d->point.data;

	if (!s)
		return NULL;
	*s = (struct spline){ .kind = d->kind, .count = d->point.count, .terms = d->terms };
	s->at = pov_alloc(d->p, mem_product(s->count, sizeof(double)));
	s->value = pov_alloc(d->p, mem_product(s->count, FUNCTION_RESULTS * sizeof(double)));
	if (!s->at || !s->value)
		return NULL;
	for (uint32_t i = 0; i < s->count; i++) {
		s->at[i] = list[i].at;
		memcpy(s->value + (size_t)i * FUNCTION_RESULTS, list[i].value, sizeof(list[i].value));
	}
	return s->kind != SPLINE_NATURAL || bend_all(d->p, s) ? s : NULL;
}

struct spline *spline_read(struct pov *p)
{
	struct draft d = { .p = p, .terms = 2, .point = { .size = sizeof(struct point) } };
	struct diag_pos pos = pov_pos(p);
	struct spline *s = NULL;

	pov_next(p);
	if (!pov_expect(p, TOK_LEFT_BRACE, "after spline") || !pov_nest(p))
		return NULL;
	kind_word(p, &d.kind);
	if (pov_token(p) == TOK_IDENT && p->tok.value.kind == SLOT_ITEM && p->tok.value.item_kind == ITEM_SPLINE) {
		copy_points(&d);
		pov_comma(p);
	}
	kind_word(p, &d.kind);
	while (!pov_failed(p) && pov_starts_number(p))
		read_point(&d);
	pov_expect(p, TOK_RIGHT_BRACE, "at the end of the spline");
	pov_unnest(p);
	if (!pov_failed(p) && !d.point.count)
		pov_fail_at(p, &pos, "the spline has no points");
	if (!pov_failed(p))
		s = finish(&d);
	buf_release(&d.point);
	return s;
}

void spline_call(struct pov *p, struct pov_value *v)
{
	struct spline *s = p->tok.value.u.item;
	enum spline_kind kind = s->kind;
	double t;

	pov_next(p);
	if (!pov_expect(p, TOK_LEFT_PAREN, "after the spline's name") || !pov_nest(p))
		return;
	t = expr_float(p);
	if (pov_accept(p, TOK_COMMA) && !kind_word(p, &kind))
		pov_fail(p, "expected a kind of spline, found %s", pov_text(p));
	pov_expect(p, TOK_RIGHT_PAREN, "after the spline's argument");
	pov_unnest(p);
	if (pov_failed(p) || (kind == SPLINE_NATURAL && !bend_all(p, s)))
		return;
	v->count = s->terms;
	spline_eval(s, kind, t, v->c);
}
