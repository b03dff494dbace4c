/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * How far the work has come: a bar on a terminal, lines in a log, JSON lines for a program.
 */
#ifndef ALIDADE_LOOK_PROGRESS_H
#define ALIDADE_LOOK_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum progress_mode { PROGRESS_AUTO, PROGRESS_BAR, PROGRESS_LINES, PROGRESS_JSON, PROGRESS_NONE };

struct progress {
	enum progress_mode mode;
	FILE *out;
	uint32_t columns; /* of the terminal */
	const char *phase; /* NULL: between two */
	uint32_t frame; /* of an animation, */
	uint64_t index, count; /* the index-th, from 1, of count; 0: a still picture */
	double began, shown; /* seconds: when the phase began, when last shown */
	uint32_t tenths; /* of the work, last shown in a line */
	bool bar; /* one stands on the terminal */
};

/* AUTO becomes a bar if out is a terminal that can erase, else lines; JSON goes to standard output. */
void progress_init(struct progress *, enum progress_mode, FILE *out);
/* phase lives until the end of it; "reading", "building", "rendering", "writing". */
void progress_begin(struct progress *, const char *phase, double now);
/* done of total, in whatever unit; now in seconds. Shows only what is worth showing. */
void progress_update(struct progress *, uint64_t done, uint64_t total, double now);
void progress_end(struct progress *, double now);
/* Take the bar away, because something else is to be printed. */
void progress_erase(struct progress *);

#endif
