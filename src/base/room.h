/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * How much more memory this process can have, before anybody is made to swap or killed.
 */
#ifndef ALIDADE_BASE_ROOM_H
#define ALIDADE_BASE_ROOM_H

#include <stdint.h>

struct room {
	uint64_t bytes; /* UINT64_MAX: nobody says */
	char what[64]; /* what sets it, as the end of "x GiB are left ...": "of what ulimit -v allows" */
};

/* The least of what the machine has available, what the control groups above this process (version 1 or 2) leave,
 * and its own limits. root: "", or a folder that stands for /, for tests. */
void room_find(struct room *, const char *root);

/* Bytes of this process that were in memory at a time; 0: nobody says. */
uint64_t room_process_most(void);

#endif
