/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pictures as a file has them, for textures: 8 or 16 bits or floats, a palette's numbers left as they
 * are, nothing decoded.
 *
 * The format is told by the first bytes. PNG, JPEG, PPM, PGM, PFM and EXR are built in; every other goes
 * through the OpenImageIO module.
 */
#ifndef ALIDADE_IMAGE_RAW_H
#define ALIDADE_IMAGE_RAW_H

#include <stdbool.h>
#include <stdint.h>

#include "image/image.h"

enum image_depth { IMAGE_8, IMAGE_16, IMAGE_FLOAT };
enum image_curve {
	IMAGE_CURVE_NONE, /* none is known */
	IMAGE_CURVE_SRGB,
	IMAGE_CURVE_POWER
};

struct image_raw {
	uint32_t width, height, channels; /* 1: grey, 2: grey and alpha, 3: RGB, 4: RGBA */
	enum image_depth depth;
	void *sample; /* by mem_alloc; [height * width * channels], top row first */
	uint32_t palette_count; /* 0: none; else samples (8 bits, 1 channel) are its numbers */
	uint8_t palette[4 * 256]; /* RGBA */
	bool palette_alpha; /* some of its entries are not opaque */
	enum image_curve curve; /* how colour is encoded */
	bool stated; /* the file says so itself, or its format leaves no choice */
	double gamma; /* IMAGE_CURVE_POWER: light = sample ^ gamma */
	bool premultiplied;
	const char *format; /* POV-Ray's word: "png", "jpeg" ...; "" for what it has no word for */
};

/* Limits (0: none) are kept before memory is taken. A number that the palette has no entry for becomes its
 * last. */
enum status image_raw_read(struct image_raw *, const char *path, struct mem_book *,
			   const struct image_limits *, struct diag *);
void image_raw_release(struct image_raw *);
uint64_t image_raw_bytes(const struct image_raw *); /* of the samples */
uint32_t image_depth_bytes(enum image_depth);

#endif
