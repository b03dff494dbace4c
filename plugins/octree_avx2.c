/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * octree_trace.h in AVX2 with FMA.
 */
#if defined __x86_64__
/* Before all headers: alidade/kernel.h, too, is to know what there is. */
#define ISA_LEVEL 2
#include "isa_begin.h"
#define ISA_NAME octree_avx2
#include "octree_trace.h"
#include "isa_end.h"
#endif
