/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Long thin triangles that lie across the axes have boxes full of nothing. Are there so many that cutting them
 * pays, and how many references will there be? Each triangle is cut in thought, as if alone (after Ernst and
 * Greiner: Early Split Clipping for Bounding Volume Hierarchies, 2007; Karras and Aila: Fast Parallel Construction
 * of High-Quality Bounding Volume Hierarchies, 2013). What is made of the answer is room; the tree's builder makes
 * the cuts, where they pay there (bvh8_spatial.h).
 *
 * When to stop: a random ray that meets the scene's box, of area A, meets a box of area a with a chance of a/A.
 * One more reference, of n, makes it pass about 1/n more of a step of the way down; so a cut pays if it takes
 * more than GAIN A/n off the areas. Meshes of round triangles are left alone by this, and split=, the most that
 * there may be, ends it.
 *
 * Triangles of hardly any width stay whole: where along a line the kernel finds them may be farther off than
 * the boxes of their parts allow for.
 */
#include "bvh8.h"

#define CHUNK 1024u /* references that one job looks at */
#define SOME 2048u /* triangles that are looked at, where a guess will do */
#define LEVELS 8u /* of cuts of one triangle */
#define GAIN 4.0
#define ROOM 3.0 /* spatial splits, to what was counted */
#define THIN 0x1p-12 /* width to length */

struct polygon {
	double v[12][3];
	uint32_t n;
};

struct chopper {
	struct builder *b;
	double least; /* gain of a cut */
	float large; /* area of a box that may be worth cutting */
	uint32_t *count; /* references of each chunk */
};

static void part_box(const struct polygon *p, double lo[3], double hi[3])
{
	for (unsigned k = 0; k < 3; k++) {
		lo[k] = hi[k] = p->v[0][k];
		for (uint32_t i = 1; i < p->n; i++) {
			lo[k] = ald_min(p->v[i][k], lo[k]);
			hi[k] = ald_max(p->v[i][k], hi[k]);
		}
	}
}

static double area(const double lo[3], const double hi[3])
{
	double x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];

	return x * y + y * z + z * x;
}

/* Sutherland and Hodgman, both sides at once; what lies in the plane belongs to both. */
static void cut(const struct polygon *p, unsigned axis, double plane, struct polygon side[2])
{
	side[0].n = side[1].n = 0;
	for (uint32_t i = 0; i < p->n; i++) {
		const double *a = p->v[i], *b = p->v[i + 1 < p->n ? i + 1 : 0];

		for (unsigned s = 0; s < 2; s++) {
			if (s ? a[axis] >= plane : a[axis] <= plane)
				memcpy(side[s].v[side[s].n++], a, sizeof(p->v[0]));
		}
		if ((a[axis] < plane) != (b[axis] < plane) && a[axis] != plane && b[axis] != plane) {
			double f = (plane - a[axis]) / (b[axis] - a[axis]), c[3];

			for (unsigned k = 0; k < 3; k++)
				c[k] = k == axis ? plane : a[k] + f * (b[k] - a[k]);
			for (unsigned s = 0; s < 2; s++)
				memcpy(side[s].v[side[s].n++], c, sizeof(c));
		}
	}
}

/* The plane of a grid of powers of two next to the middle, so that neighbours are cut in one plane. */
static double plane_of(double lo, double hi)
{
	double mid = lo + (hi - lo) / 2, g;
	int power;

	frexp((hi - lo) / 2, &power);
	g = ldexp(1, power - 1);
	return nearbyint(mid / g) * g;
}

/* Returns how many references the part makes. */
static uint32_t chop(const struct chopper *c, const struct polygon *p, unsigned level)
{
	double lo[3], hi[3], l[2][3], h[2][3], whole;
	struct polygon side[2];
	unsigned axis = 0;

	part_box(p, lo, hi);
	whole = area(lo, hi);
	for (unsigned k = 1; k < 3; k++)
		axis = hi[k] - lo[k] > hi[axis] - lo[axis] ? k : axis;
	if (level == LEVELS || !(whole > 2 * c->least))
		return 1;
	cut(p, axis, plane_of(lo[axis], hi[axis]), side);
	if (side[0].n < 3 || side[1].n < 3)
		return 1;
	part_box(&side[0], l[0], h[0]);
	part_box(&side[1], l[1], h[1]);
	if (!(whole - area(l[0], h[0]) - area(l[1], h[1]) > c->least))
		return 1;
	return chop(c, &side[0], level + 1) + chop(c, &side[1], level + 1);
}

static int is_thin(const struct polygon *p)
{
	double e[3], g[3], n2 = 0, size = 0;

	for (unsigned k = 0; k < 3; k++) {
		e[k] = p->v[1][k] - p->v[0][k];
		g[k] = p->v[2][k] - p->v[0][k];
		size += e[k] * e[k] + g[k] * g[k];
	}
	for (unsigned k = 0; k < 3; k++) {
		double n = e[(k + 1) % 3] * g[(k + 2) % 3] - e[(k + 2) % 3] * g[(k + 1) % 3];

		n2 += n * n;
	}
	return !(n2 > THIN * THIN * size * size);
}

static void polygon_of(const struct builder *b, uint32_t id, struct polygon *part)
{
	const ald_prims *p = b->prims;
	ald_vec v[3];

	part->n = 3;
	ald_corners(p, id, p->origin ? ald_group_of(p, id) : 0, v);
	for (unsigned i = 0; i < 3; i++) {
		for (unsigned k = 0; k < 3; k++)
			part->v[i][k] = (ald_get(&v[i], k) - b->a->centre[k]) * b->a->scale;
	}
}

/* How many more references a triangle makes. */
static uint32_t parts_of(const struct chopper *c, uint32_t id)
{
	struct polygon whole;

	polygon_of(c->b, id, &whole);
	return is_thin(&whole) ? 0 : chop(c, &whole, 0) - 1;
}

static void chop_job(void *arg, uint32_t job)
{
	const struct chopper *c = arg;
	uint32_t end = c->b->refs - job * CHUNK < CHUNK ? c->b->refs : (job + 1) * CHUNK, n = 0;

	for (uint32_t i = job * CHUNK; i < end; i++) {
		const struct ref *r = &c->b->ref[i];
		float x = r->lo[0] + r->minus_hi[0], y = r->lo[1] + r->minus_hi[1], z = r->lo[2] + r->minus_hi[2];

		n++;
		if (x * y + y * z + z * x > c->large && r->id < c->b->prims->tri_count)
			n += parts_of(c, r->id);
	}
	c->count[job] = n;
}

static void corner_job(void *arg, uint32_t job)
{
	const struct chopper *c = arg;
	const struct builder *b = c->b;
	uint32_t end = b->refs - job * CHUNK < CHUNK ? b->refs : (job + 1) * CHUNK;

	for (uint32_t i = job * CHUNK; i < end; i++) {
		struct ref *r = &b->ref[i];
		struct polygon whole;

		r->zero = 1;
		if (r->id >= b->prims->tri_count)
			continue;
		polygon_of(b, r->id, &whole);
		for (unsigned j = 0; j < 12; j++)
			b->corner[12 * (size_t)r->id + j] = j % 4 < 3 ? (float)whole.v[j / 4][j % 4] : 0;
		if (!is_thin(&whole))
			r->zero = 0;
	}
}

/* Room for more references, and corners to make them from. */
static int make_room(struct chopper *c, uint64_t room, uint32_t jobs)
{
	struct builder *b = c->b;
	const ald_host *h = b->host;
	struct ref *ref = bvh8_take(h, room, sizeof(*ref), "bvh8: building");

	b->corner = bvh8_take(h, 12 * (uint64_t)b->prims->tri_count, sizeof(*b->corner), "bvh8: building");
	if (!ref || !b->corner) {
		h->free(h->ctx, ref);
		return ALD_NO_MEMORY;
	}
	memcpy(ref, b->ref, b->refs * sizeof(*ref));
	h->free(h->ctx, b->ref);
	b->ref = ref;
	b->room = (uint32_t)room;
	b->a->parts = 1;
	h->parallel(h->ctx, jobs, corner_job, c);
	return ALD_OK;
}

static struct chopper chopper(struct builder *b)
{
	struct chopper c = { .b = b };
	double lo[3], hi[3];

	for (unsigned k = 0; k < 3; k++) {
		lo[k] = 0;
		hi[k] = (ald_get(&b->a->box.hi, k) - ald_get(&b->a->box.lo, k)) * b->a->scale;
	}
	c.least = ald_max(GAIN * area(lo, hi) / (b->refs ? b->refs : 1), 0x1p-40);
	c.large = (float)(2 * c.least);
	return c;
}

static int is_wanted(const struct builder *b)
{
	return b->value[P_SPLIT] > 1 && b->refs && b->value[P_SPLIT] * b->refs <= 1e9;
}

/* By some of them. */
int bvh8_is_thin(struct builder *b)
{
	struct chopper c = chopper(b);
	uint32_t step = b->prims->tri_count / SOME | 1, n = 0, more = 0;

	for (uint32_t id = 0; id < b->prims->tri_count && is_wanted(b); id += step, n++)
		more += parts_of(&c, id);
	return more > n / 16;
}

/* For how many references there is to be room, if triangles cut in thought came to so many. */
static double room_for(const struct builder *b, double n)
{
	if (n < b->refs + b->refs / 16 + 1)
		return b->refs;
	return ald_min(b->refs + ROOM * (n - b->refs), b->value[P_SPLIT] * b->refs);
}

double bvh8_room(struct builder *b, const uint32_t *id, uint32_t n, double *wanted)
{
	struct chopper c = chopper(b);
	double more = 0;

	for (uint32_t i = 0; i < n && is_wanted(b); i++)
		more += id[i] < b->prims->tri_count ? parts_of(&c, id[i]) : 0;
	*wanted = n ? b->refs * (1 + more / n) : b->refs;
	return room_for(b, *wanted);
}

int bvh8_split(struct builder *b)
{
	const ald_host *h = b->host;
	struct chopper c = chopper(b);
	uint32_t jobs = (b->refs + CHUNK - 1) / CHUNK;
	uint64_t n = 0;
	double room;

	if (!is_wanted(b))
		return ALD_OK;
	c.count = bvh8_take(h, jobs, sizeof(*c.count), "bvh8: building");
	if (!c.count)
		return ALD_NO_MEMORY;
	h->parallel(h->ctx, jobs, chop_job, &c);
	for (uint32_t i = 0; i < jobs; i++)
		n += c.count[i];
	h->free(h->ctx, c.count);
	room = room_for(b, (double)n);
	return room > b->refs ? make_room(&c, (uint64_t)room, jobs) : ALD_OK;
}
