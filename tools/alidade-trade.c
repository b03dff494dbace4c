/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * alidade-trade: what does each setting cost on this scene, and what does it gain? Options, messages and the
 * order of things; the work is in tools/trade.
 */
#include <config.h>

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/options.h"
#include "base/process.h"
#include "image/out.h"
#include "trade/trade.h"

enum {
	KEY_BUDGET = OPTION_LONG_ONLY, KEY_CHANGED, KEY_CLOCK, KEY_COMBINATIONS, KEY_CONFIRM, KEY_ERROR,
	KEY_FOLDER, KEY_FRESH, KEY_HTML, KEY_JSON, KEY_LIMIT, KEY_LINEAR, KEY_MAX_ERROR, KEY_MAX_TIME,
	KEY_PRINT_COMPLETION, KEY_PROGRAM, KEY_PROGRESS, KEY_REFERENCE, KEY_REFERENCE_OPTIONS, KEY_REPEAT,
	KEY_SWEEP, KEY_VERIFY, KEY_VERSION
};

static const struct option_spec trade_option[] = {
	{ "sweep", KEY_SWEEP, OPTION_ARG, "NAME=LEVELS", COMPLETE_WORDS, "accel precision aa indirect",
	  "measure these levels of an option of alidade, as in accel=box,octree:leaf=1/8; NAME alone: those "
	  "that it has by default; may be given again, and without it all defaults are swept",
	  "What is measured" },
	{ "combinations", KEY_COMBINATIONS, OPTION_ARG, "N", COMPLETE_NOTHING, NULL,
	  "try up to N settings that combine what was worth something alone; 16 is the default", NULL },
	{ "repeat", KEY_REPEAT, OPTION_ARG, "N", COMPLETE_NOTHING, NULL,
	  "measure each setting N times; 5 is the default", NULL },
	{ "budget", KEY_BUDGET, OPTION_ARG, "SECONDS", COMPLETE_NOTHING, NULL,
	  "measure for so long at most, without the reference; 600 is the default", NULL },
	{ "limit", KEY_LIMIT, OPTION_ARG, "SECONDS", COMPLETE_NOTHING, NULL,
	  "give up a setting whose picture takes longer; otherwise 10 times the default's", NULL },
	{ "folder", KEY_FOLDER, OPTION_ARG, "DIR", COMPLETE_DIR, NULL,
	  "keep results and the reference in DIR; otherwise the scene's name with -trade, in the current folder",
	  NULL },
	{ "fresh", KEY_FRESH, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "forget what that folder has of earlier runs", NULL },
	{ "program", KEY_PROGRAM, OPTION_ARG, "FILE", COMPLETE_FILE, NULL,
	  "the alidade to measure; otherwise the one beside this program", NULL },

	{ "reference", KEY_REFERENCE, OPTION_ARG, "FILE", COMPLETE_FILE, NULL,
	  "errors are against this picture, POV-Ray's for instance; otherwise against one of alidade's own with "
	  "the most accurate level of all that is swept",
	  "What is an error" },
	{ "reference-options", KEY_REFERENCE_OPTIONS, OPTION_ARG, "LEVEL", COMPLETE_NOTHING, NULL,
	  "options of alidade for that picture, as in aa=16+indirect-samples=8192", NULL },
	{ "linear", KEY_LINEAR, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "compare light, without limits; otherwise along the sRGB curve, within 0..1", NULL },
	{ "changed", KEY_CHANGED, OPTION_ARG, "VAL", COMPLETE_NOTHING, NULL,
	  "a pixel has changed if a colour differs by more than VAL; 1/255 is the default", NULL },
	{ "verify", KEY_VERIFY, OPTION_ARG, "N", COMPLETE_NOTHING, NULL,
	  "check one ray in N against exact arithmetic, once a setting; 16 is the default, 0 checks none", NULL },

	{ "max-error", KEY_MAX_ERROR, OPTION_ARG, "E", COMPLETE_NOTHING, NULL,
	  "recommend the fastest setting with an error of at most E", "Recommendations" },
	{ "max-time", KEY_MAX_TIME, OPTION_ARG, "SECONDS", COMPLETE_NOTHING, NULL,
	  "recommend the most accurate setting that takes at most SECONDS", NULL },
	{ "confirm", KEY_CONFIRM, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "draw what is recommended again, with other random numbers, and say whether its figures hold", NULL },
	{ "error", KEY_ERROR, OPTION_ARG, "WHICH", COMPLETE_WORDS, "rmse bias p99 max changed",
	  "the error that counts: rmse, bias, p99, max or changed; rmse is the default", NULL },
	{ "clock", KEY_CLOCK, OPTION_ARG, "WHICH", COMPLETE_WORDS, "process render cpu",
	  "the time that counts: process, render or cpu; process is the default", NULL },

	{ "json", KEY_JSON, OPTION_MAYBE_ARG, "FILE", COMPLETE_FILE, NULL,
	  "print JSON instead of text, or write it to FILE as well", "Reports" },
	{ "html", KEY_HTML, OPTION_ARG, "FILE", COMPLETE_FILE, NULL,
	  "write a page with a chart and a table", NULL },
	{ "progress", KEY_PROGRESS, OPTION_ARG, "HOW", COMPLETE_WORDS, "auto bar lines none",
	  "show progress as a bar, as lines, or not; auto takes a bar on a terminal and lines elsewhere", NULL },
	{ "quiet", 'q', OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "print errors and results only: no warnings, no progress", NULL },
	{ "verbose", 'v', OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL, "tell of each run", NULL },
	{ "help", 'h', OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL, "print this and exit", NULL },
	{ "version", KEY_VERSION, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "print the version and exit", NULL },
	{ "print-completion", KEY_PRINT_COMPLETION, OPTION_ARG, "SHELL", COMPLETE_NOTHING, NULL, NULL, NULL },
	{ 0 },
};

static const struct option_program program = {
	.name = "alidade-trade",
	.operands = "SCENE [-- option of alidade ...]",
	.summary = "Measure what settings of alidade cost and gain on a scene, and recommend some",
	.endings = "pov ini",
	.option = trade_option,
};

#define SWEEPS 64

struct run {
	struct trade trade;
	const char *sweep[SWEEPS], *completion;
	uint32_t sweeps;
	bool help, version;
	enum progress_mode mode;
	char program[TRADE_PATH];
};

static void print_message(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	struct run *run = arg;
	char line[4096];

	if ((int)level > run->trade.verbosity + 1)
		return;
	diag_format(line, sizeof(line), level, pos, text);
	progress_erase(&run->trade.progress);
	fprintf(stderr, "alidade-trade: %s\n", line);
}

static enum status wrong(struct diag *d, const struct option_spec *o, const char *value, const char *want)
{
	return diag_fail(d, STATUS_USAGE, NULL, "--%s=%s: expected %s", o->name, value, want);
}

static enum status set_count(const struct option_spec *o, const char *value, uint32_t min, uint32_t max,
			     uint32_t *out, struct diag *d)
{
	uint64_t n;

	if (!option_integer(value, min, max, &n))
		return diag_fail(d, STATUS_USAGE, NULL, "--%s=%s: expected a number from %u to %u", o->name, value,
				 min, max);
	*out = (uint32_t)n;
	return STATUS_OK;
}

static enum status set_seconds(const struct option_spec *o, const char *value, double *out, struct diag *d)
{
	return option_real(value, 1e-6, 1e9, out) ? STATUS_OK : wrong(d, o, value, "seconds above 0");
}

static enum status set_fraction(const struct option_spec *o, const char *value, double *out, struct diag *d)
{
	return option_fraction(value, 1e300, out) ? STATUS_OK :
						    wrong(d, o, value, "a number from 0 on, as in 0.004 or 1/255");
}

/* One of the option's words, and the value it stands for. */
static enum status set_which(const struct option_spec *o, const char *value, enum trade_value *out,
			     struct diag *d)
{
	static const struct {
		const char *word;
		enum trade_value value;
	} known[] = {
		{ "rmse", TRADE_RMSE }, { "bias", TRADE_BIAS }, { "p99", TRADE_P99 }, { "max", TRADE_MAX },
		{ "changed", TRADE_CHANGED }, { "process", TRADE_PROCESS }, { "render", TRADE_RENDER },
		{ "cpu", TRADE_CPU },
	};

	for (size_t i = 0; i < sizeof(known) / sizeof(*known); i++) {
		if (!strcmp(known[i].word, value) && (o->key == KEY_CLOCK) == (known[i].value < TRADE_RMSE)) {
			*out = known[i].value;
			return STATUS_OK;
		}
	}
	return wrong(d, o, value, o->words);
}

static enum status set_progress(struct run *run, const struct option_spec *o, const char *value, struct diag *d)
{
	static const struct {
		const char *word;
		enum progress_mode mode;
	} known[] = {
		{ "auto", PROGRESS_AUTO }, { "bar", PROGRESS_BAR }, { "lines", PROGRESS_LINES },
		{ "none", PROGRESS_NONE },
	};

	for (size_t i = 0; i < sizeof(known) / sizeof(*known); i++) {
		if (!strcmp(known[i].word, value)) {
			run->mode = known[i].mode;
			return STATUS_OK;
		}
	}
	return wrong(d, o, value, o->words);
}

static void set_text(struct run *run, int key, const char *value)
{
	struct trade *t = &run->trade;

	switch (key) {
	case KEY_FOLDER: t->folder = value; break;
	case KEY_PROGRAM: t->program = value; break;
	case KEY_REFERENCE: t->reference_file = value; break;
	case KEY_REFERENCE_OPTIONS: t->reference_options = value; break;
	case KEY_HTML: t->html = value; break;
	case KEY_JSON:
		t->want_json = true;
		t->json = value;
		break;
	case KEY_CONFIRM: t->confirm = true; break;
	case KEY_FRESH: t->fresh = true; break;
	case KEY_LINEAR: t->space = DIFF_LINEAR; break;
	case 'q': t->verbosity = -1; break;
	case 'v': t->verbosity = 1; break;
	case 'h': run->help = true; break;
	case KEY_VERSION: run->version = true; break;
	case KEY_PRINT_COMPLETION: run->completion = value; break;
	}
}

static enum status set_option(void *arg, const struct option_spec *o, const char *value, struct diag *d)
{
	struct run *run = arg;
	struct trade *t = &run->trade;

	switch (o->key) {
	case KEY_SWEEP:
		if (run->sweeps == SWEEPS)
			return wrong(d, o, value, "it at most 64 times");
		run->sweep[run->sweeps++] = value;
		return STATUS_OK;
	case KEY_COMBINATIONS: return set_count(o, value, 0, 500, &t->combinations, d);
	case KEY_REPEAT: return set_count(o, value, 1, 16, &t->repeat, d);
	case KEY_VERIFY: return set_count(o, value, 0, 1u << 30, &t->verify, d);
	case KEY_BUDGET: return set_seconds(o, value, &t->budget, d);
	case KEY_LIMIT: return set_seconds(o, value, &t->limit, d);
	case KEY_MAX_TIME: return set_seconds(o, value, &t->max_time, d);
	case KEY_MAX_ERROR: return set_fraction(o, value, &t->max_error, d);
	case KEY_CHANGED: return set_fraction(o, value, &t->changed, d);
	case KEY_ERROR: return set_which(o, value, &t->error, d);
	case KEY_CLOCK: return set_which(o, value, &t->clock, d);
	case KEY_PROGRESS: return set_progress(run, o, value, d);
	default:
		set_text(run, o->key, value);
		return STATUS_OK;
	}
}

static void init(struct run *run)
{
	struct trade *t = &run->trade;

	t->diag = (struct diag){ print_message, run, 0, 0 };
	mem_book_init(&t->book, 0);
	arena_init(&t->arena, &t->book, "trade");
	t->repeat = 5;
	t->combinations = 16;
	t->verify = 16;
	t->budget = 600;
	t->max_error = t->max_time = (double)NAN;
	t->clock = TRADE_PROCESS;
	t->error = TRADE_RMSE;
	t->space = DIFF_SRGB;
	t->changed = 1.0 / 255;
}

/* "path/NAME.pov" -> "NAME-trade" */
static const char *default_folder(struct trade *t)
{
	const char *slash = strrchr(t->scene, '/'), *name = slash ? slash + 1 : t->scene, *dot = strrchr(name, '.');

	return trade_text(t, "%.*s-trade", dot && dot != name ? (int)(dot - name) : (int)strlen(name), name);
}

/* $ALIDADE, or the program beside this one, or whichever the shell would find. */
static const char *find_program(struct run *run)
{
	const char *given = getenv("ALIDADE");
	ssize_t n;
	char *slash;

	if (given && *given)
		return given;
	n = readlink("/proc/self/exe", run->program, sizeof(run->program) - 1);
	if (n > 0) {
		run->program[n] = 0;
		slash = strrchr(run->program, '/');
		if (slash && (size_t)(slash + 9 - run->program) < sizeof(run->program)) {
			strcpy(slash + 1, "alidade");
			if (!access(run->program, X_OK))
				return run->program;
		}
	}
	return "alidade";
}

static enum status take_operands(struct run *run, char **operand, int count)
{
	struct trade *t = &run->trade;

	if (!count)
		return diag_fail(&t->diag, STATUS_USAGE, NULL,
				 "no scene given; usage: alidade-trade [option ...] SCENE [-- option of alidade ...]");
	t->scene = operand[0];
	if (count > 1 && *operand[1] != '-')
		return diag_fail(&t->diag, STATUS_USAGE, NULL, "one scene at a time: \"%s\" and \"%s\" were given",
				 operand[0], operand[1]);
	t->base = (const char **)(uintptr_t)(operand + 1);
	t->base_count = (uint32_t)(count - 1);
	if (!t->folder)
		t->folder = default_folder(t);
	if (!t->program)
		t->program = find_program(run);
	if (t->reference_file && t->reference_options)
		return diag_fail(&t->diag, STATUS_USAGE, NULL,
				 "--reference is a picture, --reference-options is how to draw one: one of them");
	return t->folder ? STATUS_OK : STATUS_FAILED;
}

/* One of our files, whole or not at all. */
static enum status write_report(struct trade *t, const char *path, const char *ending,
				bool (*report)(struct trade *, FILE *))
{
	struct image_out out;
	enum status st = image_out_open(&out, path, ending, &t->diag);

	if (st)
		return st;
	(void)report(t, out.file); /* a failed stream is found below */
	return image_out_finish(&out);
}

static enum status report(struct trade *t)
{
	enum status st = STATUS_OK, again;

	if (t->want_json && !t->json)
		(void)trade_json(t, stdout); /* main() looks at the stream */
	else
		trade_print(t, stdout);
	if (t->json)
		st = write_report(t, t->json, ".json", trade_json);
	if (t->html) {
		again = write_report(t, t->html, ".html", trade_html);
		st = st ? st : again;
	}
	return st;
}

static enum status sweep(struct run *run)
{
	struct trade *t = &run->trade;
	enum status st = STATUS_OK;

	if (!run->sweeps)
		st = trade_sweep_default(t);
	for (uint32_t i = 0; i < run->sweeps && !st; i++)
		st = trade_sweep(t, run->sweep[i]);
	return st;
}

/* A bound that was asked for and that nothing keeps is a budget that was missed. */
static enum status missed(const struct trade *t)
{
	for (uint32_t i = 0; i < t->verdicts; i++) {
		if (!t->verdict[i].ask.own && t->verdict[i].outcome == TRADE_NOTHING)
			return STATUS_BUDGET;
	}
	return STATUS_OK;
}

static enum status act(struct run *run)
{
	struct trade *t = &run->trade;
	size_t bytes = TRADE_SETTINGS * sizeof(*t->setting);
	enum status st, reported;

	interrupt_install();
	progress_init(&t->progress, t->verbosity < 0 ? PROGRESS_NONE : run->mode, stderr);
	t->setting = arena_zalloc(&t->arena, bytes);
	if (!t->setting)
		return diag_no_memory(&t->diag, "settings", bytes);
	st = trade_check_base(t);
	if (!st && t->json)
		st = image_out_check(t->json, &t->diag);
	if (!st && t->html)
		st = image_out_check(t->html, &t->diag);
	if (!st)
		st = trade_look(t);
	if (!st)
		st = sweep(run);
	if (!st)
		st = trade_store_open(t);
	if (!st)
		st = trade_reference_make(t);
	if (st)
		return st;
	st = trade_measure(t);
	if (st && st != STATUS_SIGINT)
		return st;
	if (st)
		fprintf(stderr, "alidade-trade: stopped; what was measured is in %s, and the same command goes on\n",
			t->results_name);
	reported = report(t);
	return st ? st : reported ? reported : missed(t);
}

/* The folder of pictures in the making, and what is in it. */
static void remove_work(struct trade *t)
{
	DIR *dir = t->work[0] ? opendir(t->work) : NULL;
	char path[TRADE_PATH + 300];
	struct dirent *e;

	while (dir && (e = readdir(dir))) {
		snprintf(path, sizeof(path), "%s/%s", t->work, e->d_name);
		if (strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0)
			unlink(path);
	}
	if (dir)
		closedir(dir);
	if (t->work[0])
		rmdir(t->work);
}

static void release(struct trade *t)
{
	if (t->results)
		fclose(t->results);
	remove_work(t);
	arena_release(&t->arena);
}

static enum status start(struct run *run, int argc, char **argv)
{
	struct trade *t = &run->trade;
	int operand;
	enum status st = options_parse(&program, argc, argv, set_option, run, &operand, &t->diag);

	if (st)
		return st;
	if (run->help) {
		options_help(&program, stdout);
	} else if (run->version) {
		printf("alidade-trade %s\n", PACKAGE_VERSION);
	} else if (run->completion) {
		if (!options_completion(&program, run->completion, stdout))
			return diag_fail(&t->diag, STATUS_USAGE, NULL,
					 "--print-completion=%s: expected bash, zsh or fish", run->completion);
	} else {
		st = take_operands(run, argv + operand, argc - operand);
		return st ? st : act(run);
	}
	return STATUS_OK;
}

int main(int argc, char **argv)
{
	struct run run = { 0 };
	int status;

	process_begin();
	init(&run);
	status = (int)start(&run, argc, argv);
	if (status == STATUS_SIGINT && interrupt_status())
		status = interrupt_status();
	release(&run.trade);
	if (fflush(stdout) || ferror(stdout)) {
		fprintf(stderr, "alidade-trade: error: standard output: %s\n", strerror(errno));
		status = status ? status : STATUS_FAILED;
	}
	return status;
}
