/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Seconds on a clock that only goes forward. For reports; nothing in a picture may depend on it, unless a time
 * was asked for (--time).
 */
#ifndef ALIDADE_BASE_CLOCK_H
#define ALIDADE_BASE_CLOCK_H

#include <time.h>

static inline double clock_seconds(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
