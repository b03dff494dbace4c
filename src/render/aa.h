/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Anti-aliasing: which places of the picture are looked at, and how they become a pixel.
 */
#ifndef ALIDADE_RENDER_AA_H
#define ALIDADE_RENDER_AA_H

#include "render/wave.h"

struct aa_tile {
	uint32_t x, y, width, height; /* in pixels of the whole picture */
};

struct aa_pixel {
	struct rgb colour, variance; /* variance of a budget: below 0: unknown */
	double transmit;
	uint32_t samples; /* of a budget: that its colour is the mean of */
	bool finite; /* false: a sample was NaN or Inf; it counts as black */
};

/* Render the tile into pixel[height * width]. False: w->stopped, or out of memory. */
bool aa_render(struct worker *w, const struct aa_tile *tile, struct aa_pixel *pixel);

#endif
