/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Noise over space, and what is random a unit cell: the same values as POV-Ray's (manual 3.4.7.5.3 and
 * 3.4.7.7.4, noise_generator). Pure functions, with tables that are constants.
 */
#ifndef ALIDADE_PATTERN_NOISE_H
#define ALIDADE_PATTERN_NOISE_H

#include <stdint.h>

#include "base/vec.h"

#define NOISE_ORIGINAL 1 /* clipped at 0 and 1 */
#define NOISE_RANGED 2 /* brought into 0 to 1; the default since 3.5 */
#define NOISE_PERLIN 3

/* 0 to 1. */
double noise_value(vec p, uint32_t generator);
/* Around 0; the same for all generators. */
vec noise_vector(vec p);

/* Octaves of noise, each lambda times as fine and omega times as strong as the one before. */
double noise_turbulence(vec p, uint32_t generator, uint32_t octaves, double lambda, double omega);
vec noise_vector_turbulence(vec p, uint32_t octaves, double lambda, double omega);

/* Noise as most patterns have it: twice the contrast for the newer generators, 0 to 1. */
double noise_contrast(vec p, uint32_t generator);

/* What is random a unit cell: three numbers of 0 to 1, the first of which is the pattern cells. */
struct noise_cell {
	vec corner; /* whole numbers, the cell's lowest */
	vec random;
};
struct noise_cell noise_cell(vec p); /* that p is in */
struct noise_cell noise_cell_at(vec corner);

/* The sources of waves and ripples: a unit vector, and waves' frequency. */
struct noise_wave {
	vec source;
	double frequency;
};
/* The wave number i, of as many as there are. */
struct noise_wave noise_wave(uint32_t i);

#endif
