/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Batches of rays through an octree: those that come near it at all, one after another. To be included by one file
 * for each instruction set, which defines ISA_LEVEL and ISA_NAME.
 */
#ifndef OCTREE_TRACE_H
#define OCTREE_TRACE_H

#include "doubles.h"
#include "octree.h"
#include "octree_herd.h"
#include "seen.h"

V void count_leaf(const ald_accel *a, struct seen *s, uint64_t *count, const struct leaf *leaf)
{
	count[ALD_COUNT_PRIMS] += leaf->tris + leaf->others;
	if (a->root_is_leaf)
		return;
	for (uint32_t i = 0; i < leaf->tris; i++)
		count[ALD_COUNT_REPEATS] += seen_again(s, a->prims->count,
						       a->id[leaf->block + i / ALD_LANES][i % ALD_LANES]);
	for (uint32_t i = 0; i < leaf->others; i++)
		count[ALD_COUNT_REPEATS] += seen_again(s, a->prims->count, a->other[leaf->other + i]);
}

#define CHUNK 1024u /* rays that are looked at together */
#define HERD_LEAST 8u /* rays that are worth a herd */

struct near { /* of a chunk: rays that come near everything's box, and the way they go */
	uint16_t index[CHUNK + DW];
	uint8_t way[CHUNK + DW];
};

#define FAST 0
#include "octree_walk.h"
#undef FAST
#define FAST 1
#include "octree_walk.h"

/* Counting is a second copy of the walk, so that it costs nothing when it is off; so are floats. */
ALD_INLINE int trace_one(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, int any, uint64_t *count)
{
	return a->fast ? trace_fast(a, q, ray, hit, any, count) : trace_right(a, q, ray, hit, any, count);
}

/* The lanes, of DW from ray on, whose line surely passes the scene's box by. m is a line's moment about the box's
 * centre; seen along an axis across it and one of the box's, the box is as large as reach. far is more than all that
 * rounding and pads (R4) may shift. A NaN does not pass. */
V uint32_t passing(const ald_accel *a, const dv ray[8])
{
	dv o[3], d[3], h[3], m, w, far = dv_all(a->frame.radius);
	dm by[3];

	for (unsigned k = 0; k < 3; k++) {
		o[k] = dv_sub(ray[k], dv_all(a->middle[k]));
		d[k] = dv_size(ray[3 + k]);
		far = dv_add(far, dv_size(o[k]));
	}
	far = dv_mul(far, dv_all(0x1p-44));
	for (unsigned k = 0; k < 3; k++)
		h[k] = dv_add(dv_all(a->reach[k]), far);
	for (unsigned k = 0; k < 3; k++) {
		const unsigned i = k == 2 ? 0 : k + 1, j = i == 2 ? 0 : i + 1;

		m = dv_sub(dv_mul(o[i], ray[3 + j]), dv_mul(o[j], ray[3 + i]));
		w = dv_add(dv_mul(h[i], d[j]), dv_mul(h[j], d[i]));
		by[k] = dv_gt(dv_size(m), w);
	}
	return dm_bits(dm_or(dm_or(by[0], by[1]), by[2]));
}

/* The rays that do not: most of a batch may never come near; and the ways they go. Returns how many. */
V uint32_t near_box(const ald_accel *a, const ald_ray *ray, uint32_t n, struct near *near)
{
	uint32_t found = 0;

	for (uint32_t i = 0; i < n; i += DW) {
		const double *at[DW];
		uint32_t past, some = n - i < DW ? n - i : DW;
		uint8_t way[DW];
		dv x[8];

		for (uint32_t k = 0; k < DW; k++)
			at[k] = &ray[i + (k < some ? k : 0)].org.x;
		dv_columns(at, x);
		past = a->ball > 0 ? 0 : passing(a, x);
		if (past == ALL_LANES)
			continue;
		ways_of(x + 3, way);
		for (uint32_t k = 0; k < some; k++) {
			near->index[found] = (uint16_t)(i + k);
			near->way[found] = way[k];
			found += !(past >> k & 1);
		}
	}
	return found;
}

/* A ray by itself. Apart, as there are many copies of the walk in it. */
static __attribute__((noinline)) void trace_nearest(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	if (q->count)
		trace_one(a, q, ray, hit, 0, q->count);
	else
		trace_one(a, q, ray, hit, 0, NULL);
}

static __attribute__((noinline)) int trace_any(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	ald_hit hit = { .t = ray->tmax, .prim = ALD_NONE };

	return q->count ? trace_one(a, q, ray, &hit, 1, q->count) : trace_one(a, q, ray, &hit, 1, NULL);
}

V void trace_alone(const ald_accel *a, ald_query *q, const struct batch *b, uint32_t i)
{
	if (b->hit)
		trace_nearest(a, q, &b->ray[i], &b->hit[i]);
	else
		b->hidden[i] = (uint8_t)trace_any(a, q, &b->ray[i]);
}

/* Herds of the rays order[from ..] that go one way; what they don't take goes alone. 0: they don't pay. */
V int trace_herds(const ald_accel *a, ald_query *q, const struct batch *b, struct herd *h, const uint16_t *order,
		  uint32_t n, uint32_t way, int any)
{
	int pays = 1;

	while (n) {
		uint32_t some = n < HERD ? n : HERD;
		uint64_t left;

		for (uint32_t i = 0; i < some; i++)
			h->index[i] = order[i];
		herd_fill(a, h, b, some, way);
		left = h->odd;
		if (h->live && !herd_walk(a, q, h, b, any)) {
			left |= h->live;
			pays = 0;
		}
		for (; left; left &= left - 1)
			trace_alone(a, q, b, h->index[__builtin_ctzll(left)]);
		n -= some;
		order += some;
	}
	return pays;
}

/* Rays by the way they go: order[], and behind each way where it ends there. */
V void sort_ways(const struct near *near, uint32_t n, uint16_t *order, uint32_t end[WAYS])
{
	uint32_t sum = 0;

	memset(end, 0, WAYS * sizeof(*end));
	for (uint32_t i = 0; i < n; i++)
		end[near->way[i]]++;
	for (unsigned k = 0; k < WAYS; k++) {
		uint32_t first = sum;

		sum += end[k];
		end[k] = first;
	}
	for (uint32_t i = 0; i < n; i++)
		order[end[near->way[i]]++] = near->index[i];
}

V void trace_chunk(const ald_accel *a, ald_query *q, const struct batch *b, uint32_t n, int any)
{
	struct near near;
	uint32_t m = near_box(a, b->ray, n, &near), end[WAYS], at = 0;
	uint16_t order[CHUNK];
	int herds = !(a->fast || a->ball > 0 || a->calls || q->count) && ISA_LEVEL >= 2;
	struct herd h;

	if (q->count)
		q->count[ALD_COUNT_VOLUME_TESTS] += n - m;
	if (!herds || m < HERD_LEAST) {
		for (uint32_t i = 0; i < m; i++)
			trace_alone(a, q, b, near.index[i]);
		return;
	}
	sort_ways(&near, m, order, end);
	for (unsigned k = 0; k < WAYS; k++) {
		if (end[k] - at >= HERD_LEAST && herds) {
			herds = trace_herds(a, q, b, &h, order + at, end[k] - at, k, any);
			at = end[k];
		}
		for (; at < end[k]; at++)
			trace_alone(a, q, b, order[at]);
	}
}

static void nearest(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n)
{
	for (uint32_t at = 0; at < n; at += CHUNK) {
		struct batch b = { .ray = ray + at, .hit = hit + at };

		trace_chunk(a, q, &b, n - at < CHUNK ? n - at : CHUNK, 0);
	}
}

static void occluded(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden, uint32_t n)
{
	memset(hidden, 0, n);
	for (uint32_t at = 0; at < n; at += CHUNK) {
		struct batch b = { .ray = ray + at, .hidden = hidden + at };

		trace_chunk(a, q, &b, n - at < CHUNK ? n - at : CHUNK, 1);
	}
}

const struct octree_isa ISA_NAME = { nearest, occluded };

#endif
