/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A world of instances: one tree, ten thousand times. Accelerators get it as the renderer does, from a scene, and
 * answer through accel/trace.h, with what the host does for instances (and not through that header: the struct mesh of
 * scenes is not that of tests).
 */
#ifndef TESTS_BENCH_FOREST_H
#define TESTS_BENCH_FOREST_H

#include "accel/load.h"
#include "base/mem.h"
#include "base/pool.h"

enum { TREES = 10000 };

struct forest;
struct geometry;
struct mesh;

void forest_tree(struct mesh *); /* 10,000 triangles, 2.2 high. In tree.c */
struct forest *forest_plant(void); /* where each of them stands */
const float (*forest_places(const struct forest *))[12]; /* images of the three axes, then of the origin */
bool forest_read(struct forest *, const ald_prims *tree, uint32_t vertices); /* as a scene; false: told why not */
void forest_free(struct forest *); /* NULL is harmless */

struct geometry *forest_build(const struct forest *, const struct accel_choice *, struct pool *, struct mem_book *);
void forest_unbuild(struct geometry *); /* NULL is harmless */
double forest_bytes(const struct geometry *); /* of the accelerator */
void forest_nearest(const struct geometry *, uint32_t thread, const ald_ray *, ald_hit *, uint32_t n, uint32_t hints);
void forest_occluded(const struct geometry *, uint32_t thread, const ald_ray *, uint8_t *hidden, uint32_t n,
		     uint32_t hints);
ald_vec forest_normal(const struct geometry *, const ald_ray *, const ald_hit *); /* either side's */

#endif
