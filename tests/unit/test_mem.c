/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Blocks of all sizes, among them those that get huge pages: aligned, cleared where that is asked for, whole, booked.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"

#define MB ((size_t)1 << 20)

static const size_t size[] = {
	0, 1, 63, 4096, 100000, MB - 64, MB - 1, MB, MB + 1, 2 * MB - 64, 2 * MB - 63, 2 * MB, 3 * MB - 65,
	3 * MB - 64, 7680000, 8 * MB - 128, 8 * MB - 65, 8 * MB - 64, 8 * MB, 9 * MB - 65, 9 * MB - 64, 33 * MB + 5,
};

#define SIZES (sizeof(size) / sizeof(*size))

/* Its first and last bytes, and one in each 4 KiB. */
static void fill(unsigned char *p, size_t bytes, unsigned char with)
{
	for (size_t i = 0; i < bytes; i += i + 4096 < bytes || i == bytes - 1 ? 4096 : bytes - 1 - i)
		p[i] = with;
}

static void assert_filled(const unsigned char *p, size_t bytes, unsigned char with)
{
	for (size_t i = 0; i < bytes; i += i + 4096 < bytes || i == bytes - 1 ? 4096 : bytes - 1 - i)
		assert_int_equal(p[i], with);
}

static void assert_zero(const unsigned char *p, size_t bytes)
{
	for (size_t i = 0; i < bytes; i++) {
		if (p[i])
			fail();
	}
}

static void test_blocks(void **state)
{
	struct mem_book book;
	unsigned char *p[2 * SIZES];
	uint64_t all = 0;

	(void)state;
	mem_book_init(&book, 0);
	for (size_t i = 0; i < 2 * SIZES; i++) {
		size_t bytes = size[i / 2];

		p[i] = i % 2 ? mem_zalloc(&book, "cleared", bytes) : mem_alloc(&book, "any", bytes);
		assert_non_null(p[i]);
		assert_int_equal((uintptr_t)p[i] % 64, 0);
		if (i % 2)
			assert_zero(p[i], bytes);
		fill(p[i], bytes, (unsigned char)i);
		all += bytes;
		assert_int_equal(book.now, all);
	}
	for (size_t i = 0; i < 2 * SIZES; i++) {
		assert_filled(p[i], size[i / 2], (unsigned char)i);
		mem_free(p[i]);
	}
	assert_int_equal(book.now, 0);
	assert_int_equal(book.peak, all);
}

/* What was written and freed may come back, and is cleared again. */
static void test_cleared_again(void **state)
{
	struct mem_book book;

	(void)state;
	mem_book_init(&book, 0);
	for (size_t i = 0; i < 2 * SIZES; i++) {
		unsigned char *p = mem_alloc(&book, "any", size[i / 2]);

		fill(p, size[i / 2], 7);
		mem_free(p);
		p = mem_zalloc(&book, "cleared", size[i / 2]);
		assert_zero(p, size[i / 2]);
		fill(p, size[i / 2], 7);
		mem_free(p);
	}
}

static void test_larger_and_smaller(void **state)
{
	struct mem_book book;
	unsigned char *p;

	(void)state;
	mem_book_init(&book, 0);
	p = mem_zalloc(&book, "grown", size[1]);
	p[0] = 1;
	for (size_t i = 2; i < SIZES; i++) {
		p = mem_realloc(p, size[i]);
		assert_filled(p, size[i - 1], (unsigned char)(i - 1));
		fill(p, size[i], (unsigned char)i);
	}
	mem_trim(p, 9);
	assert_int_equal(book.now, 9);
	p = mem_realloc(p, 9);
	assert_filled(p, 1, SIZES - 1);
	mem_free(p);
	assert_int_equal(book.now, 0);
}

static void test_too_much(void **state)
{
	struct mem_book book;

	(void)state;
	mem_book_init(&book, 3 * MB);
	for (size_t more = 0; more < 5 * MB; more += 4096) {
		assert_null(mem_alloc(&book, "any", SIZE_MAX - more));
		assert_null(mem_zalloc(&book, "any", SIZE_MAX - more));
	}
	assert_null(mem_alloc(&book, "any", 3 * MB + 1));
	assert_null(mem_zalloc(&book, "any", 3 * MB + 1));
	assert_int_equal(book.now, 0);
#ifndef __SANITIZE_ADDRESS__ /* which takes it for an error */
	book.limit = 0;
	assert_null(mem_alloc(&book, "any", SIZE_MAX / 2));
	assert_null(mem_zalloc(&book, "any", SIZE_MAX / 2));
	assert_int_equal(book.now, 0);
#endif
	assert_int_equal(book.account[0].now, 0);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_blocks),
		cmocka_unit_test(test_cleared_again),
		cmocka_unit_test(test_larger_and_smaller),
		cmocka_unit_test(test_too_much),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
