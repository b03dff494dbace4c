/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What the two ways of meeting a sphere sweep share: its surface (sweep.c), and for clear curves the inner
 * surfaces that POV-Ray leaves (sweep_inner.c).
 */
#ifndef ALIDADE_PRIM_SWEEP_H
#define ALIDADE_PRIM_SWEEP_H

#include "prim/body.h"

struct ball {
	vec c;
	double r;
};

struct curve { /* from one knot to the next; [i] is of u^i */
	double x[4], y[4], z[4], r[4];
	struct ball around;
};

struct prim_sweep {
	struct body_data head;
	struct ball *knot; /* [pieces + 1] */
	struct curve *curve; /* [pieces], or NULL: straight */
};

struct span {
	double lo, hi; /* of the line */
	double u_lo, u_hi; /* of the curve */
	double begin, end; /* of the curve's parts that cover it */
};
#define SPANS 4 /* degree 6 is positive on 4 intervals at most */

/* A piece as a line sees it: along it, across it and its radius, by powers of u. */
struct seen {
	unsigned n; /* degree */
	double a[4], x[4], y[4], z[4], r[4];
};

/* h at a knot, and the span of its ball: the same numbers for both pieces that share it. */
double sweep_knot_h(const struct ball *, vec o, vec d, double *a);
/* The parts of the line within piece i; d is unit. */
unsigned sweep_spans(const struct prim_sweep *, uint32_t i, vec o, vec d, struct seen *,
		     struct span out[SPANS]);
double sweep_seen_h(const void *seen, double u); /* at place a(u) of the line, the square of half a ball's span */
/* Where the balls between u0 and u1, a span's ends, touch the surface of what they cover, from 0 to 1 of that
 * interval, which seen is moved to; clean of them are proper roots. */
#define SWEEP_TOUCHES 20
unsigned sweep_touches(struct seen *, double u0, double u1, double u[SWEEP_TOUCHES], unsigned *clean);
/* As ops->next(), of a clear curve. */
bool sweep_inner_next(const struct prim *, uint32_t piece, const struct prim_line *, double from,
		      struct body_root *);
/* A root's u from here on is no place on the curve, but the disc at a piece's first or last knot. */
#define SWEEP_DISC 2
void sweep_inner_surface(const struct prim_sweep *, vec at, uint32_t piece, unsigned end, struct prim_point *);

#endif
