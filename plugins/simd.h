/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Vectors as wide as an instruction set has them. To be included by one file for each set, after ISA_LEVEL (see
 * f4.h). What is computed with them may differ in its last bit (an
 * fma rounds once): it only ever rejects.
 */
#ifndef SIMD_H
#define SIMD_H

#include "f4.h"

#if ISA_LEVEL >= 3
#define LANES 16u
#elif ISA_LEVEL == 2
#define LANES 8u
#else
#define LANES 4u
#endif
#define ALL_LANES ((1u << LANES) - 1)

/* + - * of two are what they say. */
typedef float wide __attribute__((vector_size(4 * LANES)));

#if ISA_LEVEL >= 3
V wide wide_load(const float *p) { return _mm512_load_ps(p); }
V void wide_store(float *p, wide a) { _mm512_store_ps(p, a); }
V wide wide_all(float x) { return _mm512_set1_ps(x); }
V wide wide_mul_add(wide a, wide b, wide c) { return _mm512_fmadd_ps(a, b, c); }
V wide wide_sub_mul(wide c, wide a, wide b) { return _mm512_fnmadd_ps(a, b, c); } /* c - a b */
V wide wide_min(wide a, wide b) { return _mm512_min_ps(a, b); }
V wide wide_max(wide a, wide b) { return _mm512_max_ps(a, b); }
V wide wide_size(wide a) { return _mm512_abs_ps(a); }
V uint32_t wide_more(wide a, wide b) { return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ); } /* a > b */
/* low < below and high > above */
V uint32_t wide_outside(wide low, wide below, wide high, wide above)
{
	return _mm512_mask_cmp_ps_mask(_mm512_cmp_ps_mask(low, below, _CMP_LT_OQ), high, above, _CMP_GT_OQ);
}
#elif ISA_LEVEL == 2
V wide wide_load(const float *p) { return _mm256_load_ps(p); }
V void wide_store(float *p, wide a) { _mm256_store_ps(p, a); }
V wide wide_all(float x) { return _mm256_set1_ps(x); }
V wide wide_mul_add(wide a, wide b, wide c) { return _mm256_fmadd_ps(a, b, c); }
V wide wide_sub_mul(wide c, wide a, wide b) { return _mm256_fnmadd_ps(a, b, c); }
V wide wide_min(wide a, wide b) { return _mm256_min_ps(a, b); }
V wide wide_max(wide a, wide b) { return _mm256_max_ps(a, b); }
V wide wide_size(wide a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }
V uint32_t wide_more(wide a, wide b) { return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_GT_OQ)); }
V uint32_t wide_outside(wide low, wide below, wide high, wide above)
{
	return (uint32_t)_mm256_movemask_ps(_mm256_and_ps(_mm256_cmp_ps(low, below, _CMP_LT_OQ),
							  _mm256_cmp_ps(high, above, _CMP_GT_OQ)));
}
#else
V wide wide_load(const float *p) { return f4_load(p); }
V void wide_store(float *p, wide a) { f4_store(p, a); }
V wide wide_all(float x) { return f4_all(x); }
V wide wide_mul_add(wide a, wide b, wide c) { return f4_mul_add(a, b, c); }
V wide wide_sub_mul(wide c, wide a, wide b) { return f4_sub_mul(c, a, b); }
V wide wide_min(wide a, wide b) { return f4_min(a, b); }
V wide wide_max(wide a, wide b) { return f4_max(a, b); }
V wide wide_size(wide a) { return f4_size(a); }
V uint32_t wide_more(wide a, wide b) { return f4_more(a, b); }
V uint32_t wide_outside(wide low, wide below, wide high, wide above)
{
	return i4_bits((low < below) & (high > above));
}
#endif

#endif
