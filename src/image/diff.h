/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Comparing two pictures, so that a machine can decide whether they are the same.
 *
 * Differences are B - A, alpha multiplied in, in one encoding for both. Thresholds named as idiff's
 * mean what they mean there, but a sample that is NaN or infinite is always a failure unless it is
 * allowed, and hard_fail is looked at whatever fail is.
 */
#ifndef ALIDADE_IMAGE_DIFF_H
#define ALIDADE_IMAGE_DIFF_H

#include <stdio.h>

#include "base/json_write.h"
#include "image/image.h"

enum diff_space {
	DIFF_STORED, /* light if both hold light, else along the sRGB curve, clamped to 0..1 */
	DIFF_LINEAR,
	DIFF_SRGB
};

struct diff_options {
	enum diff_space space;
	bool rgb_only; /* R, G, B (or Y) without a layer; others may be missing */
	bool allow_nonfinite; /* not an error where both have the same NaN or infinity */
	uint32_t crop_x, crop_y, crop_width, crop_height; /* width 0: all */
	double fail, fail_percent, warn, warn_percent; /* share of the pixels that may exceed it */
	bool warn_always; /* also if no pixel exceeds fail, when idiff does not look at warn */
	double hard_fail, hard_warn; /* no pixel may */
	uint64_t allow_failures; /* pixels that may exceed fail by any amount */
	double max_rms, max_p99; /* Inf: no matter */
	double max_mean; /* of all or any channel, without its sign */
	double scale; /* of the picture of the differences */
};

enum diff_verdict { DIFF_SAME = 0, DIFF_WARN = 1, DIFF_FAIL = 2, DIFF_UNLIKE = 3 };

#define DIFF_REASONS 12

/* Figures are over all samples compared, and for a pixel over its channels' greatest difference. */
struct diff_result {
	enum diff_verdict verdict;
	enum image_encoding encoding; /* compared in */
	uint32_t width, height, channels; /* compared */
	char name[IMAGE_CHANNELS][48];
	uint64_t pixels;
	uint64_t nonfinite[2]; /* pixels with such a sample in A, in B */
	uint64_t nonfinite_any; /* in either */
	uint64_t nonfinite_unlike; /* pixels with such a sample in only one, or another one */
	double mean, rms, psnr, p99, max; /* psnr for a peak of 1; Inf if equal */
	double channel_mean[IMAGE_CHANNELS], channel_rms[IMAGE_CHANNELS],
		channel_max[IMAGE_CHANNELS];
	uint32_t max_x, max_y, max_channel; /* place in the whole picture */
	double max_sample[2]; /* what A and B have there */
	uint64_t over_fail, over_warn; /* pixels */
	uint32_t reasons; /* why the verdict is not DIFF_SAME */
	char reason[DIFF_REASONS][200];
};

void diff_options_init(struct diff_options *); /* idiff's defaults: fail and warn 1e-6 */
/* STATUS_OK: result->verdict tells; anything else: it could not be done, and diag says why. picture
 * may be NULL; else it gets the amplified absolute differences, magenta where a sample is not
 * finite, to be released. */
enum status image_diff(const struct image *a, const struct image *b, const struct diff_options *,
		       struct diff_result *, struct image *picture, struct mem_book *,
		       struct diag *);

void diff_print(const struct diff_result *, const struct diff_options *, const char *a,
		const char *b, FILE *);
/* One object; ended by the caller's jw_finish(). */
void diff_json(const struct diff_result *, const struct diff_options *, const char *a,
	       const char *b, struct json_writer *);

#endif
