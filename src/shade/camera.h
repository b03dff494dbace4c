/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Camera rays (POV-Ray's manual 3.4.2; a pixel's centre is at a half).
 */
#ifndef ALIDADE_SHADE_CAMERA_H
#define ALIDADE_SHADE_CAMERA_H

#include "scene/scene.h"

/* The ray through (x, y) of a width x height picture, in pixels from its top left corner; *dir is unit.
 * False: there is none (the camera's direction has no length). */
bool camera_ray(const struct camera *, double x, double y, double width, double height, vec *org,
		vec *dir);

#endif
