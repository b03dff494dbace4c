/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Errors and warnings: where, what, and what to do about it.
 *
 * A function that can fail returns an enum status and reports through the caller's struct diag; only
 * main files print and exit. A status is the exit code that the programs give for it.
 */
#ifndef ALIDADE_BASE_DIAG_H
#define ALIDADE_BASE_DIAG_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#if defined __GNUC__
#define DIAG_PRINTF(a, b) __attribute__((format(printf, a, b)))
#else
#define DIAG_PRINTF(a, b)
#endif

enum status {
	STATUS_OK = 0,
	STATUS_FAILED = 1, /* while rendering or writing */
	STATUS_USAGE = 2, /* the command line */
	STATUS_SCENE = 3, /* the scene or a file it needs is wrong or unsupported */
	STATUS_ACCEL = 4, /* accelerator not found, wrong ABI, refused */
	STATUS_BUDGET = 5,
	STATUS_NONFINITE = 6, /* picture written, but with NaN or Inf samples in it */
	STATUS_VERIFY = 7, /* picture written, but an accelerator answered otherwise than brute force */
	STATUS_MEMORY = 8, /* there is not as much as it takes, or would take */
	STATUS_SIGINT = 130,
	STATUS_SIGTERM = 143
};

enum diag_level { DIAG_ERROR, DIAG_WARNING, DIAG_INFO, DIAG_DEBUG };

/* file may be NULL (no place), line 0 (the whole file), col 0 (the whole line). Both count from 1;
 * col counts bytes. The name must live as long as the diag's user needs it. */
struct diag_pos {
	const char *file;
	uint32_t line, col;
};

struct diag {
	/* Called for each message, in order; may be NULL: count only. [one thread at a time] */
	void (*sink)(void *arg, enum diag_level, const struct diag_pos *, const char *text);
	void *arg;
	uint32_t errors, warnings;
};

/* pos may be NULL. Text is one or more sentences without a final newline. */
void diag_report(struct diag *, enum diag_level, const struct diag_pos *pos, const char *fmt, ...)
	DIAG_PRINTF(4, 5);
void diag_vreport(struct diag *, enum diag_level, const struct diag_pos *pos, const char *fmt,
		  va_list ap);
/* Report an error and return st: return diag_fail(d, STATUS_SCENE, &pos, "..."); */
enum status diag_fail(struct diag *, enum status st, const struct diag_pos *pos, const char *fmt, ...)
	DIAG_PRINTF(4, 5);
enum status diag_no_memory(struct diag *, const char *what, uint64_t bytes);

/* "file:line:col: error: text" without a newline, as the programs print it; returns the length that
 * was needed, as snprintf does. */
int diag_format(char *out, size_t size, enum diag_level, const struct diag_pos *, const char *text);

#endif
