/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Light that comes out from below surfaces; shade_subsurface() of shade.h is the way in.
 */
#ifndef ALIDADE_SHADE_POV_SUBSURFACE_H
#define ALIDADE_SHADE_POV_SUBSURFACE_H

#include "shade/shade.h"

/* Below so many surfaces, as seen through one another, POV-Ray finds no more light. */
#define SUBSURFACE_DEEPEST 2

void subsurface_sizes(struct tree *);

#endif
