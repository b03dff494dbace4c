/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Media along rays.
 */
#ifndef ALIDADE_SHADE_POV_MEDIA_H
#define ALIDADE_SHADE_POV_MEDIA_H

#include "shade/shade.h"

/* What is left of light on its way through all that list says it is inside of. key: for jitter. */
struct rgb media_clear(const struct shader *, struct tree *, uint32_t list, vec org, vec dir,
		       double length, uint64_t key);
/* The same of what fills the world. */
struct rgb media_world_clear(const struct shader *, struct tree *, uint32_t list, vec org, vec dir,
			     double length, uint64_t key);

/* Set up the tree's buffers for media. */
void media_sizes(struct tree *);

#endif
