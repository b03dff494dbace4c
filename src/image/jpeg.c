/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * JPEG (ISO/IEC 10918-1) through libjpeg. Its samples are taken to be along the sRGB curve, as POV-Ray and
 * the web do.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "image/format.h"
#include "image/raw.h"

#ifdef HAVE_JPEG

#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>
#include <jerror.h>

#define SCANS_MAX 1000 /* of a progressive picture: each is a pass over all of it */

struct reader {
	struct jpeg_decompress_struct jpeg;
	struct jpeg_error_mgr error;
	struct jpeg_progress_mgr progress;
	struct jpeg_source_mgr source;
	struct image_in *in;
	jmp_buf out;
	bool ended; /* the file was too short */
	bool damaged; /* a warning said so */
	char text[JMSG_LENGTH_MAX];
	JOCTET buffer[1 << 14];
};

static struct reader *reader_of(j_common_ptr jpeg)
{
	return jpeg->client_data;
}

_Noreturn static void on_error(j_common_ptr jpeg)
{
	struct reader *r = reader_of(jpeg);

	jpeg->err->format_message(jpeg, r->text);
	longjmp(r->out, 1);
}

/* Warnings (level -1) are of damage that libjpeg guesses over; the first is kept. */
static void on_message(j_common_ptr jpeg, int level)
{
	struct reader *r = reader_of(jpeg);

	/* Bytes too many between two markers: some cameras leave them. */
	if (level >= 0 || r->damaged || jpeg->err->msg_code == JWRN_EXTRANEOUS_DATA)
		return;
	jpeg->err->format_message(jpeg, r->text);
	r->damaged = true;
}

static void on_output(j_common_ptr jpeg)
{
	(void)jpeg;
}

static void on_progress(j_common_ptr jpeg)
{
	struct reader *r = reader_of(jpeg);

	if (r->jpeg.input_scan_number <= SCANS_MAX)
		return;
	strcpy(r->text, "too many scans");
	longjmp(r->out, 1);
}

/* Two bytes were read already, to choose the format by. */
static void on_init(j_decompress_ptr jpeg)
{
	struct reader *r = reader_of((j_common_ptr)jpeg);

	r->buffer[0] = r->in->magic[0];
	r->buffer[1] = r->in->magic[1];
	r->source.next_input_byte = r->buffer;
	r->source.bytes_in_buffer = 2;
}

static boolean on_fill(j_decompress_ptr jpeg)
{
	struct reader *r = reader_of((j_common_ptr)jpeg);
	size_t n = fread(r->buffer, 1, sizeof(r->buffer), r->in->file);

	if (!n) {
		r->ended = true;
		longjmp(r->out, 1);
	}
	r->source.next_input_byte = r->buffer;
	r->source.bytes_in_buffer = n;
	return TRUE;
}

static void on_skip(j_decompress_ptr jpeg, long bytes)
{
	struct reader *r = reader_of((j_common_ptr)jpeg);

	while (bytes > (long)r->source.bytes_in_buffer) {
		bytes -= (long)r->source.bytes_in_buffer;
		(void)on_fill(jpeg);
	}
	if (bytes > 0) {
		r->source.next_input_byte += bytes;
		r->source.bytes_in_buffer -= (size_t)bytes;
	}
}

static void on_term(j_decompress_ptr jpeg)
{
	(void)jpeg;
}

/* Progressive pictures keep the coefficients of the whole: two bytes for each, beside the samples. */
static enum status check_memory(struct reader *r, const struct image_raw *raw)
{
	const struct image_limits *l = &r->in->limits;
	double bytes = 2.0 * raw->width * raw->height * r->jpeg.num_components;

	if (!r->jpeg.progressive_mode || !l->bytes || bytes <= (double)l->bytes)
		return STATUS_OK;
	return diag_fail(r->in->diag, STATUS_SCENE, &r->in->pos,
			 "reading this progressive JPEG picture would take %.1f MiB of memory; the limit leaves "
			 "%.1f MiB",
			 bytes / 1048576.0, (double)l->bytes / 1048576.0);
}

static enum status read_rows(struct reader *r, struct image_raw *raw)
{
	size_t stride = (size_t)raw->width * raw->channels;

	(void)jpeg_start_decompress(&r->jpeg);
	while (r->jpeg.output_scanline < r->jpeg.output_height) {
		JSAMPROW row = (JSAMPROW)raw->sample + r->jpeg.output_scanline * stride;

		(void)jpeg_read_scanlines(&r->jpeg, &row, 1);
	}
	(void)jpeg_finish_decompress(&r->jpeg);
	return STATUS_OK;
}

static enum status read_guarded(struct reader *r, struct image_raw *raw)
{
	struct image_in *in = r->in;
	enum status st;

	if (setjmp(r->out)) {
		if (r->ended)
			return image_truncated(in);
		return diag_fail(in->diag, STATUS_SCENE, &in->pos, "this JPEG picture is damaged: %s", r->text);
	}
	jpeg_create_decompress(&r->jpeg);
	r->jpeg.progress = &r->progress;
	r->jpeg.src = &r->source;
	(void)jpeg_read_header(&r->jpeg, TRUE);
	if (r->jpeg.out_color_space != JCS_GRAYSCALE && r->jpeg.out_color_space != JCS_RGB)
		return diag_fail(in->diag, STATUS_SCENE, &in->pos,
				 "this JPEG picture has printing colours (CMYK): convert it to RGB");
	raw->channels = r->jpeg.out_color_space == JCS_GRAYSCALE ? 1 : 3;
	raw->depth = IMAGE_8;
	raw->curve = IMAGE_CURVE_SRGB;
	st = image_raw_take(raw, in, r->jpeg.image_width, r->jpeg.image_height);
	if (!st)
		st = check_memory(r, raw);
	if (st)
		return st;
	return read_rows(r, raw);
}

enum status jpeg_read_raw(struct image_raw *raw, struct image_in *in)
{
	struct reader *r = calloc(1, sizeof(*r));
	enum status st;

	if (!r)
		return diag_no_memory(in->diag, "libjpeg", sizeof(*r));
	r->in = in;
	r->jpeg.err = jpeg_std_error(&r->error);
	r->jpeg.client_data = r;
	r->error.error_exit = on_error;
	r->error.emit_message = on_message;
	r->error.output_message = on_output;
	r->progress.progress_monitor = on_progress;
	r->source.init_source = on_init;
	r->source.fill_input_buffer = on_fill;
	r->source.skip_input_data = on_skip;
	r->source.resync_to_restart = jpeg_resync_to_restart;
	r->source.term_source = on_term;
	st = read_guarded(r, raw);
	jpeg_destroy_decompress(&r->jpeg);
	if (!st && r->damaged)
		diag_report(in->diag, DIAG_WARNING, &in->pos, "this JPEG picture is damaged: %s", r->text);
	free(r);
	return st;
}

#else

/* Through the module, if there is one. */
enum status jpeg_read_raw(struct image_raw *raw, struct image_in *in)
{
	return oiio_read_raw(raw, in, in->pos.file);
}

#endif
