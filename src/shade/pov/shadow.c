/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Shadow rays: first whether anything opaque is in the way, for all of them; then, of what is left,
 * every clear surface in order (R2: none is lost, coincident ones included). Each surface crossed
 * multiplies the light by what its layers let through and by the
 * fading of the interior that lies behind.
 */
#include "shade/pov/shadow.h"

#include "base/rng.h"
#include "shade/pov/fog.h"
#include "shade/pov/interior.h"
#include "shade/pov/media.h"
#include "shade/pov/point.h"

#define BATCH 1024
#define CAUSTICS_POWER 45 /* measured: caustics 1 narrows the light to the 45th power */

static void make_ray(const struct shader *sh, ald_ray *r, const struct shadow *s, uint32_t mask)
{
	r->org = s->org;
	r->dir = s->dir;
	r->tmin = 0;
	r->tmax = s->depth;
	r->mask = mask;
	r->skip = s->skip;
	r->after = r->after_sub[0] = r->after_sub[1] = ALD_NONE;
	if (sh->marks)
		trace_mark(r, s->pixel, TRACE_FOR_SHADOW);
}

/* Looking at what a surface lets through. */
struct filtering {
	const struct scene *scene;
	double caustics, cosine;
	struct rgb sum;
};

/* How straight light falls on a layer, bumps and all. */
static double straightness(const struct filtering *f, const struct layer *l, const struct pattern_point *at)
{
	return l->normal ? vec_dot(normal_at(f->scene, l->normal, at, at->n), at->dir) : f->cosine;
}

/* What a texture of layers lets through; fake caustics brighten where the light falls straight (3.4.8.1.3). */
static void add_filter(void *self, const struct texture *t, const struct pattern_point *at, double share)
{
	struct filtering *f = self;
	struct rgb through = { 1, 1, 1 };

	for (uint32_t i = 0; i < t->count; i++) {
		const struct pigment *p = &t->layer[i].pigment;

		through = rgb_mul(through,
				  rgbft_through(p->pattern ? pigment_at(f->scene, p, at) : p->colour));
		if (f->caustics != 0)
			through = rgb_scale(through, 1 + pow(fabs(straightness(f, &t->layer[i], at)),
							     CAUSTICS_POWER * f->caustics));
	}
	f->sum = rgb_add(f->sum, rgb_scale(through, share));
}

static void filter_texture(struct filtering *f, const struct surface *s, uint32_t texture,
			   const struct xform *place, vec dir, double share)
{
	const struct texture *t = &f->scene->texture[texture];
	struct pattern_point at;

	if (t->plain) {
		add_filter(f, t, NULL, share);
		return;
	}
	at = texture_point(s, place, f->cosine > 0 ? vec_neg(s->ns) : s->ns, dir);
	texture_visit(f->scene, t, &at, share, add_filter, f);
}

static struct rgb surface_filter(const struct shader *sh, const struct surface *s, vec dir)
{
	const struct scene *scene = sh->scene;
	struct filtering f = { .scene = scene,
			       .caustics = s->interior == SCENE_NONE ? 0 : scene->interior[s->interior].caustics,
			       .cosine = vec_dot(s->ns, dir) };

	if (f.cosine > 0 && s->interior_texture != SCENE_NONE) {
		filter_texture(&f, s, s->interior_texture, s->interior_texture_place, dir, 1);
	} else if (surface_is_even(s) && s->texture[0] != SCENE_NONE) {
		filter_texture(&f, s, s->texture[0], s->texture_place[0], dir, 1);
	} else {
		for (uint32_t i = 0; i < s->blend; i++) {
			if (s->bary[i] >= scene->adc_bailout && s->texture[i] != SCENE_NONE)
				filter_texture(&f, s, s->texture[i], s->texture_place[i], dir, s->bary[i]);
		}
	}
	return f.sum;
}

/* The ray went on to t = to, or has come to its end there: take off what is lost in what fills the world. */
static void through_air(const struct shader *sh, struct tree *t, struct shadow *s, double from, double to)
{
	vec at = vec_mad(s->org, s->dir, from);

	if (!s->air || !(to > from) || !inside_hollow(t, s->inside))
		return;
	s->colour = rgb_mul(s->colour, fog_clear(sh->scene, at, s->dir, to - from, NULL));
	if (sh->scene->media_count)
		s->colour = rgb_mul(s->colour, media_world_clear(sh, t, s->inside, at, s->dir, to - from,
								 rng_child(1, s->skip)));
}

/* The ray goes on behind what it crossed. */
static void cross(const struct shader *sh, struct tree *t, struct shadow *s, ald_ray *r, const ald_hit *h)
{
	struct surface at;

	surface_at(sh->geometry, r, h, &at);
	through_air(sh, t, s, fmax(0, r->tmin), h->t);
	if (sh->media && !s->vacuum) {
		double from = r->tmin > 0 ? r->tmin : 0;

		s->colour = rgb_mul(s->colour, media_clear(sh, t, s->inside, vec_mad(s->org, s->dir, from),
							   s->dir, h->t - from, rng_child(0, h->prim)));
	}
	s->colour = rgb_mul(s->colour, surface_filter(sh, &at, s->dir));
	if (inside_contains(t, s->inside, at.object)) {
		double from = r->tmin > 0 ? r->tmin : 0;

		s->colour = rgb_mul(s->colour, interior_shadow_fade(sh->scene, at.interior, h->t - from));
		s->inside = inside_leave(t, s->inside, at.object);
	} else {
		s->inside = inside_enter(t, s->inside, at.object, at.interior, at.flags & OBJECT_HOLLOW);
	}
	if (at.anew) {
		s->org = vec_mad(s->org, s->dir, h->t);
		s->depth -= h->t;
		make_ray(sh, r, s, TRACE_SHADOW_CLEAR);
	} else {
		trace_after(r, h);
	}
}

/* The rays i of the batch that are not yet done, through one clear surface after the other. */
static void filter_batch(const struct shader *sh, struct tree *t, uint32_t thread, struct shadow *s,
			 uint32_t *live, uint32_t n, struct shade_counts *counts)
{
	ald_ray *ray = t->ray.data;
	ald_hit *hit = t->hit.data;

	for (uint32_t i = 0; i < n; i++)
		make_ray(sh, &ray[i], &s[live[i]], TRACE_SHADOW_CLEAR);
	while (n) {
		uint32_t left = 0;

		trace_nearest(sh->geometry, thread, ray, hit, n, 0);
		for (uint32_t i = 0; i < n; i++) {
			struct shadow *one = &s[live[i]];

			if (hit[i].prim == ALD_NONE) {
				through_air(sh, t, one, fmax(0, ray[i].tmin), one->depth);
				continue;
			}
			counts->shadow_hit++;
			cross(sh, t, one, &ray[i], &hit[i]);
			if (shadow_dark(one->colour)) {
				one->colour = rgb_make(0, 0, 0);
				continue;
			}
			ray[left] = ray[i];
			live[left++] = live[i];
		}
		n = left;
	}
}

static void trace_batch(const struct shader *sh, struct tree *t, uint32_t thread, struct shadow *s,
			uint32_t n, uint32_t hints, struct shade_counts *counts)
{
	ald_ray *ray = t->ray.data;
	uint8_t *hidden = t->hidden.data;
	uint32_t live[BATCH], left = 0;

	for (uint32_t i = 0; i < n; i++)
		make_ray(sh, &ray[i], &s[i], TRACE_SHADOW_OPAQUE);
	trace_occluded(sh->geometry, thread, ray, hidden, n, hints);
	counts->shadow_cast += n;
	for (uint32_t i = 0; i < n; i++) {
		if (hidden[i]) {
			s[i].colour = rgb_make(0, 0, 0);
			counts->shadow_hit++;
		} else {
			live[left++] = i;
		}
	}
	for (uint32_t i = 0; (sh->fog || sh->scene->media_count) && !sh->clear_shadows && i < left; i++)
		through_air(sh, t, &s[live[i]], 0, s[live[i]].depth);
	if (left && sh->clear_shadows)
		filter_batch(sh, t, thread, s, live, left, counts);
}

/* How far along the ray the thing is that its light is projected through. False: nowhere before the light. */
static bool find_projected(const struct shader *sh, uint32_t thread, const struct shadow *s, double *t)
{
	ald_hit hit;
	ald_ray ray;

	make_ray(sh, &ray, s, TRACE_PROJECTED);
	for (;;) {
		struct surface at;

		trace_nearest(sh->geometry, thread, &ray, &hit, 1, 0);
		if (hit.prim == ALD_NONE)
			return false;
		surface_at(sh->geometry, &ray, &hit, &at);
		*t = hit.t;
		if (at.light_set == s->projector)
			return true;
		trace_after(&ray, &hit); /* another light's */
	}
}

/* Only what lies before the thing casts shadows then, be the thing itself in the scene or not. */
static void project(const struct shader *sh, uint32_t thread, struct shadow *s)
{
	double t;

	if (s->projector == SCENE_NONE)
		return;
	if (!find_projected(sh, thread, s, &t))
		s->colour = rgb_make(0, 0, 0);
	s->depth = shadow_dark(s->colour) || s->shadowless ? 0 : t * (1 - 0x1p-30);
}

void shadow_trace(const struct shader *sh, struct tree *t, uint32_t thread, uint32_t first,
		  uint32_t hints, struct shade_counts *counts)
{
	t->ray.count = t->hit.count = t->hidden.count = 0;
	if (tree_push(t, &t->ray, BATCH) == TREE_NONE || tree_push(t, &t->hit, BATCH) == TREE_NONE ||
	    tree_push(t, &t->hidden, BATCH) == TREE_NONE)
		return;
	for (uint32_t i = first; sh->projected && i < t->shadow.count; i++)
		project(sh, thread, BUF_AT(&t->shadow, struct shadow, i));
	while (first < t->shadow.count) {
		uint32_t n = t->shadow.count - first;

		n = n < BATCH ? n : BATCH;
		trace_batch(sh, t, thread, BUF_AT(&t->shadow, struct shadow, first), n, hints, counts);
		first += n;
	}
}
