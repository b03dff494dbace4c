/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What alidade was told to do: its table of options, and what an .ini file adds.
 */
#ifndef ALIDADE_SETTINGS_H
#define ALIDADE_SETTINGS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/diag.h"
#include "base/mem.h"
#include "base/options.h"
#include "look/progress.h"
#include "read/read.h"
#include "render/render.h"

#define SETTINGS_SIDE_MAX 1000000u

enum settings_action {
	ACTION_RENDER, ACTION_HELP, ACTION_VERSION, ACTION_LIST_ACCELS, ACTION_COMPLETION
};

struct settings {
	struct arena arena; /* of all text below that is not argv's */
	enum settings_action action;
	const char *shell; /* ACTION_COMPLETION */
	const char *scene; /* file name, "-" for standard input */
	char *output; /* NULL until settings_finish() */
	const char *accel; /* as for accel_load() */
	uint32_t precision; /* ALD_PRECISION_... */
	uint32_t threads;
	uint32_t verify; /* one ray in so many is asked twice; 0: none */
	uint64_t memory; /* bytes, 0: no limit */
	uint32_t bits;
	bool alpha;
	bool stats;
	const char *stats_file; /* NULL: text on standard error */
	enum progress_mode progress;
	int verbosity; /* -1: errors only, 0: warnings too, 1: notes, 2: everything */
	bool dry_run;
	struct frame_settings frames; /* of --range and --clock */
	struct frame_span frame[FRAME_SPANS]; /* of -f */
	uint32_t frame_count;
	bool skip_existing;
	struct read_options read;
	struct render_options render; /* width 0 until settings_finish() unless given */
	unsigned given; /* enum settings_given */
};

enum settings_given {
	GIVEN_SIZE = 1, GIVEN_CROP = 2, GIVEN_AA = 4, GIVEN_ALPHA = 8, GIVEN_OUTPUT = 16, GIVEN_RANGE = 32,
	GIVEN_ERROR = 64
};

extern const struct option_program settings_program;

void settings_init(struct settings *, struct mem_book *);
void settings_release(struct settings *);
/* The command line. */
enum status settings_parse(struct settings *, int argc, char **argv, struct diag *);
/* Which frames are to be drawn; job: what read_job_peek() found. */
void settings_plan(const struct settings *, const struct read_job *, struct frame_plan *);
/* Once the scene of a frame is read: the command line first, then the .ini file, then the defaults. After it,
 * output, size, crop and anti-aliasing are what is to be done. */
enum status settings_finish(struct settings *, const struct read_job *, struct diag *);
/* "800x600 crop 0,0,10,10 aa none": all options that decide the picture. */
void settings_describe(const struct settings *, char *out, size_t size);

#endif
