/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pictures at half, a quarter ... of their size, for --texture-filter=mip (Williams, Pyramidal Parametrics,
 * 1983): what is far away is the mean of many pixels, not one of them.
 */
#ifndef ALIDADE_PATTERN_MIP_H
#define ALIDADE_PATTERN_MIP_H

#include "base/pool.h"
#include "scene/scene.h"

/* Make those of all pictures of the scene, on the pool; once they are there, lookups with a footprint use
 * them. The scene releases them. */
enum status mip_build(struct scene *, struct pool *, struct diag *);

#endif
