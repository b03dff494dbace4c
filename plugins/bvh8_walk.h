/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's walks of single rays: one, or a crew of them in turns, so that what one waits for is fetched while
 * others compute. A crew's rays stand in lists by what comes next, nodes or leaves, and a turn goes through a
 * list: then neither the kind of the next step nor the number of children entered is a branch that a processor
 * has to guess. To be included by one file for each instruction set, which defines ISA_LEVEL and ISA_NAME.
 */
#ifndef BVH8_WALK_H
#define BVH8_WALK_H

#include "bvh8_herd.h"
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

/* ---- handing out rays ---- */

struct source {
	struct batch batch;
	ald_query *q;
	struct asked asked;
	struct lot lot;
	const uint16_t *order; /* of the rays, counted from the first, or NULL */
	uint32_t first, next, end; /* what comes behind the lot */
	uint64_t left; /* lanes of the lot */
};

/* Rays first + order[i], or i, from <= i < end. */
V void source_open(struct source *s, ald_query *q, const struct batch *b, const uint16_t *order, uint32_t first,
		   uint32_t from, uint32_t end)
{
	s->batch = *b;
	s->q = q;
	s->order = order;
	s->first = first;
	s->next = from;
	s->end = end;
	s->asked.n = 0;
	s->left = 0;
}

/* A lot more; 0: there is none. */
V int source_fill(const ald_accel *a, struct source *s, int any)
{
	uint32_t n = s->end - s->next < LOT ? s->end - s->next : LOT;

	if (!n)
		return 0;
	for (uint32_t i = 0; i < n; i++)
		s->lot.index[i] = s->order ? s->first + s->order[s->next + i] : s->next + i;
	s->next += n;
	lot_fill(a, &s->lot, &s->batch, n);
	lot_odd(a, s->q, &s->batch, &s->lot, any);
	s->left = s->lot.live & ~s->lot.odd;
	return 1;
}

V int source_next(const ald_accel *a, struct source *s, struct beam *b, int any)
{
	unsigned i;

	while (!s->left) {
		if (!source_fill(a, s, any))
			return 0;
	}
	i = (unsigned)__builtin_ctzll(s->left);
	s->left &= s->left - 1;
	beam_begin(a, b, &s->lot, i, &s->batch, s->lot.index[i]);
	return 1;
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

/* ---- a crew ---- */

enum { AT_NODE, AT_LEAF, AT_OTHERS, AT_END, AT_NOTHING, AT_REST, PLACES }; /* AT_NOTHING: beyond a hit */

struct crew {
	struct source source;
	const char *base[2]; /* of nodes and blocks, and their sizes */
	size_t size[2];
	uint8_t list[PLACES][INTERLEAVE_MAX];
	uint32_t n[PLACES];
	struct beam beam[INTERLEAVE_MAX];
};

/* On to the top of the stack. Where to that is stays with the beam until all of a turn are done: a list that
 * grows where a walk has just come to would hold up the loads of the next one. */
V void crew_move(const struct crew *c, struct beam *b)
{
	uint32_t top = b->top - 1, ref = b->below[top], beyond = b->enter[top] > b->tfar;
	uint32_t end = ref == DONE, leaf = ref >= REF_LEAF, place = leaf + (ref >= REF_OTHERS) + end;
	const char *p = c->base[leaf] + (ref & REF_INDEX & (end - 1)) * c->size[leaf];

	__builtin_prefetch(p);
	__builtin_prefetch(p + 64);
	__builtin_prefetch(p + 128);
	__builtin_prefetch(p + 175);
	__builtin_prefetch(p + 192);
	b->top = top;
	b->ref = ref;
	b->place = (place & (beyond - 1)) | beyond << 2;
}

/* Those of a list that have moved, each to the list it belongs to. */
V void crew_deal(struct crew *c, uint32_t from, uint32_t n)
{
	uint8_t moved[INTERLEAVE_MAX];

	memcpy(moved, c->list[from], sizeof(moved));
	c->n[from] = 0;
	for (uint32_t k = 0; k < n; k++) {
		uint32_t place = c->beam[moved[k]].place;

		c->list[place][c->n[place]++] = moved[k];
	}
}

/* One end of a walk, and the next one's begin; 0: there is no next one. */
V int crew_next(const ald_accel *a, struct crew *c, struct beam *b, int any)
{
	struct source *s = &c->source;

	beam_end(a, &s->batch, &s->asked, b, any);
	return source_next(a, s, b, any);
}

/* The longest list is worked off: its length is all that is to be guessed, and that once. */
V void crew_work(const ald_accel *a, struct crew *c, int any)
{
	struct source *s = &c->source;
	uint32_t live = 0;

	while (live < a->interleave && source_next(a, s, &c->beam[live], any)) {
		crew_move(c, &c->beam[live]);
		c->list[AT_NODE][live] = (uint8_t)live;
		live++;
	}
	crew_deal(c, AT_NODE, live);
	while (live) {
		uint32_t place = AT_NODE, n = c->n[AT_NODE];
		const uint8_t *list;

		for (uint32_t k = AT_NODE + 1; k < AT_REST; k++) {
			place = c->n[k] > n ? k : place;
			n = c->n[k] > n ? c->n[k] : n;
		}
		list = c->list[place];
		if (place == AT_NODE) {
			for (uint32_t k = 0; k < n; k++) {
				beam_node(a, &c->beam[list[k]]);
				crew_move(c, &c->beam[list[k]]);
			}
		} else if (place == AT_LEAF) {
			for (uint32_t k = 0; k < n; k++) {
				beam_leaf(a, &s->batch, &s->asked, &c->beam[list[k]], any);
				crew_move(c, &c->beam[list[k]]);
			}
		} else if (place == AT_NOTHING) {
			for (uint32_t k = 0; k < n; k++)
				crew_move(c, &c->beam[list[k]]);
		} else if (place == AT_OTHERS) {
			for (uint32_t k = 0; k < n; k++) {
				beam_others(a, s->q, &c->beam[list[k]], any);
				crew_move(c, &c->beam[list[k]]);
			}
		} else {
			for (uint32_t k = 0; k < n; k++) {
				if (crew_next(a, c, &c->beam[list[k]], any)) {
					crew_move(c, &c->beam[list[k]]);
					continue;
				}
				c->beam[list[k]].place = AT_REST;
				live--;
			}
		}
		crew_deal(c, place, n);
	}
}

/* ---- a batch ---- */

static __attribute__((noinline)) void serve_crew(const ald_accel *a, ald_query *q, const struct batch *b,
						 const uint16_t *order, uint32_t first, uint32_t from, uint32_t end,
						 int any)
{
	struct crew c;

	source_open(&c.source, q, b, order, first, from, end);
	c.base[0] = (const char *)a->node;
	c.base[1] = (const char *)a->block;
	c.size[0] = sizeof(*a->node);
	c.size[1] = sizeof(*a->block);
	memset(c.n, 0, sizeof(c.n));
	crew_work(a, &c, any);
	ask(a, b, &c.source.asked);
}

#if ISA_LEVEL >= 2
/* As herds, as long as it pays, and then as a crew. */
static __attribute__((noinline)) void serve_herds(const ald_accel *a, ald_query *q, const struct batch *b, int any)
{
	struct herd h;
	struct asked asked;
	uint16_t order[HERD_SORTED];

	asked.n = 0;
	h.steps = h.rays = 0;
	for (uint32_t from = 0; from < b->n; from += HERD_SORTED) {
		uint32_t n = b->n - from < HERD_SORTED ? b->n - from : HERD_SORTED, end[WAYS], at = 0, way = 0;

		herd_sort(b->ray + from, n, order, end);
		while (at < n && h.rays >= herd_together(a, any) * h.steps) {
			uint32_t m;

			for (; end[way] == at; way++)
				;
			m = end[way] - at < LOT ? end[way] - at : LOT;
			herd_serve(a, b, &asked, q, &h, order + at, from, m, way, any);
			at += m;
		}
		if (at < n)
			serve_crew(a, q, b, order, from, at, n, any);
	}
	ask(a, b, &asked);
}
#endif

/* Several rays. */
V void serve_many(const ald_accel *a, ald_query *q, const struct batch *b, int any)
{
#if ISA_LEVEL >= 2
	if (b->n >= HERD_LEAST && a->herds) {
		serve_herds(a, q, b, any);
		return;
	}
#endif
	serve_crew(a, q, b, NULL, 0, 0, b->n, any);
}

V void serve(const ald_accel *a, ald_query *q, const struct batch *b, int any)
{
	struct source s;
	struct beam beam;

	if (a->root == EMPTY || !b->n)
		return;
	if (b->n > 1 && a->interleave > 1 && !q->count) {
		serve_many(a, q, b, any);
		return;
	}
	source_open(&s, q, b, NULL, 0, 0, b->n);
	while (source_next(a, &s, &beam, any)) {
		if (q->count)
			walk_counted(a, &s, &beam, any);
		else
			beam_walk(a, b, &s.asked, q, &beam, any);
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

const struct isa ISA_NAME = { ISA_TEXT, nearest, occluded };

#endif
