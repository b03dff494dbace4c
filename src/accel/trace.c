/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Batches of world rays to the accelerator and the unbounded list, and back.
 */
#include <string.h>

#include "accel/geometry.h"
#include "accel/verify.h"
#include "base/process.h"

static bool sound(const ald_ray *r)
{
	return vec_finite(r->org) && vec_finite(r->dir) &&
	       (r->dir.x != 0 || r->dir.y != 0 || r->dir.z != 0) && r->tmin <= r->tmax;
}

static void enter_level(const struct prim_level *l, const ald_ray *in, ald_ray *out)
{
	/* One by one: clearing what has no name takes longer than all the rest. */
	out->org = prim_level_point(l, in->org);
	out->dir = vec_scale(in->dir, l->scale);
	out->tmin = in->tmin;
	out->tmax = in->tmax;
	out->mask = in->mask;
	out->skip = in->skip;
	out->after = in->after;
	out->after_sub[0] = in->after_sub[0];
	out->after_sub[1] = in->after_sub[1];
	for (unsigned k = 0; k < sizeof(out->reserved) / sizeof(*out->reserved); k++)
		out->reserved[k] = 0;
	if (!sound(in))
		trace_nothing(out);
}

static bool shows_at(const struct geometry *g, struct worker *w, const struct prim_unbounded *u, uint32_t id,
		     bool past, const ald_ray *r, double t, ald_hit *h)
{
	if ((past && t == r->tmin) || !ald_counts(r, t, id, h) ||
	    (u->node != SCENE_NONE && !csg_shows(&g->view[0], w, u->node, r, t)))
		return false;
	h->t = t;
	return true;
}

/* Where the ray first meets what has no bounds, if that counts. */
static bool meets(const struct geometry *g, struct worker *w, const struct prim_unbounded *u, uint32_t id, bool past,
		  const ald_ray *r, ald_hit *h)
{
	struct prim_roots roots;
	double t;

	if (u->prim == SCENE_NONE)
		return plane_intersect(&u->plane, r, &t) && shows_at(g, w, u, id, past, r, t, h);
	prim_crossings(&g->set.level[0].prim[u->prim], r, &roots);
	for (uint32_t i = 0; i < roots.count; i++) {
		if (isfinite(roots.t[i]) && shows_at(g, w, u, id, past, r, roots.t[i], h))
			return true;
	}
	return false;
}

/* The nearest plane: it becomes the ray's tmax, so that the accelerator looks no further. Of what is met
 * at the same t planes come first, as in POV-Ray: a glass box that stands on a floor shows the floor. The
 * ray is left to ask for primitives in that order. */
static uint32_t nearest_plane(const struct geometry *g, struct worker *w, ald_ray *r)
{
	uint32_t count = g->set.level[0].count, best = ALD_NONE;
	bool past = r->after < count; /* all planes at tmin have had their turn */
	ald_hit h = { .t = r->tmax, .prim = ALD_NONE };

	for (uint32_t i = 0; i < g->set.unbounded_count; i++) {
		const struct prim_unbounded *u = &g->set.unbounded[i];
		uint32_t id = count + i;

		if (!(u->mask & r->mask) || id == r->skip)
			continue;
		if (w->query[0].q.count)
			w->count[ALD_COUNT_PRIMS]++;
		if (meets(g, w, u, id, past, r, &h))
			h.prim = best = id;
	}
	if (best != ALD_NONE)
		r->tmax = h.t;
	if (!past && r->after != ALD_NONE) { /* behind a plane: all primitives at tmin are still to come */
		r->tmin = nextafter(r->tmin, -ALD_INF);
		r->after = ALD_NONE;
	}
	return best;
}

/* In exact order: planes, whose t are numbers, come before the triangles whose t is nearest to that number; so
 * what the ray has passed on its way to a plane at tmin is not to be met again. */
static void pass_planes(const struct geometry *g, struct worker *w, const ald_ray *asked, uint32_t i, ald_hit *hit)
{
	while (hit->prim != ALD_NONE && hit->t < asked->tmin) {
		ald_ray next = w->ray[i];

		trace_after(&next, hit);
		*hit = (ald_hit){ .t = next.tmax, .prim = ALD_NONE };
		view_nearest(&g->view[0], w, &next, hit);
	}
}

/* Rays in w->ray, of which asked is NULL or what they are in the world. */
static void room_nearest(const struct geometry *g, struct worker *w, const ald_ray *asked, ald_hit *hit, uint32_t n,
			 uint32_t hints)
{
	bool planes = g->set.unbounded_count > 0, exact = g->precision == ALD_PRECISION_EXACT;

	for (uint32_t i = 0; i < n; i++) {
		w->plane[i] = planes ? nearest_plane(g, w, &w->ray[i]) : ALD_NONE;
		hit[i] = (ald_hit){ .t = w->ray[i].tmax, .prim = ALD_NONE };
	}
	if (g->view[0].accel)
		accel_nearest_n(g->plugin, g->view[0].accel, &w->query[0].q, w->ray, hit, n, hints);
	process_arithmetic(); /* which a plugin should not, but may change */
	view_settle_n(&g->view[0], w->ray, hit, n);
	for (uint32_t i = 0; exact && planes && i < n; i++)
		pass_planes(g, w, &asked[i], i, &hit[i]);
	for (uint32_t i = 0; planes && i < n; i++) {
		if (w->plane[i] != ALD_NONE && hit[i].t >= w->ray[i].tmax)
			hit[i] = (ald_hit){ .t = w->ray[i].tmax, .prim = w->plane[i] };
	}
}

void trace_nearest(const struct geometry *g, uint32_t thread, const ald_ray *rays, ald_hit *hits,
		   uint32_t n, uint32_t hints)
{
	struct worker *w = g->worker[thread];

	for (uint32_t first = 0; first < n; first += TRACE_BATCH) {
		uint32_t m = n - first < TRACE_BATCH ? n - first : TRACE_BATCH;

		for (uint32_t i = 0; i < m; i++)
			enter_level(&g->set.level[0], &rays[first + i], &w->ray[i]);
		room_nearest(g, w, rays + first, hits + first, m, hints);
	}
	if (g->verify)
		verify_nearest(g->verify, thread, rays, hits, n);
}

/* Rays in w->ray. */
static void room_occluded(const struct geometry *g, struct worker *w, uint8_t *hidden, uint32_t n, uint32_t hints)
{
	bool planes = g->set.unbounded_count > 0;
	uint32_t live = 0;

	/* Only those that no plane hides go on. */
	for (uint32_t i = 0; planes && i < n; i++) {
		hidden[i] = nearest_plane(g, w, &w->ray[i]) != ALD_NONE;
		if (hidden[i])
			continue;
		if (live < i)
			w->ray[live] = w->ray[i];
		w->plane[live] = i;
		w->hidden[live++] = 0;
	}
	if (!planes)
		memset(hidden, 0, n);
	if (!g->view[0].accel)
		return;
	w->any = true;
	accel_occluded_n(g->plugin, g->view[0].accel, &w->query[0].q, w->ray, planes ? w->hidden : hidden,
			 planes ? live : n, hints);
	w->any = false;
	process_arithmetic();
	for (uint32_t i = 0; i < live; i++)
		hidden[w->plane[i]] = w->hidden[i];
}

void trace_occluded(const struct geometry *g, uint32_t thread, const ald_ray *rays, uint8_t *hidden,
		    uint32_t n, uint32_t hints)
{
	struct worker *w = g->worker[thread];

	for (uint32_t first = 0; first < n; first += TRACE_BATCH) {
		uint32_t m = n - first < TRACE_BATCH ? n - first : TRACE_BATCH;

		for (uint32_t i = 0; i < m; i++)
			enter_level(&g->set.level[0], &rays[first + i], &w->ray[i]);
		room_occluded(g, w, hidden + first, m, hints);
	}
	if (g->verify)
		verify_occluded(g->verify, thread, rays, hidden, n);
}

_Static_assert(TRACE_ROOM <= TRACE_BATCH, "a room's rays are one batch");

bool trace_room(const struct geometry *g, uint32_t thread, struct trace_room *room)
{
	if (g->verify || (g->set.unbounded_count && g->precision == ALD_PRECISION_EXACT))
		return false;
	room->ray = g->worker[thread]->ray;
	room->shift = g->set.level[0].shift;
	room->scale = g->set.level[0].scale;
	return true;
}

void trace_room_nearest(const struct geometry *g, uint32_t thread, ald_hit *hit, uint32_t n, uint32_t hints)
{
	room_nearest(g, g->worker[thread], NULL, hit, n, hints);
}

void trace_room_occluded(const struct geometry *g, uint32_t thread, uint8_t *hidden, uint32_t n, uint32_t hints)
{
	room_occluded(g, g->worker[thread], hidden, n, hints);
}

void trace_after(ald_ray *r, const ald_hit *hit)
{
	r->tmin = hit->t;
	r->after = hit->prim;
	r->after_sub[0] = hit->sub[0];
	r->after_sub[1] = hit->sub[1];
}

uint32_t trace_seen_by(const struct geometry *g, const ald_hit *hit)
{
	const struct prim_level *l = &g->set.level[0], *in;
	uint32_t id = hit->prim, mask;

	if (id >= l->count)
		return g->set.unbounded[id - l->count].mask;
	mask = l->mask ? l->mask[id] : UINT32_MAX;
	if (prim_level_id(l, &id) != PRIM_INSTANCE)
		return mask;
	in = &g->set.level[l->instance[id].level];
	return in->mask ? mask & in->mask[hit->sub[0]] : mask;
}
