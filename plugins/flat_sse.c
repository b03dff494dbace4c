/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * flat_walk.h in SSE4.2.
 */
#include "flat.h"

#if defined __x86_64__
#include <immintrin.h>

#ifdef __clang__
#pragma clang attribute push(__attribute__((target("sse4.2"))), apply_to = function)
#else
#pragma GCC target("sse4.2")
#endif
#define ISA_LEVEL 1
#define ISA_NAME flat_sse
#include "flat_walk.h"
#ifdef __clang__
#pragma clang attribute pop
#endif
#endif
