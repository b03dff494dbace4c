/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Accounted memory: every large allocation is booked under a purpose, so that reports can say what a
 * scene's memory went to. Arenas for what lives and dies together.
 */
#ifndef ALIDADE_BASE_MEM_H
#define ALIDADE_BASE_MEM_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define MEM_PURPOSES 32

/* One purpose, e.g. "scene" or "accel: nodes". */
struct mem_account {
	char name[40];
	_Atomic uint64_t now, peak; /* bytes */
};

struct mem_book {
	struct mem_account account[MEM_PURPOSES];
	_Atomic uint32_t count;
	_Atomic uint64_t now, peak, recent; /* recent: the most since mem_book_mark() */
	uint64_t limit; /* bytes in all, 0: none */
};

void mem_book_init(struct mem_book *, uint64_t limit);
void mem_book_mark(struct mem_book *);
/* The account of that name, made if new; the last one ("other") when the book is full. [any] */
struct mem_account *mem_account_get(struct mem_book *, const char *name);

/* 64-aligned, not cleared; NULL when out of memory or over the limit. mem_free(NULL) is harmless.
 * A block remembers its book, account and size. What is large is in huge pages. [any thread] */
void *mem_alloc(struct mem_book *, const char *purpose, size_t bytes);
void *mem_zalloc(struct mem_book *, const char *purpose, size_t bytes);
/* Like realloc; the block keeps its purpose. p may not be NULL. NULL: the old block is still there. */
void *mem_realloc(void *p, size_t bytes);
/* The rest of p was never written, nor will it be: it is not booked any more. */
void mem_trim(void *p, size_t bytes);
void mem_free(void *p);

/* Book memory that others hand out, or have taken back (bytes < 0). false: over the limit, not booked. */
bool mem_account_foreign(struct mem_book *, const char *purpose, int64_t bytes);

/* a * b or SIZE_MAX when that overflows, so that the allocation fails. */
size_t mem_product(size_t a, size_t b);

struct arena {
	struct mem_book *book;
	const char *purpose; /* must outlive the arena */
	struct arena_chunk *chunk;
	size_t used, size; /* of the current chunk */
};

void arena_init(struct arena *, struct mem_book *, const char *purpose);
void *arena_alloc(struct arena *, size_t bytes); /* 16-aligned, not cleared; NULL: no memory */
void *arena_zalloc(struct arena *, size_t bytes);
char *arena_strdup(struct arena *, const char *s);
char *arena_memdup(struct arena *, const void *p, size_t bytes);
void arena_reset(struct arena *); /* empty, but the newest chunk is kept for reuse */
void arena_release(struct arena *);

#endif
