/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Light at points that are no surfaces: asked for at a met of the wave, answered for all of them at once.
 */
#ifndef ALIDADE_SHADE_POV_LIGHTS_H
#define ALIDADE_SHADE_POV_LIGHTS_H

#include "shade/shade.h"

#define LIGHT_BESIDE 1e-10 /* cosine below which light passes by a surface, as in POV-Ray */

/* Append a lit for this light at met hit, unless none can come; true if it was appended. */
bool lights_ask(const struct shader *, struct tree *, uint32_t hit, uint32_t light);
/* What arrives, shadows included, becomes the colour of all lits. hints: how their rays lie, light by light. */
void lights_answer(const struct shader *, struct tree *, uint32_t thread, uint32_t hints, struct shade_counts *);

#endif
