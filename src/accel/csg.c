/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Does a crossing of a surface show, in constructive solid geometry (prim/csg.h)?
 *
 * Of two solids that a line crosses at nearly the same place one must not say that it is outside the other
 * and the other, by other rounding, the same of it: the ray would slip between them. So spheres, boxes, cones,
 * tori and planes are not asked about the point, but where along the line they are crossed, and crossings are
 * compared: by t, and if equal by leaf. In this one order what is inside changes from crossing to crossing,
 * and each change shows. Sweeps, blobs, discs and meshes are asked about the point.
 */
#include "accel/geometry.h"

struct probe {
	const struct view *view;
	struct worker *worker; /* NULL: about the point alone */
	const ald_ray *ray;
	double t;
	uint32_t leaf; /* whose crossing it is */
	vec p, pad; /* the place, and what it may be off by */
};

static const struct geometry *geometry_of(const struct probe *q)
{
	return q->view->geometry;
}

/* Is this crossing before the one that is asked about? */
static bool before(const struct probe *q, double t, uint32_t leaf)
{
	return t < q->t || (t == q->t && leaf < q->leaf);
}

static bool shape_holds(const struct probe *q, const struct prim *p, uint32_t leaf)
{
	struct prim_roots roots;
	unsigned crossed = 0;
	double along;

	if (!q->worker || p->kind == SHAPE_DISC)
		return p->kind == SHAPE_DISC ? mat_dir(&p->to, vec_sub(q->p, p->centre)).z <= 0 :
					       prim_inside(p, q->p);
	prim_crossings(p, q->ray, &roots);
	if (p->kind == SHAPE_PLANE) {
		along = vec_dot(p->half, q->ray->dir);
		if (along == 0 || !isfinite(roots.t[0]))
			return vec_dot(p->half, vec_sub(q->ray->org, p->centre)) <= 0;
		return before(q, roots.t[0], leaf) == (along < 0);
	}
	for (uint32_t i = 0; i < roots.count; i++)
		crossed += before(q, roots.t[i], leaf);
	return (crossed & 1) != roots.begins;
}

static bool leaf_holds(const struct probe *q, uint32_t i)
{
	const struct geometry *g = geometry_of(q);
	const struct prim_leaf *f = &g->set.leaf[i];
	const struct prim_level *l = &g->set.level[0];
	bool in;

	if (f->kind == SHAPE_MESH) /* without inside_vector it has no outside either: measured */
		return g->set.scene->mesh[f->mesh].has_inside && f->item != SCENE_NONE &&
		       mesh_holds(g, q->worker, f, q->p) != !!(f->flags & OBJECT_INVERSE);
	if (f->item == SCENE_NONE)
		in = false;
	else if (body_ops_of(f->kind))
		in = body_inside(&l->body[f->item], q->p);
	else
		in = shape_holds(q, &l->prim[f->item], i);
	return in != !!(f->flags & OBJECT_INVERSE);
}

static bool far_from(const struct probe *q, const ald_box *b)
{
	return q->p.x < b->lo.x - q->pad.x || q->p.x > b->hi.x + q->pad.x || q->p.y < b->lo.y - q->pad.y ||
	       q->p.y > b->hi.y + q->pad.y || q->p.z < b->lo.z - q->pad.z || q->p.z > b->hi.z + q->pad.z;
}

/* Nesting is limited by the reader. */
static bool node_holds(const struct probe *q, uint32_t i)
{
	const struct csg *c = &geometry_of(q)->set.csg;
	const struct csg_node *n = csg_at(c, i);

	if (far_from(q, &n->box))
		return false;
	if (n->op == CSG_LEAF)
		return n->leaf != SCENE_NONE && leaf_holds(q, n->leaf);
	for (uint32_t k = n->first; k != SCENE_NONE; k = csg_at(c, k)->next) {
		if (node_holds(q, k) != (n->op == CSG_INTERSECTION))
			return n->op != CSG_INTERSECTION;
	}
	return n->op == CSG_INTERSECTION;
}

static bool shows(const struct probe *q, uint32_t node)
{
	const struct csg *c = &geometry_of(q)->set.csg;
	uint32_t up;

	for (uint32_t i = node; (up = csg_at(c, i)->parent) != SCENE_NONE; i = up) {
		enum csg_op op = csg_at(c, up)->op;

		if (op == CSG_UNION)
			continue;
		for (uint32_t k = csg_at(c, up)->first; k != SCENE_NONE; k = csg_at(c, k)->next) {
			if (k != i && node_holds(q, k) != (op == CSG_INTERSECTION))
				return false;
		}
	}
	return true;
}

bool csg_shows(const struct view *v, struct worker *w, uint32_t node, const ald_ray *r, double t)
{
	struct probe q = { .view = v, .worker = w, .ray = r, .t = t,
			   .leaf = csg_at(&v->geometry->set.csg, node)->leaf };

	q.p = vec_mad(r->org, r->dir, t);
	for (unsigned k = 0; k < 3; k++)
		(&q.pad.x)[k] = 64 * ALD_U * (fabs((&r->org.x)[k]) + fabs((&r->dir.x)[k] * t));
	return shows(&q, node);
}

bool csg_holds(const struct geometry *g, uint32_t leaf, vec p)
{
	struct probe q = { .view = &g->view[0], .p = p, .leaf = leaf };

	return leaf_holds(&q, leaf) && shows(&q, g->set.leaf[leaf].node);
}

int csg_intersect_shape(const struct view *v, struct worker *w, const struct prim *p, uint32_t id,
			const ald_ray *r, ald_hit *hit)
{
	struct prim_roots roots;

	prim_crossings(p, r, &roots);
	for (uint32_t i = 0; i < roots.count; i++) {
		double t = prim_clamp(r, &p->box, roots.t[i]);

		if (!isfinite(t) || !ald_counts(r, t, id, hit) || !csg_shows(v, w, p->node, r, roots.t[i]))
			continue;
		*hit = (ald_hit){ .t = t, .prim = id, .part = roots.part[i] };
		return 1;
	}
	return 0;
}

int csg_intersect_piece(const struct view *v, struct worker *w, const struct prim *p,
			const struct prim_piece *q, uint32_t id, const ald_ray *r, ald_hit *hit)
{
	ald_ray next = *r;
	ald_hit one = *hit;

	while (piece_intersect(p, q, id, &next, &one)) {
		if (csg_shows(v, w, p->node, r, one.t)) {
			*hit = one;
			return 1;
		}
		next.tmin = one.t;
		next.after = ALD_NONE;
		one = *hit;
	}
	return 0;
}
