/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's vectors gv: the triangles of a block beside each other, once for each of GROUP rays.
 */
#ifndef BVH8_VECG_H
#define BVH8_VECG_H

#include "bvh8_vec.h"

#if ISA_LEVEL >= 2
V f8 f8_size(f8 a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }

/* Four numbers of each of eight rays, side by side from rows[ray][at] on. */
V void f8_rows(float (*rows)[16], unsigned at, f8 a, f8 b, f8 c, f8 d)
{
	f8 ab0 = _mm256_unpacklo_ps(a, b), ab1 = _mm256_unpackhi_ps(a, b), cd0 = _mm256_unpacklo_ps(c, d);
	f8 cd1 = _mm256_unpackhi_ps(c, d), x[4];

	x[0] = _mm256_shuffle_ps(ab0, cd0, 0x44);
	x[1] = _mm256_shuffle_ps(ab0, cd0, 0xee);
	x[2] = _mm256_shuffle_ps(ab1, cd1, 0x44);
	x[3] = _mm256_shuffle_ps(ab1, cd1, 0xee);
	for (unsigned i = 0; i < 4; i++) {
		_mm_store_ps(&rows[i][at], _mm256_castps256_ps128(x[i]));
		_mm_store_ps(&rows[i + 4][at], _mm256_extractf128_ps(x[i], 1));
	}
}
#endif

#if ISA_LEVEL >= 3
#define GROUP 4u
#define G_SPREAD(x, i) _mm512_permute_ps(x, (i) * 0x55)
#define G_TURN(x, order) _mm512_permute_ps(x, order)
typedef __m512 gv;

V gv g_seats(const float *p) { return _mm512_broadcast_f32x4(_mm_load_ps(p)); }
V gv g_all(float x) { return _mm512_set1_ps(x); }
V gv g_add(gv a, gv b) { return _mm512_add_ps(a, b); }
V gv g_sub(gv a, gv b) { return _mm512_sub_ps(a, b); }
V gv g_mul(gv a, gv b) { return _mm512_mul_ps(a, b); }
V gv g_div(gv a, gv b) { return _mm512_div_ps(a, b); }
V gv g_min(gv a, gv b) { return _mm512_min_ps(a, b); }
V gv g_max(gv a, gv b) { return _mm512_max_ps(a, b); }
V gv g_size(gv a) { return _mm512_abs_ps(a); }
V gv g_largest(gv a, gv b) { return _mm512_range_ps(a, b, 11); } /* of their sizes */
V gv g_negate(gv a) { return _mm512_sub_ps(_mm512_setzero_ps(), a); }
V gv g_mul_add(gv a, gv b, gv c) { return _mm512_fmadd_ps(a, b, c); }
V gv g_mul_sub(gv a, gv b, gv c) { return _mm512_fmsub_ps(a, b, c); }
V gv g_sub_mul(gv c, gv a, gv b) { return _mm512_fnmadd_ps(a, b, c); }
V uint32_t g_le(gv a, gv b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
V gv g_pick(uint32_t bits, gv a, gv b) { return _mm512_mask_blend_ps((__mmask16)bits, b, a); }
V gv g_or(gv a, gv b) { return _mm512_or_ps(a, b); }
V void g_store(float *p, gv a) { _mm512_store_ps(p, a); }
V void g_pack(float *p, gv a, uint32_t bits) { _mm512_storeu_ps(p, _mm512_maskz_compress_ps((__mmask16)bits, a)); }
V uint32_t g_same(gv a, gv b) { return _mm512_cmpeq_epi32_mask(_mm512_castps_si512(a), _mm512_castps_si512(b)); }

/* rows[row][at] and the three behind it, of GROUP rows. */
V gv g_rows(const float (*rows)[16], unsigned at, const uint32_t *row)
{
	gv x = _mm512_castps128_ps512(_mm_load_ps(&rows[row[0]][at]));

	x = _mm512_mask_broadcast_f32x4(x, 0x00f0, _mm_load_ps(&rows[row[1]][at]));
	x = _mm512_mask_broadcast_f32x4(x, 0x0f00, _mm_load_ps(&rows[row[2]][at]));
	return _mm512_mask_broadcast_f32x4(x, 0xf000, _mm_load_ps(&rows[row[3]][at]));
}

/* The same back, and its first to first[row]; the first of GROUP rows last, so that others may be it, too. */
V void g_rows_put(float (*rows)[16], unsigned at, float *first, const uint32_t *row, gv x)
{
	const __m128 four[] = { _mm512_castps512_ps128(x), _mm512_extractf32x4_ps(x, 1), _mm512_extractf32x4_ps(x, 2),
				_mm512_extractf32x4_ps(x, 3) };

	UNROLL
	for (unsigned i = GROUP; i-- > 0;) {
		_mm_store_ps(&rows[row[i]][at], four[i]);
		_mm_store_ss(&first[row[i]], four[i]);
	}
}

/* Each of GROUP words, as often as there are seats. */
V gv g_each(const uint32_t *p)
{
	const __m512i four = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
	__m512i x = _mm512_broadcast_i32x4(_mm_loadu_si128((const __m128i *)p));

	return _mm512_castsi512_ps(_mm512_permutexvar_epi32(four, x));
}

/* Which bits are set, and behind these GROUP of some lane; there is room for 16 more. How many. */
V uint32_t lanes_of(uint64_t bits, uint32_t *lane)
{
	const __m512i row = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
	uint32_t n = 0;

	for (unsigned i = 0; i < 64; i += 16) {
		__m512i at = _mm512_add_epi32(row, _mm512_set1_epi32((int)i));
		__mmask16 in = (__mmask16)(bits >> i);

		_mm512_storeu_si512(lane + n, _mm512_maskz_compress_epi32(in, at));
		n += (uint32_t)__builtin_popcount(in);
	}
	_mm_storeu_si128((__m128i *)(lane + n), _mm_setzero_si128());
	return n;
}
#elif ISA_LEVEL == 2
#define GROUP 2u
#define G_SPREAD(x, i) _mm256_permute_ps(x, (i) * 0x55)
#define G_TURN(x, order) _mm256_permute_ps(x, order)
typedef __m256 gv;

V gv g_seats(const float *p) { return _mm256_broadcast_ps((const __m128 *)p); }
V gv g_all(float x) { return _mm256_set1_ps(x); }
V gv g_add(gv a, gv b) { return _mm256_add_ps(a, b); }
V gv g_sub(gv a, gv b) { return _mm256_sub_ps(a, b); }
V gv g_mul(gv a, gv b) { return _mm256_mul_ps(a, b); }
V gv g_div(gv a, gv b) { return _mm256_div_ps(a, b); }
V gv g_min(gv a, gv b) { return _mm256_min_ps(a, b); }
V gv g_max(gv a, gv b) { return _mm256_max_ps(a, b); }
V gv g_size(gv a) { return f8_size(a); }
V gv g_largest(gv a, gv b) { return _mm256_max_ps(f8_size(a), f8_size(b)); }
V gv g_negate(gv a) { return f8_negate(a); }
V gv g_mul_add(gv a, gv b, gv c) { return _mm256_fmadd_ps(a, b, c); }
V gv g_mul_sub(gv a, gv b, gv c) { return _mm256_fmsub_ps(a, b, c); }
V gv g_sub_mul(gv c, gv a, gv b) { return _mm256_fnmadd_ps(a, b, c); }
V uint32_t g_le(gv a, gv b) { return f8_le(a, b); }
V gv g_pick(uint32_t bits, gv a, gv b) { return f8_pick(bits, a, b); }
V gv g_or(gv a, gv b) { return _mm256_or_ps(a, b); }
V void g_store(float *p, gv a) { _mm256_store_ps(p, a); }

V void g_pack(float *p, gv a, uint32_t bits)
{
	__m256i order = _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)bvh8_lanes[bits]));

	_mm256_storeu_ps(p, _mm256_permutevar8x32_ps(a, order));
}

V uint32_t g_same(gv a, gv b)
{
	__m256i m = _mm256_cmpeq_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b));

	return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(m));
}

V gv g_rows(const float (*rows)[16], unsigned at, const uint32_t *row)
{
	gv x = _mm256_castps128_ps256(_mm_load_ps(&rows[row[0]][at]));

	return _mm256_insertf128_ps(x, _mm_load_ps(&rows[row[1]][at]), 1);
}

V void g_rows_put(float (*rows)[16], unsigned at, float *first, const uint32_t *row, gv x)
{
	const __m128 four[] = { _mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1) };

	UNROLL
	for (unsigned i = GROUP; i-- > 0;) {
		_mm_store_ps(&rows[row[i]][at], four[i]);
		_mm_store_ss(&first[row[i]], four[i]);
	}
}

V gv g_each(const uint32_t *p)
{
	__m256i x = _mm256_broadcastsi128_si256(_mm_loadu_si128((const __m128i *)p));

	return _mm256_castsi256_ps(_mm256_permutevar8x32_epi32(x, _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1)));
}

V uint32_t lanes_of(uint64_t bits, uint32_t *lane)
{
	uint32_t n = 0;

	for (; bits; bits &= bits - 1)
		lane[n++] = (uint32_t)__builtin_ctzll(bits);
	lane[n] = 0;
	return n;
}
#endif

#if ISA_LEVEL >= 2
/* Of each ray's four the least, in all of them; and all of their bits. */
V gv g_least(gv a)
{
	a = g_min(a, G_TURN(a, 0x4e));
	return g_min(a, G_TURN(a, 0xb1));
}

V gv g_join(gv a)
{
	a = g_or(a, G_TURN(a, 0x4e));
	return g_or(a, G_TURN(a, 0xb1));
}

/* Which rays of a group, bits of their first seats, have any of these. */
V uint32_t rays_of(uint32_t seats)
{
	seats |= seats >> 1;
	return (seats | seats >> 2) & 0x11111111;
}

V uint64_t rays_lanes(uint32_t rays, const uint32_t *lane)
{
	uint64_t some = 0;

	UNROLL
	for (unsigned i = 0; i < GROUP; i++)
		some |= (uint64_t)(rays >> 4 * i & 1) << lane[i];
	return some;
}
#endif

#endif
