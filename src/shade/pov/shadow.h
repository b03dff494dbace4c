/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Shadow rays: what arrives of a light's colour.
 */
#ifndef ALIDADE_SHADE_POV_SHADOW_H
#define ALIDADE_SHADE_POV_SHADOW_H

#include "shade/shade.h"

/* Answer tree.shadow[first ..]: each colour is multiplied by what lets it through. hints: how they lie. */
void shadow_trace(const struct shader *, struct tree *, uint32_t thread, uint32_t first, uint32_t hints,
		  struct shade_counts *);

/* Light that POV-Ray takes for none. */
#define SHADOW_DARK 1e-10

static inline bool shadow_dark(struct rgb c)
{
	return fabs(c.r) < SHADOW_DARK && fabs(c.g) < SHADOW_DARK && fabs(c.b) < SHADOW_DARK;
}

/* The start of a ray from p on a surface towards dir: off it by its error bound, on dir's side. */
static inline vec shadow_origin(vec p, vec n, double error, vec dir)
{
	return vec_mad(p, n, vec_dot(n, dir) < 0 ? -error : error);
}

/* A lamp that lies in a surface is not hidden by it: the ray ends before the light by more than what
 * rounding does to coordinates of this size, unless the light grazes. */
static inline double shadow_depth(vec p, double depth)
{
	double x = fabs(p.x), y = fabs(p.y), z = fabs(p.z), yz = y > z ? y : z;
	double size = (x > yz ? x : yz) + depth;

	return depth - 0x1p-40 * size;
}

#endif
