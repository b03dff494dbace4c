/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Sampling as a budget: passes over the picture until each pixel is as sure as was asked for, or time is over, or
 * it has as many samples as it may have.
 */
#ifndef ALIDADE_RENDER_BUDGET_H
#define ALIDADE_RENDER_BUDGET_H

#include "base/pool.h"
#include "render/aa.h"

struct budget;

size_t budget_bytes_a_pixel(void);
/* worker: one for each thread of the pool. NULL: out of memory. */
struct budget *budget_new(struct worker *worker, struct pool *, struct mem_book *);
/* False: stopped by options->stop, or out of memory; what there is can be had all the same. */
bool budget_render(struct budget *, bool *stopped);
/* A pixel of the picture; false: nothing is known of it, because rendering was stopped. */
bool budget_pixel(const struct budget *, uint32_t x, uint32_t y, struct aa_pixel *);
/* What was asked, and what became of it. */
void budget_tell(const struct budget *, struct render_reached *);
void budget_free(struct budget *); /* NULL is harmless */

#endif
