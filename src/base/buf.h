/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A growing array that is emptied and filled again: once it has its size, nothing is allocated, which
 * is what the render loops need. Elements move when it grows: keep indices.
 */
#ifndef ALIDADE_BASE_BUF_H
#define ALIDADE_BASE_BUF_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/mem.h"

struct buf {
	void *data;
	size_t size; /* of an element */
	uint32_t count, room;
};

#define BUF_AT(b, type, i) (&((type *)(b)->data)[i])

/* Make room for n more; false: out of memory. */
static inline bool buf_reserve(struct buf *b, struct mem_book *book, const char *purpose, uint32_t n)
{
	uint64_t need = (uint64_t)b->count + n, room = b->room ? b->room : 64;
	void *p;

	if (need <= b->room)
		return true;
	while (room < need)
		room *= 2;
	if (room > UINT32_MAX)
		return false;
	p = b->data ? mem_realloc(b->data, mem_product(room, b->size)) :
		      mem_alloc(book, purpose, mem_product(room, b->size));
	if (!p)
		return false;
	b->data = p;
	b->room = (uint32_t)room;
	return true;
}

static inline void buf_release(struct buf *b)
{
	mem_free(b->data);
	b->data = NULL;
	b->count = b->room = 0;
}

#endif
