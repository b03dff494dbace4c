/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The unit disc in the plane z = 0 with a hole of radius a; no inside.
 */
#include "prim/prim.h"

static void disc_roots(const struct prim *p, vec o, vec d, struct prim_roots *out)
{
	double t = -o.z / d.z, x = o.x + t * d.x, y = o.y + t * d.y, rr = x * x + y * y;

	if (!(rr <= 1 && rr >= p->a * p->a))
		return;
	out->count = 1;
	out->t[0] = t;
	out->hi = sqrt(fmax(1 - vec_dot(o, o), 0) / vec_dot(d, d)); /* o is the point of closest approach */
	out->lo = -out->hi;
	out->part[0] = 0;
}

static void disc_surface(const struct prim *p, vec at, uint32_t part, struct prim_point *s)
{
	(void)p;
	(void)part;
	s->p = vec_make(at.x, at.y, 0);
	s->n = vec_make(0, 0, 1);
}

static double disc_reach(const struct prim *p, unsigned k, bool up)
{
	(void)up;
	return prim_column(p, k, true, true, false);
}

const struct prim_ops prim_disc_ops = { disc_roots, disc_surface, NULL, disc_reach };
