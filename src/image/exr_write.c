/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * OpenEXR (the "OpenEXR File Layout" document) through OpenEXRCore, its C library: one part of scan
 * lines, ZIP, layers named LAYER.CHANNEL, notes as string attributes. Nothing in the file depends
 * on time or machine.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "image/format.h"

#ifdef HAVE_OPENEXR
#include <errno.h>
#include <openexr.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/half.h"

#define LINES 16 /* in a chunk, with ZIP */

struct writer {
	const struct image_job *job;
	exr_context_t exr;
	exr_encode_pipeline_t pipe;
	bool piped; /* pipe is initialised */
	exr_result_t (*compress)(exr_encode_pipeline_t *); /* OpenEXR's */
	bool failed; /* the stream */
	double *row;
	unsigned char *chunk; /* [channel][line][x], as stored */
	bool half[IMAGE_CHANNELS];
};

/* Keeps the library from printing. It may hold its lock here, so its functions can't be asked whose
 * error this is; the result code tells enough. */
static void on_error(exr_const_context_t exr, exr_result_t code, const char *text)
{
	(void)exr;
	(void)code;
	(void)text;
}

static int64_t on_write(exr_const_context_t exr, void *data, const void *bytes, uint64_t n,
			uint64_t offset, exr_stream_error_func_ptr_t error)
{
	struct writer *w = data;
	const char *p = bytes;
	uint64_t done = 0;

	(void)exr;
	(void)error;
	while (done < n) {
		ssize_t k = pwrite(fileno(w->job->out->file), p + done, n - done,
				   (off_t)(offset + done));

		if (k > 0) {
			done += (uint64_t)k;
		} else if (k == 0 || errno != EINTR) {
			if (!w->failed)
				(void)image_out_failed(w->job->out);
			w->failed = true;
			return -1;
		}
	}
	return (int64_t)n;
}

static bool is_light(const char *name)
{
	const char *point = strrchr(name, '.');

	return image_is_colour(name) || !strcmp(point ? point + 1 : name, "A");
}

static exr_result_t add_header(struct writer *w)
{
	const struct image_job *job = w->job;
	const struct image *im = job->image;
	exr_result_t rv;
	int part;

	rv = exr_set_longname_support(w->exr, 1);
	if (!rv)
		rv = exr_add_part(w->exr, "", EXR_STORAGE_SCANLINE, &part);
	if (!rv)
		rv = exr_initialize_required_attr_simple(w->exr, part, (int32_t)im->width,
							 (int32_t)im->height, EXR_COMPRESSION_ZIP);
	for (uint32_t i = 0; i < im->channels && !rv; i++) {
		w->half[i] = job->bits == 16 && is_light(im->name[i]);
		rv = exr_add_channel(w->exr, part, im->name[i],
				     w->half[i] ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
				     EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
	}
	for (uint32_t i = 0; i < job->notes && !rv; i++)
		rv = exr_attr_set_string(w->exr, part, job->note[i].key, job->note[i].value);
	return rv ? rv : exr_write_header(w->exr);
}

/* Rows y .. y + lines - 1 from the image into the chunk. */
static void fill_chunk(struct writer *w, uint32_t y, uint32_t lines)
{
	const struct image *im = w->job->image;
	struct image_form form = { IMAGE_LINEAR, true };
	size_t width = im->width;

	for (uint32_t l = 0; l < lines; l++) {
		image_row(im, y + l, NULL, im->channels, form, w->row);
		for (uint32_t c = 0; c < im->channels; c++) {
			unsigned char *to =
				w->chunk + ((size_t)c * LINES + l) * width * sizeof(float);

			for (size_t x = 0; x < width; x++) {
				float v = (float)w->row[x * im->channels + c];
				uint16_t h = half_from_float(v);

				if (w->half[c])
					memcpy(to + x * sizeof(h), &h, sizeof(h));
				else
					memcpy(to + x * sizeof(v), &v, sizeof(v));
			}
		}
	}
}

static void point_channels(struct writer *w)
{
	const struct image *im = w->job->image;

	for (int i = 0; i < w->pipe.channel_count; i++) {
		exr_coding_channel_info_t *info = &w->pipe.channels[i];
		uint32_t c = 0;

		while (strcmp(im->name[c], info->channel_name))
			c++;
		info->user_data_type = w->half[c] ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
		info->user_bytes_per_element = w->half[c] ? 2 : 4;
		info->user_pixel_stride = info->user_bytes_per_element;
		info->user_line_stride = (int32_t)(im->width * sizeof(float));
		info->encode_from_ptr = w->chunk + (size_t)c * LINES * im->width * sizeof(float);
	}
}

/* A chunk that compression leaves as long as it was would be taken for one that is not compressed:
 * OpenEXR 3.1 writes it compressed nevertheless. */
static exr_result_t compress(exr_encode_pipeline_t *pipe)
{
	const struct writer *w = pipe->encoding_user_data;
	exr_result_t rv = w->compress(pipe);

	if (!rv && pipe->compressed_bytes == pipe->packed_bytes)
		memcpy(pipe->compressed_buffer, pipe->packed_buffer, pipe->packed_bytes);
	return rv;
}

static exr_result_t write_chunk(struct writer *w, uint32_t y)
{
	exr_chunk_info_t info;
	exr_result_t rv = exr_write_scanline_chunk_info(w->exr, 0, (int)y, &info);

	if (rv)
		return rv;
	rv = w->piped ? exr_encoding_update(w->exr, 0, &info, &w->pipe) :
			exr_encoding_initialize(w->exr, 0, &info, &w->pipe);
	if (rv)
		return rv;
	fill_chunk(w, y, (uint32_t)info.height);
	point_channels(w);
	if (!w->piped) {
		rv = exr_encoding_choose_default_routines(w->exr, 0, &w->pipe);
		w->compress = w->pipe.compress_fn;
		w->pipe.compress_fn = compress;
		w->pipe.encoding_user_data = w;
	}
	w->piped = true;
	return rv ? rv : exr_encoding_run(w->exr, 0, &w->pipe);
}

/* Names must be there and differ: the file lists them sorted. */
static enum status check_names(const struct image_job *job)
{
	const struct image *im = job->image;
	struct diag_pos pos = { .file = job->out->path };

	for (uint32_t i = 0; i < im->channels; i++) {
		for (uint32_t k = 0; k < i; k++) {
			if (!strcmp(im->name[i], im->name[k]))
				return diag_fail(job->diag, STATUS_FAILED, &pos,
						 "two channels of the picture are named \"%s\"",
						 im->name[i]);
		}
		if (!im->name[i][0])
			return diag_fail(job->diag, STATUS_FAILED, &pos,
					 "channel %u of the picture has no name", i + 1);
	}
	if (im->width > INT32_MAX / sizeof(float))
		return diag_fail(job->diag, STATUS_FAILED, &pos,
				 "the picture is too wide for .exr");
	return STATUS_OK;
}

static exr_result_t write_all(struct writer *w)
{
	exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
	exr_result_t rv, end;

	init.error_handler_fn = on_error;
	init.write_fn = on_write;
	init.user_data = w;
	init.zip_level = 4;
	rv = exr_start_write(&w->exr, w->job->out->path, EXR_WRITE_FILE_DIRECTLY, &init);
	if (rv)
		return rv;
	rv = add_header(w);
	for (uint32_t y = 0; y < w->job->image->height && !rv; y += LINES)
		rv = write_chunk(w, y);
	if (w->piped)
		(void)exr_encoding_destroy(w->exr, &w->pipe);
	end = exr_finish(&w->exr);
	return rv ? rv : end;
}

enum status exr_write(const struct image_job *job)
{
	struct diag_pos pos = { .file = job->out->path };
	struct writer w = { .job = job, .pipe = EXR_ENCODE_PIPELINE_INITIALIZER };
	size_t n = (size_t)job->image->width * job->image->channels;
	enum status st = check_names(job);
	exr_result_t rv;

	if (st)
		return st;
	w.row = malloc(n * sizeof(*w.row));
	w.chunk = malloc(mem_product(n, LINES * sizeof(float)));
	if (w.row && w.chunk) {
		rv = write_all(&w);
		if (w.failed)
			st = STATUS_FAILED;
		else if (rv)
			st = diag_fail(job->diag, STATUS_FAILED, &pos,
				       "cannot write the picture: %s",
				       exr_get_default_error_message(rv));
	} else {
		st = diag_no_memory(job->diag, "rows of a picture", n * LINES * sizeof(float));
	}
	free(w.row);
	free(w.chunk);
	return st;
}

#else

enum status exr_write(const struct image_job *job)
{
	struct diag_pos pos = { .file = job->out->path };

	return diag_fail(job->diag, STATUS_USAGE, &pos,
			 "this Alidade was built without OpenEXR: install libopenexr-dev and build "
			 "it again, "
			 "or write .pfm (float) or .png");
}

#endif
