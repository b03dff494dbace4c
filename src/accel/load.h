/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Finding, checking and configuring accelerator plugins.
 */
#ifndef ALIDADE_ACCEL_LOAD_H
#define ALIDADE_ACCEL_LOAD_H

#include <stdbool.h>

#include "alidade/accel.h"
#include "base/diag.h"

#define ACCEL_PARAMS_MAX 32

struct accel_choice {
	const ald_accel_plugin *plugin;
	void *handle; /* of dlopen; NULL: built in */
	uint32_t precision; /* ALD_PRECISION_...; 0: the default one */
	char path[4096]; /* where it was found */
	double value[ACCEL_PARAMS_MAX];
	double rays; /* about how many will be traced; 0: not known */
	/* What is predicted to need more than the book's limit, or, if guard is set and it has none, than the
	 * machine has left, is not built. */
	bool guard;
	uint64_t later; /* bytes that are going to be wanted once it is built */
};

/* spec is NAME or NAME:key=value,key=value or ./path/file.so[:...]. NAME is searched in
 * $ALIDADE_ACCEL_PATH (colon-separated, ignored in a set-uid process), then in the installed folder.
 * Every refusal is reported with path and reason, as STATUS_ACCEL. */
enum status accel_load(struct accel_choice *, const char *spec, struct diag *);
void accel_unload(struct accel_choice *);
/* Ask it for ALD_PRECISION_...; refused, with the names of those that serve it, if it does not, and if its own
 * parameters make what should be exact inexact. */
enum status accel_set_precision(struct accel_choice *, uint32_t precision, struct diag *);
const char *accel_precision_name(uint32_t precision);
/* The first parameter that it says makes its answers inexact, and that is not its default; NULL: all are. */
const ald_param *accel_inexact(const struct accel_choice *);

/* Every plugin found on the search path, for --list-accels; a broken one is reported as a warning and
 * left out. visit's argument lives during the call only. */
enum status accel_list(void (*visit)(void *arg, const struct accel_choice *), void *arg, struct diag *);

/* "octree:depth=4,leaf=8", all parameters written out, as stored in pictures. */
int accel_describe(const struct accel_choice *, char *out, size_t size);

#endif
