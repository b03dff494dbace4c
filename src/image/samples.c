/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Samples between memory and file: the sRGB curve, alpha, rounding to integers.
 *
 * The curve is IEC 61966-2-1's, with its constants as they are printed there. Bytes along it, which most files
 * hold, are looked up: a float's first bits tell its byte or the one before, and a table of the least float of
 * each byte which of the two.
 */
#include "image/format.h"
#include "image/srgb_table.h"

#include <math.h>
#include <string.h>

double srgb_encode(double linear)
{
	if (linear <= 0)
		return 0;
	if (linear >= 1)
		return 1;
	return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded)
{
	return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

uint64_t image_nonfinite(const struct image *im)
{
	size_t n = (size_t)im->width * im->height * im->channels;
	uint64_t bad = 0;

	for (size_t i = 0; i < n; i++)
		bad += !isfinite(im->pixel[i]);
	return bad;
}

/* Behind the last point: a channel's name without its layer. */
static const char *short_name(const char *name)
{
	const char *point = strrchr(name, '.');

	return point ? point + 1 : name;
}

bool image_is_colour(const char *name)
{
	const char *s = short_name(name);

	return (s[0] == 'R' || s[0] == 'G' || s[0] == 'B' || (s[0] == 'Y' && s == name)) && !s[1];
}

/* The alpha channel that goes with channel c, -1 if none. */
static int alpha_of(const struct image *im, uint32_t c)
{
	size_t layer = (size_t)(short_name(im->name[c]) - im->name[c]);

	for (uint32_t i = 0; i < im->channels; i++) {
		const char *s = short_name(im->name[i]);

		if ((size_t)(s - im->name[i]) == layer && !strcmp(s, "A") &&
		    !memcmp(im->name[i], im->name[c], layer))
			return (int)i;
	}
	return -1;
}

/* Premultiplied means multiplied in light, before encoding. */
static double convert(const struct image *im, struct image_form form, float value, float alpha,
		      bool has_alpha)
{
	bool covered = has_alpha && !(alpha >= 1); /* opaque samples stay as they are, to the bit */
	bool multiply = covered && form.premultiplied && !im->premultiplied;
	bool divide = covered && !form.premultiplied && im->premultiplied;
	double v = (double)value, a = (double)alpha;

	if (!multiply && !divide && form.encoding == im->encoding)
		return v;
	if (im->encoding == IMAGE_SRGB)
		v = srgb_decode(v);
	if (multiply)
		v *= a;
	else if (divide)
		v = a > 0 ? v / a : 0; /* nothing is seen there */
	if (form.encoding == IMAGE_SRGB)
		v = srgb_encode(v);
	return v;
}

void image_row(const struct image *im, uint32_t y, const uint32_t *channel, uint32_t count,
	       struct image_form form, double *out)
{
	const float *row = im->pixel + (size_t)y * im->width * im->channels;

	for (uint32_t i = 0; i < count; i++) {
		uint32_t c = channel ? channel[i] : i;
		bool colour = image_is_colour(im->name[c]);
		int alpha = colour ? alpha_of(im, c) : -1;

		for (uint32_t x = 0; x < im->width; x++) {
			const float *p = row + (size_t)x * im->channels;

			out[(size_t)x * count + i] =
				!colour ? (double)p[c]
					: convert(im, form, p[c], alpha < 0 ? 1 : p[alpha],
						  alpha >= 0);
		}
	}
}

static uint32_t quantise(double v, double top)
{
	return v >= 1 ? (uint32_t)top : v > 0 ? (uint32_t)(v * top + 0.5) : 0;
}

#define GUESS_LEAST 0x1p-13f /* all below are 0 */
#define GUESS_BITS 0x39000000u /* of that float */
#define GUESS_SHIFT 16 /* so many ranges an octave that none has more than two bytes */

void image_bytes_init(struct image_bytes *b, const struct image_job *job, const struct image_pick *pick,
		      struct image_form form)
{
	const struct image *im = job->image;
	uint32_t q = 0;

	*b = (struct image_bytes){ .image = im, .pick = pick, .form = form, .bits = job->bits };
	b->quick = job->bits == 8 && im->encoding == IMAGE_LINEAR && form.encoding == IMAGE_SRGB;
	for (uint32_t i = 0; b->quick && i < IMAGE_GUESSES; i++) {
		uint32_t bits = GUESS_BITS + (i << GUESS_SHIFT);
		float least;

		memcpy(&least, &bits, sizeof(least));
		while (least >= srgb_least[q + 1])
			q++;
		b->guess[i] = (uint8_t)q;
	}
}

static uint8_t srgb_byte(const struct image_bytes *b, float v)
{
	uint32_t bits;
	uint8_t q;

	if (!(v >= GUESS_LEAST))
		return 0;
	if (v >= 1)
		return 255;
	memcpy(&bits, &v, sizeof(bits));
	q = b->guess[(bits - GUESS_BITS) >> GUESS_SHIFT];
	return (uint8_t)(q + (v >= srgb_least[q + 1]));
}

static void put_integer(uint32_t q, uint32_t bits, unsigned char *out)
{
	if (bits == 16)
		*out++ = (unsigned char)(q >> 8);
	*out = (unsigned char)q;
}

void image_bytes_row(const struct image_bytes *b, uint32_t y, unsigned char *out)
{
	const struct image *im = b->image;
	const float *row = im->pixel + (size_t)y * im->width * im->channels;
	uint32_t count = b->pick->count, size = b->bits / 8;
	double top = b->bits == 8 ? 255 : 65535;

	for (uint32_t i = 0; i < count; i++) {
		uint32_t c = b->pick->channel[i];
		bool colour = image_is_colour(im->name[c]);
		int alpha = colour ? alpha_of(im, c) : -1;
		const float *p = row;
		unsigned char *to = out + (size_t)i * size;

		if (colour && b->quick && alpha < 0) { /* nearly always: nothing to ask for each sample */
			for (uint32_t x = 0; x < im->width; x++, p += im->channels, to += count)
				*to = srgb_byte(b, p[c]);
			continue;
		}
		for (uint32_t x = 0; x < im->width; x++, p += im->channels, to += (size_t)count * size) {
			if (!colour)
				put_integer(quantise((double)p[c], top), b->bits, to);
			else if (b->quick && (alpha < 0 || p[alpha] >= 1))
				*to = srgb_byte(b, p[c]);
			else
				put_integer(quantise(convert(im, b->form, p[c], alpha < 0 ? 1 : p[alpha],
							     alpha >= 0),
						     top),
					    b->bits, to);
		}
	}
}

static int find(const struct image *im, const char *name)
{
	for (uint32_t i = 0; i < im->channels; i++) {
		if (!strcmp(im->name[i], name))
			return (int)i;
	}
	return -1;
}

enum status image_pick(const struct image_job *job, bool alpha, struct image_pick *pick)
{
	static const char *const rgb[] = { "R", "G", "B" };
	const struct image *im = job->image;
	struct diag_pos pos = { .file = job->out->path };
	int a = find(im, "A"), c = find(im, "Y");

	*pick = (struct image_pick){ 0 };
	for (uint32_t i = 0; i < 3 && find(im, rgb[i]) >= 0; i++)
		pick->channel[pick->count++] = (uint32_t)find(im, rgb[i]);
	if (pick->count != 3) {
		pick->count = 0;
		if (c < 0 && im->channels == 1)
			c = 0;
		if (c < 0)
			return diag_fail(job->diag, STATUS_FAILED, &pos,
					 "the picture has neither the channels R, G and B nor Y, "
					 "which this format "
					 "stores; write it as .exr");
		pick->channel[pick->count++] = (uint32_t)c;
	}
	if (im->channels > pick->count + (a >= 0))
		diag_report(
			job->diag, DIAG_WARNING, &pos,
			"this format has no layers: %u of the picture's %u channels are left out "
			"(.exr keeps them)",
			im->channels - pick->count - (a >= 0), im->channels);
	pick->alpha = alpha && a >= 0;
	if (pick->alpha)
		pick->channel[pick->count++] = (uint32_t)a;
	return STATUS_OK;
}
