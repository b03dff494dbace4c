/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Families of patterns, for pattern.c's table: the raw value at a point behind the warps, before
 * frequency and wave. To add one, declare it here and put it into the table.
 */
#ifndef ALIDADE_PATTERN_FAMILY_H
#define ALIDADE_PATTERN_FAMILY_H

#include "pattern/pattern.h"

typedef double pattern_function(const struct scene *, const struct pattern *, const struct pattern_point *);
typedef struct rgbft colour_function(const struct scene *, const struct pattern *, const struct pattern_point *);

/* block.c: an entry's number. */
pattern_function block_brick, block_checker, block_cubic, block_hexagon, block_square, block_triangular;
/* solid.c */
pattern_function solid_boxed, solid_cylindrical, solid_gradient, solid_onion, solid_planar, solid_radial,
	solid_spherical, solid_leopard, solid_quilted, solid_spiral1, solid_spiral2;
/* From the middle of a quilt's cube; and how steep it is at that distance. */
vec solid_quilt_place(vec p);
double solid_quilt(const struct pattern *, double distance);
/* surface.c: of the surface's direction, or another pigment, or a function. */
pattern_function surface_aoi, surface_slope, surface_pigment, surface_function;
/* fractal.c: mandel, julia, magnet */
pattern_function fractal_value;
/* image.c */
pattern_function picture_value, picture_material;
colour_function picture_colour;

bool pattern_brings_colour(enum pattern_kind);
struct rgbft pattern_colour(const struct scene *, const struct pattern *, const struct pattern_point *);

/* A wave with corners: 0, 1, 0 over a period of 1. */
double wave_triangle(double);

#endif
