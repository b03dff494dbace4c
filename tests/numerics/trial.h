/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A mesh given to every accelerator, and what they answer to rays beside the truth.
 *
 * Wrong answers are classed by what a picture would show. Let delta be 1e-5 of the mesh's diameter, or 8 ulp
 * of the largest coordinate if that is more, and shift the ray by it in eight directions:
 *	leak: a miss, where the true ray and all eight hit;
 *	through: a hit more than 1e-3 diameters off the true one, which all eight are near;
 *	ghost: a hit, where the true ray and all eight miss (these three are hard: they can be seen);
 *	silhouette: any other wrong hit, miss or depth;
 *	neighbour: within 1e-3 diameters of the true depth, but another triangle.
 */
#ifndef ALIDADE_TESTS_TRIAL_H
#define ALIDADE_TESTS_TRIAL_H

#include "accel/load.h"
#include "accel/trace.h"
#include "alidade/kernel.h"
#include "soups.h"

enum { TRIAL_ACCELS = 8, TRIAL_BATCH = 1024, PLAIN_SHARE = 401 };

struct trial_tools { /* the same for all trials */
	struct mem_book book;
	struct pool *pool;
	uint32_t accels;
	const char *name[TRIAL_ACCELS];
	struct accel_choice choice[TRIAL_ACCELS];
	uint32_t precision; /* ALD_PRECISION_... */
};

struct tally { /* counts, rays first and TALLY_COUNTS in all */
	uint64_t rays, hits, leaks, through, ghosts, silhouettes, neighbours;
	uint64_t unlike; /* an accelerator answered other bits than the first one */
	uint64_t wrong_ids; /* of hits near the true depth: not the first of those that are really nearest */
	uint64_t wrong_sheet;
	uint64_t plain, unlike_plain; /* asked without the oracle's sieve too; answered otherwise then */
	uint64_t self, foreign, missed; /* rays that leave surfaces: see leaving.c */
	double t_error; /* the largest, of right hits */
};

#define TALLY_COUNTS (offsetof(struct tally, t_error) / sizeof(uint64_t))

static inline uint64_t tally_hard(const struct tally *t)
{
	return t->leaks + t->through + t->ghosts;
}

struct trial {
	struct trial_tools *tools;
	const struct soup *soup;
	struct scene scene;
	struct geometry *geometry[TRIAL_ACCELS];
	struct oracle *oracle;
	double diameter, delta;
	uint32_t sheet; /* triangles below this are one surface, the others another; 0: all are one */
};

typedef void trial_ray(void *arg, uint32_t i, ald_ray *);

/* Loads the accelerators of a list that ends with NULL; false: said why. */
bool trial_tools_init(struct trial_tools *, const char *const *accel, uint32_t precision);
void trial_tools_release(struct trial_tools *);
bool trial_begin(struct trial *, struct trial_tools *, const struct soup *);
void trial_end(struct trial *);
/* The triangle that was hit, as the soup numbers them. */
uint32_t trial_triangle(const struct trial *, const ald_hit *);
/* Ask n rays and add up what comes. */
void trial_run(struct trial *, uint32_t n, trial_ray *, void *arg, struct tally *);

#endif
