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

#include "base/pool.h"
#include "image/half.h"

#define LINES 16 /* in a chunk, with ZIP */
#define GROUP 32u /* chunks that are held until they are written */

struct writer;

struct tool { /* a thread's */
	struct writer *w;
	exr_encode_pipeline_t pipe;
	bool piped; /* pipe is initialised */
	exr_result_t (*compress)(exr_encode_pipeline_t *); /* OpenEXR's */
	double *row;
	unsigned char *chunk; /* [channel][line][x], as stored */
	struct packed *to; /* where the chunk goes that is made */
};

struct packed { /* a chunk as it will be in the file */
	unsigned char *data;
	size_t size;
	exr_result_t rv;
};

struct writer {
	const struct image_job *job;
	exr_context_t exr;
	bool failed; /* the stream */
	bool half[IMAGE_CHANNELS];
	uint32_t first; /* chunk of the group */
	struct packed packed[GROUP];
	uint32_t threads;
	struct tool *tool;
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
static void fill_chunk(const struct writer *w, struct tool *t, uint32_t y, uint32_t lines)
{
	const struct image *im = w->job->image;
	struct image_form form = { IMAGE_LINEAR, true };
	size_t width = im->width;

	for (uint32_t l = 0; l < lines; l++) {
		image_row(im, y + l, NULL, im->channels, form, t->row);
		for (uint32_t c = 0; c < im->channels; c++) {
			unsigned char *to =
				t->chunk + ((size_t)c * LINES + l) * width * sizeof(float);

			for (size_t x = 0; x < width; x++) {
				float v = (float)t->row[x * im->channels + c];
				uint16_t h = half_from_float(v);

				if (w->half[c])
					memcpy(to + x * sizeof(h), &h, sizeof(h));
				else
					memcpy(to + x * sizeof(v), &v, sizeof(v));
			}
		}
	}
}

static void point_channels(const struct writer *w, struct tool *t)
{
	const struct image *im = w->job->image;

	for (int i = 0; i < t->pipe.channel_count; i++) {
		exr_coding_channel_info_t *info = &t->pipe.channels[i];
		uint32_t c = 0;

		while (strcmp(im->name[c], info->channel_name))
			c++;
		info->user_data_type = w->half[c] ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
		info->user_bytes_per_element = w->half[c] ? 2 : 4;
		info->user_pixel_stride = info->user_bytes_per_element;
		info->user_line_stride = (int32_t)(im->width * sizeof(float));
		info->encode_from_ptr = t->chunk + (size_t)c * LINES * im->width * sizeof(float);
	}
}

/* A chunk that compression leaves as long as it was would be taken for one that is not compressed:
 * OpenEXR 3.1 writes it compressed nevertheless. */
static exr_result_t compress(exr_encode_pipeline_t *pipe)
{
	const struct tool *t = pipe->encoding_user_data;
	exr_result_t rv = t->compress(pipe);

	if (!rv && pipe->compressed_bytes == pipe->packed_bytes)
		memcpy(pipe->compressed_buffer, pipe->packed_buffer, pipe->packed_bytes);
	return rv;
}

/* Instead of into the file, where chunks have to be in order. */
static exr_result_t keep(exr_encode_pipeline_t *pipe)
{
	const struct tool *t = pipe->encoding_user_data;

	t->to->data = malloc(pipe->compressed_bytes + 1);
	if (!t->to->data)
		return EXR_ERR_OUT_OF_MEMORY;
	memcpy(t->to->data, pipe->compressed_buffer, pipe->compressed_bytes);
	t->to->size = pipe->compressed_bytes;
	return EXR_ERR_SUCCESS;
}

static exr_result_t tool_begin(struct tool *t, const exr_chunk_info_t *info)
{
	struct writer *w = t->w;
	size_t n = (size_t)w->job->image->width * w->job->image->channels;

	if (t->piped)
		return exr_encoding_update(w->exr, 0, info, &t->pipe);
	t->row = t->row ? t->row : malloc(n * sizeof(*t->row));
	t->chunk = t->chunk ? t->chunk : malloc(mem_product(n, LINES * sizeof(float)));
	return t->row && t->chunk ? exr_encoding_initialize(w->exr, 0, info, &t->pipe) : EXR_ERR_OUT_OF_MEMORY;
}

static exr_result_t pack(struct tool *t, uint32_t y)
{
	struct writer *w = t->w;
	exr_chunk_info_t info;
	exr_result_t rv = exr_write_scanline_chunk_info(w->exr, 0, (int)y, &info);

	if (!rv)
		rv = tool_begin(t, &info);
	if (rv)
		return rv;
	fill_chunk(w, t, y, (uint32_t)info.height);
	point_channels(w, t);
	if (!t->piped) {
		rv = exr_encoding_choose_default_routines(w->exr, 0, &t->pipe);
		t->compress = t->pipe.compress_fn;
		t->pipe.compress_fn = compress;
		t->pipe.yield_until_ready_fn = NULL; /* it wants chunks in order */
		t->pipe.write_fn = keep;
		t->pipe.encoding_user_data = t;
	}
	t->piped = true;
	return rv ? rv : exr_encoding_run(w->exr, 0, &t->pipe);
}

static void pack_job(void *arg, uint32_t i, uint32_t thread)
{
	struct writer *w = arg;
	struct tool *t = &w->tool[thread];

	t->to = &w->packed[i];
	t->to->rv = pack(t, (w->first + i) * LINES);
}

/* n chunks from w->first on. */
static exr_result_t write_group(struct writer *w, uint32_t n)
{
	exr_result_t rv = EXR_ERR_SUCCESS;

	memset(w->packed, 0, sizeof(w->packed));
	if (w->job->pool)
		pool_run(w->job->pool, n, pack_job, w);
	for (uint32_t i = 0; !w->job->pool && i < n; i++)
		pack_job(w, i, 0);
	for (uint32_t i = 0; i < n; i++) {
		const struct packed *p = &w->packed[i];

		rv = rv ? rv : p->rv;
		if (!rv)
			rv = exr_write_scanline_chunk(w->exr, 0, (int)((w->first + i) * LINES), p->data, p->size);
		free(p->data);
	}
	return rv;
}

static bool make_tools(struct writer *w)
{
	w->threads = w->job->pool ? pool_threads(w->job->pool) : 1;
	w->tool = calloc(w->threads, sizeof(*w->tool));
	for (uint32_t i = 0; w->tool && i < w->threads; i++)
		w->tool[i] = (struct tool){ .w = w, .pipe = EXR_ENCODE_PIPELINE_INITIALIZER };
	return w->tool;
}

/* While the file is open still. */
static void free_tools(struct writer *w)
{
	for (uint32_t i = 0; w->tool && i < w->threads; i++) {
		struct tool *t = &w->tool[i];

		if (t->piped)
			(void)exr_encoding_destroy(w->exr, &t->pipe);
		free(t->row);
		free(t->chunk);
	}
	free(w->tool);
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
	uint32_t count = (w->job->image->height - 1) / LINES + 1;
	exr_result_t rv, end;

	init.error_handler_fn = on_error;
	init.write_fn = on_write;
	init.user_data = w;
	init.zip_level = 4;
	rv = exr_start_write(&w->exr, w->job->out->path, EXR_WRITE_FILE_DIRECTLY, &init);
	if (rv)
		return rv;
	rv = add_header(w);
	if (!rv && !make_tools(w))
		rv = EXR_ERR_OUT_OF_MEMORY;
	for (w->first = 0; w->first < count && !rv; w->first += GROUP)
		rv = write_group(w, count - w->first < GROUP ? count - w->first : GROUP);
	free_tools(w);
	end = exr_finish(&w->exr);
	return rv ? rv : end;
}

enum status exr_write(const struct image_job *job)
{
	struct diag_pos pos = { .file = job->out->path };
	struct writer w = { .job = job };
	enum status st = check_names(job);
	exr_result_t rv;

	if (st)
		return st;
	rv = write_all(&w);
	if (w.failed)
		return STATUS_FAILED;
	if (rv == EXR_ERR_OUT_OF_MEMORY)
		return diag_no_memory(job->diag, "chunks of a picture",
				      (uint64_t)job->image->width * job->image->channels * LINES * sizeof(float));
	if (rv)
		return diag_fail(job->diag, STATUS_FAILED, &pos, "cannot write the picture: %s",
				 exr_get_default_error_message(rv));
	return STATUS_OK;
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
