/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The fast builder's jobs by AVX2: the same to the bit.
 */
#include "bvh8.h"

#if defined __x86_64__
#include <immintrin.h>

#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif
#define HULL_AVX2
#include "bvh8_crop.h"

void bvh8_crop_avx2(void *fast, uint32_t i)
{
	crop_job(fast, i);
}
#ifdef __clang__
#pragma clang attribute pop
#endif
#endif
