/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The one list of what is measured: the file of results, the table, JSON and HTML are all made from it.
 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "trade.h"

const struct trade_column trade_column[TRADE_VALUES] = {
	[TRADE_PROCESS] = { "process_seconds", "time", "s",
			    "of the whole process, from its start to its end", 1, 4, true },
	[TRADE_RENDER] = { "render_seconds", "render", "s", "of drawing alone", 1, 4, true },
	[TRADE_BUILD] = { "build_seconds", "build", "s", "of building the accelerator's structure", 1, 3,
			  false },
	[TRADE_READ] = { "read_seconds", "read", "s", "of reading the scene", 1, 3, false },
	[TRADE_CPU] = { "cpu_seconds", "CPU", "s", "of all processors together", 1, 4, false },
	[TRADE_MEMORY] = { "memory_bytes", "memory", "MiB", "the most that the process had", 0x1p-20, 4,
			   true },
	[TRADE_RMSE] = { "rmse", "RMSE", "", "root of the mean square error, over all pixels and colours", 1,
			 3, true },
	[TRADE_BIAS] = { "bias", "bias", "", "mean error, with its sign: above 0 is too bright", 1, 2, true },
	[TRADE_P99] = { "p99", "p99", "", "99 % of the pixels are off by this or less", 1, 3, true },
	[TRADE_MAX] = { "max", "max", "", "the largest error", 1, 3, false },
	[TRADE_CHANGED] = { "changed", "changed", "%", "share of the pixels that are visibly off", 100, 3,
			    true },
	[TRADE_NONFINITE] = { "nonfinite", "not finite", "", "pixels that are not finite numbers", 1, 6,
			      false },
	[TRADE_WRONG] = { "wrong_per_million", "wrong", "/M",
			  "rays in a million whose nearest hit is not the one that exact arithmetic finds", 1,
			  3, true },
};

enum trade_value trade_value_named(const char *key)
{
	int i = 0;

	while (i < TRADE_VALUES && strcmp(key, trade_column[i].key) != 0)
		i++;
	return (enum trade_value)i;
}

void trade_value_text(enum trade_value v, double x, char *out, size_t size)
{
	const struct trade_column *c = &trade_column[v];

	if (isfinite(x))
		snprintf(out, size, "%.*g", c->digits, x * c->scale);
	else
		snprintf(out, size, "-");
}
