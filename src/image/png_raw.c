/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * PNG pictures with their samples as they are in the file.
 */
#include "image/png_in.h"

#include <math.h>
#include <setjmp.h>
#include <string.h>

#include "image/raw.h"

/* An sRGB chunk goes before gAMA; without either, sRGB (PNG 4.2.2, and POV-Ray does the same; neither of
 * us looks at an ICC profile). */
static void read_curve(struct image_raw *raw, struct png_in *r)
{
	double gamma;
	int intent;

	raw->curve = IMAGE_CURVE_SRGB;
	raw->stated = png_get_sRGB(r->png, r->info, &intent) != 0;
	if (raw->stated || !png_get_gAMA(r->png, r->info, &gamma) || !(gamma > 0) || !isfinite(1 / gamma))
		return;
	raw->stated = true;
	raw->curve = IMAGE_CURVE_POWER;
	raw->gamma = 1 / gamma;
}

static void read_palette(struct image_raw *raw, struct png_in *r)
{
	png_bytep alpha = NULL;
	png_colorp colour = NULL;
	int count = 0, alphas = 0;

	if (!png_get_PLTE(r->png, r->info, &colour, &count) || count < 1 || count > 256)
		png_error(r->png, "it has no palette");
	if (!png_get_tRNS(r->png, r->info, &alpha, &alphas, NULL) || !alpha)
		alphas = 0;
	raw->palette_count = (uint32_t)count;
	for (int i = 0; i < count; i++) {
		uint8_t *p = raw->palette + 4 * i;

		p[0] = colour[i].red;
		p[1] = colour[i].green;
		p[2] = colour[i].blue;
		p[3] = i < alphas ? alpha[i] : 255;
		raw->palette_alpha = raw->palette_alpha || p[3] < 255;
	}
}

static bool host_is_little(void)
{
	const uint16_t one = 1;

	return *(const unsigned char *)&one;
}

static enum status read_guarded(struct png_in *r, struct image_raw *raw)
{
	enum status st;

	if (setjmp(png_jmpbuf(r->png)))
		return png_in_failed(r);
	png_in_header(r);
	read_curve(raw, r);
	if (png_get_color_type(r->png, r->info) == PNG_COLOR_TYPE_PALETTE) {
		read_palette(raw, r);
		png_set_packing(r->png);
	} else if (png_get_bit_depth(r->png, r->info) < 8) {
		png_set_expand_gray_1_2_4_to_8(r->png);
	}
	if (png_get_bit_depth(r->png, r->info) == 16 && host_is_little())
		png_set_swap(r->png);
	(void)png_set_interlace_handling(r->png);
	png_read_update_info(r->png, r->info);
	raw->channels = png_get_channels(r->png, r->info);
	raw->depth = png_get_bit_depth(r->png, r->info) == 16 ? IMAGE_16 : IMAGE_8;
	st = image_raw_take(raw, r->in, png_get_image_width(r->png, r->info),
			    png_get_image_height(r->png, r->info));
	if (st)
		return st;
	png_in_rows(r, raw->sample, png_get_rowbytes(r->png, r->info), raw->height);
	return STATUS_OK;
}

enum status png_read_raw(struct image_raw *raw, struct image_in *in)
{
	struct png_in r = { .in = in };
	enum status st = png_in_begin(&r);

	if (!st)
		st = read_guarded(&r, raw);
	png_in_end(&r);
	return st;
}
