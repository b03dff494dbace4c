/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * PNG (ISO/IEC 15948) through libpng. Written with 8 or 16 bits, straight alpha and the sRGB chunk;
 * notes as tEXt, or iTXt where they are not ASCII; never the time, so that the same picture gives
 * the same bytes.
 */
#include "image/png_in.h"

#include <math.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include "image/png_strips.h"

static void on_error(png_structp png, png_const_charp text)
{
	struct png_trouble *t = png_get_error_ptr(png);

	strncpy(t->text, text, sizeof(t->text) - 1);
	png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp text)
{
	(void)png;
	(void)text;
}

static void on_read(png_structp png, png_bytep data, size_t n)
{
	struct png_in *r = png_get_io_ptr(png);

	if (fread(data, 1, n, r->in->file) == n)
		return;
	r->ended = true;
	png_error(png, "the file ends early");
}

enum status png_in_begin(struct png_in *r)
{
	r->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r->trouble, on_error, on_warning);
	r->info = r->png ? png_create_info_struct(r->png) : NULL;
	return r->info ? STATUS_OK : diag_no_memory(r->in->diag, "libpng", 0);
}

void png_in_header(struct png_in *r)
{
	png_set_read_fn(r->png, r, on_read);
	png_set_user_limits(r->png, 0x7fffffff, 0x7fffffff);
	png_set_chunk_malloc_max(r->png, 4 << 20);
	png_set_sig_bytes(r->png, 2);
	png_read_info(r->png, r->info);
}

enum status png_in_failed(struct png_in *r)
{
	if (r->ended)
		return image_truncated(r->in);
	return diag_fail(r->in->diag, STATUS_SCENE, &r->in->pos, "this PNG picture is damaged: %s",
			 r->trouble.text);
}

void png_in_end(struct png_in *r)
{
	png_destroy_read_struct(&r->png, &r->info, NULL);
}

struct reader {
	struct png_in in;
	unsigned char *bytes; /* the whole picture: interlaced ones come in seven passes */
	size_t stride;
};

/* What the file says of its colours. */
static enum image_encoding encoding_of(png_structp png, png_infop info, double *gamma)
{
	int intent;

	*gamma = 0;
	if (png_get_sRGB(png, info, &intent) || !png_get_gAMA(png, info, gamma))
		return IMAGE_SRGB;
	if (*gamma > 0.99 && *gamma < 1.01) {
		*gamma = 0;
		return IMAGE_LINEAR;
	}
	/* 1/2.2 is what writers that mean sRGB put there. */
	if (*gamma > 0.45 && *gamma < 0.46)
		*gamma = 0;
	return *gamma > 0 ? IMAGE_LINEAR : IMAGE_SRGB;
}

static enum status read_header(struct reader *r, struct image *im)
{
	png_structp png = r->in.png;
	png_infop info = r->in.info;

	png_in_header(&r->in);
	png_set_expand(png);
	(void)png_set_interlace_handling(png);
	png_read_update_info(png, info);
	im->bits = png_get_bit_depth(png, info) == 16 ? 16 : 8;
	return image_take(im, r->in.in, png_get_image_width(png, info),
			  png_get_image_height(png, info), png_get_channels(png, info));
}

void png_in_rows(struct png_in *r, unsigned char *bytes, size_t stride, uint32_t height)
{
	int passes = png_get_interlace_type(r->png, r->info) == PNG_INTERLACE_ADAM7 ? 7 : 1;

	for (int i = 0; i < passes; i++) {
		for (uint32_t y = 0; y < height; y++)
			png_read_row(r->png, bytes + y * stride, NULL);
	}
	png_read_end(r->png, NULL);
}

static enum status read_bytes(struct reader *r, const struct image *im)
{
	size_t size;

	r->stride = (size_t)im->width * im->channels * (im->bits / 8);
	size = mem_product(r->stride, im->height);
	r->bytes = mem_alloc(r->in.in->book, "pictures", size);
	if (!r->bytes)
		return diag_no_memory(r->in.in->diag, "a picture's file", size);
	png_in_rows(&r->in, r->bytes, r->stride, im->height);
	return STATUS_OK;
}

static void decode(const struct reader *r, struct image *im)
{
	size_t n = (size_t)im->width * im->height * im->channels;
	bool alpha = im->channels == 2 || im->channels == 4;
	double gamma;

	im->encoding = encoding_of(r->in.png, r->in.info, &gamma);
	for (size_t i = 0; i < n; i++) {
		const unsigned char *b = r->bytes + i * (im->bits / 8);
		double v = im->bits == 16 ? (b[0] << 8 | b[1]) / 65535.0 : b[0] / 255.0;

		if (gamma > 0 && !(alpha && i % im->channels == im->channels - 1))
			v = pow(v, 1 / gamma);
		im->pixel[i] = (float)v;
	}
}

/* In a function of its own, so that nothing local is lost when libpng jumps back here. */
static enum status read_guarded(struct reader *r, struct image *im)
{
	enum status st;

	if (setjmp(png_jmpbuf(r->in.png)))
		return png_in_failed(&r->in);
	st = read_header(r, im);
	return st ? st : read_bytes(r, im);
}

enum status png_read(struct image *im, struct image_in *in)
{
	struct reader r = { .in = { .in = in } };
	enum status st = png_in_begin(&r.in);

	if (!st)
		st = read_guarded(&r, im);
	if (!st)
		decode(&r, im);
	mem_free(r.bytes);
	png_in_end(&r.in);
	return st;
}

struct writer {
	const struct image_job *job;
	struct image_pick pick;
	png_structp png;
	png_infop info;
	bool failed; /* the stream */
	struct png_trouble trouble;
	struct png_strips *strips;
	png_text *text;
};

static void on_write(png_structp png, png_bytep data, size_t n)
{
	struct writer *w = png_get_io_ptr(png);

	if (fwrite(data, 1, n, w->job->out->file) == n)
		return;
	w->failed = true;
	(void)image_out_failed(w->job->out);
	png_error(png, "the file cannot be written");
}

static void on_flush(png_structp png)
{
	(void)png; /* image_out_finish() does */
}

static bool is_ascii(const char *s)
{
	while (*s > 0)
		s++;
	return !*s;
}

static void write_notes(struct writer *w)
{
	const struct image_job *job = w->job;

	for (uint32_t i = 0; i < job->notes; i++) {
		/* libpng does not write through these pointers. */
		w->text[i].key = (char *)(uintptr_t)job->note[i].key;
		w->text[i].text = (char *)(uintptr_t)job->note[i].value;
		w->text[i].compression = is_ascii(job->note[i].value) ? PNG_TEXT_COMPRESSION_NONE
								     : PNG_ITXT_COMPRESSION_NONE;
	}
	if (job->notes)
		png_set_text(w->png, w->info, w->text, (int)job->notes);
}

static void put_strip(void *arg, const unsigned char *data, size_t n)
{
	png_write_chunk(((struct writer *)arg)->png, (png_const_bytep)"IDAT", data, n);
}

static enum status write_guarded(struct writer *w)
{
	static const int colour_type[] = { PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
					   PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA };
	const struct image_job *job = w->job;
	const struct image *im = job->image;
	struct diag_pos pos = { .file = job->out->path };

	if (setjmp(png_jmpbuf(w->png))) {
		if (w->failed)
			return STATUS_FAILED;
		return diag_fail(job->diag, STATUS_FAILED, &pos, "cannot write the picture: %s",
				 w->trouble.text);
	}
	png_set_write_fn(w->png, w, on_write, on_flush);
	png_set_user_limits(w->png, 0x7fffffff, 0x7fffffff);
	png_set_IHDR(w->png, w->info, im->width, im->height, (int)job->bits,
		     colour_type[w->pick.count - 1], PNG_INTERLACE_NONE,
		     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
	png_set_sRGB_gAMA_and_cHRM(w->png, w->info, PNG_sRGB_INTENT_PERCEPTUAL);
	write_notes(w);
	png_write_info(w->png, w->info);
	if (!png_strips_write(w->strips, put_strip, w))
		return diag_no_memory(job->diag, "strips of a picture", PNG_STRIP_BYTES);
	png_write_chunk(w->png, (png_const_bytep)"IEND", NULL, 0); /* png_write_end() wants rows of its own */
	return STATUS_OK;
}

static enum status check_notes(const struct image_job *job)
{
	for (uint32_t i = 0; i < job->notes; i++) {
		size_t n = strlen(job->note[i].key);

		if (!n || n > 79 || !is_ascii(job->note[i].key))
			return diag_fail(job->diag, STATUS_FAILED, NULL,
					 "\"%s\" cannot be the name of a note in a PNG file",
					 job->note[i].key);
	}
	return STATUS_OK;
}

enum status png_write(const struct image_job *job)
{
	struct diag_pos pos = { .file = job->out->path };
	struct writer w = { .job = job };
	enum status st = image_pick(job, true, &w.pick);

	if (!st && (size_t)job->image->width * w.pick.count * (job->bits / 8) > PNG_STRIPS_ROW)
		st = diag_fail(job->diag, STATUS_FAILED, &pos, "the picture is too wide for .png");
	if (!st)
		st = check_notes(job);
	if (st)
		return st;
	w.strips = png_strips_new(job, &w.pick);
	w.text = calloc(job->notes + 1, sizeof(*w.text));
	w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &w.trouble, on_error, on_warning);
	w.info = w.png ? png_create_info_struct(w.png) : NULL;
	if (w.strips && w.text && w.info)
		st = write_guarded(&w);
	else
		st = diag_no_memory(job->diag, "strips of a picture", PNG_STRIP_BYTES);
	png_destroy_write_struct(&w.png, &w.info);
	png_strips_free(w.strips);
	free(w.text);
	return st;
}
