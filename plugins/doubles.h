/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Vectors of doubles, dv: DW lanes, as many as the instruction set has. To be included by one file for each set,
 * after ISA_LEVEL (see f4.h). Each operation is the one of IEEE 754, so that what alidade/kernel.h says in scalars
 * can be said in them with the same bits; dv_mul_sub() and dv_sub_mul() apart, which round once where they can, for
 * tests that only reject. min and max are ald_min() and ald_max(): of two zeros, or with a NaN, the second.
 */
#ifndef DOUBLES_H
#define DOUBLES_H

#include <alidade/kernel.h>

#include "isa.h"

#if defined __SSE2__
#include <immintrin.h>
#endif

#define V static inline __attribute__((always_inline, unused))

#define D2(name, ...) \
	V dv dv_##name(dv a, dv b) { return __VA_ARGS__; }
#define M2(name, ...) \
	V dm dm_##name(dm a, dm b) { return __VA_ARGS__; }

#if ISA_LEVEL >= 3
#define DW 8u
typedef __m512d dv;
typedef __mmask8 dm;

V dv dv_load(const double *p) { return _mm512_loadu_pd(p); }
V void dv_store(double *p, dv a) { _mm512_storeu_pd(p, a); }
V dv dv_all(double x) { return _mm512_set1_pd(x); }
D2(add, _mm512_add_pd(a, b))
D2(sub, _mm512_sub_pd(a, b))
D2(mul, _mm512_mul_pd(a, b))
D2(div, _mm512_div_pd(a, b))
D2(min, _mm512_min_pd(a, b))
D2(max, _mm512_max_pd(a, b))
V dv dv_mul_sub(dv a, dv b, dv c) { return _mm512_fmsub_pd(a, b, c); }
V dv dv_sub_mul(dv c, dv a, dv b) { return _mm512_fnmadd_pd(a, b, c); }
V dv dv_size(dv a) { return _mm512_abs_pd(a); }
V dm dv_gt(dv a, dv b) { return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ); }
V dm dv_sign(dv a) { return _mm512_cmplt_epi64_mask(_mm512_castpd_si512(a), _mm512_setzero_si512()); }
V dv dv_pick(dm m, dv a, dv b) { return _mm512_mask_blend_pd(m, b, a); }
V dv dv_power(dv a)
{
	return _mm512_castsi512_pd(_mm512_and_si512(_mm512_castpd_si512(a), _mm512_set1_epi64(0x7ffll << 52)));
}
/* a > 0 brought to [1/2, 1) by a power of two. */
V dv dv_half(dv a)
{
	return _mm512_or_pd(_mm512_and_pd(a, _mm512_castsi512_pd(_mm512_set1_epi64((1ll << 52) - 1))), dv_all(0.5));
}
V void dv_single(float *p, dv a) { _mm256_storeu_ps(p, _mm512_cvtpd_ps(a)); }
M2(and, (dm)(a & b))
M2(or, (dm)(a | b))
M2(less, (dm)(a & ~b))
V uint32_t dm_bits(dm a) { return a; }
#elif ISA_LEVEL == 2
#define DW 4u
typedef __m256d dv;
typedef __m256d dm;

V dv dv_load(const double *p) { return _mm256_loadu_pd(p); }
V void dv_store(double *p, dv a) { _mm256_storeu_pd(p, a); }
V dv dv_all(double x) { return _mm256_set1_pd(x); }
D2(add, _mm256_add_pd(a, b))
D2(sub, _mm256_sub_pd(a, b))
D2(mul, _mm256_mul_pd(a, b))
D2(div, _mm256_div_pd(a, b))
D2(min, _mm256_min_pd(a, b))
D2(max, _mm256_max_pd(a, b))
V dv dv_mul_sub(dv a, dv b, dv c) { return _mm256_fmsub_pd(a, b, c); }
V dv dv_sub_mul(dv c, dv a, dv b) { return _mm256_fnmadd_pd(a, b, c); }
V dv dv_size(dv a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
V dm dv_gt(dv a, dv b) { return _mm256_cmp_pd(a, b, _CMP_GT_OQ); }
V dm dv_sign(dv a) { return a; }
V dv dv_pick(dm m, dv a, dv b) { return _mm256_blendv_pd(b, a, m); }
V dv dv_power(dv a) { return _mm256_and_pd(a, _mm256_castsi256_pd(_mm256_set1_epi64x(0x7ffll << 52))); }
V dv dv_half(dv a)
{
	return _mm256_or_pd(_mm256_and_pd(a, _mm256_castsi256_pd(_mm256_set1_epi64x((1ll << 52) - 1))), dv_all(0.5));
}
V void dv_single(float *p, dv a) { _mm_storeu_ps(p, _mm256_cvtpd_ps(a)); }
M2(and, _mm256_and_pd(a, b))
M2(or, _mm256_or_pd(a, b))
M2(less, _mm256_andnot_pd(b, a))
V uint32_t dm_bits(dm a) { return (uint32_t)_mm256_movemask_pd(a); }
#else
#define DW 2u
typedef double dv __attribute__((vector_size(16)));
typedef int64_t dm __attribute__((vector_size(16)));

V dv dv_load(const double *p) { return (dv){ p[0], p[1] }; }
V void dv_store(double *p, dv a) { memcpy(p, &a, sizeof(a)); }
V dv dv_all(double x) { return (dv){ x, x }; }
V dv dv_pick(dm m, dv a, dv b) { return (dv)((m & (dm)a) | (~m & (dm)b)); }
D2(add, a + b)
D2(sub, a - b)
D2(mul, a *b)
D2(div, a / b)
#if defined __SSE2__
D2(min, _mm_min_pd(a, b))
D2(max, _mm_max_pd(a, b))
V void dv_single(float *p, dv a) { _mm_storel_pi((__m64 *)p, _mm_cvtpd_ps(a)); }
V uint32_t dm_bits(dm a) { return (uint32_t)_mm_movemask_pd((dv)a); }
#else
D2(min, dv_pick(a < b, a, b))
D2(max, dv_pick(a > b, a, b))
V void dv_single(float *p, dv a) { p[0] = (float)a[0], p[1] = (float)a[1]; }
V uint32_t dm_bits(dm a) { return (uint32_t)(-a[0] - 2 * a[1]); }
#endif
V dv dv_mul_sub(dv a, dv b, dv c) { return a * b - c; }
V dv dv_sub_mul(dv c, dv a, dv b) { return c - a * b; }
V dv dv_size(dv a) { return (dv)((dm)a & INT64_MAX); }
V dm dv_gt(dv a, dv b) { return a > b; }
V dm dv_sign(dv a) { return (dm)a < 0; }
V dv dv_power(dv a) { return (dv)((dm)a & 0x7ffll << 52); }
V dv dv_half(dv a) { return (dv)(((dm)a & ((1ll << 52) - 1)) | 0x3fell << 52); }
M2(and, a &b)
M2(or, a | b)
M2(less, a & ~b)
#endif

#undef D2
#undef M2

/* x[k] from the k-th of eight doubles that stand at each of DW places. */
V void dv_columns(const double *const p[], dv x[8])
{
#if ISA_LEVEL >= 3
	dv r[8], s[8];

	UNROLL
	for (unsigned i = 0; i < 8; i++)
		r[i] = _mm512_loadu_pd(p[i]);
	UNROLL
	for (unsigned i = 0; i < 8; i += 2) {
		s[i] = _mm512_unpacklo_pd(r[i], r[i + 1]);
		s[i + 1] = _mm512_unpackhi_pd(r[i], r[i + 1]);
	}
	UNROLL
	for (unsigned i = 0; i < 2; i++) { /* 2 x 2 blocks in 128 bits each */
		r[i] = _mm512_shuffle_f64x2(s[i], s[i + 2], 0x88);
		r[i + 2] = _mm512_shuffle_f64x2(s[i], s[i + 2], 0xdd);
		r[i + 4] = _mm512_shuffle_f64x2(s[i + 4], s[i + 6], 0x88);
		r[i + 6] = _mm512_shuffle_f64x2(s[i + 4], s[i + 6], 0xdd);
	}
	UNROLL
	for (unsigned i = 0; i < 2; i++) {
		x[i] = _mm512_shuffle_f64x2(r[i], r[i + 4], 0x88);
		x[i + 4] = _mm512_shuffle_f64x2(r[i], r[i + 4], 0xdd);
		x[i + 2] = _mm512_shuffle_f64x2(r[i + 2], r[i + 6], 0x88);
		x[i + 6] = _mm512_shuffle_f64x2(r[i + 2], r[i + 6], 0xdd);
	}
#elif ISA_LEVEL == 2
	UNROLL
	for (unsigned h = 0; h < 8; h += 4) {
		dv a = dv_load(p[0] + h), b = dv_load(p[1] + h), c = dv_load(p[2] + h), d = dv_load(p[3] + h);
		dv ab0 = _mm256_unpacklo_pd(a, b), ab1 = _mm256_unpackhi_pd(a, b);
		dv cd0 = _mm256_unpacklo_pd(c, d), cd1 = _mm256_unpackhi_pd(c, d);

		x[h] = _mm256_permute2f128_pd(ab0, cd0, 0x20);
		x[h + 1] = _mm256_permute2f128_pd(ab1, cd1, 0x20);
		x[h + 2] = _mm256_permute2f128_pd(ab0, cd0, 0x31);
		x[h + 3] = _mm256_permute2f128_pd(ab1, cd1, 0x31);
	}
#else
	UNROLL
	for (unsigned k = 0; k < 8; k++) {
		double lane[DW];

		UNROLL
		for (unsigned i = 0; i < DW; i++)
			lane[i] = p[i][k];
		x[k] = dv_load(lane);
	}
#endif
}

#endif
