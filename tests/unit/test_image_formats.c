/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Each format gives back what was written; encodings against their formula.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <math.h>

#include "image_fixture.h"

#include "base/pool.h"
#include "base/rng.h"
#include "image/half.h"
#include "image/srgb_table.h"

static double srgb_exact(double x)
{
	x = x < 0 ? 0 : x > 1 ? 1 : x;
	return x <= 0.0031308 ? x * 12.92 : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

static void write_and_read(struct fixture *f, const struct image *im, const char *name,
			   uint32_t bits, struct image *back)
{
	const char *path = fixture_path(f, 0, name);

	if (image_write(im, path, bits, NULL, 0, NULL, &f->diag))
		fail_msg("%s", f->text);
	if (image_read(back, path, &f->book, NULL, &f->diag))
		fail_msg("%s", f->text);
	assert_int_equal(back->width, im->width);
	assert_int_equal(back->height, im->height);
	assert_int_equal(fixture_count(f), 1);
}

static void test_integer_formats(void **state)
{
	static const struct {
		const char *name;
		uint32_t bits, channels;
	} cases[] = {
		{ "a.png", 8, 3 },  { "a.png", 16, 3 }, { "a.png", 8, 1 }, { "a.png", 16, 1 },
		{ "a.ppm", 8, 3 },  { "a.ppm", 16, 3 }, { "a.pgm", 8, 1 }, { "A.PPM", 16, 1 },
		{ "a.pnm", 16, 1 },
	};
	struct fixture *f = *state;

	for (size_t k = 0; k < sizeof(cases) / sizeof(*cases); k++) {
		double top = cases[k].bits == 8 ? 255 : 65535;
		struct image im, back;

		fixture_image(f, &im, 37, 21, cases[k].channels);
		im.pixel[0] = -1;
		im.pixel[1] = 7;
		im.pixel[2] = NAN;
		im.pixel[3] = INFINITY;
		im.pixel[4] = -INFINITY;
		write_and_read(f, &im, cases[k].name, cases[k].bits, &back);
		assert_int_equal(back.channels, im.channels);
		assert_int_equal(back.bits, cases[k].bits);
		assert_int_equal(back.encoding, IMAGE_SRGB);
		for (uint32_t i = 0; i < 37 * 21 * im.channels; i++) {
			double v = i == 2 ? 0 : (double)im.pixel[i];
			float want = (float)(floor(srgb_exact(v) * top + 0.5) / top);

			if (memcmp(&want, &back.pixel[i], sizeof(want)))
				fail_msg("%s %u: sample %u is %g, not %g", cases[k].name,
					 cases[k].bits, i, (double)back.pixel[i], (double)want);
		}
		image_release(&im);
		image_release(&back);
		unlink(f->path[0]);
	}
}

/* What is sRGB already goes through unchanged, all 65,536 values of it. */
static void test_srgb_is_kept(void **state)
{
	struct fixture *f = *state;
	struct image im, back;

	fixture_image(f, &im, 256, 256, 1);
	im.encoding = IMAGE_SRGB;
	for (uint32_t i = 0; i < 65536; i++)
		im.pixel[i] = (float)(i / 65535.0);
	write_and_read(f, &im, "a.png", 16, &back);
	assert_memory_equal(im.pixel, back.pixel, 65536 * sizeof(float));
	image_release(&im);
	image_release(&back);
}

static void test_float_formats(void **state)
{
	static const char *const name[] = { "a.pfm", "a.exr" };
	struct fixture *f = *state;

	for (size_t k = 0; k < 2; k++) {
		struct image im, back;

		fixture_image(f, &im, 19, 53, 3);
		im.pixel[0] = NAN;
		im.pixel[1] = INFINITY;
		im.pixel[2] = -INFINITY;
		im.pixel[3] = -1e30f;
		im.pixel[4] = 1e-42f;
		im.pixel[5] = -0.0f;
#ifndef HAVE_OPENEXR
		if (k == 1) {
			assert_int_equal(image_write(&im, "a.exr", 0, NULL, 0, NULL, &f->diag),
					 STATUS_USAGE);
			image_release(&im);
			continue;
		}
#endif
		write_and_read(f, &im, name[k], 0, &back);
		assert_int_equal(back.bits, 32);
		assert_int_equal(back.encoding, IMAGE_LINEAR);
		assert_memory_equal(im.pixel, back.pixel, 19 * 53 * 3 * sizeof(float));
		assert_int_equal(image_nonfinite(&back), 3);
		image_release(&im);
		image_release(&back);
		unlink(f->path[0]);
	}
}

#ifdef HAVE_OPENEXR
static void test_exr_layers(void **state)
{
	static const char *const name[] = {
		"R",	    "G",	"B",
		"A",	    "Depth.Z",	"Normal.X",
		"Normal.Y", "Normal.Z", "a layer with a rather long name.R"
	};
	struct fixture *f = *state;
	struct image im, back;

	fixture_image(f, &im, 40, 35, 9);
	im.premultiplied = true;
	for (uint32_t i = 0; i < 9; i++)
		strcpy(im.name[i], name[8 - i]);
	write_and_read(f, &im, "a.exr", 32, &back);
	assert_int_equal(back.channels, 9);
	for (uint32_t i = 0; i < 9; i++) {
		assert_string_equal(back.name[i], name[i]);
		for (uint32_t p = 0; p < 40 * 35; p++)
			assert_true(back.pixel[p * 9 + i] == im.pixel[p * 9 + 8 - i]);
	}
	image_release(&im);
	image_release(&back);
}

/* Half is for light; depth keeps its precision. */
static void test_exr_half(void **state)
{
	struct fixture *f = *state;
	struct image im, back;

	fixture_image(f, &im, 64, 20, 4);
	strcpy(im.name[3], "Depth.Z");
	im.pixel[0] = 1e6f;
	im.pixel[1] = -INFINITY;
	im.pixel[2] = NAN;
	im.pixel[4] = 1.0f + 0x1p-11f; /* ties to even: 1 */
	im.pixel[5] = 1.0f + 0x1p-11f + 0x1p-23f;
	im.pixel[6] = 0x1p-24f;
	im.pixel[8] = 0x1p-25f; /* a tie: 0 */
	im.pixel[9] = 0x1.8p-24f;
	write_and_read(f, &im, "a.exr", 16, &back);
	assert_true(back.pixel[0] == HALF_MAX);
	assert_true(back.pixel[1] == -INFINITY);
	assert_true(isnan(back.pixel[2]));
	assert_true(back.pixel[4] == 1.0f);
	assert_true(back.pixel[5] == 1.0f + 0x1p-10f);
	assert_true(back.pixel[6] == 0x1p-24f);
	assert_true(back.pixel[8] == 0.0f);
	assert_true(back.pixel[9] == 0x1p-23f);
	for (uint32_t p = 5; p < 64 * 20; p++) {
		assert_true(back.pixel[p * 4 + 3] == im.pixel[p * 4 + 3]);
		assert_true(fabsf(back.pixel[p * 4] - im.pixel[p * 4]) <=
			    im.pixel[p * 4] * 0x1p-11f);
	}
	image_release(&im);
	image_release(&back);
}

/* What hardly compresses: among so many, some come out exactly as long as they were. */
static void test_exr_incompressible(void **state)
{
	struct fixture *f = *state;
	struct image im, back;

	for (uint32_t k = 0; k < 200; k++) {
		fixture_image(f, &im, 40, 2, 3);
		for (uint32_t i = 0; i < 40 * 2 * 3; i++)
			im.pixel[i] = (float)floor(rng_unit(rng_child(k, i)) * 5000) / 65536;
		write_and_read(f, &im, "a.exr", 32, &back);
		assert_memory_equal(im.pixel, back.pixel, 40 * 2 * 3 * sizeof(float));
		image_release(&im);
		image_release(&back);
	}
}

static void test_exr_names(void **state)
{
	struct fixture *f = *state;
	struct image im;

	fixture_image(f, &im, 4, 4, 3);
	strcpy(im.name[2], "R");
	assert_int_equal(image_write(&im, fixture_path(f, 0, "a.exr"), 0, NULL, 0, NULL, &f->diag),
			 STATUS_FAILED);
	assert_non_null(strstr(f->text, "two channels of the picture are named \"R\""));
	im.name[2][0] = '\0';
	assert_int_equal(image_write(&im, f->path[0], 0, NULL, 0, NULL, &f->diag), STATUS_FAILED);
	assert_non_null(strstr(f->text, "channel 3 of the picture has no name"));
	assert_int_equal(fixture_count(f), 0);
	image_release(&im);
}
#endif

static void test_alpha(void **state)
{
	static const float pixel[] = { 0.25f, 0.125f, 0,    0.5f, 0.2f, 0.2f,
				       0.2f,  0,      0.5f, 0.5f, 0.5f, 1 };
	struct fixture *f = *state;
	struct image im, back;

	fixture_image(f, &im, 3, 1, 4);
	memcpy(im.pixel, pixel, sizeof(pixel));
	im.premultiplied = true;
	write_and_read(f, &im, "a.png", 16, &back);
	assert_false(back.premultiplied);
	assert_float_equal(back.pixel[0], srgb_exact(0.5), 1e-5);
	assert_float_equal(back.pixel[1], srgb_exact(0.25), 1e-5);
	assert_float_equal(back.pixel[3], 0.5, 1e-5);
	assert_float_equal(back.pixel[4], 0, 0);
	assert_float_equal(back.pixel[8], srgb_exact(0.5), 1e-5);
	image_release(&im);
	/* Straight again to PPM: over black, and no warning for it. */
	f->messages = 0;
	write_and_read(f, &back, "a.png", 16, &im);
	image_release(&im);
	assert_int_equal(image_write(&back, fixture_path(f, 1, "b.ppm"), 16, NULL, 0, NULL, &f->diag),
			 STATUS_OK);
	assert_int_equal(image_read(&im, f->path[1], &f->book, NULL, &f->diag), STATUS_OK);
	assert_int_equal(f->messages, 0);
	assert_float_equal(im.pixel[0], srgb_exact(0.25), 3e-5);
	assert_float_equal(im.pixel[3], 0, 0);
	image_release(&im);
	image_release(&back);
}

/* Layers don't fit into a PNG: said, not hidden. */
static void test_left_out(void **state)
{
	struct fixture *f = *state;
	struct image im, back;

	fixture_image(f, &im, 5, 5, 5);
	strcpy(im.name[0], "Depth.Z");
	strcpy(im.name[1], "B");
	strcpy(im.name[2], "G");
	strcpy(im.name[3], "R");
	strcpy(im.name[4], "Heat.R");
	write_and_read(f, &im, "a.png", 8, &back);
	assert_int_equal(f->messages, 1);
	assert_non_null(strstr(f->text, "2 of the picture's 5 channels are left out"));
	assert_int_equal(back.channels, 3);
	assert_float_equal(back.pixel[0], (float)srgb_exact((double)im.pixel[3]), 0.00197f);
	image_release(&back);
	strcpy(im.name[3], "X");
	assert_int_equal(image_write(&im, f->path[0], 8, NULL, 0, NULL, &f->diag), STATUS_FAILED);
	assert_non_null(strstr(f->text, "neither the channels R, G and B nor Y"));
	image_release(&im);
}

static void test_notes(void **state)
{
	static const struct image_note note[] = { { "Software", "Alidade 1" },
						  { "alidade:accel", "octree:leaf=4" },
						  { "Comment", "Gr\xc3\xbc\xc3\x9f" "e" } };
	static const char *const name[] = { "a.png", "a.exr" };
	struct fixture *f = *state;
	struct image im;
	char *data, *again;
	size_t n, m;

	fixture_image(f, &im, 8, 8, 3);
	for (size_t k = 0; k < 2; k++) {
#ifndef HAVE_OPENEXR
		if (k == 1)
			break;
#endif
		assert_int_equal(
			image_write(&im, fixture_path(f, 0, name[k]), 0, note, 3, NULL, &f->diag),
			STATUS_OK);
		data = fixture_load(f->path[0], &n);
		assert_non_null(memmem(data, n, "octree:leaf=4", 13));
		assert_non_null(memmem(data, n, "Gr\xc3\xbc\xc3\x9f" "e", 7));
		assert_null(memmem(data, n, "tIME", 4));
		/* The same picture gives the same bytes. */
		assert_int_equal(image_write(&im, f->path[0], 0, note, 3, NULL, &f->diag), STATUS_OK);
		again = fixture_load(f->path[0], &m);
		assert_int_equal(n, m);
		assert_memory_equal(data, again, n);
		free(data);
		free(again);
	}
	image_release(&im);
}

static void test_srgb_curve(void **state)
{
	(void)state;
	for (int i = 0; i <= 10000; i++) {
		double x = i / 10000.0;

		assert_float_equal(srgb_encode(x), srgb_exact(x), 0);
		assert_float_equal(srgb_decode(srgb_encode(x)), x, 1e-7);
	}
	assert_true(srgb_encode(-1) == 0 && srgb_encode(2) == 1 && srgb_encode(1) == 1);
	assert_true(isnan(srgb_encode((double)NAN)));
}

/* Bytes are looked up: on both sides of each byte's least float, and in between, they are what the curve says. */
static void test_srgb_bytes(void **state)
{
	static const char *const name[] = { "a.png", "a.ppm" };
	struct fixture *f = *state;
	struct image im, back;
	uint32_t n = 0;

	fixture_image(f, &im, 256, 256, 1);
	im.pixel[n++] = (float)NAN;
	im.pixel[n++] = -1;
	im.pixel[n++] = INFINITY;
	for (uint32_t q = 1; q < 256; q++) {
		im.pixel[n++] = srgb_least[q];
		im.pixel[n++] = nextafterf(srgb_least[q], 0);
	}
	for (uint32_t i = 0; n < 65536; i++)
		im.pixel[n++] = (float)pow(rng_unit(i), 1 + i % 8);
	for (int k = 0; k < 2; k++) {
		write_and_read(f, &im, name[k], 8, &back);
		for (uint32_t i = 0; i < 65536; i++) {
			double v = (double)im.pixel[i], q = v > 0 ? floor(srgb_exact(v) * 255 + 0.5) : 0;

			assert_float_equal(back.pixel[i] * 255, q, 1e-4);
		}
		image_release(&back);
		unlink(f->path[0]);
	}
	for (uint32_t q = 1; q < 256; q++) {
		assert_true(floor(srgb_exact((double)srgb_least[q]) * 255 + 0.5) == q);
		assert_true(floor(srgb_exact((double)nextafterf(srgb_least[q], 0)) * 255 + 0.5) == q - 1);
	}
	image_release(&im);
}

static void same_bytes(const char *a, const char *b)
{
	FILE *x = fopen(a, "rb"), *y = fopen(b, "rb");
	int c;

	assert_non_null(x);
	assert_non_null(y);
	while ((c = getc(x)) == getc(y) && c != EOF)
		;
	assert_true(c == EOF && feof(x) && feof(y));
	fclose(x);
	fclose(y);
}

/* Strips and chunks, more of them than are held at once, give the same file whoever makes them. */
static void test_threads(void **state)
{
	static const struct {
		const char *name[2];
		uint32_t bits, width, height;
		double error;
	} cases[] = {
		{ { "a.png", "b.png" }, 16, 900, 1111, 0.5 / 65535 },
		{ { "a.png", "b.png" }, 8, 50000, 3, 0.5 / 255 }, /* a strip is a row */
		{ { "a.png", "b.png" }, 8, 1, 1, 0.5 / 255 },
#ifdef HAVE_OPENEXR
		{ { "a.exr", "b.exr" }, 32, 100, 1111, 0 },
#endif
	};
	struct fixture *f = *state;
	struct pool *pool = pool_new(3);

	assert_non_null(pool);
	for (size_t k = 0; k < sizeof(cases) / sizeof(*cases); k++) {
		const char *alone = fixture_path(f, 0, cases[k].name[0]), *all = fixture_path(f, 1, cases[k].name[1]);
		size_t n = (size_t)cases[k].width * cases[k].height * 3;
		struct image im, back;

		fixture_image(f, &im, cases[k].width, cases[k].height, 3);
		im.encoding = cases[k].bits == 32 ? IMAGE_LINEAR : IMAGE_SRGB;
		for (size_t i = 0; i < n; i += 7) /* not only a ramp */
			im.pixel[i] = 1 - im.pixel[i];
		assert_int_equal(image_write(&im, alone, cases[k].bits, NULL, 0, NULL, &f->diag), STATUS_OK);
		assert_int_equal(image_write(&im, all, cases[k].bits, NULL, 0, pool, &f->diag), STATUS_OK);
		same_bytes(alone, all);
		assert_int_equal(image_read(&back, all, &f->book, NULL, &f->diag), STATUS_OK);
		for (size_t i = 0; i < n; i++)
			assert_true(fabs((double)back.pixel[i] - (double)im.pixel[i]) <= cases[k].error * 1.001);
		image_release(&im);
		image_release(&back);
	}
	pool_free(pool);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
#define T(name) cmocka_unit_test_setup_teardown(name, fixture_setup, fixture_teardown)
		T(test_integer_formats), T(test_srgb_is_kept), T(test_float_formats), T(test_threads),
#ifdef HAVE_OPENEXR
		T(test_exr_layers), T(test_exr_half), T(test_exr_incompressible), T(test_exr_names),
#endif
		T(test_alpha), T(test_left_out), T(test_notes), T(test_srgb_curve), T(test_srgb_bytes),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
