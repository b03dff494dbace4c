/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * try SPEC: load an accelerator and say what came of it. try --list: all that are found. After each load
 * the arithmetic has to be what it was: rounding, and denormal numbers.
 */
#include <fenv.h>
#include <float.h>
#include <stdio.h>
#include <string.h>

#include "accel/load.h"

static void print_text(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	char line[2304];

	diag_format(line, sizeof(line), level, pos, text);
	fprintf(arg, "%s\n", line);
}

static void print_choice(void *arg, const struct accel_choice *c)
{
	char text[512];

	accel_describe(c, text, sizeof(text));
	fprintf(arg, "%s\n", text);
}

static int arithmetic_kept(void)
{
	volatile double tiny = DBL_MIN;

	tiny = tiny / 4;
	return fegetround() == FE_TONEAREST && tiny > 0;
}

int main(int argc, char **argv)
{
	struct diag d = { .sink = print_text, .arg = stderr };
	struct accel_choice c;
	enum status st;

	if (argc != 2) {
		fprintf(stderr, "usage: try SPEC | --list\n");
		return 2;
	}
	if (!strcmp(argv[1], "--list")) {
		st = accel_list(print_choice, stdout, &d);
	} else {
		st = accel_load(&c, argv[1], &d);
		if (!st) {
			print_choice(stdout, &c);
			accel_unload(&c);
		}
	}
	if (!arithmetic_kept()) {
		fprintf(stderr, "the arithmetic was changed\n");
		return 99;
	}
	return (int)st;
}
