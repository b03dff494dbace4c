/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pictures as textures: samples as the files have them, whatever kind of PNG, JPEG or PPM; limits; files that
 * lie or are cut short.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "image_fixture.h"

#include <png.h>

#include "image/raw.h"

#ifdef HAVE_JPEG
#include <jpeglib.h>
#endif

#define WIDTH 7
#define HEIGHT 5

static const struct image_limits no_limits;

static uint32_t sample_of(uint32_t x, uint32_t y, uint32_t c, uint32_t top)
{
	return (x * 37 + y * 61 + c * 101 + 11) % (top + 1);
}

struct kind {
	int colour, depth, interlace;
	uint32_t channels;
};

static void put_sample(unsigned char *row, uint32_t i, uint32_t v, int depth)
{
	if (depth == 16) {
		row[2 * i] = (unsigned char)(v >> 8);
		row[2 * i + 1] = (unsigned char)v;
	} else {
		uint32_t bit = i * (uint32_t)depth;

		row[bit / 8] |= (unsigned char)(v << (8 - (uint32_t)depth - bit % 8));
	}
}

static void write_png(const char *path, const struct kind *k, double gamma)
{
	png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
	png_infop info = png_create_info_struct(png);
	unsigned char row[HEIGHT][WIDTH * 8] = { { 0 } };
	png_byte alpha[2] = { 0, 128 };
	png_color palette[256];
	FILE *out = fopen(path, "wb");
	png_bytep rows[HEIGHT];

	assert_non_null(out);
	png_init_io(png, out);
	png_set_IHDR(png, info, WIDTH, HEIGHT, k->depth, k->colour, k->interlace, 0, 0);
	for (int i = 0; i < 256; i++)
		palette[i] = (png_color){ (png_byte)i, (png_byte)(255 - i), (png_byte)(i * 3) };
	if (k->colour == PNG_COLOR_TYPE_PALETTE) {
		png_set_PLTE(png, info, palette, 1 << k->depth);
		png_set_tRNS(png, info, alpha, 2, NULL);
	}
	if (gamma > 0)
		png_set_gAMA(png, info, gamma);
	for (uint32_t y = 0; y < HEIGHT; y++) {
		for (uint32_t i = 0; i < WIDTH * k->channels; i++)
			put_sample(row[y], i, sample_of(i / k->channels, y, i % k->channels, (1u << k->depth) - 1),
				   k->depth);
		rows[y] = row[y];
	}
	png_write_info(png, info);
	png_write_image(png, rows);
	png_write_end(png, info);
	png_destroy_write_struct(&png, &info);
	assert_int_equal(fclose(out), 0);
}

static void read_good(struct fixture *f, struct image_raw *raw, const char *path)
{
	if (image_raw_read(raw, path, &f->book, &no_limits, &f->diag))
		fail_msg("%s", f->text);
	assert_int_equal(raw->width, WIDTH);
	assert_int_equal(raw->height, HEIGHT);
}

static const struct kind png_kind[] = {
	{ PNG_COLOR_TYPE_GRAY, 1, 0, 1 },	{ PNG_COLOR_TYPE_GRAY, 2, 0, 1 },
	{ PNG_COLOR_TYPE_GRAY, 4, 1, 1 },	{ PNG_COLOR_TYPE_GRAY, 8, 0, 1 },
	{ PNG_COLOR_TYPE_GRAY, 16, 1, 1 },	{ PNG_COLOR_TYPE_GRAY_ALPHA, 8, 1, 2 },
	{ PNG_COLOR_TYPE_GRAY_ALPHA, 16, 0, 2 }, { PNG_COLOR_TYPE_RGB, 8, 1, 3 },
	{ PNG_COLOR_TYPE_RGB, 16, 0, 3 },	{ PNG_COLOR_TYPE_RGB_ALPHA, 8, 0, 4 },
	{ PNG_COLOR_TYPE_RGB_ALPHA, 16, 1, 4 }, { PNG_COLOR_TYPE_PALETTE, 1, 0, 1 },
	{ PNG_COLOR_TYPE_PALETTE, 2, 1, 1 },	{ PNG_COLOR_TYPE_PALETTE, 4, 0, 1 },
	{ PNG_COLOR_TYPE_PALETTE, 8, 1, 1 },
};

static void test_png_kinds(void **state)
{
	struct fixture *f = *state;
	const char *path = fixture_path(f, 0, "a.png");

	for (size_t k = 0; k < sizeof(png_kind) / sizeof(*png_kind); k++) {
		const struct kind *kind = &png_kind[k];
		bool palette = kind->colour == PNG_COLOR_TYPE_PALETTE;
		uint32_t top = (1u << kind->depth) - 1, spread = !palette && kind->depth < 8 ? 255 / top : 1;
		struct image_raw raw;

		write_png(path, kind, 0);
		read_good(f, &raw, path);
		assert_int_equal(raw.channels, kind->channels);
		assert_int_equal(raw.depth, kind->depth == 16 ? IMAGE_16 : IMAGE_8);
		assert_int_equal(raw.palette_count, palette ? 1 << kind->depth : 0);
		for (uint32_t i = 0; i < WIDTH * HEIGHT * kind->channels; i++) {
			uint32_t at = i / kind->channels, c = i % kind->channels;
			uint32_t want = spread * sample_of(at % WIDTH, at / WIDTH, c, top);

			assert_int_equal(raw.depth == IMAGE_16 ? ((uint16_t *)raw.sample)[i] :
								 ((uint8_t *)raw.sample)[i], want);
		}
		for (uint32_t i = 0; i < raw.palette_count; i++) {
			assert_int_equal(raw.palette[4 * i], i);
			assert_int_equal(raw.palette[4 * i + 1], 255 - i);
			assert_int_equal(raw.palette[4 * i + 3], i == 0 ? 0 : i == 1 ? 128 : 255);
		}
		assert_int_equal(raw.palette_alpha, palette);
		image_raw_release(&raw);
	}
}

static void test_png_gamma(void **state)
{
	struct fixture *f = *state;
	const char *path = fixture_path(f, 0, "a.png");
	struct image_raw raw;

	write_png(path, &png_kind[7], 0);
	read_good(f, &raw, path);
	assert_int_equal(raw.curve, IMAGE_CURVE_SRGB);
	assert_false(raw.stated);
	image_raw_release(&raw);
	write_png(path, &png_kind[7], 0.5);
	read_good(f, &raw, path);
	assert_int_equal(raw.curve, IMAGE_CURVE_POWER);
	assert_true(raw.stated);
	assert_true(raw.gamma > 1.9999 && raw.gamma < 2.0001);
	image_raw_release(&raw);
}

static void test_pnm(void **state)
{
	static const char small[] = "P6 # of 10\n2 1\n10\n\0\5\12\1\2\3", wide[] = "P5 2 1 1000\n\0\0\3\350";
	struct fixture *f = *state;
	const char *path = fixture_path(f, 0, "a.ppm");
	struct image_raw raw;
	const uint8_t *byte;

	fixture_store(path, small, sizeof(small) - 1);
	assert_int_equal(image_raw_read(&raw, path, &f->book, &no_limits, &f->diag), STATUS_OK);
	assert_string_equal(raw.format, "ppm");
	assert_int_equal(raw.curve, IMAGE_CURVE_NONE);
	byte = raw.sample;
	assert_int_equal(byte[0], 0);
	assert_int_equal(byte[1], 128); /* half of 255, rounded */
	assert_int_equal(byte[2], 255);
	image_raw_release(&raw);
	fixture_store(path, wide, sizeof(wide) - 1);
	assert_int_equal(image_raw_read(&raw, path, &f->book, &no_limits, &f->diag), STATUS_OK);
	assert_int_equal(raw.depth, IMAGE_16);
	assert_int_equal(((uint16_t *)raw.sample)[0], 0);
	assert_int_equal(((uint16_t *)raw.sample)[1], 65535);
	image_raw_release(&raw);
}

static void test_floats(void **state)
{
	struct fixture *f = *state;
	const char *path = fixture_path(f, 0, "a.pfm");
	struct image_raw raw;
	struct image im;

	fixture_image(f, &im, WIDTH, HEIGHT, 3);
	assert_int_equal(image_write(&im, path, 32, NULL, 0, NULL, &f->diag), STATUS_OK);
	read_good(f, &raw, path);
	assert_int_equal(raw.depth, IMAGE_FLOAT);
	assert_memory_equal(raw.sample, im.pixel, sizeof(float) * WIDTH * HEIGHT * 3);
	image_raw_release(&raw);
#ifdef HAVE_OPENEXR
	/* Channels beyond colour are left, colour is put in order. */
	image_release(&im);
	fixture_image(f, &im, WIDTH, HEIGHT, 5);
	for (uint32_t i = 0; i < 5; i++)
		strcpy(im.name[i], (const char *[]){ "Depth.Z", "A", "B", "G", "R" }[i]);
	im.premultiplied = true;
	path = fixture_path(f, 0, "a.exr");
	assert_int_equal(image_write(&im, path, 32, NULL, 0, NULL, &f->diag), STATUS_OK);
	read_good(f, &raw, path);
	assert_int_equal(raw.channels, 4);
	assert_true(raw.premultiplied);
	for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
		for (uint32_t c = 0; c < 4; c++)
			assert_true(((float *)raw.sample)[4 * i + c] == im.pixel[5 * i + (c < 3 ? 4 - c : 1)]);
	}
	image_raw_release(&raw);
#endif
	image_release(&im);
}

static void expect_bad(struct fixture *f, const char *path, const struct image_limits *limits, const char *text)
{
	struct image_raw raw;
	uint32_t before = f->messages;

	assert_int_equal(image_raw_read(&raw, path, &f->book, limits, &f->diag), STATUS_SCENE);
	assert_int_equal(f->messages, before + 1);
	if (!strstr(f->text, text))
		fail_msg("\"%s\" is not in: %s", text, f->text);
	assert_null(raw.sample);
}

static void test_limits(void **state)
{
	struct fixture *f = *state;
	const char *path = fixture_path(f, 0, "a.png");
	struct image_limits bytes = { .bytes = WIDTH * HEIGHT * 8 }, pixels = { .pixels = WIDTH * HEIGHT };
	struct image_raw raw;

	write_png(path, &png_kind[10], 0); /* 8 bytes a pixel */
	assert_int_equal(image_raw_read(&raw, path, &f->book, &bytes, &f->diag), STATUS_OK);
	image_raw_release(&raw);
	assert_int_equal(image_raw_read(&raw, path, &f->book, &pixels, &f->diag), STATUS_OK);
	image_raw_release(&raw);
	bytes.bytes--;
	pixels.pixels--;
	expect_bad(f, path, &bytes, "of memory");
	expect_bad(f, path, &pixels, "the limit is 34");
}

/* A header that claims 16 GiB; nothing of that may be taken. */
static void test_bomb(void **state)
{
	static const unsigned char head[] = {
		0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0, 1, 0, 0,
		0,    1,   0,	0,   8,	 6,  0,	 0,  0, 0x6c, 0x84, 0x30, 0xe3, 0, 0, 0, 0, 'I', 'D', 'A', 'T'
	};
	struct fixture *f = *state;
	const char *path = fixture_path(f, 0, "bomb.png");
	struct image_limits limits = { .pixels = 1 << 28, .bytes = 1 << 30 };

	fixture_store(path, head, sizeof(head));
	expect_bad(f, path, &limits, "65536 x 65536 pixels; the limit is 268435456");
	fixture_store(path, "P6 60000 60000 255\n", 19);
	expect_bad(f, path, &limits, "60000 x 60000 pixels; the limit is 268435456");
	assert_true(atomic_load(&f->book.peak) < 1 << 20);
}

/* Every prefix, and every byte changed: an error or a picture, never a crash, leak or more than one line. */
static void harm(struct fixture *f, const char *name)
{
	const char *path = fixture_path(f, 0, name);
	struct image_limits limits = { .pixels = 1 << 20, .bytes = 1 << 24 };
	struct image_raw raw;
	char *data;
	size_t n;

	data = fixture_load(path, &n);
	for (size_t i = 0; i < 2 * n; i++) {
		uint32_t before = f->messages;

		if (i < n) {
			fixture_store(path, data, i);
		} else {
			data[i - n] = (char)(data[i - n] ^ (1 << i % 8));
			fixture_store(path, data, n);
			data[i - n] = (char)(data[i - n] ^ (1 << i % 8));
		}
		if (image_raw_read(&raw, path, &f->book, &limits, &f->diag))
			assert_int_equal(f->messages, before + 1);
		else
			image_raw_release(&raw);
		assert_true(f->messages <= before + 1);
		assert_null(strchr(f->text, '\n'));
	}
	free(data);
}

static void test_harmed_png(void **state)
{
	struct fixture *f = *state;

	for (size_t k = 4; k < sizeof(png_kind) / sizeof(*png_kind); k += 5) {
		write_png(fixture_path(f, 0, "a.png"), &png_kind[k], 0.45455);
		harm(f, "a.png");
	}
}

#ifdef HAVE_JPEG

static void write_jpeg(const char *path, J_COLOR_SPACE space, int channels, bool progressive)
{
	struct jpeg_compress_struct jpeg;
	struct jpeg_error_mgr error;
	JSAMPLE row[WIDTH * 4];
	JSAMPROW rows = row;
	FILE *out = fopen(path, "wb");

	assert_non_null(out);
	jpeg.err = jpeg_std_error(&error);
	jpeg_create_compress(&jpeg);
	jpeg_stdio_dest(&jpeg, out);
	jpeg.image_width = WIDTH;
	jpeg.image_height = HEIGHT;
	jpeg.input_components = channels;
	jpeg.in_color_space = space;
	jpeg_set_defaults(&jpeg);
	jpeg_set_quality(&jpeg, 100, TRUE);
	if (progressive)
		jpeg_simple_progression(&jpeg);
	jpeg_start_compress(&jpeg, TRUE);
	for (uint32_t y = 0; y < HEIGHT; y++) {
		for (uint32_t i = 0; i < WIDTH * (uint32_t)channels; i++)
			row[i] = (JSAMPLE)(20 * (i / (uint32_t)channels) + 10 * y + 40 * (i % (uint32_t)channels));
		(void)jpeg_write_scanlines(&jpeg, &rows, 1);
	}
	jpeg_finish_compress(&jpeg);
	jpeg_destroy_compress(&jpeg);
	assert_int_equal(fclose(out), 0);
}

static void test_jpeg_kinds(void **state)
{
	struct fixture *f = *state;
	const char *path = fixture_path(f, 0, "a.jpg");

	for (int k = 0; k < 4; k++) {
		uint32_t channels = k & 1 ? 3 : 1;
		struct image_raw raw;

		write_jpeg(path, k & 1 ? JCS_RGB : JCS_GRAYSCALE, (int)channels, k & 2);
		read_good(f, &raw, path);
		assert_int_equal(raw.channels, channels);
		assert_string_equal(raw.format, "jpeg");
		for (uint32_t i = 0; i < WIDTH * HEIGHT * channels; i++) {
			uint32_t at = i / channels;
			int want = (int)(20 * (at % WIDTH) + 10 * (at / WIDTH) + 40 * (i % channels));

			/* colour is kept at half the resolution */
			assert_true(abs(((uint8_t *)raw.sample)[i] - want) <= (channels > 1 ? 12 : 2));
		}
		image_raw_release(&raw);
	}
	write_jpeg(path, JCS_CMYK, 4, false);
	expect_bad(f, path, &no_limits, "CMYK");
	/* A progressive picture takes more memory while it is read. */
	write_jpeg(path, JCS_RGB, 3, true);
	expect_bad(f, path, &(struct image_limits){ .bytes = WIDTH * HEIGHT * 3 }, "progressive");
}

static void test_harmed_jpeg(void **state)
{
	struct fixture *f = *state;

	write_jpeg(fixture_path(f, 0, "a.jpg"), JCS_RGB, 3, false);
	harm(f, "a.jpg");
	write_jpeg(fixture_path(f, 0, "a.jpg"), JCS_GRAYSCALE, 1, true);
	harm(f, "a.jpg");
}

#endif

static void test_lies(void **state)
{
	struct fixture *f = *state;
	const char *path = fixture_path(f, 0, "a.jpg");
	struct image_raw raw;

	/* The contents decide. */
	write_png(path, &png_kind[7], 0);
	read_good(f, &raw, path);
	assert_string_equal(raw.format, "png");
	image_raw_release(&raw);
	fixture_store(path, "", 0);
	expect_bad(f, path, &no_limits, "empty");
	expect_bad(f, f->folder, &no_limits, "folder");
	expect_bad(f, "/nowhere/at/all.png", &no_limits, "cannot open");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
#define TEST(t) cmocka_unit_test_setup_teardown(t, fixture_setup, fixture_teardown)
		TEST(test_png_kinds), TEST(test_png_gamma), TEST(test_pnm), TEST(test_floats),
		TEST(test_limits), TEST(test_bomb), TEST(test_lies), TEST(test_harmed_png),
#ifdef HAVE_JPEG
		TEST(test_jpeg_kinds), TEST(test_harmed_jpeg),
#endif
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
