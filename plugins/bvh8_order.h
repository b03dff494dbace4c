/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The order in which rays mostly enter a node's children, for each of the eight ways that the signs of a direction
 * may be: by the middles of their boxes. With it a ray has nothing to sort (after Ylitie, Karras, Laine: Efficient
 * Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, 2017, who place children so that one order does).
 * No answer depends on it.
 */
#ifndef BVH8_ORDER_H
#define BVH8_ORDER_H

#include "bvh8_vec.h"

#if ISA_LEVEL >= 2
/* How many lanes hold more, or as much and stand earlier. */
V __m256i ranks_of(f8 key)
{
	const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
	__m256i rank = _mm256_setzero_si256();

	UNROLL
	for (int i = 1; i < 8; i++) {
		__m256i at = _mm256_and_si256(_mm256_add_epi32(lane, _mm256_set1_epi32(i)), _mm256_set1_epi32(7));
		f8 x = _mm256_permutevar8x32_ps(key, at);
		f8 more = _mm256_cmp_ps(x, key, _CMP_GT_OQ), same = _mm256_cmp_ps(x, key, _CMP_EQ_OQ);
		__m256i early = _mm256_cmpgt_epi32(lane, at);

		early = _mm256_and_si256(early, _mm256_castps_si256(same));
		rank = _mm256_sub_epi32(rank, _mm256_or_si256(early, _mm256_castps_si256(more)));
	}
	return rank;
}

/* Each lane's number where its rank says, three bits each. */
V uint32_t order_of(__m256i rank)
{
	const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
	__m256i x = _mm256_sllv_epi32(lane, _mm256_add_epi32(rank, _mm256_add_epi32(rank, rank)));
	__m128i y = _mm_or_si128(_mm256_castsi256_si128(x), _mm256_extracti128_si256(x, 1));

	y = _mm_or_si128(y, _mm_shuffle_epi32(y, 0x4e));
	return (uint32_t)_mm_cvtsi128_si32(_mm_or_si128(y, _mm_shuffle_epi32(y, 0xb1)));
}

static void order_nodes(struct node *n, uint32_t count)
{
	for (const struct node *end = n + count; n < end; n++) {
		const __m256i kids = _mm256_load_si256((const __m256i *)n->child);
		const f8 none = _mm256_castsi256_ps(_mm256_cmpeq_epi32(kids, _mm256_set1_epi32(-1)));
		f8 x = f8_add(f8_load(n->plane[0]), f8_load(n->plane[1]));
		f8 y = f8_add(f8_load(n->plane[2]), f8_load(n->plane[3]));
		f8 z = f8_add(f8_load(n->plane[4]), f8_load(n->plane[5]));

		UNROLL
		for (unsigned i = 0; i < 4; i++) {
			f8 key = f8_add(x, f8_add(i & 1 ? f8_negate(y) : y, i & 2 ? f8_negate(z) : z));
			__m256i rank = ranks_of(_mm256_blendv_ps(key, _mm256_set1_ps(INFINITY), none));

			n->order[2 * i] = order_of(rank);
			n->order[7 - 2 * i] = order_of(_mm256_sub_epi32(_mm256_set1_epi32(7), rank));
		}
	}
}
#endif

#endif
