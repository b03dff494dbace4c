/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Every other format, through the OpenImageIO module.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "image/format.h"

#include <dlfcn.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/process.h"
#include "image/oiio/io_oiio.h"
#include "image/raw.h"

#define FILE_NAME "io_oiio.so"

static const char *module_path(void)
{
#ifdef HAVE_SECURE_GETENV
	const char *path = secure_getenv("ALIDADE_MODULE_PATH");
#else
	const char *path = NULL;
#endif

	return path && *path ? path : ALIDADE_MODULE_DIR;
}

/* The first module on the path, a list of folders with colons between; NULL: none. Freed by the
 * caller. */
static char *module_file(void)
{
	const char *p = module_path();
	char *file;

	while (*p) {
		size_t n = strcspn(p, ":");

		/* An empty entry would be the working folder, which anybody may have filled. */
		if (n && asprintf(&file, "%.*s/" FILE_NAME, (int)n, p) >= 0) {
			if (!access(file, F_OK))
				return file;
			free(file);
		}
		p += n + (p[n] == ':');
	}
	return NULL;
}

/* The module stays loaded once it is: OpenImageIO has threads and caches of its own. st: the status
 * of a failure. */
static const struct io_oiio *load(const struct diag_pos *pos, enum status st, struct diag *diag)
{
	char *file = module_file();
	const struct io_oiio *io = NULL;
	void *handle;

	if (!file) {
		(void)diag_fail(diag, st, pos,
				"this picture's format needs the OpenImageIO module, and there is "
				"no " FILE_NAME
				" in %s: use .png, .exr, .ppm or .pfm, or build Alidade where "
				"libopenimageio-dev is installed",
				module_path());
		return NULL;
	}
	handle = process_load(file, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
	if (handle)
		io = dlsym(handle, IO_OIIO_SYMBOL);
	if (!io)
		(void)diag_fail(diag, st, pos, "the OpenImageIO module cannot be loaded: %s",
				dlerror());
	else if (io->abi != IO_OIIO_ABI || io->size != sizeof(*io)) {
		(void)diag_fail(diag, st, pos, "%s belongs to another version of Alidade", file);
		io = NULL;
	}
	if (handle)
		dlclose(handle);
	free(file);
	return io;
}

struct taking {
	struct image *image;
	struct image_in *in;
	enum status status;
};

static float *take(void *arg, const struct io_oiio_header *h)
{
	struct taking *t = arg;
	struct image *im = t->image;

	t->status = image_take(im, t->in, h->width, h->height, h->channels);
	if (t->status)
		return NULL;
	im->bits = h->bits;
	im->encoding = h->linear ? IMAGE_LINEAR : IMAGE_SRGB;
	im->premultiplied = true;
	for (uint32_t i = 0; i < im->channels && im->channels > 2; i++)
		snprintf(im->name[i], sizeof(im->name[i]), "%s", h->name[i]);
	return im->pixel;
}

enum status oiio_read(struct image *im, struct image_in *in, const char *path)
{
	struct taking t = { im, in, STATUS_OK };
	const struct io_oiio *io;
	char error[512];

	if (in->file == stdin)
		return diag_fail(in->diag, STATUS_SCENE, &in->pos,
				 "this is neither a PNG nor a PPM or PFM picture; other formats "
				 "cannot be read "
				 "from standard input");
	io = load(&in->pos, STATUS_SCENE, in->diag);
	if (!io)
		return STATUS_SCENE;
	switch (io->read(path, take, &t, error, sizeof(error))) {
	case 0:
		return STATUS_OK;
	case 2:
		return t.status;
	default:
		return diag_fail(in->diag, STATUS_SCENE, &in->pos, "cannot read the picture: %s",
				 error);
	}
}

struct raw_taking {
	struct image_raw *raw;
	struct image_in *in;
	enum status status;
};

static void *take_raw(void *arg, const struct io_oiio_raw *h)
{
	static const char *const word[][2] = {
		{ "targa", "tga" }, { "gif", "gif" },	    { "bmp", "bmp" },  { "tiff", "tiff" },
		{ "hdr", "hdr" },   { "openexr", "exr" },   { "iff", "iff" },  { "jpeg", "jpeg" },
	};
	struct raw_taking *t = arg;
	struct image_raw *raw = t->raw;

	for (size_t i = 0; i < sizeof(word) / sizeof(*word); i++) {
		if (!strcmp(h->format, word[i][0]))
			raw->format = word[i][1];
	}
	raw->channels = h->channels;
	raw->depth = h->bits == 8 ? IMAGE_8 : h->bits == 16 ? IMAGE_16 : IMAGE_FLOAT;
	raw->stated = h->linear && raw->depth == IMAGE_FLOAT;
	raw->curve = raw->stated			 ? IMAGE_CURVE_POWER :
		     !strcmp(raw->format, "tiff") ? IMAGE_CURVE_NONE :
						    IMAGE_CURVE_SRGB;
	raw->gamma = 1;
	raw->premultiplied = h->premultiplied;
	t->status = image_raw_take(raw, t->in, h->width, h->height);
	return raw->sample;
}

/* Radiance's bytes stand for the middle of what they round to, as its own library and POV-Ray have it;
 * OpenImageIO gives the lower end. A pixel's three share the exponent, so the largest tells how much a half is. */
static void centre(const struct image_raw *raw)
{
	size_t n = (size_t)raw->width * raw->height;
	float *v = raw->sample;
	int e;

	for (size_t i = 0; i < n && raw->channels == 3; i++, v += 3) {
		float most = fmaxf(v[0], fmaxf(v[1], v[2])), half;

		if (!(most > 0) || !isfinite(most))
			continue;
		(void)frexpf(most, &e);
		half = ldexpf(1, e - 9);
		v[0] += half;
		v[1] += half;
		v[2] += half;
	}
}

enum status oiio_read_raw(struct image_raw *raw, struct image_in *in, const char *path)
{
	struct raw_taking t = { raw, in, STATUS_OK };
	const struct io_oiio *io = load(&in->pos, STATUS_SCENE, in->diag);
	char error[512];

	if (!io)
		return STATUS_SCENE;
	switch (io->read_raw(path, take_raw, &t, error, sizeof(error))) {
	case 0:
		if (raw->depth == IMAGE_FLOAT && !strcmp(raw->format, "hdr"))
			centre(raw);
		return STATUS_OK;
	case 2:
		return t.status;
	default:
		return diag_fail(in->diag, STATUS_SCENE, &in->pos, "cannot read the picture: %s", error);
	}
}

enum status oiio_can_write(const char *path, uint32_t bits, struct diag *diag)
{
	struct diag_pos pos = { .file = path };
	const struct io_oiio *io = load(&pos, STATUS_USAGE, diag);
	int linear, alpha;
	char error[512];

	if (!io)
		return STATUS_USAGE;
	if (io->can_write(path, &bits, &linear, &alpha, error, sizeof(error)))
		return diag_fail(diag, STATUS_USAGE, &pos, "cannot write such a picture: %s",
				 error);
	return STATUS_OK;
}

static int put(void *arg, const void *bytes, size_t n)
{
	struct image_out *out = arg;

	if (fwrite(bytes, 1, n, out->file) == n && !fflush(out->file))
		return 0;
	(void)image_out_failed(out);
	return 1;
}

static enum status write_pixels(const struct image_job *job, const struct io_oiio *io,
				const struct io_oiio_picture *picture)
{
	const char **text = calloc(2 * (size_t)job->notes + 1, sizeof(*text));
	struct io_oiio_picture p = *picture;
	struct diag_pos pos = { .file = job->out->path };
	enum status st = STATUS_OK;
	char error[512];
	int bad;

	if (!text)
		return diag_no_memory(job->diag, "a picture's notes", job->notes * sizeof(*text));
	for (uint32_t i = 0; i < job->notes; i++) {
		text[i] = job->note[i].key;
		text[job->notes + i] = job->note[i].value;
	}
	p.key = text;
	p.value = text + job->notes;
	p.notes = job->notes;
	bad = io->write(job->out->temporary, &p, put, job->out, error, sizeof(error));
	if (bad == 2)
		st = STATUS_FAILED;
	else if (bad)
		st = diag_fail(job->diag, STATUS_FAILED, &pos, "cannot write the picture: %s",
			       error);
	free(text);
	return st;
}

/* Samples as the file shall hold them. */
static void fill(const struct image *im, const struct image_pick *pick, bool linear, float *pixel,
		 double *row)
{
	struct image_form form = { linear ? IMAGE_LINEAR : IMAGE_SRGB, true };
	size_t n = (size_t)im->width * pick->count;

	for (uint32_t y = 0; y < im->height; y++) {
		image_row(im, y, pick->channel, pick->count, form, row);
		for (size_t i = 0; i < n; i++)
			*pixel++ = (float)row[i];
	}
}

enum status oiio_write(const struct image_job *job)
{
	const struct image *im = job->image;
	struct diag_pos pos = { .file = job->out->path };
	const struct io_oiio *io = load(&pos, STATUS_USAGE, job->diag);
	struct image_pick pick;
	uint32_t bits = job->bits;
	int linear, alpha;
	char error[512];
	enum status st;
	float *pixel;
	double *row;
	size_t n;

	if (!io)
		return STATUS_USAGE;
	if (!job->out->temporary)
		return diag_fail(job->diag, STATUS_FAILED, &pos,
				 "this format can be written to a regular file only");
	if (io->can_write(job->out->path, &bits, &linear, &alpha, error, sizeof(error)))
		return diag_fail(job->diag, STATUS_USAGE, &pos, "cannot write such a picture: %s",
				 error);
	st = image_pick(job, alpha, &pick);
	if (st)
		return st;
	n = (size_t)im->width * im->height * pick.count;
	pixel = malloc(mem_product(n, sizeof(*pixel)));
	row = malloc(mem_product((size_t)im->width * pick.count, sizeof(*row)));
	if (pixel && row) {
		struct io_oiio_picture p = { im->width, im->height, pick.count, bits, linear,
					     pixel,	NULL,	    NULL,	0 };

		fill(im, &pick, linear, pixel, row);
		st = write_pixels(job, io, &p);
	} else {
		st = diag_no_memory(job->diag, "a picture", n * sizeof(*pixel));
	}
	free(pixel);
	free(row);
	return st;
}
