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
/* The same for what casts shadows. */
struct rgb interior_shadow_fade(const struct scene *, uint32_t interior, double distance);
/* Index of the far side of a surface relative to the near one, for fresnel. */
double interior_relative_ior(const struct scene *, const struct tree *, uint32_t list, uint32_t object,
			     uint32_t interior);
/* What a surface does to rays through it. */
struct crossing {
	double ratio; /* of indices, near to far */
	double dispersion; /* of the same, at violet to that at red */
	uint32_t bands; /* that white light is split into if dispersion is not 1 */
};
/* Go through the surface: *list becomes what the ray is then in. */
struct crossing interior_cross(const struct scene *, struct tree *, uint32_t *list, const struct met *);

#endif
