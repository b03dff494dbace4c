/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A low-discrepancy sequence in up to four dimensions: Sobol's, with the direction numbers of Joe and
 * Kuo (2008), its points shuffled and scrambled as Owen does (Burley, Practical Hash-based Owen
 * Scrambling, JCGT 9(4), 2020). Any number of its first points covers the unit square or cube evenly;
 * another seed gives another, independent sequence.
 */
#ifndef ALIDADE_BASE_SOBOL_H
#define ALIDADE_BASE_SOBOL_H

#include <stdint.h>

#include "base/rng.h"

#define SOBOL_DIMS 4

/* A sequence; the same key gives the same one. */
struct sobol {
	uint32_t order, scramble[SOBOL_DIMS];
};

struct sobol sobol_make(uint64_t key);
/* Coordinate dim, 0 <= x < 1, of its point number index. */
double sobol_at(const struct sobol *, uint32_t index, uint32_t dim);

#endif
