/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * flat_walk.h in AVX-512.
 */
#include "flat.h"

#if defined __x86_64__
#include <immintrin.h>

#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2,fma,avx512f,avx512dq,avx512vl"))), apply_to = function)
#else
#pragma GCC target("avx2,fma,avx512f,avx512dq,avx512vl")
#endif
#define ISA_LEVEL 3
#define ISA_NAME flat_avx512
#include "flat_walk.h"
#ifdef __clang__
#pragma clang attribute pop
#endif
#endif
