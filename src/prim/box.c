/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A box about the origin with half sizes p->half; faces 0..5 are -x, +x, -y, +y, -z, +z. A half size may
 * be 0. An own unit along each axis is a level unit across the faces.
 */
#include "prim/prim.h"

/* Rays are not moved to the box's own centre: with the very arithmetic of plane_intersect(), a face and
 * the plane that it stands in are met at the same t, to the bit, and which of them counts is settled by
 * their numbers and not by noise (a glass cube on a floor; a camera in a room's wall). */
void box_crossings(const struct prim *p, const ald_ray *r, struct prim_roots *out)
{
	double t0 = -ALD_INF, t1 = ALD_INF;
	uint32_t f0 = 0, f1 = 0;

	for (uint32_t k = 0; k < 3; k++) {
		vec n = { p->to.m[0][k], p->to.m[1][k], p->to.m[2][k] };
		double at = vec_dot(n, r->org), dir = vec_dot(n, r->dir), a, b;
		double lo = p->side[2 * k], hi = p->side[2 * k + 1];

		if (dir == 0) {
			if (!(lo <= at && at <= hi))
				return;
			continue;
		}
		a = ((dir < 0 ? hi : lo) - at) / dir;
		b = ((dir < 0 ? lo : hi) - at) / dir;
		if (a > t0) {
			t0 = a;
			f0 = 2 * k + (dir < 0);
		}
		if (b < t1) {
			t1 = b;
			f1 = 2 * k + (dir > 0);
		}
	}
	if (!(t0 <= t1))
		return;
	out->count = 2;
	out->t[0] = t0;
	out->t[1] = t1;
	out->part[0] = f0;
	out->part[1] = f1;
}

static void box_surface(const struct prim *p, vec at, uint32_t part, struct prim_point *s)
{
	uint32_t axis = part / 2;
	double side = part & 1 ? 1 : -1;

	s->p = at;
	s->n = vec_make(0, 0, 0);
	for (uint32_t k = 0; k < 3; k++) {
		double h = (&p->half.x)[k];

		(&s->p.x)[k] = fmax(-h, fmin(h, (&at.x)[k]));
	}
	(&s->p.x)[axis] = side * (&p->half.x)[axis];
	(&s->n.x)[axis] = side;
}

static bool box_inside(const struct prim *p, vec at)
{
	return fabs(at.x) <= p->half.x && fabs(at.y) <= p->half.y && fabs(at.z) <= p->half.z;
}

static double box_reach(const struct prim *p, unsigned k, bool up)
{
	(void)up;
	return fabs(p->half.x * p->from.m[0][k]) + fabs(p->half.y * p->from.m[1][k]) +
	       fabs(p->half.z * p->from.m[2][k]);
}

const struct prim_ops prim_box_ops = { NULL, box_surface, box_inside, box_reach };
