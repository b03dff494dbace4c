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
static inline bool shadow_dark(struct rgb c)
{
	return fabs(c.r) < 1e-10 && fabs(c.g) < 1e-10 && fabs(c.b) < 1e-10;
}

/* The start of a ray from a hit towards dir: off the surface by its error bound, on dir's side. */
static inline vec shadow_origin(const struct met *m, vec dir)
{
	return vec_mad(m->p, m->n, vec_dot(m->n, dir) < 0 ? -m->error : m->error);
}

#endif
