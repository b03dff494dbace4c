/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "base/diag.h"

#include <stdio.h>

void diag_vreport(struct diag *d, enum diag_level level, const struct diag_pos *pos, const char *fmt,
		  va_list ap)
{
	char text[2048];

	if (level == DIAG_ERROR)
		d->errors++;
	else if (level == DIAG_WARNING)
		d->warnings++;
	if (!d->sink)
		return;
	vsnprintf(text, sizeof(text), fmt, ap);
	d->sink(d->arg, level, pos, text);
}

void diag_report(struct diag *d, enum diag_level level, const struct diag_pos *pos, const char *fmt, ...)
{
	va_list ap;

	va_start(ap, fmt);
	diag_vreport(d, level, pos, fmt, ap);
	va_end(ap);
}

enum status diag_fail(struct diag *d, enum status st, const struct diag_pos *pos, const char *fmt, ...)
{
	va_list ap;

	va_start(ap, fmt);
	diag_vreport(d, DIAG_ERROR, pos, fmt, ap);
	va_end(ap);
	return st;
}

enum status diag_no_memory(struct diag *d, const char *what, uint64_t bytes)
{
	diag_report(d, DIAG_ERROR, NULL, "out of memory: %s needs %.1f MiB more", what,
		    (double)bytes / 1048576.0);
	return STATUS_MEMORY;
}

int diag_format(char *out, size_t size, enum diag_level level, const struct diag_pos *pos,
		const char *text)
{
	static const char *const name[] = { "error", "warning", "note", "debug" };

	if (!pos || !pos->file)
		return snprintf(out, size, "%s: %s", name[level], text);
	if (!pos->line)
		return snprintf(out, size, "%s: %s: %s", pos->file, name[level], text);
	if (!pos->col)
		return snprintf(out, size, "%s:%u: %s: %s", pos->file, pos->line, name[level], text);
	return snprintf(out, size, "%s:%u:%u: %s: %s", pos->file, pos->line, pos->col, name[level],
			text);
}
