/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Command lines from one table: parsing, --help and the shells' completion files are all made from it,
 * and a test holds the man page against it, so that none of them can name an option that is not there.
 */
#ifndef ALIDADE_BASE_OPTIONS_H
#define ALIDADE_BASE_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/diag.h"

enum option_arg { OPTION_ALONE, OPTION_ARG, OPTION_MAYBE_ARG };

/* What a shell offers for the argument. */
enum option_complete { COMPLETE_NOTHING, COMPLETE_FILE, COMPLETE_DIR, COMPLETE_WORDS, COMPLETE_ACCEL };

#define OPTION_LONG_ONLY 256 /* keys from here on have no letter */

struct option_spec {
	const char *name; /* long, without dashes */
	int key; /* its letter, or a number from OPTION_LONG_ONLY */
	enum option_arg takes;
	const char *arg; /* how help and man page call the argument: "FILE" */
	enum option_complete complete;
	const char *words; /* COMPLETE_WORDS: separated by spaces; else NULL */
	const char *help; /* one sentence without a stop; NULL: a hidden option or a synonym */
	const char *group; /* heading of the help, where a new one starts; else NULL */
};

struct option_program {
	const char *name, *operands; /* "alidade", "SCENE" */
	const char *summary; /* one sentence */
	const char *endings; /* of the operands' files, for completion: "pov ini"; NULL: any file */
	const struct option_spec *option; /* ends with a NULL name */
};

/* Called for every option in the order given; value is NULL where there is none. */
typedef enum status option_set(void *arg, const struct option_spec *, const char *value, struct diag *);

/* Returns the first status that is not STATUS_OK; *operand is the index of the first operand in argv,
 * which is permuted. Not reentrant: it uses getopt_long(). */
enum status options_parse(const struct option_program *, int argc, char **argv, option_set *, void *arg,
			  int *operand, struct diag *);

void options_help(const struct option_program *, FILE *out);
/* The completion file for "bash", "zsh" or "fish"; false: no such shell. */
bool options_completion(const struct option_program *, const char *shell, FILE *out);

/* Values. All of them refuse empty text, trailing text, and what is out of range. */
bool option_integer(const char *text, uint64_t min, uint64_t max, uint64_t *out);
bool option_real(const char *text, double min, double max, double *out);
bool option_fraction(const char *text, double max, double *out); /* from 0: 0.004, 1/255 */
bool option_bytes(const char *text, uint64_t *out); /* 512, 512K, 2M, 3.5G, 1T; powers of 1024 */
bool option_extent(const char *text, uint32_t max, uint32_t *width, uint32_t *height); /* 640x480 */

/* key=value,key=value: takes the next pair off *cursor; false at the end. A pair without = has an empty
 * value. What does not fit is cut off. */
struct option_pair {
	char key[64], value[64];
};
bool option_next_pair(const char **cursor, struct option_pair *);

#endif
