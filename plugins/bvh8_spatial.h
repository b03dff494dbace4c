/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Spatial splits (Stich, Friedrich, Dietrich: Spatial Splits in Bounding Volume Hierarchies, 2009): a range is
 * cut by a plane, and a triangle that lies across it becomes two references, each with the box of its part.
 *
 * Parts are computed in floats. What that errs, less than 2^-22 of the scene where the plane is met, is added to
 * their boxes; an edge that is nearly in the plane is met elsewhere, but then the parts are those that
 * a plane makes which is as near.
 */
#ifndef BVH8_SPATIAL_H
#define BVH8_SPATIAL_H

#include "bvh8_bins.h"

#define PLANES 16u /* bins of a range, and planes between them */
#define LONG 0.6f /* sides that are worth cutting, to the longest */
#define SHARED 0x1p-13f /* of a range's area, what both sides of an object split must have for planes to be tried */
#define PART_ERROR 0x1p-22f

struct planes {
	hull box[3][PLANES];
	uint32_t in[3][PLANES], out[3][PLANES]; /* references that begin and end there */
	float step[4], from[4];
	int used[4];
	q4 start, scale;
};

V hull point_hull(q4 p)
{
	return hull_make(p, q4_negate(p));
}

/* The parts of a triangle before and behind a plane. Empty ones are hull_none(). */
V void part_hulls(const float *v, unsigned k, float plane, hull side[2])
{
	q4 error = q4_all(PART_ERROR);

	side[0] = side[1] = hull_none();
	for (unsigned i = 0; i < 3; i++) {
		const float *a = v + 4 * i, *b = v + (i < 2 ? 4 * i + 4 : 0);
		q4 p = q4_load(a);

		if (a[k] <= plane)
			side[0] = hull_join(side[0], point_hull(p));
		if (a[k] >= plane)
			side[1] = hull_join(side[1], point_hull(p));
		if ((a[k] < plane && b[k] > plane) || (a[k] > plane && b[k] < plane)) {
			float t = (plane - a[k]) / (b[k] - a[k]);
			hull c = point_hull(q4_add(p, q4_mul(q4_sub(q4_load(b), p), q4_all(t))));

			side[0] = hull_join(side[0], c);
			side[1] = hull_join(side[1], c);
		}
	}
	for (unsigned s = 0; s < 2; s++)
		side[s] = hull_make(q4_sub(hull_lo(side[s]), error), q4_sub(hull_minus_hi(side[s]), error));
}

/* A box with nothing in it. */
V int is_empty(hull h)
{
	float d[4] __attribute__((aligned(16)));

	q4_store(d, q4_add(hull_lo(h), hull_minus_hi(h)));
	return d[0] > 0 || d[1] > 0 || d[2] > 0;
}

V void cut_hull(const struct builder *b, uint32_t id, unsigned k, float plane, hull whole, hull side[2])
{
	part_hulls(b->corner + 12 * (size_t)id, k, plane, side);
	side[0] = hull_common(side[0], whole);
	side[1] = hull_common(side[1], whole);
}

V void planes_begin(struct planes *p, const struct range *r)
{
	float size[4] __attribute__((aligned(16))), most;

	q4_store(size, q4_sub(q4_negate(hull_minus_hi(r->box)), hull_lo(r->box)));
	most = size[0] > size[1] ? size[0] : size[1];
	most = most > size[2] ? most : size[2];
	p->start = q4_three(hull_lo(r->box));
	memcpy(p->from, &p->start, sizeof(p->from));
	for (unsigned k = 0; k < 4; k++) {
		p->used[k] = k < 3 && size[k] > 64 * PART_ERROR && size[k] > LONG * most;
		p->step[k] = size[k] / PLANES;
		size[k] = k < 3 && size[k] > 64 * PART_ERROR && size[k] > LONG * most ? PLANES * 0.99999f / size[k] : 0;
		for (unsigned i = 0; i < PLANES && k < 3; i++) {
			p->box[k][i] = hull_none();
			p->in[k][i] = p->out[k][i] = 0;
		}
	}
	p->scale = q4_load(size);
}

V int32_t within(int32_t i)
{
	return i < 0 ? 0 : i < (int32_t)PLANES ? i : (int32_t)PLANES - 1;
}

/* The first and last bin of a reference along each axis. */
V void bins_of(const struct planes *p, const struct ref *r, hull h, int32_t lo[4], int32_t hi[4])
{
	if (r->zero != 0) {
		q4_whole(q4_mul(q4_sub(q4_mul(hull_mid(h), q4_all(0.5f)), p->start), p->scale), lo);
		memcpy(hi, lo, 4 * sizeof(*hi));
	} else {
		q4_whole(q4_mul(q4_sub(q4_three(hull_lo(h)), p->start), p->scale), lo);
		q4_whole(q4_mul(q4_sub(q4_negate(q4_three(hull_minus_hi(h))), p->start), p->scale), hi);
	}
}

V void planes_add(const struct builder *b, struct planes *p, const struct ref *r)
{
	hull h = ref_hull(r);
	int32_t lo[4], hi[4];

	bins_of(p, r, h, lo, hi);
	for (unsigned k = 0; k < 3; k++) {
		int32_t i = within(lo[k]), end = within(hi[k]);
		hull rest = h, side[2];

		if (!p->used[k])
			continue;
		p->in[k][i]++;
		p->out[k][end]++;
		for (; i < end; i++) {
			cut_hull(b, r->id, k, p->from[k] + (float)(i + 1) * p->step[k], rest, side);
			if (!is_empty(side[0]))
				p->box[k][i] = hull_join(p->box[k][i], side[0]);
			rest = side[1];
			if (is_empty(rest))
				break;
		}
		if (i == end)
			p->box[k][i] = hull_join(p->box[k][i], rest);
	}
}

/* No more references than most. */
V void best_plane(const struct planes *p, unsigned k, uint32_t most, struct split *best)
{
	float right[PLANES];
	uint32_t behind[PLANES], n = 0;
	hull h = hull_none();

	for (unsigned i = PLANES - 1; i > 0; i--) {
		h = hull_join(h, p->box[k][i]);
		n += p->out[k][i];
		behind[i] = n;
		right[i] = n ? hull_area(h) * blocks(n) : FAR;
	}
	h = hull_none();
	n = 0;
	for (unsigned i = 1; i < PLANES; i++) {
		float cost;

		h = hull_join(h, p->box[k][i - 1]);
		n += p->in[k][i - 1];
		cost = n ? hull_area(h) * blocks(n) + right[i] : FAR;
		if (cost < best->cost && n + behind[i] <= most)
			*best = (struct split){ cost, k, i };
	}
}

/* Do the sides of an object split have much in common? */
V int sides_overlap(const struct range *r, const struct bins *bins, const struct split *s)
{
	hull side[2] = { hull_none(), hull_none() }, both;

	for (unsigned i = 0; i < bins->used; i++)
		side[i >= s->bin] = hull_join(side[i >= s->bin], bins->box[s->axis][i]);
	both = hull_common(side[0], side[1]);
	return !is_empty(both) && hull_area(both) > SHARED * hull_area(r->box);
}

static struct split best_spatial(const struct builder *b, const struct range *r, struct planes *p, uint32_t most)
{
	struct split best = { FAR, 3, 0 };
	float scale[4] __attribute__((aligned(16)));

	planes_begin(p, r);
	q4_store(scale, p->scale);
	for (uint32_t i = 0; i < r->count; i++)
		planes_add(b, p, &b->ref[r->first + i]);
	for (unsigned k = 0; k < 3; k++) {
		if (scale[k] > 0)
			best_plane(p, k, most, &best);
	}
	return best;
}

V void ref_put(struct ref *r, hull h, uint32_t id)
{
	ref_store(r, h);
	r->id = id;
	r->zero = 0;
}

/* Move what is left of the plane to the front; parts on the right of it are added at the end. Returns how many
 * are left, and how many right in *more. */
static uint32_t part_plane(const struct builder *b, const struct range *r, const struct planes *p,
			   const struct split *s, struct range *left, struct range *right, uint32_t *more)
{
	struct ref *ref = b->ref + r->first;
	uint32_t i = 0, j = r->count, end = r->count;
	float plane = p->from[s->axis] + (float)s->bin * p->step[s->axis];

	range_clear(left);
	range_clear(right);
	while (i < j) {
		hull h = ref_hull(&ref[i]), side[2];
		int32_t lo[4], hi[4], at = (int32_t)s->bin;
		int goes[2];

		bins_of(p, &ref[i], h, lo, hi);
		goes[0] = within(lo[s->axis]) < at;
		goes[1] = within(hi[s->axis]) >= at;
		side[0] = side[1] = h;
		if (goes[0] && goes[1]) {
			cut_hull(b, ref[i].id, s->axis, plane, h, side);
			goes[0] = !is_empty(side[0]);
			goes[1] = !is_empty(side[1]);
			if (!goes[0] && !goes[1]) {
				goes[0] = 1;
				side[0] = h;
			}
		}
		if (goes[1])
			range_add(right, side[1], hull_mid(side[1]));
		if (goes[0])
			range_add(left, side[0], hull_mid(side[0]));
		if (goes[0] && goes[1]) {
			ref_put(&ref[end++], side[1], ref[i].id);
			ref_put(&ref[i], side[0], ref[i].id);
			i++;
		} else if (goes[0]) {
			if (ref[i].zero == 0)
				ref_put(&ref[i], side[0], ref[i].id);
			i++;
		} else {
			struct ref swap = ref[i];

			if (swap.zero == 0)
				ref_put(&swap, side[1], swap.id);
			ref[i] = ref[--j];
			ref[j] = swap;
		}
	}
	*more = end - i;
	return i;
}

/* How much is to be cut yet. */
V float weight_of(const struct ref *ref, uint32_t n)
{
	float sum = 0;

	for (uint32_t i = 0; i < n; i++)
		sum += sqrtf(hull_area(ref_hull(&ref[i])));
	return sum;
}

/* The right side makes way for what the left may still become. */
static void share_room(const struct builder *b, const struct range *r, uint32_t n, uint32_t m, struct range *left,
		       struct range *right)
{
	uint64_t spare = r->end - r->first - n - m, mine;
	struct ref *from = b->ref + r->first + n;
	float x = weight_of(from - n, n), y = weight_of(from, m);
	uint32_t move;

	mine = x + y > 0 ? (uint64_t)((double)spare * (double)(x / (x + y))) : 0;
	move = mine < m ? (uint32_t)mine : m;

	memcpy(from + (mine < m ? m : mine), from, move * sizeof(*from));
	left->first = r->first;
	left->count = n;
	left->end = right->first = r->first + n + (uint32_t)mine;
	right->count = m;
	right->end = r->end;
}

/* Parts of one triangle that are together in what becomes a leaf are one again. */
static void join_parts_of(const struct builder *b, struct range *r)
{
	struct ref *ref = b->ref + r->first;

	for (uint32_t i = 0; i < r->count; i++) {
		for (uint32_t j = i + 1; j < r->count; j++) {
			if (ref[j].id != ref[i].id)
				continue;
			ref_put(&ref[i], hull_join(ref_hull(&ref[i]), ref_hull(&ref[j])), ref[i].id);
			ref[j--] = ref[--r->count];
		}
	}
}

#endif
