/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include <config.h>

#include "base/options.h"

#include <ctype.h>
#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define OPTIONS_MAX 96
#define HELP_COLUMN 28
#define HELP_WIDTH 80

static size_t count_options(const struct option_program *p)
{
	size_t n = 0;

	while (p->option[n].name)
		n++;
	return n < OPTIONS_MAX ? n : OPTIONS_MAX;
}

static const struct option_spec *find_key(const struct option_program *p, int key)
{
	for (const struct option_spec *o = p->option; o->name; o++) {
		if (o->key == key)
			return o;
	}
	return NULL;
}

/* Letters wrong, missing, added or exchanged between two short words: the restricted
 * Damerau-Levenshtein distance, three rows at a time. */
static unsigned distance(const char *a, const char *b)
{
	unsigned row[3][32] = { 0 };
	size_t la = strlen(a), lb = strlen(b);

	if (la > 31 || lb > 31)
		return 99;
	for (size_t j = 0; j <= lb; j++)
		row[0][j] = (unsigned)j;
	for (size_t i = 1; i <= la; i++) {
		unsigned *now = row[i % 3], *last = row[(i + 2) % 3], *before = row[(i + 1) % 3];

		now[0] = (unsigned)i;
		for (size_t j = 1; j <= lb; j++) {
			unsigned d = last[j - 1] + (a[i - 1] != b[j - 1]);

			d = last[j] + 1 < d ? last[j] + 1 : d;
			d = now[j - 1] + 1 < d ? now[j - 1] + 1 : d;
			if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] &&
			    before[j - 2] + 1 < d)
				d = before[j - 2] + 1;
			now[j] = d;
		}
	}
	return row[la % 3][lb];
}

static enum status unknown(const struct option_program *p, const char *given, struct diag *d)
{
	const char *best = NULL;
	unsigned near = 3, starts = 0;
	char word[32];
	size_t length;

	if (strncmp(given, "--", 2))
		return diag_fail(d, STATUS_USAGE, NULL, "there is no option -%c; see %s --help",
				 optopt, p->name);
	length = strcspn(given + 2, "=");
	snprintf(word, sizeof(word), "%.*s", (int)length, given + 2);
	for (const struct option_spec *o = p->option; o->name; o++) {
		unsigned n = o->help ? distance(word, o->name) : 99;

		starts += !strncmp(word, o->name, strlen(word));
		if (n < near) {
			near = n;
			best = o->name;
		}
	}
	if (starts > 1)
		return diag_fail(d, STATUS_USAGE, NULL, "--%s could be one of %u options; see %s --help",
				 word, starts, p->name);
	if (best)
		return diag_fail(d, STATUS_USAGE, NULL, "there is no option --%s; did you mean --%s?",
				 word, best);
	return diag_fail(d, STATUS_USAGE, NULL, "there is no option %.*s; see %s --help",
			 (int)length + 2, given, p->name);
}

static enum status refuse(const struct option_program *p, int c, const char *given, struct diag *d)
{
	const struct option_spec *o = optopt ? find_key(p, optopt) : NULL;

	if (!o)
		return unknown(p, given, d);
	if (c == ':')
		return diag_fail(d, STATUS_USAGE, NULL, "option %s needs a value: --%s=%s", given,
				 o->name, o->arg ? o->arg : "VALUE");
	return diag_fail(d, STATUS_USAGE, NULL, "option --%s takes no value", o->name);
}

enum status options_parse(const struct option_program *p, int argc, char **argv, option_set *set, void *arg,
			  int *operand, struct diag *d)
{
	static const int has_arg[] = { no_argument, required_argument, optional_argument };
	struct option list[OPTIONS_MAX + 1] = { 0 };
	char letters[3 * OPTIONS_MAX + 2] = ":", *l = letters + 1;
	size_t n = count_options(p);
	int c, index = -1;

	for (size_t i = 0; i < n; i++) {
		const struct option_spec *o = &p->option[i];

		list[i] = (struct option){ o->name, has_arg[o->takes], NULL, o->key };
		if (o->key < OPTION_LONG_ONLY) {
			*l++ = (char)o->key;
			for (int k = 0; k < (int)o->takes; k++)
				*l++ = ':';
		}
	}
	*l = 0;
	optind = 0; /* glibc: start afresh */
	opterr = 0;
	for (;;) {
		const struct option_spec *o;
		enum status st;

		index = -1;
		c = getopt_long(argc, argv, letters, list, &index);
		if (c < 0)
			break;
		if (c == '?' || c == ':')
			return refuse(p, c, argv[optind - 1], d);
		o = index >= 0 ? &p->option[index] : find_key(p, c);
		st = set(arg, o, optarg, d);
		if (st)
			return st;
	}
	*operand = optind;
	return STATUS_OK;
}

/* Prints text from the given column on, broken at spaces. */
static void wrap(FILE *out, const char *text, size_t column)
{
	size_t at = column;

	while (*text) {
		size_t word = strcspn(text, " ");

		if (at > HELP_COLUMN && at + word > HELP_WIDTH) {
			fprintf(out, "\n%*s", HELP_COLUMN, "");
			at = HELP_COLUMN;
		}
		fprintf(out, "%.*s", (int)word, text);
		at += word;
		text += word;
		if (*text == ' ') {
			text++;
			if (at + 1 + strcspn(text, " ") <= HELP_WIDTH)
				fputc(' ', out);
			at++;
		}
	}
	fputc('\n', out);
}

void options_help(const struct option_program *p, FILE *out)
{
	fprintf(out, "Usage: %s [option ...] %s\n%s.\n", p->name, p->operands, p->summary);
	for (const struct option_spec *o = p->option; o->name; o++) {
		char left[96];
		int n;

		if (o->group)
			fprintf(out, "\n%s:\n", o->group);
		if (!o->help)
			continue;
		n = o->key < OPTION_LONG_ONLY ? snprintf(left, sizeof(left), "  -%c, --%s", o->key, o->name)
					      : snprintf(left, sizeof(left), "      --%s", o->name);
		if (o->takes)
			n += snprintf(left + n, sizeof(left) - (size_t)n,
				      o->takes == OPTION_ARG ? "=%s" : "[=%s]", o->arg);
		if (n + 2 > HELP_COLUMN)
			fprintf(out, "%s\n%*s", left, HELP_COLUMN, "");
		else
			fprintf(out, "%-*s", HELP_COLUMN, left);
		wrap(out, o->help, HELP_COLUMN);
	}
}

bool option_integer(const char *text, uint64_t min, uint64_t max, uint64_t *out)
{
	unsigned long long v;
	char *end;

	if (!isdigit((unsigned char)*text))
		return false;
	errno = 0;
	v = strtoull(text, &end, 10);
	if (errno || *end || v < min || v > max)
		return false;
	*out = v;
	return true;
}

bool option_real(const char *text, double min, double max, double *out)
{
	char *end;
	double v;

	if (!*text || isspace((unsigned char)*text))
		return false;
	v = strtod(text, &end);
	if (*end || !isfinite(v) || v < min || v > max)
		return false;
	*out = v;
	return true;
}

bool option_fraction(const char *text, double max, double *out)
{
	const char *slash = strchr(text, '/');
	char left[32];
	double below;

	if (!slash)
		return option_real(text, 0, max, out);
	if ((size_t)(slash - text) >= sizeof(left))
		return false;
	snprintf(left, sizeof(left), "%.*s", (int)(slash - text), text);
	if (!option_real(left, 0, max, out) || !option_real(slash + 1, 1e-300, max, &below))
		return false;
	*out /= below;
	return isfinite(*out);
}

bool option_bytes(const char *text, uint64_t *out)
{
	static const char unit[] = "KMGT";
	double v, scale = 1;
	const char *u;
	char *end;

	if (!isdigit((unsigned char)*text))
		return false;
	v = strtod(text, &end);
	if (*end) {
		u = strchr(unit, toupper((unsigned char)*end));
		if (!u || end[1])
			return false;
		scale = ldexp(1.0, 10 * (int)(u - unit + 1));
	}
	v *= scale;
	if (!(v < 0x1p63))
		return false;
	*out = (uint64_t)v;
	return true;
}

bool option_extent(const char *text, uint32_t max, uint32_t *width, uint32_t *height)
{
	const char *x = strpbrk(text, "xX");
	uint64_t w, h;
	char left[16];

	if (!x || x - text >= (ptrdiff_t)sizeof(left))
		return false;
	snprintf(left, sizeof(left), "%.*s", (int)(x - text), text);
	if (!option_integer(left, 1, max, &w) || !option_integer(x + 1, 1, max, &h))
		return false;
	*width = (uint32_t)w;
	*height = (uint32_t)h;
	return true;
}

bool option_next_pair(const char **cursor, struct option_pair *pair)
{
	const char *s = *cursor;
	size_t length, key;

	if (!s || !*s)
		return false;
	length = strcspn(s, ",");
	key = strcspn(s, "=,");
	snprintf(pair->key, sizeof(pair->key), "%.*s", (int)key, s);
	pair->value[0] = 0;
	if (s[key] == '=')
		snprintf(pair->value, sizeof(pair->value), "%.*s", (int)(length - key - 1), s + key + 1);
	*cursor = s + length + (s[length] == ',');
	return true;
}
