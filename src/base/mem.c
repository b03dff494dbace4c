/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "base/mem.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#define ALIGN 64
#define CHUNK (64 * 1024)
#define PAGE ((size_t)64 << 10) /* the largest that systems have */
#define HUGE_PAGE ((size_t)2 << 20)
#define MOST_OF_IT (HUGE_PAGE / 2) /* of a huge page, for which a whole one is taken */
#define LARGE (4 * HUGE_PAGE)
/* Blocks that are mapped; a sanitizer sees where others end, but not these. */
#if defined __SANITIZE_ADDRESS__
#define MAP_LEAST SIZE_MAX
#elif defined __has_feature
#if __has_feature(address_sanitizer)
#define MAP_LEAST SIZE_MAX
#endif
#endif
#ifndef MAP_LEAST
#define MAP_LEAST LARGE
#endif

/* Stands in the 64 bytes before each block. */
struct block {
	void *base; /* what is to be freed */
	size_t mapped; /* or unmapped: bytes */
	struct mem_book *book;
	struct mem_account *account;
	size_t bytes; /* as asked for */
};

void mem_book_init(struct mem_book *book, uint64_t limit)
{
	memset(book, 0, sizeof(*book));
	book->limit = limit;
}

void mem_book_mark(struct mem_book *book)
{
	atomic_store(&book->recent, atomic_load(&book->now));
}

struct mem_account *mem_account_get(struct mem_book *book, const char *name)
{
	static atomic_flag lock = ATOMIC_FLAG_INIT;
	struct mem_account *found = NULL;
	uint32_t n = atomic_load(&book->count);

	for (uint32_t i = 0; i < n; i++) {
		if (!strncmp(book->account[i].name, name, sizeof(book->account[i].name) - 1))
			return &book->account[i];
	}
	while (atomic_flag_test_and_set(&lock))
		;
	n = atomic_load(&book->count);
	for (uint32_t i = 0; i < n && !found; i++) {
		if (!strncmp(book->account[i].name, name, sizeof(book->account[i].name) - 1))
			found = &book->account[i];
	}
	if (!found && n < MEM_PURPOSES) {
		found = &book->account[n];
		snprintf(found->name, sizeof(found->name), "%s",
			 n == MEM_PURPOSES - 1 ? "other" : name);
		atomic_store(&book->count, n + 1);
	}
	atomic_flag_clear(&lock);
	return found ? found : &book->account[MEM_PURPOSES - 1];
}

static void raise_peak(_Atomic uint64_t *peak, uint64_t now)
{
	uint64_t old = atomic_load(peak);

	while (now > old && !atomic_compare_exchange_weak(peak, &old, now))
		;
}

static bool book_add(struct mem_book *book, struct mem_account *account, size_t bytes)
{
	uint64_t now = atomic_fetch_add(&book->now, bytes) + bytes;

	if (book->limit && now > book->limit) {
		atomic_fetch_sub(&book->now, bytes);
		return false;
	}
	raise_peak(&book->peak, now);
	raise_peak(&book->recent, now);
	raise_peak(&account->peak, atomic_fetch_add(&account->now, bytes) + bytes);
	return true;
}

static void book_sub(const struct block *b)
{
	atomic_fetch_sub(&b->book->now, b->bytes);
	atomic_fetch_sub(&b->account->now, b->bytes);
}

static void *begin_block(void *base, size_t mapped, char *p, struct mem_book *book, struct mem_account *account,
			 size_t bytes)
{
	struct block *b = (struct block *)(p - ALIGN);

	*b = (struct block){ base, mapped, book, account, bytes };
	return p;
}

static void *no_block(struct mem_book *book, struct mem_account *account, size_t bytes)
{
	atomic_fetch_sub(&book->now, bytes);
	atomic_fetch_sub(&account->now, bytes);
	return NULL;
}

/* What is large starts with a huge page and is in huge pages, of which a small part may be unused: fewer pages are
 * written for the first time, and walks that read here and there find their place sooner. A virtual machine may have to
 * get each from its host first, which takes longer for 2 MiB than for 4 KiB; and smaller blocks would leave more unused
 * than they win. */
static bool is_large(size_t bytes)
{
	return bytes >= LARGE;
}

static size_t rounded(size_t bytes)
{
	size_t to = is_large(bytes) && bytes % HUGE_PAGE >= MOST_OF_IT ? HUGE_PAGE : ALIGN;

	return (bytes + to - 1) / to * to;
}

/* p: at a huge page's start, or somewhere. */
static void in_huge_pages(void *p, size_t bytes)
{
#if defined __linux__ && defined MADV_HUGEPAGE
	uintptr_t from = ((uintptr_t)p + HUGE_PAGE - 1) & ~(HUGE_PAGE - 1);
	uintptr_t end = ((uintptr_t)p + bytes) & ~(HUGE_PAGE - 1);

	if (from < end)
		(void)madvise((void *)from, end - from, MADV_HUGEPAGE);
#else
	(void)p, (void)bytes;
#endif
}

void *mem_alloc(struct mem_book *book, const char *purpose, size_t bytes)
{
	struct mem_account *account = mem_account_get(book, purpose);
	void *base = NULL;
	size_t all;

	if (bytes > SIZE_MAX - 2 * HUGE_PAGE || !book_add(book, account, bytes))
		return NULL;
	all = rounded(ALIGN + bytes);
	if (posix_memalign(&base, is_large(all) ? HUGE_PAGE : ALIGN, all))
		return no_block(book, account, bytes);
	in_huge_pages(base, all);
	return begin_block(base, 0, (char *)base + ALIGN, book, account, bytes);
}

/* Bytes that the system has cleared, at a huge page's start; what it gave beside them is given back. */
static char *map_large(size_t bytes)
{
	size_t all = bytes + HUGE_PAGE, before, behind;
	char *p = mmap(NULL, all, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);

	if (p == MAP_FAILED)
		return NULL;
	before = (HUGE_PAGE - (uintptr_t)p % HUGE_PAGE) % HUGE_PAGE;
	behind = HUGE_PAGE - before;
	if (before)
		(void)munmap(p, before);
	if (behind)
		(void)munmap(p + before + bytes, behind);
	in_huge_pages(p + before, bytes);
	return p + before;
}

/* Cleared by the system, when it is used: each thread its part. What is small, by calloc(), which knows what has been
 * cleared already. */
void *mem_zalloc(struct mem_book *book, const char *purpose, size_t bytes)
{
	struct mem_account *account = mem_account_get(book, purpose);
	size_t mapped = 0;
	char *base, *p;

	if (bytes > SIZE_MAX - 4 * HUGE_PAGE || !book_add(book, account, bytes))
		return NULL;
	if (ALIGN + bytes >= MAP_LEAST) {
		mapped = (rounded(ALIGN + bytes) + PAGE - 1) / PAGE * PAGE;
		base = map_large(mapped);
		p = base;
	} else {
		base = calloc(1, bytes + 2 * ALIGN);
		p = base + (ALIGN - (uintptr_t)base % ALIGN) % ALIGN;
		if (base)
			in_huge_pages(p, bytes); /* what is written as a whole */
	}
	return base ? begin_block(base, mapped, p + ALIGN, book, account, bytes) : no_block(book, account, bytes);
}

void *mem_realloc(void *p, size_t bytes)
{
	struct block *b = (struct block *)((char *)p - ALIGN);
	void *q = mem_alloc(b->book, b->account->name, bytes);

	if (!q)
		return NULL;
	memcpy(q, p, bytes < b->bytes ? bytes : b->bytes);
	mem_free(p);
	return q;
}

void mem_trim(void *p, size_t bytes)
{
	struct block *b = (struct block *)((char *)p - ALIGN);
	struct block rest = *b;

	if (bytes >= b->bytes)
		return;
	rest.bytes -= bytes;
	b->bytes = bytes;
	book_sub(&rest);
}

void mem_free(void *p)
{
	struct block b;

	if (!p)
		return;
	b = *(struct block *)((char *)p - ALIGN);
	book_sub(&b);
	if (b.mapped)
		(void)munmap(b.base, b.mapped);
	else
		free(b.base);
}

bool mem_account_foreign(struct mem_book *book, const char *purpose, int64_t bytes)
{
	struct mem_account *account = mem_account_get(book, purpose);

	if (bytes >= 0)
		return book_add(book, account, (size_t)bytes);
	atomic_fetch_sub(&book->now, (uint64_t)-bytes);
	atomic_fetch_sub(&account->now, (uint64_t)-bytes);
	return true;
}

size_t mem_product(size_t a, size_t b)
{
	size_t out;

	return __builtin_mul_overflow(a, b, &out) ? SIZE_MAX : out;
}

struct arena_chunk {
	struct arena_chunk *older;
	size_t size;
	_Alignas(16) char data[];
};

void arena_init(struct arena *a, struct mem_book *book, const char *purpose)
{
	*a = (struct arena){ .book = book, .purpose = purpose };
}

void *arena_alloc(struct arena *a, size_t bytes)
{
	struct arena_chunk *c;
	size_t size;
	void *p;

	if (bytes > SIZE_MAX / 2)
		return NULL;
	bytes = (bytes + 15) & ~(size_t)15;
	if (bytes > a->size - a->used) {
		size = bytes > CHUNK ? bytes : CHUNK;
		c = mem_alloc(a->book, a->purpose, sizeof(*c) + size);
		if (!c)
			return NULL;
		c->older = a->chunk;
		c->size = size;
		a->chunk = c;
		a->used = 0;
		a->size = size;
	}
	p = a->chunk->data + a->used;
	a->used += bytes;
	return p;
}

void *arena_zalloc(struct arena *a, size_t bytes)
{
	void *p = arena_alloc(a, bytes);

	if (p) {
		in_huge_pages(p, bytes);
		memset(p, 0, bytes);
	}
	return p;
}

char *arena_memdup(struct arena *a, const void *p, size_t bytes)
{
	char *q = arena_alloc(a, bytes);

	if (q)
		memcpy(q, p, bytes);
	return q;
}

char *arena_strdup(struct arena *a, const char *s)
{
	return arena_memdup(a, s, strlen(s) + 1);
}

void arena_reset(struct arena *a)
{
	struct arena_chunk *c = a->chunk, *older;

	if (!c)
		return;
	for (older = c->older; older; older = c->older) {
		c->older = older->older;
		mem_free(older);
	}
	a->used = 0;
}

void arena_release(struct arena *a)
{
	struct arena_chunk *older;

	for (struct arena_chunk *c = a->chunk; c; c = older) {
		older = c->older;
		mem_free(c);
	}
	a->chunk = NULL;
	a->used = a->size = 0;
}
