/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "accel/param.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accel/load.h"

#define EXACT_INT 9007199254740992.0 /* 2^53 */

bool param_name_ok(const char *s, size_t n)
{
	if (!n || n > 64 || s[0] < 'a' || s[0] > 'z')
		return false;
	for (size_t i = 1; i < n; i++) {
		if (!(s[i] >= 'a' && s[i] <= 'z') && !(s[i] >= '0' && s[i] <= '9') && s[i] != '-')
			return false;
	}
	return true;
}

static uint32_t label_count(const ald_param *p)
{
	uint32_t n = 0;

	while (n < 1024 && p->label[n])
		n++;
	return n;
}

static const char *one_fault(const ald_param *p)
{
	if (!param_name_ok(p->name, strlen(p->name)))
		return "its name is not of the form [a-z][a-z0-9-]*";
	if (!p->help)
		return "it has no help text";
	if (p->type < ALD_BOOL || p->type > ALD_CHOICE)
		return "its type is unknown";
	if (!isfinite(p->def) || !isfinite(p->min) || !isfinite(p->max))
		return "its range is not finite";
	if (!(p->min <= p->def && p->def <= p->max))
		return "its default is outside its range";
	if (p->type == ALD_REAL)
		return NULL;
	if (p->def != floor(p->def) || p->min != floor(p->min) || p->max != floor(p->max) ||
	    fabs(p->min) > EXACT_INT || fabs(p->max) > EXACT_INT)
		return "its range is not of whole numbers up to 2^53";
	if (p->type == ALD_BOOL && (p->min != 0 || p->max != 1))
		return "a boolean's range must be 0 to 1";
	if (p->type == ALD_CHOICE &&
	    (!p->label || p->min != 0 || p->max + 1 != (double)label_count(p)))
		return "its range does not match its labels";
	return NULL;
}

const char *param_table_fault(const ald_param *table, const char **which)
{
	const char *fault;

	*which = "";
	for (uint32_t i = 0; table && table[i].name; i++) {
		*which = table[i].name;
		if (i == ACCEL_PARAMS_MAX)
			return "there are too many";
		fault = one_fault(&table[i]);
		for (uint32_t j = 0; j < i && !fault; j++) {
			if (!strcmp(table[i].name, table[j].name))
				fault = "its name is there twice";
		}
		if (fault)
			return fault;
	}
	return NULL;
}

void param_value_text(const ald_param *p, double value, char *out, size_t size)
{
	if (p->type == ALD_BOOL)
		snprintf(out, size, "%s", value != 0 ? "on" : "off");
	else if (p->type == ALD_CHOICE)
		snprintf(out, size, "%s", p->label[(uint32_t)value]);
	else if (p->type == ALD_INT)
		snprintf(out, size, "%.0f", value);
	else {
		/* The shortest that reads back as the same number. */
		for (int digits = 6; digits <= 17; digits++) {
			snprintf(out, size, "%.*g", digits, value);
			if (strtod(out, NULL) == value)
				break;
		}
	}
}

void param_range_text(const ald_param *p, char *out, size_t size)
{
	char lo[40], hi[40];
	uint32_t n;
	int used = 0;

	if (p->type == ALD_BOOL) {
		snprintf(out, size, "on or off");
		return;
	}
	if (p->type != ALD_CHOICE) {
		param_value_text(p, p->min, lo, sizeof(lo));
		param_value_text(p, p->max, hi, sizeof(hi));
		snprintf(out, size, "%s..%s", lo, hi);
		return;
	}
	n = label_count(p);
	for (uint32_t i = 0; i < n && used >= 0 && (size_t)used < size; i++)
		used += snprintf(out + used, size - (size_t)used, "%s%s",
				 !i ? "" : i + 1 == n ? " or " : ", ", p->label[i]);
}

static bool read_number(const char *s, double *out)
{
	char *end;

	/* strtod() would also take nan, inf and 0x1p3. */
	if (!*s || s[strspn(s, "+-.0123456789eE")])
		return false;
	*out = strtod(s, &end);
	return !*end && isfinite(*out);
}

static bool read_value(const ald_param *p, const char *s, double *out)
{
	static const char *const word[] = { "off", "on", "no", "yes", "false", "true", "0", "1" };

	if (p->type == ALD_BOOL) {
		for (unsigned i = 0; i < 8; i++) {
			if (!strcmp(s, word[i])) {
				*out = i % 2;
				return true;
			}
		}
		return false;
	}
	if (p->type == ALD_CHOICE) {
		for (uint32_t i = 0; p->label[i]; i++) {
			if (!strcmp(s, p->label[i])) {
				*out = i;
				return true;
			}
		}
		return false;
	}
	if (!read_number(s, out) || *out < p->min || *out > p->max)
		return false;
	return p->type != ALD_INT || *out == floor(*out);
}

static void list_params(const ald_param *table, struct text *t)
{
	char range[256];

	for (uint32_t i = 0; table && table[i].name; i++) {
		param_range_text(&table[i], range, sizeof(range));
		text_add(t, "%s%s (%s)", i ? ", " : "", table[i].name, range);
	}
}

static enum status unknown_key(const ald_param *table, const char *key, const char *where,
			       struct diag *d)
{
	struct text t = { 0 };

	for (uint32_t i = 0; table && table[i].name; i++) {
		if (text_alike(key, table[i].name)) {
			text_add(&t, "Did you mean '%s'? ", table[i].name);
			break;
		}
	}
	if (!table || !table[0].name) {
		text_add(&t, "It takes none.");
	} else {
		text_add(&t, "It takes ");
		list_params(table, &t);
		text_add(&t, ".");
	}
	return diag_fail(d, STATUS_ACCEL, NULL, "accelerator '%s' has no parameter '%s'. %s", where, key,
			 t.s);
}

static enum status set_one(const ald_param *table, char *item, double *value, bool *seen,
			   const char *where, struct diag *d)
{
	char *eq = strchr(item, '=');
	char range[256];
	uint32_t i = 0;

	if (!eq || eq == item)
		return diag_fail(d, STATUS_ACCEL, NULL,
				 "accelerator '%s': '%s' is not of the form KEY=VALUE", where, item);
	*eq = 0;
	while (table && table[i].name && strcmp(table[i].name, item))
		i++;
	if (!table || !table[i].name)
		return unknown_key(table, item, where, d);
	if (seen[i])
		return diag_fail(d, STATUS_ACCEL, NULL,
				 "accelerator '%s': parameter '%s' is given twice", where, item);
	seen[i] = true;
	if (read_value(&table[i], eq + 1, &value[i]))
		return STATUS_OK;
	param_range_text(&table[i], range, sizeof(range));
	return diag_fail(d, STATUS_ACCEL, NULL, "accelerator '%s': %s=%s is refused; %s is %s%s (%s)",
			 where, item, eq + 1, item, table[i].type == ALD_INT ? "a whole number " : "",
			 range, table[i].help);
}

enum status param_parse(const ald_param *table, const char *text, double *value, const char *where,
			struct diag *d)
{
	bool seen[ACCEL_PARAMS_MAX] = { false };
	char copy[1024];
	char *item, *next;
	enum status st = STATUS_OK;

	for (uint32_t i = 0; table && table[i].name; i++)
		value[i] = table[i].def;
	if (!text)
		return STATUS_OK;
	if (strlen(text) >= sizeof(copy))
		return diag_fail(d, STATUS_ACCEL, NULL,
				 "accelerator '%s': more than %zu bytes of parameters", where,
				 sizeof(copy) - 1);
	strcpy(copy, text);
	for (item = copy; item && !st; item = next) {
		next = strchr(item, ',');
		if (next)
			*next++ = 0;
		st = set_one(table, item, value, seen, where, d);
	}
	return st;
}
