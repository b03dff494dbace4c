/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What a ray's cone covers of a texture.
 */
#include "shade/pov/point.h"

#include <math.h>

#define FLATTEST 1e-3 /* the cosine from which on a grazing cone's trace grows no longer */

void texture_footprint(const struct geometry *g, const ald_hit *hit, const struct surface *s, double width,
		       struct pattern_point *at, struct footprint *foot)
{
	double cosine = fabs(vec_dot(at->n, at->dir));
	vec along = vec_mad(at->dir, at->n, -vec_dot(at->dir, at->n));

	if (!(vec_dot(along, along) > 1e-12)) /* straight on: any direction will do */
		along = vec_cross(at->n, fabs(at->n.x) < 0.5 ? vec_make(1, 0, 0) : vec_make(0, 1, 0));
	along = vec_unit(along);
	foot->axis[0] = vec_scale(along, width / fmax(cosine, FLATTEST));
	foot->axis[1] = vec_scale(vec_cross(at->n, along), width);
	for (int i = 0; i < 2; i++) {
		surface_uv_along(g, hit, s, foot->axis[i], &foot->u[i], &foot->v[i]);
		if (at->place)
			foot->axis[i] = mat_dir(&at->place->inv, foot->axis[i]);
	}
	at->foot = foot;
}
