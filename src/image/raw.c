/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pictures as a file has them: which reader, and the limits.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "image/raw.h"

#include <inttypes.h>
#include <string.h>

#include "image/format.h"

uint32_t image_depth_bytes(enum image_depth depth)
{
	return depth == IMAGE_8 ? 1 : depth == IMAGE_16 ? 2 : 4;
}

uint64_t image_raw_bytes(const struct image_raw *raw)
{
	return (uint64_t)raw->width * raw->height * raw->channels * image_depth_bytes(raw->depth);
}

void image_raw_release(struct image_raw *raw)
{
	mem_free(raw->sample);
	raw->sample = NULL;
}

enum status image_raw_take(struct image_raw *raw, struct image_in *in, uint64_t width, uint64_t height)
{
	const struct image_limits *l = &in->limits;
	uint64_t bytes;

	if (!width || !height)
		return diag_fail(in->diag, STATUS_SCENE, &in->pos, "the picture has no pixels");
	if (width > INT32_MAX || height > INT32_MAX || (l->pixels && width > l->pixels / height))
		return diag_fail(in->diag, STATUS_SCENE, &in->pos,
				 "the picture claims %" PRIu64 " x %" PRIu64 " pixels; the limit is %" PRIu64,
				 width, height, l->pixels);
	raw->width = (uint32_t)width;
	raw->height = (uint32_t)height;
	bytes = image_raw_bytes(raw);
	if (bytes > SIZE_MAX / 2 || (l->bytes && bytes > l->bytes))
		return diag_fail(in->diag, STATUS_SCENE, &in->pos,
				 "the picture would take %.1f MiB of memory; the limit leaves %.1f MiB",
				 (double)bytes / 1048576.0, (double)l->bytes / 1048576.0);
	raw->sample = mem_alloc(in->book, "textures", (size_t)bytes);
	return raw->sample ? STATUS_OK : diag_no_memory(in->diag, "a texture's picture", bytes);
}

/* R, G, B, A or Y, A without a layer, in this order; how many, 0 if there is no colour. */
static uint32_t choose(const struct image *im, uint32_t channel[4])
{
	static const char *const want[] = { "R", "G", "B", "A" };
	uint32_t n = 0, y = UINT32_MAX, alpha = UINT32_MAX;

	for (uint32_t i = 0; i < im->channels; i++) {
		if (!strcmp(im->name[i], "Y"))
			y = i;
		if (!strcmp(im->name[i], "A"))
			alpha = i;
		if (n < 3 && !strcmp(im->name[i], want[n]))
			channel[n++] = i;
	}
	if (n < 3 && y == UINT32_MAX)
		return 0;
	if (n < 3) {
		channel[0] = y;
		n = 1;
	}
	if (alpha != UINT32_MAX)
		channel[n++] = alpha;
	return n;
}

static bool in_order(const uint32_t *channel, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++) {
		if (channel[i] != i)
			return false;
	}
	return true;
}

static void gather(struct image_raw *raw, const struct image *im, const uint32_t *channel)
{
	size_t n = (size_t)im->width * im->height;
	float *out = raw->sample;

	for (size_t i = 0; i < n; i++) {
		for (uint32_t c = 0; c < raw->channels; c++)
			*out++ = im->pixel[i * im->channels + channel[c]];
	}
}

static enum status take_floats(struct image_raw *raw, struct image_in *in, struct image *im)
{
	uint32_t channel[4];
	enum status st;

	raw->depth = IMAGE_FLOAT;
	raw->curve = IMAGE_CURVE_POWER;
	raw->gamma = 1;
	raw->stated = true;
	raw->premultiplied = im->premultiplied;
	raw->channels = choose(im, channel);
	if (!raw->channels)
		return diag_fail(in->diag, STATUS_SCENE, &in->pos,
				 "the picture has neither channels R, G, B nor Y");
	if (raw->channels == im->channels && in_order(channel, raw->channels)) {
		raw->width = im->width;
		raw->height = im->height;
		raw->sample = im->pixel;
		im->pixel = NULL;
		return STATUS_OK;
	}
	st = image_raw_take(raw, in, im->width, im->height);
	if (!st)
		gather(raw, im, channel);
	return st;
}

/* Formats of light: floats anyway, so the reader of pictures serves. */
static enum status float_read_raw(struct image_raw *raw, struct image_in *in,
				  enum status (*read)(struct image *, struct image_in *))
{
	struct image im = { 0 };
	enum status st = read(&im, in);

	if (!st)
		st = take_floats(raw, in, &im);
	image_release(&im);
	return st;
}

/* A number without an entry would be read beyond the palette. */
static void mend_palette(struct image_raw *raw)
{
	size_t n = (size_t)raw->width * raw->height;
	uint8_t *sample = raw->sample, last = (uint8_t)(raw->palette_count - 1);

	for (size_t i = 0; raw->palette_count && i < n; i++) {
		if (sample[i] > last)
			sample[i] = last;
	}
}

static enum status read_any(struct image_raw *raw, struct image_in *in, const char *path)
{
	if (!memcmp(in->magic, "P5", 2) || !memcmp(in->magic, "P6", 2)) {
		raw->format = in->magic[1] == '5' ? "pgm" : "ppm";
		return pnm_read_raw(raw, in);
	}
	if (!memcmp(in->magic, "PF", 2) || !memcmp(in->magic, "Pf", 2))
		return float_read_raw(raw, in, pfm_read);
	if (!memcmp(in->magic, "\x89P", 2)) {
		raw->format = "png";
		return png_read_raw(raw, in);
	}
	if (!memcmp(in->magic, "\xff\xd8", 2)) {
		raw->format = "jpeg";
		return jpeg_read_raw(raw, in);
	}
	if (!memcmp(in->magic, "v/", 2)) {
		raw->format = "exr";
		return float_read_raw(raw, in, exr_read);
	}
	return oiio_read_raw(raw, in, path);
}

enum status image_raw_read(struct image_raw *raw, const char *path, struct mem_book *book,
			   const struct image_limits *limits, struct diag *diag)
{
	struct image_in in = { .pos = { .file = path }, .limits = *limits, .book = book, .diag = diag };
	enum status st;

	memset(raw, 0, sizeof(*raw));
	raw->format = "";
	st = image_in_open(&in, path);
	if (!st)
		st = read_any(raw, &in, path);
	image_in_close(&in);
	if (st)
		image_raw_release(raw);
	else
		mend_palette(raw);
	return st;
}
