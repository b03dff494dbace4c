/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Reading a piece of scene description language in a test: the scene, its dump and the messages.
 */
#ifndef ALIDADE_TESTS_POV_FIXTURE_H
#define ALIDADE_TESTS_POV_FIXTURE_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "read/pov/parser.h"
#include "scene/dump.h"

struct fixture {
	struct mem_book book;
	struct scene scene;
	struct diag diag;
	enum status status;
	char messages[8192]; /* "line:col: error: text\n" each; 0:0 where there is no place */
	char *dump; /* made by fixture_dump() */
};

static void fixture_sink(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	static const char *const name[] = { "error", "warning", "note", "debug" };
	struct fixture *f = arg;
	size_t used = strlen(f->messages);

	snprintf(f->messages + used, sizeof(f->messages) - used, "%u:%u: %s: %s\n", pos ? pos->line : 0,
		 pos ? pos->col : 0, name[level], text);
}

static void fixture_read_bytes(struct fixture *f, const char *text, size_t size,
			       const struct read_options *options)
{
	memset(f, 0, sizeof(*f));
	mem_book_init(&f->book, 0);
	scene_init(&f->scene, &f->book);
	f->diag = (struct diag){ .sink = fixture_sink, .arg = f };
	f->status = pov_read("test.pov", text, size, options, &f->scene, &f->diag);
}

static inline void fixture_read(struct fixture *f, const char *text, bool lenient)
{
	const struct read_options options = { .lenient = lenient };
	/* Exactly as long as the text, so that a sanitizer sees a read beyond its end. */
	size_t size = strlen(text);
	char *copy = malloc(size ? size : 1);

	if (!copy)
		abort();
	memcpy(copy, text, size);
	fixture_read_bytes(f, copy, size, &options);
	free(copy);
}

static inline const char *fixture_dump(struct fixture *f, unsigned what)
{
	size_t size;
	FILE *to;

	free(f->dump);
	f->dump = NULL;
	to = open_memstream(&f->dump, &size);
	if (!to)
		abort();
	scene_dump(&f->scene, what, to);
	fclose(to);
	return f->dump;
}

static inline void fixture_release(struct fixture *f)
{
	scene_release(&f->scene);
	free(f->dump);
}

#endif
