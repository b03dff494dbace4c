/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * An irradiance cache: indirect light at some places, with gradients, and between them (Ward and others, A Ray
 * Tracing Solution for Diffuse Interreflection, 1988; Ward and Heckbert, Irradiance Gradients, 1992).
 *
 * It is filled between pictures of ever finer grids, never while it is asked, and sums go in the order of its
 * records: so what it answers depends on no thread.
 */
#ifndef ALIDADE_SHADE_CACHE_H
#define ALIDADE_SHADE_CACHE_H

#include <stdbool.h>

#include "base/buf.h"
#include "base/colour.h"
#include "base/mem.h"
#include "base/vec.h"

#define CACHE_REACH 1.4 /* how much further than its radius a record may be asked */

struct cache_record {
	vec p, n; /* place, unit normal */
	struct rgb light; /* mean of what comes from the hemisphere around n */
	vec turn[3], move[3]; /* gradients of its r, g and b: by turning n, by moving p */
	double radius; /* it is good so far away */
	double nearest; /* the nearest surface that it knows of */
	double least; /* its radius at least */
	uint64_t key; /* what it is sorted by */
};

struct cache {
	struct mem_book *book;
	double slack;
	double turn2; /* 1 over how much a normal may be turned, as 1 less its cosine */
	struct buf record, block, slope; /* block: places by cells; slope: light as a function of the place */
	struct cache_cell *cell; /* a hash table, 1 << bits of them; NULL: empty */
	uint32_t bits, used, blocks;
	uint32_t level_count;
	int level[64]; /* those that have cells, the finest first */
	double per[64]; /* 1 / the size of their cells */
};

/* slack: how much more than by default, 1, light may be off between records. */
void cache_init(struct cache *, double slack, struct mem_book *);
void cache_release(struct cache *);
/* Put n records in; they are sorted by key first. False: out of memory. */
bool cache_add(struct cache *, struct cache_record *, uint32_t n);
/* Light at p around n from records that are good there, radii and angles taken times reach, at most
 * CACHE_REACH. False: none is. [any thread] */
bool cache_find(const struct cache *, vec p, vec n, double reach, struct rgb *light);

/* The rays of a record, in strata of equal weight: cells = rows x columns, of a record for about samples rays.
 * Ray i of them, around n; u and v in 0 .. 1 are its place in the stratum. */
struct cache_grid {
	uint32_t rows, columns;
};
struct cache_grid cache_grid(uint32_t samples);
vec cache_direction(const struct cache_grid *, vec n, uint32_t i, double u, double v);

/* What one ray of a record brought, and from how far. */
struct cache_ray {
	struct rgb light;
	double distance;
};

/* Of a record's radius; slack as above. */
struct cache_limits {
	double least, most, slack;
};

/* Make a record of what its rays brought. p, n and key are set before. */
void cache_make(struct cache_record *, const struct cache_grid *, const struct cache_ray *ray,
		const struct cache_limits *);

#endif
