/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Interiors: refraction indices and fading (manual 3.4.8).
 */
#ifndef ALIDADE_SHADE_POV_INTERIOR_H
#define ALIDADE_SHADE_POV_INTERIOR_H

#include "shade/shade.h"

double interior_ior(const struct scene *, uint32_t interior); /* 1 for SCENE_NONE */
/* What is left of light after distance through an interior (SCENE_NONE: all of it). */
struct rgb interior_fade(const struct scene *, uint32_t interior, double distance);
/* Index of the far side of a surface relative to the near one, for fresnel. */
double interior_relative_ior(const struct scene *, const struct tree *, uint32_t list, uint32_t object,
			     uint32_t interior);
/* Go through the surface: *list becomes what the ray is then in; the ratio of indices, near to far. */
double interior_cross(const struct scene *, struct tree *, uint32_t *list, const struct met *);

#endif
