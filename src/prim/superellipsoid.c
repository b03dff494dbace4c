/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Superellipsoids: ((|x|^p + |y|^p)^(q/p) + |z|^q <= 1, with p = 2/a and q = 2/b (manual 3.4.5.1.14).
 *
 * Where p and q are at least 1 (a and b at most 2) the left side is convex: a line is inside over one
 * interval, which is bracketed as soon as one inner point is known, and that is sought where the slope
 * changes its sign. Otherwise the body is pinched along the planes of its axes, between which the line is cut
 * into steps; two crossings closer than a step are lost.
 *
 * pow() is the one function here whose last bit may differ from one machine's library to another's.
 */
#include "prim/poly.h"
#include "prim/prim.h"

#define STEPS 64

struct line {
	vec o, d;
	double p, q;
};

static double level(double p, double q, vec at)
{
	double x = pow(fabs(at.x), p), y = pow(fabs(at.y), p);

	return pow(x + y, q / p) + pow(fabs(at.z), q) - 1;
}

static double value(const void *line, double t)
{
	const struct line *l = line;

	return level(l->p, l->q, vec_mad(l->o, l->d, t));
}

/* Of the left side; 0 where it is not smooth. */
static vec gradient(double p, double q, vec at)
{
	double x = fabs(at.x), y = fabs(at.y), z = fabs(at.z), sum = pow(x, p) + pow(y, p);
	double f = sum > 0 ? q * pow(sum, q / p - 1) : 0;
	vec g = { x > 0 ? f * pow(x, p - 1) : 0, y > 0 ? f * pow(y, p - 1) : 0, z > 0 ? q * pow(z, q - 1) : 0 };

	return vec_make(copysign(g.x, at.x), copysign(g.y, at.y), copysign(g.z, at.z));
}

/* A place in [x, y] where a convex function is below 0. */
static bool find_inside(const struct line *l, double x, double y, double *at)
{
	double t = fmax(x, fmin(y, 0)); /* nearest to the centre */

	for (unsigned i = 0; i < 100; i++) {
		double slope;

		if (value(l, t) < 0) {
			*at = t;
			return true;
		}
		slope = vec_dot(gradient(l->p, l->q, vec_mad(l->o, l->d, t)), l->d);
		if (slope == 0 || !(y > x))
			return false;
		if (slope > 0)
			y = t;
		else
			x = t;
		t = x + (y - x) / 2;
		if (t == x || t == y)
			return false;
	}
	return false;
}

static void add(struct prim_roots *out, double t)
{
	out->part[out->count] = 0;
	out->t[out->count++] = t;
}

static void convex_roots(const struct line *l, double x, double y, struct prim_roots *out)
{
	double mid, in;

	if (!find_inside(l, x, y, &mid))
		return;
	in = value(l, mid);
	add(out, poly_refine(value, l, x, fmax(0, value(l, x)), mid, in));
	add(out, poly_refine(value, l, mid, in, y, fmax(0, value(l, y))));
}

static void pinched_roots(const struct line *l, double x, double y, struct prim_roots *out)
{
	double cut[5] = { x, y, y, y, y }, last = x, f = value(l, x);
	unsigned n = 1;

	for (unsigned k = 0; k < 3; k++) { /* in order */
		double t = -(&l->o.x)[k] / (&l->d.x)[k];
		unsigned i = n;

		if (!(t > x && t < y))
			continue;
		for (; i > 1 && cut[i - 1] > t; i--)
			cut[i] = cut[i - 1];
		cut[i] = t;
		n++;
	}
	cut[n] = y;
	for (unsigned i = 0; i < n; i++) {
		for (unsigned k = 1; k <= STEPS && out->count < PRIM_ROOTS; k++) {
			double t = cut[i] + (cut[i + 1] - cut[i]) * (k / (double)STEPS), g = value(l, t);

			if ((f < 0) != (g < 0))
				add(out, poly_refine(value, l, last, f, t, g));
			last = t;
			f = g;
		}
	}
}

static void superellipsoid_roots(const struct prim *p, vec o, vec d, struct prim_roots *out)
{
	double len = vec_length(d), x = -ALD_INF, y = ALD_INF;
	struct line l = { o, vec_scale(d, 1 / len), p->a, p->b };

	for (unsigned k = 0; k < 3; k++) {
		double at = (&l.o.x)[k], dir = (&l.d.x)[k], size = 1 + 16 * ALD_U;

		if (dir == 0 && fabs(at) > 1)
			return;
		if (dir == 0)
			continue;
		x = fmax(x, (-copysign(size, dir) - at) / dir);
		y = fmin(y, (copysign(size, dir) - at) / dir);
	}
	if (!(x < y))
		return;
	if (l.p >= 1 && l.q >= 1)
		convex_roots(&l, x, y, out);
	else
		pinched_roots(&l, x, y, out);
	for (uint32_t i = 0; i < out->count; i++)
		out->t[i] /= len;
}

static void superellipsoid_surface(const struct prim *p, vec at, uint32_t part, struct prim_point *s)
{
	vec g = gradient(p->a, p->b, at);
	double l = vec_length(g), f = level(p->a, p->b, at);

	(void)part;
	s->n = l > 0 ? vec_scale(g, 1 / l) : vec_unit(at);
	s->p = vec_mad(at, s->n, l > 0 ? -fmax(-1e-9, fmin(1e-9, f / l)) : 0);
	s->error = l > 0 ? fmin(64 * ALD_U * (4 + p->a + p->b) / l, 1e-9) : 1e-9;
}

static bool superellipsoid_inside(const struct prim *p, vec at)
{
	return level(p->a, p->b, at) <= 0;
}

/* The dual of the p-norm; p below 1 has the same hull as 1. */
static double dual(double p, double x, double y)
{
	double most = fmax(x, y), least = fmin(x, y), other = p / (p - 1);

	if (!(p > 1.001) || most == 0)
		return most * (p > 1 ? 1.001 : 1);
	return most * pow(1 + pow(least / most, other), 1 / other);
}

static double superellipsoid_reach(const struct prim *p, unsigned k, bool up)
{
	double flat = dual(p->a, fabs(p->from.m[0][k]), fabs(p->from.m[1][k]));

	(void)up;
	return dual(p->b, flat, fabs(p->from.m[2][k])) * (1 + 0x1p-40);
}

const struct prim_ops prim_superellipsoid_ops = { superellipsoid_roots, superellipsoid_surface,
						  superellipsoid_inside, superellipsoid_reach };
