/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pictures in memory and in files.
 *
 * Formats are chosen by the name's ending. ppm, pfm, png and exr are built in; every other goes
 * through the OpenImageIO module, which is loaded only then.
 */
#ifndef ALIDADE_IMAGE_IMAGE_H
#define ALIDADE_IMAGE_IMAGE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/diag.h"
#include "base/mem.h"

#define IMAGE_CHANNELS 64

enum image_encoding {
	IMAGE_LINEAR, /* light; may be below 0 and above 1 */
	IMAGE_SRGB /* 0..1 along the sRGB curve (IEC 61966-2-1) */
};

struct image {
	uint32_t width, height, channels;
	enum image_encoding encoding; /* of colour; alpha, depth and counts are always linear */
	float *pixel; /* [height * width * channels], top row first; by mem_alloc */
	char name[IMAGE_CHANNELS][48]; /* "R", "G", "B", "A", "Depth.Z"; layers as LAYER.CHANNEL */
	bool premultiplied; /* colour is already multiplied by A */
	uint32_t bits; /* as stored in the file: 8, 16, 32 (0: no matter) */
};

struct pool; /* base/pool.h */

/* Name, value pairs stored in PNG (tEXt) and EXR (string attributes). */
struct image_note {
	const char *key, *value;
};

struct image_limits {
	uint64_t pixels, bytes; /* 0: default (2^31 pixels, 8 GiB) */
};

enum status image_init(struct image *, struct mem_book *, uint32_t width, uint32_t height,
		       uint32_t channels, struct diag *);
void image_release(struct image *);

/* The format is told by the first bytes; "-" is standard input. EXR: the first part's display
 * window, with the channels in the order R G B A, then layer by layer. */
enum status image_read(struct image *, const char *path, struct mem_book *,
		       const struct image_limits *, struct diag *);
/* The ending of path chooses the format: .png, .ppm, .pfm, .exr, others through the module. "-" is
 * a PNG on standard output, "-.ppm" and "-.pfm" are those. Encodes as the format needs: PNG and PPM
 * get sRGB from linear, EXR and PFM linear from sRGB; alpha is straight in PNG, multiplied in
 * elsewhere. bits: 8 or 16 for PNG and PPM, 16 (half; only colour and alpha, other channels stay
 * float) or 32 for EXR; 0: the format's usual one. Written to a temporary name in the same folder,
 * synced and renamed, so that a reader sees the old picture or the new, whole. PNG and EXR
 * are compressed by the pool's threads, to the same bytes as by one; NULL: by who calls. */
enum status image_write(const struct image *, const char *path, uint32_t bits,
			const struct image_note *, uint32_t notes, struct pool *, struct diag *);
/* Before an hour of rendering: is the format known, can the folder be written to? Makes no file. */
enum status image_can_write(const char *path, uint32_t bits, struct diag *);

/* What image_write() makes of colour in a file of that name. */
enum image_encoding image_file_encoding(const char *path);

double srgb_encode(double linear); /* clamps to 0..1; NaN gives NaN */
double srgb_decode(double encoded);
/* Samples that are NaN or Inf. */
uint64_t image_nonfinite(const struct image *);

#endif
