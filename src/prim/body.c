/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "prim/body.h"

const struct body_ops *body_ops_of(enum shape_kind kind)
{
	switch (kind) {
	case SHAPE_BLOB:
		return &blob_ops;
	case SHAPE_ISOSURFACE:
		return &isosurface_ops;
	case SHAPE_LATHE:
		return &lathe_ops;
	case SHAPE_PRISM:
		return &prism_ops;
	case SHAPE_SWEEP:
		return &sweep_ops;
	default:
		return NULL;
	}
}

bool body_make(struct prim *p, const struct object *o, const struct xform *place, vec shift, double scale,
	       const void *data)
{
	const struct body_data *head = data;
	struct mat m = mat_identity;

	*p = (struct prim){ .kind = o->kind, .data = data, .node = SCENE_NONE };
	m.m[0][0] = m.m[1][1] = m.m[2][2] = head->size;
	m.m[3][0] = head->centre.x;
	m.m[3][1] = head->centre.y;
	m.m[3][2] = head->centre.z;
	return prim_frame(p, &m, place, shift, scale);
}

bool piece_make(struct prim_piece *q, const struct prim *p, uint32_t body, uint32_t part, double size,
		double pad)
{
	const struct body_ops *ops = body_ops_of(p->kind);

	*q = (struct prim_piece){ .body = body, .part = part };
	for (unsigned k = 0; k < 3; k++) {
		vec m = { p->from.m[0][k], p->from.m[1][k], p->from.m[2][k] };
		double up = ops->reach(p, part, m), down = ops->reach(p, part, vec_neg(m));

		if (!prim_side(p, k, down, up, size, pad, &q->box))
			return false;
	}
	return true;
}

/* Does the line surely miss the box? Box and ray are exact, so a slab's ends are off by 3 u of themselves. */
static bool misses(const ald_box *b, const ald_ray *r)
{
	double t0 = -ALD_INF, t1 = ALD_INF;

	for (unsigned k = 0; k < 3; k++) {
		double d = (&r->dir.x)[k], o = (&r->org.x)[k], inv = 1 / d;
		double lo = (&b->lo.x)[k] - o, hi = (&b->hi.x)[k] - o;

		t0 = ald_max((signbit(d) ? hi : lo) * inv, t0);
		t1 = ald_min((signbit(d) ? lo : hi) * inv, t1);
	}
	return t0 == ALD_INF || t1 == -ALD_INF || t0 - t1 > 8 * ALD_U * (fabs(t0) + fabs(t1));
}

/* Pieces are many, and long ones fill little of an accelerator's cells: most are missed by the box. */
int piece_intersect(const struct prim *p, const struct prim_piece *q, uint32_t id, const ald_ray *r,
		    ald_hit *hit)
{
	const struct body_ops *ops = body_ops_of(p->kind);
	struct body_root root;
	struct prim_line l;

	if (misses(&q->box, r) || !prim_line(p, r, &l))
		return 0;
	/* Far enough before tmin that rounding there loses nothing. */
	root.t = r->tmin - l.slide - 64 * ALD_U * (fabs(r->tmin) + fabs(l.slide));
	while (ops->next(p, q->part, &l, root.t, &root)) {
		double t = prim_clamp(r, &q->box, l.slide + root.t);

		if (t > hit->t)
			return 0;
		if (!isfinite(t) || !ald_counts(r, t, id, hit))
			continue;
		*hit = (ald_hit){ .t = t, .u = root.u, .prim = id, .part = q->part };
		return 1;
	}
	return 0;
}

void piece_surface(const struct prim *p, const ald_ray *r, const ald_hit *hit, vec *at, vec *n,
		   double *error)
{
	struct prim_point s = { .error = 0 };
	struct prim_line l;

	prim_line(p, r, &l);
	body_ops_of(p->kind)->surface(p, vec_mad(l.o, l.d, hit->t - l.slide), hit->part, hit->u, &s);
	prim_leave(p, &s, at, n, error);
}

bool body_inside(const struct prim *p, vec at)
{
	return body_ops_of(p->kind)->inside(p, mat_dir(&p->to, vec_sub(at, p->centre)));
}
