/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Rays made to be hard for a mesh. What is made is what counts: directions are rounded differences.
 */
#ifndef ALIDADE_TESTS_COURSE_H
#define ALIDADE_TESTS_COURSE_H

#include "trial.h"

struct course { /* rays over one placed soup */
	const struct soup *soup;
	vec centre;
	double radius;
	bool floats, inside;
	int ulps; /* b: off the plane */
	uint64_t seed;
};

/* v as the course keeps numbers: rounded to floats, or not. */
vec kept_vec(const struct course *, vec v);
void ray_start(ald_ray *); /* all but origin and direction */

/* All are trial_ray functions; arg is a course. */
void ray_aimed(void *arg, uint32_t i, ald_ray *); /* at vertices, edges and their middles */
void ray_ordinary(void *arg, uint32_t i, ald_ray *);
void ray_mixed(void *arg, uint32_t i, ald_ray *); /* aimed and ordinary, from inside and outside */
/* In the plane of a face of the box, or some ulps off it, towards the box; ulps count outwards. */
void ray_in_plane(void *arg, uint32_t i, ald_ray *);
/* To a point of a face, at 1e-7 to 1e-3 radians to it. */
void ray_grazing(void *arg, uint32_t i, ald_ray *);
/* Through a vertex, with one or two components of the direction +-0. */
void ray_axis(void *arg, uint32_t i, ald_ray *);

#endif
