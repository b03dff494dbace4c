/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Patterns over space: what colour, normal or texture stands at a point (POV-Ray's manual 3.4.7).
 *
 * Pure functions of the scene and the point: no allocation, any thread.
 */
#ifndef ALIDADE_PATTERN_PATTERN_H
#define ALIDADE_PATTERN_PATTERN_H

#include "scene/scene.h"

/* Where a texture is looked up. */
struct pattern_point {
	vec p; /* in the texture's coordinates: the object's texture_place is undone */
	vec world; /* the same place in the world */
	double u, v; /* the surface's own; 0 unless the scene asks for them */
	vec n; /* unit normal, turned to the ray, in the world (slope, aoi) */
	vec dir; /* of the ray, unit, in the world (aoi) */
	const struct xform *place; /* texture to world; NULL: the same */
	bool within; /* place has the transforms of a pattern of textures around this one */
	const struct footprint *foot; /* how much around the point counts (footprint.h); NULL: nothing */
};

/* The value of a pattern at a point, warps, frequency and wave included. For blocks: an entry's number.
 * Not for PATTERN_AVERAGE and what brings its own colours. */
double pattern_value(const struct scene *, const struct pattern *, const struct pattern_point *);
/* The same where the warps have been gone through already. */
double pattern_value_warped(const struct scene *, const struct pattern *, const struct pattern_point *);
/* The point behind the pattern's warps. */
vec pattern_warp(const struct pattern *, vec p);

struct rgbft pigment_at(const struct scene *, const struct pigment *, const struct pattern_point *);

/* n (unit, in the world, turned to the ray) bent; unit. */
vec normal_at(const struct scene *, const struct normal *, const struct pattern_point *, vec n);

/* The textures of layers that make up a texture at a point, each with its share; and where it is asked. */
typedef void texture_visitor(void *self, const struct texture *, const struct pattern_point *, double share);
void texture_visit(const struct scene *, const struct texture *, const struct pattern_point *, double share,
		   texture_visitor *, void *self);

/* Between which two entries of a map a value lies: value = (1 - *t) entry a + *t entry b. */
void map_find(const struct map *, double value, uint32_t *a, uint32_t *b, double *t);

/* Can it be evaluated: as a value or colour; as a normal. */
bool pattern_known(enum pattern_kind);
bool pattern_known_slope(enum pattern_kind);
/* The colours of a pattern for which none were given. */
const struct map *pattern_default_map(enum pattern_kind);
const struct map *pattern_own_map(const struct pattern *);

#endif
