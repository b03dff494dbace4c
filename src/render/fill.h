/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Filling the cache of indirect light before the picture is made.
 */
#ifndef ALIDADE_RENDER_FILL_H
#define ALIDADE_RENDER_FILL_H

#include "base/pool.h"
#include "render/wave.h"
#include "shade/cache.h"

/* The workers' shader asks this cache from then on. False: a worker stopped, or out of memory. */
bool fill_cache(struct cache *, struct shader *, struct worker *, struct pool *);

#endif
