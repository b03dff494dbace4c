/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The fast builder's jobs, each some thousand references that lie together: sorted along a Morton curve; cut into
 * leaves, of all ways to cut the row the one whose leaves are expected to cost least; and these joined, each
 * with the nearest of the next along the curve if that is also its nearest, until few trees are left (Meister,
 * Bittner: Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy Construction, 2018).
 */
#ifndef BVH8_CROP_H
#define BVH8_CROP_H

#include "bvh8_corner.h"
#include "bvh8_fast.h"

#define ROUNDS 20u
#define REACH 8u /* neighbours to each side that are looked at */
#define FINE 128.0f /* cells to a side */
#define LOW 11u /* of their codes' bits, those that are sorted by first */
#define HIGH 10u
#define PENALTY 0.25f /* of one leaf more, to its neighbourhood's area */
#define WIDE 0x1p30f /* of boxes that nothing is near to */
#define RANK 31u /* bits of an area that are given to a neighbour's rank */

struct row { /* trees in order; boxes have REACH wide ones before and behind them */
	float box[6][CROP + 2 * REACH] __attribute__((aligned(64))); /* low sides, and high ones negated */
	uint32_t kid[CROP], count[CROP];
	uint32_t n;
};

/* ---- along the curve ---- */

/* What primitives will be read from, two steps ahead. */
V void fetch(const ald_prims *p, const uint64_t *key, uint32_t i, uint32_t n)
{
	size_t each = p->vertex_double ? 24 : 12;
	uint32_t id;

	if (i + 24 < n) {
		id = (uint32_t)key[i + 24];
		if (id < p->tri_count)
			__builtin_prefetch(p->index + 3 * (size_t)id);
	}
	if (i + 12 < n) {
		id = (uint32_t)key[i + 12];
		for (unsigned k = 0; k < 3 && id < p->tri_count; k++)
			__builtin_prefetch((const char *)p->vertex + each * p->index[3 * (size_t)id + k]);
	}
}

/* By the code: radix sort, in two steps; a stable one. */
static void sort_keys(uint64_t *key, uint64_t *spare, uint32_t n)
{
	uint32_t low[1u << LOW], high[1u << HIGH], at[2] = { 0, 0 };

	memset(low, 0, sizeof(low));
	memset(high, 0, sizeof(high));
	for (uint32_t i = 0; i < n; i++) {
		low[key[i] >> 32 & ((1u << LOW) - 1)]++;
		high[key[i] >> (32 + LOW)]++;
	}
	for (uint32_t i = 0; i < 1u << LOW; i++) {
		uint32_t m = low[i];

		low[i] = at[0];
		at[0] += m;
	}
	for (uint32_t i = 0; i < 1u << HIGH; i++) {
		uint32_t m = high[i];

		high[i] = at[1];
		at[1] += m;
	}
	for (uint32_t i = 0; i < n; i++)
		spare[low[key[i] >> 32 & ((1u << LOW) - 1)]++] = key[i];
	for (uint32_t i = 0; i < n; i++)
		key[high[spare[i] >> (32 + LOW)]++] = spare[i];
}

/* Boxes in the order of a finer curve than that of the keys, and the keys with them. */
static void crop_order(const struct fast *f, const struct crop *c, struct ref *ref)
{
	const struct builder *b = f->b;
	uint64_t *key = b->key + c->first;
	float size[4] __attribute__((aligned(16))), most;
	struct ref from[CROP] __attribute__((aligned(32)));
	uint64_t spare[CROP];
	struct to_x x = to_x(b->a);
	struct range r;
	struct grid g;

	range_clear(&r);
	for (uint32_t i = 0; i < c->count; i++) {
		hull h;

		fetch(b->prims, key, i, c->count);
		h = prim_hull(b->a, &x, b->prims, (uint32_t)key[i]);
		range_add(&r, h, hull_mid(h));
		ref_store(&from[i], h);
		from[i].id = (uint32_t)key[i];
	}
	q4_store(size, q4_sub(r.hi, r.lo));
	most = size[0] > size[1] ? size[0] : size[1];
	most = most > size[2] ? most : size[2];
	g = grid_of(r.lo, most, FINE);
	for (uint32_t i = 0; i < c->count; i++)
		key[i] = grid_key(&g, hull_mid(ref_hull(&from[i])), i);
	sort_keys(key, spare, c->count);
	for (uint32_t i = 0; i < c->count; i++) {
		ref_store(&ref[i], ref_hull(&from[(uint32_t)key[i]]));
		key[i] = ref[i].id;
	}
}

/* ---- leaves ---- */

V q4 areas_of(hull a, hull b, hull c, hull d)
{
	q4 s[4] = { q4_add(hull_lo(a), hull_minus_hi(a)), q4_add(hull_lo(b), hull_minus_hi(b)),
		    q4_add(hull_lo(c), hull_minus_hi(c)), q4_add(hull_lo(d), hull_minus_hi(d)) };

	q4_turn(s);
	return q4_add(q4_add(q4_mul(s[0], s[1]), q4_mul(s[1], s[2])), q4_mul(s[2], s[0]));
}

V float lesser(float a, float b)
{
	return a < b ? a : b;
}

/* How many references the leaf that ends at each one has, at best. */
static void crop_cut(const struct builder *b, const struct ref *ref, uint32_t n, uint8_t *len)
{
	uint32_t tris = b->prims->tri_count, most = (uint32_t)b->value[P_LEAF], run = 0;
	int mixed = tris < b->prims->count;
	float b0 = 0, b1 = FAR, b2 = FAR, b3 = FAR; /* best of what ends one, two, three and four before */
	float not[4]; /* FAR: no such leaf */
	hull h[4] = { hull_none(), hull_none(), hull_none(), hull_none() };

	for (unsigned k = 0; k < 4; k++)
		not[k] = k < most ? 0 : FAR;
	for (uint32_t i = 0; i < n; i++) {
		hull one = ref_hull(&ref[i]);
		float a[4] __attribute__((aligned(16))), c0, c1, c2, c3, least;

		h[3] = hull_join(h[2], one);
		h[2] = hull_join(h[1], one);
		h[1] = hull_join(h[0], one);
		h[0] = one;
		q4_store(a, areas_of(h[0], h[1], h[2], h[3]));
		if (mixed) {
			run = ref[i].id >= tris ? 0 : run + 1;
			for (unsigned k = 1; k < 4; k++)
				not[k] = k < most && k < run ? 0 : FAR;
		}
		c1 = a[1] + not[1] + b1;
		c2 = a[2] + not[2] + b2;
		c3 = a[3] + not[3] + b3;
		c0 = a[0] + b0;
		least = lesser(lesser(c1, c2), c3);
		least = lesser(c0, least);
		len[i] = (uint8_t)(1 + (c0 > least) + ((c0 > least) & (c1 > least)) +
				   ((c0 > least) & (c1 > least) & (c2 > least)));
		b3 = b2;
		b2 = b1;
		b1 = b0;
		b0 = least + PENALTY * a[3];
	}
}

V void row_put(struct row *r, uint32_t i, hull h, uint32_t kid, uint32_t count)
{
	float x[8] __attribute__((aligned(32)));

	hull_store(x, h);
	UNROLL for (unsigned k = 0; k < 3; k++) {
		r->box[k][REACH + i] = x[k];
		r->box[3 + k][REACH + i] = x[4 + k];
	}
	r->kid[i] = kid;
	r->count[i] = count;
}

/* From the end on, turned round, as len[] says. */
static void row_fill(struct row *r, const struct ref *ref, uint32_t first, const uint8_t *len, uint32_t n)
{
	uint32_t leaves = 0, i;

	for (i = n; i; i -= len[i - 1])
		leaves++;
	r->n = leaves;
	for (i = n; i; i -= len[i - 1]) {
		uint32_t count = len[i - 1];
		hull h = ref_hull(&ref[i - count]);

		for (uint32_t j = 1; j < count; j++)
			h = hull_join(h, ref_hull(&ref[i - count + j]));
		row_put(r, --leaves, h, first + i - count, count);
	}
}

static void row_close(struct row *r)
{
	for (unsigned k = 0; k < 6; k++) {
		for (unsigned i = 0; i < REACH; i++)
			r->box[k][i] = r->box[k][REACH + r->n + i] = -WIDE;
	}
}

/* ---- joining ---- */

/* Of even and of odd places: the rank that decides between neighbours as near. The other one of its pair comes
 * first, so that of many that are in one place, all find partners. */
static const uint32_t rank_back[2][REACH] __attribute__((aligned(32))) = {
	{ 15, 13, 11, 9, 7, 5, 3, 2 }, { 15, 13, 11, 9, 7, 5, 3, 0 }
};
static const uint32_t rank_ahead[2][REACH] __attribute__((aligned(32))) = {
	{ 0, 4, 6, 8, 10, 12, 14, 16 }, { 2, 4, 6, 8, 10, 12, 14, 16 }
};
static const int8_t rank_step[2][17] = {
	{ 1, 0, -1, -2, 2, -3, 3, -4, 4, -5, 5, -6, 6, -7, 7, -8, 8 },
	{ -1, 0, 1, -2, 2, -3, 3, -4, 4, -5, 5, -6, 6, -7, 7, -8, 8 },
};

/* Areas around one of the trees and eight others from p on, with the ranks. */
V hull joint_areas(const struct row *r, uint32_t p, const hull one[6], const uint32_t *rank)
{
	hull x = hull_add(hull_join(hull_loose(&r->box[0][p]), one[0]), hull_join(hull_loose(&r->box[3][p]), one[3]));
	hull y = hull_add(hull_join(hull_loose(&r->box[1][p]), one[1]), hull_join(hull_loose(&r->box[4][p]), one[4]));
	hull z = hull_add(hull_join(hull_loose(&r->box[2][p]), one[2]), hull_join(hull_loose(&r->box[5][p]), one[5]));
	hull area = hull_add(hull_mul(x, y), hull_mul(hull_add(x, y), z));

	return hull_mark(hull_add(area, hull_all(0x1p-100f)), RANK, rank);
}

static void row_nearest(const struct row *r, uint32_t *near)
{
	for (uint32_t i = 0; i < r->n; i++) {
		uint32_t p = REACH + i, odd = i & 1, rank;
		hull one[6];

		UNROLL for (unsigned k = 0; k < 6; k++)
			one[k] = hull_all(r->box[k][p]);
		rank = hull_least(hull_join(joint_areas(r, p - REACH, one, rank_back[odd]),
					    joint_areas(r, p + 1, one, rank_ahead[odd]))) & RANK;
		near[i] = i + (uint32_t)(int32_t)rank_step[odd][rank];
	}
}

V void put_twig(struct twig *t, const struct row *r, uint32_t i)
{
	UNROLL for (unsigned k = 0; k < 3; k++) {
		t->lo[k] = r->box[k][REACH + i];
		t->hi[k] = -r->box[3 + k][REACH + i];
	}
	t->kid = r->kid[i];
	t->count = r->count[i];
}

/* Those whose nearest has them as its nearest become one. kids: where the next two twigs go; returns where the
 * next do. */
static uint32_t row_join(struct row *r, struct twig *twig, uint32_t kids, uint32_t *near)
{
	uint32_t stay[CROP], pair[CROP / 2 + 1], n = 0, pairs = 0;

	for (uint32_t i = 0; i < r->n; i++) {
		uint32_t j = near[i], mutual = near[j] == i;

		stay[n] = i;
		n += !(mutual & (j < i));
		pair[pairs] = i;
		pairs += mutual & (i < j);
	}
	for (uint32_t k = 0; k < pairs; k++, kids += 2) {
		uint32_t i = pair[k], j = near[i];

		put_twig(&twig[kids], r, i);
		put_twig(&twig[kids + 1], r, j);
		r->kid[i] = kids;
		r->count[i] = 0;
		UNROLL for (unsigned q = 0; q < 6; q++)
			r->box[q][REACH + i] = lesser(r->box[q][REACH + i], r->box[q][REACH + j]);
	}
	for (uint32_t k = 0; k < n; k++) {
		uint32_t i = stay[k];

		UNROLL for (unsigned q = 0; q < 6; q++)
			r->box[q][REACH + k] = r->box[q][REACH + i];
		r->kid[k] = r->kid[i];
		r->count[k] = r->count[i];
	}
	r->n = n;
	return kids;
}

/* Until there are few. Where hardly any find each other, and after ROUNDS, neighbours are joined as they stand: no
 * tree is deeper than DEEP. */
static uint32_t row_reduce(struct row *r, struct twig *twig, uint32_t kids)
{
	uint32_t near[CROP], was = 2 * r->n;

	for (uint32_t round = 0; r->n > TIPS; round++) {
		row_close(r);
		if (r->n > was - was / 10 || round >= ROUNDS) {
			for (uint32_t i = 0; i < r->n; i++)
				near[i] = (i ^ 1) < r->n ? i ^ 1 : i;
		} else {
			row_nearest(r, near);
		}
		was = r->n;
		kids = row_join(r, twig, kids, near);
	}
	return kids;
}

/* ---- a job ---- */

static void crop_seat(const struct fast *f, const struct crop *c, uint32_t i, const struct row *r, uint32_t kids)
{
	struct builder *b = f->b;
	struct seat *seat = b->seat + (size_t)b->twigs_a_ref * c->first / 2;

	for (uint32_t k = 0; k < r->n; k++) {
		struct part *p = &b->part[1 + TIPS * i + k];

		put_twig(&f->tip[TIPS * i + k], r, k);
		*p = (struct part){ .seat = seat };
		if (r->count[k])
			continue;
		put_twig(&b->twig[kids], r, k);
		bvh8_seat(b, p, kids++);
		seat += p->seats;
	}
}

static void crop_job(void *arg, uint32_t i)
{
	const struct fast *f = arg;
	struct builder *b = f->b;
	struct crop *c = &f->crop[i];
	uint32_t kids = b->twigs_a_ref * c->first;
	struct ref ref[CROP] __attribute__((aligned(32)));
	uint8_t len[CROP];
	struct row row;

	crop_order(f, c, ref);
	crop_cut(b, ref, c->count, len);
	row_fill(&row, ref, c->first, len, c->count);
	if (b->twigs_a_ref == 1 && 2 * row.n > c->count + TIPS / 2) { /* more twigs than there is room for */
		for (uint32_t k = 0; k < c->count; k++)
			len[k] = (uint8_t)(k % SEATS + 1);
		row_fill(&row, ref, c->first, len, c->count);
	}
	kids = row_reduce(&row, b->twig, kids);
	crop_seat(f, c, i, &row, kids);
	c->tips = row.n;
}

#endif
