/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The picture is looked at on ever finer grids. What the cache cannot answer becomes a record, but only once
 * the grid is through: all of a grid's places ask the same cache, so neither threads nor the order of
 * work can be seen in it. Always the whole picture is gone over, so that a crop is a part of it.
 */
#include "render/fill.h"

#include <stdatomic.h>
#include <string.h>

#define FINEST 2 /* pixels between places, without slack */
#define SIDE 4 /* places of a tile, a side: they gather rays by the hundred */

struct fill {
	struct worker *worker;
	uint32_t step, across;
	atomic_bool failed;
};

static bool push_places(struct worker *w, uint32_t left, uint32_t top, uint32_t step, uint32_t *n)
{
	const struct render_options *o = w->options;

	*n = 0;
	for (uint32_t y = 0; y < SIDE; y++) {
		for (uint32_t x = 0; x < SIDE; x++) {
			struct sample s = { .x = (double)(left + x * step + step / 2) + 0.5,
					    .y = (double)(top + y * step + step / 2) + 0.5 };
			struct wave_root root = { .x = s.x, .y = s.y, .key = wave_seeded(w, wave_key(&s)) };

			if (s.x > o->width || s.y > o->height)
				continue;
			if (!wave_push(w, &root))
				return false;
			++*n;
		}
	}
	return true;
}

static void fill_tile(void *arg, uint32_t i, uint32_t thread)
{
	struct fill *f = arg;
	struct worker *w = &f->worker[thread];
	uint32_t side = SIDE * f->step, n;

	if (atomic_load(&f->failed))
		return;
	if (!wave_begin(w) || !push_places(w, i % f->across * side, i / f->across * side, f->step, &n) ||
	    !wave_follow(w, n))
		atomic_store(&f->failed, true);
}

/* All workers' new records into the cache. */
static bool collect(struct cache *c, struct worker *w, uint32_t threads)
{
	struct buf *all = &w[0].tree.record;
	bool good;

	for (uint32_t i = 1; i < threads; i++) {
		struct buf *b = &w[i].tree.record;
		uint32_t first = all->count;

		if (b->count && tree_push(&w[0].tree, all, b->count) == TREE_NONE)
			return false;
		if (b->count)
			memcpy(BUF_AT(all, struct cache_record, first), b->data, b->count * b->size);
		b->count = 0;
	}
	good = cache_add(c, all->data, all->count);
	all->count = 0;
	return good;
}

/* A power of two, at most n. */
static uint32_t pixels(double n)
{
	uint32_t i = 1;

	while (2 * i <= n)
		i *= 2;
	return i;
}

bool fill_cache(struct cache *c, struct shader *sh, struct worker *w, struct pool *pool)
{
	const struct render_options *o = w->options;
	struct fill f = { .worker = w };
	uint32_t first = pixels(sh->indirect.reach), last = pixels(FINEST * sh->indirect.slack);

	sh->indirect.cache = c;
	sh->indirect.filling = true;
	for (f.step = first; f.step >= last; f.step /= 2) {
		uint32_t side = SIDE * f.step, down = (o->height + side - 1) / side;

		f.across = (o->width + side - 1) / side;
		pool_run(pool, f.across * down, fill_tile, &f);
		if (atomic_load(&f.failed) || !collect(c, w, pool_threads(pool)))
			return false;
	}
	sh->indirect.filling = false;
	return true;
}
