/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A tile's camera rays -> hits -> light (shadow rays) -> what mirrors and glass ask for -> hits ...
 *
 * A wave is followed in batches of about a thousand rays, the main road of the plugin contract. Where
 * trees grow large (many mirrors, much glass), the samples are taken in smaller groups: each sample's
 * colour depends on its own tree alone, so grouping changes nothing.
 */
#include "render/wave.h"

#include <string.h>

#include "base/rng.h"
#include "render/fold.h"
#include "shade/camera.h"

#define BATCH 1024
#define NODES_MAX (256 * 1024) /* of a group, before it is split */

static uint64_t sample_key(const struct sample *s)
{
	uint64_t x, y;

	memcpy(&x, &s->x, sizeof(x));
	memcpy(&y, &s->y, sizeof(y));
	return rng_mix(rng_mix(x) + y);
}

/* The root of sample s. */
static bool push_camera(struct worker *w, const struct sample *s)
{
	struct tree *t = &w->tree;
	const struct scene *scene = w->shader->scene;
	uint32_t i = tree_push(t, &t->node, 1);
	struct node n = { .weight = 1,
			  .key = sample_key(s),
			  .skip = ALD_NONE,
			  .kind = NODE_CAMERA,
			  .clear_sky = w->shader->alpha,
			  .inside = w->inside };

	if (i == TREE_NONE)
		return false;
	if (!camera_ray(&scene->camera, s->x, s->y, w->options->width, w->options->height, &n.org,
			&n.dir))
		n.dir = vec_make(0, 0, 0); /* hits nothing */
	if (scene->camera.kind != CAMERA_PERSPECTIVE)
		n.inside = shade_camera_inside(w->shader, t, n.org);
	*BUF_AT(&t->node, struct node, i) = n;
	return true;
}

static void fill_ray(ald_ray *r, const struct node *n)
{
	*r = (ald_ray){ .org = n->org,
			.dir = n->dir,
			.tmin = 0,
			.tmax = HUGE_VAL,
			.mask = n->mirrored ? TRACE_REFLECTED : TRACE_CAMERA,
			.skip = n->skip,
			.after = ALD_NONE,
			.after_sub = { ALD_NONE, ALD_NONE } };
}

static void count_rays(struct worker *w, const struct node *n, bool hit)
{
	static const enum render_ray kind[] = { RENDER_CAMERA, RENDER_REFLECTED, RENDER_REFRACTED };

	w->counts.cast[kind[n->kind]]++;
	w->counts.hit[kind[n->kind]] += hit;
}

/* Nodes first .. first + n - 1, all the way to their children. */
static void follow_batch(struct worker *w, uint32_t first, uint32_t n, uint32_t hints)
{
	struct tree *t = &w->tree;
	struct shade_counts counts = { 0, 0 };
	ald_ray *ray;
	ald_hit *hit;

	t->ray.count = t->hit.count = 0;
	if (tree_push(t, &t->ray, n) == TREE_NONE || tree_push(t, &t->hit, n) == TREE_NONE)
		return;
	ray = t->ray.data;
	hit = t->hit.data;
	for (uint32_t i = 0; i < n; i++)
		fill_ray(&ray[i], BUF_AT(&t->node, struct node, first + i));
	trace_nearest(w->shader->geometry, w->thread, ray, hit, n, hints);

	tree_reset_wave(t);
	for (uint32_t i = 0; i < n; i++) {
		struct node *node = BUF_AT(&t->node, struct node, first + i);
		bool met = hit[i].prim != ALD_NONE;

		count_rays(w, node, met);
		if (!met)
			shade_sky(w->shader, node);
		else if (w->options->camera_only)
			node->colour = rgb_make(1, 1, 1);
		else
			shade_hit(w->shader, t, first + i, &ray[i], &hit[i]);
	}
	if (t->met.count && !t->no_memory)
		shade_light(w->shader, t, w->thread, &counts);
	if (t->met.count && !t->no_memory)
		shade_spawn(w->shader, t);
	w->counts.cast[RENDER_SHADOW] += counts.shadow_cast;
	w->counts.hit[RENDER_SHADOW] += counts.shadow_hit;
}

/* The whole tree of a group of samples. False: it grew too large (nothing is lost but time). */
static bool follow_group(struct worker *w, uint32_t first, uint32_t n)
{
	const struct scene *scene = w->shader->scene;
	struct tree *t = &w->tree;
	uint32_t done = 0;

	tree_reset(t);
	w->inside = TREE_NONE;
	if (scene->camera.kind == CAMERA_PERSPECTIVE)
		w->inside = shade_camera_inside(w->shader, t, scene->camera.location);
	for (uint32_t i = 0; i < n; i++) {
		if (!push_camera(w, BUF_AT(&w->sample, struct sample, first + i)))
			return true;
	}
	while (done < t->node.count && !t->no_memory) {
		uint32_t m = t->node.count - done;
		uint32_t hints = done < n ? ALD_COHERENT : 0;

		if (!done && scene->camera.kind == CAMERA_PERSPECTIVE)
			hints |= ALD_ONE_ORIGIN;
		if (done < n && m > n - done)
			m = n - done; /* camera rays by themselves */
		m = m < BATCH ? m : BATCH;
		follow_batch(w, done, m, hints);
		done += m;
		if (n > 1 && t->node.count > NODES_MAX)
			return false;
	}
	return true;
}

static void collect(struct worker *w, uint32_t first, uint32_t n)
{
	fold_tree(&w->tree);
	for (uint32_t i = 0; i < n; i++) {
		struct sample *s = BUF_AT(&w->sample, struct sample, first + i);
		const struct node *node = BUF_AT(&w->tree.node, struct node, i);

		s->colour = node->colour;
		s->transmit = node->transmit;
	}
}

bool wave_trace(struct worker *w, uint32_t first, uint32_t n)
{
	uint32_t group = n, end = first + n;

	while (first < end && !w->tree.no_memory) {
		uint32_t m = end - first < group ? end - first : group;
		struct render_counts before = w->counts;

		if (!follow_group(w, first, m)) {
			w->counts = before; /* traced again in halves, counted once */
			group = (m + 1) / 2;
			continue;
		}
		if (w->tree.no_memory)
			break;
		w->counts.samples += m;
		collect(w, first, m);
		first += m;
	}
	return !w->tree.no_memory;
}
