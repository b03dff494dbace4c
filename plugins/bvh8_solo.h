/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A ray of bvh8's that goes alone, to its end: what nodes want to know of it stays in registers, and a processor that
 * guesses branches goes on into the next node before it knows that it was right. Most nodes are left through one child
 * or two; nothing is sorted there.
 */
#ifndef BVH8_SOLO_H
#define BVH8_SOLO_H

#include "bvh8_beam.h"

/* From the root to where nothing is left to be seen. */
V void solo_on(const ald_accel *a, const struct batch *s, struct asked *q, ald_query *query, struct beam *b, int any)
{
	const f8 ix = f8_all(b->inverse[0]), iy = f8_all(b->inverse[1]), iz = f8_all(b->inverse[2]);
	const f8 nx = f8_all(b->near_o[0]), ny = f8_all(b->near_o[1]), nz = f8_all(b->near_o[2]);
	const f8 fx = f8_all(b->far_o[0]), fy = f8_all(b->far_o[1]), fz = f8_all(b->far_o[2]);
	const size_t x = b->near[0] * sizeof(a->node->plane[0]), y = b->near[1] * sizeof(a->node->plane[0]);
	const size_t z = b->near[2] * sizeof(a->node->plane[0]), other = sizeof(a->node->plane[0]);
	f8 tfar = f8_all(b->tfar);
	uint32_t ref = a->root, top = 1;

	for (;;) {
		while (ref < REF_LEAF) {
			const struct node *n = &a->node[ref];
			const char *p = (const char *)n;
			f8 t0 = f8_mul_add(f8_load((const float *)(p + x)), ix, nx);
			f8 y0 = f8_mul_add(f8_load((const float *)(p + y)), iy, ny);
			f8 z0 = f8_mul_add(f8_load((const float *)(p + z)), iz, nz);
			f8 t1 = f8_mul_add(f8_load((const float *)(p + (x ^ other))), ix, fx);
			f8 y1 = f8_mul_add(f8_load((const float *)(p + (y ^ other))), iy, fy);
			f8 z1 = f8_mul_add(f8_load((const float *)(p + (z ^ other))), iz, fz);
			float enter[WIDTH] __attribute__((aligned(32)));
			uint32_t in, i, j;

			t0 = f8_max(f8_max(t0, y0), f8_max(z0, f8_all(0)));
			t1 = f8_min(f8_min(t1, y1), f8_min(z1, tfar));
			in = f8_le(t0, t1);
			if (!in)
				goto pop;
			i = (uint32_t)__builtin_ctz(in);
			in &= in - 1;
			ref = n->child[i];
			if (!in)
				continue;
			j = (uint32_t)__builtin_ctz(in);
			in &= in - 1;
			if (!in) {
				uint32_t second = n->child[j], swap;

				f8_store(enter, t0);
				swap = enter[j] < enter[i];
				b->enter[top] = swap ? enter[i] : enter[j];
				b->below[top] = swap ? ref : second;
				ref = swap ? second : ref;
				top++;
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

				block_meet(a, &b->aim, n, b->ray, &m, 1);
				if (!m.maybe)
					continue;
				if (a->fast)
					beam_meet_fast(a, b, n, &m, any);
				else
					beam_meet(a, s, q, b, n, &m, any);
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
	solo_on(a, s, asked, q, b, any);
	beam_end(a, s, asked, b, any);
}

#endif
