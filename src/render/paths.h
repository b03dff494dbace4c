/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Samples of pixels, each a single random path: its place in the pixel, its point of the lens, and one answer
 * for everything else that is integrated.
 */
#ifndef ALIDADE_RENDER_PATHS_H
#define ALIDADE_RENDER_PATHS_H

#include "render/wave.h"

/*
 * Samples first .. first + count - 1 of one set of a pixel. The samples of a set cover everything evenly together;
 * sets of other numbers, pixels or seeds are independent.
 */
struct path_run {
	uint32_t x, y; /* the pixel */
	uint32_t set, first, count;
	/* What they bring: */
	struct rgb sum;
	double transmit; /* summed too */
	bool finite; /* false: a sample was NaN or Inf, and is not in the sums */
};

/* Trace n runs. False: w->stopped, or out of memory. */
bool paths_trace(struct worker *, struct path_run *, uint32_t n);

#endif
