/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The unit sphere. The origin of the line is already its point of closest approach, so that the
 * discriminant is 1 - |o|^2 and both roots are equally good (Haines et al., Ray Tracing Gems 7).
 */
#include "prim/prim.h"

static void sphere_roots(const struct prim *p, vec o, vec d, struct prim_roots *out)
{
	double l = vec_length(o), gap = (1 - l) * (1 + l), half;

	(void)p;
	if (!(gap >= 0))
		return;
	half = sqrt(gap / vec_dot(d, d));
	out->count = 2;
	out->t[0] = -half;
	out->t[1] = half;
	out->part[0] = out->part[1] = 0;
}

static void sphere_surface(const struct prim *p, vec at, uint32_t part, struct prim_point *s)
{
	(void)p;
	(void)part;
	s->p = s->n = vec_unit(at);
}

static bool sphere_inside(const struct prim *p, vec at)
{
	(void)p;
	return vec_dot(at, at) <= 1;
}

static double sphere_reach(const struct prim *p, unsigned k, bool up)
{
	(void)up;
	return prim_column(p, k, true, true, true);
}

const struct prim_ops prim_sphere_ops = { sphere_roots, sphere_surface, sphere_inside, sphere_reach };
