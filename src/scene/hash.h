/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What scene_hash() is made of. FNV-1a, 64 bits: stable over machines of one byte order, and nothing here
 * defends against malice.
 */
#ifndef ALIDADE_SCENE_HASH_H
#define ALIDADE_SCENE_HASH_H

#include <string.h>

#include "scene/scene.h"

static inline uint64_t hash_bytes(uint64_t h, const void *p, size_t n)
{
	const unsigned char *c = p;

	for (size_t i = 0; i < n; i++)
		h = (h ^ c[i]) * 1099511628211u;
	return h;
}

/* Eight bytes at a time: meshes and pictures are large. */
static inline uint64_t hash_words(uint64_t h, const void *p, size_t n)
{
	const unsigned char *c = p;
	uint64_t w;

	for (; n >= 8; n -= 8, c += 8) {
		memcpy(&w, c, 8);
		h = (h ^ w) * 1099511628211u;
		h ^= h >> 32;
	}
	return hash_bytes(h, c, n);
}

#define HASH_START 14695981039346656037u
#define HASH(h, x) hash_bytes(h, &(x), sizeof(x))

/* Textures, and all that they are made of. */
uint64_t hash_normal(uint64_t h, const struct normal *); /* or NULL */
uint64_t hash_textures(uint64_t h, const struct scene *);
uint64_t hash_media(uint64_t h, uint32_t count, const struct media *);

#endif
