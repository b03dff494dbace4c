/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The torus about the y axis with major radius 1 and minor radius a.
 *
 * From the point of closest approach, along a unit direction, the surface is the quartic
 *	f(s) = s^4 + c2 s^2 + c1 s + c0 = (|p|^2 + 1 - a^2)^2 - 4 (x^2 + z^2)
 * without a cubic term. Its extrema, found as the roots of f' between those of f'', cut the line into
 * pieces where f is monotone; in each with a change of sign the root is bracketed. Signs are not taken
 * from the polynomial, which cancels, but from its factors (rho - 1)^2 + y^2 - a^2 and
 * (rho + 1)^2 + y^2 - a^2 with rho^2 = x^2 + z^2; the second vanishes inside spindle tori only.
 */
#include "prim/poly.h"
#include "prim/prim.h"

struct line {
	vec o, d; /* d unit */
	double a;
	double c2, c1; /* f' = 4 s^3 + 2 c2 s + c1 */
};

/* Not hypot(): that may differ from machine to machine, and so would hits. */
static double length(double x, double y)
{
	return sqrt(x * x + y * y);
}

static double surface(const void *line, double s)
{
	const struct line *l = line;
	vec q = vec_mad(l->o, l->d, s);
	double rho = sqrt(q.x * q.x + q.z * q.z);

	return (length(rho - 1, q.y) - l->a) * (length(rho + 1, q.y) - l->a);
}

static double slope(const void *line, double s)
{
	const struct line *l = line;

	return (4 * s * s + 2 * l->c2) * s + l->c1;
}

/* Points of [-h, h] between which f is monotone, ends included; how many. */
static unsigned pieces(const struct line *l, double h, double at[5])
{
	double cut[4] = { -h, h, h, h }, x, fx;
	unsigned n = 0, cuts = 2;

	at[n++] = -h;
	if (l->c2 < 0) { /* f'' = 12 s^2 + 2 c2 */
		double s = sqrt(-l->c2 / 6);

		if (s < h) {
			cut[1] = -s;
			cut[2] = s;
			cuts = 4;
		}
	}
	x = cut[0];
	fx = slope(l, x);
	for (unsigned i = 1; i < cuts; i++) {
		double y = cut[i], fy = slope(l, y);

		if ((fx < 0) != (fy < 0))
			at[n++] = poly_refine(slope, l, x, fx, y, fy);
		x = y;
		fx = fy;
	}
	at[n++] = h;
	return n;
}

static void torus_roots(const struct prim *p, vec o, vec d, struct prim_roots *out)
{
	double len = vec_length(d), oo = vec_dot(o, o), reach = 1 + p->a, far = (1 + 8 * ALD_U) * reach;
	struct line l = { .o = o, .d = vec_scale(d, 1 / len), .a = p->a };
	double at[5], x, fx, y, fy;
	unsigned n;

	if (!(oo <= far * far))
		return;
	l.c2 = 2 * (oo + 1 - p->a * p->a) - 4 * (l.d.x * l.d.x + l.d.z * l.d.z);
	l.c1 = -8 * (o.x * l.d.x + o.z * l.d.z);
	n = pieces(&l, sqrt(far * far - oo) * (1 + 8 * ALD_U), at);
	x = at[0];
	fx = surface(&l, x);
	for (unsigned i = 1; i < n && out->count < PRIM_ROOTS; i++) {
		y = at[i];
		fy = surface(&l, y);
		if ((fx < 0) != (fy < 0)) {
			out->part[out->count] = 0;
			out->t[out->count++] = poly_refine(surface, &l, x, fx, y, fy) / len;
		}
		x = y;
		fx = fy;
	}
}

static void torus_surface(const struct prim *p, vec at, uint32_t part, struct prim_point *s)
{
	double rho = sqrt(at.x * at.x + at.z * at.z), in = length(rho - 1, at.y);
	double side = fabs(in - p->a) <= fabs(length(rho + 1, at.y) - p->a) ? 1 : -1;
	vec ring = rho > 0 ? vec_make(at.x / rho * side, 0, at.z / rho * side) : vec_make(side, 0, 0);

	(void)part;
	s->n = vec_unit(vec_sub(at, ring));
	s->p = vec_mad(ring, s->n, p->a);
}

static bool torus_inside(const struct prim *p, vec at)
{
	return length(sqrt(at.x * at.x + at.z * at.z) - 1, at.y) <= p->a;
}

static double torus_reach(const struct prim *p, unsigned k, bool up)
{
	(void)up;
	return prim_column(p, k, true, false, true) + p->a * prim_column(p, k, true, true, true);
}

const struct prim_ops prim_torus_ops = { torus_roots, torus_surface, torus_inside, torus_reach };
