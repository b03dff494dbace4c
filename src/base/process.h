/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * How a process computes and how it writes numbers. Code that is loaded into it can change both: a library built
 * with gcc's -ffast-math makes the thread that loads it take subnormal numbers for 0, and threads hand that on;
 * others call setlocale(), and then 0.5 is written and read as 0,5. Pictures must not depend on either.
 */
#ifndef ALIDADE_BASE_PROCESS_H
#define ALIDADE_BASE_PROCESS_H

/* First thing in main(): for libraries that are there before it. */
void process_begin(void);
/* This thread rounds to the nearest, keeps subnormal numbers, and traps nothing. Costs next to nothing. */
void process_arithmetic(void);
/* dlopen() that leaves arithmetic and locale as process_begin() set them. */
void *process_load(const char *path, int flags);

#endif
