/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What the tests of pictures share: a folder that goes away, the last message, small pictures.
 */
#ifndef ALIDADE_TESTS_IMAGE_FIXTURE_H
#define ALIDADE_TESTS_IMAGE_FIXTURE_H

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "image/image.h"

struct fixture {
	char folder[64];
	char path[4][128];
	char text[2048]; /* of the last message, as printed */
	uint32_t messages;
	struct diag diag;
	struct mem_book book;
};

static void fixture_sink(void *arg, enum diag_level level, const struct diag_pos *pos,
			 const char *text)
{
	struct fixture *f = arg;

	f->messages++;
	diag_format(f->text, sizeof(f->text), level, pos, text);
}

static int fixture_setup(void **state)
{
	struct fixture *f = calloc(1, sizeof(*f));

	if (!f)
		return -1;
	strcpy(f->folder, "/tmp/alidade-test-XXXXXX");
	if (!mkdtemp(f->folder))
		return -1;
	f->diag = (struct diag){ .sink = fixture_sink, .arg = f };
	mem_book_init(&f->book, 0);
	*state = f;
	return 0;
}

/* Files in the folder. */
static inline uint32_t fixture_count(const struct fixture *f)
{
	DIR *d = opendir(f->folder);
	uint32_t n = 0;

	assert_non_null(d);
	for (struct dirent *e = readdir(d); e; e = readdir(d))
		n += strcmp(e->d_name, ".") && strcmp(e->d_name, "..");
	closedir(d);
	return n;
}

static int fixture_teardown(void **state)
{
	struct fixture *f = *state;
	DIR *d = opendir(f->folder);
	char path[400];
	int leak = atomic_load(&f->book.now) != 0;

	for (struct dirent *e = d ? readdir(d) : NULL; e; e = readdir(d)) {
		snprintf(path, sizeof(path), "%s/%s", f->folder, e->d_name);
		(void)unlink(path);
	}
	if (d)
		closedir(d);
	(void)rmdir(f->folder);
	free(f);
	return leak ? -1 : 0;
}

/* The full name of a file in the folder; four of them live at a time. */
static inline const char *fixture_path(struct fixture *f, uint32_t i, const char *name)
{
	snprintf(f->path[i], sizeof(f->path[i]), "%s/%s", f->folder, name);
	return f->path[i];
}

/* Light between 0 and 1 that no two samples share. */
static inline void fixture_image(struct fixture *f, struct image *im, uint32_t w, uint32_t h,
				 uint32_t channels)
{
	size_t n = (size_t)w * h * channels;

	assert_int_equal(image_init(im, &f->book, w, h, channels, &f->diag), STATUS_OK);
	for (size_t i = 0; i < n; i++)
		im->pixel[i] = (float)i / (float)n;
}

static inline void fixture_store(const char *path, const void *data, size_t n)
{
	FILE *out = fopen(path, "wb");

	assert_non_null(out);
	assert_int_equal(fwrite(data, 1, n, out), n);
	assert_int_equal(fclose(out), 0);
}

/* The file's bytes, freed by the caller. */
static inline char *fixture_load(const char *path, size_t *n)
{
	FILE *in = fopen(path, "rb");
	char *data = malloc(1 << 20);

	assert_non_null(in);
	assert_non_null(data);
	*n = fread(data, 1, 1 << 20, in);
	fclose(in);
	return data;
}

#endif
