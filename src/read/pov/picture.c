/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Picture files: where they are looked for, and reading each once (manual 3.4.6.1.5).
 */
#include <config.h>

#include "read/pov/picture.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "read/limits.h"
#include "read/pictures.h"
#include "scene/hash.h"

#define SUFFIXES_MAX 16

/* What the readers of pictures report, at the statement that names the file. */
struct courier {
	struct pov *p;
	const char *path;
	struct diag_pos at;
};

static void deliver(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	struct courier *c = arg;

	(void)pos;
	if (level == DIAG_ERROR)
		pov_fail_at(c->p, &c->at, "\"%s\": %s", c->path, text);
	else if (level == DIAG_WARNING)
		pov_warn(c->p, &c->at, "\"%s\": %s", c->path, text);
}

/* Behind the next / or \ of a name: Blender on Windows writes either. NULL: there is none. */
static const char *shorter(const char *name)
{
	const char *mark = strpbrk(name, "/\\");

	return mark && mark[1] ? mark + 1 : NULL;
}

/* A scene that was moved has the pictures' old places. The longest end of the name that is found beside the
 * scene or in a -L folder is taken, and that is said. */
static char *search_moved(struct pov *p, const char *name, const struct diag_pos *at)
{
	const char *end = shorter(name);
	char *path = NULL;

	for (int i = 0; end && !path && i < SUFFIXES_MAX; i++) {
		if (*end != '/' && *end != '\\' && strncmp(end, "..", 2) != 0)
			path = pov_find_file(p, end);
		if (!path)
			end = shorter(end);
	}
	if (path)
		pov_warn(p, at, "there is no file \"%s\"; \"%s\" is taken in its place", name, path);
	return path;
}

static char *search(struct pov *p, const char *name, const struct diag_pos *at)
{
	char *path = pov_find_file(p, name);

	if (!path && !access(name, F_OK))
		path = arena_strdup(&pov_scene(p)->arena, name);
	if (!path && !pov_failed(p))
		path = search_moved(p, name, at);
	if (!path && !pov_failed(p))
		pov_fail_at(p, at, "the picture \"%s\" was not found (looked there, beside the scene and in -L "
			    "folders)", name);
	return path;
}

static bool any_clear(const struct picture *p, bool palette_alpha)
{
	size_t n = (size_t)p->width * p->height, step = p->channels;

	if (p->palette_count)
		return palette_alpha;
	if (step != 2 && step != 4)
		return false;
	for (size_t i = step - 1; i < n * step; i += step) {
		if (p->depth == PICTURE_8 ? ((const uint8_t *)p->sample)[i] < UINT8_MAX :
		    p->depth == PICTURE_16 ? ((const uint16_t *)p->sample)[i] < UINT16_MAX :
					     !(((const float *)p->sample)[i] >= 1))
			return true;
	}
	return false;
}

static struct pov_picture *keep(struct pov *p, struct image_raw *raw, const char *path,
				const struct diag_pos *at, bool kept)
{
	struct pov_picture *f = pov_new(p, sizeof(*f));
	struct picture *picture = f ? scene_add_picture(pov_scene(p)) : NULL;

	if (!picture) {
		if (!kept)
			image_raw_release(raw);
		pov_no_memory(p);
		return NULL;
	}
	*picture = (struct picture){ .path = path,
				     .width = raw->width,
				     .height = raw->height,
				     .channels = raw->channels,
				     .depth = (enum picture_depth)raw->depth,
				     .sample = raw->sample,
				     .palette_count = raw->palette_count,
				     .kept = kept,
				     .hash = hash_words(HASH_START, raw->sample, (size_t)image_raw_bytes(raw)),
				     .pos = *at };
	picture->clear = any_clear(picture, raw->palette_alpha);
	f->raw = *raw;
	f->raw.sample = NULL;
	f->picture = picture;
	f->next = pov_state(p)->pictures;
	pov_state(p)->pictures = f;
	pov_state(p)->picture_bytes += image_raw_bytes(raw);
	return f;
}

static struct pov_picture *load(struct pov *p, const char *path, const struct diag_pos *at)
{
	struct read_limits limit = read_limits_fill(&pov_options(p)->limits);
	uint64_t used = pov_state(p)->picture_bytes;
	struct courier courier = { p, path, *at };
	struct diag diag = { .sink = deliver, .arg = &courier };
	struct image_limits left = { limit.texture_pixels,
				     used < limit.texture_bytes ? limit.texture_bytes - used : 1 };
	struct read_pictures *store = pov_options(p)->pictures;
	const struct image_raw *earlier = store ? read_pictures_find(store, path) : NULL;
	struct image_raw raw;
	bool kept = true;

	if (earlier) {
		raw = *earlier;
	} else {
		if (image_raw_read(&raw, path, pov_book(p), &left, &diag))
			return NULL;
		kept = store && read_pictures_add(store, path, &raw);
	}
	return keep(p, &raw, path, at, kept);
}

/* tif is tiff, jpg is jpeg: POV-Ray's words for what a name ends in; NULL: it knows none. */
static const char *word_of(const char *name)
{
	static const char *const ending[][2] = {
		{ "png", "png" },   { "jpg", "jpeg" }, { "jpeg", "jpeg" }, { "tif", "tiff" },
		{ "tiff", "tiff" }, { "tga", "tga" },  { "gif", "gif" },   { "bmp", "bmp" },
		{ "exr", "exr" },   { "hdr", "hdr" },  { "iff", "iff" },   { "ppm", "ppm" },
		{ "pgm", "pgm" },
	};
	const char *dot = strrchr(name, '.');

	for (size_t i = 0; dot && i < sizeof(ending) / sizeof(*ending); i++) {
		if (!strcasecmp(dot + 1, ending[i][0]))
			return ending[i][1];
	}
	return NULL;
}

static void check_word(struct pov *p, const struct pov_picture *f, const char *word, const char *name,
		       const struct diag_pos *at)
{
	const char *is = f->raw.format;

	if (!word)
		word = word_of(name);
	if (!word || !*is || !strcmp(word, is))
		return;
	pov_warn(p, at, "\"%s\" is a %s picture and is read as such, not as %s; POV-Ray would not read it", name,
		 is, word);
}

struct pov_picture *pov_picture_file(struct pov *p, const char *word)
{
	struct diag_pos at = pov_here(p);
	const char *name = pov_path(p);
	struct pov_picture *f;
	char *path;

	if (!name || pov_failed(p))
		return NULL;
	path = search(p, name, &at);
	if (!path)
		return NULL;
	for (f = pov_state(p)->pictures; f; f = f->next) {
		if (!strcmp(f->picture->path, path))
			break;
	}
	if (!f)
		f = load(p, path, &at);
	if (f)
		check_word(p, f, word, name, &at);
	return f;
}
