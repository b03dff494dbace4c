/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * flat_walk.h in SSE4.2.
 */
#include "flat.h"

#if defined __x86_64__
#define ISA_LEVEL 1
#include "isa_begin.h"
#define ISA_NAME flat_sse
#include "flat_walk.h"
#include "isa_end.h"
#endif
