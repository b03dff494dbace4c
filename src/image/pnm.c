/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Netpbm's binary PPM and PGM (ppm(5), pgm(5)): a line of text, then samples of 8 or 16 bits, most
 * significant byte first; taken to be along the sRGB curve, as POV-Ray and everybody else does. And
 * PFM, the same with floats of light, bottom row first; the sign of its scale tells the byte order.
 */
#include "image/format.h"
#include "image/raw.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The next byte that is neither white space nor in a comment. */
static int skip(FILE *file)
{
	int c;

	while ((c = getc(file)) == '#' || isspace(c)) {
		if (c != '#')
			continue;
		do {
			c = getc(file);
		} while (c != '\n' && c != EOF);
	}
	return c;
}

/* The next word of the header and the one white space behind it; false: there is none. */
static bool word(struct image_in *in, char *out, size_t size)
{
	size_t n = 0;
	int c = skip(in->file);

	while (c != EOF && !isspace(c) && n + 1 < size) {
		out[n++] = (char)c;
		c = getc(in->file);
	}
	out[n] = '\0';
	return n && isspace(c);
}

static bool number(struct image_in *in, uint64_t *out)
{
	char text[20], *end;

	if (!word(in, text, sizeof(text)) || !isdigit((unsigned char)text[0]))
		return false;
	*out = strtoull(text, &end, 10);
	return !*end;
}

static enum status bad_header(struct image_in *in, const char *what)
{
	if (ferror(in->file) || feof(in->file))
		return image_truncated(in);
	return diag_fail(in->diag, STATUS_SCENE, &in->pos, "the picture's header is wrong: %s",
			 what);
}

static enum status read_rows(struct image *im, struct image_in *in, double top)
{
	size_t size = top > 255 ? 2 : 1, n = (size_t)im->width * im->channels;
	unsigned char *row = mem_alloc(in->book, "pictures", n * size);
	float *out = im->pixel;
	enum status st = STATUS_OK;

	if (!row)
		return diag_no_memory(in->diag, "a row of a picture", n * size);
	for (uint32_t y = 0; y < im->height && !st; y++) {
		if (fread(row, size, n, in->file) != n) {
			st = image_truncated(in);
			break;
		}
		for (size_t i = 0; i < n; i++) {
			uint32_t v =
				size == 2 ? (uint32_t)row[2 * i] << 8 | row[2 * i + 1] : row[i];

			*out++ = (float)(v / top);
		}
	}
	mem_free(row);
	return st;
}

static enum status read_header(struct image_in *in, uint64_t *width, uint64_t *height, uint64_t *top)
{
	if (!number(in, width) || !number(in, height) || !number(in, top))
		return bad_header(in, "width, height and greatest value are expected");
	if (!*top || *top > 65535)
		return bad_header(in, "the greatest value must be 1 to 65535");
	return STATUS_OK;
}

enum status pnm_read(struct image *im, struct image_in *in)
{
	uint64_t width, height, top;
	enum status st = read_header(in, &width, &height, &top);

	if (!st)
		st = image_take(im, in, width, height, in->magic[1] == '5' ? 1 : 3);
	if (st)
		return st;
	im->encoding = IMAGE_SRGB;
	im->bits = top > 255 ? 16 : 8;
	return read_rows(im, in, (double)top);
}

/* Samples of 0 to top as the full range of their depth. */
static void spread(struct image_raw *raw, size_t n, uint32_t top)
{
	uint8_t *byte = raw->sample;
	uint16_t *word = raw->sample;

	for (size_t i = 0; i < n && raw->depth == IMAGE_8 && top != 255; i++)
		byte[i] = (uint8_t)(((byte[i] < top ? byte[i] : top) * 510 + top) / (2 * top));
	for (size_t i = 0; i < n && raw->depth == IMAGE_16; i++) {
		const uint8_t *b = (const uint8_t *)&word[i];
		uint32_t v = (uint32_t)b[0] << 8 | b[1];

		word[i] = (uint16_t)(((v < top ? v : top) * UINT64_C(131070) + top) / (2 * top));
	}
}

enum status pnm_read_raw(struct image_raw *raw, struct image_in *in)
{
	uint64_t width, height, top;
	enum status st = read_header(in, &width, &height, &top);
	size_t n;

	if (st)
		return st;
	raw->channels = in->magic[1] == '5' ? 1 : 3;
	raw->depth = top > 255 ? IMAGE_16 : IMAGE_8;
	raw->curve = IMAGE_CURVE_NONE;
	st = image_raw_take(raw, in, width, height);
	if (st)
		return st;
	n = (size_t)width * (size_t)height * raw->channels;
	if (fread(raw->sample, image_depth_bytes(raw->depth), n, in->file) != n)
		return image_truncated(in);
	spread(raw, n, (uint32_t)top);
	return STATUS_OK;
}

enum status pnm_write(const struct image_job *job)
{
	const struct image *im = job->image;
	struct image_form form = { IMAGE_SRGB, true };
	FILE *file = job->out->file;
	struct image_pick pick;
	struct image_bytes rows;
	unsigned char *bytes;
	enum status st = image_pick(job, false, &pick);
	size_t n;

	if (st)
		return st;
	n = (size_t)im->width * pick.count;
	image_bytes_init(&rows, job, &pick, form);
	bytes = malloc(n * 2);
	fprintf(file, "P%d\n%u %u\n%u\n", pick.count == 1 ? 5 : 6, im->width, im->height,
		(1u << job->bits) - 1);
	if (!bytes)
		st = diag_no_memory(job->diag, "a row of a picture", n * 2);
	for (uint32_t y = 0; y < im->height && !st; y++) {
		image_bytes_row(&rows, y, bytes);
		if (fwrite(bytes, job->bits / 8, n, file) != n)
			st = image_out_failed(job->out);
	}
	free(bytes);
	return st;
}

static uint32_t swap(uint32_t v)
{
	return v << 24 | (v & 0xff00) << 8 | (v >> 8 & 0xff00) | v >> 24;
}

static bool host_is_little(void)
{
	const uint32_t one = 1;

	return *(const unsigned char *)&one;
}

enum status pfm_read(struct image *im, struct image_in *in)
{
	uint64_t width, height;
	char text[40], *end;
	double scale;
	enum status st;
	size_t n;

	if (!number(in, &width) || !number(in, &height))
		return bad_header(in, "width and height are expected");
	if (!word(in, text, sizeof(text)))
		return bad_header(in, "a scale is expected");
	scale = strtod(text, &end);
	if (*end || !isfinite(scale) || scale == 0)
		return bad_header(in, "the scale must be a number other than 0");
	st = image_take(im, in, width, height, in->magic[1] == 'f' ? 1 : 3);
	if (st)
		return st;
	im->bits = 32;
	n = (size_t)im->width * im->channels;
	for (uint32_t y = im->height; y-- > 0;) {
		float *row = im->pixel + y * n;

		if (fread(row, sizeof(*row), n, in->file) != n)
			return image_truncated(in);
		for (size_t i = 0; i < n && (scale < 0) != host_is_little(); i++) {
			uint32_t v;

			memcpy(&v, &row[i], sizeof(v));
			v = swap(v);
			memcpy(&row[i], &v, sizeof(v));
		}
	}
	return STATUS_OK;
}

enum status pfm_write(const struct image_job *job)
{
	const struct image *im = job->image;
	struct image_form form = { IMAGE_LINEAR, true };
	struct image_pick pick;
	enum status st = image_pick(job, false, &pick);
	double *light;
	float *row;
	size_t n;

	if (st)
		return st;
	n = (size_t)im->width * pick.count;
	row = malloc(n * sizeof(*row));
	light = malloc(n * sizeof(*light));
	if (!row || !light)
		st = diag_no_memory(job->diag, "a row of a picture",
				    n * (sizeof(*row) + sizeof(*light)));
	fprintf(job->out->file, "P%c\n%u %u\n%s\n", pick.count == 1 ? 'f' : 'F', im->width,
		im->height, host_is_little() ? "-1.0" : "1.0");
	for (uint32_t y = im->height; y-- > 0 && !st;) {
		image_row(im, y, pick.channel, pick.count, form, light);
		for (size_t i = 0; i < n; i++)
			row[i] = (float)light[i];
		if (fwrite(row, sizeof(*row), n, job->out->file) != n)
			st = image_out_failed(job->out);
	}
	free(row);
	free(light);
	return st;
}
