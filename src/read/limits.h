/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The limits on what a scene may ask of the reader: names, defaults and meanings in one table, for
 * --limit, --help and the man page.
 */
#ifndef ALIDADE_READ_LIMITS_H
#define ALIDADE_READ_LIMITS_H

#include <stddef.h>

#include "read/read.h"

struct read_limit_row {
	const char *name;
	double value; /* the default */
	const char *help;
};

extern const struct read_limit_row read_limit_table[];
extern const size_t read_limit_count;

/* The same with every 0 replaced by its default. */
struct read_limits read_limits_fill(const struct read_limits *);
/* Set one by its name; false: there is none of that name, or the value is not a positive number (for
 * seconds, 0 is allowed). */
bool read_limits_set(struct read_limits *, const char *name, double value);

#endif
