/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Damaged and lying files end in one clear line; a picture that cannot be written whole leaves the
 * old one.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "image_fixture.h"

static const char *const format[] = { "a.png", "a.ppm", "a.pfm",
#ifdef HAVE_OPENEXR
				      "a.exr",
#endif
};
#define FORMATS (sizeof(format) / sizeof(*format))

/* Reading fails with one message that has the words in it. */
static void refused(struct fixture *f, const char *path, const struct image_limits *limits,
		    const char *words)
{
	struct image im;

	f->messages = 0;
	assert_int_equal(image_read(&im, path, &f->book, limits, &f->diag), STATUS_SCENE);
	assert_null(im.pixel);
	assert_int_equal(f->messages, 1);
	assert_null(strchr(f->text, '\n'));
	if (!strstr(f->text, words) || !strstr(f->text, path))
		fail_msg("\"%s\" does not say \"%s\"", f->text, words);
}

static void test_bad_headers(void **state)
{
	static const struct {
		const char *text, *words;
	} cases[] = {
		{ "P6\n2147483647 2147483647\n255\n", "claims 2147483647 x 2147483647 pixels" },
		{ "P6\n99999999999999999999999 1\n255\n", "header is wrong" },
		{ "P6\n65536 65536\n255\n", "claims 65536 x 65536 pixels" },
		{ "P5\n46340 46340\n65535\n", "ends before its last pixel" },
		{ "P6\n0 4\n255\n", "has no pixels" },
		{ "P6\n-1 4\n255\n", "header is wrong" },
		{ "P6\n4 4\n65536\n", "1 to 65535" },
		{ "P6\n4 4\n0\n", "1 to 65535" },
		{ "P6\n4", "ends before its last pixel" },
		{ "P6\n# comment without end", "ends before its last pixel" },
		{ "P6 4 4 255 ", "ends before its last pixel" },
		{ "PF\n4 4\n0\n", "other than 0" },
		{ "PF\n4 4\nnan\n", "other than 0" },
		{ "PF\n4 4\nlittle\n", "other than 0" },
		{ "PF\n2147483647 1\n-1\n", "the limit is" },
		{ "P", "one byte" },
		{ "\x89PNG\r\n\x1a\n", "ends before its last pixel" },
		{ "\x89PJG\r\n\x1a\nxxxxxxxxxxxxxxxx", "damaged" },
	};
	struct fixture *f = *state;
	const char *path = fixture_path(f, 0, "x");

	for (size_t i = 0; i < sizeof(cases) / sizeof(*cases); i++) {
		fixture_store(path, cases[i].text, strlen(cases[i].text));
		refused(f, path, NULL, cases[i].words);
	}
	fixture_store(path, "", 0);
	refused(f, path, NULL, "is empty");
	refused(f, f->folder, NULL, "folder");
	unlink(path);
	refused(f, path, NULL, "No such file");
#ifndef HAVE_OPENEXR
	fixture_store(path, "v/1\1", 4);
	refused(f, path, NULL, "built without OpenEXR");
#endif
}

/* What stands at the front must be right; nobody is told of comments. */
static void test_comments(void **state)
{
	static const char text[] = "P5 # one\n#two\n2\t# three\n1 255\n\x10\xff";
	struct fixture *f = *state;
	const char *path = fixture_path(f, 0, "x");
	struct image im;

	fixture_store(path, text, sizeof(text) - 1);
	assert_int_equal(image_read(&im, path, &f->book, NULL, &f->diag), STATUS_OK);
	assert_int_equal(im.width, 2);
	assert_true(im.pixel[0] == 16.0f / 255 && im.pixel[1] == 1);
	image_release(&im);
}

static void test_truncated(void **state)
{
	struct fixture *f = *state;

	for (size_t k = 0; k < FORMATS; k++) {
		const char *path = fixture_path(f, 0, format[k]);
		struct image im;
		char *data;
		size_t n;

		fixture_image(f, &im, 9, 40, 3);
		assert_int_equal(image_write(&im, path, 0, NULL, 0, NULL, &f->diag), STATUS_OK);
		image_release(&im);
		data = fixture_load(path, &n);
		for (size_t i = 0; i < n; i += 1 + i / 50) {
			fixture_store(path, data, i);
			refused(f, path, NULL, "");
		}
		fixture_store(path, data, n - 1);
		refused(f, path, NULL, "");
		free(data);
	}
}

/* Any byte may be wrong: that may go unnoticed or be refused, with one line. */
static void test_mutated(void **state)
{
	struct fixture *f = *state;
	const struct image_limits limits = { .pixels = 1 << 20, .bytes = 1 << 24 };
	uint32_t rng = 12345;

	for (size_t k = 0; k < FORMATS; k++) {
		const char *path = fixture_path(f, 0, format[k]);
		struct image im;
		char *data;
		size_t n;

		fixture_image(f, &im, 9, 20, 3);
		assert_int_equal(image_write(&im, path, 0, NULL, 0, NULL, &f->diag), STATUS_OK);
		image_release(&im);
		data = fixture_load(path, &n);
		for (int i = 0; i < 300; i++) {
			size_t at;
			char old;

			rng = rng * 1664525 + 1013904223;
			at = rng % (i & 1 ? n : n < 64 ? n : 64);
			old = data[at];
			rng = rng * 1664525 + 1013904223;
			data[at] = (char)(rng >> 24);
			fixture_store(path, data, n);
			data[at] = old;
			f->messages = 0;
			if (image_read(&im, path, &f->book, &limits, &f->diag))
				assert_int_equal(f->messages, 1);
			image_release(&im);
		}
		free(data);
	}
}

static void test_limits(void **state)
{
	const struct image_limits pixels = { .pixels = 359 }, bytes = { .bytes = 4319 };
	const struct image_limits enough = { .pixels = 360, .bytes = 4320 };
	struct fixture *f = *state;

	for (size_t k = 0; k < FORMATS; k++) {
		const char *path = fixture_path(f, 0, format[k]);
		struct image im;

		fixture_image(f, &im, 9, 40, 3);
		assert_int_equal(image_write(&im, path, 0, NULL, 0, NULL, &f->diag), STATUS_OK);
		image_release(&im);
		refused(f, path, &pixels, "claims 9 x 40 pixels");
		refused(f, path, &bytes, "MiB");
		assert_int_equal(image_read(&im, path, &f->book, &enough, &f->diag), STATUS_OK);
		image_release(&im);
	}
}

/* A size limit on files stands for the full disk: the write fails half way. */
static void test_full_disk(void **state)
{
	struct rlimit old, small;
	struct fixture *f = *state;
	struct image im;
	uint32_t rng = 1;

	fixture_image(f, &im, 200, 200, 3);
	for (uint32_t i = 0; i < 200 * 200 * 3; i++) {
		rng = rng * 1664525 + 1013904223;
		im.pixel[i] = (float)(rng >> 8) / 0x1p24f;
	}
	signal(SIGXFSZ, SIG_IGN);
	assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
	small = old;
	small.rlim_cur = 5000;
	for (size_t k = 0; k < FORMATS; k++) {
		const char *path = fixture_path(f, 0, format[k]);
		char *data;
		size_t n;

		fixture_store(path, "old", 3);
		f->messages = 0;
		assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
		assert_int_equal(image_write(&im, path, 0, NULL, 0, NULL, &f->diag), STATUS_FAILED);
		assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
		assert_int_equal(f->messages, 1);
		assert_non_null(strstr(f->text, "File too large"));
		assert_non_null(strstr(f->text, path));
		assert_int_equal(fixture_count(f), 1);
		data = fixture_load(path, &n);
		assert_true(n == 3 && !memcmp(data, "old", 3));
		free(data);
		unlink(path);
	}
	image_release(&im);
}

/* A device is written to, not replaced. */
static void test_device(void **state)
{
	struct fixture *f = *state;
	struct stat st;
	struct image im;

	if (stat("/dev/full", &st) || !S_ISCHR(st.st_mode))
		skip();
	fixture_image(f, &im, 30, 30, 3);
	for (size_t k = 0; k < FORMATS; k++) {
		const char *path = fixture_path(f, 0, format[k]);

		assert_int_equal(symlink("/dev/full", path), 0);
		f->messages = 0;
		assert_int_equal(image_write(&im, path, 0, NULL, 0, NULL, &f->diag), STATUS_FAILED);
		assert_int_equal(f->messages, 1);
		assert_non_null(strstr(f->text, "No space left"));
		assert_int_equal(lstat(path, &st), 0);
		assert_true(S_ISLNK(st.st_mode));
		unlink(path);
	}
	assert_int_equal(stat("/dev/full", &st), 0);
	assert_true(S_ISCHR(st.st_mode));
	image_release(&im);
}

/* The file that a link names is replaced, its mode kept, and the link stays. */
static void test_link(void **state)
{
	struct fixture *f = *state;
	const char *path = fixture_path(f, 0, "link.png"), *real = fixture_path(f, 1, "real.png");
	struct stat st;
	struct image im;

	fixture_store(real, "old", 3);
	assert_int_equal(chmod(real, 0600), 0);
	assert_int_equal(symlink("real.png", path), 0);
	fixture_image(f, &im, 5, 5, 3);
	assert_int_equal(image_write(&im, path, 0, NULL, 0, NULL, &f->diag), STATUS_OK);
	image_release(&im);
	assert_int_equal(lstat(path, &st), 0);
	assert_true(S_ISLNK(st.st_mode));
	assert_int_equal(lstat(real, &st), 0);
	assert_true(S_ISREG(st.st_mode) && (st.st_mode & 0777) == 0600 && st.st_size > 3);
	assert_int_equal(fixture_count(f), 2);
}

static void cannot(struct fixture *f, const char *path, uint32_t bits, enum status want,
		   const char *words)
{
	uint32_t files = fixture_count(f);
	struct image im;

	fixture_image(f, &im, 5, 5, 3);
	f->messages = 0;
	assert_int_equal(image_can_write(path, bits, &f->diag), want);
	assert_int_equal(f->messages, 1);
	if (!strstr(f->text, words))
		fail_msg("\"%s\" does not say \"%s\"", f->text, words);
	assert_int_equal(image_write(&im, path, bits, NULL, 0, NULL, &f->diag), want);
	assert_int_equal(fixture_count(f), files);
	image_release(&im);
}

static void test_can_write(void **state)
{
	struct fixture *f = *state;

	assert_int_equal(image_can_write(fixture_path(f, 0, "a.png"), 0, &f->diag), STATUS_OK);
	assert_int_equal(image_can_write(fixture_path(f, 0, "a.ppm"), 16, &f->diag), STATUS_OK);
	assert_int_equal(f->messages, 0);
	cannot(f, fixture_path(f, 0, "no/a.png"), 0, STATUS_FAILED, "No such file");
	cannot(f, f->path[0], 0, STATUS_FAILED, "/no");
	cannot(f, fixture_path(f, 0, "a"), 0, STATUS_USAGE, "ending of its name");
	cannot(f, fixture_path(f, 0, "a.png"), 32, STATUS_USAGE, "8 or 16 bits, not 32");
	cannot(f, fixture_path(f, 0, "a.pfm"), 16, STATUS_USAGE, "32 bits, not 16");
	cannot(f, "-.exr", 0, STATUS_USAGE, "standard output");
	cannot(f, "", 0, STATUS_USAGE, "ending");
	mkdir(fixture_path(f, 1, "dir.png"), 0700);
	cannot(f, f->path[1], 0, STATUS_FAILED, "this is a folder");
	rmdir(f->path[1]);
	if (geteuid()) {
		assert_int_equal(chmod(f->folder, 0500), 0);
		cannot(f, fixture_path(f, 0, "a.png"), 0, STATUS_FAILED, "Permission denied");
		assert_int_equal(chmod(f->folder, 0700), 0);
		fixture_store(f->path[0], "old", 3);
		assert_int_equal(chmod(f->path[0], 0400), 0);
		cannot(f, f->path[0], 0, STATUS_FAILED, "cannot replace");
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
#define T(name) cmocka_unit_test_setup_teardown(name, fixture_setup, fixture_teardown)
		T(test_bad_headers), T(test_comments), T(test_truncated),
		T(test_mutated),     T(test_limits),   T(test_full_disk),
		T(test_device),	     T(test_link),     T(test_can_write),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
