/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "image/diff.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/format.h"

/* Samples are stored in single precision: two that differ by exactly a threshold must not exceed it
 * by their rounding. */
#define SLACK 0x1p-23

struct comparing {
	const struct image *image[2];
	const struct diff_options *opt;
	struct diff_result *result;
	struct image *picture;
	uint32_t channel[2][IMAGE_CHANNELS];
	uint32_t x0, y0;
	double *row[2];
	float *worst; /* of each pixel */
	double sum[IMAGE_CHANNELS], square[IMAGE_CHANNELS];
	uint64_t samples[IMAGE_CHANNELS];
};

void diff_options_init(struct diff_options *o)
{
	*o = (struct diff_options){
		.fail = 1e-6, .warn = 1e-6, .hard_fail = HUGE_VAL, .hard_warn = HUGE_VAL,
		.max_rms = HUGE_VAL, .max_mean = HUGE_VAL, .max_p99 = HUGE_VAL, .scale = 20,
	};
}

static void reason(struct diff_result *r, enum diff_verdict verdict, const char *fmt, ...)
	DIAG_PRINTF(3, 4);

static void reason(struct diff_result *r, enum diff_verdict verdict, const char *fmt, ...)
{
	va_list ap;

	if (verdict > r->verdict)
		r->verdict = verdict;
	if (r->reasons == DIFF_REASONS)
		return;
	va_start(ap, fmt);
	vsnprintf(r->reason[r->reasons++], sizeof(r->reason[0]), fmt, ap);
	va_end(ap);
}

static int find(const struct image *im, const char *name)
{
	for (uint32_t i = 0; i < im->channels; i++) {
		if (!strcmp(im->name[i], name))
			return (int)i;
	}
	return -1;
}

static bool wanted(const struct diff_options *o, const char *name)
{
	return !o->rgb_only || (image_is_colour(name) && !strchr(name, '.'));
}

/* Which channel of A goes with which of B; by name, as their order in files is free. */
static void match_channels(struct comparing *c)
{
	const struct image *a = c->image[0], *b = c->image[1];
	struct diff_result *r = c->result;

	for (uint32_t i = 0; i < a->channels; i++) {
		int k = find(b, a->name[i]);

		if (!wanted(c->opt, a->name[i]))
			continue;
		if (k < 0) {
			reason(r, DIFF_UNLIKE, "only the first picture has a channel %s",
			       a->name[i]);
			continue;
		}
		c->channel[0][r->channels] = i;
		c->channel[1][r->channels] = (uint32_t)k;
		memcpy(r->name[r->channels++], a->name[i], sizeof(r->name[0]));
	}
	for (uint32_t i = 0; i < b->channels; i++) {
		if (wanted(c->opt, b->name[i]) && find(a, b->name[i]) < 0)
			reason(r, DIFF_UNLIKE, "only the second picture has a channel %s",
			       b->name[i]);
	}
	if (!r->channels && r->verdict == DIFF_SAME)
		reason(r, DIFF_UNLIKE, "the pictures have no colour channels");
}

static enum status match_sizes(struct comparing *c, struct diag *diag)
{
	const struct image *a = c->image[0], *b = c->image[1];
	const struct diff_options *o = c->opt;
	struct diff_result *r = c->result;

	if (a->width != b->width || a->height != b->height) {
		reason(r, DIFF_UNLIKE,
		       "the sizes differ: %" PRIu32 " x %" PRIu32 " and %" PRIu32 " x %" PRIu32,
		       a->width, a->height, b->width, b->height);
		return STATUS_OK;
	}
	r->width = a->width;
	r->height = a->height;
	if (!o->crop_width)
		return STATUS_OK;
	if ((uint64_t)o->crop_x + o->crop_width > a->width ||
	    (uint64_t)o->crop_y + o->crop_height > a->height || !o->crop_height)
		return diag_fail(diag, STATUS_USAGE, NULL,
				 "the part to compare, %" PRIu32 " x %" PRIu32 " at %" PRIu32
				 ",%" PRIu32 ", is not within the pictures' %" PRIu32 " x %" PRIu32,
				 o->crop_width, o->crop_height, o->crop_x, o->crop_y, a->width,
				 a->height);
	c->x0 = o->crop_x;
	c->y0 = o->crop_y;
	r->width = o->crop_width;
	r->height = o->crop_height;
	return STATUS_OK;
}

static float raw(const struct comparing *c, int side, uint32_t x, uint32_t y, uint32_t i)
{
	const struct image *im = c->image[side];

	return im->pixel[((size_t)(c->y0 + y) * im->width + c->x0 + x) * im->channels +
			 c->channel[side][i]];
}

/* Both NaN, or the same infinity. */
static bool alike(float a, float b)
{
	return (isnan(a) && isnan(b)) || (isinf(a) && isinf(b) && a == b);
}

struct pixel {
	double worst; /* greatest difference */
	bool nonfinite[2], unlike;
};

static void compare_sample(struct comparing *c, struct pixel *p, uint32_t x, uint32_t y, uint32_t i)
{
	struct diff_result *r = c->result;
	float a = raw(c, 0, x, y, i), b = raw(c, 1, x, y, i);
	size_t at = (size_t)(c->x0 + x) * r->channels + i;
	double d, abs;

	p->nonfinite[0] |= !isfinite(a);
	p->nonfinite[1] |= !isfinite(b);
	if (!isfinite(a) || !isfinite(b)) {
		p->unlike |= !alike(a, b);
		return;
	}
	d = c->row[1][at] - c->row[0][at];
	abs = fabs(d);
	c->sum[i] += d;
	c->square[i] += d * d;
	c->samples[i]++;
	if (abs > p->worst)
		p->worst = abs;
	if (abs > r->channel_max[i])
		r->channel_max[i] = abs;
	if (abs > r->max) {
		r->max = abs;
		r->max_x = c->x0 + x;
		r->max_y = c->y0 + y;
		r->max_channel = i;
		r->max_sample[0] = c->row[0][at];
		r->max_sample[1] = c->row[1][at];
	}
}

/* Colour differences in their channel; those of alpha and layers as grey. */
static void paint(struct comparing *c, const struct pixel *p, uint32_t x, uint32_t y)
{
	struct diff_result *r = c->result;
	float *out = c->picture->pixel + ((size_t)y * r->width + x) * 3;
	double rgb[3] = { 0 }, rest = 0;

	for (uint32_t i = 0; i < r->channels; i++) {
		size_t at = (size_t)(c->x0 + x) * r->channels + i;
		double d = fabs(c->row[1][at] - c->row[0][at]) * c->opt->scale;
		const char *place = r->name[i][1] ? NULL : strchr("RGB", r->name[i][0]);

		if (place && *place)
			rgb[place - "RGB"] = d;
		else if (d > rest)
			rest = d;
	}
	for (int k = 0; k < 3; k++)
		out[k] = (float)(rgb[k] > rest ? rgb[k] : rest);
	if (p->nonfinite[0] || p->nonfinite[1]) {
		out[0] = out[2] = 1;
		out[1] = 0;
	}
}

static void compare_row(struct comparing *c, uint32_t y)
{
	struct diff_result *r = c->result;
	struct image_form form = { r->encoding, true };

	for (int side = 0; side < 2; side++)
		image_row(c->image[side], c->y0 + y, c->channel[side], r->channels, form,
			  c->row[side]);
	for (uint32_t x = 0; x < r->width; x++) {
		struct pixel p = { 0 };

		for (uint32_t i = 0; i < r->channels; i++)
			compare_sample(c, &p, x, y, i);
		r->nonfinite[0] += p.nonfinite[0];
		r->nonfinite[1] += p.nonfinite[1];
		r->nonfinite_any += p.nonfinite[0] || p.nonfinite[1];
		r->nonfinite_unlike += p.unlike;
		r->over_fail += p.unlike || p.worst > c->opt->fail + SLACK;
		r->over_warn += p.unlike || p.worst > c->opt->warn + SLACK;
		c->worst[(size_t)y * r->width + x] = (float)p.worst;
		if (c->picture)
			paint(c, &p, x, y);
	}
}

/* The k-th smallest (from 0) of n floats that are not negative: those sort as their bits do, so two
 * passes of counting find it. */
static double select_float(const float *v, uint64_t n, uint64_t k, uint64_t *count)
{
	uint32_t high = 0, bits;
	float out;

	for (int pass = 0; pass < 2; pass++) {
		uint32_t i = 0;

		memset(count, 0, 65536 * sizeof(*count));
		for (uint64_t j = 0; j < n; j++) {
			memcpy(&bits, &v[j], sizeof(bits));
			if (!pass)
				count[bits >> 16]++;
			else if (bits >> 16 == high)
				count[bits & 0xffff]++;
		}
		while (k >= count[i])
			k -= count[i++];
		if (!pass)
			high = i;
		else
			high = high << 16 | i;
	}
	memcpy(&out, &high, sizeof(out));
	return (double)out;
}

static enum status summarise(struct comparing *c, struct mem_book *book, struct diag *diag)
{
	struct diff_result *r = c->result;
	uint64_t *count = mem_alloc(book, "pictures", 65536 * sizeof(*count)), n = 0;
	double sum = 0, square = 0;

	if (!count)
		return diag_no_memory(diag, "a histogram", 65536 * sizeof(*count));
	for (uint32_t i = 0; i < r->channels; i++) {
		double m = c->samples[i] ? (double)c->samples[i] : 1;

		r->channel_mean[i] = c->sum[i] / m;
		r->channel_rms[i] = sqrt(c->square[i] / m);
		sum += c->sum[i];
		square += c->square[i];
		n += c->samples[i];
	}
	r->mean = n ? sum / (double)n : 0;
	r->rms = n ? sqrt(square / (double)n) : 0;
	r->psnr = r->rms > 0 ? -20 * log10(r->rms) : HUGE_VAL;
	r->p99 = select_float(c->worst, r->pixels, (r->pixels * 99 + 99) / 100 - 1, count);
	mem_free(count);
	return STATUS_OK;
}

static double percent(const struct diff_result *r, uint64_t n)
{
	return 100.0 * (double)n / (double)r->pixels;
}

static void judge_figures(struct diff_result *r, const struct diff_options *o)
{
	if (r->rms > o->max_rms)
		reason(r, DIFF_FAIL, "the RMS error %.6g is above %.6g", r->rms, o->max_rms);
	if (fabs(r->mean) > o->max_mean)
		reason(r, DIFF_FAIL, "the mean error %+.6g is beyond %.6g", r->mean, o->max_mean);
	for (uint32_t i = 0; i < r->channels; i++) {
		if (fabs(r->channel_mean[i]) > o->max_mean)
			reason(r, DIFF_FAIL, "the mean error of %s, %+.6g, is beyond %.6g",
			       r->name[i], r->channel_mean[i], o->max_mean);
	}
	if (r->p99 > o->max_p99 + SLACK)
		reason(r, DIFF_FAIL,
		       "1 %% of the pixels differ by %.6g or more; at most %.6g is allowed", r->p99,
		       o->max_p99);
}

static void judge(struct diff_result *r, const struct diff_options *o)
{
	uint64_t bad = o->allow_nonfinite ? r->nonfinite_unlike : r->nonfinite_any;
	bool over = (double)r->over_fail > o->fail_percent / 100 * (double)r->pixels;

	if (bad)
		reason(r, DIFF_FAIL, "%" PRIu64 " pixels are not finite (NaN or Inf)%s", bad,
		       o->allow_nonfinite ? " in one picture only" : "");
	if (over && r->over_fail > o->allow_failures)
		reason(r, DIFF_FAIL,
		       "%" PRIu64 " pixels (%.4g %%) differ by more than %.6g; %.4g %% may",
		       r->over_fail, percent(r, r->over_fail), o->fail, o->fail_percent);
	if (r->max > o->hard_fail + SLACK)
		reason(r, DIFF_FAIL, "the largest difference, %.6g, is above %.6g", r->max,
		       o->hard_fail);
	judge_figures(r, o);
	if (r->verdict == DIFF_FAIL || (!r->over_fail && !o->warn_always))
		return;
	if ((double)r->over_warn > o->warn_percent / 100 * (double)r->pixels &&
	    r->over_warn > o->allow_failures)
		reason(r, DIFF_WARN,
		       "%" PRIu64 " pixels (%.4g %%) differ by more than %.6g; %.4g %% may",
		       r->over_warn, percent(r, r->over_warn), o->warn, o->warn_percent);
	if (r->max > o->hard_warn + SLACK)
		reason(r, DIFF_WARN, "the largest difference, %.6g, is above %.6g", r->max,
		       o->hard_warn);
}

static enum image_encoding space_of(const struct comparing *c)
{
	if (c->opt->space != DIFF_STORED)
		return c->opt->space == DIFF_LINEAR ? IMAGE_LINEAR : IMAGE_SRGB;
	return c->image[0]->encoding == IMAGE_LINEAR && c->image[1]->encoding == IMAGE_LINEAR
		       ? IMAGE_LINEAR
		       : IMAGE_SRGB;
}

static enum status compare(struct comparing *c, struct mem_book *book, struct diag *diag)
{
	struct diff_result *r = c->result;
	size_t row = (size_t)c->image[0]->width * r->channels * sizeof(double);

	for (int side = 0; side < 2; side++) {
		c->row[side] = mem_alloc(book, "pictures", row);
		if (!c->row[side])
			return diag_no_memory(diag, "a row of a picture", row);
	}
	c->worst = mem_alloc(book, "pictures", r->pixels * sizeof(float));
	if (!c->worst)
		return diag_no_memory(diag, "a picture of the differences",
				      r->pixels * sizeof(float));
	for (uint32_t y = 0; y < r->height; y++)
		compare_row(c, y);
	return summarise(c, book, diag);
}

enum status image_diff(const struct image *a, const struct image *b, const struct diff_options *opt,
		       struct diff_result *r, struct image *picture, struct mem_book *book,
		       struct diag *diag)
{
	struct comparing c = { .image = { a, b }, .opt = opt, .result = r, .picture = picture };
	enum status st;

	memset(r, 0, sizeof(*r));
	if (picture)
		memset(picture, 0, sizeof(*picture));
	st = match_sizes(&c, diag);
	match_channels(&c);
	if (st || r->verdict == DIFF_UNLIKE)
		return st;
	r->pixels = (uint64_t)r->width * r->height;
	r->encoding = space_of(&c);
	if (picture)
		st = image_init(picture, book, r->width, r->height, 3, diag);
	if (!st)
		st = compare(&c, book, diag);
	for (int side = 0; side < 2; side++)
		mem_free(c.row[side]);
	mem_free(c.worst);
	if (!st)
		judge(r, opt);
	return st;
}
