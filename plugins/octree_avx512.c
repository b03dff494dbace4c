/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * octree_trace.h in AVX-512.
 */
#if defined __x86_64__
/* Before all headers: alidade/kernel.h, too, is to know what there is. */
#define ISA_LEVEL 3
#include "isa_begin.h"
#define ISA_NAME octree_avx512
#include "octree_trace.h"
#include "isa_end.h"
#endif
