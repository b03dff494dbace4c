/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A plugin's table of parameters: is it sound, and what does "depth=4,leaf=8" mean by it.
 */
#ifndef ALIDADE_ACCEL_PARAM_H
#define ALIDADE_ACCEL_PARAM_H

#include <stdbool.h>

#include "accel/text.h"
#include "alidade/accel.h"
#include "base/diag.h"

/* A plugin's or parameter's name: [a-z][a-z0-9-]* in n bytes. */
bool param_name_ok(const char *s, size_t n);
/* NULL, or what is wrong with the table, with the parameter's name in *which. */
const char *param_table_fault(const ald_param *, const char **which);
/* text is "key=value,key=value" or NULL; value[] gets defaults first. where names the plugin. */
enum status param_parse(const ald_param *, const char *text, double *value, const char *where,
			struct diag *);
/* "4", "on" or a choice's name, as param_parse() reads it. */
void param_value_text(const ald_param *, double value, char *out, size_t size);
/* "1..64", "on or off", "auto, 16 or 32" */
void param_range_text(const ald_param *, char *out, size_t size);

#endif
