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

struct walk {
	struct beam beam;
	uint32_t ref, top, index, found;
	uint64_t stack[STACK_MAX];
};

V uint32_t pop(struct walk *w, int any)
{
	while (w->top) {
		uint64_t e = w->stack[--w->top];

		if (any || !(entry_enter(e) > w->beam.tfar))
			return (uint32_t)e;
	}
	return DONE;
}

/* Through a node: the nearest of what the ray enters is next, the others go on the stack, the nearest of
 * them last. For any hit, as they stand in the node: large boxes first. */
V uint32_t step_node(const ald_accel *a, struct walk *w, int any)
{
	const struct node *n = &a->node[w->ref];
	float enter[WIDTH] __attribute__((aligned(32)));
	uint32_t bits = beam_node(&w->beam, n, enter);
	uint64_t *first = &w->stack[w->top], *p, e, f;
	unsigned k;

	if (!bits)
		return pop(w, any);
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
		w->top = (uint32_t)(p - w->stack);
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
	w->top = (uint32_t)(p - w->stack);
	return (uint32_t)e;
}

V uint32_t step_leaf(const ald_accel *a, ald_query *q, struct walk *w, int any)
{
	w->found |= (uint32_t)beam_leaf(a, q, &w->beam, w->ref, any);
	return any && w->found ? DONE : pop(w, any);
}

V void count_step(const ald_accel *a, const struct walk *w, uint64_t *count)
{
	if (w->ref < REF_LEAF) {
		count[ALD_COUNT_NODES]++;
		for (unsigned k = 0; k < WIDTH; k++)
			count[ALD_COUNT_VOLUME_TESTS] += a->node[w->ref].child[k] != EMPTY;
	} else if (w->ref >= REF_OTHERS) {
		count[ALD_COUNT_PRIMS] += a->other[w->ref & REF_INDEX];
	} else {
		const struct block *b = &a->block[w->ref & REF_INDEX];

		for (uint32_t i = 0; i < SEATS * ((w->ref >> REF_SHIFT & 7) + 1); i++)
			count[ALD_COUNT_PRIMS] += b[i / SEATS].slack[i % SEATS] >= 0;
	}
}

/* 1: there is something to be walked through; 0: all is known already. */
V int begin(const ald_accel *a, ald_query *q, struct walk *w, const ald_ray *ray, ald_hit *hit, int any)
{
	w->found = 0;
	w->top = 0;
	w->ref = a->root;
	if (!beam_begin(a, &w->beam, ray, hit))
		return 0;
	if (w->beam.axis[0] < 3)
		return 1;
	w->found = (uint32_t)beam_odd(a, q, &w->beam, any);
	return 0;
}

/* Counting is a second copy, so that it costs nothing when it is off. */
V int walk_one(const ald_accel *a, ald_query *q, struct walk *w, const ald_ray *ray, ald_hit *hit, int any,
	       uint64_t *count)
{
	if (count)
		count[ALD_COUNT_VOLUME_TESTS]++;
	if (!begin(a, q, w, ray, hit, any))
		return (int)w->found;
	while (w->ref != DONE) {
		uint32_t found = w->found;

		if (count) {
			count[ALD_COUNT_VOLUME_HITS]++;
			count_step(a, w, count);
			w->found = 0;
		}
		w->ref = w->ref < REF_LEAF ? step_node(a, w, any) : step_leaf(a, q, w, any);
		if (count) {
			count[ALD_COUNT_VOLUME_USEFUL] += w->found;
			w->found |= found;
		}
	}
	return (int)w->found;
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

/* The next ray that has a way to go; 0: there is none. */
V int stream_next(const ald_accel *a, ald_query *q, struct stream *s, struct walk *w, ald_hit *own, int any)
{
	while (s->next < s->n) {
		uint32_t i = s->next++;

		if (any)
			*own = (ald_hit){ .t = s->ray[i].tmax, .prim = ALD_NONE };
		w->index = i;
		if (begin(a, q, w, &s->ray[i], any ? own : &s->hit[i], any))
			return 1;
		if (any)
			s->hidden[i] = (uint8_t)w->found;
	}
	return 0;
}

V void take_turns(const ald_accel *a, ald_query *q, struct stream *s, int any)
{
	struct walk walk[INTERLEAVE_MAX];
	ald_hit own[INTERLEAVE_MAX];
	uint32_t turn[INTERLEAVE_MAX], live = 0, most = a->interleave;

	while (live < most && stream_next(a, q, s, &walk[live], &own[live], any)) {
		turn[live] = live;
		live++;
	}
	while (live) {
		for (uint32_t i = 0; i < live; i++) {
			struct walk *w = &walk[turn[i]];

			w->ref = w->ref < REF_LEAF ? step_node(a, w, any) : step_leaf(a, q, w, any);
			if (w->ref != DONE) {
				fetch(a, w->ref);
				continue;
			}
			if (any)
				s->hidden[w->index] = (uint8_t)w->found;
			if (!stream_next(a, q, s, w, &own[turn[i]], any))
				turn[i--] = turn[--live];
		}
	}
}

static void nearest(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n,
		    uint32_t hints)
{
	struct stream s = { ray, hit, NULL, n, 0 };
	struct walk w;

	if (!q->count && n > 1 && a->interleave > 1 && !(hints & ALD_COHERENT)) {
		take_turns(a, q, &s, 0);
		return;
	}
	for (uint32_t i = 0; i < n && !q->count; i++)
		walk_one(a, q, &w, &ray[i], &hit[i], 0, NULL);
	for (uint32_t i = 0; i < n && q->count; i++)
		walk_one(a, q, &w, &ray[i], &hit[i], 0, q->count);
}

static void occluded(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden, uint32_t n,
		     uint32_t hints)
{
	struct stream s = { ray, NULL, hidden, n, 0 };
	struct walk w;

	if (!q->count && n > 1 && a->interleave > 1 && !(hints & ALD_COHERENT)) {
		take_turns(a, q, &s, 1);
		return;
	}
	for (uint32_t i = 0; i < n; i++) {
		ald_hit hit = { .t = ray[i].tmax, .prim = ALD_NONE };

		hidden[i] = (uint8_t)(q->count ? walk_one(a, q, &w, &ray[i], &hit, 1, q->count) :
						 walk_one(a, q, &w, &ray[i], &hit, 1, NULL));
	}
}

const struct isa ISA_NAME = { ISA_TEXT, nearest, occluded };

#endif
