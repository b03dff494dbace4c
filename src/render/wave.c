/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A tile's camera rays -> hits -> light (shadow rays) -> what mirrors and glass ask for -> hits ...
 *
 * A wave is followed in batches of about a thousand rays, the main road of the plugin contract. What a
 * batch asks for is followed to its end, and folded into it, before the next batch of the wave: where trees
 * grow large (many mirrors, much glass), memory grows with their depth only. Each sample's colour depends
 * on its own tree alone, so batching changes nothing.
 */
#include "render/wave.h"

#include <string.h>

#include "base/rng.h"
#include "render/fold.h"
#include "render/lens.h"
#include "shade/camera.h"

#define BATCH 1024
#define GATHER_BATCH 16384 /* rays that a batch may gather; a hit's own count apart */

uint64_t wave_key(const struct sample *s)
{
	uint64_t x, y;

	memcpy(&x, &s->x, sizeof(x));
	memcpy(&y, &s->y, sizeof(y));
	return rng_mix(rng_mix(x) + y);
}

uint64_t wave_seeded(const struct worker *w, uint64_t key)
{
	return w->options->seed ? rng_child(key, w->options->seed) : key;
}

static bool root_ray(const struct worker *w, const struct wave_root *r, struct node *n)
{
	const struct scene *s = w->shader->scene;
	double width = w->options->width, height = w->options->height;
	bool there;

	if (camera_has_lens(&s->camera))
		there = camera_lens_ray(&s->camera, r->x, r->y, width, height, r->lens_x, r->lens_y, &n->org,
					&n->dir);
	else
		there = camera_ray(&s->camera, r->x, r->y, width, height, &n->org, &n->dir);
	if (there && s->camera.normal)
		camera_bend(s, r->x, r->y, width, height, &n->dir);
	return there;
}

/* The cone of a camera ray is as wide as the way to the next one; focal blur averages anyway. */
static void root_cone(const struct worker *w, const struct wave_root *r, struct node *n)
{
	const struct render_options *o = w->options;
	double step = o->budget ? 0.25 : o->spp ? 1 / sqrt(o->spp) : o->aa == RENDER_AA_GRID ? 1.0 / o->aa_n : 1;
	vec org, dir;

	if (!camera_ray(&w->shader->scene->camera, r->x + step, r->y, o->width, o->height, &org, &dir))
		return;
	n->spread = vec_length(vec_sub(dir, n->dir));
	n->width = vec_length(vec_sub(org, n->org));
	if (camera_has_lens(&w->shader->scene->camera)) { /* the origins are random then */
		vec from, to;

		if (camera_ray(&w->shader->scene->camera, r->x, r->y, o->width, o->height, &from, &to)) {
			n->spread = vec_length(vec_sub(dir, to));
			n->width = vec_length(vec_sub(org, from));
		}
	}
}

/* Samples at the picture's far edges belong to its last pixels. */
static uint32_t pixel_at(double x, uint32_t size)
{
	return x >= size ? size - 1 : (uint32_t)x;
}

void wave_pixel(const struct worker *w, double x, double y, uint32_t pixel[2])
{
	pixel[0] = pixel_at(x, w->options->width);
	pixel[1] = pixel_at(y, w->options->height);
}

static void put_root(struct worker *w, struct node *n, const struct wave_root *r)
{
	static const struct node blank = { .weight = 1, .skip = ALD_NONE, .kind = NODE_CAMERA };
	const struct shader *sh = w->shader;

	*n = blank; /* copied, as clearing what is not named takes longer */
	n->key = r->key;
	n->path = r->path;
	n->inside = w->inside;
	wave_pixel(w, r->x, r->y, n->pixel);
	n->clear_sky = sh->alpha;
	if (!root_ray(w, r, n)) {
		n->nowhere = true;
		n->org = sh->scene->camera.location;
		n->dir = vec_make(0, 0, 1);
		return;
	}
	if (!camera_is_point(&sh->scene->camera))
		n->inside = shade_camera_inside(sh, &w->tree, n->org);
	if (sh->footprints)
		root_cone(w, r, n);
}

bool wave_push(struct worker *w, const struct wave_root *r)
{
	uint32_t i = tree_push(&w->tree, &w->tree.node, 1);

	if (i == TREE_NONE)
		return false;
	put_root(w, BUF_AT(&w->tree.node, struct node, i), r);
	return true;
}

/* Gathered rays keep their mask through mirrors and glass. */
static uint32_t node_mask(const struct node *n)
{
	if (n->bounce)
		return n->mirrored ? TRACE_GATHER_REFLECTED : TRACE_GATHER;
	return n->mirrored ? TRACE_REFLECTED : TRACE_CAMERA;
}

static void fill_ray(const struct worker *w, ald_ray *r, const struct node *n)
{
	static const enum trace_purpose purpose[] = { TRACE_FOR_CAMERA, TRACE_FOR_REFLECTED, TRACE_FOR_REFRACTED,
						      TRACE_FOR_GATHERED };

	r->org = n->org;
	r->dir = n->dir;
	r->tmin = 0;
	r->tmax = HUGE_VAL;
	r->mask = n->nowhere ? 0 : node_mask(n);
	r->skip = n->skip;
	r->after = r->after_sub[0] = r->after_sub[1] = ALD_NONE;
	if (w->shader->marks)
		trace_mark(r, n->pixel, purpose[n->kind]);
}

static void count_rays(struct worker *w, const struct node *n, bool hit)
{
	static const enum render_ray kind[] = { RENDER_CAMERA, RENDER_REFLECTED, RENDER_REFRACTED,
					       RENDER_GATHERED };

	w->counts.cast[kind[n->kind]]++;
	w->counts.hit[kind[n->kind]] += hit;
}

/* Nodes first .. first + n - 1, all the way to their children. */
static void follow_batch(struct worker *w, uint32_t first, uint32_t n, uint32_t hints)
{
	struct tree *t = &w->tree;
	struct shade_counts counts = { 0, 0, 0, 0 };
	ald_ray *ray;
	ald_hit *hit;

	t->ray.count = t->hit.count = 0;
	if (tree_push(t, &t->ray, n) == TREE_NONE || tree_push(t, &t->hit, n) == TREE_NONE)
		return;
	ray = t->ray.data;
	hit = t->hit.data;
	for (uint32_t i = 0; i < n; i++)
		fill_ray(w, &ray[i], BUF_AT(&t->node, struct node, first + i));
	trace_nearest(w->shader->geometry, w->thread, ray, hit, n, hints);

	tree_reset_wave(t);
	for (uint32_t i = 0; i < n; i++) {
		struct node *node = BUF_AT(&t->node, struct node, first + i);
		bool met = hit[i].prim != ALD_NONE;

		count_rays(w, node, met);
		node->length = met ? hit[i].t : HUGE_VAL;
		node->light_set = SCENE_NONE;
		if (!met)
			shade_sky(w->shader, node);
		else if (w->options->camera_only)
			node->colour = rgb_make(1, 1, 1);
		else
			shade_hit(w->shader, t, first + i, &ray[i], &hit[i]);
	}
	if (!t->no_memory)
		plain_light(w->shader, t, w->thread, hints & ALD_COHERENT, &counts);
	for (uint32_t i = 0; i < t->plain.count; i++) {
		const struct plain *p = BUF_AT(&t->plain, struct plain, i);

		BUF_AT(&t->node, struct node, p->to)->colour = p->colour;
	}
	if (t->met.count && !t->no_memory)
		shade_light(w->shader, t, w->thread, hints & ALD_COHERENT, &counts);
	if (t->met.count && !t->no_memory)
		shade_spawn(w->shader, t);
	if (t->beneath.count && !t->no_memory)
		shade_subsurface(w->shader, t, w->thread, &counts);
	if (w->shader->media && !w->options->camera_only && !t->no_memory)
		shade_media(w->shader, t, w->thread, first, n, &counts);
	if (w->shader->scene->rainbow_count && !w->options->camera_only && !t->no_memory)
		shade_rainbow(w->shader, t, first, n);
	if (w->shader->fog && !w->options->camera_only && !t->no_memory)
		shade_fog(w->shader, t, first, n);
	w->counts.cast[RENDER_SHADOW] += counts.shadow_cast;
	w->counts.hit[RENDER_SHADOW] += counts.shadow_hit;
	w->counts.cast[RENDER_SUBSURFACE] += counts.subsurface_cast;
	w->counts.hit[RENDER_SUBSURFACE] += counts.subsurface_hit;
}

/* Nodes that wait, and where the tree stood before the batch that asked for them. */
struct frame {
	uint32_t done, end; /* nodes done .. end - 1 are still to be followed */
	uint32_t batch, batched; /* the batch being followed: first node, how many */
	uint32_t node, part, mirror, inside, veil, gather, scatter; /* counts before it */
};

static bool push_frame(struct worker *w, uint32_t first, uint32_t end)
{
	uint32_t i = tree_push(&w->tree, &w->frame, 1);

	if (i == TREE_NONE)
		return false;
	*BUF_AT(&w->frame, struct frame, i) = (struct frame){ .done = first, .end = end };
	return true;
}

/* All that the batch asked for is known: fold it, and forget what stands behind it. */
static void finish_batch(struct worker *w, struct frame *f)
{
	struct tree *t = &w->tree;

	fold_nodes(w->shader, t, f->batch, f->batched);
	t->node.count = f->node;
	t->part.count = f->part;
	t->mirror.count = f->mirror;
	t->inside.count = f->inside;
	t->veil.count = f->veil;
	t->gather.count = f->gather;
	t->scatter.count = f->scatter;
	f->batched = 0;
}

/* As many as a plugin likes, but not so many that what they gather fills the memory. */
static uint32_t batch_size(const struct worker *w, const struct frame *f)
{
	const struct indirect *in = &w->shader->indirect;
	uint32_t most = f->end - f->done < BATCH ? f->end - f->done : BATCH, rays = 0, n;

	if (in->method == INDIRECT_OFF)
		return most;
	for (n = 0; n < most && rays < GATHER_BATCH; n++)
		rays += BUF_AT(&w->tree.node, struct node, f->done + n)->bounce ? 1 : in->samples;
	return n;
}

static bool next_batch(struct worker *w, struct frame *f, uint32_t hints)
{
	struct tree *t = &w->tree;
	uint32_t n = batch_size(w, f), before = t->node.count;

	f->batch = f->done;
	f->batched = n;
	f->done += n;
	f->node = before;
	f->part = t->part.count;
	f->mirror = t->mirror.count;
	f->inside = t->inside.count;
	f->veil = t->veil.count;
	f->gather = t->gather.count;
	f->scatter = t->scatter.count;
	follow_batch(w, f->batch, n, hints);
	if (t->no_memory)
		return false;
	if (t->node.count == before)
		finish_batch(w, f);
	else
		return push_frame(w, before, t->node.count); /* f is no longer valid */
	return true;
}

/* Depth first, a batch at a time, so that what is held grows with the depth of the trees and not with
 * their size. */
static bool follow(struct worker *w, uint32_t roots, uint32_t hints)
{
	w->frame.count = 0;
	if (!push_frame(w, 0, roots))
		return false;
	while (w->frame.count) {
		struct frame *f = BUF_AT(&w->frame, struct frame, w->frame.count - 1);

		if (f->batched)
			finish_batch(w, f); /* its children's frame was just popped */
		if (w->options->stop && w->options->stop(w->options->arg)) {
			w->stopped = true;
			return false;
		}
		if (f->done == f->end)
			w->frame.count--;
		else if (!next_batch(w, f, w->frame.count == 1 ? hints : 0))
			return false;
	}
	return true;
}

bool wave_begin(struct worker *w)
{
	const struct camera *c = &w->shader->scene->camera;

	tree_reset(&w->tree);
	w->frame.size = sizeof(struct frame);
	w->inside = camera_is_point(c) ? shade_camera_inside(w->shader, &w->tree, c->location) :
					 TREE_NONE;
	return !w->tree.no_memory;
}

bool wave_follow(struct worker *w, uint32_t roots)
{
	bool point = camera_is_point(&w->shader->scene->camera);

	if (!follow(w, roots, ALD_COHERENT | (point ? ALD_ONE_ORIGIN : 0)))
		return false;
	w->counts.samples += roots;
	return true;
}

void wave_take(const struct worker *w, uint32_t i, struct sample *s)
{
	const struct node *node = BUF_AT(&w->tree.node, struct node, i);

	s->colour = node->colour;
	s->variance = node->variance;
	s->transmit = node->transmit;
}

bool wave_trace(struct worker *w, uint32_t first, uint32_t n)
{
	struct tree *t = &w->tree;

	if (camera_has_lens(&w->shader->scene->camera))
		return lens_trace(w, first, n);
	if (w->shorts)
		return wave_trace_short(w, first, n);
	if (!wave_begin(w) || tree_push(t, &t->node, n) == TREE_NONE)
		return false;
	for (uint32_t i = 0; i < n; i++) {
		const struct sample *s = BUF_AT(&w->sample, struct sample, first + i);
		struct wave_root root = { .x = s->x, .y = s->y, .key = wave_seeded(w, wave_key(s)) };

		put_root(w, BUF_AT(&t->node, struct node, i), &root);
	}
	if (!wave_follow(w, n))
		return false;
	for (uint32_t i = 0; i < n; i++)
		wave_take(w, i, BUF_AT(&w->sample, struct sample, first + i));
	return true;
}
