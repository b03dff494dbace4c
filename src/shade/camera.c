/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "shade/camera.h"

bool camera_ray(const struct camera *c, double x, double y, double width, double height, vec *org,
		vec *dir)
{
	double u = x / width - 0.5, v = 0.5 - y / height;
	vec side = vec_add(vec_scale(c->right, u), vec_scale(c->up, v));
	double length;

	*org = c->location;
	*dir = c->direction;
	if (c->kind == CAMERA_ORTHOGRAPHIC)
		*org = vec_add(*org, side);
	else
		*dir = vec_add(*dir, side);
	length = vec_length(*dir);
	if (!(length > 0) || !isfinite(length) || !vec_finite(*org))
		return false;
	*dir = vec_scale(*dir, 1 / length);
	return true;
}
