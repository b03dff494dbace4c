/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's walks. One ray, nearest child first; or several in turns, each a step and then the next one's, so
 * that what a ray waits for is fetched while others are computed. To be included by one file for each
 * instruction set, which defines ISA_LEVEL and ISA_NAME.
 */
#ifndef BVH8_WALK_H
#define BVH8_WALK_H

#include "bvh8_beam.h"
#include "seen.h"

#define DONE EMPTY /* the next step of a walk that has ended */

/* Below a node, where the ray enters a child, as the bits of a float >= 0, above the reference: entries
 * compare as distances do. */
V uint64_t entry_make(float t, uint32_t ref)
{
	uint32_t bits;

	memcpy(&bits, &t, sizeof(bits));
	return (uint64_t)bits << 32 | ref;
}

V float entry_enter(uint64_t e)
{
	uint32_t bits = (uint32_t)(e >> 32);
	float t;

	memcpy(&t, &bits, sizeof(t));
	return t;
}

V uint32_t pop(const struct beam *b, const uint64_t *stack, uint32_t *top, int any)
{
	while (*top) {
		uint64_t e = stack[--*top];

		if (any || !(entry_enter(e) > b->tfar))
			return (uint32_t)e;
	}
	return DONE;
}

/* Through a node: the nearest of what the ray enters is next, the others go on the stack, the nearest of
 * them last. For any hit, as they stand in the node: large boxes first. */
V uint32_t step_node(const ald_accel *a, const struct beam *b, uint32_t ref, uint64_t *stack, uint32_t *top,
		     int any)
{
	const struct node *n = &a->node[ref];
	float enter[WIDTH] __attribute__((aligned(32)));
	uint32_t bits = beam_node(b, n, enter);
	uint64_t *first = stack + *top, *p, e, f;
	unsigned k;

	if (!bits)
		return pop(b, stack, top, any);
	k = (unsigned)__builtin_ctz(bits);
	bits &= bits - 1;
	if (!bits)
		return n->child[k];
	e = entry_make(enter[k], n->child[k]);
	k = (unsigned)__builtin_ctz(bits);
	bits &= bits - 1;
	f = entry_make(enter[k], n->child[k]);
	if (any) {
		*first = f;
		for (p = first + 1; bits; bits &= bits - 1)
			*p++ = n->child[__builtin_ctz(bits)];
		*top = (uint32_t)(p - stack);
		return (uint32_t)e;
	}
	*first = e > f ? e : f;
	e = e > f ? f : e; /* the nearest so far */
	for (p = first + 1; bits; bits &= bits - 1) {
		uint64_t *at = p++;

		k = (unsigned)__builtin_ctz(bits);
		f = entry_make(enter[k], n->child[k]);
		if (f < e) {
			*at = e;
			e = f;
			continue;
		}
		for (; at > first && at[-1] < f; at--)
			*at = at[-1];
		*at = f;
	}
	*top = (uint32_t)(p - stack);
	return (uint32_t)e;
}

V void count_prim(const ald_accel *a, struct seen *s, uint32_t id, uint64_t *count)
{
	count[ALD_COUNT_PRIMS]++;
	if (s)
		count[ALD_COUNT_REPEATS] += seen_again(s, a->prims->count, id);
}

/* s: NULL where nothing can be met again. */
V void count_step(const ald_accel *a, struct seen *s, uint32_t ref, uint64_t *count)
{
	count[ALD_COUNT_VOLUME_HITS]++;
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

		for (uint32_t i = 0; i < SEATS * ((ref >> REF_SHIFT & 7) + 1); i++) {
			if (b[i / SEATS].slack[i % SEATS] >= 0)
				count_prim(a, s, b[i / SEATS].id[i % SEATS], count);
		}
	}
}

/* 1: there is something to be walked through; 0: all is known already, and *found. */
V int begin(const ald_accel *a, ald_query *q, struct beam *b, const ald_ray *ray, ald_hit *hit, int any,
	    int *found)
{
	*found = 0;
	if (a->root == EMPTY || !beam_begin(a, b, ray, hit))
		return 0;
	if (b->axis[0] < 3)
		return 1;
	*found = beam_odd(a, q, b, any);
	return 0;
}

/* Returns if anything was hit only if any. Counting is a second copy, so that it costs nothing when it is off. */
V int walk_one(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, int any, uint64_t *count)
{
	struct beam b;
	struct seen *seen = count && a->parts ? q->scratch : NULL;
	uint64_t stack[STACK_MAX];
	uint32_t top = 0, ref = a->root;
	int found;

	if (count)
		count[ALD_COUNT_VOLUME_TESTS]++;
	if (seen)
		seen_begin(seen, a->prims->count);
	if (!begin(a, q, &b, ray, hit, any, &found))
		return found;
	while (ref != DONE) {
		if (count)
			count_step(a, seen, ref, count);
		if (ref < REF_LEAF) {
			ref = step_node(a, &b, ref, stack, &top, any);
			continue;
		}
		found = beam_leaf(a, q, &b, ref, any);
		if (count)
			count[ALD_COUNT_VOLUME_USEFUL] += (uint64_t)found;
		if (any && found)
			return 1;
		ref = pop(&b, stack, &top, any);
	}
	if (!any)
		beam_settle(a, &b);
	return 0;
}

V void fetch(const ald_accel *a, uint32_t ref)
{
	const char *p;

	if (ref < REF_LEAF) {
		p = (const char *)&a->node[ref];
		__builtin_prefetch(p);
		__builtin_prefetch(p + 64);
		__builtin_prefetch(p + 128);
		__builtin_prefetch(p + 192);
	} else if (ref < REF_OTHERS) {
		p = (const char *)&a->block[ref & REF_INDEX];
		__builtin_prefetch(p);
		__builtin_prefetch(p + 64);
		__builtin_prefetch(p + 128);
		__builtin_prefetch(p + 175);
	}
}

struct stream { /* the rays of a batch */
	const ald_ray *ray;
	ald_hit *hit; /* NULL: any will do, and hidden is told */
	uint8_t *hidden;
	uint32_t n, next;
};

struct walk {
	struct beam beam;
	ald_hit own; /* where any hit will do */
	uint32_t ref, top, index, late; /* late: of the end, when triangles are fetched to be asked about */
	uint64_t stack[STACK_MAX];
};

/* The next ray that has a way to go; 0: there is none. */
V int stream_next(const ald_accel *a, ald_query *q, struct stream *s, struct walk *w, int any)
{
	while (s->next < s->n) {
		uint32_t i = s->next++;
		int found;

		if (any)
			w->own = (ald_hit){ .t = s->ray[i].tmax, .prim = ALD_NONE };
		w->index = i;
		w->top = w->late = 0;
		w->ref = a->root;
		if (begin(a, q, &w->beam, &s->ray[i], any ? &w->own : &s->hit[i], any, &found))
			return 1;
		if (any)
			s->hidden[i] = (uint8_t)found;
	}
	return 0;
}

/* A walk that has arrived waits two turns for the corners of the triangle that is probably hit. */
V int still_late(const ald_accel *a, struct walk *w)
{
	const ald_prims *p = a->prims;
	uint32_t id = w->beam.id[0];

	if (!w->beam.pending || !a->far)
		return 0;
	for (uint32_t i = 1; i < w->beam.pending; i++)
		id = w->beam.low[i] < w->beam.low[0] ? w->beam.id[i] : id;
	if (!w->late++) {
		__builtin_prefetch(&p->index[3 * (size_t)id]);
		return 1;
	}
	if (w->late > 2)
		return 0;
	for (unsigned k = 0; k < 3; k++) {
		size_t at = 3 * (size_t)p->index[3 * (size_t)id + k] * (p->vertex_double ? 8 : 4);

		__builtin_prefetch((const char *)p->vertex + at);
	}
	return 1;
}

/* One step; 0: the walk has ended. */
V int take_turn(const ald_accel *a, ald_query *q, struct stream *s, struct walk *w, int any)
{
	int found = 0;

	if (w->ref < REF_LEAF) {
		w->ref = step_node(a, &w->beam, w->ref, w->stack, &w->top, any);
	} else if (w->ref != DONE) {
		found = beam_leaf(a, q, &w->beam, w->ref, any);
		w->ref = any && found ? DONE : pop(&w->beam, w->stack, &w->top, any);
	}
	if (w->ref != DONE) {
		fetch(a, w->ref);
		return 1;
	}
	if (any)
		s->hidden[w->index] = (uint8_t)found;
	else if (still_late(a, w))
		return 1;
	else
		beam_settle(a, &w->beam);
	return 0;
}

V void take_turns(const ald_accel *a, ald_query *q, struct stream *s, int any)
{
	struct walk walk[INTERLEAVE_MAX];
	uint32_t turn[INTERLEAVE_MAX], live = 0, most = a->interleave;

	while (live < most && stream_next(a, q, s, &walk[live], any)) {
		turn[live] = live;
		live++;
	}
	while (live) {
		for (uint32_t i = 0; i < live; i++) {
			struct walk *w = &walk[turn[i]];

			if (!take_turn(a, q, s, w, any) && !stream_next(a, q, s, w, any))
				turn[i--] = turn[--live];
		}
	}
}

static void nearest(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n,
		    uint32_t hints)
{
	struct stream s = { ray, hit, NULL, n, 0 };

	if (!q->count && n > 1 && a->interleave > 1 && (a->far || !(hints & ALD_COHERENT))) {
		take_turns(a, q, &s, 0);
		return;
	}
	for (uint32_t i = 0; i < n && !q->count; i++)
		walk_one(a, q, &ray[i], &hit[i], 0, NULL);
	for (uint32_t i = 0; i < n && q->count; i++)
		walk_one(a, q, &ray[i], &hit[i], 0, q->count);
}

static void occluded(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden, uint32_t n,
		     uint32_t hints)
{
	struct stream s = { ray, NULL, hidden, n, 0 };

	if (!q->count && n > 1 && a->interleave > 1 && (a->far || !(hints & ALD_COHERENT))) {
		take_turns(a, q, &s, 1);
		return;
	}
	for (uint32_t i = 0; i < n; i++) {
		ald_hit hit = { .t = ray[i].tmax, .prim = ALD_NONE };

		hidden[i] = (uint8_t)(q->count ? walk_one(a, q, &ray[i], &hit, 1, q->count) :
						 walk_one(a, q, &ray[i], &hit, 1, NULL));
	}
}

const struct isa ISA_NAME = { ISA_TEXT, nearest, occluded };

#endif
