/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The fast builder's jobs by AVX2: the same to the bit.
 */
#include "bvh8.h"

#if defined __x86_64__
#define ISA_LEVEL 2
#include "isa_begin.h"
#include "bvh8_crop.h"

const struct bvh8_crop bvh8_crop_avx2 = { key_job, crop_job, sizeof(struct desk) };
#include "isa_end.h"
#endif
