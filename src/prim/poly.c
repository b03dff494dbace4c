/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "prim/poly.h"

#include "alidade/kernel.h"

double poly_value(const double *c, unsigned n, double x)
{
	double y = c[n];

	while (n--)
		y = y * x + c[n];
	return y;
}

void poly_slope(const double *c, unsigned n, double *out)
{
	for (unsigned i = 0; i < n; i++)
		out[i] = (i + 1) * c[i + 1];
}

void poly_shift(double *c, unsigned n, double x, double w)
{
	double power = w;

	for (unsigned i = 0; i < n; i++) {
		for (unsigned k = n; k-- > i;)
			c[k] += x * c[k + 1];
	}
	for (unsigned i = 1; i <= n; i++, power *= w)
		c[i] *= power;
}

void poly_mul(const double *a, unsigned n, const double *b, unsigned m, double *out)
{
	for (unsigned i = 0; i <= n + m; i++)
		out[i] = 0;
	for (unsigned i = 0; i <= n; i++) {
		for (unsigned k = 0; k <= m; k++)
			out[i + k] += a[i] * b[k];
	}
}

double poly_refine(double (*f)(const void *, double), const void *arg, double x, double fx, double y,
		   double fy)
{
	int kept = 0; /* which end moved last: 1 y, -1 x */

	if (fx == 0)
		return x;
	if (fy == 0)
		return y;
	for (unsigned i = 0; i < 200 && fabs(y - x) > 2 * ALD_U * (1 + fmax(fabs(x), fabs(y))); i++) {
		double m = x + (y - x) / 2, n = x - fx * ((y - x) / (fy - fx)), fm;
		int now;

		if (i % 4 != 3 && (n > x) != (n > y))
			m = n;
		if (m == x || m == y)
			break;
		fm = f(arg, m);
		if (fm == 0)
			return m;
		now = (fm < 0) == (fy < 0) ? 1 : -1;
		if (now > 0) {
			y = m;
			fy = fm;
			fx /= kept == now ? 2 : 1;
		} else {
			x = m;
			fx = fm;
			fy /= kept == now ? 2 : 1;
		}
		kept = now;
	}
	return fabs(fx) < fabs(fy) ? x : y;
}

/* Newton's steps from the middle, kept in the bracket; a step that does not halve it is a bisection. */
static double newton(const double *c, unsigned n, double x, double fx, double y)
{
	double at = x + (y - x) / 2, wide = fabs(y - x);

	for (unsigned i = 0; i < 100; i++) {
		double f = c[n], g = 0, next;

		for (unsigned k = n; k--;) {
			g = g * at + f;
			f = f * at + c[k];
		}
		if (f == 0)
			return at;
		if ((f < 0) == (fx < 0))
			x = at;
		else
			y = at;
		next = at - f / g;
		if (fabs(next - at) <= 2 * ALD_U * (fabs(at) + wide * 0x1p-40))
			return next >= fmin(x, y) && next <= fmax(x, y) ? next : at;
		if (!((next > x) != (next > y)) || (i & 3) == 3)
			next = x + (y - x) / 2;
		if (next == x || next == y)
			return next;
		at = next;
	}
	return at;
}

static unsigned keep(double t, double lo, double hi, double *root, unsigned n)
{
	if (!(t > lo && t < hi))
		return n;
	root[n] = t;
	return n + 1;
}

static unsigned quadratic(const double *c, double lo, double hi, double *root)
{
	double disc = c[1] * c[1] - 4 * c[2] * c[0], q, a, b;

	if (c[2] == 0)
		return c[1] == 0 ? 0 : keep(-c[0] / c[1], lo, hi, root, 0);
	if (!(disc > 0))
		return 0;
	q = -0.5 * (c[1] + copysign(sqrt(disc), c[1]));
	a = q / c[2];
	b = c[0] / q;
	return keep(fmax(a, b), lo, hi, root, keep(fmin(a, b), lo, hi, root, 0));
}

unsigned poly_roots(const double *c, unsigned n, double lo, double hi, double *root)
{
	double slope[POLY_DEGREE], cut[POLY_DEGREE + 1], x = lo, fx;
	unsigned cuts, count = 0;

	while (n && c[n] == 0)
		n--;
	if (n == 0)
		return 0;
	if (n == 1)
		return keep(-c[0] / c[1], lo, hi, root, 0);
	if (n == 2)
		return quadratic(c, lo, hi, root);
	poly_slope(c, n, slope);
	cuts = poly_roots(slope, n - 1, lo, hi, cut);
	cut[cuts++] = hi;
	fx = poly_value(c, n, x);
	for (unsigned i = 0; i < cuts; i++) {
		double y = cut[i], fy = poly_value(c, n, y);

		if ((fx < 0) != (fy < 0))
			root[count++] = newton(c, n, x, fx, y);
		x = y;
		fx = fy;
	}
	return count;
}
