/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What tests of accelerators stand on: a host without a renderer, meshes, and rays out to find the spots
 * where two accelerators might disagree.
 */
#ifndef TESTS_UNIT_RAYS_H
#define TESTS_UNIT_RAYS_H

#include <stdbool.h>

#include "alidade/accel.h"
#include "alidade/kernel.h"
#include "base/mem.h"
#include "base/pool.h"

struct ball { /* a primitive that is no triangle */
	ald_vec centre;
	double radius;
};

struct mesh {
	ald_prims prims; /* first: the callbacks get a pointer to it */
	ald_frame frame;
	ald_vec *vertex;
	float *vertex_float; /* NULL: prims.vertex is in double */
	uint32_t *index, *mask, *group_first;
	ald_vec *origin;
	struct ball *ball; /* primitive tri_count + i is ball[i] */
	uint32_t vertices, vertex_room, index_room, groups, balls;
};

/* All start with an empty mesh ({ 0 }) and add to it; each call begins a new group. */
void mesh_torus(struct mesh *, ald_vec centre, double big, double small, uint32_t around, uint32_t across);
void mesh_field(struct mesh *, uint32_t n, double size, double height, uint64_t seed);
void mesh_soup(struct mesh *, uint32_t n, double size, double edge, uint64_t seed);
void mesh_sheets(struct mesh *, uint32_t n, uint32_t sheets, double gap); /* axis-aligned, in z */
void mesh_balls(struct mesh *, uint32_t n, double radius, uint64_t seed);
/* By hand: a new group, then its vertices (each returns its number) and triangles. */
void mesh_group(struct mesh *);
uint32_t mesh_vertex(struct mesh *, double x, double y, double z);
void mesh_triangle(struct mesh *, uint32_t a, uint32_t b, uint32_t c);
/* After the last: fills prims. exact: ALD_PRECISION_EXACT. */
void mesh_finish(struct mesh *, bool as_float, bool with_mask, bool exact);
/* In exact order: what the host does once the plugin has found a hit. */
void mesh_settle(const struct mesh *, const ald_ray *, ald_hit *);
void mesh_release(struct mesh *);

struct test_host {
	ald_host host;
	struct mem_book book;
	struct pool *pool;
	double cancel_at; /* progress() asks to stop from here on; above 1: never */
};

void test_host_init(struct test_host *, uint32_t threads, uint64_t limit);
void test_host_release(struct test_host *);

uint64_t random_next(uint64_t *state);
double random_unit(uint64_t *state); /* [0, 1) */

/* Ray number i of a set that depends on the seed only: two thirds of them hostile. */
void ray_make(const struct mesh *, uint64_t seed, uint32_t i, ald_ray *);

#endif
