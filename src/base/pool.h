/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A pool of threads that runs numbered jobs.
 */
#ifndef ALIDADE_BASE_POOL_H
#define ALIDADE_BASE_POOL_H

#include <stdint.h>

struct pool;

typedef void pool_job(void *arg, uint32_t i, uint32_t thread);

/* threads >= 1 in all, the caller of pool_run() being one of them; NULL: could not be made. */
struct pool *pool_new(uint32_t threads);
uint32_t pool_threads(const struct pool *);
/* Run job(arg, i, thread) for i = 0 .. n-1, handed out in that order, and wait for all of them. One
 * call at a time, not from within a job. thread is below pool_threads(). */
void pool_run(struct pool *, uint32_t n, pool_job *job, void *arg);
void pool_free(struct pool *); /* NULL is harmless */

uint32_t pool_cores(void); /* processors this process may run on, at least 1 */

#endif
