/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Strips are deflated (RFC 1951) apart, each with a window of its own and, but for the last, ending on a byte; one
 * after the other they are one stream, whose checksum follows from theirs (RFC 1950).
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "image/png_strips.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "base/pool.h"

#define GROUP 32u /* strips that are held until they are written */
#define LEVEL 3 /* a tenth larger than 6, in a third of the time */
#define WINDOW_BITS 15
#define MEMORY_LEVEL 8 /* what is usual */
#define FILTER_SUB 1
#define HEADER 2 /* of the stream, before the first strip */
#define TRAILER 4 /* its checksum, behind the last */

struct tool { /* a thread's */
	z_stream z;
	bool begun;
	unsigned char *line, *raw; /* a row; a strip, filtered */
};

struct strip {
	unsigned char *data;
	size_t bytes, size; /* compressed, and before */
	uLong sum;
};

struct png_strips {
	struct image_bytes rows;
	struct pool *pool;
	size_t row; /* bytes, without the filter's number */
	uint32_t height, step, count, rows_each; /* step: bytes a pixel */
	uint32_t first; /* strip of the group */
	uint32_t threads;
	atomic_bool no_memory;
	struct strip strip[GROUP];
	struct tool tool[];
};

/* Each sample less the one to the left (PNG, 9.2): trying all filters on each row takes half more time, and files are
 * as large. */
static void filter_row(unsigned char *restrict to, const unsigned char *restrict from, size_t n, size_t step)
{
	*to++ = FILTER_SUB;
	memcpy(to, from, n < step ? n : step);
	for (size_t i = step; i < n; i++)
		to[i] = (unsigned char)(from[i] - from[i - step]);
}

static bool tool_begin(struct tool *t, const struct png_strips *s)
{
	if (t->begun)
		return deflateReset(&t->z) == Z_OK;
	if (!t->line)
		t->line = malloc(s->row);
	if (!t->raw)
		t->raw = malloc(s->rows_each * (s->row + 1));
	t->begun = t->line && t->raw &&
		   deflateInit2(&t->z, LEVEL, Z_DEFLATED, -WINDOW_BITS, MEMORY_LEVEL, Z_FILTERED) == Z_OK;
	return t->begun;
}

static bool compress_strip(struct tool *t, struct strip *out, bool last)
{
	size_t room = deflateBound(&t->z, (uLong)out->size) + HEADER + TRAILER + 16;

	out->data = malloc(room); /* what stays untouched costs nothing */
	if (!out->data)
		return false;
	t->z.next_in = t->raw;
	t->z.avail_in = (uInt)out->size;
	t->z.next_out = out->data + HEADER;
	t->z.avail_out = (uInt)(room - HEADER - TRAILER);
	if (deflate(&t->z, last ? Z_FINISH : Z_FULL_FLUSH) != (last ? Z_STREAM_END : Z_OK) || !t->z.avail_out)
		return false;
	out->bytes = (size_t)(t->z.next_out - out->data) - HEADER;
	out->sum = adler32_z(adler32_z(0, NULL, 0), t->raw, out->size);
	return true;
}

static void strip_job(void *arg, uint32_t i, uint32_t thread)
{
	struct png_strips *s = arg;
	struct tool *t = &s->tool[thread];
	uint32_t number = s->first + i, y = number * s->rows_each;
	uint32_t left = s->height - y, rows = left < s->rows_each ? left : s->rows_each;
	struct strip *out = &s->strip[i];

	if (atomic_load(&s->no_memory) || !tool_begin(t, s)) {
		atomic_store(&s->no_memory, true);
		return;
	}
	for (uint32_t k = 0; k < rows; k++) {
		image_bytes_row(&s->rows, y + k, t->line);
		filter_row(t->raw + k * (s->row + 1), t->line, s->row, s->step);
	}
	out->size = rows * (s->row + 1);
	if (!compress_strip(t, out, number == s->count - 1))
		atomic_store(&s->no_memory, true);
}

struct png_strips *png_strips_new(const struct image_job *job, const struct image_pick *pick)
{
	uint32_t threads = job->pool ? pool_threads(job->pool) : 1;
	struct png_strips *s = calloc(1, sizeof(*s) + threads * sizeof(s->tool[0]));

	if (!s)
		return NULL;
	image_bytes_init(&s->rows, job, pick, (struct image_form){ IMAGE_SRGB, !pick->alpha });
	s->pool = job->pool;
	s->threads = threads;
	s->step = pick->count * (job->bits / 8);
	s->row = (size_t)job->image->width * s->step;
	s->height = job->image->height;
	s->rows_each = s->row + 1 < PNG_STRIP_BYTES ? (uint32_t)(PNG_STRIP_BYTES / (s->row + 1)) : 1;
	s->count = (s->height - 1) / s->rows_each + 1;
	return s;
}

static void free_group(struct png_strips *s)
{
	for (uint32_t i = 0; i < GROUP; i++) {
		free(s->strip[i].data);
		s->strip[i].data = NULL;
	}
}

/* Its data with what stands before the first and behind the last. */
static void put_strip(const struct png_strips *s, uint32_t number, struct strip *t, uLong sum, png_strips_put *put,
		      void *arg)
{
	static const unsigned char header[HEADER] = { 0x78, 0x5e }; /* a window of 32 KiB; compressed fast */
	bool first = !number, last = number == s->count - 1;

	memcpy(t->data, header, HEADER);
	for (unsigned k = 0; k < TRAILER; k++)
		t->data[HEADER + t->bytes + k] = (unsigned char)(sum >> (8 * (TRAILER - 1 - k)));
	put(arg, t->data + (first ? 0 : HEADER), t->bytes + (first ? HEADER : 0) + (last ? TRAILER : 0));
}

bool png_strips_write(struct png_strips *s, png_strips_put *put, void *arg)
{
	uLong sum = adler32_z(0, NULL, 0);

	for (s->first = 0; s->first < s->count; s->first += GROUP) {
		uint32_t n = s->count - s->first < GROUP ? s->count - s->first : GROUP;

		if (s->pool)
			pool_run(s->pool, n, strip_job, s);
		for (uint32_t i = 0; !s->pool && i < n; i++)
			strip_job(s, i, 0);
		if (atomic_load(&s->no_memory))
			return false;
		for (uint32_t i = 0; i < n; i++) {
			sum = adler32_combine(sum, s->strip[i].sum, (z_off_t)s->strip[i].size);
			put_strip(s, s->first + i, &s->strip[i], sum, put, arg);
		}
		free_group(s);
	}
	return true;
}

void png_strips_free(struct png_strips *s)
{
	if (!s)
		return;
	free_group(s);
	for (uint32_t i = 0; i < s->threads; i++) {
		if (s->tool[i].begun)
			(void)deflateEnd(&s->tool[i].z);
		free(s->tool[i].line);
		free(s->tool[i].raw);
	}
	free(s);
}
