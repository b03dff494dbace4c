/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A message built up piece by piece in a buffer that can't overflow; what does not fit is cut.
 */
#ifndef ALIDADE_ACCEL_TEXT_H
#define ALIDADE_ACCEL_TEXT_H

#include <stdarg.h>
#include <stddef.h>

#include "base/diag.h"

struct text {
	size_t used;
	char s[1536];
};

void text_add(struct text *, const char *fmt, ...) DIAG_PRINTF(2, 3);

/* Is b what someone may have meant by a: at most one letter in three wrong, missing, added, or swapped
 * with its neighbour. */
int text_alike(const char *a, const char *b);

#endif
