/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Patterns made of noise and of random points (manual 3.4.7.1), as values before frequency and wave.
 */
#ifndef ALIDADE_PATTERN_RANDOM_H
#define ALIDADE_PATTERN_RANDOM_H

#include "pattern/noise.h"
#include "scene/scene.h"

/* agate, bozo, bumps, cells, crackle, dents, granite, marble, ripples, spotted, waves, wood and wrinkles.
 * p: behind the warps. */
double random_pattern(const struct scene *, const struct pattern *, vec p);

/* The generator that a pattern's noise is made by. */
uint32_t pattern_generator(const struct scene *, const struct pattern *);

/* The nearest of the random points, one a unit cell, by which facets are cut. */
vec random_facet(vec p, double metric);

/* sin(2 pi v) */
double cycloidal(double v);

#endif
