/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * octree_trace.h in AVX2 with FMA.
 */
#if defined __x86_64__
/* Before all headers: alidade/kernel.h, too, is to know what there is. */
#ifdef __clang__
#include <immintrin.h>
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC target("avx2,fma")
#endif
#define ISA_LEVEL 2
#define ISA_NAME octree_avx2
#include "octree_trace.h"
#ifdef __clang__
#pragma clang attribute pop
#endif
#endif
