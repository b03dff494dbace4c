/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include <config.h>

#include "read/pictures.h"

#include <string.h>
#include <sys/stat.h>

struct kept_picture {
	struct kept_picture *next;
	struct image_raw raw;
	struct stat file; /* as it was */
	bool used;
	char path[];
};

static bool unchanged(const struct stat *a, const struct stat *b)
{
	return a->st_dev == b->st_dev && a->st_ino == b->st_ino && a->st_size == b->st_size &&
	       a->st_mtim.tv_sec == b->st_mtim.tv_sec && a->st_mtim.tv_nsec == b->st_mtim.tv_nsec;
}

void read_pictures_begin(struct read_pictures *s)
{
	s->kept = 0;
	for (struct kept_picture *k = s->first; k; k = k->next)
		k->used = false;
}

void read_pictures_end(struct read_pictures *s)
{
	struct kept_picture **at = &s->first, *k;

	while ((k = *at)) {
		if (k->used) {
			at = &k->next;
			continue;
		}
		*at = k->next;
		image_raw_release(&k->raw);
		mem_free(k);
	}
}

void read_pictures_release(struct read_pictures *s)
{
	read_pictures_begin(s);
	read_pictures_end(s);
}

const struct image_raw *read_pictures_find(struct read_pictures *s, const char *path)
{
	struct stat now;

	for (struct kept_picture *k = s->first; k; k = k->next) {
		if (strcmp(k->path, path) || stat(path, &now) || !unchanged(&k->file, &now))
			continue;
		s->kept += !k->used;
		k->used = true;
		return &k->raw;
	}
	return NULL;
}

bool read_pictures_add(struct read_pictures *s, const char *path, const struct image_raw *raw)
{
	size_t length = strlen(path) + 1;
	struct kept_picture *k = mem_alloc(s->book, "pictures", sizeof(*k) + length);

	if (!k)
		return false;
	*k = (struct kept_picture){ .next = s->first, .raw = *raw, .used = true };
	memcpy(k->path, path, length);
	/* A file that is not there any more, or changes meanwhile, is read anew. */
	if (stat(path, &k->file))
		memset(&k->file, 0, sizeof(k->file));
	s->first = k;
	return true;
}
