/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Real roots of polynomials on an interval, each bracketed before it is refined.
 *
 * The roots of the derivative cut the interval into pieces where the polynomial is monotone; a piece whose
 * ends differ in sign holds one root (Yuksel: High-Performance Polynomial Root Finding for Graphics,
 * HPG 2022). No root can be lost by an iteration that does not converge, and two that lie closer than
 * rounding lets one tell are none or two, never one.
 */
#ifndef ALIDADE_PRIM_POLY_H
#define ALIDADE_PRIM_POLY_H

#define POLY_DEGREE 35

/* c[i] is of x^i; 0 counts as positive. Ascending; how many, at most n. */
unsigned poly_roots(const double *c, unsigned n, double lo, double hi, double *root);
double poly_value(const double *c, unsigned n, double x);
/* out[i], i < n, of the derivative. */
void poly_slope(const double *c, unsigned n, double *out);
/* q(s) = p(x + s w), in place. */
void poly_shift(double *c, unsigned n, double x, double w);
/* out of degree n + m, not one of the factors. */
void poly_mul(const double *a, unsigned n, const double *b, unsigned m, double *out);

/* A root of f in [x, y], fx and fy of opposite signs or 0: regula falsi with the Illinois rule, and a
 * bisection whenever that is slow, until the bracket is no wider than 2 u (1 + its magnitude). */
double poly_refine(double (*f)(const void *, double), const void *arg, double x, double fx, double y,
		   double fy);

#endif
