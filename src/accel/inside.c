/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Which solids hold a point.
 */
#include "accel/geometry.h"

/* Does the half-line from the origin to +x, in the plane, cross the edge from a to b? Half-open in y, and
 * computed from the lower end upwards, so that both triangles at an edge get the same answer. */
static bool crosses(const double a[2], const double b[2])
{
	if ((a[1] > 0) == (b[1] > 0))
		return false;
	return a[1] < b[1] ? a[0] * b[1] - a[1] * b[0] > 0 : b[0] * a[1] - b[1] * a[0] > 0;
}

/* Face i of those that may lie ahead: does it count? */
static bool counts(const struct mesh *m, uint32_t i, const ald_prep *p)
{
	double q[3][2];
	vec c[3];

	for (unsigned k = 0; k < 3; k++) {
		const double *v = m->vertex + 3 * (size_t)m->index[3 * (size_t)i + k];
		double z = v[p->kz] - p->o[p->kz];

		c[k] = vec_make(v[0], v[1], v[2]);
		q[k][0] = (v[p->kx] - p->o[p->kx]) - p->shear[0] * z;
		q[k][1] = (v[p->ky] - p->o[p->ky]) - p->shear[1] * z;
	}
	return (crosses(q[0], q[1]) ^ crosses(q[1], q[2]) ^ crosses(q[2], q[0])) &&
	       ald_triangle_t(p, &c[0], &c[1], &c[2]) > 0;
}

/* The parity of the faces ahead. Each face's shadow on the plane across the direction is tested by the
 * parity of edges crossed: every point of the plane is then counted to exactly one side of every edge,
 * and a closed mesh has no gaps and no doubles, whatever the ray meets. The accelerator of an instanced
 * mesh finds the faces, and at edges too many rather than too few; their own coordinates decide. */
bool mesh_holds(const struct geometry *g, struct worker *w, const struct prim_leaf *f, vec level)
{
	const struct prim_level *world = &g->set.level[0];
	const struct mesh *m = &g->set.scene->mesh[f->mesh];
	vec at = mat_point(&f->place.inv, vec_add(vec_scale(level, 1 / world->scale), world->shift));
	const double *d = &m->inside.x;
	ald_frame frame = { at, 0, NULL };
	ald_ray ray = { .org = at, .dir = m->inside };
	bool odd = false;
	ald_prep p;

	if (!vec_finite(at) || !(d[0] != 0 || d[1] != 0 || d[2] != 0))
		return false;
	ald_ray_prep(&frame, &ray, &p);
	if (!w || !f->level) {
		for (uint32_t i = 0; i < m->triangle_count; i++)
			odd ^= counts(m, i, &p);
		return odd;
	}
	ray = (ald_ray){ .org = prim_level_point(&g->set.level[f->level], at), .dir = m->inside,
			 .tmin = -g->set.level[f->level].pad, .tmax = ALD_INF, .mask = ~0u, .skip = ALD_NONE,
			 .after = ALD_NONE, .after_sub = { ALD_NONE, ALD_NONE } };
	for (;;) {
		ald_hit hit = { .t = ALD_INF, .prim = ALD_NONE };
		uint32_t face;

		view_nearest(&g->view[f->level], w, &ray, &hit);
		if (hit.prim == ALD_NONE)
			return odd;
		view_leaf(&g->set.level[f->level], hit.prim, &face);
		odd ^= counts(m, face, &p);
		trace_after(&ray, &hit);
	}
}

/* False if the leaf has no inside at all. */
static bool leaf_holds(const struct geometry *g, const struct prim_leaf *f, vec level)
{
	const struct scene *sc = g->set.scene;
	bool in;

	if (f->kind == SHAPE_MESH) {
		if (!sc->mesh[f->mesh].has_inside)
			return false;
		in = mesh_holds(g, NULL, f, level);
	} else if (f->item == SCENE_NONE || f->kind == SHAPE_DISC ||
		   (f->kind == SHAPE_CONE && sc->object[f->object].shape.cone.open)) {
		return false;
	} else if (f->kind == SHAPE_PLANE) {
		in = plane_inside(&g->set.unbounded[f->item].plane, level);
	} else if (body_ops_of(f->kind)) {
		in = body_inside(&g->set.level[0].body[f->item], level);
	} else {
		in = prim_inside(&g->set.level[0].prim[f->item], level);
	}
	return f->flags & OBJECT_INVERSE ? !in : in;
}

static bool has_solid(const struct solid *solid, uint32_t n, uint32_t object)
{
	for (uint32_t i = 0; i < n; i++) {
		if (solid[i].object == object)
			return true;
	}
	return false;
}

uint32_t geometry_inside(const struct geometry *g, vec p, struct solid *solid, uint32_t room)
{
	vec level = prim_level_point(&g->set.level[0], p);
	uint32_t n = 0;

	for (uint32_t i = 0; i < g->set.leaf_count; i++) {
		const struct prim_leaf *f = &g->set.leaf[i];

		if (f->cut || f->flags & OBJECT_PROJECTED)
			continue;
		if (!(f->node == SCENE_NONE ? leaf_holds(g, f, level) : csg_holds(g, i, level)))
			continue;
		if (f->node != SCENE_NONE && has_solid(solid, n < room ? n : room, f->solid))
			continue;
		if (n < room)
			solid[n] = (struct solid){ f->solid, i, f->interior, f->flags & OBJECT_HOLLOW };
		n++;
	}
	return n;
}
