/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A file that appears whole or not at all.
 *
 * It is written under a temporary name in the folder of its final place, synced, closed and
 * renamed. What is no regular file (a pipe, a device, "-" for standard output) is written to
 * directly.
 */
#ifndef ALIDADE_IMAGE_OUT_H
#define ALIDADE_IMAGE_OUT_H

#include <stdbool.h>
#include <stdio.h>

#include "base/diag.h"

struct image_out {
	const char *path; /* as the caller named it */
	FILE *file;
	char *final; /* links followed; NULL: written directly */
	char *temporary;
	bool standard; /* standard output */
	struct diag *diag;
};

/* Can a file be made there, or replaced? Makes none. */
enum status image_out_check(const char *path, struct diag *);
/* ending: of the temporary name, with its dot, may be "". path must outlive the call of finish or
 * drop. */
enum status image_out_open(struct image_out *, const char *path, const char *ending, struct diag *);
/* What went wrong with the stream, by errno. */
enum status image_out_failed(struct image_out *);
/* Done: puts the file in its place. On failure nothing is left behind and the old file is as it
 * was. */
enum status image_out_finish(struct image_out *);
void image_out_drop(struct image_out *);

#endif
