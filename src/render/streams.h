/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A pixel of a budget: two streams of sets of samples, of which each says when the other has enough (budget.c).
 */
#ifndef ALIDADE_RENDER_STREAMS_H
#define ALIDADE_RENDER_STREAMS_H

#include "render/estimate.h"

enum { STREAM_A, STREAM_B, STREAMS };

struct streams {
	float origin[ESTIMATE_VALUES]; /* its first sample; all else counts from there */
	struct moments run[STREAMS];
	float mean[ESTIMATE_VALUES], variance[ESTIMATE_VALUES]; /* of the stream that ended before the other */
	float sets; /* of it, as moments_sets() */
	float pilot[STREAMS]; /* squared error as it is seen, times samples of both streams, after the pilot */
	uint32_t kept_n; /* samples of it */
	uint32_t pairs; /* of whole sets, traced */
	bool started, bad, beside; /* beside: not of the picture, but of its neighbourhood */
	bool ended[STREAMS], kept; /* kept: mean, variance, sets are of the one that is ended[] first */
	uint8_t first; /* which */
	bool done;
};

/* Mean and variance of a pixel, or of one of its streams, less the origin. */
struct stream_mean {
	double mean[ESTIMATE_VALUES], variance[ESTIMATE_VALUES]; /* variance below 0: unknown */
	double sets; /* equal ones that tell as much */
	uint32_t n; /* samples; 0: there is the origin only */
};

/* The error of the whole pixel as it is seen, squared, if both streams were as this one is; of the first so many
 * values the largest. */
double streams_error(const struct streams *, int stream, const struct estimate_view *, uint32_t values);
/* This stream ends here, the other does not. */
void streams_keep(struct streams *, int stream);
/* decided: the streams' lengths are of their own deciding. */
struct stream_mean streams_mean(const struct streams *, bool decided);
/* What makes 68 and 95 of 100 values be within one and 1.96 errors that come from so many sets. */
double streams_student(double sets);

#endif
