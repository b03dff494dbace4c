/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Anti-aliasing as samplers (POV-Ray's manual 3.2.8.7).
 *
 * All places lie on a fine grid, with div steps a pixel, and each is traced once a tile. The adaptive
 * methods work in rounds: what is known decides which places are asked for next, until nothing more is
 * wanted. A place's colour does not depend on the tile, so neither does the picture. (POV-Ray's method 1
 * compares with neighbours that may already be averages, which depends on its blocks; here all are
 * compared by their first sample.)
 */
#include "render/aa.h"

#include "render/paths.h"

#define UNKNOWN UINT32_MAX
#define SAMPLES_HELD 16384
#define GRID_SIDE 512 /* places along the side of an adaptive part's grid; 2^9, the deepest, fits */

/* The fine grid of a tile: map[] holds, for each place, its index in w->sample. */
struct grid {
	struct worker *w;
	const struct aa_tile *tile;
	uint32_t div; /* places a pixel side */
	int32_t margin; /* pixels around the tile */
	double shift; /* of place 0 from the pixel's left edge, in places */
	uint32_t columns, rows;
	uint32_t asked; /* samples traced so far */
};

/* Of a place in the picture, in pixels. Counted in places from the picture's corner and divided once, so that
 * the same place has the same coordinates to the bit in every tile. */
static double coordinate(uint32_t tile, int32_t place, double shift, uint32_t div)
{
	return ((double)tile * div + place + shift) / div;
}

static bool grid_init(struct grid *g, struct worker *w, const struct aa_tile *tile, uint32_t div,
		      uint32_t margin, double shift)
{
	uint64_t cells;

	*g = (struct grid){ .w = w, .tile = tile, .div = div, .margin = (int32_t)margin, .shift = shift };
	g->columns = (tile->width + 2 * margin) * div + 1;
	g->rows = (tile->height + 2 * margin) * div + 1;
	cells = (uint64_t)g->columns * g->rows;
	w->map.size = sizeof(uint32_t);
	w->map.count = 0;
	if (cells > UINT32_MAX / 2 ||
	    !buf_reserve(&w->map, w->tree.book, "render", (uint32_t)cells))
		return false;
	for (uint64_t i = 0; i < cells; i++)
		*BUF_AT(&w->map, uint32_t, i) = UNKNOWN;
	w->sample.count = 0;
	return true;
}

/* The sample at place (x, y), in places from the tile's own corner (may be negative, in the margin); NULL:
 * it is asked for, and known after grid_trace(). */
static struct sample *grid_at(struct grid *g, int32_t x, int32_t y)
{
	int32_t off = g->margin * (int32_t)g->div;
	uint32_t *cell = BUF_AT(&g->w->map, uint32_t,
				(size_t)(uint32_t)(y + off) * g->columns + (uint32_t)(x + off));
	struct worker *w = g->w;

	if (*cell == UNKNOWN) {
		uint32_t i = tree_push(&w->tree, &w->sample, 1);

		if (i == TREE_NONE)
			return NULL;
		*BUF_AT(&w->sample, struct sample, i) =
			(struct sample){ .x = coordinate(g->tile->x, x, g->shift, g->div),
					 .y = coordinate(g->tile->y, y, g->shift, g->div) };
		*cell = i;
	}
	return *cell < g->asked ? BUF_AT(&w->sample, struct sample, *cell) : NULL;
}

/* Trace what was asked for. *more: there was something. */
static bool grid_trace(struct grid *g, bool *more)
{
	uint32_t n = g->w->sample.count - g->asked;

	*more = n > 0;
	if (n && !wave_trace(g->w, g->asked, n))
		return false;
	g->asked += n;
	return !g->w->tree.no_memory;
}

static bool sample_finite(const struct sample *s)
{
	return vec_finite(vec_make(s->colour.r, s->colour.g, s->colour.b)) && isfinite(s->transmit);
}

static void pixel_add(struct aa_pixel *p, const struct sample *s, double weight)
{
	if (!sample_finite(s)) {
		p->finite = false;
		return;
	}
	p->colour = rgb_add(p->colour, rgb_scale(s->colour, weight));
	p->variance = rgb_add(p->variance, rgb_scale(s->variance, weight * weight));
	p->transmit += s->transmit * weight;
}

static double encode(double c, double gamma)
{
	return c > 0 ? pow(c, 1 / gamma) : 0;
}

/* Kept, as powers take long and a sample has four neighbours. */
static void look(struct sample *s, double gamma)
{
	if (s->looked)
		return;
	s->seen = rgb_make(encode(s->colour.r, gamma), encode(s->colour.g, gamma), encode(s->colour.b, gamma));
	s->looked = true;
}

static double difference(struct sample *a, struct sample *b, double gamma)
{
	look(a, gamma);
	look(b, gamma);
	return fabs(a->seen.r - b->seen.r) + fabs(a->seen.g - b->seen.g) + fabs(a->seen.b - b->seen.b) +
	       fabs(a->transmit - b->transmit);
}

/* Place (x, y) of columns x rows is asked for as which? In squares of 4 x 4, so that rays which follow each other
 * lie together. */
static inline uint32_t square_index(uint32_t x, uint32_t y, uint32_t columns, uint32_t rows)
{
	uint32_t left = x & ~3u, top = y & ~3u;
	uint32_t width = columns - left < 4 ? columns - left : 4, height = rows - top < 4 ? rows - top : 4;

	return top * columns + left * height + (y & 3) * width + (x & 3);
}

/* n x n centres of equal squares; n = 1 is no anti-aliasing. It is known where each stands. */
static bool plain_part(struct worker *w, const struct aa_tile *tile, uint32_t n, struct aa_pixel *pixel,
		       uint32_t pitch)
{
	uint32_t columns = tile->width * n, rows = tile->height * n;
	double weight = 1.0 / ((double)n * n);
	struct sample *s;

	w->sample.count = 0;
	if (tree_push(&w->tree, &w->sample, columns * rows) == TREE_NONE)
		return false;
	s = w->sample.data;
	for (uint32_t y = 0; y < rows; y++) {
		double at = coordinate(tile->y, (int32_t)y, 0.5, n);

		for (uint32_t x = 0; x < columns; x++) {
			struct sample *one = s + square_index(x, y, columns, rows);

			one->x = coordinate(tile->x, (int32_t)x, 0.5, n);
			one->y = at;
		}
	}
	if (!wave_trace(w, 0, columns * rows))
		return false;
	s = w->sample.data;
	for (uint32_t y = 0; y < rows; y++) {
		for (uint32_t x = 0; x < columns; x++)
			pixel_add(&pixel[y / n * pitch + x / n], s + square_index(x, y, columns, rows), weight);
	}
	return true;
}

/* Fine grids are taken a part of the tile at a time, so that the samples held stay few. */
static bool plain(struct worker *w, const struct aa_tile *tile, uint32_t n, struct aa_pixel *pixel)
{
	uint32_t most = SAMPLES_HELD / (n * n), step = most / tile->width;
	uint32_t width = tile->width;

	if (step == 0) {
		step = 1;
		width = most ? most : 1;
	}
	for (uint32_t y = 0; y < tile->height; y += step) {
		for (uint32_t x = 0; x < tile->width; x += width) {
			struct aa_tile part = { tile->x + x, tile->y + y,
						tile->width - x < width ? tile->width - x : width,
						tile->height - y < step ? tile->height - y : step };

			if (!plain_part(w, &part, n, pixel + (size_t)y * tile->width + x, tile->width))
				return false;
		}
	}
	return true;
}

/* Method 1. Places: the centre of a pixel is at div / 2; div is 2 n, so that sub-pixel centres are on the
 * grid too. */
static bool unlike(struct grid *g, int32_t x, int32_t y, int32_t dx, int32_t dy, double threshold,
		   double gamma)
{
	int32_t d = (int32_t)g->div, half = d / 2;
	struct sample *a = grid_at(g, x * d + half, y * d + half);
	struct sample *b = grid_at(g, (x + dx) * d + half, (y + dy) * d + half);

	/* grid_at() may have moved the samples. */
	a = grid_at(g, x * d + half, y * d + half);
	return a && b && difference(a, b, gamma) >= threshold;
}

static void pov1_pixel(struct grid *g, int32_t x, int32_t y, const struct render_options *o,
		       struct aa_pixel *out)
{
	int32_t d = (int32_t)g->div, n = (int32_t)o->aa_n, step = d / n;
	double weight = 1;
	bool refine = false;
	const struct sample *s;

	refine |= unlike(g, x, y, -1, 0, o->aa_threshold, o->aa_gamma);
	refine |= unlike(g, x, y, 1, 0, o->aa_threshold, o->aa_gamma);
	refine |= unlike(g, x, y, 0, -1, o->aa_threshold, o->aa_gamma);
	refine |= unlike(g, x, y, 0, 1, o->aa_threshold, o->aa_gamma);
	if (refine)
		weight = 1 / ((double)n * n + 1);
	*out = (struct aa_pixel){ .finite = true };
	s = grid_at(g, x * d + d / 2, y * d + d / 2);
	if (s)
		pixel_add(out, s, weight);
	for (int32_t i = 0; refine && i < n * n; i++) {
		s = grid_at(g, x * d + i % n * step + step / 2, y * d + i / n * step + step / 2);
		if (s)
			pixel_add(out, s, weight);
	}
}

/* Method 2: div = 2^depth places a pixel, its corners on the grid. */
static struct aa_pixel pov2_square(struct grid *g, int32_t x, int32_t y, int32_t size, uint32_t level,
				   const struct render_options *o)
{
	struct sample *c[4];
	struct aa_pixel out = { .finite = true };
	bool known = true, refine = false;

	for (int i = 0; i < 4; i++)
		known &= grid_at(g, x + (i & 1 ? size : 0), y + (i & 2 ? size : 0)) != NULL;
	if (!known)
		return out;
	for (int i = 0; i < 4; i++)
		c[i] = grid_at(g, x + (i & 1 ? size : 0), y + (i & 2 ? size : 0));
	for (int i = 0; i < 4 && level; i++) {
		for (int j = i + 1; j < 4; j++)
			refine |= difference(c[i], c[j], o->aa_gamma) >= o->aa_threshold;
	}
	if (!refine) {
		for (int i = 0; i < 4; i++)
			pixel_add(&out, c[i], 0.25);
		return out;
	}
	size /= 2;
	for (int i = 0; i < 4; i++) {
		struct aa_pixel q = pov2_square(g, x + (i & 1 ? size : 0), y + (i & 2 ? size : 0), size,
						level - 1, o);

		out.colour = rgb_add(out.colour, rgb_scale(q.colour, 0.25));
		out.variance = rgb_add(out.variance, rgb_scale(q.variance, 0.0625));
		out.transmit += 0.25 * q.transmit;
		out.finite &= q.finite;
	}
	return out;
}

/* Rounds until nothing more is asked for. */
static bool adaptive_part(struct worker *w, const struct aa_tile *tile, struct aa_pixel *pixel,
			  uint32_t pitch)
{
	const struct render_options *o = w->options;
	bool second = o->aa == RENDER_AA_POV2, more = true;
	uint32_t div = second ? 1u << o->aa_n : 2 * o->aa_n;
	struct grid g;

	if (!grid_init(&g, w, tile, div, second ? 0 : 1, 0))
		return false;
	while (more) {
		for (uint32_t i = 0; i < tile->width * tile->height; i++) {
			int32_t x = (int32_t)(i % tile->width), y = (int32_t)(i / tile->width);
			struct aa_pixel *out = &pixel[(uint32_t)y * pitch + (uint32_t)x];

			if (second)
				*out = pov2_square(&g, x * (int32_t)div, y * (int32_t)div,
						       (int32_t)div, o->aa_n - 1, o);
			else
				pov1_pixel(&g, x, y, o, out);
		}
		if (!grid_trace(&g, &more))
			return false;
	}
	return true;
}

/* Deep recursion makes a fine grid: then the tile is cut up, at the price of tracing the places that the
 * parts share again. */
static bool adaptive(struct worker *w, const struct aa_tile *tile, struct aa_pixel *pixel)
{
	uint32_t side = w->options->aa == RENDER_AA_POV2 ? GRID_SIDE >> w->options->aa_n : GRID_SIDE;

	for (uint32_t y = 0; y < tile->height; y += side) {
		for (uint32_t x = 0; x < tile->width; x += side) {
			struct aa_tile part = { tile->x + x, tile->y + y,
						tile->width - x < side ? tile->width - x : side,
						tile->height - y < side ? tile->height - y : side };

			if (!adaptive_part(w, &part, pixel + (size_t)y * tile->width + x, tile->width))
				return false;
		}
	}
	return true;
}

/* The same number of samples everywhere, in one set a pixel. */
static bool sampled(struct worker *w, const struct aa_tile *tile, uint32_t n, struct aa_pixel *pixel)
{
	uint32_t count = tile->width * tile->height;
	struct path_run *run;

	w->run.size = sizeof(struct path_run);
	w->run.count = 0;
	if (tree_push(&w->tree, &w->run, count) == TREE_NONE)
		return false;
	run = w->run.data;
	for (uint32_t i = 0; i < count; i++)
		run[i] = (struct path_run){ .x = tile->x + i % tile->width, .y = tile->y + i / tile->width,
					    .count = n };
	if (!paths_trace(w, run, count))
		return false;
	for (uint32_t i = 0; i < count; i++)
		pixel[i] = (struct aa_pixel){ .colour = rgb_scale(run[i].sum, 1.0 / n),
					      .transmit = run[i].transmit / n, .finite = run[i].finite };
	return true;
}

bool aa_render(struct worker *w, const struct aa_tile *tile, struct aa_pixel *pixel)
{
	const struct render_options *o = w->options;

	for (uint32_t i = 0; i < tile->width * tile->height; i++)
		pixel[i] = (struct aa_pixel){ .finite = true };
	if (o->spp)
		return sampled(w, tile, o->spp, pixel);
	switch (o->aa) {
	case RENDER_AA_GRID:
		return plain(w, tile, o->aa_n, pixel);
	case RENDER_AA_POV1:
	case RENDER_AA_POV2:
		return adaptive(w, tile, pixel);
	case RENDER_AA_NONE:
		break;
	}
	return plain(w, tile, 1, pixel);
}
