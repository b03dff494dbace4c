/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's walks: which way rays go, alone, in crews or as herds, and what is counted. To be included by one file for
 * each instruction set, which defines ISA_LEVEL and ISA_NAME.
 */
#ifndef BVH8_WALK_H
#define BVH8_WALK_H

#include "bvh8_flood.h"
#include "bvh8_herd.h"
#include "bvh8_order.h"
#include "seen.h"

/* ---- counting ---- */

V void count_prim(const ald_accel *a, struct seen *s, uint32_t id, uint64_t *count)
{
	count[ALD_COUNT_PRIMS]++;
	if (s)
		count[ALD_COUNT_REPEATS] += seen_again(s, a->prims->count, id);
}

/* s: NULL where nothing can be met again. Of a leaf, one block is a step; its box was tested once. */
V void count_step(const ald_accel *a, struct seen *s, uint32_t ref, int rest, uint64_t *count)
{
	count[ALD_COUNT_VOLUME_HITS] += !rest;
	if (ref < REF_LEAF) {
		count[ALD_COUNT_NODES]++;
		for (unsigned k = 0; k < WIDTH; k++)
			count[ALD_COUNT_VOLUME_TESTS] += a->node[ref].child[k] != EMPTY;
	} else if (ref >= REF_OTHERS) {
		const uint32_t *list = &a->other[ref & REF_INDEX];

		for (uint32_t i = 1; i <= list[0]; i++)
			count_prim(a, s, list[i], count);
	} else {
		const struct block *b = &a->block[ref & REF_INDEX];

		for (uint32_t i = 0; i < SEATS; i++) {
			if (b->slack[i] >= 0)
				count_prim(a, s, b->id[i], count);
		}
	}
}

/* ---- one ray ---- */

/* To its end, and counted. */
static __attribute__((noinline)) void walk_counted(const ald_accel *a, struct source *s, struct beam *b, int any)
{
	uint64_t *count = s->q->count;
	struct seen *seen = a->parts ? s->q->scratch : NULL;
	int rest = 0, useful = 0;

	count[ALD_COUNT_VOLUME_TESTS]++;
	if (seen)
		seen_begin(seen, a->prims->count);
	for (beam_pop(b); b->ref != DONE; beam_pop(b)) {
		uint32_t before = b->pending + b->found, ref = b->ref;
		double t = b->hit->t;

		count_step(a, seen, ref, rest, count);
		beam_step(a, &s->batch, &s->asked, s->q, b, any);
		useful = (rest && useful) || b->pending + b->found != before || b->hit->t != t;
		rest = ref >= REF_LEAF && ref < REF_OTHERS && ref >> REF_SHIFT & 7 && !(any && b->found);
		count[ALD_COUNT_VOLUME_USEFUL] += useful && !rest;
	}
	beam_end(a, &s->batch, &s->asked, b, any);
}

/* ---- a batch ---- */

/* Batches of as many rays at most are not worth a crew: one ray after another. */
#define LONE_MOST 12u
/* Of batches, which pairs of neighbours are looked at, and what is far, of scenes of size 2. */
#define SCATTERED_STEP 31u
#define SCATTERED_FAR 0.25

/* Do these rays see all primitives, so that no mask has to be looked at? */
V int see_all(const ald_accel *a, const struct batch *b, const uint16_t *order, uint32_t first, uint32_t from,
	      uint32_t end)
{
	if (!a->prims->mask)
		return 1;
	for (; a->masks && from < end; from++) {
		uint32_t mask = b->ray[order ? first + order[from] : from].mask;

		for (uint32_t k = 0; k < a->masks; k++) {
			if (!(a->mask[k] & mask))
				return 0;
		}
	}
	return from == end;
}

/* Rays that go alone: first + order[i], or i where there is none, from <= i < end. */
V void serve_alone(const ald_accel *a, ald_query *q, const struct batch *b, const uint16_t *order, uint32_t first,
		   uint32_t from, uint32_t end, int any)
{
#if ISA_LEVEL >= 2
	if (!a->fast && !a->frame.exact && see_all(a, b, order, first, from, end)) {
		for (; from < end; from += RIDE_RUN)
			serve_ride(a, q, b, order, first, from, end - from < RIDE_RUN ? end : from + RIDE_RUN, any);
		return;
	}
#endif
	serve_crew(a, q, b, order, first, from, end, any);
}

#if ISA_LEVEL >= 2
/* Do neighbours among n rays mostly begin far from each other, as seen from the scene? Then no sorting brings rays
 * together. */
V int are_scattered(const ald_accel *a, const ald_ray *r, uint32_t n)
{
	uint32_t far = 0, of = 0;

	for (uint32_t i = 0; i + 1 < n; i += SCATTERED_STEP) {
		const ald_vec *x = &r[i].org, *y = &r[i + 1].org;

		far += (fabs(x->x - y->x) + fabs(x->y - y->y) + fabs(x->z - y->z)) * a->scale > SCATTERED_FAR;
		of++;
	}
	return 2 * far > of;
}

/* As herds, as long as it pays, and then alone. */
static __attribute__((noinline)) void serve_herds(const ald_accel *a, ald_query *q, const struct batch *b, int any)
{
	struct herd h;
	struct asked asked;
	uint16_t order[HERD_SORTED];

	asked.n = 0;
	h.steps = h.rays = 0;
	h.due.some = 0;
	memset(h.due.corner, 0, sizeof(h.due.corner));
	h.lines = h.both;
	for (uint32_t from = 0; from < b->n; from += HERD_SORTED) {
		uint32_t n = b->n - from < HERD_SORTED ? b->n - from : HERD_SORTED, end[WAYS], at = 0, way = 0;
		int sorted = herd_is_sorted(b->ray + from, n);

		if (!sorted && are_scattered(a, b->ray + from, n)) {
			serve_alone(a, q, b, NULL, 0, from, from + n, any);
			continue;
		}
		if (!sorted)
			herd_sort(b->ray + from, n, order, end);
		while (at < n && h.rays >= herd_together(a, any) * h.steps) {
			uint32_t m = n - at;

			for (; !sorted && end[way] == at; way++)
				;
			m = sorted ? n - at : end[way] - at;
			m = m < LOT ? m : LOT;
			for (uint32_t i = 0; i < m; i++)
				h.lot.index[i] = from + (sorted ? at + i : order[at + i]);
			herd_serve(a, b, &asked, q, &h, m, any);
			at += m;
		}
		if (at < n)
			serve_alone(a, q, b, sorted ? NULL : order, from, sorted ? from + at : at,
				    sorted ? from + n : n, any);
	}
	if (h.due.some)
		due_ask(a, b, &h.due);
	ask(a, b, &asked);
}
#endif

/* Several rays. */
V void serve_many(const ald_accel *a, ald_query *q, const struct batch *b, int any)
{
#if ISA_LEVEL >= 2
	if (any && b->n >= HERD_LEAST && a->herds && !a->others && !a->fast && !a->frame.exact &&
	    are_short(a, b->ray, b->n) && see_all(a, b, NULL, 0, 0, b->n)) {
		serve_flood(a, q, b);
		return;
	}
	if (b->n >= HERD_LEAST && a->herds) {
		serve_herds(a, q, b, any);
		return;
	}
#endif
	serve_alone(a, q, b, NULL, 0, 0, b->n, any);
}

V void serve(const ald_accel *a, ald_query *q, const struct batch *b, int any)
{
	struct source s;
	struct beam beam;

	if (a->root == EMPTY || !b->n)
		return;
#if ISA_LEVEL >= 2
	if ((b->n <= LONE_MOST || a->interleave <= 1) && a->lone && !q->count) {
		serve_lone(a, q, b, any);
		return;
	}
#endif
	if (b->n > 1 && a->interleave > 1 && !q->count) {
		serve_many(a, q, b, any);
		return;
	}
	source_open(&s, q, b, NULL, 0, 0, b->n);
	while (source_next(a, &s, &beam, any)) {
		if (q->count)
			walk_counted(a, &s, &beam, any);
		else
			solo_walk(a, b, &s.asked, q, &beam, any);
	}
	ask(a, b, &s.asked);
}

static void nearest(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n,
		    uint32_t hints)
{
	struct batch b = { ray, hit, NULL, n };

	(void)hints;
	serve(a, q, &b, 0);
}

static void occluded(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden, uint32_t n,
		     uint32_t hints)
{
	struct batch b = { ray, NULL, hidden, n };

	memset(hidden, 0, n);
	(void)hints;
	serve(a, q, &b, 1);
}

#if ISA_LEVEL >= 2
const struct isa ISA_NAME = { ISA_TEXT, nearest, occluded, lone_nearest, lone_occluded, order_nodes };
#else
const struct isa ISA_NAME = { ISA_TEXT, nearest, occluded, NULL, NULL, NULL };
#endif

#endif
