/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * octree_trace.h in SSE4.2.
 */
#if defined __x86_64__
/* Before all headers: alidade/kernel.h, too, is to know what there is. */
#ifdef __clang__
#include <immintrin.h>
#pragma clang attribute push(__attribute__((target("sse4.2"))), apply_to = function)
#else
#pragma GCC target("sse4.2")
#endif
#define ISA_LEVEL 1
#define ISA_NAME octree_sse
#include "octree_trace.h"
#ifdef __clang__
#pragma clang attribute pop
#endif
#endif
