/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Camera rays (POV-Ray's manual 3.4.2; a pixel's centre is at a half).
 */
#ifndef ALIDADE_SHADE_CAMERA_H
#define ALIDADE_SHADE_CAMERA_H

#include "base/wide.h"
#include "scene/scene.h"

/* The ray through (x, y) of a width x height picture, in pixels from its top left corner; *dir is unit.
 * False: there is none (outside a fisheye's circle; or the camera's direction has no length). */
bool camera_ray(const struct camera *, double x, double y, double width, double height, vec *org,
		vec *dir);

/* The same through eight places. */
struct camera_rays {
	double org[3][LANES], dir[3][LANES];
	double there[LANES]; /* 0: there is none */
};
void camera_rays(const struct camera *, const double *x, const double *y, double width, double height,
		 struct camera_rays *);

/* A camera's normal { } bends the ray through (x, y). */
void camera_bend(const struct scene *, double x, double y, double width, double height, vec *dir);

/* The same through a point of the lens, -1..1 across and up within the unit circle. */
bool camera_lens_ray(const struct camera *, double x, double y, double width, double height,
		     double lens_x, double lens_y, vec *org, vec *dir);

static inline bool camera_has_lens(const struct camera *c)
{
	return c->aperture != 0;
}

/* All its rays start in one point. */
static inline bool camera_is_point(const struct camera *c)
{
	return c->kind != CAMERA_ORTHOGRAPHIC && c->kind != CAMERA_CYLINDER_3 &&
	       c->kind != CAMERA_CYLINDER_4 && !camera_has_lens(c);
}

#endif
