/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * alidade-diff: do two pictures show the same? Options, reading, printing; the comparing is
 * src/image/diff.c.
 */
#include <config.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/json_write.h"
#include "base/options.h"
#include "base/process.h"
#include "image/diff.h"
#include "image/image.h"
#include "image/out.h"

/* As idiff's. Wrong usage is 1 there, like a warning; a script that treats it as anything but 0 is
 * right. */
enum { EXIT_OK = 0, EXIT_WARN = 1, EXIT_USAGE = 1, EXIT_FAIL = 2, EXIT_UNLIKE = 3, EXIT_FILE = 4 };

enum {
	KEY_ALLOW_FAILURES = OPTION_LONG_ONLY,
	KEY_ALLOW_NONFINITE,
	KEY_CHANNELS,
	KEY_CROP,
	KEY_FAIL,
	KEY_FAIL_PERCENT,
	KEY_HARD_FAIL,
	KEY_HARD_WARN,
	KEY_JSON,
	KEY_LINEAR,
	KEY_MAX_MEAN,
	KEY_MAX_P99,
	KEY_MAX_RMSE,
	KEY_PRINT_COMPLETION,
	KEY_SCALE,
	KEY_SRGB,
	KEY_VERSION,
	KEY_WARN,
	KEY_WARN_PERCENT
};

static const struct option_spec diff_option[] = {
	{ "channels", KEY_CHANNELS, OPTION_ARG, "WHICH", COMPLETE_WORDS, "all rgb",
	  "all: both pictures must have the same channels; rgb: compare R, G and B alone; all is "
	  "the default",
	  "What is compared" },
	{ "crop", KEY_CROP, OPTION_ARG, "X,Y,W,H", COMPLETE_NOTHING, NULL,
	  "only this part of both: left, top, width, height in pixels", NULL },
	{ "linear", KEY_LINEAR, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "compare light, without limits, whatever the files hold", NULL },
	{ "srgb", KEY_SRGB, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "compare along the sRGB curve, clamped to 0..1, whatever the files hold; the default "
	  "unless both hold "
	  "light",
	  NULL },

	{ "fail", KEY_FAIL, OPTION_ARG, "VAL", COMPLETE_NOTHING, NULL,
	  "a pixel fails if a channel differs by more than VAL, a number or a fraction as 1/255; "
	  "1e-6 is the "
	  "default",
	  "Thresholds" },
	{ "failpercent", KEY_FAIL_PERCENT, OPTION_ARG, "PERCENT", COMPLETE_NOTHING, NULL,
	  "failure if more than this share of the pixels fails; 0 is the default", NULL },
	{ "hardfail", KEY_HARD_FAIL, OPTION_ARG, "VAL", COMPLETE_NOTHING, NULL,
	  "failure if any channel of any pixel differs by more than VAL", NULL },
	{ "allowfailures", KEY_ALLOW_FAILURES, OPTION_ARG, "N", COMPLETE_NOTHING, NULL,
	  "N pixels may fail or warn by any amount", NULL },
	{ "warn", KEY_WARN, OPTION_ARG, "VAL", COMPLETE_NOTHING, NULL,
	  "a pixel warns if a channel differs by more than VAL; 1e-6, where any pixel fails, is "
	  "the default",
	  NULL },
	{ "warnpercent", KEY_WARN_PERCENT, OPTION_ARG, "PERCENT", COMPLETE_NOTHING, NULL,
	  "warning if more than this share of the pixels warns; 0 is the default", NULL },
	{ "hardwarn", KEY_HARD_WARN, OPTION_ARG, "VAL", COMPLETE_NOTHING, NULL,
	  "warning if any channel of any pixel differs by more than VAL", NULL },
	{ "max-mean", KEY_MAX_MEAN, OPTION_ARG, "VAL", COMPLETE_NOTHING, NULL,
	  "failure if the mean signed error, of all or of one channel, is beyond VAL either way",
	  NULL },
	{ "max-rmse", KEY_MAX_RMSE, OPTION_ARG, "VAL", COMPLETE_NOTHING, NULL,
	  "failure if the root mean square error is above VAL", NULL },
	{ "max-p99", KEY_MAX_P99, OPTION_ARG, "VAL", COMPLETE_NOTHING, NULL,
	  "failure if 99 % of the pixels do not stay within VAL", NULL },
	{ "allow-nonfinite", KEY_ALLOW_NONFINITE, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "NaN and infinity are no failure where both pictures have the same", NULL },

	{ "output", 'o', OPTION_ARG, "FILE", COMPLETE_FILE, NULL,
	  "write a picture of the absolute differences, magenta where a sample is not finite",
	  "Reports" },
	{ "scale", KEY_SCALE, OPTION_ARG, "FACTOR", COMPLETE_NOTHING, NULL,
	  "multiply the differences in that picture; 20 is the default", NULL },
	{ "json", KEY_JSON, OPTION_MAYBE_ARG, "FILE", COMPLETE_FILE, NULL,
	  "print the figures as JSON instead of text, or write them to FILE as well", NULL },
	{ "quiet", 'q', OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "print nothing but errors; the exit status tells", NULL },
	{ "help", 'h', OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL, "print this and exit", NULL },
	{ "version", KEY_VERSION, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "print the version and exit", NULL },
	{ "print-completion", KEY_PRINT_COMPLETION, OPTION_ARG, "SHELL", COMPLETE_NOTHING, NULL,
	  NULL, NULL },
	{ 0 },
};

static const struct option_program program = {
	.name = "alidade-diff",
	.operands = "A B",
	.summary = "Compare two pictures and say how and where B differs from A",
	.endings = "png exr ppm pfm",
	.option = diff_option,
};

struct settings {
	struct diff_options diff;
	const char *output, *json, *completion;
	bool want_json, quiet, help, version;
};

static void print_message(void *arg, enum diag_level level, const struct diag_pos *pos,
			  const char *text)
{
	const struct settings *s = arg;
	char line[4096];

	if (s->quiet && level != DIAG_ERROR)
		return;
	diag_format(line, sizeof(line), level, pos, text);
	fprintf(stderr, "alidade-diff: %s\n", line);
}

static enum status wrong(struct diag *d, const struct option_spec *o, const char *value,
			 const char *want)
{
	return diag_fail(d, STATUS_USAGE, NULL, "--%s=%s: expected %s", o->name, value, want);
}

static bool set_crop(struct diff_options *d, const char *value)
{
	uint32_t *to[] = { &d->crop_x, &d->crop_y, &d->crop_width, &d->crop_height };
	const char *cursor = value;
	struct option_pair pair;
	uint64_t n;
	int i;

	for (i = 0; option_next_pair(&cursor, &pair); i++) {
		if (i == 4 || !option_integer(pair.key, i < 2 ? 0 : 1, INT32_MAX, &n))
			return false;
		*to[i] = (uint32_t)n;
	}
	return i == 4;
}

/* The number that an option sets, NULL if it is another kind. */
static double *threshold_of(struct diff_options *d, int key)
{
	switch (key) {
	case KEY_FAIL: return &d->fail;
	case KEY_FAIL_PERCENT: return &d->fail_percent;
	case KEY_HARD_FAIL: return &d->hard_fail;
	case KEY_WARN: return &d->warn;
	case KEY_WARN_PERCENT: return &d->warn_percent;
	case KEY_HARD_WARN: return &d->hard_warn;
	case KEY_MAX_MEAN: return &d->max_mean;
	case KEY_MAX_RMSE: return &d->max_rms;
	case KEY_MAX_P99: return &d->max_p99;
	case KEY_SCALE: return &d->scale;
	default: return NULL;
	}
}

static enum status set_option(void *arg, const struct option_spec *o, const char *value,
			      struct diag *d)
{
	struct settings *s = arg;
	double *threshold = threshold_of(&s->diff, o->key);

	if (threshold) {
		if (!option_fraction(value,
			    o->key == KEY_FAIL_PERCENT || o->key == KEY_WARN_PERCENT ? 100 : 1e300,
			    threshold))
			return wrong(d, o, value, "a number from 0 on, as in 0.004 or 1/255");
		if (o->key == KEY_WARN || o->key == KEY_WARN_PERCENT || o->key == KEY_HARD_WARN)
			s->diff.warn_always = true;
		return STATUS_OK;
	}
	switch (o->key) {
	case KEY_CHANNELS:
		s->diff.rgb_only = !strcmp(value, "rgb");
		return s->diff.rgb_only || !strcmp(value, "all") ? STATUS_OK
								 : wrong(d, o, value, "all or rgb");
	case KEY_CROP:
		return set_crop(&s->diff, value)
			       ? STATUS_OK
			       : wrong(d, o, value, "X,Y,W,H in pixels, as in 0,0,64,48");
	case KEY_ALLOW_FAILURES:
		return option_integer(value, 0, UINT64_MAX, &s->diff.allow_failures) ?
			       STATUS_OK :
			       wrong(d, o, value, "a number of pixels");
	case KEY_LINEAR: s->diff.space = DIFF_LINEAR; break;
	case KEY_SRGB: s->diff.space = DIFF_SRGB; break;
	case KEY_ALLOW_NONFINITE: s->diff.allow_nonfinite = true; break;
	case 'o': s->output = value; break;
	case KEY_JSON:
		s->want_json = true;
		s->json = value;
		break;
	case 'q': s->quiet = true; break;
	case 'h': s->help = true; break;
	case KEY_VERSION: s->version = true; break;
	case KEY_PRINT_COMPLETION: s->completion = value; break;
	}
	return STATUS_OK;
}

/* idiff writes its long options with one dash: -fail is --fail. What was changed is kept in memory
 * of its own until the program ends. */
static bool double_dashes(int argc, char **argv)
{
	for (int i = 1; i < argc && strcmp(argv[i], "--"); i++) {
		for (const struct option_spec *o = diff_option; o->name; o++) {
			size_t n = strlen(o->name);
			char *word;

			if (argv[i][0] != '-' || strncmp(argv[i] + 1, o->name, n) ||
			    (argv[i][1 + n] && argv[i][1 + n] != '='))
				continue;
			word = malloc(strlen(argv[i]) + 2);
			if (!word)
				return false;
			sprintf(word, "-%s", argv[i]);
			argv[i] = word;
			break;
		}
	}
	return true;
}

static int file_failed(const char *path)
{
	fprintf(stderr, "alidade-diff: %s: error: cannot write: %s\n", path, strerror(errno));
	return EXIT_FILE;
}

/* The figures to a file or to standard output. */
static int report(const struct settings *s, const struct diff_result *r, char **name,
		  struct diag *diag)
{
	struct image_out out;
	struct json_writer json;

	if (s->want_json && s->json) {
		if (image_out_open(&out, s->json, ".json", diag))
			return EXIT_FILE;
		jw_init(&json, out.file, JW_INDENT);
		diff_json(r, &s->diff, name[0], name[1], &json);
		(void)jw_finish(&json); /* a failed stream is found below */
		if (image_out_finish(&out))
			return EXIT_FILE;
	}
	errno = 0;
	if (s->want_json && !s->json) {
		jw_init(&json, stdout, JW_INDENT);
		diff_json(r, &s->diff, name[0], name[1], &json);
		if (!jw_finish(&json))
			return file_failed("standard output");
	} else if (!s->quiet) {
		diff_print(r, &s->diff, name[0], name[1], stdout);
	}
	return fflush(stdout) || ferror(stdout) ? file_failed("standard output") : EXIT_OK;
}

static int compare(const struct settings *s, char **name, struct diag *diag)
{
	struct image image[2] = { 0 }, picture = { 0 };
	struct diff_result r;
	struct mem_book book;
	enum status st;
	int code = EXIT_FILE;

	mem_book_init(&book, 0);
	if (image_read(&image[0], name[0], &book, NULL, diag) ||
	    image_read(&image[1], name[1], &book, NULL, diag))
		goto out;
	st = image_diff(&image[0], &image[1], &s->diff, &r, s->output ? &picture : NULL, &book,
			diag);
	if (st) {
		code = st == STATUS_USAGE ? EXIT_USAGE : EXIT_FILE;
		goto out;
	}
	code = report(s, &r, name, diag);
	if (!code)
		code = (int)r.verdict;
	/* What is shown is the difference itself: no curve is laid over it. */
	picture.encoding = s->output ? image_file_encoding(s->output) : IMAGE_LINEAR;
	if (picture.pixel && image_write(&picture, s->output, 0, NULL, 0, NULL, diag))
		code = EXIT_FILE;
out:
	image_release(&image[0]);
	image_release(&image[1]);
	image_release(&picture);
	return code;
}

int main(int argc, char **argv)
{
	struct settings s = { 0 };
	struct diag diag = { .sink = print_message, .arg = &s };
	int operand;

	process_begin();
	diff_options_init(&s.diff);
	if (!double_dashes(argc, argv) ||
	    options_parse(&program, argc, argv, set_option, &s, &operand, &diag))
		return EXIT_USAGE;
	if (s.help) {
		options_help(&program, stdout);
	} else if (s.version) {
		printf("alidade-diff %s\n", PACKAGE_VERSION);
	} else if (s.completion) {
		if (!options_completion(&program, s.completion, stdout)) {
			diag_report(&diag, DIAG_ERROR, NULL,
				    "completion is made for bash, zsh and fish");
			return EXIT_USAGE;
		}
	} else if (argc - operand != 2) {
		diag_report(&diag, DIAG_ERROR, NULL,
			    "two pictures are compared, and %d were named; see --help",
			    argc - operand);
		return EXIT_USAGE;
	} else {
		return compare(&s, argv + operand, &diag);
	}
	return fflush(stdout) || ferror(stdout) ? file_failed("standard output") : EXIT_OK;
}
