/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Meshes to try rays on, of size 1 about the origin until they are placed.
 */
#ifndef ALIDADE_TESTS_SOUPS_H
#define ALIDADE_TESTS_SOUPS_H

#include "oracle.h"

double random_unit(uint64_t *seed); /* [0, 1) */
double random_signed(uint64_t *seed); /* [-1, 1) */
uint32_t random_below(uint64_t *seed, uint32_t n);
vec random_direction(uint64_t *seed); /* unit */
double as_float(double); /* with 24 bits, whatever the exponent */

/* All add to a soup, which starts as { 0 }. */
void soup_bumpy(struct soup *, double bump, uint64_t *seed); /* icosahedron in 1,280, radius 1 +- bump */
void soup_uv(struct soup *); /* 24 rings of 48, poles of valence 48 */
void soup_box(struct soup *); /* [-1, 1]^3, 8 x 8 quads a face, shared vertices */
void soup_sheets(struct soup *, double height, double gap); /* two of 24 x 24 quads, across z */
void soup_needles(struct soup *, uint32_t n, double aspect, uint64_t *seed);
/* A triangle of these corners; a copy of each vertex is its own. */
void soup_triangle(struct soup *, vec a, vec b, vec c);
void soup_degenerates(struct soup *); /* per face: AAB, ABB, CCC, A (copy of A) B */
void soup_turn(struct soup *, const struct mat *);
void soup_stretch(struct soup *, vec by);
/* v -> round(round(v scale) + offset): floats, or doubles. */
void soup_place(struct soup *, double scale, vec offset, bool floats);
void soup_release(struct soup *);
double soup_diameter(const struct soup *);
double soup_largest(const struct soup *); /* coordinate */

#endif
