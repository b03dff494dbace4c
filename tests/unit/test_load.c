/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The loader's parts: parameters and their texts, words that look alike, and files broken in every way.
 * What it says to whom is in tests/plugins/load.sh.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "accel/elf.h"
#include "accel/load.h"
#include "accel/param.h"

static const char *const label[] = { "thin", "thick", NULL };
static const ald_param table[] = {
	{ "depth", "levels", ALD_INT, 4, 0, 9007199254740992.0, NULL },
	{ "share", "of all", ALD_REAL, 0.1, -1, 1, NULL },
	{ "fast", "inexact", ALD_BOOL, 0, 0, 1, NULL },
	{ "kind", "of it", ALD_CHOICE, 1, 0, 1, label },
	{ NULL, NULL, 0, 0, 0, 0, NULL },
};

static void test_values(void **state)
{
	struct diag d = { .sink = NULL };
	double v[ACCEL_PARAMS_MAX];

	(void)state;
	assert_int_equal(param_parse(table, NULL, v, "x", &d), STATUS_OK);
	assert_true(v[0] == 4 && v[1] == 0.1 && v[2] == 0 && v[3] == 1);
	assert_int_equal(param_parse(table, "kind=thin,fast=on,depth=9007199254740992,share=-1e-3", v, "x",
				     &d),
			 STATUS_OK);
	assert_true(v[0] == 9007199254740992.0 && v[1] == -1e-3 && v[2] == 1 && v[3] == 0);
	assert_int_equal(d.errors, 0);
	for (unsigned i = 0; i < 8; i++) {
		const char *const bad[] = { "depth=-1",	  "share=1.0000001", "fast=2",	   "kind=0",
					    "share=1e400", "share=inf",	     "depth=9e99", ",depth=1" };

		assert_int_equal(param_parse(table, bad[i], v, "x", &d), STATUS_ACCEL);
		assert_int_equal(d.errors, i + 1);
	}
}

static void test_texts(void **state)
{
	char text[64];

	(void)state;
	param_value_text(&table[1], 0.1, text, sizeof(text));
	assert_string_equal(text, "0.1");
	param_value_text(&table[1], 1.0 / 3, text, sizeof(text));
	assert_true(strtod(text, NULL) == 1.0 / 3);
	param_value_text(&table[0], 9007199254740992.0, text, sizeof(text));
	assert_string_equal(text, "9007199254740992");
	param_range_text(&table[3], text, sizeof(text));
	assert_string_equal(text, "thin or thick");
	param_range_text(&table[2], text, sizeof(text));
	assert_string_equal(text, "on or off");
}

static void test_alike(void **state)
{
	(void)state;
	assert_true(text_alike("octre", "octree"));
	assert_true(text_alike("ocrtee", "octree"));
	assert_true(text_alike("leef", "leaf"));
	assert_false(text_alike("box", "none"));
	assert_false(text_alike("", "none"));
	assert_false(text_alike("kd", "octree"));
}

static unsigned char *read_plugin(size_t *size)
{
	struct diag d = { .sink = NULL };
	struct accel_choice c;
	unsigned char *bytes;
	struct stat st;
	FILE *f;

	assert_int_equal(accel_load(&c, "none", &d), STATUS_OK);
	f = fopen(c.path, "rb");
	assert_non_null(f);
	assert_int_equal(fstat(fileno(f), &st), 0);
	*size = (size_t)st.st_size;
	bytes = malloc(*size);
	assert_int_equal(fread(bytes, 1, *size, f), *size);
	fclose(f);
	accel_unload(&c);
	return bytes;
}

static void write_file(const char *path, const unsigned char *bytes, size_t size)
{
	FILE *f = fopen(path, "wb");

	assert_non_null(f);
	assert_int_equal(fwrite(bytes, 1, size, f), size);
	fclose(f);
}

/* Whatever is in the file, looking into it ends well (AddressSanitizer watches). */
static void test_broken_files(void **state)
{
	char path[] = "/tmp/alidade-test-XXXXXX";
	uint64_t s = 1;
	size_t size;
	unsigned char *bytes = read_plugin(&size);
	struct elf_peek peek;
	int fd = mkstemp(path);

	(void)state;
	assert_true(fd >= 0);
	close(fd);
	write_file(path, bytes, size);
	assert_null(elf_peek_file(path, "ald_accel_entry", &peek));
	assert_int_equal(peek.found, 1);
	assert_int_equal(peek.abi, ALD_ACCEL_ABI);
	assert_int_equal(peek.size, sizeof(ald_accel_plugin));
	for (size_t n = size - 1; n > 0; n -= n > 4096 && n > size / 512 ? size / 1024 : n > 7 ? 7 : 1) {
		assert_int_equal(truncate(path, (off_t)n), 0);
		assert_non_null(elf_peek_file(path, "ald_accel_entry", &peek));
	}
	write_file(path, bytes, size);
	for (unsigned round = 0; round < 2000; round++) {
		FILE *f = fopen(path, "r+b");
		size_t at[8];

		assert_non_null(f);
		for (unsigned k = 0; k < 8; k++) {
			s = s * 6364136223846793005u + 1442695040888963407u;
			/* Headers are at both ends. */
			at[k] = k % 2 ? (s >> 33) % 1024 : size - 1 - (s >> 33) % 2048;
			fseek(f, (long)at[k], SEEK_SET);
			fputc((int)(s >> 25 & 255), f);
		}
		fflush(f);
		elf_peek_file(path, "ald_accel_entry", &peek);
		for (unsigned k = 0; k < 8; k++) {
			fseek(f, (long)at[k], SEEK_SET);
			fputc(bytes[at[k]], f);
		}
		fclose(f);
	}
	assert_null(elf_peek_file(path, "ald_accel_entry", &peek));
	unlink(path);
	free(bytes);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_values),
		cmocka_unit_test(test_texts),
		cmocka_unit_test(test_alike),
		cmocka_unit_test(test_broken_files),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
