/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Shadow rays: whether anything opaque is in the way, and every clear surface in order (R2: none is lost, coincident
 * ones included). Each surface crossed multiplies the light by what its layers let through and by the fading of the
 * interior that lies behind.
 *
 * Where nothing is clear that is one question. Else rays look for both at once, as most meet nothing, or something
 * opaque first; those that have crossed several surfaces are asked for anything opaque ahead before they go on.
 */
#include "shade/pov/shadow.h"

#include "base/rng.h"
#include "shade/pov/fog.h"
#include "shade/pov/interior.h"
#include "shade/pov/media.h"
#include "shade/pov/point.h"

#define BATCH 1024
#define CROSSED 8 /* clear surfaces: of hair or leaves there may be many before something opaque */
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
		make_ray(sh, r, s, r->mask);
	} else {
		trace_after(r, h);
	}
}

/* Those that anything opaque ahead hides are done; the others look for clear surfaces alone from now on. */
static uint32_t drop_hidden(const struct shader *sh, struct tree *t, uint32_t thread, struct shadow *s,
			    uint32_t *live, uint32_t n)
{
	ald_ray *ray = t->ray.data;
	const uint8_t *hidden = t->hidden.data;
	uint32_t left = 0;

	for (uint32_t i = 0; i < n; i++)
		ray[i].mask = TRACE_SHADOW_OPAQUE;
	trace_occluded(sh->geometry, thread, ray, t->hidden.data, n, 0);
	for (uint32_t i = 0; i < n; i++) {
		if (hidden[i]) {
			s[live[i]].colour = rgb_make(0, 0, 0);
			continue;
		}
		ray[i].mask = TRACE_SHADOW_CLEAR;
		ray[left] = ray[i];
		live[left++] = live[i];
	}
	return left;
}

/* What the rays have met, or that they have not; those which go on are left, and their number is returned. */
static uint32_t cross_batch(const struct shader *sh, struct tree *t, struct shadow *s, uint32_t *live, uint32_t n)
{
	ald_ray *ray = t->ray.data;
	const ald_hit *hit = t->hit.data;
	uint32_t left = 0;

	for (uint32_t i = 0; i < n; i++) {
		struct shadow *one = &s[live[i]];

		if (hit[i].prim == ALD_NONE) {
			through_air(sh, t, one, fmax(0, ray[i].tmin), one->depth);
			continue;
		}
		if (!(trace_seen_by(sh->geometry, &hit[i]) & ray[i].mask & TRACE_SHADOW_OPAQUE)) {
			cross(sh, t, one, &ray[i], &hit[i]);
			if (!shadow_dark(one->colour)) {
				ray[left] = ray[i];
				live[left++] = live[i];
				continue;
			}
		}
		one->colour = rgb_make(0, 0, 0);
	}
	return left;
}

/* Through one clear surface after the other. */
static void filter_batch(const struct shader *sh, struct tree *t, uint32_t thread, struct shadow *s, uint32_t n,
			 uint32_t hints, struct shade_counts *counts)
{
	ald_ray *ray = t->ray.data;
	const ald_hit *hit = t->hit.data;
	uint32_t live[BATCH];

	for (uint32_t i = 0; i < n; i++) {
		make_ray(sh, &ray[i], &s[i], TRACE_SHADOW_OPAQUE | TRACE_SHADOW_CLEAR);
		live[i] = i;
	}
	for (uint32_t crossed = 0; n; crossed++) {
		if (crossed == CROSSED)
			n = drop_hidden(sh, t, thread, s, live, n);
		trace_nearest(sh->geometry, thread, ray, t->hit.data, n, crossed ? 0 : hints);
		for (uint32_t i = 0; !crossed && i < n; i++)
			counts->shadow_hit += hit[i].prim != ALD_NONE;
		n = cross_batch(sh, t, s, live, n);
	}
}

static void trace_batch(const struct shader *sh, struct tree *t, uint32_t thread, struct shadow *s,
			uint32_t n, uint32_t hints, struct shade_counts *counts)
{
	ald_ray *ray = t->ray.data;
	const uint8_t *hidden = t->hidden.data;

	counts->shadow_cast += n;
	if (sh->clear_shadows) {
		filter_batch(sh, t, thread, s, n, hints, counts);
		return;
	}
	for (uint32_t i = 0; i < n; i++)
		make_ray(sh, &ray[i], &s[i], TRACE_SHADOW_OPAQUE);
	trace_occluded(sh->geometry, thread, ray, t->hidden.data, n, hints);
	for (uint32_t i = 0; i < n; i++) {
		counts->shadow_hit += hidden[i];
		if (hidden[i])
			s[i].colour = rgb_make(0, 0, 0);
		else if (sh->fog || sh->scene->media_count)
			through_air(sh, t, &s[i], 0, s[i].depth);
	}
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
