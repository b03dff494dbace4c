/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Infinite planes: no accelerator can bound them, so the tracer asks each.
 */
#include "prim/prim.h"

bool plane_make(struct prim_plane *p, const struct object *o, const struct xform *place, vec shift,
		double scale)
{
	/* The plane n.q = d of own points q = place^-1(world). */
	vec n = mat_normal(&place->inv, o->shape.plane.normal);
	vec at = vec_make(place->inv.m[3][0], place->inv.m[3][1], place->inv.m[3][2]);
	double d = o->shape.plane.distance - vec_dot(o->shape.plane.normal, at), l = vec_length(n);

	p->n = vec_scale(n, 1 / l);
	p->d = (d / l - vec_dot(p->n, shift)) * scale;
	return vec_finite(p->n) && isfinite(p->d);
}

bool plane_intersect(const struct prim_plane *p, const ald_ray *r, double *t)
{
	*t = (p->d - vec_dot(p->n, r->org)) / vec_dot(p->n, r->dir);
	return isfinite(*t);
}

void plane_surface(const struct prim_plane *p, const ald_ray *r, const ald_hit *hit, vec *at, vec *n,
		   double *error)
{
	vec q = vec_mad(r->org, r->dir, hit->t);

	*n = p->n;
	*at = vec_mad(q, p->n, p->d - vec_dot(p->n, q));
	*error = 16 * ALD_U * (fabs(at->x * p->n.x) + fabs(at->y * p->n.y) + fabs(at->z * p->n.z) +
			       fabs(p->d));
}

/* POV-Ray's: the side that the normal points away from. */
bool plane_inside(const struct prim_plane *p, vec at)
{
	return vec_dot(p->n, at) <= p->d;
}

/* The same as a primitive in level coordinates about a point of the plane, normal half. */
static void plane_roots(const struct prim *p, vec o, vec d, struct prim_roots *out)
{
	out->count = 1;
	out->t[0] = -vec_dot(p->half, o) / vec_dot(p->half, d);
	out->part[0] = 0;
}

static void plane_point(const struct prim *p, vec at, uint32_t part, struct prim_point *s)
{
	(void)part;
	s->p = vec_mad(at, p->half, -vec_dot(p->half, at));
	s->n = p->half;
}

static bool plane_holds(const struct prim *p, vec at)
{
	return vec_dot(p->half, at) <= 0;
}

static double plane_reach(const struct prim *p, unsigned k, bool up)
{
	(void)p;
	(void)k;
	(void)up;
	return ALD_INF;
}

const struct prim_ops prim_plane_ops = { plane_roots, plane_point, plane_holds, plane_reach };

bool prim_make_plane(struct prim *p, const struct object *o, const struct xform *place, vec shift,
		     double scale)
{
	struct prim_plane plane;

	if (!plane_make(&plane, o, place, shift, scale))
		return false;
	*p = (struct prim){ .kind = SHAPE_PLANE, .half = plane.n, .to = mat_identity, .from = mat_identity,
			    .centre = vec_scale(plane.n, plane.d), .node = SCENE_NONE };
	p->box = (ald_box){ { -ALD_INF, -ALD_INF, -ALD_INF }, { ALD_INF, ALD_INF, ALD_INF } };
	return true;
}
