/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What rays.c races over: meshes, where they are looked at from, and rays of five kinds. All numbers of meshes and
 * rays are floats, so that those who calculate in floats answer the same question.
 */
#ifndef TESTS_BENCH_WORLDS_H
#define TESTS_BENCH_WORLDS_H

#include "../unit/rays.h"
#include "forest.h"

enum { CAMERA, SHADOW, BOUNCE, SHUFFLED, AO, KINDS };
enum { BATCH = 1024 }; /* rays that are handed over in one call */
extern const char *const kind_name[KINDS];
extern const uint32_t kind_hints[KINDS]; /* ALD_COHERENT ... */
static inline bool kind_any(unsigned k)
{
	return k == SHADOW || k == AO;
}

struct world {
	char name[40];
	struct mesh mesh; /* of a forest one tree */
	struct forest *forest; /* NULL: the mesh is all there is */
	ald_vec centre; /* of all, and how far from it that goes */
	double radius;
	ald_vec eye, at, light;
	double wide; /* of the picture, at distance 1, half */
	double share; /* of the rays asked for: 1, or less where rays are slow */
};

extern const char worlds_usual[], worlds_all[]; /* names, with commas */

/* exits where it can't; false: there is no such name. */
bool world_make(struct world *, const char *name);
uint32_t world_triangles(const struct world *); /* each instance's counted */
void world_release(struct world *);

struct shots {
	ald_ray *ray[KINDS];
	uint32_t n[KINDS];
};

/* Camera rays, 32 x 32 pixels after another in blocks of 4 x 4; width: a multiple of 128. */
void shots_camera(struct shots *, const struct world *, uint32_t width);
/* What starts where these have hit; of a forest this is one that was built. */
void shots_second(struct shots *, const struct world *, const struct geometry *, const ald_hit *hit);
void shots_release(struct shots *);

#endif
