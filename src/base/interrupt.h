/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Being asked to stop: the first SIGINT or SIGTERM is a wish that the program looks up and grants with
 * what it has, the second leaves at once.
 */
#ifndef ALIDADE_BASE_INTERRUPT_H
#define ALIDADE_BASE_INTERRUPT_H

#include <stdbool.h>

/* A signal that was ignored when the program started (nohup, a shell's background job) stays so. */
void interrupt_install(void);
bool interrupt_asked(void); /* [any] */
int interrupt_status(void); /* 128 + the signal's number, 0: none came */

#endif
