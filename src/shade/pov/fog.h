/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Fog along rays (manual 3.4.3.3).
 */
#ifndef ALIDADE_SHADE_POV_FOG_H
#define ALIDADE_SHADE_POV_FOG_H

#include "shade/shade.h"

/* All fogs of the scene over a way through the open. What is left of what stands at its end; glow: what
 * they add, may be NULL. */
struct rgb fog_clear(const struct scene *, vec org, vec dir, double length, struct rgb *glow);

#endif
