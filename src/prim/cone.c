/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Cones and cylinders: z from -1 to 1, radius a + b z, the larger end's being 1.
 *
 * The solid is convex, so that a line is inside over one interval: the part of the infinite cone's that
 * lies between the ends. Seen so, nothing can slip through where the side meets a cap. Parts: 0 the
 * side, 1 the end at z = -1, 2 the end at z = 1.
 */
#include "prim/prim.h"

/* Over which s is the line within the infinite (double) cone's nappe with a + b z >= 0? */
static bool side_interval(const struct prim *p, vec o, vec d, double *s0, double *s1)
{
	double r = p->a + p->b * o.z, rd = p->b * d.z;
	double lo = sqrt(o.x * o.x + o.y * o.y);
	double qa = d.x * d.x + d.y * d.y - rd * rd;
	double qb = o.x * d.x + o.y * d.y - r * rd;
	double qc = (lo - r) * (lo + r);
	double cross = o.x * d.y - o.y * d.x;
	/* qb^2 - qa qc without its cancellation: the cylinder's part is |d|^2 r^2 - cross^2. */
	double wx = r * d.x - rd * o.x, wy = r * d.y - rd * o.y;
	double disc = wx * wx + wy * wy - cross * cross;
	double q, x, y;

	if (qa == 0 && qb == 0) {
		*s0 = -ALD_INF;
		*s1 = ALD_INF;
		return qc <= 0;
	}
	if (!(disc >= 0)) {
		if (!(qa < 0))
			return false;
		disc = 0; /* through the apex */
	}
	q = -(qb + copysign(sqrt(disc), qb));
	x = qa == 0 ? copysign(ALD_INF, q) : q / qa;
	y = q == 0 ? x : qc / q;
	*s0 = fmin(x, y);
	*s1 = fmax(x, y);
	if (qa < 0) { /* within one nappe before s0, within the other after s1 */
		if (rd > 0) {
			*s0 = *s1;
			*s1 = ALD_INF;
		} else {
			*s1 = *s0;
			*s0 = -ALD_INF;
		}
	}
	return true;
}

/* An apex, which is of the side, whether the ends are open or not. */
static bool pointed(const struct prim *p, uint32_t end)
{
	return (end == 1 ? p->a - p->b : p->a + p->b) == 0;
}

static void cone_roots(const struct prim *p, vec o, vec d, struct prim_roots *out)
{
	double s0, s1, t0 = -ALD_INF, t1 = ALD_INF;
	uint32_t end0 = d.z > 0 ? 1 : 2;

	if (!side_interval(p, o, d, &s0, &s1))
		return;
	if (d.z == 0) {
		if (fabs(o.z) > 1)
			return;
	} else {
		t0 = (-copysign(1, d.z) - o.z) / d.z;
		t1 = (copysign(1, d.z) - o.z) / d.z;
	}
	if (!(fmax(s0, t0) <= fmin(s1, t1)))
		return;
	out->lo = s0;
	out->hi = s1;
	if (s0 > t0 || pointed(p, end0)) {
		out->t[out->count] = fmax(s0, t0);
		out->part[out->count++] = 0;
	} else if (!p->open) {
		out->t[out->count] = t0;
		out->part[out->count++] = end0;
	}
	if (s1 < t1 || pointed(p, 3 - end0)) {
		out->t[out->count] = fmin(s1, t1);
		out->part[out->count++] = 0;
	} else if (!p->open) {
		out->t[out->count] = t1;
		out->part[out->count++] = 3 - end0;
	}
}

static void cone_surface(const struct prim *p, vec at, uint32_t part, struct prim_point *s)
{
	double l = sqrt(at.x * at.x + at.y * at.y), r;

	s->p = at;
	s->p.z = fmax(-1, fmin(1, at.z));
	if (part) {
		s->p.z = part == 1 ? -1 : 1;
		s->n = vec_make(0, 0, s->p.z);
		r = p->a + p->b * s->p.z;
		if (l > r) {
			s->p.x *= r / l;
			s->p.y *= r / l;
		}
		return;
	}
	r = p->a + p->b * s->p.z;
	if (l > 0) {
		s->n = vec_unit(vec_make(at.x / l, at.y / l, -p->b));
		s->p.x = at.x / l * r;
		s->p.y = at.y / l * r;
	} else {
		s->n = vec_make(0, 0, p->b > 0 ? -1 : 1); /* the apex */
	}
}

static bool cone_inside(const struct prim *p, vec at)
{
	double r = p->a + p->b * at.z;

	return !p->open && fabs(at.z) <= 1 && at.x * at.x + at.y * at.y <= r * r;
}

static double cone_reach(const struct prim *p, unsigned k, bool up)
{
	double axis = up ? p->from.m[2][k] : -p->from.m[2][k];
	double round = prim_column(p, k, true, true, false);

	return fmax(axis + (p->a + p->b) * round, -axis + (p->a - p->b) * round);
}

const struct prim_ops prim_cone_ops = { cone_roots, cone_surface, cone_inside, cone_reach };
