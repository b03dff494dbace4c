/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What alidade-trade knows: settings, what was measured of each, and what follows from it.
 *
 * A level is one or more options of alidade, a factor a choice of levels, and a setting one level (or the
 * default) of each factor. Each run of a setting is a process of its own.
 */
#ifndef ALIDADE_TRADE_TRADE_H
#define ALIDADE_TRADE_TRADE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/diag.h"
#include "base/mem.h"
#include "image/diff.h"
#include "look/progress.h"
#include "read/read.h"

#define TRADE_FACTORS 16
#define TRADE_LEVELS 96 /* of a factor */
#define TRADE_LEVEL_OPTIONS 8
#define TRADE_SETTINGS 1024
#define TRADE_RUNS 48 /* of a setting */
#define TRADE_PATH 4096
#define TRADE_GAIN 0.99 /* an error is smaller than another one if it is below this much of it */

/* What a run gives; columns.c has a line for each. A setting has the median of each over its runs. */
enum trade_value {
	TRADE_PROCESS, TRADE_RENDER, TRADE_BUILD, TRADE_READ, TRADE_CPU, TRADE_MEMORY, TRADE_RMSE,
	TRADE_BIAS, TRADE_P99, TRADE_MAX, TRADE_CHANGED, TRADE_NONFINITE, TRADE_WRONG, TRADE_VALUES
};

struct trade_column {
	const char *key; /* in JSON and in the file of results */
	const char *title, *unit, *help;
	double scale; /* what is shown is the value times this */
	int digits; /* that count */
	bool narrow; /* shown where there is little room */
};
extern const struct trade_column trade_column[TRADE_VALUES];
/* The value of that key; TRADE_VALUES: there is none. */
enum trade_value trade_value_named(const char *key);
/* In the column's unit, with its digits; "-" if not finite. */
void trade_value_text(enum trade_value, double, char *out, size_t size);

struct trade_level {
	char *text; /* "octree:leaf=1", "cache+indirect-error=4" */
	char *option[TRADE_LEVEL_OPTIONS]; /* "--indirect=cache" */
	uint32_t options;
	const char *accel; /* what it says of the accelerator; NULL: nothing */
};

struct trade_factor {
	char name[48]; /* the option that its first level is for */
	struct trade_level *level; /* [TRADE_LEVELS] */
	uint32_t levels;
	bool by_default; /* its levels are ours, not the user's */
};

struct trade_run {
	uint64_t seed, picture; /* picture: the file's hash */
	double value[TRADE_VALUES]; /* NaN: not known */
};

/* The median, and an interval that the true median is in with that confidence (0: one run only). */
struct trade_range {
	double median, low, high, confidence;
	uint32_t count;
};

enum trade_stage { TRADE_BASE, TRADE_ALONE, TRADE_PARAMETER, TRADE_COMBINED };

struct trade_setting {
	uint16_t level[TRADE_FACTORS]; /* of each factor: 0: the default, else the level after it */
	char label[320];
	uint64_t key; /* of scene, options, program, plugin, machine and reference */
	enum trade_stage stage;
	struct trade_run *run; /* [TRADE_RUNS] */
	uint32_t runs, target;
	const char *failure; /* NULL: none */
	double checked, different; /* hits; checked is 0 where they were not */
	const char *unverified; /* why they were not */
	const char *inexact; /* what lets its hits be wrong; NULL: nothing does */
	struct trade_range range[TRADE_VALUES];
	bool front; /* nothing is both faster and as accurate */
};

enum trade_kind { TRADE_FASTEST, TRADE_MOST_ACCURATE };
enum trade_outcome { TRADE_CLEAR, TRADE_TIED, TRADE_UNSURE, TRADE_NOTHING };

struct trade_ask {
	enum trade_kind kind;
	double bound; /* of the error, or in seconds */
	bool own; /* nobody asked: the bound is what the default settings reach */
};

struct trade_verdict {
	struct trade_ask ask;
	enum trade_outcome outcome;
	const struct trade_setting *pick; /* for TRADE_NOTHING: what comes nearest, or NULL */
	const struct trade_setting **tied; /* not told apart from it */
	uint32_t ties;
	struct trade_range time_again, error_again; /* of runs made to confirm it; count 0: there were none */
	const struct trade_setting *pacer; /* took turns with it then, or NULL */
	double drift; /* how many times as long that took as before; 1 without one */
	bool time_holds, error_holds; /* their intervals overlap those found before, drift being allowed for in times */
	bool bound_holds; /* and their median keeps the bound */
};
#define TRADE_ASKS 4

/* The scene, as read once. */
struct trade_about {
	uint64_t hash;
	uint32_t width, height;
	bool radiosity;
	struct read_job job; /* what its .ini says */
	char options[256]; /* of base, as alidade describes them */
};

struct trade_reference {
	const char *file; /* the user's, or ours */
	const char *options; /* it was drawn with; NULL: the user's */
	uint64_t hash, key; /* of the file, and of what it was made from */
	double noise; /* RMS that it is off by itself, as far as that is known */
	uint32_t pictures; /* it is the mean of */
};

struct trade_planned;

struct trade {
	/* What was asked for. */
	const char *scene, *program, *folder, *reference_file, *reference_options, *json, *html;
	bool want_json, fresh, confirm;
	const char **base; /* options that every run has */
	uint32_t base_count;
	uint32_t repeat, combinations, verify;
	double budget, limit, max_error, max_time; /* seconds, seconds, NaN: not asked */
	enum trade_value clock, error; /* what is traded for what */
	enum diff_space space;
	double changed;
	int verbosity;
	uint64_t seed; /* of all runs; 0: each run of a setting another one */
	const char *base_accel;

	/* What is known. */
	struct mem_book book;
	struct arena arena;
	struct diag diag;
	struct progress progress;
	struct trade_about about;
	struct trade_reference reference;
	struct trade_factor factor[TRADE_FACTORS];
	uint32_t factors;
	struct trade_setting *setting; /* [TRADE_SETTINGS], the default first */
	uint32_t settings;
	uint64_t program_hash, machine_hash;
	bool random; /* pictures differ with the seed */
	bool complete; /* all that was planned has been measured */
	double began; /* seconds: when measuring began */
	double longest; /* seconds of CPU time: a run that takes more is stopped, unless there is a limit */
	FILE *results;
	struct trade_planned *looking; /* the plan that is looked for in them */
	char results_name[TRADE_PATH], work[TRADE_PATH]; /* work: a folder that is removed at the end */
	uint64_t done, planned; /* runs */
	uint64_t kept, made; /* runs: from earlier, and now */
	struct trade_verdict verdict[TRADE_ASKS];
	uint32_t verdicts;
};

/* A copy in t's arena; NULL after an error has been reported. */
char *trade_text(struct trade *, const char *fmt, ...) DIAG_PRINTF(2, 3);

/* plan.c: which settings there are. */
enum status trade_sweep(struct trade *, const char *text); /* of --sweep */
enum status trade_sweep_default(struct trade *);
bool trade_sweeps(const struct trade *, const char *option); /* is it part of any level? */
enum status trade_plan(struct trade *); /* the default, and each level alone */
enum status trade_plan_parameters(struct trade *);
enum status trade_plan_combinations(struct trade *); /* combine.c */
enum status trade_setting_add(struct trade *, const uint16_t *level, enum trade_stage);
/* The options of a setting beyond base; ends with NULL. out has room for TRADE_FACTORS *
 * TRADE_LEVEL_OPTIONS + 1. */
uint32_t trade_options(const struct trade *, const struct trade_setting *, const char **out);
/* What would be typed to draw the picture with it. */
const char *trade_command(struct trade *, const struct trade_setting *);
/* "aa=8+indirect=exact" to a level. */
enum status trade_level_parse(struct trade *, const char *text, struct trade_level *);

/* scene.c */
/* The base, with these options after it, is a command line that alidade takes. */
enum status trade_allowed(const struct trade *, char *const *option, uint32_t options, struct diag *);
/* And the accelerator serves the precision: it is loaded if that is not the usual one. What was found stays in
 * *known, which begins as zeroes. */
enum { TRADE_SERVED = 64 };
struct trade_served {
	uint64_t key[TRADE_SERVED]; /* 0: none */
	bool yes[TRADE_SERVED];
};
bool trade_goes(const struct trade *, char *const *option, uint32_t options, struct trade_served *known);
/* What of these options makes hits inexact, by the accelerator's own word; "": nothing; NULL: no memory. */
const char *trade_inexact(struct trade *, char *const *option, uint32_t options);
bool trade_changes_nothing(const struct trade *, const struct trade_level *);
enum status trade_check_base(struct trade *);
enum status trade_look(struct trade *);

/* store.c: a file of JSON lines that later runs go on with. */
enum status trade_store_open(struct trade *);
enum status trade_store_load(struct trade *, uint32_t first); /* what is known of settings from there on */
enum status trade_store_run(struct trade *, const struct trade_setting *, const struct trade_run *);
enum status trade_store_failure(struct trade *, const struct trade_setting *, double limit);
enum status trade_store_verify(struct trade *, const struct trade_setting *);
enum status trade_store_reference(struct trade *);
/* What a stage planned from what the settings before it had shown: a name, or lists of levels. It is kept, as
 * other measurements of the same would lead to another plan, and no run would ever be the last. */
struct trade_planned {
	uint64_t key;
	bool found;
	char name[128];
	uint16_t (*level)[TRADE_FACTORS];
	uint32_t count, room;
};
enum status trade_store_plan(struct trade *, const struct trade_planned *);
void trade_store_find_plan(struct trade *, struct trade_planned *); /* of its key */
bool trade_store_find_reference(struct trade *); /* of its key */
uint64_t trade_hash_file(uint64_t h, const char *path); /* 0: it cannot be read */
uint64_t trade_hash_text(uint64_t h, const char *text);
uint64_t trade_plan_key(const struct trade *, const char *stage);
uint64_t trade_setting_key(const struct trade *, const struct trade_setting *);
uint64_t trade_options_key(const struct trade *, const char *const *option, const char *accel);

/* child.c */
struct trade_child {
	const char *const *option; /* beyond base; ends with NULL */
	uint64_t seed;
	const char *picture, *stats; /* files it writes; stats may be NULL */
	double limit, cpu_limit; /* seconds, and seconds of CPU time; 0: none */

	bool late; /* it was stopped at the limit */
	int status; /* its exit status; 128 + a signal's number */
	char message[512]; /* its last words, if it failed */
	double value[TRADE_VALUES]; /* those of time and memory */
};
/* STATUS_OK: it ran, and status tells how it ended; STATUS_SIGINT: we were asked to stop. */
enum status trade_child_run(struct trade *, struct trade_child *);

/* picture.c */
enum status trade_compare(struct trade *, const char *picture, double *value);
/* The mean of two pictures to out; *noise is how far it is off. */
enum status trade_average(struct trade *, const char *a, const char *b, const char *out, double *noise);
enum status trade_look_reference(struct trade *); /* the user's: can it be read, has it the size? */
/* A function in a process of its own: neither its memory nor its end is ours. out is size bytes that come
 * back. */
enum status trade_apart(struct trade *, enum status (*job)(struct trade *, void *arg, void *out), void *arg,
			void *out, size_t size);

/* measure.c */
enum status trade_reference_make(struct trade *);
enum status trade_measure(struct trade *);

/* confirm.c: what is recommended is drawn again, with other random numbers; nothing of it is kept. */
enum status trade_confirm(struct trade *);
enum status trade_run_once(struct trade *, const struct trade_setting *, struct trade_child *, struct trade_run *);

/* judge.c */
void trade_range_of(const double *value, uint32_t count, struct trade_range *); /* count <= TRADE_RUNS */
void trade_summarise(struct trade *); /* ranges and the front */
enum status trade_decide(struct trade *); /* verdicts */
/* Something else is as accurate in a time that is less by that factor. */
bool trade_far_behind(const struct trade *, const struct trade_setting *, double times);
bool trade_measured(const struct trade *, const struct trade_setting *); /* time and error are known */

/* report.c, html.c, chart.c */
void trade_print(struct trade *, FILE *);
bool trade_json(struct trade *, FILE *);
bool trade_html(struct trade *, FILE *);
void trade_chart(struct trade *, FILE *);
/* Measured settings, fastest first; the count. order has room for TRADE_SETTINGS. */
uint32_t trade_order(const struct trade *, const struct trade_setting **order);
/* One sentence on what a verdict says. */
const char *trade_verdict_text(struct trade *, const struct trade_verdict *);
/* Why that is no verdict; NULL: it is one. */
const char *trade_outcome_text(struct trade *, const struct trade_verdict *);
/* That its hits are inexact, and how many were wrong; NULL: they are not. */
const char *trade_caution_text(struct trade *, const struct trade_setting *);
const char *trade_confirm_text(struct trade *, const struct trade_verdict *); /* NULL: it was not tried */
/* Is there anything to show in that column? wide: there is room for all. */
bool trade_shown(const struct trade *, enum trade_value, bool wide);
void trade_escape(FILE *out, const char *s); /* for HTML */
/* What a reader has to know besides: one sentence each; NULL: no more. */
const char *trade_note(struct trade *, uint32_t i);

#endif
