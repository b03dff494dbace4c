/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Cells of a test shared out to processes, so that a run takes as long as its cores let it, and told in order.
 *
 * Every process goes through the same list of cells, and runs those that it is the first to claim.
 */
#ifndef ALIDADE_TESTS_CREW_H
#define ALIDADE_TESTS_CREW_H

#include "trial.h"

/* Calls all() in as many processes, and prints what they tell as TAP, with sums by class at the end. all() is to
 * go through all cells, each of which begins with crew_claims() and ends with crew_tell(). Those before first,
 * counted from 0, are left out. True: all is well. */
bool crew_run(unsigned processes, uint32_t first, void (*all)(void));
/* The next cell begins. Is it ours? If not, it must be left at once. */
bool crew_claims(void);
/* Its number, from 0: for seeds. */
uint32_t crew_cell(void);
/* How it went; detail: a line. The name's first letter is its class. */
void crew_tell(const char *name, const struct tally *, bool good, const char *detail);

#endif
