/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "accel/text.h"

#include <stdio.h>
#include <string.h>

void text_add(struct text *t, const char *fmt, ...)
{
	size_t room = sizeof(t->s) - t->used;
	va_list ap;
	int n;

	va_start(ap, fmt);
	n = vsnprintf(t->s + t->used, room, fmt, ap);
	va_end(ap);
	if (n > 0)
		t->used += (size_t)n < room ? (size_t)n : room - 1;
}

#define WORD 32

static unsigned least(unsigned a, unsigned b)
{
	return a < b ? a : b;
}

/* The edit distance with swaps of neighbours (Damerau 1964, in its restricted form). */
static unsigned distance(const char *a, size_t n, const char *b, size_t m)
{
	unsigned d[WORD + 1][WORD + 1];

	for (size_t i = 0; i <= n; i++)
		d[i][0] = (unsigned)i;
	for (size_t j = 0; j <= m; j++)
		d[0][j] = (unsigned)j;
	for (size_t i = 1; i <= n; i++) {
		for (size_t j = 1; j <= m; j++) {
			unsigned differ = a[i - 1] != b[j - 1];

			d[i][j] = least(d[i - 1][j - 1] + differ,
					least(d[i - 1][j], d[i][j - 1]) + 1);
			if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
				d[i][j] = least(d[i][j], d[i - 2][j - 2] + 1);
		}
	}
	return d[n][m];
}

int text_alike(const char *a, const char *b)
{
	size_t n = strlen(a), m = strlen(b);

	if (!n || !m || n > WORD || m > WORD)
		return 0;
	return distance(a, n, b, m) <= (n + 2) / 3;
}
