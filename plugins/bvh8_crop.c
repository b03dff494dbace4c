/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The fast builder's jobs, for any processor.
 */
#include "bvh8_crop.h"

const struct bvh8_crop bvh8_crop_base = { key_job, crop_job, sizeof(struct desk) };
