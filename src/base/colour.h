/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Colours in the scene's working space (linear light where assumed_gamma is 1).
 */
#ifndef ALIDADE_BASE_COLOUR_H
#define ALIDADE_BASE_COLOUR_H

struct rgb {
	double r, g, b;
};

/* filter: the share of light let through tinted by rgb; transmit: the share let through as it is. */
struct rgbft {
	double r, g, b, filter, transmit;
};

static inline struct rgb rgb_make(double r, double g, double b)
{
	return (struct rgb){ r, g, b };
}

static inline struct rgb rgb_add(struct rgb a, struct rgb b)
{
	return (struct rgb){ a.r + b.r, a.g + b.g, a.b + b.b };
}

static inline struct rgb rgb_mul(struct rgb a, struct rgb b)
{
	return (struct rgb){ a.r * b.r, a.g * b.g, a.b * b.b };
}

static inline struct rgb rgb_scale(struct rgb a, double s)
{
	return (struct rgb){ a.r * s, a.g * s, a.b * s };
}

static inline double rgb_max(struct rgb a)
{
	double m = a.r > a.g ? a.r : a.g;

	return m > a.b ? m : a.b;
}

/* POV-Ray's grey: .297 R + .589 G + .114 B. */
static inline double rgb_grey(struct rgb a)
{
	return 0.297 * a.r + 0.589 * a.g + 0.114 * a.b;
}

/* What a surface of this colour lets through, by channel. */
static inline struct rgb rgbft_through(struct rgbft a)
{
	return (struct rgb){ a.r * a.filter + a.transmit, a.g * a.filter + a.transmit,
			     a.b * a.filter + a.transmit };
}

static inline struct rgb rgbft_rgb(struct rgbft a)
{
	return (struct rgb){ a.r, a.g, a.b };
}

#endif
