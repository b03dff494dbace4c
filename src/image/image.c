/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pictures in memory, and which format reads or writes a file.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "image/format.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#define DEFAULT_PIXELS ((uint64_t)1 << 31)
#define DEFAULT_BYTES ((uint64_t)8 << 30)

struct format {
	const char *ending[4];
	enum status (*write)(const struct image_job *);
	uint32_t bits[3]; /* what it can store; the first is its usual one */
	bool streams; /* can be written to standard output */
	enum image_encoding encoding;
};

static const struct format formats[] = {
	{ { ".png" }, png_write, { 8, 16 }, true, IMAGE_SRGB },
	{ { ".exr" }, exr_write, { 32, 16 }, false, IMAGE_LINEAR },
	{ { ".ppm", ".pgm", ".pnm" }, pnm_write, { 8, 16 }, true, IMAGE_SRGB },
	{ { ".pfm" }, pfm_write, { 32 }, true, IMAGE_LINEAR },
};

static const struct format other = { { NULL }, oiio_write, { 0 }, false, IMAGE_SRGB };

static const char *ending_of(const char *path)
{
	const char *slash = strrchr(path, '/');
	const char *point = strrchr(slash ? slash : path, '.');

	return point ? point : "";
}

/* "-" alone is a PNG. */
static const struct format *format_of(const char *path)
{
	const char *ending = strcmp(path, "-") ? ending_of(path) : ".png";

	for (size_t i = 0; i < sizeof(formats) / sizeof(*formats); i++) {
		for (size_t k = 0; k < 4 && formats[i].ending[k]; k++) {
			if (!strcasecmp(ending, formats[i].ending[k]))
				return &formats[i];
		}
	}
	return ending[0] && ending[1] ? &other : NULL;
}

enum image_encoding image_file_encoding(const char *path)
{
	const struct format *f = format_of(path);

	return f ? f->encoding : IMAGE_SRGB;
}

static bool is_standard(const char *path)
{
	return !strcmp(path, "-") || !strncmp(path, "-.", 2);
}

static enum status check_format(const char *path, uint32_t *bits, const struct format **out,
				struct diag *diag)
{
	const struct format *f = format_of(path);
	struct diag_pos pos = { .file = path };

	*out = f;
	if (!f)
		return diag_fail(
			diag, STATUS_USAGE, &pos,
			"the picture's format is chosen by the ending of its name: use .png, .exr, "
			".ppm or .pfm");
	if (is_standard(path) && !f->streams)
		return diag_fail(
			diag, STATUS_USAGE, &pos,
			"this format cannot be written to standard output: use -.png, -.ppm or "
			"-.pfm, or name a file");
	if (f == &other)
		return oiio_can_write(path, *bits, diag);
	if (!*bits)
		*bits = f->bits[0];
	for (size_t i = 0; i < 3 && f->bits[i]; i++) {
		if (*bits == f->bits[i])
			return STATUS_OK;
	}
	if (!f->bits[1])
		return diag_fail(diag, STATUS_USAGE, &pos,
				 "%s stores %" PRIu32 " bits, not %" PRIu32, f->ending[0],
				 f->bits[0], *bits);
	return diag_fail(diag, STATUS_USAGE, &pos,
			 "%s stores %" PRIu32 " or %" PRIu32 " bits, not %" PRIu32, f->ending[0],
			 f->bits[0], f->bits[1], *bits);
}

enum status image_can_write(const char *path, uint32_t bits, struct diag *diag)
{
	const struct format *f;
	enum status st = check_format(path, &bits, &f, diag);

	return st ? st : image_out_check(path, diag);
}

enum status image_write(const struct image *im, const char *path, uint32_t bits,
			const struct image_note *note, uint32_t notes, struct pool *pool, struct diag *diag)
{
	struct image_out out;
	struct image_job job = { im, bits, note, notes, &out, pool, diag };
	const struct format *f;
	enum status st;

	st = check_format(path, &job.bits, &f, diag);
	if (!st)
		st = image_out_open(&out, path, ending_of(path), diag);
	if (st)
		return st;
	st = f->write(&job);
	if (st) {
		image_out_drop(&out);
		return st;
	}
	return image_out_finish(&out);
}

static void name_channels(struct image *im)
{
	static const char *const name[4][4] = {
		{ "Y" }, { "Y", "A" }, { "R", "G", "B" }, { "R", "G", "B", "A" }
	};

	for (uint32_t i = 0; i < im->channels && im->channels <= 4; i++)
		strcpy(im->name[i], name[im->channels - 1][i]);
}

/* Bytes of the samples, 0 if the size is none. */
static size_t sample_bytes(uint64_t width, uint64_t height, uint64_t channels)
{
	uint64_t n;

	if (!width || !height || !channels || channels > IMAGE_CHANNELS || width > INT32_MAX ||
	    height > INT32_MAX ||
	    __builtin_mul_overflow(width * height, channels * sizeof(float), &n) ||
	    n > SIZE_MAX / 2)
		return 0;
	return (size_t)n;
}

enum status image_init(struct image *im, struct mem_book *book, uint32_t width, uint32_t height,
		       uint32_t channels, struct diag *diag)
{
	size_t bytes = sample_bytes(width, height, channels);

	memset(im, 0, sizeof(*im));
	if (!bytes)
		return diag_fail(diag, STATUS_FAILED, NULL,
				 "a picture of %" PRIu32 " x %" PRIu32 " pixels with %" PRIu32
				 " channels cannot be made",
				 width, height, channels);
	im->pixel = mem_zalloc(book, "pictures", bytes);
	if (!im->pixel)
		return diag_no_memory(diag, "a picture", bytes);
	im->width = width;
	im->height = height;
	im->channels = channels;
	name_channels(im);
	return STATUS_OK;
}

void image_release(struct image *im)
{
	mem_free(im->pixel);
	im->pixel = NULL;
}

enum status image_check(struct image_in *in, uint64_t width, uint64_t height, uint64_t channels)
{
	uint64_t pixels = in->limits.pixels ? in->limits.pixels : DEFAULT_PIXELS;
	uint64_t limit = in->limits.bytes ? in->limits.bytes : DEFAULT_BYTES;
	size_t bytes;

	if (!width || !height)
		return diag_fail(in->diag, STATUS_SCENE, &in->pos, "the picture has no pixels");
	if (channels > IMAGE_CHANNELS)
		return diag_fail(in->diag, STATUS_SCENE, &in->pos,
				 "the picture has %" PRIu64 " channels; at most %d can be read",
				 channels, IMAGE_CHANNELS);
	bytes = sample_bytes(width, height, channels);
	if (!bytes || width > pixels / height)
		return diag_fail(in->diag, STATUS_SCENE, &in->pos,
				 "the picture claims %" PRIu64 " x %" PRIu64
				 " pixels; at most %" PRIu64 " are read",
				 width, height, pixels);
	if (bytes > limit)
		return diag_fail(in->diag, STATUS_SCENE, &in->pos,
				 "the picture would take %.0f MiB of memory; the limit is %.0f MiB",
				 (double)bytes / 1048576.0, (double)limit / 1048576.0);
	return STATUS_OK;
}

enum status image_take(struct image *im, struct image_in *in, uint64_t width, uint64_t height,
		       uint64_t channels)
{
	enum status st = image_check(in, width, height, channels);
	size_t bytes = sample_bytes(width, height, channels);

	if (st)
		return st;
	im->pixel = mem_alloc(in->book, "pictures", bytes);
	if (!im->pixel)
		return diag_no_memory(in->diag, "a picture", bytes);
	im->width = (uint32_t)width;
	im->height = (uint32_t)height;
	im->channels = (uint32_t)channels;
	name_channels(im);
	return STATUS_OK;
}

enum status image_truncated(struct image_in *in)
{
	if (ferror(in->file))
		return diag_fail(in->diag, STATUS_SCENE, &in->pos, "cannot read the picture: %s",
				 strerror(errno));
	return diag_fail(
		in->diag, STATUS_SCENE, &in->pos,
		"the picture's file ends before its last pixel: it is damaged or was cut short");
}

enum status image_in_open(struct image_in *in, const char *path)
{
	struct stat st;

	if (!strcmp(path, "-")) {
		in->pos.file = "standard input";
		in->file = stdin;
	} else {
		in->file = fopen(path, "rbe");
	}
	if (!in->file || fstat(fileno(in->file), &st))
		return diag_fail(in->diag, STATUS_SCENE, &in->pos, "cannot open the picture: %s",
				 strerror(errno));
	if (S_ISDIR(st.st_mode))
		return diag_fail(in->diag, STATUS_SCENE, &in->pos,
				 "cannot read a picture from a folder");
	if (fread(in->magic, 1, 2, in->file) != 2) {
		if (ferror(in->file))
			return image_truncated(in);
		return diag_fail(in->diag, STATUS_SCENE, &in->pos,
				 "this is no picture: the file %s",
				 st.st_size ? "has but one byte" : "is empty");
	}
	return STATUS_OK;
}

void image_in_close(struct image_in *in)
{
	if (in->file && in->file != stdin)
		fclose(in->file);
	in->file = NULL;
}

enum status image_read(struct image *im, const char *path, struct mem_book *book,
		       const struct image_limits *limits, struct diag *diag)
{
	struct image_in in = { .pos = { .file = path }, .book = book, .diag = diag };
	enum status st;

	memset(im, 0, sizeof(*im));
	if (limits)
		in.limits = *limits;
	st = image_in_open(&in, path);
	if (st)
		;
	else if (!memcmp(in.magic, "P5", 2) || !memcmp(in.magic, "P6", 2))
		st = pnm_read(im, &in);
	else if (!memcmp(in.magic, "PF", 2) || !memcmp(in.magic, "Pf", 2))
		st = pfm_read(im, &in);
	else if (!memcmp(in.magic, "\x89P", 2))
		st = png_read(im, &in);
	else if (!memcmp(in.magic, "v/", 2))
		st = exr_read(im, &in);
	else
		st = oiio_read(im, &in, path);
	image_in_close(&in);
	if (st)
		image_release(im);
	return st;
}
