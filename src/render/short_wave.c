/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Camera rays of scenes whose every surface takes the short way (shade/pov/plain.c): from the place in the picture to
 * its colour without a tree, as none would have more than its root. Triangles go eight at a time (plain_lanes.c),
 * other shapes one by one; and what turns out to need more, as a face between textures, the long way from its start.
 */
#include "render/short_wave.h"

#include <string.h>

#include "shade/camera.h"

static bool asked_to_stop(struct worker *w)
{
	w->stopped = w->stopped || (w->options->stop && w->options->stop(w->options->arg));
	return w->stopped;
}

static vec into_room(const struct trace_room *room, vec p)
{
	return vec_scale(vec_sub(p, room->shift), room->scale);
}

/* org: where all rays start, if it is one point, or NULL. */
static void put_ray(const struct short_wave *s, const struct camera_rays *c, const vec *org, uint32_t at, unsigned i)
{
	const struct trace_room *room = &s->lanes.room;
	ald_ray *r = &room->ray[at + i];

	r->org = org ? *org : into_room(room, vec_make(c->org[0][i], c->org[1][i], c->org[2][i]));
	r->dir = vec_scale(vec_make(c->dir[0][i], c->dir[1][i], c->dir[2][i]), room->scale);
	r->tmin = 0;
	r->tmax = HUGE_VAL;
	r->mask = TRACE_CAMERA;
	r->skip = r->after = r->after_sub[0] = r->after_sub[1] = ALD_NONE;
	r->reserved[0] = r->reserved[1] = r->reserved[2] = 0;
	if (c->there[i] == 0) /* the camera sees nothing here */
		trace_nothing(r);
}

static void make_rays(struct worker *w, uint32_t n)
{
	const struct render_options *o = w->options;
	struct short_wave *s = w->shorts;
	const struct camera *camera = &w->shader->scene->camera;
	vec org = into_room(&s->lanes.room, camera->location);
	bool point = camera_is_point(camera);
	struct camera_rays c;

	for (uint32_t i = n; i % LANES; i++)
		s->x[i] = s->y[i] = 0;
	for (uint32_t at = 0; at < n; at += LANES) {
		camera_rays(camera, s->x + at, s->y + at, o->width, o->height, &c);
		for (unsigned k = 0; k < 3; k++)
			memcpy(s->lanes.dir[k] + at, c.dir[k], sizeof(c.dir[k]));
		for (unsigned i = 0; i < LANES; i++)
			s->there[at + i] = c.there[i] != 0;
		for (unsigned i = 0; i < LANES && at + i < n; i++)
			put_ray(s, &c, point ? &org : NULL, at, i);
	}
}

static void see_nothing(const struct shader *sh, bool there, struct seen *out)
{
	out->colour = there ? sh->open[sh->alpha].colour : rgb_make(0, 0, 0);
	out->transmit = there ? sh->open[sh->alpha].transmit : sh->alpha;
}

/* A hit on something that is no triangle; false: it has to go the long way. */
static bool see_other(struct worker *w, uint32_t i, const ald_hit *hit)
{
	static const uint32_t no_pixel[2] = { 0, 0 }; /* rays are not told theirs on the short way */
	const struct render_options *o = w->options;
	const struct short_wave *s = w->shorts;
	ald_ray r = { .tmax = HUGE_VAL, .mask = TRACE_CAMERA, .skip = ALD_NONE, .after = ALD_NONE,
		      .after_sub = { ALD_NONE, ALD_NONE } };
	struct surface at;

	camera_ray(&w->shader->scene->camera, s->x[i], s->y[i], o->width, o->height, &r.org, &r.dir);
	surface_at(w->shader->geometry, &r, hit, &at);
	return plain_hit(w->shader, &w->tree, i, r.dir, no_pixel, &at, hit->prim);
}

/* What the rays hit; how many have to go the long way: those whose place in later is true. */
static uint32_t see(struct worker *w, uint32_t n, struct seen *out)
{
	struct short_wave *s = w->shorts;
	uint32_t left = 0, hits = 0;

	for (uint32_t i = 0; i < n; i++) {
		const ald_hit *hit = &s->lanes.hit[i];

		s->later[i] = false;
		if (hit->prim == ALD_NONE) {
			see_nothing(w->shader, s->there[i], &out[i]);
			continue;
		}
		hits++;
		if (plain_lanes_take(&s->lanes, w->shader, s->paint, i, hit))
			continue;
		out[i].transmit = 0;
		s->later[i] = !see_other(w, i, hit);
		left += s->later[i];
	}
	w->counts.hit[RENDER_CAMERA] += hits - left;
	w->counts.cast[RENDER_CAMERA] += n - left;
	w->counts.samples += n - left;
	return left;
}

static bool follow_later(struct worker *w, uint32_t n, uint32_t left, struct seen *out)
{
	const struct short_wave *s = w->shorts;
	uint32_t k = 0;

	if (!wave_begin(w))
		return false;
	for (uint32_t i = 0; i < n; i++) {
		struct sample at = { .x = s->x[i], .y = s->y[i] };
		struct wave_root root = { .x = at.x, .y = at.y, .key = wave_seeded(w, wave_key(&at)) };

		if (s->later[i] && !wave_push(w, &root))
			return false;
	}
	if (!wave_follow(w, left))
		return false;
	for (uint32_t i = 0; i < n; i++) {
		struct sample at;

		if (!s->later[i])
			continue;
		wave_take(w, k++, &at);
		out[i] = (struct seen){ at.colour, at.transmit };
	}
	return true;
}

bool wave_short(struct worker *w, uint32_t n, struct seen *out)
{
	uint32_t hints = ALD_COHERENT | (camera_is_point(&w->shader->scene->camera) ? ALD_ONE_ORIGIN : 0), left;
	struct shade_counts counts = { 0, 0, 0, 0 };
	struct short_wave *s = w->shorts;
	struct tree *t = &w->tree;

	if (asked_to_stop(w))
		return false;
	tree_reset(t);
	plain_lanes_begin(&s->lanes, w->shader, w->thread);
	make_rays(w, n);
	trace_room_nearest(w->shader->geometry, w->thread, s->lanes.hit, n, hints);
	left = see(w, n, out);
	plain_lanes_light(&s->lanes, w->shader, s->paint, w->thread, ALD_COHERENT, out, &counts);
	plain_light(w->shader, t, w->thread, ALD_COHERENT, &counts);
	if (t->no_memory)
		return false;
	for (uint32_t i = 0; i < t->plain.count; i++) {
		const struct plain *p = BUF_AT(&t->plain, struct plain, i);

		out[p->to].colour = p->colour;
	}
	w->counts.cast[RENDER_SHADOW] += counts.shadow_cast;
	w->counts.hit[RENDER_SHADOW] += counts.shadow_hit;
	return !left || follow_later(w, n, left, out);
}

bool wave_trace_short(struct worker *w, uint32_t first, uint32_t n)
{
	struct short_wave *s = w->shorts;

	for (uint32_t done = 0; done < n; done += SHORT_BATCH) {
		uint32_t m = n - done < SHORT_BATCH ? n - done : SHORT_BATCH;

		for (uint32_t i = 0; i < m; i++) {
			s->x[i] = BUF_AT(&w->sample, struct sample, first + done + i)->x;
			s->y[i] = BUF_AT(&w->sample, struct sample, first + done + i)->y;
		}
		if (!wave_short(w, m, s->seen))
			return false;
		for (uint32_t i = 0; i < m; i++) {
			struct sample *out = BUF_AT(&w->sample, struct sample, first + done + i);

			out->colour = s->seen[i].colour;
			out->transmit = s->seen[i].transmit;
			out->variance = rgb_make(0, 0, 0);
		}
	}
	return true;
}
