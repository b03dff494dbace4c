/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's vectors: f8 for the children of a node, f4 for the triangles of a block. To be included by one
 * file for each instruction set, after ISA_LEVEL (see f4.h).
 * What is computed with them may differ in its last bit (an fma rounds once): it only ever rejects.
 */
#ifndef BVH8_VEC_H
#define BVH8_VEC_H

#include <math.h>
#include <stdint.h>

#include "bvh8.h"
#include "f4.h"

#if ISA_LEVEL >= 2
typedef __m256 f8;

V f8 f8_load(const float *p) { return _mm256_load_ps(p); }
V void f8_store(float *p, f8 a) { _mm256_store_ps(p, a); }
V f8 f8_all(float x) { return _mm256_set1_ps(x); }
V f8 f8_mul_add(f8 a, f8 b, f8 c) { return _mm256_fmadd_ps(a, b, c); }
V f8 f8_min(f8 a, f8 b) { return _mm256_min_ps(a, b); }
V f8 f8_max(f8 a, f8 b) { return _mm256_max_ps(a, b); }
V f8 f8_add(f8 a, f8 b) { return _mm256_add_ps(a, b); }
V f8 f8_sub(f8 a, f8 b) { return _mm256_sub_ps(a, b); }
V f8 f8_mul(f8 a, f8 b) { return _mm256_mul_ps(a, b); }
V f8 f8_negate(f8 a) { return _mm256_xor_ps(a, _mm256_set1_ps(-0.0f)); }
/* a >= 0 with the sign of b */
V f8 f8_signed(f8 a, f8 b) { return _mm256_or_ps(a, _mm256_and_ps(b, _mm256_set1_ps(-0.0f))); }
V uint32_t f8_le(f8 a, f8 b) { return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)); }
#else
typedef struct {
	f4 a, b;
} f8;

V f8 f8_load(const float *p) { return (f8){ f4_load(p), f4_load(p + 4) }; }
V void f8_store(float *p, f8 x) { f4_store(p, x.a), f4_store(p + 4, x.b); }
V f8 f8_all(float x) { return (f8){ f4_all(x), f4_all(x) }; }
V f8 f8_mul_add(f8 x, f8 y, f8 z) { return (f8){ f4_mul_add(x.a, y.a, z.a), f4_mul_add(x.b, y.b, z.b) }; }
V f8 f8_min(f8 x, f8 y) { return (f8){ f4_min(x.a, y.a), f4_min(x.b, y.b) }; }
V f8 f8_max(f8 x, f8 y) { return (f8){ f4_max(x.a, y.a), f4_max(x.b, y.b) }; }
V f8 f8_add(f8 x, f8 y) { return (f8){ x.a + y.a, x.b + y.b }; }
V f8 f8_sub(f8 x, f8 y) { return (f8){ x.a - y.a, x.b - y.b }; }
V f8 f8_mul(f8 x, f8 y) { return (f8){ x.a * y.a, x.b * y.b }; }
V f8 f8_negate(f8 x) { return (f8){ -x.a, -x.b }; }
V f8 f8_signed(f8 x, f8 y) { return (f8){ f4_signed(x.a, y.a), f4_signed(x.b, y.b) }; }
V uint32_t f8_le(f8 x, f8 y) { return f4_le(x.a, y.a) | f4_le(x.b, y.b) << 4; }
#endif

/* The lanes of bits, together at the front; there is room for all. */
#if ISA_LEVEL >= 3
V void f4_pack(float *p, f4 a, uint32_t bits) { _mm_storeu_ps(p, _mm_maskz_compress_ps((__mmask8)bits, a)); }
V f4 f4_pick(uint32_t bits, f4 a, f4 b) { return _mm_mask_blend_ps((__mmask8)bits, b, a); }
#elif ISA_LEVEL > 0
#define LANE(k) 4 * (k), 4 * (k) + 1, 4 * (k) + 2, 4 * (k) + 3
#define LANES(a, b, c, d) { LANE(a), LANE(b), LANE(c), LANE(d) }
static const uint8_t f4_packs[16][16] __attribute__((aligned(16), unused)) = {
	LANES(0, 0, 0, 0), LANES(0, 0, 0, 0), LANES(1, 0, 0, 0), LANES(0, 1, 0, 0),
	LANES(2, 0, 0, 0), LANES(0, 2, 0, 0), LANES(1, 2, 0, 0), LANES(0, 1, 2, 0),
	LANES(3, 0, 0, 0), LANES(0, 3, 0, 0), LANES(1, 3, 0, 0), LANES(0, 1, 3, 0),
	LANES(2, 3, 0, 0), LANES(0, 2, 3, 0), LANES(1, 2, 3, 0), LANES(0, 1, 2, 3),
};
#undef LANE
#undef LANES

V void f4_pack(float *p, f4 a, uint32_t bits)
{
	__m128i order = _mm_load_si128((const __m128i *)f4_packs[bits & 15]);

	_mm_storeu_ps(p, _mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(a), order)));
}

V f4 f4_pick(uint32_t bits, f4 a, f4 b)
{
	const __m128i lane = _mm_setr_epi32(1, 2, 4, 8);
	__m128i m = _mm_and_si128(_mm_set1_epi32((int)bits), lane);

	return _mm_blendv_ps(b, a, _mm_castsi128_ps(_mm_cmpeq_epi32(m, lane)));
}
#else
V void f4_pack(float *p, f4 a, uint32_t bits)
{
	for (bits &= 15; bits; bits &= bits - 1)
		*p++ = a[__builtin_ctz(bits)];
}

V f4 f4_pick(uint32_t bits, f4 a, f4 b)
{
	const i4 lane = { 1, 2, 4, 8 };

	return f4_where(((int32_t)bits & lane) == lane, a, b);
}
#endif

V uint32_t f4_same(const uint32_t *p, uint32_t x) /* where p[] is x */
{
	return i4_bits(*(const i4 *)(const void *)p == (int32_t)x);
}

V float f4_least(f4 a)
{
	a = f4_min(a, (f4){ a[2], a[3], a[0], a[1] });
	return a[0] < a[1] ? a[0] : a[1];
}

/* Children of a node: where and in which order are they entered? Those with from <= to are written farthest
 * first, where each is entered (or a little before) and its reference; there is room for eight at both. How many. */
#if ISA_LEVEL >= 2
#define SORT_PASS(x, other, low)                                                             \
	do {                                                                                 \
		__m256i other_ = (other);                                                    \
		(x) = _mm256_blend_epi32(_mm256_max_epi32(x, other_), _mm256_min_epi32(x, other_), low); \
	} while (0)

/* The low three bits of what is sorted say which lane it was. */
V __m256i f8_sorted(f8 from, f8 to, uint32_t *n)
{
	const __m256i lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), low = _mm256_set1_epi32(7);
	__m256i x = _mm256_or_si256(_mm256_andnot_si256(low, _mm256_castps_si256(from)), lanes);
	__m256 out = _mm256_cmp_ps(from, to, _CMP_NLE_UQ);

	*n = 8 - (uint32_t)__builtin_popcount((unsigned)_mm256_movemask_ps(out));
	x = _mm256_or_si256(x, _mm256_castps_si256(out));
	/* Batcher's network, by whole vectors; distances >= 0 compare as integers do, what is missed is -1. */
	SORT_PASS(x, _mm256_shuffle_epi32(x, 0xb1), 0xaa);
	SORT_PASS(x, _mm256_shuffle_epi32(x, 0x1b), 0xcc);
	SORT_PASS(x, _mm256_shuffle_epi32(x, 0xb1), 0xaa);
	SORT_PASS(x, _mm256_shuffle_epi32(_mm256_permute4x64_epi64(x, 0x4e), 0x1b), 0xf0);
	SORT_PASS(x, _mm256_shuffle_epi32(x, 0x4e), 0xcc);
	SORT_PASS(x, _mm256_shuffle_epi32(x, 0xb1), 0xaa);
	return x;
}

V uint32_t f8_order(f8 from, f8 to, const uint32_t *child, float *enter, uint32_t *ref)
{
	uint32_t n;
	__m256i x = f8_sorted(from, to, &n), kids = _mm256_load_si256((const __m256i *)child);

	_mm256_storeu_si256((__m256i *)ref, _mm256_permutevar8x32_epi32(kids, x));
	_mm256_storeu_si256((__m256i *)enter, _mm256_andnot_si256(_mm256_set1_epi32(7), x));
	return n;
}

/* The same, in an order that is given: three bits a lane, the nearest last, or, where ORDER_TURNED is 7, first. */
#define ORDER_TURNED (ISA_LEVEL >= 3 ? 0u : 7u)

V uint32_t f8_ordered(f8 from, f8 to, uint32_t order, const uint32_t *child, float *enter, uint32_t *ref)
{
	const __m256i by = _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21);
	__m256i at = _mm256_srlv_epi32(_mm256_set1_epi32((int)order), by);
	__m256i kids = _mm256_permutevar8x32_epi32(_mm256_load_si256((const __m256i *)child), at);
	f8 t0 = _mm256_permutevar8x32_ps(from, at), t1 = _mm256_permutevar8x32_ps(to, at);
#if ISA_LEVEL >= 3
	__mmask8 in = _mm256_cmp_ps_mask(t0, t1, _CMP_LE_OQ);

	_mm256_storeu_si256((__m256i *)ref, _mm256_maskz_compress_epi32(in, kids));
	_mm256_storeu_ps(enter, _mm256_maskz_compress_ps(in, t0));
	return (uint32_t)__builtin_popcount(in);
#else
	uint32_t in = f8_le(t0, t1);
	__m256i last = _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)bvh8_lanes[in]));

	_mm256_storeu_si256((__m256i *)ref, _mm256_permutevar8x32_epi32(kids, last));
	_mm256_storeu_ps(enter, _mm256_permutevar8x32_ps(t0, last));
	return (uint32_t)__builtin_popcount(in);
#endif
}

/* Where from <= to, bit too. */
V __m256i f8_mark(__m256i marks, f8 from, f8 to, uint32_t bit)
{
#if ISA_LEVEL >= 3
	__mmask8 in = _mm256_cmp_ps_mask(from, to, _CMP_LE_OQ);

	return _mm256_mask_or_epi32(marks, in, marks, _mm256_set1_epi32((int)bit));
#else
	__m256i in = _mm256_castps_si256(_mm256_cmp_ps(from, to, _CMP_LE_OQ));

	return _mm256_or_si256(marks, _mm256_and_si256(in, _mm256_set1_epi32((int)bit)));
#endif
}

/* The least, of those from that are <= to. */
V f8 f8_first(f8 least, f8 from, f8 to)
{
#if ISA_LEVEL >= 3
	return _mm256_mask_min_ps(least, _mm256_cmp_ps_mask(from, to, _CMP_LE_OQ), least, from);
#else
	f8 in = _mm256_cmp_ps(from, to, _CMP_LE_OQ);

	return _mm256_min_ps(least, _mm256_blendv_ps(_mm256_set1_ps(INFINITY), from, in));
#endif
}

V void f8_put(uint32_t *to, __m256i x, __m256i order)
{
	_mm256_storeu_si256((__m256i *)to, _mm256_permutevar8x32_epi32(x, order));
}

/* Children that have a mark are written, the first one last, with both words of it; there is room for eight.
 * How many. */
V uint32_t f8_keep(__m256i some, __m256i more, const uint32_t *child, uint32_t *some_to, uint32_t *more_to,
		   uint32_t *ref, uint32_t *box)
{
	__m256i none = _mm256_cmpeq_epi32(_mm256_or_si256(some, more), _mm256_setzero_si256());
	uint32_t bits = ~(uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(none)) & 255;
	__m256i order = _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)bvh8_lanes[bits]));

	f8_put(some_to, some, order);
	f8_put(more_to, more, order);
	f8_put(ref, _mm256_load_si256((const __m256i *)child), order);
	_mm256_storeu_si256((__m256i *)box, _mm256_set1_epi32(-1));
	return (uint32_t)__builtin_popcount(bits);
}

/* The same in the order of where they are entered, the nearest last. */
V uint32_t f8_sort(f8 enter, __m256i some, __m256i more, const uint32_t *child, uint32_t *some_to, uint32_t *more_to,
		   uint32_t *ref, uint32_t *box, float *enter_to)
{
	uint32_t n;
	__m256i x = f8_sorted(enter, _mm256_set1_ps(0x1p100f), &n);

	f8_put(some_to, some, x);
	f8_put(more_to, more, x);
	f8_put(ref, _mm256_load_si256((const __m256i *)child), x);
	_mm256_storeu_si256((__m256i *)box, _mm256_set1_epi32(-1));
	_mm256_storeu_si256((__m256i *)enter_to, _mm256_andnot_si256(_mm256_set1_epi32(7), x));
	return n;
}

/* As f8_order(), without the distances; of each its lane, and first, too. */
V uint32_t f8_order_lanes(f8 from, f8 to, const uint32_t *child, uint32_t first, uint32_t *ref, uint32_t *lane)
{
	uint32_t n;
	__m256i x = _mm256_and_si256(f8_sorted(from, to, &n), _mm256_set1_epi32(7));

	f8_put(ref, _mm256_load_si256((const __m256i *)child), x);
	_mm256_storeu_si256((__m256i *)lane, _mm256_add_epi32(x, _mm256_set1_epi32((int)first)));
	return n;
}
#else
#define ORDER_TURNED 0u

V uint32_t f8_order(f8 from, f8 to, const uint32_t *child, float *enter, uint32_t *ref)
{
	float t[8] __attribute__((aligned(32)));
	uint32_t n = 0;

	f8_store(t, from);
	for (uint32_t bits = f8_le(from, to); bits; bits &= bits - 1) {
		unsigned k = (unsigned)__builtin_ctz(bits);
		uint32_t at = n++;

		for (; at > 0 && enter[at - 1] < t[k]; at--) {
			enter[at] = enter[at - 1];
			ref[at] = ref[at - 1];
		}
		enter[at] = t[k];
		ref[at] = child[k];
	}
	return n;
}
#endif

/* ---- f16: a ray of a packet in each lane ---- */

#if ISA_LEVEL >= 3
typedef __m512 f16;

V f16 f16_load(const float *p) { return _mm512_load_ps(p); }
V void f16_store(float *p, f16 a) { _mm512_store_ps(p, a); }
V f16 f16_all(float x) { return _mm512_set1_ps(x); }
V f16 f16_add(f16 a, f16 b) { return _mm512_add_ps(a, b); }
V f16 f16_sub(f16 a, f16 b) { return _mm512_sub_ps(a, b); }
V f16 f16_mul(f16 a, f16 b) { return _mm512_mul_ps(a, b); }
V f16 f16_div(f16 a, f16 b) { return _mm512_div_ps(a, b); }
V f16 f16_min(f16 a, f16 b) { return _mm512_min_ps(a, b); }
V f16 f16_max(f16 a, f16 b) { return _mm512_max_ps(a, b); }
V f16 f16_size(f16 a) { return _mm512_abs_ps(a); }
V f16 f16_mul_add(f16 a, f16 b, f16 c) { return _mm512_fmadd_ps(a, b, c); }
V f16 f16_mul_sub(f16 a, f16 b, f16 c) { return _mm512_fmsub_ps(a, b, c); }
V f16 f16_sub_mul(f16 c, f16 a, f16 b) { return _mm512_fnmadd_ps(a, b, c); }
V uint32_t f16_le(f16 a, f16 b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
V f16 f16_pick(uint32_t bits, f16 a, f16 b) { return _mm512_mask_blend_ps((__mmask16)bits, b, a); }
V float f16_least(f16 a) { return _mm512_reduce_min_ps(a); }
V float f16_most(f16 a) { return _mm512_reduce_max_ps(a); }
/* The lanes of bits, and which they are, counted from first, together; there is room for all. */
V void f16_pack(float *p, uint32_t *lane, f16 a, uint32_t bits, uint32_t first)
{
	const __m512i row = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
	const __m512i lanes = _mm512_add_epi32(row, _mm512_set1_epi32((int)first));

	_mm512_storeu_ps(p, _mm512_maskz_compress_ps((__mmask16)bits, a));
	_mm512_storeu_si512(lane, _mm512_maskz_compress_epi32((__mmask16)bits, lanes));
}
#elif ISA_LEVEL == 2
typedef struct {
	__m256 a, b;
} f16;

#define F16(name, op) \
	V f16 f16_##name(f16 x, f16 y) { return (f16){ op(x.a, y.a), op(x.b, y.b) }; }
#define F16_3(name, op) \
	V f16 f16_##name(f16 x, f16 y, f16 z) { return (f16){ op(x.a, y.a, z.a), op(x.b, y.b, z.b) }; }
F16(add, _mm256_add_ps)
F16(sub, _mm256_sub_ps)
F16(mul, _mm256_mul_ps)
F16(div, _mm256_div_ps)
F16(min, _mm256_min_ps)
F16(max, _mm256_max_ps)
F16_3(mul_add, _mm256_fmadd_ps)
F16_3(mul_sub, _mm256_fmsub_ps)
#undef F16
#undef F16_3
V f16 f16_load(const float *p) { return (f16){ _mm256_load_ps(p), _mm256_load_ps(p + 8) }; }
V void f16_store(float *p, f16 x) { _mm256_store_ps(p, x.a), _mm256_store_ps(p + 8, x.b); }
V f16 f16_all(float x) { return (f16){ _mm256_set1_ps(x), _mm256_set1_ps(x) }; }
V f16 f16_sub_mul(f16 z, f16 x, f16 y)
{
	return (f16){ _mm256_fnmadd_ps(x.a, y.a, z.a), _mm256_fnmadd_ps(x.b, y.b, z.b) };
}
V f16 f16_size(f16 x)
{
	__m256 s = _mm256_set1_ps(-0.0f);

	return (f16){ _mm256_andnot_ps(s, x.a), _mm256_andnot_ps(s, x.b) };
}
V uint32_t f16_le(f16 x, f16 y) { return f8_le(x.a, y.a) | f8_le(x.b, y.b) << 8; }
V __m256 f8_pick(uint32_t bits, __m256 a, __m256 b)
{
	const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
	__m256i m = _mm256_and_si256(_mm256_set1_epi32((int)bits), lane);

	return _mm256_blendv_ps(b, a, _mm256_castsi256_ps(_mm256_cmpeq_epi32(m, lane)));
}
V f16 f16_pick(uint32_t bits, f16 x, f16 y)
{
	return (f16){ f8_pick(bits, x.a, y.a), f8_pick(bits >> 8, x.b, y.b) };
}
V float f16_least(f16 x)
{
	__m256 m = _mm256_min_ps(x.a, x.b);

	return f4_least(_mm_min_ps(_mm256_castps256_ps128(m), _mm256_extractf128_ps(m, 1)));
}
V float f16_most(f16 x)
{
	__m256 m = _mm256_min_ps(f8_negate(x.a), f8_negate(x.b));

	return -f4_least(_mm_min_ps(_mm256_castps256_ps128(m), _mm256_extractf128_ps(m, 1)));
}
/* The lanes of bits, and which they are, counted from first, together; there is room for all. */
V void f16_pack(float *p, uint32_t *lane, f16 x, uint32_t bits, uint32_t first)
{
	float all[16] __attribute__((aligned(64)));

	f16_store(all, x);
	for (; bits; bits &= bits - 1) {
		unsigned i = (unsigned)__builtin_ctz(bits);

		*p++ = all[i];
		*lane++ = first + i;
	}
}
#endif

#endif
