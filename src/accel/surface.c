/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What shading needs to know of a hit, found once, after traversal.
 *
 * Points are placed on the primitive itself rather than along the ray, and come with a bound on their
 * distance from it (running error analysis as in Pharr, Jakob, Humphreys: Physically Based Rendering,
 * 4th ed., 6.8; Waechter and Binder, Ray Tracing Gems 6, 2019).
 */
#include "accel/geometry.h"

struct place { /* in level coordinates */
	vec p, n;
	double error;
};

uint32_t view_leaf(const struct prim_level *l, uint32_t id, uint32_t *face)
{
	uint32_t group = level_group(l, id), n = id - l->group_first[group];

	*face = l->group[group].face ? l->group[group].face[n] : n;
	return l->group[group].leaf;
}

/* Of a triangle whose area is too small for a cross product of doubles: any across its longest edge. */
static vec sliver_normal(const vec c[3])
{
	vec longest = { 0, 0, 0 };
	double most = 0;

	for (unsigned k = 0; k < 3; k++) {
		vec e = vec_sub(c[(k + 1) % 3], c[k]);
		double l = ald_max(ald_max(fabs(e.x), fabs(e.y)), fabs(e.z));

		if (l > most) {
			longest = vec_scale(e, 1 / l);
			most = l;
		}
	}
	return vec_cross(longest, fabs(longest.x) < 0.5 ? vec_make(1, 0, 0) :
				  fabs(longest.y) < 0.5 ? vec_make(0, 1, 0) :
							  vec_make(0, 0, 1));
}

/* By its corners' weights, which keeps the point in the plane whatever the error of t. */
static void place_triangle(const struct prim_level *l, uint32_t id, double u, double v, struct place *out)
{
	vec c[3], n;
	double w = 1 - u - v, big;

	prim_triangle(l, id, c);
	out->p = vec_add(vec_add(vec_scale(c[0], w), vec_scale(c[1], u)), vec_scale(c[2], v));
	n = vec_cross(vec_sub(c[2], c[0]), vec_sub(c[1], c[0])); /* the side POV-Ray calls outside */
	big = ald_max(ald_max(fabs(n.x), fabs(n.y)), fabs(n.z));
	if (!(big > 0x1p-1022)) {
		n = sliver_normal(c);
		big = 1;
	}
	out->n = vec_unit(vec_scale(n, near_inverse(big))); /* scaled before it is squared: tiny triangles */
	out->error = 64 * ALD_U * ald_max(ald_max(size_of(c[0]), size_of(c[1])), size_of(c[2]));
}

static void mesh_normal(const struct prim_leaf *f, const struct mesh *m, uint32_t face, struct surface *s)
{
	const uint32_t *i = (m->normal_index ? m->normal_index : m->index) + 3 * (size_t)face;
	vec n = { 0, 0, 0 };

	for (unsigned k = 0; k < 3; k++) {
		const float *v = m->normal + 3 * (size_t)i[k];

		n = vec_mad(n, vec_make((double)v[0], (double)v[1], (double)v[2]), s->bary[k]);
	}
	n = vec_unit(mat_normal(&f->place.inv, n));
	if (vec_finite(n) && vec_dot(n, n) > 0.5)
		s->ns = n;
}

/* Of a cell's lower triangle the corners are (0, 0), (1, 0) and (0, 1), of its upper one (1, 1), (0, 1), (1, 0).
 * POV-Ray brings the normals to the world and to unit length before it takes their mean. */
static void grid_normal(const struct prim_leaf *f, const struct mesh *m, uint32_t face, struct surface *s)
{
	const uint32_t *i = m->index + 3 * (size_t)face, *j = m->index + 3 * (size_t)(face ^ 1);
	double x = face & 1 ? 1 - s->bary[1] : s->bary[1], z = face & 1 ? 1 - s->bary[2] : s->bary[2];
	uint32_t at[4] = { i[0], i[1], i[2], j[0] };
	double share[4] = { (1 - x) * (1 - z), x * (1 - z), (1 - x) * z, x * z };
	vec n = { 0, 0, 0 };

	if (face & 1) {
		at[0] = j[0];
		at[1] = j[1];
		at[2] = j[2];
		at[3] = i[0];
	}
	for (unsigned k = 0; k < 4; k++) {
		const float *v = m->normal + 3 * (size_t)at[k];
		vec one = vec_make((double)v[0], (double)v[1], (double)v[2]);

		n = vec_mad(n, vec_unit(mat_normal(&f->place.inv, one)), share[k]);
	}
	n = vec_unit(n);
	if (vec_finite(n) && vec_dot(n, n) > 0.5)
		s->ns = n;
}

static void mesh_uv(const struct mesh *m, uint32_t face, struct surface *s)
{
	static const uint32_t first[3] = { 0, 0, 0 };
	const uint32_t *i = m->uv_index ? m->uv_index : m->index;

	i = m->uv_count == 1 ? first : i + 3 * (size_t)face;
	for (unsigned k = 0; k < 3; k++) {
		const float *uv = m->uv + 2 * (size_t)i[k];

		s->u += s->bary[k] * (double)uv[0];
		s->v += s->bary[k] * (double)uv[1];
	}
}

static void mesh_surface(const struct scene *sc, const struct prim_leaf *f, uint32_t face, double u,
			 double v, struct surface *s)
{
	const struct mesh *m = &sc->mesh[f->mesh];

	s->bary[0] = 1 - u - v;
	s->bary[1] = u;
	s->bary[2] = v;
	if (m->grid)
		grid_normal(f, m, face, s);
	else if (m->normal && face < m->smooth_count)
		mesh_normal(f, m, face, s);
	if (m->uv)
		mesh_uv(m, face, s);
	if (!m->texture)
		return;
	for (uint32_t k = 0; k < 3; k++) {
		uint32_t per = m->textures_per_face;
		uint32_t t = m->texture[(size_t)face * per + (per == 3 ? k : 0)];

		if (t != SCENE_NONE) {
			s->texture[k] = t;
			s->texture_place[k] = &f->place; /* faces' own textures move with the mesh */
		}
	}
}

/* From an instanced level to level 0; rounding on the way, and on the next ray's way back, included. */
static void leave_instance(const struct prim_set *set, const struct prim_instance *in, struct place *at)
{
	const struct mat from = prim_instance_from(set, in);
	vec off = mat_dir(&from, at->p), n = mat_normal(&in->to, at->n);
	double l = vec_length(n), round = 0;

	for (unsigned j = 0; j < 3; j++) {
		for (unsigned i = 0; i < 3; i++)
			round += fabs((&off.x)[i] * in->to.m[i][j]) +
				 fabs((&at->p.x)[i] * from.m[i][j]) * l;
	}
	at->p = vec_add(in->centre, off);
	at->n = vec_scale(n, 1 / l);
	at->error = (at->error + 32 * ALD_U * round) / l + 8 * ALD_U * (size_of(at->p) + size_of(in->centre));
}

static void leave_world(const struct prim_level *l, const struct place *at, struct surface *s)
{
	s->p = vec_add(vec_scale(at->p, 1 / l->scale), l->shift);
	s->n = s->ns = at->n;
	s->error = at->error / l->scale + 4 * ALD_U * (size_of(s->p) + size_of(l->shift));
}

static void leaf_surface(const struct scene *sc, const struct prim_leaf *f, struct surface *s)
{
	for (unsigned k = 0; k < 3; k++)
		s->texture_place[k] = sc->object[f->object].texture_place;
	s->interior_texture_place = sc->object[f->object].interior_texture_place;
	s->u = s->v = 0;
	s->texture[0] = s->texture[1] = s->texture[2] = f->texture;
	s->interior_texture = f->interior_texture;
	s->interior = f->interior;
	s->object = f->solid;
	s->flags = f->flags;
	s->light_set = sc->object[f->object].light_set;
	s->bary[0] = 1;
	s->bary[1] = s->bary[2] = 0;
	s->blend = 3;
}

/* Components with textures of their own are blended by what they add to the density. */
static void blob_surface(const struct scene *sc, const struct prim *p, const struct object *o,
			 const ald_hit *hit, vec at, struct surface *s)
{
	const struct blob *b = &sc->blob[o->shape.blob];
	uint32_t part[SURFACE_BLEND], own = s->texture[0];
	const struct xform *own_place = s->texture_place[0];

	s->blend = blob_blend(b, p, hit->part, at, part, s->bary, SURFACE_BLEND);
	for (uint32_t i = 0; i < s->blend || i < 3; i++) {
		const struct blob_part *q = part[i < s->blend ? i : 0] == SCENE_NONE ?
						    NULL :
						    &b->part[part[i < s->blend ? i : 0]];

		s->texture[i] = q ? q->texture : own;
		s->texture_place[i] = q ? q->texture_place : own_place;
		s->bary[i] = i < s->blend ? s->bary[i] : 0;
	}
	s->blend = s->blend < 3 ? 3 : s->blend;
}

static void level_ray(const struct prim_level *l, const ald_ray *in, ald_ray *out)
{
	*out = *in;
	out->org = prim_level_point(l, in->org);
	out->dir = vec_scale(in->dir, l->scale);
}

void surface_at(const struct geometry *g, const ald_ray *ray, const ald_hit *hit, struct surface *s)
{
	const struct prim_level *l = &g->set.level[0];
	const struct prim_leaf *f;
	const struct prim_instance *in;
	uint32_t leaf, face = 0, id = hit->prim;
	const struct prim_unbounded *unbounded;
	const struct prim *body = NULL;
	bool mesh = false;
	struct place at;
	ald_ray r;

	s->planar = s->anew = false;
	if (id >= l->count) {
		leaf = g->set.unbounded[id - l->count].leaf;
		level_ray(l, ray, &r);
		unbounded = &g->set.unbounded[id - l->count];
		s->planar = unbounded->prim == SCENE_NONE;
		if (s->planar)
			plane_surface(&unbounded->plane, &r, hit, &at.p, &at.n, &at.error);
		else
			prim_surface(&l->prim[unbounded->prim], &r, hit, &at.p, &at.n, &at.error);
	} else {
		leaf = view_leaf(l, id, &face);
		switch (prim_level_id(l, &id)) {
		case PRIM_TRIANGLE:
			place_triangle(l, id, hit->u, hit->v, &at);
			if (g->set.leaf[leaf].mirrored)
				at.n = vec_neg(at.n);
			mesh = s->planar = true;
			break;
		case PRIM_SHAPE:
			level_ray(l, ray, &r);
			prim_surface(&l->prim[id], &r, hit, &at.p, &at.n, &at.error);
			s->planar = l->prim[id].kind == SHAPE_DISC;
			break;
		case PRIM_PIECE:
			level_ray(l, ray, &r);
			body = &l->body[l->piece[id].body];
			piece_surface(body, &r, hit, &at.p, &at.n, &at.error);
			s->anew = body->inner;
			break;
		case PRIM_INSTANCE:
			in = &l->instance[id];
			view_leaf(&g->set.level[in->level], hit->sub[0], &face);
			place_triangle(&g->set.level[in->level], hit->sub[0], hit->u, hit->v, &at);
			leave_instance(&g->set, in, &at);
			mesh = true;
			break;
		}
	}
	f = &g->set.leaf[leaf];
	leaf_surface(g->set.scene, f, s);
	if (f->kind == SHAPE_BLOB)
		blob_surface(g->set.scene, body, &g->set.scene->object[f->object], hit, at.p, s);
	leave_world(l, &at, s);
	if (mesh)
		mesh_surface(g->set.scene, f, face, hit->u, hit->v, s);
	else if (f->flags & OBJECT_INVERSE)
		s->n = s->ns = vec_neg(s->n);
	if (!g->set.scene->wants_uv)
		return;
	if (!mesh) {
		prim_uv(&g->set.scene->object[f->object], &f->place, s->p, hit->part, &s->u, &s->v);
	} else if (g->set.scene->mesh[f->mesh].lone) {
		s->u = s->p.x;
		s->v = s->p.y;
	}
}

/* From the triangle's corners: way = b e1 + c e2, as near as may be. */
static void mesh_uv_along(const struct mesh *m, const struct xform *place, uint32_t face, vec way, double *u,
			  double *v)
{
	const uint32_t *i = m->index + 3 * (size_t)face, *k = m->uv_index ? m->uv_index + 3 * (size_t)face : i;
	vec corner[3], e1, e2;
	double aa, ab, bb, a, b, det;
	const float *uv[3];

	for (int j = 0; j < 3; j++) {
		const double *x = m->vertex + 3 * (size_t)i[j];

		corner[j] = vec_make(x[0], x[1], x[2]);
		uv[j] = m->uv + 2 * (size_t)(m->uv_count == 1 ? 0 : k[j]);
	}
	e1 = mat_dir(&place->fwd, vec_sub(corner[1], corner[0]));
	e2 = mat_dir(&place->fwd, vec_sub(corner[2], corner[0]));
	aa = vec_dot(e1, e1);
	ab = vec_dot(e1, e2);
	bb = vec_dot(e2, e2);
	det = aa * bb - ab * ab;
	if (!(det > 0))
		return;
	a = (vec_dot(way, e1) * bb - vec_dot(way, e2) * ab) / det;
	b = (vec_dot(way, e2) * aa - vec_dot(way, e1) * ab) / det;
	*u = a * (double)(uv[1][0] - uv[0][0]) + b * (double)(uv[2][0] - uv[0][0]);
	*v = a * (double)(uv[1][1] - uv[0][1]) + b * (double)(uv[2][1] - uv[0][1]);
}

void surface_uv_along(const struct geometry *g, const ald_hit *hit, const struct surface *s, vec way, double *u,
		      double *v)
{
	const struct prim_level *l = &g->set.level[0];
	const double part = 1.0 / 64; /* so that a difference does not reach over a seam */
	const struct prim_leaf *f;
	const struct mesh *m;
	uint32_t leaf, face = 0, id = hit->prim;

	*u = *v = 0;
	if (!g->set.scene->wants_uv)
		return;
	if (id >= l->count) {
		leaf = g->set.unbounded[id - l->count].leaf;
	} else {
		leaf = view_leaf(l, id, &face);
		if (prim_level_id(l, &id) == PRIM_INSTANCE)
			view_leaf(&g->set.level[l->instance[id].level], hit->sub[0], &face);
	}
	f = &g->set.leaf[leaf];
	if (f->kind != SHAPE_MESH) {
		prim_uv(&g->set.scene->object[f->object], &f->place, vec_mad(s->p, way, part), hit->part, u, v);
		*u -= s->u;
		*v -= s->v;
		*u = (*u - round(*u)) / part;
		*v = (*v - round(*v)) / part;
		return;
	}
	m = &g->set.scene->mesh[f->mesh];
	if (m->lone) {
		*u = way.x;
		*v = way.y;
	} else if (m->uv) {
		mesh_uv_along(m, &f->place, face, way, u, v);
	}
}

double surface_error(const struct geometry *g, const ald_ray *ray, const ald_hit *hit,
		     const struct surface *s)
{
	(void)g;
	(void)ray;
	(void)hit;
	return s->error;
}

/* The face of a mesh that was hit and its leaf; in *v its corners relative to the hit, in the world. */
static const struct prim_leaf *corners_around(const struct geometry *g, const ald_hit *hit, const struct surface *s,
					      vec v[3], uint32_t *face)
{
	const struct prim_level *l = &g->set.level[0];
	uint32_t id = hit->prim, leaf;
	struct mat from = mat_identity;
	enum prim_id kind;
	vec c[3];

	if (id >= l->count)
		return NULL;
	leaf = view_leaf(l, id, face);
	kind = prim_level_id(l, &id);
	if (kind == PRIM_TRIANGLE) {
		prim_triangle(l, hit->prim, c);
	} else if (kind == PRIM_INSTANCE) {
		const struct prim_instance *in = &l->instance[id];

		view_leaf(&g->set.level[in->level], hit->sub[0], face);
		prim_triangle(&g->set.level[in->level], hit->sub[0], c);
		from = prim_instance_from(&g->set, in);
	} else {
		return NULL;
	}
	for (unsigned k = 0; k < 3; k++) {
		vec to = { 0, 0, 0 };

		for (unsigned j = 0; j < 3; j++)
			to = vec_mad(to, vec_sub(c[k], c[j]), s->bary[j]);
		v[k] = vec_scale(mat_dir(&from, to), 1 / l->scale);
	}
	return &g->set.leaf[leaf];
}

/* The hit's projections onto the planes that the normals make at the corners, where it is below them, and the
 * mean of these by the corners' weights; that of the ways to the corners themselves is none. */
bool surface_lift(const struct geometry *g, const ald_hit *hit, const struct surface *s, vec lift[2])
{
	const struct prim_leaf *f;
	const struct mesh *m;
	const uint32_t *i;
	uint32_t face;
	vec v[3];

	f = corners_around(g, hit, s, v, &face);
	if (!f || f->kind != SHAPE_MESH)
		return false;
	m = &g->set.scene->mesh[f->mesh];
	if (!m->normal || face >= m->smooth_count)
		return false;
	i = (m->normal_index ? m->normal_index : m->index) + 3 * (size_t)face;
	lift[0] = lift[1] = vec_make(0, 0, 0);
	for (unsigned k = 0; k < 3; k++) {
		const float *p = m->normal + 3 * (size_t)i[k];
		vec n = vec_make((double)p[0], (double)p[1], (double)p[2]);
		double off;

		n = vec_unit(mat_normal(&f->place.inv, n));
		off = vec_dot(v[k], n); /* of the corner above the hit */
		if (!isfinite(off))
			return false;
		lift[off < 0] = vec_mad(lift[off < 0], n, s->bary[k] * off);
	}
	return true;
}
