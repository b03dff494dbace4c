/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * From a surface to where its texture is asked.
 */
#ifndef ALIDADE_SHADE_POV_POINT_H
#define ALIDADE_SHADE_POV_POINT_H

#include "accel/trace.h"
#include "pattern/footprint.h"
#include "pattern/pattern.h"

/* What a cone of this width covers of the surface it meets along dir, in *foot; at asks for it then. */
void texture_footprint(const struct geometry *, const ald_hit *, const struct surface *, double width,
		       struct pattern_point *at, struct footprint *foot);

/* place: the texture's coordinates to the world. n: turned to the ray, which goes along dir. */
static inline struct pattern_point texture_point(const struct surface *s, const struct xform *place, vec n, vec dir)
{
	return (struct pattern_point){ .p = place ? mat_point(&place->inv, s->p) : s->p,
				       .world = s->p,
				       .u = s->u,
				       .v = s->v,
				       .n = n,
				       .dir = dir,
				       .place = place };
}

#endif
