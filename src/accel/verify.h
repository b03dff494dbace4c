/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Some of a picture's rays asked again, of the plainest code there is: --verify.
 *
 * Two judges answer. Brute force with the arithmetic of the picture's own precision has to answer to the bit what
 * the accelerator does; if not, the accelerator is wrong. Brute force with exact order tells how often this
 * precision takes another primitive than the one that is really first, or misses one: what it costs to be fast.
 *
 * Which rays is decided by their own numbers and their pixel, so that threads, tiles and batches choose alike.
 * A judge is a second geometry over the same primitives, levels and solids, in which brute force takes the
 * plugin's place at every level. Each ray takes time in proportion to the scene's primitives then.
 */
#ifndef ALIDADE_ACCEL_VERIFY_H
#define ALIDADE_ACCEL_VERIFY_H

#include "accel/trace.h"

enum verify_question { VERIFY_NEAREST, VERIFY_OCCLUDED, VERIFY_NEXT, VERIFY_QUESTIONS };

#define VERIFY_SHOWN 5 /* differences that are kept */

struct verify_difference {
	enum verify_question question;
	enum trace_purpose purpose;
	uint32_t x, y; /* of the picture */
	ald_ray ray; /* in world coordinates */
	bool inexact; /* held against the exact order */
	ald_hit got, want; /* the plugin's, and the judge's; of an occluded one: prim 0 for yes */
};

struct verify_counts {
	uint32_t every; /* one ray in so many; 0: none */
	/* different: from brute force; inexact: which primitives, from the exact order. In exact mode both are one,
	 * and counted as the former; float kernels are held against the exact order alone. */
	uint64_t checked[VERIFY_QUESTIONS], different[VERIFY_QUESTIONS], inexact[VERIFY_QUESTIONS];
	struct verify_list { /* by y, x and the ray's numbers: the topmost ones */
		uint32_t count;
		struct verify_difference one[VERIFY_SHOWN];
	} first, first_inexact;
};

/* From now on one ray in every is checked. [setup] */
enum status verify_begin(struct geometry *, uint32_t every, struct pool *, struct diag *);
void verify_get(const struct geometry *, struct verify_counts *);
/* "pixel 12,34: shadow ray ...": what happened, with all that is needed to ask again. */
int verify_describe(const struct geometry *, const struct verify_difference *, char *out, size_t size);

/* For trace.c. */
struct verify;
void verify_nearest(struct verify *, uint32_t thread, const ald_ray *, const ald_hit *, uint32_t n);
void verify_occluded(struct verify *, uint32_t thread, const ald_ray *, const uint8_t *hidden, uint32_t n);
void verify_reset(struct verify *);
void verify_free(struct verify *);

#endif
