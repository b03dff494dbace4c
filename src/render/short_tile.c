/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Tiles on the short way, where it is known from the start which samples make a pixel (see aa.c, whose operations
 * and whose order these are): samples go straight into the picture.
 */
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

/* Square by square, each by rows, into s->seen. */
static bool trace_patch(struct worker *w, const struct patch *p)
{
	struct short_wave *s = w->shorts;
	uint32_t k = 0, done = 0;

	for (uint32_t x = 0; x < p->columns; x++)
		s->across[x] = coordinate(p->x, x, p->n);
	for (uint32_t y = 0; y < p->rows; y++)
		s->down[y] = coordinate(p->y, y, p->n);
	for (uint32_t top = 0; top < p->rows; top += SIDE) {
		for (uint32_t left = 0; left < p->columns; left += SIDE) {
			uint32_t right = least(left + SIDE, p->columns), bottom = least(top + SIDE, p->rows);

			for (uint32_t y = top; y < bottom; y++) {
				for (uint32_t x = left; x < right; x++) {
					s->x[k] = s->across[x];
					s->y[k++] = s->down[y];
				}
			}
			if (k + SIDE * SIDE <= SHORT_BATCH)
				continue;
			if (!wave_short(w, k, s->seen + done))
				return false;
			done += k;
			k = 0;
		}
	}
	return !k || wave_short(w, k, s->seen + done);
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

/* Of the square that holds a row's samples, and where in it the row begins. */
struct row {
	const struct seen *first; /* of the row of squares */
	uint32_t y, height;
};

static inline struct row row_of(const struct short_wave *s, const struct patch *p, uint32_t y)
{
	uint32_t top = y - y % SIDE;

	return (struct row){ s->seen + (size_t)top * p->columns, y % SIDE, least(SIDE, p->rows - top) };
}

static inline const struct seen *seen_at(const struct patch *p, const struct row *r, uint32_t x)
{
	uint32_t left = x - x % SIDE;

	return r->first + left * r->height + r->y * least(SIDE, p->columns - left) + x % SIDE;
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
	double weight = 1.0 / ((double)p->n * p->n + p->middle);
	struct sum sum = { .finite = true };
	struct row r;

	if (p->middle) {
		r = row_of(s, p, y * p->n + p->n / 2);
		add(&sum, seen_at(p, &r, x * p->n + p->n / 2), weight);
	}
	for (uint32_t j = 0; j < p->n; j++) {
		r = row_of(s, p, y * p->n + j);
		for (uint32_t i = 0; i < p->n; i++)
			add(&sum, seen_at(p, &r, x * p->n + i), weight);
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

/* A sample a pixel, in the order in which they are there. */
static void draw_single(const struct canvas *c, const struct patch *p, const struct seen *s)
{
	for (uint32_t top = 0; top < p->rows; top += SIDE) {
		for (uint32_t left = 0; left < p->columns; left += SIDE) {
			uint32_t right = least(left + SIDE, p->columns), bottom = least(top + SIDE, p->rows);

			for (uint32_t y = top; y < bottom; y++) {
				for (uint32_t x = left; x < right; x++) {
					struct sum sum = { .finite = true };

					add(&sum, s++, 1);
					put_at(c, p, x, y, &sum);
				}
			}
		}
	}
}

static bool draw_patch(struct worker *w, const struct patch *p, const struct canvas *c)
{
	if (!trace_patch(w, p))
		return false;
	if (p->n == 1) {
		draw_single(c, p, w->shorts->seen);
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
