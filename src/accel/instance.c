/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Primitives as plugins see them, instances among them: an instance is one primitive of level 0 that asks
 * an accelerator of the same plugin over its own level.
 */
#include <string.h>

#include "accel/geometry.h"

void view_bounds(const ald_prims *prims, uint32_t id, ald_box *out)
{
	const struct view *v = (const struct view *)prims;
	const struct prim_level *l = v->level;
	vec c[3];

	switch (prim_level_id(l, &id)) {
	case PRIM_INSTANCE:
		*out = l->instance[id].box;
		return;
	case PRIM_PIECE:
		*out = l->piece[id].box;
		return;
	case PRIM_SHAPE:
		*out = l->prim[id].box;
		return;
	case PRIM_TRIANGLE:
		break;
	}
	prim_triangle(l, id, c);
	*out = (ald_box){ c[0], c[0] };
	ald_box_join(out, &(ald_box){ c[1], c[1] });
	ald_box_join(out, &(ald_box){ c[2], c[2] });
	out->lo = vec_sub(out->lo, vec_make(l->pad, l->pad, l->pad));
	out->hi = vec_add(out->hi, vec_make(l->pad, l->pad, l->pad));
}

/* The ray in the inner level; t is the same number there. In exact order it is asked up to the next number, as
 * the t of a hit inside may be rounded down to tmax. A next-hit walk inside this instance goes on
 * where it was; in one with a greater id hits at tmin itself count, in one with a smaller id they have
 * been seen. */
static void inner_ray(const struct prim_instance *p, uint32_t id, const ald_ray *r, double tmax, ald_ray *in,
		      ald_hit *found)
{
	*in = *r;
	in->org = mat_dir(&p->to, vec_sub(r->org, p->centre));
	in->dir = mat_dir(&p->to, r->dir);
	in->tmax = tmax;
	in->skip = ALD_NONE;
	in->after = ALD_NONE;
	if (r->after == id)
		in->after = r->after_sub[0];
	else if (r->after != ALD_NONE && id > r->after)
		in->tmin = ald_down(r->tmin);
	*found = (ald_hit){ .t = in->tmax, .prim = ALD_NONE };
}

static bool exact(const struct view *v)
{
	return v->prims.precision == ALD_PRECISION_EXACT;
}

void view_nearest(const struct view *v, struct worker *w, const ald_ray *r, ald_hit *hit)
{
	v->geometry->plugin->intersect(v->accel, &w->query[v - v->geometry->view].q, r, hit);
	view_settle(v, r, hit);
}

/* The sign of the t of a triangle of the level less a number. */
static int triangle_against(const struct view *v, const ald_ray *r, uint32_t id, double t)
{
	ald_prep prep;
	vec c[3];

	ald_ray_prep(&v->frame, r, &prep);
	prim_triangle(v->level, id, c);
	return ald_exact_against(&prep, c, t);
}

/* Is another primitive's hit, whose t is a number, before the one so far, which in exact order may be a
 * triangle with bounds on its t? */
static bool beats(const struct view *v, const ald_ray *r, double t, uint32_t id, const ald_hit *best)
{
	int sign;

	if (!ald_wins(t, id, best))
		return false;
	if (!exact(v) || best->prim >= v->prims.tri_count || t < best->u)
		return true;
	sign = triangle_against(v, r, best->prim, t);
	return sign > 0 || (sign == 0 && id < best->prim);
}

static int take_inner(const struct view *v, const ald_ray *r, uint32_t id, const ald_hit *found, ald_hit *hit)
{
	if (found->prim == ALD_NONE || !beats(v, r, found->t, id, hit))
		return 0;
	*hit = (ald_hit){ .t = found->t, .u = found->u, .v = found->v, .prim = id,
			  .sub = { found->prim, found->part } };
	return 1;
}

static const struct prim_instance *instance_of(const struct view *v, uint32_t id)
{
	prim_level_id(v->level, &id);
	return &v->level->instance[id];
}

static double inner_end(const struct view *v, const ald_hit *hit)
{
	return exact(v) ? ald_up(hit->t) : hit->t;
}

/* Inside, t is a fraction; here the number nearest to it, which may have been seen already. */
static bool too_near(const struct view *v, const ald_ray *r, uint32_t id, const ald_hit *found)
{
	return exact(v) && found->prim != ALD_NONE &&
	       !(found->t > r->tmin || (found->t == r->tmin && r->after != ALD_NONE && id >= r->after));
}

static bool occluded(const ald_accel_plugin *p, const ald_accel *a, ald_query *q, const ald_ray *r)
{
	ald_hit h = { .t = r->tmax, .prim = ALD_NONE };

	return ACCEL_HAS(p, occluded) ? p->occluded(a, q, r) : p->intersect(a, q, r, &h);
}

/* Is any hit inside as good as the nearest? Not in solids, which show only parts of it, nor where t has to be told
 * apart from tmin. */
static bool any_inside(const struct view *v, const struct worker *w, const struct prim_instance *p)
{
	return w->any && p->node == SCENE_NONE && !exact(v);
}

static int intersect_instance(const struct view *v, uint32_t id, ald_query *q, const ald_ray *r,
			      ald_hit *hit)
{
	const struct prim_instance *p = instance_of(v, id);
	struct worker *w = ((struct query *)q)->worker;
	ald_ray in;
	ald_hit found;

	inner_ray(p, id, r, inner_end(v, hit), &in, &found);
	if (any_inside(v, w, p)) {
		if (!occluded(v->geometry->plugin, v->geometry->view[p->level].accel, &w->query[p->level].q, &in))
			return 0;
		hit->prim = id;
		return 1;
	}
	for (;;) {
		view_nearest(&v->geometry->view[p->level], w, &in, &found);
		if (found.prim == ALD_NONE || (!too_near(v, r, id, &found) &&
					       (p->node == SCENE_NONE || csg_shows(v, w, p->node, r, found.t))))
			break;
		trace_after(&in, &found);
		found = (ald_hit){ .t = in.tmax, .prim = ALD_NONE };
	}
	return take_inner(v, r, id, &found, hit);
}

static int intersect_other(const struct view *v, uint32_t id, ald_query *q, const ald_ray *r, ald_hit *hit)
{
	const struct prim_level *l = v->level;
	const struct prim_piece *piece;
	uint32_t i = id;

	switch (prim_level_id(l, &i)) {
	case PRIM_INSTANCE:
		return intersect_instance(v, id, q, r, hit);
	case PRIM_PIECE:
		piece = &l->piece[i];
		if (l->body[piece->body].node != SCENE_NONE)
			return csg_intersect_piece(v, ((struct query *)q)->worker, &l->body[piece->body],
						   piece, id, r, hit);
		return piece_intersect(&l->body[piece->body], piece, id, r, hit);
	case PRIM_SHAPE:
		if (l->prim[i].node != SCENE_NONE)
			return csg_intersect_shape(v, ((struct query *)q)->worker, &l->prim[i], id, r, hit);
		return prim_intersect(&l->prim[i], id, r, hit);
	case PRIM_TRIANGLE:
		break;
	}
	return 0;
}

/* The same, where the ray goes on behind a triangle, or has met one, and the order is exact: tmin is the nearest
 * number to where the triangle is, so a hit at tmin may be on either side. */
static int intersect_exactly(const struct view *v, uint32_t id, ald_query *q, const ald_ray *r, ald_hit *hit)
{
	bool behind = r->after < v->prims.tri_count;
	ald_hit found = *hit;
	ald_ray mine = *r;
	int sign;

	if (behind) {
		mine.tmin = ald_down(r->tmin);
		mine.after = ALD_NONE;
	}
	if (!intersect_other(v, id, q, &mine, &found))
		return 0;
	if (behind && found.t == r->tmin) {
		sign = triangle_against(v, r, r->after, r->tmin);
		if (sign > 0 || (sign == 0 && id < r->after)) {
			mine.tmin = r->tmin;
			found = *hit;
			if (!intersect_other(v, id, q, &mine, &found))
				return 0;
		}
	}
	if (!beats(v, r, found.t, id, hit))
		return 0;
	*hit = found;
	return 1;
}

int view_intersect(const ald_prims *prims, uint32_t id, ald_query *q, const ald_ray *r, ald_hit *hit)
{
	const struct view *v = (const struct view *)prims;
	uint32_t tris = prims->tri_count;
	ald_prep prep;
	vec c[3];

	if (!ald_sees(prims, r, id))
		return 0;
	if (id >= tris)
		return (exact(v) && (r->after < tris || hit->prim < tris) ? intersect_exactly :
									   intersect_other)(v, id, q, r, hit);
	ald_ray_prep(&v->frame, r, &prep);
	prim_triangle(v->level, id, c);
	return ald_triangle(&prep, r, c, id, hit);
}

static void intersect_instance_n(const struct view *v, uint32_t id, ald_query *q, const ald_ray *r,
				 ald_hit *hit, const uint8_t *live, uint32_t n)
{
	const struct prim_instance *p = instance_of(v, id);
	const struct geometry *g = v->geometry;
	struct worker *w = ((struct query *)q)->worker;
	uint32_t m = 0;

	for (uint32_t i = 0; i < n || m; i++) {
		if (i < n && live[i] && ald_sees(&v->prims, &r[i], id)) {
			if (r[i].after < v->prims.tri_count && exact(v)) {
				view_intersect(&v->prims, id, q, &r[i], &hit[i]);
			} else {
				inner_ray(p, id, &r[i], inner_end(v, &hit[i]), &w->inner_ray[m],
					  &w->inner_hit[m]);
				w->slot[m++] = i;
			}
		}
		if (m < TRACE_BATCH && i + 1 < n)
			continue;
		if (any_inside(v, w, p)) {
			memset(w->inner_hidden, 0, m);
			accel_occluded_n(g->plugin, g->view[p->level].accel, &w->query[p->level].q, w->inner_ray,
					 w->inner_hidden, m, 0);
			for (uint32_t k = 0; k < m; k++) {
				if (w->inner_hidden[k])
					hit[w->slot[k]].prim = id;
			}
			m = 0;
			continue;
		}
		accel_nearest_n(g->plugin, g->view[p->level].accel, &w->query[p->level].q, w->inner_ray,
				w->inner_hit, m, 0);
		view_settle_n(&g->view[p->level], w->inner_ray, w->inner_hit, m);
		for (uint32_t k = 0; k < m; k++) {
			uint32_t at = w->slot[k];

			if (too_near(v, &r[at], id, &w->inner_hit[k]))
				view_intersect(&v->prims, id, q, &r[at], &hit[at]);
			else
				take_inner(v, &r[at], id, &w->inner_hit[k], &hit[at]);
		}
		m = 0;
	}
}

void view_intersect_n(const ald_prims *prims, uint32_t id, ald_query *q, const ald_ray *r, ald_hit *hit,
		      const uint8_t *live, uint32_t n)
{
	const struct view *v = (const struct view *)prims;
	uint32_t kind = id;

	if (prim_level_id(v->level, &kind) == PRIM_INSTANCE && v->level->instance[kind].node == SCENE_NONE) {
		intersect_instance_n(v, id, q, r, hit, live, n);
		return;
	}
	for (uint32_t i = 0; i < n; i++) {
		if (live[i])
			view_intersect(prims, id, q, &r[i], &hit[i]);
	}
}

void accel_nearest_n(const ald_accel_plugin *p, const ald_accel *a, ald_query *q, const ald_ray *r,
		     ald_hit *hit, uint32_t n, uint32_t hints)
{
	if (!n)
		return;
	if (ACCEL_HAS(p, intersect_n)) {
		p->intersect_n(a, q, r, hit, n, hints);
		return;
	}
	for (uint32_t i = 0; i < n; i++)
		p->intersect(a, q, &r[i], &hit[i]);
}

void accel_occluded_n(const ald_accel_plugin *p, const ald_accel *a, ald_query *q, const ald_ray *r,
		      uint8_t *hidden, uint32_t n, uint32_t hints)
{
	if (!n)
		return;
	if (ACCEL_HAS(p, occluded_n)) {
		p->occluded_n(a, q, r, hidden, n, hints);
		return;
	}
	for (uint32_t i = 0; i < n; i++)
		hidden[i] = occluded(p, a, q, &r[i]);
}
