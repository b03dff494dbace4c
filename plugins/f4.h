/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * f4: four floats, as SSE and NEON have them, and compilers everywhere; + - * / of two are what they say. To be
 * included by one file for each instruction set, after ISA_LEVEL: 0 what every processor of the kind has (on aarch64
 * NEON), 1 SSE4.2, 2 AVX2 with FMA, 3 AVX-512VL. f4_mul_add() and its like round once where they can.
 */
#ifndef F4_H
#define F4_H

#include <stdint.h>

#if defined __SSE2__
#include <immintrin.h>
#elif defined __aarch64__
#include <arm_neon.h>
#endif

#define V static inline __attribute__((always_inline, unused))

typedef float f4 __attribute__((vector_size(16)));
typedef int32_t i4 __attribute__((vector_size(16))); /* a lane that is -1 is true, 0 false */

/* At multiples of 16 bytes. */
V f4 f4_load(const float *p) { return *(const f4 *)(const void *)p; }
V void f4_store(float *p, f4 a) { *(f4 *)(void *)p = a; }
V f4 f4_all(float x) { return (f4){ x, x, x, x }; }
V f4 f4_where(i4 in, f4 a, f4 b) { return (f4)((in & (i4)a) | (~in & (i4)b)); }
V f4 f4_add(f4 a, f4 b) { return a + b; }
V f4 f4_sub(f4 a, f4 b) { return a - b; }
V f4 f4_mul(f4 a, f4 b) { return a * b; }
V f4 f4_div(f4 a, f4 b) { return a / b; }
V f4 f4_negate(f4 a) { return -a; }
V f4 f4_size(f4 a) { return (f4)((i4)a & 0x7fffffff); }
/* a >= 0 with the sign of b */
V f4 f4_signed(f4 a, f4 b) { return (f4)((i4)a | ((i4)b & INT32_MIN)); }

/* Of two zeros, or with a NaN, b. */
#if defined __SSE2__
V f4 f4_min(f4 a, f4 b) { return _mm_min_ps(a, b); }
V f4 f4_max(f4 a, f4 b) { return _mm_max_ps(a, b); }
V uint32_t i4_bits(i4 in) { return (uint32_t)_mm_movemask_ps((f4)in); }
#else
V f4 f4_min(f4 a, f4 b) { return f4_where(a < b, a, b); }
V f4 f4_max(f4 a, f4 b) { return f4_where(a > b, a, b); }
V uint32_t i4_bits(i4 in)
{
	i4 x = in & (i4){ 1, 2, 4, 8 };

#if defined __aarch64__
	return (uint32_t)vaddvq_s32(x);
#else
	return (uint32_t)(x[0] | x[1] | x[2] | x[3]);
#endif
}
#endif

V uint32_t f4_le(f4 a, f4 b) { return i4_bits(a <= b); }
V uint32_t f4_more(f4 a, f4 b) { return i4_bits(a > b); }

/* a b + c, a b - c, c - a b */
#if ISA_LEVEL >= 2
V f4 f4_mul_add(f4 a, f4 b, f4 c) { return _mm_fmadd_ps(a, b, c); }
V f4 f4_mul_sub(f4 a, f4 b, f4 c) { return _mm_fmsub_ps(a, b, c); }
V f4 f4_sub_mul(f4 c, f4 a, f4 b) { return _mm_fnmadd_ps(a, b, c); }
#elif defined __aarch64__
V f4 f4_mul_add(f4 a, f4 b, f4 c) { return vfmaq_f32(c, a, b); }
V f4 f4_mul_sub(f4 a, f4 b, f4 c) { return vfmaq_f32(-c, a, b); }
V f4 f4_sub_mul(f4 c, f4 a, f4 b) { return vfmsq_f32(c, a, b); }
#else
V f4 f4_mul_add(f4 a, f4 b, f4 c) { return a * b + c; }
V f4 f4_mul_sub(f4 a, f4 b, f4 c) { return a * b - c; }
V f4 f4_sub_mul(f4 c, f4 a, f4 b) { return c - a * b; }
#endif

#endif
