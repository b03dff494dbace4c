/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Tiles on the short way, where it is known from the start which samples make a pixel (see aa.c, whose operations
 * and whose order these are): samples go straight into the picture.
 */
#include <string.h>

#include "base/wide.h"
#include "film/tone.h"
#include "render/short_wave.h"
#include "shade/camera.h"

#define SIDE 4 /* samples are asked for in squares, so that rays which follow each other lie together */

/* Columns x rows of samples, n x n a pixel. */
struct patch {
	uint32_t x, y, width, height; /* in pixels of the picture */
	uint32_t n, columns, rows;
	bool middle; /* the middle one counts once more, as POV-Ray's method 1 begins with it */
};

void nonfinite_note(struct nonfinite *f, uint64_t count, uint32_t x, uint32_t y)
{
	if (count && (!f->count || y < f->y || (y == f->y && x < f->x))) {
		f->x = x;
		f->y = y;
	}
	f->count += count;
}

bool short_tile_can(const struct worker *w)
{
	const struct render_options *o = w->options;
	bool all = o->aa == RENDER_AA_POV1 && o->aa_threshold <= 0 && o->aa_n % 2;
	bool fits = o->aa == RENDER_AA_NONE || o->aa_n * o->aa_n <= SHORT_HELD;

	return w->shorts && fits && !o->spp && !o->error && !camera_has_lens(&w->shader->scene->camera) &&
	       (o->aa == RENDER_AA_NONE || o->aa == RENDER_AA_GRID || all);
}

static double coordinate(uint32_t pixel, uint32_t place, uint32_t n)
{
	return ((double)pixel * n + place + 0.5) / n;
}

static inline uint32_t least(uint32_t a, uint32_t b)
{
	return a < b ? a : b;
}

/* In which order a part's samples are asked for: squares of 8 x 8, as many as a herd of rays has (accelerators take
 * them as they come), in each of them squares of 4 x 4 by rows. */
static void order_square(struct short_wave *s, const struct patch *p, uint32_t left, uint32_t top, uint32_t *k)
{
	for (uint32_t q = 0; q < 4; q++) {
		uint32_t x0 = left + q % 2 * SIDE, y0 = top + q / 2 * SIDE;

		for (uint32_t y = y0; y < least(y0 + SIDE, p->rows); y++) {
			for (uint32_t x = x0; x < least(x0 + SIDE, p->columns); x++, ++*k) {
				s->column[*k] = (uint16_t)x;
				s->row[*k] = (uint16_t)y;
				s->place[y * p->columns + x] = (uint16_t)*k;
			}
		}
	}
}

static void order_samples(struct short_wave *s, const struct patch *p)
{
	uint32_t k = 0;

	if (s->columns == p->columns && s->rows == p->rows)
		return;
	for (uint32_t top = 0; top < p->rows; top += 2 * SIDE) {
		for (uint32_t left = 0; left < p->columns; left += 2 * SIDE)
			order_square(s, p, left, top, &k);
	}
	s->columns = p->columns;
	s->rows = p->rows;
}

/* Into s->seen. */
static bool trace_patch(struct worker *w, const struct patch *p)
{
	struct short_wave *s = w->shorts;
	uint32_t samples = p->columns * p->rows;

	order_samples(s, p);
	for (uint32_t x = 0; x < p->columns; x++)
		s->across[x] = coordinate(p->x, x, p->n);
	for (uint32_t y = 0; y < p->rows; y++)
		s->down[y] = coordinate(p->y, y, p->n);
	for (uint32_t done = 0; done < samples; done += SHORT_BATCH) {
		uint32_t n = least(samples - done, SHORT_BATCH);

		for (uint32_t k = 0; k < n; k++) {
			s->x[k] = s->across[s->column[done + k]];
			s->y[k] = s->down[s->row[done + k]];
		}
		if (!wave_short(w, n, s->seen + done))
			return false;
	}
	return true;
}

struct sum {
	struct rgb colour;
	double transmit;
	bool finite;
};

static inline void add(struct sum *to, const struct seen *s, double weight)
{
	double nothing = s->colour.r * 0 + s->colour.g * 0 + s->colour.b * 0 + s->transmit * 0;

	if (nothing != 0) { /* NaN */
		to->finite = false;
		return;
	}
	to->colour = rgb_add(to->colour, rgb_scale(s->colour, weight));
	to->transmit += s->transmit * weight;
}

static inline bool put(const struct sum *s, double gamma, float *out)
{
	struct rgb c = tone_linear_rgb(s->colour, gamma);
	float nothing;

	out[0] = (float)c.r;
	out[1] = (float)c.g;
	out[2] = (float)c.b;
	out[3] = (float)(1 - s->transmit);
	nothing = out[0] * 0 + out[1] * 0 + out[2] * 0 + out[3] * 0;
	if (nothing == 0)
		return s->finite;
	out[0] = out[1] = out[2] = out[3] = 0;
	return false;
}

static struct sum sum_pixel(const struct short_wave *s, const struct patch *p, uint32_t x, uint32_t y)
{
	const uint16_t *place = s->place + (size_t)y * p->n * p->columns + (size_t)x * p->n;
	double weight = 1.0 / ((double)p->n * p->n + p->middle);
	struct sum sum = { .finite = true };

	if (p->middle)
		add(&sum, &s->seen[place[p->n / 2 * p->columns + p->n / 2]], weight);
	for (uint32_t j = 0; j < p->n; j++, place += p->columns) {
		for (uint32_t i = 0; i < p->n; i++)
			add(&sum, &s->seen[place[i]], weight);
	}
	return sum;
}

struct canvas {
	float *out;
	size_t pitch;
	double gamma;
	struct nonfinite *bad;
};

static inline void put_at(const struct canvas *c, const struct patch *p, uint32_t x, uint32_t y, const struct sum *s)
{
	if (!put(s, c->gamma, c->out + y * c->pitch + 4 * (size_t)x))
		nonfinite_note(c->bad, 1, p->x + x, p->y + y);
}

/* A sample a pixel: what add() and put() make of n of them, without a branch. False: not all are finite. */
WIDE static bool round_all(const struct seen *restrict from, uint32_t n, float *restrict to)
{
	float nothing[4] = { 0, 0, 0, 0 };

	for (uint32_t k = 0; k < n; k++, to += 4) {
		double x[4] = { from[k].colour.r, from[k].colour.g, from[k].colour.b, from[k].transmit };

		for (unsigned i = 0; i < 4; i++)
			to[i] = (float)((i < 3 ? 0.0 : 1.0) + (i < 3 ? x[i] : -x[i]));
		for (unsigned i = 0; i < 4; i++)
			nothing[i] += to[i] * 0;
	}
	return nothing[0] + nothing[1] + nothing[2] + nothing[3] == 0;
}

static void draw_one_by_one(const struct canvas *c, const struct patch *p, const struct short_wave *s)
{
	for (uint32_t k = 0; k < p->columns * p->rows; k++) {
		struct sum sum = { .finite = true };

		add(&sum, &s->seen[k], 1);
		put_at(c, p, s->column[k], s->row[k], &sum);
	}
}

static void draw_single(const struct canvas *c, const struct patch *p, struct short_wave *s)
{
	if (c->gamma != 1 || !round_all(s->seen, p->columns * p->rows, s->pixel)) {
		draw_one_by_one(c, p, s);
		return;
	}
	for (uint32_t y = 0; y < p->rows; y++) {
		const uint16_t *place = s->place + (size_t)y * p->columns;
		float *out = c->out + y * c->pitch;

		for (uint32_t x = 0; x < p->columns; x++)
			memcpy(out + 4 * (size_t)x, s->pixel + 4 * (size_t)place[x], 4 * sizeof(*out));
	}
}

static bool draw_patch(struct worker *w, const struct patch *p, const struct canvas *c)
{
	if (!trace_patch(w, p))
		return false;
	if (p->n == 1) {
		draw_single(c, p, w->shorts);
		return true;
	}
	for (uint32_t y = 0; y < p->height; y++) {
		for (uint32_t x = 0; x < p->width; x++) {
			struct sum sum = sum_pixel(w->shorts, p, x, y);

			put_at(c, p, x, y, &sum);
		}
	}
	return true;
}

bool short_tile(struct worker *w, const struct aa_tile *t, float *out, size_t pitch, struct nonfinite *bad)
{
	const struct render_options *o = w->options;
	uint32_t n = o->aa == RENDER_AA_NONE ? 1 : o->aa_n, most = SHORT_HELD / (n * n), width, height;
	struct canvas c = { .pitch = pitch, .gamma = w->shader->scene->assumed_gamma, .bad = bad };
	struct patch p = { .n = n, .middle = o->aa == RENDER_AA_POV1 && n > 1 };

	most = most ? most : 1;
	width = least(t->width, most);
	height = least(t->height, most / width);
	for (uint32_t y = 0; y < t->height; y += height) {
		for (uint32_t x = 0; x < t->width; x += width) {
			p.x = t->x + x;
			p.y = t->y + y;
			p.width = least(width, t->width - x);
			p.height = least(height, t->height - y);
			p.columns = p.width * n;
			p.rows = p.height * n;
			c.out = out + y * pitch + 4 * (size_t)x;
			if (!draw_patch(w, &p, &c))
				return false;
		}
	}
	return true;
}
