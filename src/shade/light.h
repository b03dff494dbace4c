/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Lights: the direction and strength of their light at a point, and the grid of an area light.
 */
#ifndef ALIDADE_SHADE_LIGHT_H
#define ALIDADE_SHADE_LIGHT_H

#include "scene/scene.h"

/* From a point towards a light. */
struct light_ray {
	vec dir; /* unit */
	double depth; /* how far shadows matter: to the light, or to its plane if it is parallel */
};

/* shift moves the light (a point of an area light's grid). */
struct light_ray light_towards(const struct light *, vec p, vec shift);

/* The factor of spot cone, cylinder and fading (manual 3.4.4.2, .3, .8). */
double light_attenuation(const struct light *, vec p, const struct light_ray *);

/* The axes of the grid as seen from p: the light's own, or with orient turned to face p. */
void light_axes(const struct light *, vec p, vec *axis1, vec *axis2);

/* Where grid point (u, v) lies from the centre. key: what jitter is drawn from; each round of the same key
 * has its own, and together they cover the cell evenly. */
vec light_grid_point(const struct light *, vec axis1, vec axis2, uint32_t u, uint32_t v, uint64_t key,
		     uint32_t round);

/* The stretch of a ray, at most length of it, that lies in the light's cone or beam; all of it for other kinds.
 * False: none of it does. dir is unit. */
bool light_reach(const struct light *, vec org, vec dir, double length, double *from, double *to);

#endif
