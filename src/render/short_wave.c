/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Camera rays of scenes whose every surface takes the short way (shade/pov/plain.c): from the place in the picture to
 * its colour without a tree, as none would have more than its root. What turns out to need more, as a face between
 * textures, goes the long way from its start.
 */
#include "render/wave.h"

#include "shade/camera.h"

#define BATCH 1024

static bool point_ray(const struct worker *w, const struct sample *s, ald_ray *r)
{
	const struct render_options *o = w->options;
	bool there = camera_ray(&w->shader->scene->camera, s->x, s->y, o->width, o->height, &r->org, &r->dir);

	if (!there) { /* the camera sees nothing here */
		r->org = w->shader->scene->camera.location;
		r->dir = vec_make(0, 0, 1);
	}
	r->tmin = 0;
	r->tmax = HUGE_VAL;
	r->mask = there ? TRACE_CAMERA : 0;
	r->skip = r->after = r->after_sub[0] = r->after_sub[1] = ALD_NONE;
	return there;
}

static void see_nothing(const struct shader *sh, struct sample *s, bool there)
{
	s->colour = there ? sh->open[sh->alpha].colour : rgb_make(0, 0, 0);
	s->transmit = there ? sh->open[sh->alpha].transmit : sh->alpha;
}

/* What the rays hit; how many have to go the long way: those whose place in later is true. */
static uint32_t see(struct worker *w, uint32_t first, uint32_t n, bool *later)
{
	struct tree *t = &w->tree;
	const ald_ray *ray = t->ray.data;
	const ald_hit *hit = t->hit.data;
	uint32_t left = 0;

	for (uint32_t i = 0; i < n; i++) {
		struct sample *s = BUF_AT(&w->sample, struct sample, first + i);
		struct surface at;
		uint32_t pixel[2];

		s->variance = rgb_make(0, 0, 0);
		s->transmit = 0;
		later[i] = false;
		if (hit[i].prim == ALD_NONE) {
			see_nothing(w->shader, s, ray[i].mask);
			continue;
		}
		surface_at(w->shader->geometry, &ray[i], &hit[i], &at);
		wave_pixel(w, s->x, s->y, pixel);
		later[i] = !plain_hit(w->shader, t, first + i, ray[i].dir, pixel, &at, hit[i].prim);
		left += later[i];
		w->counts.hit[RENDER_CAMERA] += !later[i];
	}
	w->counts.cast[RENDER_CAMERA] += n - left;
	w->counts.samples += n - left;
	return left;
}

static bool follow_later(struct worker *w, uint32_t first, uint32_t n, const bool *later, uint32_t left)
{
	uint32_t k = 0;

	if (!wave_begin(w))
		return false;
	for (uint32_t i = 0; i < n; i++) {
		const struct sample *s = BUF_AT(&w->sample, struct sample, first + i);
		struct wave_root root = { .x = s->x, .y = s->y, .key = wave_seeded(w, wave_key(s)) };

		if (later[i] && !wave_push(w, &root))
			return false;
	}
	if (!wave_follow(w, left))
		return false;
	for (uint32_t i = 0; i < n; i++) {
		if (later[i])
			wave_take(w, k++, BUF_AT(&w->sample, struct sample, first + i));
	}
	return true;
}

static bool batch(struct worker *w, uint32_t first, uint32_t n, uint32_t hints)
{
	struct tree *t = &w->tree;
	struct shade_counts counts = { 0, 0, 0, 0 };
	bool later[BATCH];
	uint32_t left;

	tree_reset(t);
	t->ray.count = t->hit.count = 0;
	if (tree_push(t, &t->ray, n) == TREE_NONE || tree_push(t, &t->hit, n) == TREE_NONE)
		return false;
	for (uint32_t i = 0; i < n; i++) {
		const struct sample *s = BUF_AT(&w->sample, struct sample, first + i);
		ald_ray *r = BUF_AT(&t->ray, ald_ray, i);
		uint32_t pixel[2];

		point_ray(w, s, r);
		if (w->shader->marks) {
			wave_pixel(w, s->x, s->y, pixel);
			trace_mark(r, pixel, TRACE_FOR_CAMERA);
		}
	}
	trace_nearest(w->shader->geometry, w->thread, t->ray.data, t->hit.data, n, hints);
	left = see(w, first, n, later);
	plain_light(w->shader, t, w->thread, ALD_COHERENT, &counts);
	if (t->no_memory)
		return false;
	for (uint32_t i = 0; i < t->plain.count; i++) {
		const struct plain *p = BUF_AT(&t->plain, struct plain, i);

		BUF_AT(&w->sample, struct sample, p->to)->colour = p->colour;
	}
	w->counts.cast[RENDER_SHADOW] += counts.shadow_cast;
	w->counts.hit[RENDER_SHADOW] += counts.shadow_hit;
	return !left || follow_later(w, first, n, later, left);
}

bool wave_trace_short(struct worker *w, uint32_t first, uint32_t n)
{
	uint32_t hints = ALD_COHERENT | (camera_is_point(&w->shader->scene->camera) ? ALD_ONE_ORIGIN : 0);

	for (uint32_t i = 0; i < n; i += BATCH) {
		if (w->options->stop && w->options->stop(w->options->arg)) {
			w->stopped = true;
			return false;
		}
		if (!batch(w, first + i, n - i < BATCH ? n - i : BATCH, hints))
			return false;
	}
	return true;
}
