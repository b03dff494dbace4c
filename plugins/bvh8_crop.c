/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The fast builder's jobs, for any processor.
 */
#include "bvh8_crop.h"

void bvh8_crop_base(void *fast, uint32_t i)
{
	crop_job(fast, i);
}

size_t bvh8_desk(void)
{
	return sizeof(struct desk);
}
