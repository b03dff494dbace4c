/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The colours that POV-Ray gives to patterns without a map.
 */
#include "pattern/pattern.h"

#define COLOUR(v, red, green, blue) { .at = (double)(float)(v), .is.colour = { red, green, blue, 0, 0 } }

static const struct map_entry grey[] = { COLOUR(0, 0, 0, 0), COLOUR(1, 1, 1, 1) };
static const struct map_entry agate[] = { COLOUR(0, 1, 1, 1),		COLOUR(0.5, 0.95, 0.75, 0.5),
				    COLOUR(0.5, 0.9, 0.7, 0.5), COLOUR(0.6, 0.9, 0.7, 0.4),
				    COLOUR(0.6, 1, 0.7, 0.4),	COLOUR(1, 0.6, 0.3, 0) };
static const struct map_entry bozo[] = { COLOUR(0.4, 1, 1, 1), COLOUR(0.4, 0, 1, 0), COLOUR(0.6, 0, 1, 0),
				   COLOUR(0.6, 0, 0, 1), COLOUR(0.8, 0, 0, 1), COLOUR(0.8, 1, 0, 0) };
static const struct map_entry brick[] = { COLOUR(0, 0.5, 0.5, 0.5), COLOUR(1, 0.6, 0.15, 0.15) };
static const struct map_entry checker[] = { COLOUR(0, 0, 0, 1), COLOUR(1, 0, 1, 0) };
static const struct map_entry six[] = { COLOUR(0, 1, 0, 0), COLOUR(1, 0, 1, 0), COLOUR(2, 0, 0, 1),
				  COLOUR(3, 1, 1, 0), COLOUR(4, 0, 1, 1), COLOUR(5, 1, 0, 1) };
static const struct map_entry hexagon[] = { COLOUR(0, 0, 0, 1), COLOUR(1, 0, 1, 0), COLOUR(2, 1, 0, 0) };
static const struct map_entry mandel[] = { COLOUR(0.001, 0, 0, 0), COLOUR(0.001, 0, 1, 1), COLOUR(0.012, 1, 1, 0),
				     COLOUR(0.015, 1, 0, 1), COLOUR(0.1, 0, 1, 1) };
static const struct map_entry marble[] = { COLOUR(0, 0.9, 0.8, 0.8), COLOUR(0.9, 0.9, 0.08, 0.08),
				     COLOUR(0.9, 0, 0, 0) };
static const struct map_entry radial[] = { COLOUR(0, 0, 1, 1), COLOUR(0.333, 1, 1, 0), COLOUR(0.666, 1, 0, 1),
				     COLOUR(1, 0, 1, 1) };
static const struct map_entry wood[] = { COLOUR(0.6, 0.666, 0.312, 0.2), COLOUR(0.6, 0.4, 0.1333, 0.066) };

#define MAP(array) { .kind = MAP_COLOUR, .count = sizeof(array) / sizeof(array[0]), .entry = (struct map_entry *)array }

static const struct map grey_map = MAP(grey);
static const struct map map_of[PATTERN_KINDS] = {
	[PATTERN_AGATE] = MAP(agate),	[PATTERN_BOZO] = MAP(bozo),	  [PATTERN_BRICK] = MAP(brick),
	[PATTERN_CHECKER] = MAP(checker), [PATTERN_OBJECT] = MAP(checker), [PATTERN_CUBIC] = MAP(six),
	[PATTERN_SQUARE] = MAP(six),	[PATTERN_TRIANGULAR] = MAP(six),  [PATTERN_HEXAGON] = MAP(hexagon),
	[PATTERN_FRACTAL] = MAP(mandel), [PATTERN_MARBLE] = MAP(marble),  [PATTERN_RADIAL] = MAP(radial),
	[PATTERN_WOOD] = MAP(wood),
};

const struct map *pattern_default_map(enum pattern_kind k)
{
	return map_of[k].count ? &map_of[k] : &grey_map;
}

const struct map *pattern_own_map(const struct pattern *q)
{
	/* Of the fractals, only the plain Mandelbrot set has colours. */
	if (q->kind == PATTERN_FRACTAL &&
	    (q->of.fractal.julia || q->of.fractal.magnet || q->of.fractal.exponent != 2))
		return &grey_map;
	return pattern_default_map(q->kind);
}
