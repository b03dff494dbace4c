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
	struct rgb variance; /* of colour, as an estimate */
	double transmit;
	struct rgb seen; /* colour as anti-aliasing compares it, */
	bool looked; /* once it has */
};

/* One render thread's own things. */
struct short_wave;
struct worker {
	const struct shader *shader;
	const struct render_options *options;
	uint32_t thread;
	uint32_t inside; /* what a perspective camera is inside of, found once a group */
	struct tree tree;
	struct buf sample; /* struct sample: those of the current tile */
	struct buf map; /* for anti-aliasing, see aa.c */
	struct buf lens; /* for focal blur, see lens.c */
	struct buf run; /* struct path_run: samples being taken */
	struct buf frame; /* what waits while rays are followed, see wave.c */
	struct short_wave *shorts; /* for wave_trace_short(), or NULL: there is no short way */
	bool stopped;
	struct render_counts counts;
};

/* Trace samples first .. first + n - 1 of w->sample. False: w->stopped, or out of memory. */
bool wave_trace(struct worker *w, uint32_t first, uint32_t n);

/* A camera ray: through a place in the picture, and a point of the lens if there is one. */
struct wave_root {
	double x, y, lens_x, lens_y;
	uint64_t key; /* what its random numbers are made of, */
	uint32_t path; /* and which of the rays that share it */
};

/* The same if w->shorts, without trees. */
bool wave_trace_short(struct worker *w, uint32_t first, uint32_t n);

/* The same in steps, for lens.c: begin, push each ray, follow all; then the tree's nodes from 0 on have
 * their colours. False as above. */
bool wave_begin(struct worker *w);
bool wave_push(struct worker *w, const struct wave_root *);
bool wave_follow(struct worker *w, uint32_t roots);
/* The sample's colour is node i's. */
void wave_take(const struct worker *, uint32_t i, struct sample *);
/* The pixel that a place in the picture belongs to. */
void wave_pixel(const struct worker *, double x, double y, uint32_t pixel[2]);
uint64_t wave_key(const struct sample *);
/* The same for the seed that was asked for. */
uint64_t wave_seeded(const struct worker *, uint64_t key);

#endif
