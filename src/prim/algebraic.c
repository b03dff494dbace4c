/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Where a polynomial of x, y and z is 0 (manual 3.4.5.3.2): quadrics, cubics, quartics, and any up to degree 35.
 *
 * Along a line the polynomial is one of t, made by Horner's scheme over polynomials, and all its roots are
 * bracketed (poly.h) between the ends of an interval that is known to hold them: 2 max |c(n-i) / c(n)|^(1/i)
 * (Fujiwara 1916), rounded up to a power of two. At its lower end the sign says on which side the line begins,
 * so that solids cut by such surfaces count their crossings from there.
 *
 * A value of the polynomial is known to within a few u of the sum of its terms' sizes; what that is in length, at
 * the surface's own slope, is the bound on how far a hit may be off the surface. Two crossings of a line that are
 * nearer to each other than rounding tells are none or two.
 */
#include "prim/prim.h"

#include "prim/poly.h"

/* out = out (a + b t) + term. */
static void step(double *out, unsigned n, double a, double b)
{
	out[n] = 0;
	for (unsigned i = n; i; i--)
		out[i] = out[i] * a + out[i - 1] * b;
	out[0] *= a;
}

/* The polynomial along o + t d. */
static void restrict_to(const struct algebraic *f, vec o, vec d, double *out)
{
	const double *term = f->term;
	unsigned n = f->degree;
	double y[SCENE_ALGEBRAIC_DEGREE + 1], z[SCENE_ALGEBRAIC_DEGREE + 1];

	out[0] = 0;
	for (unsigned i = 0; i <= n; i++) { /* of x^(n-i) */
		if (i)
			step(out, i, o.x, d.x);
		y[0] = 0;
		for (unsigned j = 0; j <= i; j++) {
			if (j)
				step(y, j, o.y, d.y);
			z[0] = 0;
			for (unsigned k = 0; k <= j; k++) {
				if (k)
					step(z, k, o.z, d.z);
				z[0] += *term++;
			}
			for (unsigned k = 0; k <= j; k++)
				y[k] += z[k];
		}
		for (unsigned k = 0; k <= i; k++)
			out[k] += y[k];
	}
}

/* What no root is further from 0 than. */
static double bound(const double *c, unsigned n)
{
	int most = -2000, top = ilogb(c[n]);

	for (unsigned i = 1; i <= n; i++) {
		int e = ilogb(c[n - i]) + 1 - top;

		if (c[n - i] == 0)
			continue;
		most = (int)fmax(most, ceil(e / (double)i));
	}
	return ldexp(1, most < -1000 ? -1000 : most > 1000 ? 1000 : most + 1) * (1 + ALD_U);
}

static void algebraic_roots(const struct prim *p, vec o, vec d, struct prim_roots *out)
{
	const struct algebraic *f = p->data;
	double c[SCENE_ALGEBRAIC_DEGREE + 1], len = vec_length(d), far;
	unsigned n = f->degree;

	restrict_to(f, o, vec_scale(d, 1 / len), c);
	while (n && c[n] == 0)
		n--;
	if (!n || !isfinite(c[n])) {
		out->begins = c[0] < 0;
		return;
	}
	far = bound(c, n);
	out->begins = (c[n] < 0) != (n & 1);
	out->count = poly_roots(c, n, -far, far, out->t);
	for (uint32_t i = 0; i < out->count; i++) {
		out->t[i] /= len;
		out->part[i] = 0;
	}
}

struct slope { /* a value, its derivatives, and the sum of its terms' sizes */
	double f, size;
	vec g;
};

/* s = s x + 1 c, x being coordinate k. */
static void climb(struct slope *s, double x, unsigned k)
{
	s->g = vec_scale(s->g, x);
	(&s->g.x)[k] += s->f;
	s->f *= x;
	s->size *= fabs(x);
}

static void join(struct slope *to, const struct slope *s)
{
	to->f += s->f;
	to->size += s->size;
	to->g = vec_add(to->g, s->g);
}

static struct slope slope_at(const struct algebraic *f, vec p)
{
	const double *term = f->term;
	struct slope x = { .f = 0 };

	for (unsigned i = 0; i <= f->degree; i++) {
		struct slope y = { .f = 0 };

		climb(&x, p.x, 0);
		for (unsigned j = 0; j <= i; j++) {
			struct slope z = { .f = 0 };

			climb(&y, p.y, 1);
			for (unsigned k = 0; k <= j; k++, term++) {
				climb(&z, p.z, 2);
				z.f += *term;
				z.size += fabs(*term);
			}
			join(&y, &z);
		}
		join(&x, &y);
	}
	return x;
}

/* Where the surface has no slope (a cone's tip) it has no normal, and the bound is what it may be at most. */
static void algebraic_surface(const struct prim *p, vec at, uint32_t part, struct prim_point *s)
{
	const struct algebraic *f = p->data;
	struct slope v = slope_at(f, at);
	double l = vec_length(v.g), most = 1e-6 * (1 + vec_length(at));
	double off = l > 0 ? 4 * (f->degree + 2) * ALD_U * v.size / l : most;

	(void)part;
	s->n = l > 0 ? vec_scale(v.g, 1 / l) : vec_make(0, 1, 0);
	s->p = vec_mad(at, s->n, l > 0 ? -fmax(-most, fmin(most, v.f / l)) : 0);
	s->error = fmin(off, most);
}

static bool algebraic_inside(const struct prim *p, vec at)
{
	return slope_at(p->data, at).f <= 0;
}

static double algebraic_reach(const struct prim *p, unsigned k, bool up)
{
	(void)p;
	(void)k;
	(void)up;
	return ALD_INF;
}

const struct prim_ops prim_algebraic_ops = { algebraic_roots, algebraic_surface, algebraic_inside,
					     algebraic_reach };

bool prim_make_algebraic(struct prim *p, const struct algebraic *f, const struct xform *place, vec shift,
			 double scale)
{
	struct mat m = mat_identity;

	*p = (struct prim){ .kind = SHAPE_ALGEBRAIC, .data = f, .node = SCENE_NONE };
	p->box = (ald_box){ { -ALD_INF, -ALD_INF, -ALD_INF }, { ALD_INF, ALD_INF, ALD_INF } };
	m.m[0][0] = m.m[1][1] = m.m[2][2] = f->size;
	return prim_frame(p, &m, place, shift, scale);
}
