/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Making a picture's smaller copies: each pixel is the mean of the area it covers in the size above, weighted
 * by area, so that sizes need not be powers of 2, and colours by what is opaque of them. The scene's working
 * space is where means are taken; with assumed_gamma 1 that is light.
 */
#include "pattern/mip.h"

#include <math.h>

#include "pattern/image.h"

#define BAND 32 /* rows a job */
#define COVER 4 /* at most: the half of 3 covers 3 pixels, rounding may touch one more */

struct job {
	struct mip *mip;
	uint32_t to; /* the level to be made */
};

/* Where one size's pixel i of n lies in another's m: the first, and how much of it and of those after it. */
struct cover {
	uint32_t first, count;
	double weight[COVER];
};

static struct cover cover(uint32_t i, uint32_t n, uint32_t m)
{
	double from = (double)i * m / n, to = (double)(i + 1) * m / n;
	struct cover c = { .first = (uint32_t)from };

	c.count = (uint32_t)ceil(to) - c.first;
	if (c.count > COVER)
		c.count = COVER;
	if (c.first + c.count > m)
		c.count = m - c.first;
	for (uint32_t k = 0; k < c.count; k++) {
		double low = fmax(from, c.first + k), high = fmin(to, c.first + k + 1.0);

		c.weight[k] = fmax(0, high - low) / (to - from);
	}
	return c;
}

static struct rgbft above(const struct job *j, uint32_t x, uint32_t y)
{
	if (j->to)
		return image_level_texel(j->mip, j->to - 1, x, y);
	return image_texel(j->mip->of, x, y);
}

static struct rgbft mean(const struct job *j, const struct cover *across, const struct cover *down)
{
	struct rgbft sum = { 0 }, plain = { 0 };
	double opaque = 0;

	for (uint32_t k = 0; k < down->count; k++) {
		for (uint32_t i = 0; i < across->count; i++) {
			struct rgbft c = above(j, across->first + i, down->first + k);
			double w = across->weight[i] * down->weight[k], a = w * fmax(0, 1 - c.transmit);

			if (j->mip->of->premultiplied)
				a = w;
			sum.r += a * c.r;
			sum.g += a * c.g;
			sum.b += a * c.b;
			plain.r += w * c.r;
			plain.g += w * c.g;
			plain.b += w * c.b;
			plain.filter += w * c.filter;
			plain.transmit += w * c.transmit;
			opaque += a;
		}
	}
	if (opaque > 0) {
		plain.r = sum.r / opaque;
		plain.g = sum.g / opaque;
		plain.b = sum.b / opaque;
	}
	return plain;
}

static void make_band(void *arg, uint32_t band, uint32_t thread)
{
	const struct job *j = arg;
	const struct mip_level *l = &j->mip->level[j->to];
	const struct picture *p = j->mip->of->picture;
	uint32_t width = j->to ? j->mip->level[j->to - 1].width : p->width;
	uint32_t height = j->to ? j->mip->level[j->to - 1].height : p->height;

	(void)thread;
	for (uint32_t y = band * BAND; y < l->height && y < (band + 1) * BAND; y++) {
		struct cover down = cover(y, l->height, height);

		for (uint32_t x = 0; x < l->width; x++) {
			struct cover across = cover(x, l->width, width);

			image_level_store(j->mip, j->to, x, y, mean(j, &across, &down));
		}
	}
}

static uint32_t half(uint32_t n)
{
	return n > 1 ? n / 2 : 1;
}

static enum status build(struct scene *s, struct mip *m, struct pool *pool, struct diag *diag)
{
	const struct picture *p = m->of->picture;
	uint32_t width = p->width, height = p->height;
	struct job job = { .mip = m };

	m->channels = p->palette_count ? 5 : p->channels;
	while (width * (uint64_t)height > 1 && m->count < MIP_LEVELS) {
		struct mip_level *l = &m->level[m->count];
		size_t bytes;

		l->width = width = half(width);
		l->height = height = half(height);
		bytes = mem_product(mem_product(width, height), m->channels * sizeof(*l->texel));
		l->texel = mem_alloc(s->book, "textures: smaller copies", bytes);
		if (!l->texel)
			return diag_no_memory(diag, "smaller copies of pictures", bytes);
		job.to = m->count++;
		pool_run(pool, (height + BAND - 1) / BAND, make_band, &job);
	}
	return STATUS_OK;
}

enum status mip_build(struct scene *s, struct pool *pool, struct diag *diag)
{
	enum status st = STATUS_OK;

	for (struct mip *m = s->mip; m && !st; m = m->next) {
		if (!m->count)
			st = build(s, m, pool, diag);
	}
	return st;
}
