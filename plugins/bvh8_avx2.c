/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's walk in AVX2 with FMA.
 */
#include "bvh8.h"

#if defined __x86_64__
#define ISA_LEVEL 2
#include "isa_begin.h"
#define ISA_NAME bvh8_avx2
#define ISA_TEXT "avx2"
#include "bvh8_walk.h"
#include "isa_end.h"
#endif
