/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Where a record is good: no further than the harmonic mean of what its rays met, nor half as far as the
 * nearest of that or of what a record beside it met, nor to where its gradient would change the light by
 * half; never less than a part of a pixel, and for normals within an angle. Weights fall to 0 there
 * (Tabellion and Lamorlette, An Approximate Global Illumination System for Computer Generated Films, 2004).
 * Of these it is the nearest surface that matters: measured on seven scenes, it brings the error to a third
 * for twice as many records. Records stand in a hash table of cells, on levels of a power of two, so that
 * none reaches further than a cell.
 */
#include "shade/cache.h"

#include <stdlib.h>
#include <string.h>

#include "base/rng.h"
#include "base/wide.h"
#include "shade/frame.h"

#define NEAREST 0.5 /* a radius' share of the way to the nearest surface, without slack */
#define CHANGE 0.5 /* the share of its light by which it may change, without slack */
#define ANGLE 0.0603 /* 1 - cos 20 degrees: the same */
#define BEHIND 0.1 /* share of the radius that a place may lie behind a record's surface */
#define LEAST_BITS 6 /* of the table of cells: one record has room */
#define RECORDS 4
#define PI 3.14159265358979323846

struct cache_cell {
	uint64_t key; /* 0: free */
	uint32_t first, count; /* its first block; how many records it has */
};

/* What a question needs of a block of records first. Lanes not used are at no place. */
struct block {
	double p[3][RECORDS], n[3][RECORDS];
	double shrink[RECORDS]; /* the radius to the power of -2 */
	double behind[RECORDS];
	uint32_t record[RECORDS];
};

/* The light of a record as a linear function: of what turns away from its normal and of the way from its place. The
 * fourth lane is only there for the width. */
struct slope {
	double at[4], turn[3][4], move[3][4];
};

void cache_init(struct cache *c, double slack, struct mem_book *book)
{
	memset(c, 0, sizeof(*c));
	c->book = book;
	c->slack = slack;
	c->turn2 = 1 / fmin(1, ANGLE * slack * slack);
	c->record.size = sizeof(struct cache_record);
	c->block.size = sizeof(struct block);
	c->slope.size = sizeof(struct slope);
}

void cache_release(struct cache *c)
{
	buf_release(&c->record);
	buf_release(&c->block);
	buf_release(&c->slope);
	mem_free(c->cell);
	c->cell = NULL;
}

static int level_of(double radius)
{
	return ilogb(CACHE_REACH * radius) + 1; /* cells larger than what reaches into them */
}

LANED uint64_t cell_key(int level, int64_t x, int64_t y, int64_t z)
{
	uint64_t k = rng_mix((uint64_t)x * 0x9e3779b97f4a7c15u + (uint64_t)y * 0xd1b54a32d192ed03u +
			     (uint64_t)z * 0xabc98388fb8fac03u + (uint64_t)level * 0x8cb92ba72f3d8dd7u);

	return k ? k : 1;
}

/* per: 1 / a cell's size, a power of two. Further than 2^53 of them from the origin all are one. */
LANED int64_t cell_of(double x, double per)
{
	double at = x * per;
	int64_t i;

	at = at < 0x1p53 ? at : 0x1p53;
	at = at > -0x1p53 ? at : -0x1p53;
	i = (int64_t)at;
	return i - (at < (double)i);
}

static int by_key(const void *a, const void *b)
{
	const struct cache_record *x = a, *y = b;

	return x->key < y->key ? -1 : x->key > y->key;
}

LANED struct cache_cell *find_cell(const struct cache *c, uint64_t key)
{
	uint32_t mask = (1u << c->bits) - 1;

	for (uint32_t i = (uint32_t)key & mask;; i = (i + 1) & mask) {
		if (c->cell[i].key == key || !c->cell[i].key)
			return &c->cell[i];
	}
}

static void note_level(struct cache *c, int level)
{
	uint32_t i = c->level_count;

	for (uint32_t k = 0; k < c->level_count; k++) {
		if (c->level[k] == level)
			return;
	}
	if (i == sizeof(c->level) / sizeof(c->level[0]))
		return; /* radii over twenty orders of magnitude: the rest is not found */
	for (; i && c->level[i - 1] > level; i--)
		c->level[i] = c->level[i - 1];
	c->level[i] = level;
	c->level_count++;
}

/* A table of twice the size with the same cells. */
static bool grow_table(struct cache *c)
{
	struct cache_cell *old = c->cell;
	uint32_t n = old ? 1u << c->bits : 0;

	if (c->bits >= 30)
		return false;
	c->bits = old ? c->bits + 1 : LEAST_BITS;
	c->cell = mem_zalloc(c->book, "indirect", mem_product(1u << c->bits, sizeof(*c->cell)));
	for (uint32_t i = 0; c->cell && i < n; i++) {
		if (old[i].key)
			*find_cell(c, old[i].key) = old[i];
	}
	mem_free(old);
	return c->cell;
}

static void put(struct cache *c, const struct cache_cell *cell, uint32_t index)
{
	const struct cache_record *r = BUF_AT(&c->record, struct cache_record, index);
	struct block *b = BUF_AT(&c->block, struct block, cell->first + cell->count / RECORDS);
	uint32_t i = cell->count % RECORDS;

	b->p[0][i] = r->p.x, b->p[1][i] = r->p.y, b->p[2][i] = r->p.z;
	b->n[0][i] = r->n.x, b->n[1][i] = r->n.y, b->n[2][i] = r->n.z;
	b->shrink[i] = 1 / (r->radius * r->radius);
	b->behind[i] = -2 * BEHIND * r->radius;
	b->record[i] = index;
}

/* How far x is from cell i of an axis. */
static double beside(double x, int64_t i, double size)
{
	return fmax(0, fmax((double)i * size - x, x - (double)(i + 1) * size));
}

/* Go over the cells that a record reaches into: three a side at most. fill: it is put into them, where they
 * have room; otherwise it is only counted. */
static bool enter(struct cache *c, uint32_t index, bool fill)
{
	const struct cache_record *r = BUF_AT(&c->record, struct cache_record, index);
	int level = level_of(r->radius);
	double size = ldexp(1, level), per = 1 / size, reach = CACHE_REACH * r->radius, d[3];
	int64_t lo[] = { cell_of(r->p.x - reach, per), cell_of(r->p.y - reach, per),
			 cell_of(r->p.z - reach, per) };
	int64_t hi[] = { cell_of(r->p.x + reach, per), cell_of(r->p.y + reach, per),
			 cell_of(r->p.z + reach, per) };

	for (int64_t x = lo[0]; x <= hi[0]; x++) {
		d[0] = beside(r->p.x, x, size);
		for (int64_t y = lo[1]; y <= hi[1]; y++) {
			d[1] = beside(r->p.y, y, size);
			for (int64_t z = lo[2]; z <= hi[2]; z++) {
				struct cache_cell *cell;

				d[2] = beside(r->p.z, z, size);
				if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > 1.0001 * reach * reach)
					continue; /* past its corner */
				cell = find_cell(c, cell_key(level, x, y, z));
				if (!cell->key) {
					cell->key = cell_key(level, x, y, z);
					c->used++;
				}
				if (fill)
					put(c, cell, index);
				cell->count++;
			}
		}
	}
	/* Room for another one's cells. */
	return c->used + 27 < (1u << c->bits) / 2 || grow_table(c);
}

static void lay_out(struct cache *c)
{
	uint32_t first = 0;

	for (uint32_t i = 0; i < 1u << c->bits; i++) {
		c->cell[i].first = first;
		first += (c->cell[i].count + RECORDS - 1) / RECORDS;
		c->cell[i].count = 0;
	}
	c->blocks = first;
}

static struct slope slope_of(const struct cache_record *r)
{
	struct slope s = { .at = { r->light.r, r->light.g, r->light.b } };

	for (int i = 0; i < 3; i++) {
		s.turn[0][i] = r->turn[i].x, s.turn[1][i] = r->turn[i].y, s.turn[2][i] = r->turn[i].z;
		s.move[0][i] = r->move[i].x, s.move[1][i] = r->move[i].y, s.move[2][i] = r->move[i].z;
	}
	return s;
}

/* Counted, then laid out, then filled: cells have their records in order, without sorting. */
static bool make_index(struct cache *c)
{
	uint32_t n = c->record.count;

	mem_free(c->cell);
	c->cell = NULL;
	c->block.count = c->slope.count = c->used = c->level_count = 0;
	if (!grow_table(c) || !buf_reserve(&c->slope, c->book, "indirect", n))
		return false;
	for (uint32_t i = 0; i < n; i++) {
		const struct cache_record *r = BUF_AT(&c->record, struct cache_record, i);

		*BUF_AT(&c->slope, struct slope, i) = slope_of(r);
		note_level(c, level_of(r->radius));
		if (!enter(c, i, false))
			return false;
	}
	for (uint32_t l = 0; l < c->level_count; l++)
		c->per[l] = ldexp(1, -c->level[l]);
	lay_out(c);
	if (!buf_reserve(&c->block, c->book, "indirect", c->blocks))
		return false;
	for (uint32_t i = 0; i < c->blocks; i++) {
		struct block *b = BUF_AT(&c->block, struct block, i);

		for (uint32_t k = 0; k < RECORDS; k++)
			b->p[0][k] = (double)NAN;
	}
	for (uint32_t i = 0; i < n; i++) {
		if (!enter(c, i, true))
			return false;
	}
	return true;
}

/* A place that light is asked for. */
struct question {
	double p[3], n[3];
	double reach2, turn2; /* powers of -2 of how far it may be, in radii, and of how much turned */
};

/* How far out of the reach of each record it is, squared: 1 at its end, and more where it is no good at all. */
LANED void weigh(const struct block *b, const struct question *q, double out[RECORDS])
{
	for (int i = 0; i < RECORDS; i++) {
		double x = q->p[0] - b->p[0][i], y = q->p[1] - b->p[1][i], z = q->p[2] - b->p[2][i];
		double nx = b->n[0][i], ny = b->n[1][i], nz = b->n[2][i];
		double far = (x * x + y * y + z * z) * b->shrink[i] * q->reach2;
		double turned = (1 - (nx * q->n[0] + ny * q->n[1] + nz * q->n[2])) * q->turn2;
		double above = x * (q->n[0] + nx) + y * (q->n[1] + ny) + z * (q->n[2] + nz);

		far = turned > far ? turned : far; /* a NaN is kept */
		out[i] = above < b->behind[i] ? 2 : far;
	}
}

/* Add what a record foretells, w times. */
LANED void foretell(const struct slope *s, const struct cache_record *r, const struct question *q, double w,
		    double sum[4])
{
	double d[3] = { q->p[0] - r->p.x, q->p[1] - r->p.y, q->p[2] - r->p.z };
	double a[3] = { r->n.y * q->n[2] - r->n.z * q->n[1], r->n.z * q->n[0] - r->n.x * q->n[2],
			r->n.x * q->n[1] - r->n.y * q->n[0] };

	for (int i = 0; i < 4; i++) {
		double turn = a[0] * s->turn[0][i] + a[1] * s->turn[1][i] + a[2] * s->turn[2][i];
		double move = d[0] * s->move[0][i] + d[1] * s->move[1][i] + d[2] * s->move[2][i];
		double light = s->at[i] + turn + move;

		sum[i] += (light > 0 ? light : 0) * w;
	}
}

LANED double ask_cell(const struct cache *c, const struct cache_cell *cell, const struct question *q, double sum[4])
{
	const struct block *b = BUF_AT(&c->block, struct block, cell->first);
	double out[RECORDS], weights = 0;

	for (uint32_t first = 0; first < cell->count; first += RECORDS, b++) {
		weigh(b, q, out);
		for (uint32_t i = 0; i < RECORDS; i++) {
			double w;

			if (!(out[i] < 1))
				continue;
			w = out[i] > 0 ? 1 - sqrt(out[i]) : 1;
			foretell(BUF_AT(&c->slope, struct slope, b->record[i]),
				 BUF_AT(&c->record, struct cache_record, b->record[i]), q, w, sum);
			weights += w;
		}
	}
	return weights;
}

LANED struct question question(const struct cache *c, vec p, vec n, double reach)
{
	struct question q = { .p = { p.x, p.y, p.z }, .n = { n.x, n.y, n.z }, .reach2 = 1 / (reach * reach) };

	q.turn2 = q.reach2 * c->turn2;
	return q;
}

LANED const struct cache_cell *cell_at(const struct cache *c, vec p, uint32_t level)
{
	double per = c->per[level];

	return find_cell(c, cell_key(c->level[level], cell_of(p.x, per), cell_of(p.y, per), cell_of(p.z, per)));
}

WIDE static bool find(const struct cache *c, vec p, vec n, double reach, struct rgb *light)
{
	struct question q = question(c, p, n, reach);
	double sum[4] = { 0, 0, 0, 0 }, weights = 0;

	for (uint32_t l = 0; c->cell && l < c->level_count; l++)
		weights += ask_cell(c, cell_at(c, p, l), &q, sum);
	if (weights > 0)
		*light = rgb_make(sum[0] / weights, sum[1] / weights, sum[2] / weights);
	return weights > 0;
}

bool cache_find(const struct cache *c, vec p, vec n, double reach, struct rgb *light)
{
	return find(c, p, n, reach, light);
}

/* A gradient that is not trusted so far is made flatter. */
static void set_radius(struct cache_record *r, double radius)
{
	double keep = radius / r->least;

	for (int i = 0; i < 3 && keep < 1; i++)
		r->move[i] = vec_scale(r->move[i], keep);
	r->radius = fmax(radius, r->least);
}

/* What record k knows to be near, those of a cell know that reach as far as k. */
static void warn_cell(const struct cache *c, const struct cache_cell *cell, uint32_t k, const struct question *q,
		      double *near)
{
	const struct block *b = BUF_AT(&c->block, struct block, cell->first);
	double known = BUF_AT(&c->record, struct cache_record, k)->nearest, out[RECORDS];

	for (uint32_t first = 0; first < cell->count; first += RECORDS, b++) {
		weigh(b, q, out);
		for (uint32_t i = 0; i < RECORDS; i++) {
			double x = b->p[0][i] - q->p[0], y = b->p[1][i] - q->p[1], z = b->p[2][i] - q->p[2];

			if (out[i] < 1)
				near[b->record[i]] = fmin(near[b->record[i]], known + sqrt(x * x + y * y + z * z));
		}
	}
}

/* The nearest surface may lie between a record's rays. Another record, closer to it, has met it then, and tells the
 * first, which would answer for places there (Krivanek and others, Making Radiance and Irradiance Caching Practical:
 * Adaptive Caching and Neighbor Clamping, 2006). All ask what was known before: no order shows. */
static bool warn(struct cache *c, bool *changed)
{
	uint32_t n = c->record.count;
	double *near = mem_alloc(c->book, "indirect", mem_product(n, sizeof(*near)));

	if (!near)
		return false;
	for (uint32_t i = 0; i < n; i++)
		near[i] = BUF_AT(&c->record, struct cache_record, i)->nearest;
	for (uint32_t i = 0; i < n; i++) {
		const struct cache_record *r = BUF_AT(&c->record, struct cache_record, i);
		struct question q = question(c, r->p, r->n, CACHE_REACH);

		for (uint32_t l = 0; l < c->level_count; l++)
			warn_cell(c, cell_at(c, r->p, l), i, &q, near);
	}
	for (uint32_t i = 0; i < n; i++) {
		struct cache_record *r = BUF_AT(&c->record, struct cache_record, i);

		r->nearest = near[i];
		if (r->radius > r->least && NEAREST * c->slack * near[i] < r->radius) {
			set_radius(r, NEAREST * c->slack * near[i]);
			*changed = true;
		}
	}
	mem_free(near);
	return true;
}

bool cache_add(struct cache *c, struct cache_record *r, uint32_t n)
{
	bool changed = false;

	if (!n)
		return true;
	if (!buf_reserve(&c->record, c->book, "indirect", n))
		return false;
	qsort(r, n, sizeof(*r), by_key);
	memcpy(BUF_AT(&c->record, struct cache_record, c->record.count), r, n * sizeof(*r));
	c->record.count += n;
	return make_index(c) && warn(c, &changed) && (!changed || make_index(c));
}

struct cache_grid cache_grid(uint32_t samples)
{
	struct cache_grid g = { .rows = (uint32_t)lround(sqrt(samples / PI)) };

	if (g.rows < 2)
		g.rows = 2;
	g.columns = samples / g.rows < 4 ? 4 : samples / g.rows;
	return g;
}

vec cache_direction(const struct cache_grid *g, vec n, uint32_t i, double u, double v)
{
	double s = (i % g->rows + u) / g->rows, phi = 2 * PI * (i / g->rows + v) / g->columns;

	return frame_around(n, sqrt(s) * cos(phi), sqrt(s) * sin(phi), sqrt(fmax(0, 1 - s)));
}

static double channel(struct rgb c, int i)
{
	return i == 0 ? c.r : i == 1 ? c.g : c.b;
}

static void add_gradient(vec to[3], vec along, struct rgb c, double scale)
{
	for (int i = 0; i < 3; i++)
		to[i] = vec_mad(to[i], along, scale * channel(c, i));
}

/* Ward and Heckbert's sums over the borders of strata, for the mean: without their factor pi. */
static void add_column(struct cache_record *r, const struct cache_grid *g, uint32_t k, const struct cache_ray *ray)
{
	uint32_t before = (k ? k - 1 : g->columns - 1) * g->rows;
	double phi = 2 * PI * (k + 0.5) / g->columns, edge = 2 * PI * k / g->columns;
	vec out = frame_around(r->n, cos(phi), sin(phi), 0), side = frame_around(r->n, -sin(phi), cos(phi), 0);
	vec across = frame_around(r->n, -sin(edge), cos(edge), 0);

	for (uint32_t j = 0; j < g->rows; j++) {
		uint32_t i = k * g->rows + j;
		double low = (double)j / g->rows, high = (j + 1.0) / g->rows, mid = (j + 0.5) / g->rows;
		struct rgb step = rgb_add(ray[i].light, rgb_scale(ray[before + j].light, -1));
		double nearer = fmin(ray[i].distance, ray[before + j].distance);

		add_gradient(r->turn, side, ray[i].light,
			     sqrt(mid / (1 - mid)) / ((double)g->rows * g->columns));
		add_gradient(r->move, across, step, (sqrt(high) - sqrt(low)) / nearer / PI);
		if (!j)
			continue;
		step = rgb_add(ray[i].light, rgb_scale(ray[i - 1].light, -1));
		nearer = fmin(ray[i].distance, ray[i - 1].distance);
		add_gradient(r->move, out, step, 2 * sqrt(low) * (1 - low) / g->columns / nearer);
	}
}

static double steepness(const struct cache_record *r)
{
	vec g = vec_add(vec_add(vec_scale(r->move[0], 0.297), vec_scale(r->move[1], 0.589)),
			vec_scale(r->move[2], 0.114));

	return sqrt(vec_dot(g, g));
}

void cache_make(struct cache_record *r, const struct cache_grid *g, const struct cache_ray *ray,
		const struct cache_limits *limits)
{
	uint32_t n = g->rows * g->columns;
	double inverse = 0, nearest = HUGE_VAL, change = CHANGE * limits->slack, steep, radius;

	r->light = rgb_make(0, 0, 0);
	memset(r->turn, 0, sizeof(r->turn));
	memset(r->move, 0, sizeof(r->move));
	for (uint32_t i = 0; i < n; i++) {
		r->light = rgb_add(r->light, rgb_scale(ray[i].light, 1.0 / n));
		inverse += 1 / ray[i].distance / n;
		nearest = fmin(nearest, ray[i].distance);
	}
	for (uint32_t k = 0; k < g->columns; k++)
		add_column(r, g, k, ray);
	r->nearest = nearest;
	r->least = fmin(limits->least, limits->most);
	steep = steepness(r);
	radius = fmin(inverse > 0 ? 1 / inverse : limits->most, NEAREST * limits->slack * nearest);
	if (steep * radius > change * rgb_grey(r->light))
		radius = change * rgb_grey(r->light) / steep;
	set_radius(r, fmin(radius, limits->most));
}
