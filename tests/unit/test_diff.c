/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <math.h>

#include "image_fixture.h"

#include "image/diff.h"

struct pair {
	struct image a, b, picture;
	struct diff_options opt;
	struct diff_result r;
};

/* Two grey pictures, 100 x 100. */
static void pair_make(struct fixture *f, struct pair *p, uint32_t channels)
{
	memset(p, 0, sizeof(*p));
	fixture_image(f, &p->a, 100, 100, channels);
	fixture_image(f, &p->b, 100, 100, channels);
	for (uint32_t i = 0; i < 10000 * channels; i++)
		p->a.pixel[i] = p->b.pixel[i] = 0.5f;
	diff_options_init(&p->opt);
}

static enum diff_verdict pair_diff(struct fixture *f, struct pair *p)
{
	if (image_diff(&p->a, &p->b, &p->opt, &p->r, NULL, &f->book, &f->diag))
		fail_msg("%s", f->text);
	return p->r.verdict;
}

static void pair_release(struct pair *p)
{
	image_release(&p->a);
	image_release(&p->b);
	image_release(&p->picture);
}

static bool near(double a, double b)
{
	return fabs(a - b) <= 1e-7;
}

static void test_same(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 4);
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	assert_true(p.r.mean == 0 && p.r.rms == 0 && p.r.max == 0 && p.r.p99 == 0 &&
		    isinf(p.r.psnr));
	assert_int_equal(p.r.reasons, 0);
	pair_release(&p);
}

static void test_figures(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 3);
	for (uint32_t i = 0; i < 100; i++)
		p.b.pixel[(i * 100 + i) * 3 + 1] = 0.75f;
	p.b.pixel[(40 * 100 + 70) * 3 + 2] = 0.0f;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	assert_true(near(p.r.channel_mean[0], 0));
	assert_true(near(p.r.channel_mean[1], 0.25 / 100));
	assert_true(near(p.r.channel_mean[2], -0.5 / 10000));
	assert_true(near(p.r.mean, (25 - 0.5) / 30000));
	assert_true(near(p.r.rms, sqrt((100 * 0.0625 + 0.25) / 30000)));
	assert_true(near(p.r.psnr, -20 * log10(p.r.rms)));
	assert_true(p.r.max == 0.5 && p.r.max_x == 70 && p.r.max_y == 40 && p.r.max_channel == 2);
	assert_true(p.r.max_sample[0] == 0.5 && p.r.max_sample[1] == 0);
	assert_int_equal(p.r.over_fail, 101);
	/* The 9,900th of 10,000 in order: 9,899 are equal. */
	assert_true(p.r.p99 == 0.25);
	p.b.pixel[(40 * 100 + 70) * 3 + 2] = 0.5f;
	pair_diff(f, &p);
	assert_true(p.r.p99 == 0);
	pair_release(&p);
}

/* Ten of 10,000 pixels off by 0.1: the thresholds of idiff, and where we differ from it. */
static void test_thresholds(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 3);
	for (uint32_t i = 0; i < 10; i++)
		p.b.pixel[(i * 997) * 3] = 0.6f;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	p.opt.fail = 0.05;
	p.opt.fail_percent = 1;
	assert_int_equal(pair_diff(f, &p), DIFF_WARN);
	p.opt.warn = 0.05;
	p.opt.warn_percent = 1;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	p.opt.fail_percent = p.opt.warn_percent = 0.1; /* exactly as many */
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	p.opt.fail_percent = 0.0999;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	p.opt.fail_percent = 1;
	p.opt.hard_fail = 0.09;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	p.opt.fail = 0.5; /* idiff then no longer looks */
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	p.opt.hard_fail = 0.11;
	p.opt.hard_warn = 0.09;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME); /* idiff does not look at it either */
	p.opt.warn_always = true;
	assert_int_equal(pair_diff(f, &p), DIFF_WARN);
	diff_options_init(&p.opt);
	p.opt.allow_failures = 10;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	p.opt.allow_failures = 9;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	pair_release(&p);
}

static void test_figure_thresholds(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 3);
	for (uint32_t i = 0; i < 10000; i++)
		p.b.pixel[i * 3 + 1] = 0.498f;
	p.opt.fail = p.opt.warn = 0.01;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	p.opt.max_mean = 0.001; /* only the one channel is beyond it */
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	assert_int_equal(p.r.reasons, 1);
	assert_non_null(strstr(p.r.reason[0], "mean error of G, -0.002"));
	p.opt.max_mean = 0.01;
	p.opt.max_rms = 0.001;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	p.opt.max_rms = 0.01;
	p.opt.max_p99 = 0.0019;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	p.opt.max_p99 = 0.002;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	pair_release(&p);
}

/* A step of 1/255 is within 1/255, whatever single precision makes of the two. */
static void test_slack(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 1);
	p.opt.fail = p.opt.warn = 1.0 / 255;
	for (uint32_t i = 0; i < 255; i++) {
		p.a.pixel[i] = (float)i / 255;
		p.b.pixel[i] = (float)(i + 1) / 255;
	}
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	p.b.pixel[0] = 2.0f / 255;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	pair_release(&p);
}

static void test_nonfinite(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 3);
	p.b.pixel[300] = NAN;
	p.b.pixel[302] = INFINITY;
	p.opt.fail = p.opt.warn = 1e9;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	assert_true(p.r.nonfinite[0] == 0 && p.r.nonfinite[1] == 1 && p.r.nonfinite_any == 1);
	assert_true(isfinite(p.r.rms) && isfinite(p.r.mean));
	/* Both the same: still a failure, unless that is allowed. */
	p.a.pixel[300] = -NAN;
	p.a.pixel[302] = INFINITY;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	p.opt.allow_nonfinite = true;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	p.a.pixel[302] = -INFINITY;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	/* Along the sRGB curve an infinity would be 1. */
	p.opt.allow_nonfinite = false;
	p.opt.space = DIFF_SRGB;
	p.a.pixel[302] = 1;
	p.a.pixel[300] = p.b.pixel[300] = 0;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	pair_release(&p);
	/* Nothing but NaN. */
	pair_make(f, &p, 1);
	for (uint32_t i = 0; i < 10000; i++)
		p.a.pixel[i] = NAN;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	pair_release(&p);
}

static void test_unlike(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 3);
	image_release(&p.b);
	fixture_image(f, &p.b, 101, 100, 3);
	assert_int_equal(pair_diff(f, &p), DIFF_UNLIKE);
	assert_string_equal(p.r.reason[0], "the sizes differ: 100 x 100 and 101 x 100");
	image_release(&p.b);
	fixture_image(f, &p.b, 100, 100, 4);
	assert_int_equal(pair_diff(f, &p), DIFF_UNLIKE);
	assert_string_equal(p.r.reason[0], "only the second picture has a channel A");
	for (uint32_t i = 0; i < 10000; i++)
		memcpy(p.b.pixel + 4 * i, (float[]){ 0.5f, 0.5f, 0.5f, 1 }, 4 * sizeof(float));
	p.opt.rgb_only = true;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	strcpy(p.b.name[1], "X");
	assert_int_equal(pair_diff(f, &p), DIFF_UNLIKE);
	pair_release(&p);
}

/* Channels are matched by name, whatever their order. */
static void test_order(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 3);
	strcpy(p.b.name[0], "B");
	strcpy(p.b.name[2], "R");
	for (uint32_t i = 0; i < 10000; i++)
		p.a.pixel[3 * i] = p.b.pixel[3 * i + 2] = 0.25f;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	pair_release(&p);
}

static void test_space(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 3);
	for (uint32_t i = 0; i < 30000; i++) {
		p.a.pixel[i] = (float)srgb_encode(i / 30000.0);
		p.b.pixel[i] = (float)(i / 30000.0);
	}
	p.a.encoding = IMAGE_SRGB;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	assert_int_equal(p.r.encoding, IMAGE_SRGB);
	p.opt.space = DIFF_LINEAR;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	/* Beyond 1 the light is clamped, unless light is compared. */
	p.a.pixel[0] = 1;
	p.b.pixel[0] = 7;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	p.opt.space = DIFF_STORED;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	p.a.encoding = IMAGE_LINEAR;
	pair_diff(f, &p);
	assert_int_equal(p.r.encoding, IMAGE_LINEAR);
	pair_release(&p);
}

/* Straight and premultiplied alpha mean the same picture. */
static void test_alpha(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 4);
	p.b.premultiplied = true;
	for (uint32_t i = 0; i < 10000; i++) {
		float alpha = (float)i / 10000;

		p.a.pixel[4 * i + 3] = p.b.pixel[4 * i + 3] = alpha;
		for (uint32_t k = 0; k < 3; k++)
			p.b.pixel[4 * i + k] = 0.5f * alpha;
	}
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	p.b.pixel[3] = 0.5f;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	assert_string_equal(p.r.name[p.r.max_channel], "A");
	pair_release(&p);
}

static void test_crop(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 1);
	p.b.pixel[30 * 100 + 20] = 1;
	p.opt.crop_x = 20;
	p.opt.crop_y = 30;
	p.opt.crop_width = 80;
	p.opt.crop_height = 70;
	assert_int_equal(pair_diff(f, &p), DIFF_FAIL);
	assert_true(p.r.max_x == 20 && p.r.max_y == 30 && p.r.pixels == 5600);
	p.opt.crop_x = 21;
	p.opt.crop_width = 79;
	assert_int_equal(pair_diff(f, &p), DIFF_SAME);
	p.opt.crop_width = 80;
	assert_int_equal(image_diff(&p.a, &p.b, &p.opt, &p.r, NULL, &f->book, &f->diag),
			 STATUS_USAGE);
	p.opt.crop_x = p.opt.crop_width = UINT32_MAX;
	assert_int_equal(image_diff(&p.a, &p.b, &p.opt, &p.r, NULL, &f->book, &f->diag),
			 STATUS_USAGE);
	pair_release(&p);
}

static void test_picture(void **state)
{
	struct fixture *f = *state;
	struct pair p;

	pair_make(f, &p, 4);
	p.a.premultiplied = p.b.premultiplied = true;
	p.b.pixel[4] = 0.5625f;
	p.b.pixel[9] = 0.4375f;
	p.b.pixel[15] = 0.625f;
	p.b.pixel[16] = NAN;
	p.opt.scale = 4;
	assert_int_equal(image_diff(&p.a, &p.b, &p.opt, &p.r, &p.picture, &f->book, &f->diag),
			 STATUS_OK);
	assert_int_equal(p.picture.channels, 3);
	assert_memory_equal(
		p.picture.pixel,
		((float[]){ 0, 0, 0, 0.25f, 0, 0, 0, 0.25f, 0, 0.5f, 0.5f, 0.5f, 1, 0, 1 }),
		15 * sizeof(float));
	pair_release(&p);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
#define T(name) cmocka_unit_test_setup_teardown(name, fixture_setup, fixture_teardown)
		T(test_same),	 T(test_figures), T(test_thresholds), T(test_figure_thresholds),
		T(test_slack),	 T(test_nonfinite), T(test_unlike),   T(test_order),
		T(test_space),	 T(test_alpha),	  T(test_crop),	      T(test_picture),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
