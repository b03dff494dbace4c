/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What the picture formats share; private to src/image.
 */
#ifndef ALIDADE_IMAGE_FORMAT_H
#define ALIDADE_IMAGE_FORMAT_H

#include <stdio.h>

#include "image/image.h"
#include "image/out.h"

/* A file being read. Its first two bytes are read already, to choose the format by: standard input
 * can't be wound back. */
struct image_in {
	FILE *file;
	unsigned char magic[2];
	struct diag_pos pos; /* of the file, for messages */
	struct mem_book *book;
	struct image_limits limits;
	struct diag *diag;
};

/* Open a file and read its first two bytes; on failure too, image_in_close() takes it down. */
enum status image_in_open(struct image_in *, const char *path);
void image_in_close(struct image_in *);

/* A picture and where it goes. */
struct image_job {
	const struct image *image;
	uint32_t bits; /* never 0 */
	const struct image_note *note;
	uint32_t notes;
	struct image_out *out;
	struct pool *pool; /* that compresses; NULL: who calls does */
	struct diag *diag;
};

/* A reader fills an image that is all zero; its caller releases it on failure. */
enum status pnm_read(struct image *, struct image_in *);
enum status pfm_read(struct image *, struct image_in *);
enum status png_read(struct image *, struct image_in *);
enum status exr_read(struct image *, struct image_in *);
enum status oiio_read(struct image *, struct image_in *, const char *path);

struct image_raw; /* raw.h */
enum status pnm_read_raw(struct image_raw *, struct image_in *);
enum status png_read_raw(struct image_raw *, struct image_in *);
enum status jpeg_read_raw(struct image_raw *, struct image_in *);
enum status oiio_read_raw(struct image_raw *, struct image_in *, const char *path);
/* channels and depth are set: sets the size, checks it against the limits and takes memory. */
enum status image_raw_take(struct image_raw *, struct image_in *, uint64_t width, uint64_t height);

enum status pnm_write(const struct image_job *);
enum status pfm_write(const struct image_job *);
enum status png_write(const struct image_job *);
enum status exr_write(const struct image_job *);
enum status oiio_write(const struct image_job *);
/* Is the module there, and does it write files of that ending? */
enum status oiio_can_write(const char *path, uint32_t bits, struct diag *);

/* Is the size that a file's header claims within the limits? */
enum status image_check(struct image_in *, uint64_t width, uint64_t height, uint64_t channels);
/* Checks it and takes memory, not cleared: the pages of a lying header are never touched. Names of 1 to
 * 4 channels are set to Y, YA, RGB, RGBA. */
enum status image_take(struct image *, struct image_in *, uint64_t width, uint64_t height,
		       uint64_t channels);
/* "the file ends early" or the stream's error. */
enum status image_truncated(struct image_in *);

/* Which channels a display format stores: Y, Y A, R G B or R G B A, those without a layer. Others
 * are left out with a warning, alpha silently if the format has none (the picture then stands on
 * black). */
struct image_pick {
	uint32_t count;
	uint32_t channel[4];
	bool alpha; /* the last one is alpha */
};

enum status image_pick(const struct image_job *, bool alpha, struct image_pick *);

/* How a file wants its colour. */
struct image_form {
	enum image_encoding encoding;
	bool premultiplied;
};

/* Row y of count channels, each sample in that form; in double, so that it is rounded once only.
 * channel NULL: all of them in order. */
void image_row(const struct image *, uint32_t y, const uint32_t *channel, uint32_t count,
	       struct image_form form, double *out);

/* Rows as integers of 8 or 16 bits (most significant byte first), rounded to nearest; below 0 and NaN give 0. */
#define IMAGE_GUESSES 1664
struct image_bytes {
	const struct image *image;
	const struct image_pick *pick;
	struct image_form form;
	uint32_t bits;
	bool quick; /* light to bytes along the sRGB curve, looked up */
	uint8_t guess[IMAGE_GUESSES]; /* for samples from 2^-13 to 1, by the first bits of the float */
};

void image_bytes_init(struct image_bytes *, const struct image_job *, const struct image_pick *,
		      struct image_form);
void image_bytes_row(const struct image_bytes *, uint32_t y, unsigned char *out);
/* R, G, B of any layer, Y of none. */
bool image_is_colour(const char *name);

#endif
