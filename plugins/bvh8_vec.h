/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's vectors: f8 for the children of a node, f4 for the triangles of a block. To be included by one
 * file for each instruction set, after ISA_LEVEL: 0 plain C, 1 SSE4.2, 2 AVX2 with FMA, 3 AVX-512VL.
 * What is computed with them may differ in its last bit (an fma rounds once): it only ever rejects.
 */
#ifndef BVH8_VEC_H
#define BVH8_VEC_H

#include <stdint.h>

#if ISA_LEVEL > 0
#include <immintrin.h>
#endif

#define V static inline __attribute__((always_inline, unused))

#if ISA_LEVEL > 0
typedef __m128 f4;

V f4 f4_load(const float *p) { return _mm_load_ps(p); }
V f4 f4_all(float x) { return _mm_set1_ps(x); }
V f4 f4_sub(f4 a, f4 b) { return _mm_sub_ps(a, b); }
V f4 f4_mul(f4 a, f4 b) { return _mm_mul_ps(a, b); }
V f4 f4_min(f4 a, f4 b) { return _mm_min_ps(a, b); }
V f4 f4_max(f4 a, f4 b) { return _mm_max_ps(a, b); }
V f4 f4_negate(f4 a) { return _mm_xor_ps(a, _mm_set1_ps(-0.0f)); }
V f4 f4_size(f4 a) { return _mm_andnot_ps(_mm_set1_ps(-0.0f), a); }
V f4 f4_add(f4 a, f4 b) { return _mm_add_ps(a, b); }
V f4 f4_div(f4 a, f4 b) { return _mm_div_ps(a, b); }
V void f4_store(float *p, f4 a) { _mm_store_ps(p, a); }
V uint32_t f4_le(f4 a, f4 b) { return (uint32_t)_mm_movemask_ps(_mm_cmple_ps(a, b)); }
#else
typedef struct {
	float x[4];
} f4;

#define EACH4 for (unsigned i = 0; i < 4; i++)

V f4 f4_load(const float *p)
{
	f4 r;

	EACH4 r.x[i] = p[i];
	return r;
}

V f4 f4_all(float x)
{
	return (f4){ { x, x, x, x } };
}

V f4 f4_sub(f4 a, f4 b)
{
	EACH4 a.x[i] -= b.x[i];
	return a;
}

V f4 f4_mul(f4 a, f4 b)
{
	EACH4 a.x[i] *= b.x[i];
	return a;
}

V f4 f4_min(f4 a, f4 b)
{
	EACH4 a.x[i] = a.x[i] < b.x[i] ? a.x[i] : b.x[i];
	return a;
}

V f4 f4_max(f4 a, f4 b)
{
	EACH4 a.x[i] = a.x[i] > b.x[i] ? a.x[i] : b.x[i];
	return a;
}

V f4 f4_negate(f4 a)
{
	EACH4 a.x[i] = -a.x[i];
	return a;
}

V f4 f4_size(f4 a)
{
	EACH4 a.x[i] = a.x[i] < 0 ? -a.x[i] : a.x[i];
	return a;
}

V f4 f4_add(f4 a, f4 b)
{
	EACH4 a.x[i] += b.x[i];
	return a;
}

V f4 f4_div(f4 a, f4 b)
{
	EACH4 a.x[i] /= b.x[i];
	return a;
}

V void f4_store(float *p, f4 a)
{
	EACH4 p[i] = a.x[i];
}

V uint32_t f4_le(f4 a, f4 b)
{
	uint32_t bits = 0;

	EACH4 bits |= (uint32_t)(a.x[i] <= b.x[i]) << i;
	return bits;
}
#endif

#if ISA_LEVEL >= 2
V f4 f4_mul_add(f4 a, f4 b, f4 c) { return _mm_fmadd_ps(a, b, c); }
V f4 f4_mul_sub(f4 a, f4 b, f4 c) { return _mm_fmsub_ps(a, b, c); }
V f4 f4_sub_mul(f4 c, f4 a, f4 b) { return _mm_fnmadd_ps(a, b, c); } /* c - a b */
#elif ISA_LEVEL == 1
V f4 f4_mul_add(f4 a, f4 b, f4 c) { return _mm_add_ps(_mm_mul_ps(a, b), c); }
V f4 f4_mul_sub(f4 a, f4 b, f4 c) { return _mm_sub_ps(_mm_mul_ps(a, b), c); }
V f4 f4_sub_mul(f4 c, f4 a, f4 b) { return _mm_sub_ps(c, _mm_mul_ps(a, b)); }
#else
V f4 f4_mul_add(f4 a, f4 b, f4 c)
{
	EACH4 c.x[i] += a.x[i] * b.x[i];
	return c;
}

V f4 f4_mul_sub(f4 a, f4 b, f4 c)
{
	EACH4 c.x[i] = a.x[i] * b.x[i] - c.x[i];
	return c;
}

V f4 f4_sub_mul(f4 c, f4 a, f4 b)
{
	EACH4 c.x[i] -= a.x[i] * b.x[i];
	return c;
}
#endif

#if ISA_LEVEL >= 2
typedef __m256 f8;

V f8 f8_load(const float *p) { return _mm256_load_ps(p); }
V void f8_store(float *p, f8 a) { _mm256_store_ps(p, a); }
V f8 f8_all(float x) { return _mm256_set1_ps(x); }
V f8 f8_mul_add(f8 a, f8 b, f8 c) { return _mm256_fmadd_ps(a, b, c); }
V f8 f8_min(f8 a, f8 b) { return _mm256_min_ps(a, b); }
V f8 f8_max(f8 a, f8 b) { return _mm256_max_ps(a, b); }
#if ISA_LEVEL >= 3
V uint32_t f8_le(f8 a, f8 b) { return _mm256_cmp_ps_mask(a, b, _CMP_LE_OQ); }
#else
V uint32_t f8_le(f8 a, f8 b) { return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)); }
#endif
#elif ISA_LEVEL == 1
typedef struct {
	__m128 a, b;
} f8;

V f8 f8_load(const float *p) { return (f8){ _mm_load_ps(p), _mm_load_ps(p + 4) }; }
V void f8_store(float *p, f8 x) { _mm_store_ps(p, x.a), _mm_store_ps(p + 4, x.b); }
V f8 f8_all(float x) { return (f8){ _mm_set1_ps(x), _mm_set1_ps(x) }; }
V f8 f8_mul_add(f8 x, f8 y, f8 z) { return (f8){ f4_mul_add(x.a, y.a, z.a), f4_mul_add(x.b, y.b, z.b) }; }
V f8 f8_min(f8 x, f8 y) { return (f8){ _mm_min_ps(x.a, y.a), _mm_min_ps(x.b, y.b) }; }
V f8 f8_max(f8 x, f8 y) { return (f8){ _mm_max_ps(x.a, y.a), _mm_max_ps(x.b, y.b) }; }
V uint32_t f8_le(f8 x, f8 y) { return f4_le(x.a, y.a) | f4_le(x.b, y.b) << 4; }
#else
typedef struct {
	float x[8];
} f8;

#define EACH8 for (unsigned i = 0; i < 8; i++)

V f8 f8_load(const float *p)
{
	f8 r;

	EACH8 r.x[i] = p[i];
	return r;
}

V void f8_store(float *p, f8 a)
{
	EACH8 p[i] = a.x[i];
}

V f8 f8_all(float x)
{
	return (f8){ { x, x, x, x, x, x, x, x } };
}

V f8 f8_mul_add(f8 a, f8 b, f8 c)
{
	EACH8 c.x[i] += a.x[i] * b.x[i];
	return c;
}

V f8 f8_min(f8 a, f8 b)
{
	EACH8 a.x[i] = a.x[i] < b.x[i] ? a.x[i] : b.x[i];
	return a;
}

V f8 f8_max(f8 a, f8 b)
{
	EACH8 a.x[i] = a.x[i] > b.x[i] ? a.x[i] : b.x[i];
	return a;
}

V uint32_t f8_le(f8 a, f8 b)
{
	uint32_t bits = 0;

	EACH8 bits |= (uint32_t)(a.x[i] <= b.x[i]) << i;
	return bits;
}
#endif

#endif
