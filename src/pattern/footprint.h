/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * How much of a texture a ray's pixel covers: the two axes of an ellipse, led through warps with the point in
 * its middle, as differences (Igehy, Tracing Ray Differentials, 1999, but from a cone and not a beam).
 */
#ifndef ALIDADE_PATTERN_FOOTPRINT_H
#define ALIDADE_PATTERN_FOOTPRINT_H

#include "pattern/pattern.h"

struct footprint {
	vec axis[2]; /* whole, in the coordinates of the point */
	double u[2], v[2]; /* what the surface's own coordinates change by along them */
};

/* The footprint behind a pattern's warps, in *room; NULL: there is none. uv: asked at (u, v, 0). */
static inline const struct footprint *footprint_within(const struct pattern *q, bool uv,
						       const struct pattern_point *at, struct footprint *room)
{
	vec p = uv ? vec_make(at->u, at->v, 0) : at->p, middle;

	if (!at->foot)
		return NULL;
	*room = *at->foot;
	middle = pattern_warp(q, p);
	for (int i = 0; i < 2; i++) {
		vec axis = uv ? vec_make(room->u[i], room->v[i], 0) : room->axis[i];

		room->axis[i] = vec_sub(pattern_warp(q, vec_add(p, axis)), middle);
	}
	return room;
}

/* The same where there is no pattern but the change to (u, v, 0). */
static inline const struct footprint *footprint_at_uv(const struct pattern_point *at, struct footprint *room)
{
	if (!at->foot)
		return NULL;
	*room = *at->foot;
	for (int i = 0; i < 2; i++)
		room->axis[i] = vec_make(room->u[i], room->v[i], 0);
	return room;
}

#endif
