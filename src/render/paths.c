/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The key of a set decides its sequences: one of four dimensions for pixel and lens, and each random decision after
 * that has its own, made from the set's key and from where in the tree of rays it is. All are asked for the point
 * with the sample's number (node.path). Their orders are shuffled independently, so that together they are as
 * good as one sequence of many dimensions would be (Burley, JCGT 9(4), 2020).
 */
#include "render/paths.h"

#include "base/sobol.h"
#include "render/lens.h"
#include "shade/camera.h"

#define HELD 16384 /* rays at a time */
#define TREE_KEY 0x700000000u /* of a set's random numbers: the key of all below its camera rays */

/* Where in the runs the rays that are asked for now begin, and end. */
struct cursor {
	uint32_t run, sample;
};

static uint64_t set_key(const struct path_run *r)
{
	struct sample centre = { .x = r->x + 0.5, .y = r->y + 0.5 };

	return rng_child(wave_key(&centre), r->set);
}

/* Sobol's first two dimensions are its best: they go to the lens where there is one, as blur is wide. */
static struct wave_root root_at(const struct path_run *r, uint64_t key, const struct sobol *s, uint32_t i, bool lens)
{
	struct wave_root root = { .key = rng_child(key, TREE_KEY), .path = i };

	root.x = r->x + sobol_at(s, i, lens ? 2 : 0);
	root.y = r->y + sobol_at(s, i, lens ? 3 : 1);
	if (lens)
		lens_disc(sobol_at(s, i, 0), sobol_at(s, i, 1), &root.lens_x, &root.lens_y);
	return root;
}

/* From *at on as many as are held at a time; *at becomes where the next ones begin. */
static bool push_rays(struct worker *w, const struct path_run *run, uint32_t n, struct cursor *at, uint32_t *rays)
{
	bool lens = camera_has_lens(&w->shader->scene->camera);

	*rays = 0;
	while (at->run < n && *rays < HELD) {
		const struct path_run *r = &run[at->run];
		uint64_t key = wave_seeded(w, set_key(r));
		struct sobol s = sobol_make(key);

		for (; at->sample < r->count && *rays < HELD; at->sample++, ++*rays) {
			struct wave_root root = root_at(r, key, &s, r->first + at->sample, lens);

			if (!wave_push(w, &root))
				return false;
		}
		if (at->sample == r->count)
			*at = (struct cursor){ at->run + 1, 0 };
	}
	return true;
}

static void add(struct path_run *r, const struct node *n)
{
	if (!isfinite(n->colour.r) || !isfinite(n->colour.g) || !isfinite(n->colour.b) || !isfinite(n->transmit)) {
		r->finite = false;
		return;
	}
	r->sum = rgb_add(r->sum, n->colour);
	r->transmit += n->transmit;
}

bool paths_trace(struct worker *w, struct path_run *run, uint32_t n)
{
	struct cursor at = { 0, 0 }, from = { 0, 0 };

	for (uint32_t i = 0; i < n; i++) {
		run[i].sum = rgb_make(0, 0, 0);
		run[i].transmit = 0;
		run[i].finite = true;
	}
	while (at.run < n) {
		uint32_t rays;

		if (!wave_begin(w) || !push_rays(w, run, n, &at, &rays) || !wave_follow(w, rays))
			return false;
		for (uint32_t i = 0; i < rays; i++) {
			while (from.sample == run[from.run].count)
				from = (struct cursor){ from.run + 1, 0 };
			add(&run[from.run], BUF_AT(&w->tree.node, struct node, i));
			from.sample++;
		}
	}
	return true;
}
