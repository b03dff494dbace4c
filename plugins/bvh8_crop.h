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
#include "bvh8_fold.h"

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

struct desk { /* 64-aligned */
	struct ref ref[CROP]; /* as they are read, */
	q4 corner[CROP][3]; /* and what triangles' blocks are made of */
	struct ref sorted[CROP];
	uint64_t key[CROP], spare[CROP]; /* in the end, below the code: which reference that is */
	struct row row;
	struct twig twig[2 * CROP];
	struct sprig sprig[CROP];
	uint8_t len[CROP]; /* of the leaf that ends with a reference */
	uint16_t begin[CROP]; /* of leaves, from the last one */
};

/* ---- the first curve ---- */

V uint64_t triangle_key(const struct coder *s, const struct to_x *x, const d4 v[3], uint32_t id)
{
	int32_t at[4] __attribute__((aligned(16)));
	d4 lo = d4_sub(d4_min(d4_min(v[0], v[1]), v[2]), x->centre);
	d4 hi = d4_sub(d4_max(d4_max(v[0], v[1]), v[2]), x->centre);

	d4_whole(d4_sub(d4_mul(d4_add(lo, hi), d4_all(s->scale)), d4_three(s->from)), at);
	return (uint64_t)morton(at) << 32 | id;
}

/* Pieces that different threads work at lie apart, as what they write is fresh memory. */
static void key_job(void *arg, uint32_t job)
{
	struct coder *s = arg;
	const struct builder *b = s->f->b;
	const ald_prims *p = b->prims;
	uint32_t threads = b->host->threads, each = (s->pieces + threads - 1) / threads;
	uint32_t piece = job % threads * each + job / threads, first = piece * PIECE, at = first, end;
	struct to_x x = to_x(b->a);
	d4 v[3];

	if (piece >= s->pieces)
		return;
	end = p->count - first < PIECE ? p->count : first + PIECE;
	for (uint32_t id = first; id < end; id++) {
		if (id >= p->tri_count) {
			b->key[at++] = grid_key(&s->grid, hull_mid(prim_hull(b->a, &x, p, id)), id);
			continue;
		}
		read_corners(p, id, v);
		if (can_be_hit(v))
			b->key[at++] = triangle_key(s, &x, v, id);
	}
	s->valid[piece] = at - first;
	if (p->count > CROP)
		count_digits(&b->key[first], at - first, 32, (1u << LOW_BITS) - 1, s->f->count[piece]);
}

/* ---- along a curve ---- */

/* What primitives will be read from, two steps ahead. */
V void fetch(const ald_prims *p, const uint64_t *key, uint32_t i, uint32_t n)
{
	size_t each = p->vertex_double ? 24 : 12;
	uint32_t id;

	if (i + 40 < n) {
		id = (uint32_t)key[i + 40];
		if (id < p->tri_count)
			__builtin_prefetch(p->index + 3 * (size_t)id);
	}
	if (i + 16 < n) {
		id = (uint32_t)key[i + 16];
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

/* Boxes, and in X the corners of triangles. */
static void crop_read(const struct builder *b, const uint64_t *key, uint32_t n, struct desk *d, struct range *r)
{
	struct to_x x = to_x(b->a);

	range_clear(r);
	for (uint32_t i = 0; i < n; i++) {
		uint32_t id = (uint32_t)key[i];
		d4 c[3];
		hull h;

		fetch(b->prims, key, i, n);
		if (id < b->prims->tri_count) {
			read_corners(b->prims, id, c);
			corners_x(&x, c, d->corner[i]);
			h = corners_hull(d->corner[i]);
		} else {
			h = prim_hull(b->a, &x, b->prims, id);
		}
		range_add(r, h, hull_mid(h));
		ref_store(&d->ref[i], h);
		d->ref[i].id = id;
	}
}

/* In the order of a finer curve than that of the keys. */
static void crop_order(struct desk *d, uint32_t n, const struct range *r)
{
	float size[4] __attribute__((aligned(16))), most;
	struct grid g;

	q4_store(size, q4_sub(r->hi, r->lo));
	most = size[0] > size[1] ? size[0] : size[1];
	most = most > size[2] ? most : size[2];
	g = grid_of(r->lo, most, FINE);
	for (uint32_t i = 0; i < n; i++)
		d->key[i] = grid_key(&g, hull_mid(ref_hull(&d->ref[i])), i);
	sort_keys(d->key, d->spare, n);
	for (uint32_t i = 0; i < n; i++)
		ref_store(&d->sorted[i], ref_hull(&d->ref[(uint32_t)d->key[i]]));
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
	float none[4] __attribute__((aligned(16))); /* FAR: no such leaf */
	float first[4] __attribute__((aligned(16))) = { 0, FAR, FAR, FAR };
	q4 not, best = q4_load(first); /* of what ends one, two, three and four before */
	hull h[4] = { hull_none(), hull_none(), hull_none(), hull_none() };

	for (unsigned k = 0; k < 4; k++)
		none[k] = k < most ? 0 : FAR;
	not = q4_load(none);
	for (uint32_t i = 0; i < n; i++) {
		hull one = ref_hull(&ref[i]);
		q4 a, c, least;

		h[3] = hull_join(h[2], one);
		h[2] = hull_join(h[1], one);
		h[1] = hull_join(h[0], one);
		h[0] = one;
		a = areas_of(h[0], h[1], h[2], h[3]);
		if (mixed) {
			run = ref[i].id >= tris ? 0 : run + 1;
			for (unsigned k = 1; k < 4; k++)
				none[k] = k < most && k < run ? 0 : FAR;
			not = q4_load(none);
		}
		c = q4_add(q4_add(a, not), best);
		least = q4_least(c);
		len[i] = (uint8_t)(1 + __builtin_ctz(q4_same(c, least) | 8));
		best = q4_push(best, q4_add(least, q4_mul(q4_all(PENALTY), q4_last(a))));
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

/* Where leaves begin, from the last one on; returns how many there are, and of how many triangles are no part. */
static uint32_t crop_leaves(const struct builder *b, struct desk *d, uint32_t n, uint32_t *others)
{
	uint32_t leaves = 0;

	*others = 0;
	for (uint32_t i = n; i; leaves++) {
		i -= d->len[i - 1];
		d->begin[leaves] = (uint16_t)i;
		*others += d->sorted[i].id >= b->prims->tri_count;
	}
	return leaves;
}

static void crop_block(struct block *to, const struct desk *d, uint32_t first, uint32_t n)
{
	q4 v[3][SEATS];

	UNROLL for (unsigned i = 0; i < SEATS; i++) {
		if (i < n)
			block_seat(to, v, i, d->sorted[first + i].id, d->corner[(uint32_t)d->key[first + i]]);
		else
			block_empty(to, v, i);
	}
	block_close(to, v);
}

/* From..to of fresh memory are about to be written: whoever comes to a new page sees to it that one further on is
 * cleared. */
static void crop_reach(const struct fast *f, const void *p, size_t each, uint64_t from, uint64_t to, uint64_t room)
{
	size_t before = (uintptr_t)p % HUGE_PAGE, ahead = AHEAD_OF(f->b->host->threads) * HUGE_PAGE;
	size_t a = (before + from * each) / HUGE_PAGE, b = (before + to * each) / HUGE_PAGE;
	size_t end = (b + 1) * HUGE_PAGE + ahead - before;

	if (a != b && f->b->host->threads > 1 && end <= room * each)
		bvh8_touch(p, end - (b - a) * HUGE_PAGE, end);
}

/* Leaves, and what rays will go down to. */
static void crop_fill(struct fast *f, struct crop *c, struct desk *d)
{
	ald_accel *a = f->b->a;
	uint32_t others, leaves = crop_leaves(f->b, d, c->count, &others);
	uint64_t block = atomic_fetch_add(&f->blocks, leaves - others);
	uint64_t other = atomic_fetch_add(&f->others, 2 * (uint64_t)others);
	int room = block + leaves - others <= f->block_room && other + 2 * others <= f->other_room;

	crop_reach(f, a->block, sizeof(*a->block), block, block + leaves - others, f->block_room);
	d->row.n = c->leaves = leaves;
	for (uint32_t i = 0; i < leaves; i++) {
		uint32_t first = d->begin[leaves - 1 - i];
		uint32_t count = (i + 1 < leaves ? d->begin[leaves - 2 - i] : c->count) - first, kid;
		hull h = ref_hull(&d->sorted[first]);

		for (uint32_t j = 1; j < count; j++)
			h = hull_join(h, ref_hull(&d->sorted[first + j]));
		c->cost += (double)hull_area(h);
		if (d->sorted[first].id >= f->b->prims->tri_count) {
			kid = REF_OTHERS | (uint32_t)other;
			if (room) {
				a->other[other] = 1;
				a->other[other + 1] = d->sorted[first].id;
			}
			other += 2;
		} else {
			kid = REF_LEAF | (uint32_t)block;
			if (room)
				crop_block(&a->block[block], d, first, count);
			block++;
		}
		row_put(&d->row, i, h, kid, count);
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

/* What is left are tips; their nodes to where rays find them. */
static void crop_fold(struct fast *f, struct crop *c, struct desk *d, uint32_t kids)
{
	struct twig *tip = &f->tip[TIPS * (c - f->crop)];
	struct folded o = { .sprig = d->sprig };
	uint32_t root = kids;
	uint64_t first;

	for (uint32_t k = 0; k < d->row.n; k++) {
		put_twig(&tip[k], &d->row, k);
		if (tip[k].count) {
			tip[k].count = 1;
			continue;
		}
		put_twig(&d->twig[kids], &d->row, k);
		fold(&o, d->twig, kids++);
		tip[k].count = 1 + o.depth;
	}
	c->tips = d->row.n;
	c->cost += o.area;
	first = atomic_fetch_add(&f->nodes, o.n);
	crop_reach(f, f->b->a->node, sizeof(struct node), first, first + o.n, f->node_room);
	for (uint32_t i = 0; i < o.n && first + o.n <= f->node_room; i++)
		fold_node(&f->b->a->node[first + i], d->twig, &d->sprig[i], (uint32_t)first);
	for (uint32_t k = 0; k < d->row.n; k++) {
		if (tip[k].count > 1)
			tip[k].kid = (uint32_t)first + d->twig[root++].kid;
	}
}

static void crop_make(struct fast *f, struct crop *c, struct desk *d)
{
	struct builder *b = f->b;
	struct range r;

	c->cost = 0;
	crop_read(b, b->key + c->first, c->count, d, &r);
	crop_order(d, c->count, &r);
	crop_cut(b, d->sorted, c->count, d->len);
	crop_fill(f, c, d);
	crop_fold(f, c, d, row_reduce(&d->row, d->twig, 0));
}

static void crop_job(void *arg, uint32_t i)
{
	struct fast *f = arg;
	uint32_t k;

	while ((k = atomic_fetch_add(&f->next, 1)) < f->crops)
		crop_make(f, &f->crop[k], (struct desk *)f->desk + i);
}

#endif
