/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's walk in AVX-512VL: masks instead of vectors of signs.
 */
#include "bvh8.h"

#if defined __x86_64__
#define ISA_LEVEL 3
#include "isa_begin.h"
#define ISA_NAME bvh8_avx512
#define ISA_TEXT "avx512"
#include "bvh8_walk.h"
#include "isa_end.h"
#endif
