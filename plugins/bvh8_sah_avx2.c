/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's binary tree by AVX2: the same to the bit.
 */
#include "bvh8.h"

#if defined __x86_64__
#define ISA_LEVEL 2
#include "isa_begin.h"
#include "bvh8_sah.h"

int bvh8_sah_avx2(struct builder *b)
{
	return sah(b);
}
#include "isa_end.h"
#endif
