/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A ray of bvh8's that goes alone, to its end: what nodes want to know of it stays in registers, and a processor that
 * guesses branches goes on into the next node before it knows that it was right: it guesses which child, too. Most
 * nodes are left through one child or two; nothing is sorted there.
 */
#ifndef BVH8_SOLO_H
#define BVH8_SOLO_H

#include "bvh8_lone.h"

struct slopes { /* of a path, for eight children */
	f8 ix, iy, iz, nx, ny, nz, fx, fy, fz;
	uint32_t down; /* bits: the direction goes down */
};

V struct slopes slopes_of(const struct beam *b)
{
	return (struct slopes){ f8_all(b->inverse[0]), f8_all(b->inverse[1]), f8_all(b->inverse[2]),
				f8_all(b->near_o[0]),  f8_all(b->near_o[1]),  f8_all(b->near_o[2]),
				f8_all(b->far_o[0]),   f8_all(b->far_o[1]),   f8_all(b->far_o[2]),
				b->way ^ ORDER_TURNED };
}

/* Child k, for a processor that guesses: it is as if there were a branch for each, whose address is known long before k
 * is. So while neighbours go the same way no node waits for the boxes of the one before. */
#define CHILD(k)                                         \
	case k:                                          \
		ref = n->child[k];                       \
		__asm__ volatile("/*" #k "*/" : "+r"(ref)); /* else they are made one again */ \
		break

V uint32_t child_guessed(const struct node *n, uint32_t k)
{
	uint32_t ref;

	switch (k) {
		CHILD(0);
		CHILD(1);
		CHILD(2);
		CHILD(3);
		CHILD(4);
		CHILD(5);
		CHILD(6);
		CHILD(7);
	default:
		__builtin_unreachable();
	}
	return ref;
}
#undef CHILD

/* What a block may hold. line: of a ray that asks for itself; NULL: the batch asks. */
V void solo_meet(const ald_accel *a, const struct batch *s, struct asked *q, const struct line *line, struct beam *b,
		 const struct block *n, struct meeting *m, int any)
{
	if (a->fast) {
		beam_meet_fast(a, b, n, m, any);
		return;
	}
#if ISA_LEVEL >= 2
	if (line) {
		lone_meet(a, line, b, n, m, any);
		return;
	}
#endif
	(void)line;
	beam_meet(a, s, q, b, n, m, any);
}

/* From the root to where nothing is left to be seen. */
V void solo_on(const ald_accel *a, const struct batch *s, struct asked *q, ald_query *query, const struct line *line,
	       const struct slopes *p, struct beam *b, int any)
{
	const size_t other = sizeof(a->node->plane[0]), x = (p->down & 1) * other;
	const size_t y = (2 + (p->down >> 1 & 1)) * other, z = (4 + (p->down >> 2 & 1)) * other;
	f8 tfar = f8_all(b->tfar);
	uint32_t ref = a->root, top = 1;

	for (;;) {
		while (ref < REF_LEAF) {
			const struct node *n = &a->node[ref];
			const char *at = (const char *)n;
			f8 t0 = f8_mul_add(f8_load((const float *)(at + x)), p->ix, p->nx);
			f8 y0 = f8_mul_add(f8_load((const float *)(at + y)), p->iy, p->ny);
			f8 z0 = f8_mul_add(f8_load((const float *)(at + z)), p->iz, p->nz);
			f8 t1 = f8_mul_add(f8_load((const float *)(at + (x ^ other))), p->ix, p->fx);
			f8 y1 = f8_mul_add(f8_load((const float *)(at + (y ^ other))), p->iy, p->fy);
			f8 z1 = f8_mul_add(f8_load((const float *)(at + (z ^ other))), p->iz, p->fz);
			float enter[WIDTH] __attribute__((aligned(32)));
			uint32_t in, i, j;

			t0 = f8_max(f8_max(t0, y0), f8_max(z0, f8_all(0)));
			t1 = f8_min(f8_min(t1, y1), f8_min(z1, tfar));
			in = f8_le(t0, t1);
			if (!in)
				goto pop;
			i = (uint32_t)__builtin_ctz(in);
			in &= in - 1;
			if (!in) {
				ref = child_guessed(n, i);
				continue;
			}
			j = (uint32_t)__builtin_ctz(in);
			in &= in - 1;
			if (!in) {
				uint32_t first, second;

				f8_store(enter, t0);
				first = enter[j] < enter[i] ? j : i;
				second = first ^ i ^ j;
				b->enter[top] = enter[second];
				b->below[top] = n->child[second];
				top++;
				ref = child_guessed(n, first);
				continue;
			}
#if ISA_LEVEL >= 2
			top += f8_ordered(t0, t1, n->order[b->way], n->child, b->enter + top, b->below + top);
#else
			top += f8_order(t0, t1, n->child, b->enter + top, b->below + top);
#endif
			ref = b->below[--top];
		}
		b->ref = ref;
		b->top = top;
		if (ref >= REF_OTHERS) {
			if (ref == DONE)
				return;
			beam_others(a, query, b, any);
		} else {
			const struct block *n = &a->block[ref & REF_INDEX];
			const struct block *end = n + (ref >> REF_SHIFT & 7) + 1;

			for (; n < end; n++) {
				struct meeting m;

				block_meet(a, &b->aim, n, b->ray, &m, line && !any ? MEET_FETCHED : MEET_EARLY);
				if (!m.maybe)
					continue;
				solo_meet(a, s, q, line, b, n, &m, any);
				if (any && b->found)
					return;
			}
		}
		if (any && b->found)
			return;
		tfar = f8_all(b->tfar);
pop:
		do
			top--;
		while (b->enter[top] > b->tfar);
		ref = b->below[top];
	}
}

/* To its end. */
V void solo_walk(const ald_accel *a, const struct batch *s, struct asked *asked, ald_query *q, struct beam *b, int any)
{
	const struct slopes p = slopes_of(b);

	solo_on(a, s, asked, q, NULL, &p, b, any);
	beam_end(a, s, asked, b, any);
}

#if ISA_LEVEL >= 2
V f8 f8_lane(f4 a, int k)
{
	return _mm256_permutevar8x32_ps(_mm256_castps128_ps256(a), _mm256_set1_epi32(k));
}

V struct slopes slopes_lone(const struct path *p)
{
	return (struct slopes){ f8_lane(p->inverse, 0), f8_lane(p->inverse, 1), f8_lane(p->inverse, 2),
				f8_lane(p->near_o, 0),	f8_lane(p->near_o, 1),	f8_lane(p->near_o, 2),
				f8_lane(p->far_o, 0),	f8_lane(p->far_o, 1),	f8_lane(p->far_o, 2),
				p->down };
}

/* A ray from the call to the answer. If any will do, hit tells the ray's tmax; what counts is returned, whether it is
 * hit. */
V uint32_t lone_serve(const ald_accel *a, ald_query *q, const ald_ray *r, ald_hit *hit, int any)
{
	struct slopes slopes;
	struct path path;
	struct line line;
	struct beam b;
	enum lone is = lone_begin(a, r, hit->t, &line, &path, &b);

	if (is == LONE_MISSES)
		return 0;
	if (is == LONE_ODD)
		return beam_odd(a, q, r, hit, any) != 0;
	b.hit = hit;
	b.found = b.pending = b.asked = 0;
	b.ray = r;
	b.way = ORDER_TURNED ^ path.down;
	b.enter[0] = -INFINITY;
	b.below[0] = DONE;
	slopes = slopes_lone(&path);
	lone_aim(&line, &b);
	solo_on(a, NULL, NULL, q, &line, &slopes, &b, any);
	if (any || !a->frame.exact || !beam_certain(&b))
		lone_settle(a, &line, &b, any);
	return b.found;
}

static __attribute__((noinline)) void lone_nearest(const ald_accel *a, ald_query *q, const ald_ray *r, ald_hit *hit)
{
	lone_serve(a, q, r, hit, 0);
}

static __attribute__((noinline)) uint32_t lone_occluded(const ald_accel *a, ald_query *q, const ald_ray *r)
{
	ald_hit own = { .t = r->tmax, .prim = ALD_NONE };

	return lone_serve(a, q, r, &own, 1);
}

V void serve_lone(const ald_accel *a, ald_query *q, const struct batch *s, int any)
{
	for (uint32_t i = 0; i < s->n; i++) {
		if (any)
			s->hidden[i] = (uint8_t)lone_occluded(a, q, &s->ray[i]);
		else
			lone_nearest(a, q, &s->ray[i], &s->hit[i]);
	}
}
#endif

#endif
