/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A long list of vectors, scanned by all threads.
 */
#ifndef ALIDADE_READ_POV_SHARE_H
#define ALIDADE_READ_POV_SHARE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/pool.h"

/* Scan the element at at into place i of the list. NULL: it is not plain, or wrong. Nothing else may be written,
 * as others do the same with other places. */
typedef const char *share_element(void *list, const char *at, const char *end, size_t i);

/* Is so much text long enough for it? */
bool share_worth(const struct pool *, const char *at, const char *end);
/* Elements from *at on, as long as each is plain, into places from first on, most of them at most. Returns how many
 * these are, and where the next begins in *at: all is as if one thread had scanned them in their order, but that places
 * behind them may have been written to, and that it may stop early. 0, and *at as it was: the list is too short. */
size_t share_scan(struct pool *, share_element *one, void *list, size_t first, size_t most, const char **at,
		  const char *end);

#endif
