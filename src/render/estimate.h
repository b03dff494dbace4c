/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * How sure a mean is: first and second moments of independent sets of samples.
 *
 * Samples of one set cover their domain evenly together, so they are not independent, and say little of how far off
 * their mean is. Means of sets are, and do: randomised quasi-Monte Carlo (Owen, 1995), also where sets are not of
 * equal size.
 */
#ifndef ALIDADE_RENDER_ESTIMATE_H
#define ALIDADE_RENDER_ESTIMATE_H

#include <stdbool.h>
#include <stdint.h>

#define ESTIMATE_VALUES 4 /* red, green, blue, and how much of the background is seen */

/* Floats, as every pixel has them; what is added are differences from a sample of the pixel, so that little is lost. */
struct moments {
	uint32_t n; /* samples */
	float q0; /* sum of squared sizes of the sets */
	float s[ESTIMATE_VALUES], q1[ESTIMATE_VALUES], q2[ESTIMATE_VALUES];
	/* sums over sets of size mean, size^2 mean, size^2 mean^2 */
};

/* A set of n samples. */
void moments_add(struct moments *, uint32_t n, const double mean[ESTIMATE_VALUES]);
void moments_merge(struct moments *, const struct moments *);
double moments_mean(const struct moments *, int i);
/* Of the mean; below 0 if there are not two sets. Unbiased if sets are of one size or a set's variance goes with
 * the inverse of its size. */
double moments_variance(const struct moments *, int i);
/* As many sets of one size tell as much. */
double moments_sets(const struct moments *);

/* How a picture shows its colours. */
struct estimate_view {
	double gamma; /* of the scene's working space, see film/tone.h */
	bool clips; /* what is brighter than white is white */
};

/* A standard error as it is seen: half the difference between mean + error and mean - error along the sRGB curve. */
double estimate_seen(const struct estimate_view *, double mean, double error);

#endif
