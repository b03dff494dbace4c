/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A small scene and its geometry, for tests; includes cmocka.
 */
#ifndef ALIDADE_TESTS_WORLD_FIXTURE_H
#define ALIDADE_TESTS_WORLD_FIXTURE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "accel/trace.h"
#include "alidade/kernel.h"
#include "base/pool.h"

struct world {
	struct mem_book book;
	struct scene scene;
	struct diag diag;
	struct pool *pool;
	struct geometry *g;
};

static inline void begin(struct world *w)
{
	memset(w, 0, sizeof(*w));
	mem_book_init(&w->book, 0);
	scene_init(&w->scene, &w->book);
	w->pool = pool_new(1);
	assert_non_null(w->pool);
}

static inline void build(struct world *w)
{
	assert_int_equal(geometry_build(&w->g, &w->scene, NULL, w->pool, &w->book, true, &w->diag),
			 STATUS_OK);
}

static inline void end(struct world *w)
{
	geometry_free(w->g);
	scene_release(&w->scene);
	pool_free(w->pool);
	assert_int_equal(w->book.now, 0);
}

static inline struct object *add(struct world *w, enum shape_kind kind)
{
	uint32_t i = scene_add_object(&w->scene);

	assert_true(i != SCENE_NONE);
	scene_add_root(&w->scene, i);
	w->scene.object[i].kind = kind;
	return &w->scene.object[i];
}

static inline struct object *add_sphere(struct world *w, vec c, double r)
{
	struct object *o = add(w, SHAPE_SPHERE);

	o->shape.sphere.centre = c;
	o->shape.sphere.radius = r;
	return o;
}

static inline ald_ray ray(vec o, vec d)
{
	return (ald_ray){ .org = o, .dir = d, .tmax = ALD_INF, .mask = ~0u, .skip = ALD_NONE,
			  .after = ALD_NONE, .after_sub = { ALD_NONE, ALD_NONE } };
}

static inline ald_hit nearest(struct world *w, const ald_ray *r)
{
	ald_hit h;

	trace_nearest(w->g, 0, r, &h, 1, 0);
	return h;
}

/* xorshift64*: the same numbers everywhere. */
static inline double uniform(uint64_t *state)
{
	uint64_t x = *state;

	x ^= x >> 12;
	x ^= x << 25;
	x ^= x >> 27;
	*state = x;
	return (double)((x * 2685821657736338717u) >> 11) * 0x1p-53;
}

static inline double signed_uniform(uint64_t *state)
{
	return 2 * uniform(state) - 1;
}

static inline vec random_vec(uint64_t *state)
{
	double x = signed_uniform(state), y = signed_uniform(state);

	return vec_make(x, y, signed_uniform(state));
}

/* Not evenly spread, but everywhere. */
static inline vec random_unit(uint64_t *state)
{
	vec v = random_vec(state);

	while (vec_dot(v, v) < 0.01)
		v = random_vec(state);
	return vec_unit(v);
}

#endif
