/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Reading PNG through libpng, what both readers of it share; private to src/image.
 */
#ifndef ALIDADE_IMAGE_PNG_IN_H
#define ALIDADE_IMAGE_PNG_IN_H

#include <png.h>

#include "image/format.h"

/* libpng leaves by longjmp; the text waits here. */
struct png_trouble {
	char text[160];
};

struct png_in {
	struct image_in *in;
	png_structp png;
	png_infop info;
	bool ended; /* the file was too short */
	struct png_trouble trouble;
};

enum status png_in_begin(struct png_in *); /* in is set */
void png_in_end(struct png_in *);
/* These two leave through png_jmpbuf(png) on failure, which png_in_failed() then reports. */
void png_in_header(struct png_in *); /* all up to the samples */
void png_in_rows(struct png_in *, unsigned char *bytes, size_t stride, uint32_t height);
enum status png_in_failed(struct png_in *);

#endif
