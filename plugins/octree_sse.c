/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * octree_trace.h in SSE4.2.
 */
#if defined __x86_64__
/* Before all headers: alidade/kernel.h, too, is to know what there is. */
#define ISA_LEVEL 1
#include "isa_begin.h"
#define ISA_NAME octree_sse
#include "octree_trace.h"
#include "isa_end.h"
#endif
