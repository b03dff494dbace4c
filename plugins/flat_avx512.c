/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * flat_walk.h in AVX-512.
 */
#include "flat.h"

#if defined __x86_64__
#define ISA_LEVEL 3
#include "isa_begin.h"
#define ISA_NAME flat_avx512
#include "flat_walk.h"
#include "isa_end.h"
#endif
