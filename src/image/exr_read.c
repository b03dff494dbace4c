/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Reading OpenEXR through OpenEXRCore: the first part, scan lines or tiles (full resolution), half,
 * float and unsigned samples, any data window, which is laid into the display window.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "image/format.h"

#ifdef HAVE_OPENEXR
#include <openexr.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct reader {
	struct image_in *in;
	struct image *image;
	exr_context_t exr;
	exr_decode_pipeline_t pipe;
	bool piped; /* pipe is initialised */
	bool ended; /* the file was too short */
	exr_attr_box2i_t data, display;
	float *chunk; /* [channel][line][x] */
	size_t chunk_size; /* bytes */
};

/* Keeps the library from printing; see exr_write.c. */
static void on_error(exr_const_context_t exr, exr_result_t code, const char *text)
{
	(void)exr;
	(void)code;
	(void)text;
}

static int64_t on_read(exr_const_context_t exr, void *data, void *out, uint64_t n, uint64_t offset,
		       exr_stream_error_func_ptr_t error)
{
	struct reader *r = data;
	char *p = out;
	uint64_t done = 0;
	ssize_t k;

	(void)exr;
	(void)error;
	while (done < n) {
		k = pread(fileno(r->in->file), p + done, n - done, (off_t)(offset + done));
		if (k < 0)
			return -1;
		if (!k) {
			r->ended = true;
			break;
		}
		done += (uint64_t)k;
	}
	return (int64_t)done;
}

static int64_t on_size(exr_const_context_t exr, void *data)
{
	struct reader *r = data;
	struct stat st;

	(void)exr;
	return fstat(fileno(r->in->file), &st) ? -1 : (int64_t)st.st_size;
}

/* R, G, B, A before others; the layer decides first, none being the first of all. */
static int channel_rank(const char *name, size_t *layer)
{
	const char *point = strrchr(name, '.');
	const char *s = point ? point + 1 : name;
	const char *place;

	*layer = (size_t)(s - name);
	place = s[0] && !s[1] ? strchr("RGBA", s[0]) : NULL;
	return place ? (int)(place - "RGBA") : 4;
}

static int by_layer(const void *a, const void *b)
{
	const char *s = a, *t = b;
	size_t n, m;
	int i = channel_rank(s, &n), k = channel_rank(t, &m), c;

	c = memcmp(s, t, n < m ? n : m);
	if (c || n != m)
		return c ? c : n < m ? -1 : 1;
	return i != k ? i - k : strcmp(s, t);
}

static enum status damaged(struct reader *r, exr_result_t rv)
{
	if (r->ended)
		return image_truncated(r->in);
	return diag_fail(r->in->diag, STATUS_SCENE, &r->in->pos, "this EXR picture is damaged: %s",
			 exr_get_default_error_message(rv));
}

static enum status refuse(struct reader *r, const char *what)
{
	return diag_fail(r->in->diag, STATUS_SCENE, &r->in->pos,
			 "%s cannot be read here: convert the picture with oiiotool", what);
}

static uint64_t extent(int32_t min, int32_t max)
{
	return max < min ? 0 : (uint64_t)((int64_t)max - min + 1);
}

static enum status read_channels(struct reader *r)
{
	const exr_attr_chlist_t *list;
	struct image *im = r->image;
	bool half = true;
	exr_result_t rv = exr_get_channels(r->exr, 0, &list);
	enum status st;

	if (rv)
		return damaged(r, rv);
	/* The data window too: the library's chunks are as wide as it is. */
	st = image_check(r->in, extent(r->data.min.x, r->data.max.x),
			 extent(r->data.min.y, r->data.max.y), (uint64_t)list->num_channels);
	if (!st)
		st = image_take(im, r->in, extent(r->display.min.x, r->display.max.x),
				extent(r->display.min.y, r->display.max.y),
				(uint64_t)list->num_channels);
	if (st)
		return st;
	for (int i = 0; i < list->num_channels; i++) {
		const exr_attr_chlist_entry_t *e = &list->entries[i];

		if (e->name.length <= 0 || (size_t)e->name.length >= sizeof(im->name[i]))
			return diag_fail(
				r->in->diag, STATUS_SCENE, &r->in->pos,
				"the name of channel \"%.200s\" is empty or longer than %zu bytes",
				e->name.str, sizeof(im->name[i]) - 1);
		if (e->x_sampling != 1 || e->y_sampling != 1)
			return refuse(r, "a channel with fewer samples than pixels");
		memset(im->name[i], 0, sizeof(im->name[i]));
		memcpy(im->name[i], e->name.str, (size_t)e->name.length);
		half = half && e->pixel_type == EXR_PIXEL_HALF;
	}
	im->bits = half ? 16 : 32;
	im->premultiplied = true;
	qsort(im->name, im->channels, sizeof(im->name[0]), by_layer);
	return STATUS_OK;
}

/* From the decoded chunk, whose first pixel is x0, y0 of the data window's space, into the
 * image. */
static void place(struct reader *r, int64_t x0, int64_t y0, uint32_t width, uint32_t height)
{
	struct image *im = r->image;

	for (int i = 0; i < r->pipe.channel_count; i++) {
		const exr_coding_channel_info_t *info = &r->pipe.channels[i];
		const float *from = r->chunk + (size_t)i * width * height;
		uint32_t c = 0;

		while (strcmp(im->name[c], info->channel_name))
			c++;
		for (uint32_t l = 0; l < height; l++) {
			int64_t y = y0 + l - r->display.min.y;

			for (uint32_t k = 0; k < width && y >= 0 && y < im->height; k++) {
				int64_t x = x0 + k - r->display.min.x;
				float v = from[(size_t)l * width + k];
				uint32_t u;

				if (x < 0 || x >= im->width)
					continue;
				if (info->data_type == EXR_PIXEL_UINT) {
					memcpy(&u, &v, sizeof(u));
					v = (float)u;
				}
				im->pixel[((size_t)y * im->width + (size_t)x) * im->channels + c] =
					v;
			}
		}
	}
}

static enum status decode_chunk(struct reader *r, const exr_chunk_info_t *info, int64_t x0,
				int64_t y0)
{
	uint32_t width = (uint32_t)info->width, height = (uint32_t)info->height;
	size_t plane = mem_product(mem_product(width, height), sizeof(float));
	size_t size = mem_product(plane, r->image->channels);
	exr_result_t rv;

	/* Lines and tiles may reach beyond the window. */
	if (image_check(r->in, width, height, r->image->channels))
		return STATUS_SCENE;
	if (size > r->chunk_size) {
		mem_free(r->chunk);
		r->chunk_size = 0;
		r->chunk = mem_alloc(r->in->book, "pictures", size);
		if (!r->chunk)
			return diag_no_memory(r->in->diag, "a chunk of a picture", size);
		r->chunk_size = size;
	}
	rv = r->piped ? exr_decoding_update(r->exr, 0, info, &r->pipe) :
			exr_decoding_initialize(r->exr, 0, info, &r->pipe);
	if (rv)
		return damaged(r, rv);
	for (int i = 0; i < r->pipe.channel_count; i++) {
		exr_coding_channel_info_t *c = &r->pipe.channels[i];

		c->user_data_type =
			c->data_type == EXR_PIXEL_UINT ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
		c->user_bytes_per_element = 4;
		c->user_pixel_stride = 4;
		c->user_line_stride = (int32_t)(width * 4);
		c->decode_to_ptr = (uint8_t *)r->chunk + (size_t)i * plane;
	}
	rv = r->piped ? EXR_ERR_SUCCESS : exr_decoding_choose_default_routines(r->exr, 0, &r->pipe);
	r->piped = true;
	if (!rv)
		rv = exr_decoding_run(r->exr, 0, &r->pipe);
	if (rv)
		return damaged(r, rv);
	place(r, x0, y0, width, height);
	return STATUS_OK;
}

static enum status read_lines(struct reader *r)
{
	exr_chunk_info_t info;
	enum status st = STATUS_OK;
	int32_t lines;
	exr_result_t rv = exr_get_scanlines_per_chunk(r->exr, 0, &lines);

	if (rv || lines <= 0)
		return damaged(r, rv);
	for (int64_t y = r->data.min.y; y <= r->data.max.y && !st; y += lines) {
		rv = exr_read_scanline_chunk_info(r->exr, 0, (int)y, &info);
		st = rv ? damaged(r, rv) : decode_chunk(r, &info, r->data.min.x, info.start_y);
	}
	return st;
}

static enum status read_tiles(struct reader *r)
{
	exr_chunk_info_t info;
	enum status st = STATUS_OK;
	exr_tile_level_mode_t level;
	exr_tile_round_mode_t round;
	uint32_t w, h;
	int64_t across, down;
	exr_result_t rv = exr_get_tile_descriptor(r->exr, 0, &w, &h, &level, &round);

	if (rv || !w || !h)
		return damaged(r, rv);
	across = ((int64_t)r->data.max.x - r->data.min.x) / w + 1;
	down = ((int64_t)r->data.max.y - r->data.min.y) / h + 1;
	for (int64_t y = 0; y < down && !st; y++) {
		for (int64_t x = 0; x < across && !st; x++) {
			rv = exr_read_tile_chunk_info(r->exr, 0, (int)x, (int)y, 0, 0, &info);
			st = rv ? damaged(r, rv) : decode_chunk(r, &info, r->data.min.x + x * w,
								r->data.min.y + y * h);
		}
	}
	return st;
}

static enum status read_part(struct reader *r)
{
	struct image_in *in = r->in;
	exr_storage_t storage;
	exr_result_t rv;
	int parts = 1;
	enum status st;

	rv = exr_get_count(r->exr, &parts);
	if (!rv)
		rv = exr_get_storage(r->exr, 0, &storage);
	if (!rv)
		rv = exr_get_data_window(r->exr, 0, &r->data);
	if (!rv)
		rv = exr_get_display_window(r->exr, 0, &r->display);
	if (rv)
		return damaged(r, rv);
	if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
		return refuse(r, "a deep picture (many samples a pixel)");
	if (parts > 1)
		diag_report(in->diag, DIAG_WARNING, &in->pos,
			    "the file has %d parts; only the first is read", parts);
	st = read_channels(r);
	if (st)
		return st;
	if (memcmp(&r->data, &r->display, sizeof(r->data)))
		memset(r->image->pixel, 0, (size_t)r->image->width * r->image->height *
						   r->image->channels * sizeof(float));
	return storage == EXR_STORAGE_TILED ? read_tiles(r) : read_lines(r);
}

enum status exr_read(struct image *im, struct image_in *in)
{
	exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
	struct reader r = { .in = in, .image = im, .pipe = EXR_DECODE_PIPELINE_INITIALIZER };
	enum status st;
	exr_result_t rv;

	if (lseek(fileno(in->file), 0, SEEK_CUR) < 0)
		return diag_fail(in->diag, STATUS_SCENE, &in->pos,
				 "an EXR picture cannot be read from a pipe: name its file");
	init.error_handler_fn = on_error;
	init.read_fn = on_read;
	init.size_fn = on_size;
	init.user_data = &r;
	rv = exr_start_read(&r.exr, in->pos.file, &init);
	if (rv)
		return damaged(&r, rv);
	st = read_part(&r);
	if (r.piped)
		(void)exr_decoding_destroy(r.exr, &r.pipe);
	(void)exr_finish(&r.exr);
	mem_free(r.chunk);
	return st;
}

#else

enum status exr_read(struct image *im, struct image_in *in)
{
	(void)im;
	return diag_fail(in->diag, STATUS_SCENE, &in->pos,
			 "this Alidade was built without OpenEXR and cannot read .exr: install "
			 "libopenexr-dev and "
			 "build it again, or convert the picture to .pfm");
}

#endif
