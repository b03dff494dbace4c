/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's crews: rays that go alone, up to 48 of them in turns, so that what one waits for is fetched while others
 * compute. They stand in lists by what comes next, nodes or leaves, and a turn goes through a list: then neither the
 * kind of the next step nor the number of children entered is a branch that a processor has to guess. Where each goes
 * from there is found out for all of the list at once, sixteen rays in a step where there is AVX-512.
 */
#ifndef BVH8_CREW_H
#define BVH8_CREW_H

#include "bvh8_solo.h"

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
	for (uint32_t i = n; i % 8; i++)
		s->lot.index[i] = s->lot.index[n - 1]; /* eight rays are made ready together */
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

/* ---- a crew ---- */

enum { AT_NODE, AT_LEAF, AT_OTHERS, AT_END, PLACES };

#define CREW_ROOM (INTERLEAVE_MAX + 16)

struct turn { /* rays that take the same step next; what that needs of them, side by side */
	uint32_t ray[CREW_ROOM], ref[CREW_ROOM], top[CREW_ROOM];
	float tfar[CREW_ROOM];
	uint32_t n;
} __attribute__((aligned(64)));

struct turns { /* by what comes next */
	struct turn turn[PLACES + 1];
	struct turn *at[PLACES], *spare;
};

struct crew {
	struct source source;
	struct turns turns;
	struct beam beam[INTERLEAVE_MAX];
};

V void turn_add(struct turn *t, uint32_t ray, uint32_t ref, uint32_t top, float tfar)
{
	uint32_t n = t->n++;

	t->ray[n] = ray;
	t->ref[n] = ref;
	t->top[n] = top;
	t->tfar[n] = tfar;
}

#if ISA_LEVEL >= 3
V void turn_add_some(struct turn *t, __mmask16 in, __m512i ray, __m512i ref, __m512i top, __m512 tfar)
{
	uint32_t n = t->n;

	_mm512_storeu_si512(t->ray + n, _mm512_maskz_compress_epi32(in, ray));
	_mm512_storeu_si512(t->ref + n, _mm512_maskz_compress_epi32(in, ref));
	_mm512_storeu_si512(t->top + n, _mm512_maskz_compress_epi32(in, top));
	_mm512_storeu_ps(t->tfar + n, _mm512_maskz_compress_ps(in, tfar));
	t->n = n + (uint32_t)__builtin_popcount(in);
}

/* Those of a list go on to the top of their stack, or to the next block of a leaf, and to the list where that is. */
V void turns_deal(struct turns *c, const struct turn *w, const float *enters, const uint32_t *belows, size_t each,
		  int leaves)
{
	const __m512i more = _mm512_set1_epi32(7 << REF_SHIFT), one = _mm512_set1_epi32(1);

	for (uint32_t i = 0; i < w->n; i += 16) {
		__mmask16 all = (__mmask16)(w->n - i < 16 ? (1u << (w->n - i)) - 1 : 0xffff), open = all, leaf, rare;
		__m512i ray = _mm512_load_si512(w->ray + i), ref = _mm512_load_si512(w->ref + i);
		__m512i top = _mm512_load_si512(w->top + i), at;
		__m512 tfar = _mm512_load_ps(w->tfar + i), enter = _mm512_setzero_ps();
		__m512i base = _mm512_mullo_epi32(ray, _mm512_set1_epi32((int)(each / sizeof(float))));

		if (leaves) {
			open = (__mmask16)(all & ~_mm512_test_epi32_mask(ref, more));
			ref = _mm512_sub_epi32(ref, _mm512_set1_epi32((1 << REF_SHIFT) - 1));
		}
		do {
			top = _mm512_mask_sub_epi32(top, open, top, one);
			at = _mm512_add_epi32(base, top);
			enter = _mm512_mask_i32gather_ps(enter, open, at, enters, 4);
			ref = _mm512_mask_i32gather_epi32(ref, open, at, belows, 4);
			open = _mm512_mask_cmp_ps_mask(open, enter, tfar, _CMP_GT_OQ);
		} while (open);
		leaf = _mm512_mask_cmpge_epu32_mask(all, ref, _mm512_set1_epi32((int)REF_LEAF));
		rare = _mm512_mask_cmpge_epu32_mask(all, ref, _mm512_set1_epi32((int)REF_OTHERS));
		turn_add_some(c->at[AT_NODE], all & ~leaf, ray, ref, top, tfar);
		turn_add_some(c->at[AT_LEAF], leaf & ~rare, ray, ref, top, tfar);
		if (rare) {
			__mmask16 end = _mm512_mask_cmpeq_epu32_mask(rare, ref, _mm512_set1_epi32((int)DONE));

			turn_add_some(c->at[AT_END], end, ray, ref, top, tfar);
			turn_add_some(c->at[AT_OTHERS], rare & ~end, ray, ref, top, tfar);
		}
	}
}
#else
V void turns_deal(struct turns *c, const struct turn *w, const float *enters, const uint32_t *belows, size_t each,
		  int leaves)
{
	for (uint32_t i = 0; i < w->n; i++) {
		size_t at = w->ray[i] * each / sizeof(float);
		uint32_t top = w->top[i], ref = w->ref[i], place;

		if (leaves && ref & 7u << REF_SHIFT) {
			ref -= (1u << REF_SHIFT) - 1;
		} else {
			do
				top--;
			while (enters[at + top] > w->tfar[i]);
			ref = belows[at + top];
		}
		place = (uint32_t)(ref >= REF_LEAF) + (ref >= REF_OTHERS) + (ref == DONE);
		turn_add(c->at[place], w->ray[i], ref, top, w->tfar[i]);
	}
}
#endif

V void turn_fetch(const ald_accel *a, const struct turn *w)
{
	for (uint32_t i = 0; i < w->n; i++) {
		uint32_t ref = w->ref[i];
		const char *p = ref < REF_LEAF ? (const char *)&a->node[ref] :
						 (const char *)&a->block[ref & REF_INDEX];

		__builtin_prefetch(p);
		__builtin_prefetch(p + 64);
		__builtin_prefetch(p + 128);
		__builtin_prefetch(p + 175);
		__builtin_prefetch(p + 192);
	}
}

V void crew_node(const ald_accel *a, struct beam *b, struct turn *w, uint32_t i)
{
	b->ref = w->ref[i];
	b->top = w->top[i];
	b->tfar = w->tfar[i];
	beam_node(a, b);
	w->top[i] = b->top;
}

V void crew_leaf(const ald_accel *a, struct source *s, struct beam *b, struct turn *w, uint32_t i, int any)
{
	const struct block *n = &a->block[w->ref[i] & REF_INDEX];
	struct meeting m;

	b->top = w->top[i];
	b->tfar = w->tfar[i];
	block_meet(a, &b->aim, n, b->ray, &m, 0);
	if (a->fast)
		beam_meet_fast(a, b, n, &m, any);
	else
		beam_meet(a, &s->batch, &s->asked, b, n, &m, any);
	if (any)
		w->ref[i] = b->found ? REF_LEAF : w->ref[i];
	w->top[i] = b->top;
	w->tfar[i] = b->tfar;
}

/* Walks that have ended, and those that begin in their place. */
V void crew_next(const ald_accel *a, struct crew *c, struct turn *w, int any)
{
	struct source *s = &c->source;
	uint32_t n = 0;

	for (uint32_t i = 0; i < w->n; i++) {
		struct beam *b = &c->beam[w->ray[i]];

		beam_end(a, &s->batch, &s->asked, b, any);
		if (!source_next(a, s, b, any))
			continue;
		w->ray[n] = w->ray[i];
		w->top[n] = 2;
		w->tfar[n++] = b->tfar;
	}
	w->n = n;
}

V void crew_deal(struct crew *c, const struct turn *w, int leaves)
{
	turns_deal(&c->turns, w, c->beam->enter, c->beam->below, sizeof(*c->beam), leaves);
}

V void crew_step(const ald_accel *a, struct crew *c, struct turn *w, uint32_t place, int any)
{
	struct source *s = &c->source;

	if (place == AT_NODE) {
		for (uint32_t i = 0; i < w->n; i++)
			crew_node(a, &c->beam[w->ray[i]], w, i);
		crew_deal(c, w, 0);
		return;
	}
	if (place == AT_LEAF) {
		for (uint32_t i = 0; i < w->n; i++)
			crew_leaf(a, s, &c->beam[w->ray[i]], w, i, any);
		crew_deal(c, w, 1);
		return;
	}
	if (place == AT_END)
		crew_next(a, c, w, any);
	for (uint32_t i = 0; i < w->n && place == AT_OTHERS; i++) {
		struct beam *b = &c->beam[w->ray[i]];

		b->ref = w->ref[i];
		b->top = w->top[i];
		b->tfar = w->tfar[i];
		beam_others(a, s->q, b, any);
		w->top[i] = b->top;
		w->tfar[i] = b->tfar;
	}
	crew_deal(c, w, 0);
}

/* The longest list is to be worked off: its length is all that is to be guessed, and that once. NULL: all have
 * ended. */
V struct turn *turns_next(struct turns *c, uint32_t *place)
{
	uint32_t n = c->at[AT_NODE]->n;
	struct turn *w;

	*place = AT_NODE;
	for (uint32_t k = AT_NODE + 1; k < PLACES; k++) {
		*place = c->at[k]->n > n ? k : *place;
		n = c->at[k]->n > n ? c->at[k]->n : n;
	}
	if (!n)
		return NULL;
	w = c->at[*place];
	c->at[*place] = c->spare;
	c->spare->n = 0;
	c->spare = w;
	return w;
}

/* Nobody stands there; the list that the first are to be put on. */
V struct turn *turns_begin(struct turns *c)
{
	for (unsigned i = 0; i < PLACES; i++) {
		c->at[i] = &c->turn[i];
		c->at[i]->n = 0;
	}
	c->spare = &c->turn[PLACES];
	c->spare->n = 0;
	return c->spare;
}

static __attribute__((noinline)) void serve_crew(const ald_accel *a, ald_query *q, const struct batch *b,
						 const uint16_t *order, uint32_t first, uint32_t from, uint32_t end,
						 int any)
{
	struct crew c;
	struct turn *w = turns_begin(&c.turns);

	source_open(&c.source, q, b, order, first, from, end);
	for (uint32_t i = 0; i < a->interleave && source_next(a, &c.source, &c.beam[i], any); i++)
		turn_add(w, i, 0, 2, c.beam[i].tfar);
	crew_deal(&c, w, 0);
	for (uint32_t place; (w = turns_next(&c.turns, &place)) != NULL;) {
		if (a->far && (place == AT_NODE || place == AT_LEAF))
			turn_fetch(a, w);
		crew_step(a, &c, w, place, any);
	}
	ask(a, b, &c.source.asked);
}

#endif
