/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Camera rays of scenes whose every surface takes the short way (shade/pov/plain.c), and tiles of them.
 */
#ifndef ALIDADE_RENDER_SHORT_WAVE_H
#define ALIDADE_RENDER_SHORT_WAVE_H

#include "render/aa.h"
#include "shade/pov/plain_lanes.h"

#define SHORT_BATCH PLAIN_LANES
#define SHORT_HELD 2048 /* samples of a tile, at most */

/* A thread's own. */
struct short_wave {
	struct plain_lanes lanes;
	const struct paint *paint; /* by texture */
	double x[SHORT_BATCH], y[SHORT_BATCH]; /* places in the picture, as a sample's */
	bool there[SHORT_BATCH]; /* the camera sees something there */
	bool later[SHORT_BATCH]; /* it has to go the long way */
	struct seen seen[SHORT_HELD];
	float pixel[4 * SHORT_HELD]; /* R, G, B and A of samples that are pixels */
	double across[SHORT_HELD], down[SHORT_HELD]; /* coordinates of a part's columns and rows */
	uint32_t columns, rows; /* of the part that this order is for: where the samples are, and which is where */
	uint16_t column[SHORT_HELD], row[SHORT_HELD], place[SHORT_HELD];
};

/* What is seen in the first n places of w->shorts. False: w->stopped, or out of memory. */
bool wave_short(struct worker *w, uint32_t n, struct seen *out);

/* Pixels whose samples were NaN or Inf; the first of them, by row then column. */
struct nonfinite {
	uint64_t count;
	uint32_t x, y;
};
void nonfinite_note(struct nonfinite *, uint64_t count, uint32_t x, uint32_t y);

/* Is w->shorts there, and can it draw tiles as they are asked for? */
bool short_tile_can(const struct worker *w);
/* The tile's R, G, B and A, whose rows are pitch floats apart. False as above. */
bool short_tile(struct worker *w, const struct aa_tile *, float *out, size_t pitch, struct nonfinite *);

#endif
