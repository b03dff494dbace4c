/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * quadric, cubic, quartic, poly and polynomial (manual 3.4.5.3.2 and 3.4.5.3.3).
 *
 * Coefficients are brought to a size at which none of lower degree is greater than the greatest of the highest,
 * by powers of two and so exactly: then nothing overflows, however large the thing is.
 */
#include <config.h>

#include "read/pov/items.h"

#include <math.h>

static uint32_t term_index(uint32_t degree, uint32_t x, uint32_t y)
{
	uint32_t i = degree - x, j = i - y;

	/* i whole triangles, the k-th of which has k + 1 rows; j rows */
	return i * (i + 1) * (i + 2) / 6 + j * (j + 1) / 2;
}

/* Of x^i y^j z^k. */
static double *term(const struct algebraic *f, uint32_t i, uint32_t j, uint32_t k)
{
	return &f->term[term_index(f->degree, i, j) + (f->degree - i - j - k)];
}

/* The greatest coefficient of a degree. */
static double greatest(const struct algebraic *f, uint32_t degree)
{
	double most = 0;

	for (uint32_t i = 0; i <= degree; i++) {
		for (uint32_t j = 0; i + j <= degree; j++)
			most = fmax(most, fabs(*term(f, i, j, degree - i - j)));
	}
	return most;
}

/* out has the highest degree that f has coefficients of. */
static void balance(const struct algebraic *f, struct algebraic *out)
{
	int top = ilogb(greatest(f, out->degree)), size = -900;
	bool lower = false;

	for (uint32_t n = 0; n < out->degree; n++) {
		double most = greatest(f, n);

		if (most == 0)
			continue;
		lower = true;
		size = (int)fmax(size, ceil((ilogb(most) - top) / (double)(out->degree - n)));
	}
	size = lower ? (int)fmin(size, 900) : 0;
	for (uint32_t i = 0; i <= out->degree; i++) {
		for (uint32_t j = 0; i + j <= out->degree; j++) {
			for (uint32_t k = 0; i + j + k <= out->degree; k++)
				*term(out, i, j, k) = ldexp(*term(f, i, j, k),
							    size * ((int)(i + j + k) - (int)out->degree) - top);
		}
	}
	out->size = ldexp(1, size);
}

static void finish(struct pov *p, const struct algebraic *f, struct object *o)
{
	uint32_t degree = f->degree;

	pov_accept(p, TOK_STURM); /* roots are always bracketed */
	if (pov_failed(p))
		return;
	while (degree && greatest(f, degree) == 0)
		degree--;
	if (!degree) {
		pov_fail_at(p, &o->pos, "all coefficients of x, y and z are 0, which is no surface");
		return;
	}
	o->shape.algebraic = scene_add_algebraic(pov_scene(p), degree);
	if (o->shape.algebraic == SCENE_NONE)
		pov_no_memory(p);
	else
		balance(f, &pov_scene(p)->algebraic[o->shape.algebraic]);
}

static bool begin(struct pov *p, uint32_t degree, struct algebraic *f)
{
	*f = (struct algebraic){ degree, 1, pov_new(p, algebraic_terms(degree) * sizeof(double)) };
	return f->term != NULL;
}

/* <c, c, ...> */
static void read_terms(struct pov *p, struct object *o, uint32_t degree)
{
	struct algebraic f;

	if (!begin(p, degree, &f) || !pov_expect(p, TOK_LEFT_ANGLE, "before the coefficients"))
		return;
	for (uint32_t i = 0; i < algebraic_terms(degree) && !pov_failed(p); i++) {
		if (i)
			pov_comma(p);
		f.term[i] = pov_finite_float(p, "a coefficient");
	}
	pov_comma(p);
	if (pov_expect(p, TOK_RIGHT_ANGLE, "after the coefficients"))
		finish(p, &f, o);
}

void pov_read_cubic(struct pov *p, struct object *o)
{
	read_terms(p, o, 3);
}

void pov_read_quartic(struct pov *p, struct object *o)
{
	read_terms(p, o, 4);
}

static uint32_t read_degree(struct pov *p)
{
	uint32_t n = pov_count(p, "the degree", 2, SCENE_ALGEBRAIC_DEGREE);

	pov_comma(p);
	return n;
}

void pov_read_poly(struct pov *p, struct object *o)
{
	uint32_t degree = read_degree(p);

	if (!pov_failed(p))
		read_terms(p, o, degree);
}

static uint32_t read_power(struct pov *p, uint32_t most)
{
	uint32_t n = pov_count(p, "the power", 0, most);

	pov_comma(p);
	return n;
}

/* xyz(i, j, k): c, ...; what is not there is 0, and what is there twice the last. */
void pov_read_polynomial(struct pov *p, struct object *o)
{
	uint32_t degree = read_degree(p);
	struct algebraic f;

	if (pov_failed(p) || !begin(p, degree, &f))
		return;
	while (pov_accept(p, TOK_XYZ)) {
		struct diag_pos at = pov_here(p);
		uint32_t i, j, k;
		double c;

		pov_expect(p, TOK_LEFT_PAREN, "after xyz");
		i = read_power(p, degree);
		j = read_power(p, degree);
		k = read_power(p, degree);
		pov_expect(p, TOK_RIGHT_PAREN, "after the three powers");
		pov_expect(p, TOK_COLON, "before the coefficient");
		c = pov_finite_float(p, "a coefficient");
		pov_comma(p);
		if (!pov_failed(p) && i + j + k > degree)
			pov_fail_at(p, &at, "the powers %u, %u and %u are more than the degree %u together", i, j,
				    k, degree);
		if (pov_failed(p))
			return;
		*term(&f, i, j, k) = c;
	}
	finish(p, &f, o);
}

/* <x^2, y^2, z^2>, <xy, xz, yz>, <x, y, z>, 1 */
void pov_read_quadric(struct pov *p, struct object *o)
{
	vec v[3];
	struct algebraic f;

	for (unsigned i = 0; i < 3; i++) {
		v[i] = pov_finite_vector(p, "the quadric's coefficients");
		pov_comma(p);
	}
	if (pov_failed(p) || !begin(p, 2, &f))
		return;
	*term(&f, 2, 0, 0) = v[0].x;
	*term(&f, 0, 2, 0) = v[0].y;
	*term(&f, 0, 0, 2) = v[0].z;
	*term(&f, 1, 1, 0) = v[1].x;
	*term(&f, 1, 0, 1) = v[1].y;
	*term(&f, 0, 1, 1) = v[1].z;
	*term(&f, 1, 0, 0) = v[2].x;
	*term(&f, 0, 1, 0) = v[2].y;
	*term(&f, 0, 0, 1) = v[2].z;
	*term(&f, 0, 0, 0) = pov_finite_float(p, "the quadric's constant");
	finish(p, &f, o);
}
