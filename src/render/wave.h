/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Colours of samples: camera rays through places in the picture, followed in waves.
 */
#ifndef ALIDADE_RENDER_WAVE_H
#define ALIDADE_RENDER_WAVE_H

#include "render/render.h"
#include "shade/shade.h"

/* A place in the picture, in pixels from its top left corner, and in the end its colour. */
struct sample {
	double x, y;
	struct rgb colour; /* working space, premultiplied */
	double transmit;
};

/* One render thread's own things. */
struct worker {
	const struct shader *shader;
	const struct render_options *options;
	uint32_t thread;
	uint32_t inside; /* what a perspective camera is inside of, found once a group */
	struct tree tree;
	struct buf sample; /* struct sample: those of the current tile */
	struct buf map; /* for anti-aliasing, see aa.c */
	struct buf frame; /* what waits while rays are followed, see wave.c */
	bool stopped;
	struct render_counts counts;
};

/* Trace samples first .. first + n - 1 of w->sample. False: w->stopped, or out of memory. */
bool wave_trace(struct worker *w, uint32_t first, uint32_t n);

#endif
