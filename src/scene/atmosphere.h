/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What surrounds a scene (POV-Ray's manual 3.4.3).
 */
#ifndef ALIDADE_SCENE_ATMOSPHERE_H
#define ALIDADE_SCENE_ATMOSPHERE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/colour.h"
#include "base/vec.h"

/* Fills the world, outside of what is not hollow. */
struct fog {
	bool ground; /* fog_type 2: thins out above offset, to a half at alt above it */
	double distance; /* not 0 */
	struct rgbft colour; /* transmit: what is always let through */
	vec up; /* unit; ground */
	double offset, alt; /* alt is not 0; ground */
	vec turbulence; /* 0: none */
	double turb_depth, lambda, omega;
	uint32_t octaves;
};

struct map_entry;

/* Bows around a direction, seen before what rays meet. Angles in radians. */
struct rainbow {
	double angle, width; /* of the bow's middle from the direction; from edge to edge, more than 0 */
	double distance; /* not 0: how far away 1 - 1/e of it stands before what is seen */
	double arc, falloff; /* halves: up to here from up it is there; from here on it fades */
	vec direction, up, right; /* unit, square */
	uint32_t count;
	struct map_entry *entry; /* colours, from the inner edge to the outer; in the arena */
};

struct pigment;

/* Around everything, infinitely far away. Its pigments are looked up by a ray's unit direction. */
struct sky_sphere {
	uint32_t count;
	struct pigment **pigment; /* the last one is on top */
	struct rgb emission;
	struct xform place;
};

#endif
