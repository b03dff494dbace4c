/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * alidade/lanes.h - how wide the n-wide forms are, and what plain loops over lanes end in: a bit for each.
 *
 * Included by alidade/kernel.h, which is what plugins include. Compilers don't find a move of masks by themselves.
 */
#ifndef ALIDADE_LANES_H
#define ALIDADE_LANES_H

#include "exact.h"

#ifdef __AVX2__
#include <immintrin.h>
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define ALD_LANES 8u /* of the n-wide forms */

/* Of lanes that are 0 or 1: a bit for each. */
ALD_INLINE uint32_t ald_lane_bits(const int64_t in[ALD_LANES])
{
#if defined __AVX512F__
	__m512i x = _mm512_loadu_si512(in);

	return _mm512_test_epi64_mask(x, x);
#elif defined __AVX2__
	__m256i x = _mm256_loadu_si256((const __m256i_u *)in), y = _mm256_loadu_si256((const __m256i_u *)(in + 4));

	x = _mm256_slli_epi64(x, 63);
	y = _mm256_slli_epi64(y, 63);
	return (uint32_t)(_mm256_movemask_pd(_mm256_castsi256_pd(x)) | _mm256_movemask_pd(_mm256_castsi256_pd(y)) << 4);
#else
	uint32_t bits = 0;

	for (unsigned i = 0; i < ALD_LANES; i++)
		bits |= (uint32_t)in[i] << i;
	return bits;
#endif
}

ALD_INLINE uint32_t ald_lane_bits_single(const int32_t in[ALD_LANES])
{
#if defined __AVX2__
	__m256i x = _mm256_slli_epi32(_mm256_loadu_si256((const __m256i_u *)in), 31);

	return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(x));
#else
	uint32_t bits = 0;

	for (unsigned i = 0; i < ALD_LANES; i++)
		bits |= (uint32_t)in[i] << i;
	return bits;
#endif
}

#ifdef __cplusplus
}
#endif
#endif
