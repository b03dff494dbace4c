/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Picture files that are kept from one frame of an animation to the next, so that each is read once. The samples
 * are theirs; scenes that use them say so (struct picture, kept).
 */
#ifndef ALIDADE_READ_PICTURES_H
#define ALIDADE_READ_PICTURES_H

#include "image/raw.h"

struct kept_picture;

struct read_pictures {
	struct mem_book *book;
	struct kept_picture *first;
	uint64_t kept; /* in this frame, how many need not have been read */
};

/* Before a frame is read, and after that: what it did not ask for is dropped. */
void read_pictures_begin(struct read_pictures *);
void read_pictures_end(struct read_pictures *);
void read_pictures_release(struct read_pictures *);
/* The file of that path as it was read, if it has not changed; or NULL. */
const struct image_raw *read_pictures_find(struct read_pictures *, const char *path);
/* Keep this one. False: no memory, and it is still the caller's. */
bool read_pictures_add(struct read_pictures *, const char *path, const struct image_raw *);

#endif
