/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Exact order's last step as the renderer takes it, eight rays at a time.
 */
#ifndef TESTS_BENCH_SETTLE_H
#define TESTS_BENCH_SETTLE_H

#include "alidade/kernel.h"

/* prims are of a mesh without origins, and were asked for exact order. */
void settle_as_host(const ald_prims *, const ald_frame *, const ald_ray *, ald_hit *, uint32_t n);

#endif
