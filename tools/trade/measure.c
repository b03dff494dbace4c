/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The order of measuring. Repetitions are interleaved: a pass measures each setting once, every other pass
 * backwards, so that a machine that grows slow or busy does so for all of them. A later stage measures the
 * front of the earlier ones along with its own settings, for the same reason.
 */
#include <config.h>

#include <errno.h>
#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/interrupt.h"
#include "scene/hash.h"
#include "trade.h"

#define SEED_FIRST 1000001 /* of references; runs have 1, 2, .. */
#define SLOW 10 /* times the default's time: such a setting is given up */
#define SLOW_ACCEL 4 /* the same, where nothing but the accelerator differs: that gains time or nothing */
#define SLOW_LEAST 5.0 /* seconds more than the default's */
#define BEHIND 1.5 /* times the time of what is as accurate: that needs no more than two runs */
#define PLAYOFFS 3 /* settings that are not told apart get up to as many times the repetitions */

/* Shares of the budget by whose end a stage ends. */
#define END_ALONE 0.5
#define END_PARAMETERS 0.65
#define END_COMBINED 0.85

static bool picture_there(const struct trade_child *c)
{
	return c->status == STATUS_OK || c->status == STATUS_BUDGET || c->status == STATUS_NONFINITE ||
	       c->status == STATUS_VERIFY;
}

static void name_in(char *out, size_t size, const char *folder, const char *name)
{
	snprintf(out, size, "%s/%s", folder, name);
}

/* Draws a picture whose failure is ours too. */
static enum status draw(struct trade *t, const char *const *option, uint64_t seed, const char *picture,
			const char *what, double *took)
{
	struct trade_child c = { .option = option, .seed = seed, .picture = picture };
	enum status st = trade_child_run(t, &c);

	if (!st && !picture_there(&c))
		st = diag_fail(&t->diag, c.status < 128 ? (enum status)c.status : STATUS_FAILED, NULL,
			       "%s cannot be drawn: %s", what, c.message);
	*took = c.value[TRADE_CPU];
	return st;
}

/* Fills caches, says how long a picture takes, and whether it depends on the seed. */
static enum status warm_up(struct trade *t)
{
	const char *none[] = { NULL };
	char picture[TRADE_PATH + 16];
	uint64_t hash[2];
	enum status st = STATUS_OK;
	double took = 0;

	name_in(picture, sizeof(picture), t->work, "picture.pfm");
	progress_begin(&t->progress, "drawing the default", clock_seconds());
	for (uint64_t i = 0; i < 2 && !st; i++) {
		st = draw(t, none, t->seed ? t->seed : i + 1, picture, "the default", &took);
		hash[i] = st ? 0 : trade_hash_file(HASH_START, picture);
	}
	progress_end(&t->progress, clock_seconds());
	if (st)
		return st;
	t->random = hash[0] != hash[1];
	t->longest = fmax(SLOW * took, took + SLOW_LEAST);
	return STATUS_OK;
}

/* The most accurate level of each kind of option that is varied; what nobody varies stays. Samples spread
 * over the pixel make the truer mean, but also stand for indirect light's, which needs more of them. */
static const char *reference_options(struct trade *t)
{
	char spp[] = "--spp=256", *only[] = { spp };
	struct diag silent = { 0 };
	bool indirect = trade_sweeps(t, "indirect") || trade_sweeps(t, "indirect-samples");
	bool pixel = trade_sweeps(t, "aa") || trade_sweeps(t, "spp") || trade_sweeps(t, "noise") ||
		     trade_sweeps(t, "blur-samples");
	const char *first = trade_sweeps(t, "precision") ? "precision=exact" : "", *second = "";

	if (t->reference_options)
		return t->reference_options;
	if (pixel && !indirect && !trade_allowed(t, only, 1, &silent))
		second = spp + 2;
	else if (pixel)
		second = indirect ? "aa=8+indirect=exact+indirect-samples=4096" : "aa=8";
	else if (indirect)
		second = "indirect=exact+indirect-samples=4096";
	return trade_text(t, "%s%s%s", first, *first && *second ? "+" : "", second);
}

static enum status rename_to(struct trade *t, const char *from, const char *to)
{
	return rename(from, to) ? diag_fail(&t->diag, STATUS_FAILED, NULL, "%s: %s", to, strerror(errno)) :
				  STATUS_OK;
}

/* Two halves with other random numbers say how far their mean is off. */
static enum status draw_reference(struct trade *t, const char *const *option)
{
	struct trade_reference *r = &t->reference;
	char half[2][TRADE_PATH + 16];
	enum status st = STATUS_OK;
	double took;

	name_in(half[0], sizeof(half[0]), t->work, "half1.pfm");
	name_in(half[1], sizeof(half[1]), t->work, "half2.pfm");
	r->pictures = (t->random || strstr(r->options, "spp=")) && !t->seed ? 2 : 1;
	r->noise = 0;
	progress_begin(&t->progress, "drawing the reference", clock_seconds());
	for (uint32_t i = 0; i < r->pictures && !st; i++)
		st = draw(t, option, t->seed ? t->seed : SEED_FIRST + i, half[i], "the reference", &took);
	progress_end(&t->progress, clock_seconds());
	if (st)
		return st;
	st = r->pictures == 2 ? trade_average(t, half[0], half[1], r->file, &r->noise) :
				rename_to(t, half[0], r->file);
	if (st)
		return st;
	r->hash = trade_hash_file(HASH_START, r->file);
	return trade_store_reference(t);
}

static enum status own_reference(struct trade *t)
{
	const char *option[TRADE_LEVEL_OPTIONS + 1] = { NULL };
	struct trade_level level;
	enum status st;

	t->reference.options = reference_options(t);
	if (!t->reference.options)
		return STATUS_FAILED;
	st = trade_level_parse(t, t->reference.options, &level);
	if (!st)
		st = trade_allowed(t, level.option, level.options, &t->diag);
	if (st)
		return st;
	memcpy(option, level.option, level.options * sizeof(*option));
	t->reference.key = trade_options_key(t, option, t->base_accel);
	t->reference.key = HASH(t->reference.key, t->seed);
	t->reference.file = trade_text(t, "%s/reference-%016" PRIx64 ".pfm", t->folder, t->reference.key);
	if (!t->reference.file)
		return STATUS_FAILED;
	if (trade_store_find_reference(t))
		return STATUS_OK;
	st = t->longest > 0 ? STATUS_OK : warm_up(t);
	return st ? st : draw_reference(t, option);
}

enum status trade_reference_make(struct trade *t)
{
	if (!t->reference_file)
		return own_reference(t);
	t->reference.file = t->reference_file;
	t->reference.pictures = 1;
	t->reference.hash = trade_hash_file(HASH_START, t->reference_file);
	return trade_look_reference(t);
}

/* Figures of the same picture need not be taken again. */
static enum status take_figures(struct trade *t, const struct trade_setting *s, struct trade_run *r,
				const char *picture)
{
	r->picture = trade_hash_file(HASH_START, picture);
	for (uint32_t i = 0; i < s->runs; i++) {
		if (s->run[i].picture != r->picture)
			continue;
		for (int v = TRADE_RMSE; v <= TRADE_NONFINITE; v++)
			r->value[v] = s->run[i].value[v];
		return STATUS_OK;
	}
	return trade_compare(t, picture, r->value);
}

static enum status fail_setting(struct trade *t, struct trade_setting *s, const struct trade_child *c)
{
	s->failure = trade_text(t, "%s", c->message);
	if (!s->failure)
		return STATUS_FAILED;
	diag_report(&t->diag, DIAG_INFO, NULL, "%s: %s", s->label, s->failure);
	return trade_store_failure(t, s, !c->late ? 0 : c->limit > 0 ? c->limit : c->cpu_limit);
}

/* The picture is the default's, then. */
static bool only_accel(const struct trade *t, const struct trade_setting *s)
{
	const char *option[TRADE_FACTORS * TRADE_LEVEL_OPTIONS + 1];
	uint32_t n = trade_options(t, s, option);

	return n == 1 && !strncmp(option[0], "--accel=", 8);
}

/* One process and its picture's figures. If c->message is not empty it failed, and r is of no use. */
enum status trade_run_once(struct trade *t, const struct trade_setting *s, struct trade_child *c,
			   struct trade_run *r)
{
	const char *option[TRADE_FACTORS * TRADE_LEVEL_OPTIONS + 1];
	char picture[TRADE_PATH + 16];
	enum status st;

	name_in(picture, sizeof(picture), t->work, "picture.pfm");
	trade_options(t, s, option);
	c->option = option;
	c->picture = picture;
	st = trade_child_run(t, c);
	if (st || !picture_there(c))
		return st;
	c->message[0] = 0; /* a budget that was missed, say, is still a picture */
	memcpy(r->value, c->value, sizeof(r->value));
	return take_figures(t, s, r, picture);
}

static enum status run_setting(struct trade *t, struct trade_setting *s)
{
	struct trade_run *r = &s->run[s->runs];
	struct trade_child c = { .seed = t->seed ? t->seed : s->runs + 1 };
	enum status st;

	r->seed = c.seed;
	if (s != t->setting) {
		c.limit = t->limit;
		c.cpu_limit = only_accel(t, s) ? fmax(t->longest * SLOW_ACCEL / SLOW, SLOW_LEAST) : t->longest;
	}
	st = trade_run_once(t, s, &c, r);
	if (st)
		return st;
	if (c.message[0])
		return fail_setting(t, s, &c);
	s->runs++;
	t->made++;
	diag_report(&t->diag, DIAG_INFO, NULL, "%s: %.3f s, RMSE %.4g", s->label, r->value[TRADE_PROCESS],
		    r->value[TRADE_RMSE]);
	return trade_store_run(t, s, r);
}

static bool due(const struct trade *t, const struct trade_setting *s)
{
	return !s->failure && s->runs < s->target && s->runs < TRADE_RUNS &&
	       (s->runs < 2 || s == t->setting || !trade_far_behind(t, s, BEHIND));
}

static uint64_t count_due(const struct trade *t)
{
	uint64_t n = 0;

	for (uint32_t i = 0; i < t->settings; i++)
		n += due(t, &t->setting[i]) ? t->setting[i].target - t->setting[i].runs : 0;
	return n;
}

/* Passes until nothing is due, or the time is up. A setting joins when it has as few runs as any. */
static enum status passes(struct trade *t, const char *phase, double share)
{
	enum status st = STATUS_OK;
	double end = t->began + share * t->budget;
	uint64_t left = count_due(t), total = left;

	progress_begin(&t->progress, phase, clock_seconds());
	for (uint32_t pass = 0; left && !st; pass++) {
		for (uint32_t k = 0; k < t->settings && !st; k++) {
			uint32_t i = pass % 2 ? t->settings - 1 - k : k;
			struct trade_setting *s = &t->setting[i];

			if (!due(t, s))
				continue;
			if (clock_seconds() > end && (i || s->runs))
				break;
			st = interrupt_asked() ? STATUS_SIGINT : run_setting(t, s);
			progress_update(&t->progress, total - count_due(t), total, clock_seconds());
		}
		trade_summarise(t);
		if (clock_seconds() > end)
			break;
		left = count_due(t);
	}
	progress_end(&t->progress, clock_seconds());
	if (count_due(t))
		t->complete = false;
	return st;
}

/* Two runs of each setting are the least that says anything. */
static void warn_budget(struct trade *t)
{
	double picture = t->longest / SLOW, need = 2 * picture * t->settings / END_ALONE;

	if (t->longest > SLOW_LEAST * SLOW / (SLOW - 1) && need > t->budget && t->setting[0].runs < t->repeat)
		diag_report(&t->diag, DIAG_WARNING, NULL,
			    "a picture takes %.3g s of CPU, and there are %u settings: --budget=%.3g would do them "
			    "justice, or a smaller picture (-- -s)", picture, t->settings, need);
}

static enum status stage_alone(struct trade *t)
{
	enum status st = trade_plan(t);

	if (!st)
		st = trade_store_load(t, 0);
	trade_summarise(t);
	if (!st && t->setting[0].runs)
		t->longest = fmax(SLOW * t->setting[0].range[TRADE_CPU].median,
				  t->setting[0].range[TRADE_CPU].median + SLOW_LEAST);
	else if (!st && t->longest <= 0)
		st = warm_up(t);
	warn_budget(t);
	if (!st)
		st = passes(t, "measuring", END_ALONE);
	trade_summarise(t);
	if (!st && t->setting[0].failure)
		st = diag_fail(&t->diag, STATUS_FAILED, NULL, "the default cannot be drawn: %s",
			       t->setting[0].failure);
	return st;
}

static enum status stage_parameters(struct trade *t)
{
	uint32_t first = t->settings;
	enum status st = trade_plan_parameters(t);

	if (!st && t->settings > first)
		st = trade_store_load(t, first);
	if (!st)
		st = passes(t, "measuring parameters", END_PARAMETERS);
	trade_summarise(t);
	return st;
}

static enum status stage_combined(struct trade *t)
{
	uint32_t first = t->settings;
	bool any = false;
	enum status st = trade_plan_combinations(t);

	if (!st && t->settings > first)
		st = trade_store_load(t, first);
	for (uint32_t i = first; i < t->settings; i++)
		any = any || due(t, &t->setting[i]);
	for (uint32_t i = 0; i < first && any; i++) {
		struct trade_setting *s = &t->setting[i];

		if (s->front || !i) /* again along with the new ones; but not each time it is called */
			s->target = s->runs + t->repeat < 2 * t->repeat ? s->runs + t->repeat : 2 * t->repeat;
	}
	if (!st)
		st = passes(t, "combining", END_COMBINED);
	trade_summarise(t);
	return st;
}

/* What decides which hit is the nearest. */
static void hits_text(const struct trade *t, const struct trade_setting *s, const char **out)
{
	const char *option[TRADE_FACTORS * TRADE_LEVEL_OPTIONS + 1];
	uint32_t n = trade_options(t, s, option);

	out[0] = out[1] = out[2] = NULL;
	for (uint32_t i = 0; i < n; i++) {
		if (!strncmp(option[i], "--accel=", 8))
			out[0] = option[i];
		else if (!strncmp(option[i], "--precision=", 12))
			out[1] = option[i];
	}
	if (!out[0]) {
		out[0] = out[1];
		out[1] = NULL;
	}
}

static bool same_text(const char *a, const char *b)
{
	return a == b || (a && b && !strcmp(a, b));
}

/* Another setting that finds the same hits, and is known; NULL: none. */
static const struct trade_setting *verified_like(const struct trade *t, const struct trade_setting *s)
{
	const char *mine[3], *other[3];

	hits_text(t, s, mine);
	for (uint32_t i = 0; i < t->settings; i++) {
		hits_text(t, &t->setting[i], other);
		if ((t->setting[i].checked > 0 || t->setting[i].unverified) && same_text(mine[0], other[0]) &&
		    same_text(mine[1], other[1]))
			return &t->setting[i];
	}
	return NULL;
}

static enum status read_verify(struct trade *t, struct trade_setting *s, const char *path)
{
	json_t *v = json_load_file(path, 0, NULL);
	/* What an accelerator misses by its own fault, and what the precision does. */
	double different = 0, inexact = 0;

	s->checked = 0;
	json_unpack(v, "{s:{s:{s:F, s:F, s?F}}}", "verify", "nearest", "checked", &s->checked, "different",
		    &different, "inexact", &inexact);
	s->different = different + inexact;
	s->unverified = s->checked > 0 ? NULL : "no ray was checked";
	json_decref(v);
	return s->checked > 0 ? trade_store_verify(t, s) : STATUS_OK;
}

/* Counting and checking take time, so this is a run of its own, which nobody times. */
static enum status verify(struct trade *t, struct trade_setting *s)
{
	const char *option[4];
	char picture[TRADE_PATH + 16], stats[TRADE_PATH + 16], every[40];
	struct trade_child c = { .option = option, .picture = picture, .stats = stats, .seed = 1,
				 .limit = 4 * t->limit, .cpu_limit = 4 * t->longest };
	enum status st;
	int n = 0;

	name_in(picture, sizeof(picture), t->work, "picture.pfm");
	name_in(stats, sizeof(stats), t->work, "stats.json");
	hits_text(t, s, option);
	while (option[n])
		n++;
	snprintf(every, sizeof(every), "--verify=%u", t->verify);
	option[n++] = every;
	option[n] = NULL;
	st = trade_child_run(t, &c);
	if (st)
		return st;
	if (picture_there(&c))
		return read_verify(t, s, stats);
	s->unverified = trade_text(t, "%s", c.message);
	return s->unverified ? STATUS_OK : STATUS_FAILED;
}

/* Once for each accelerator and precision, while there is time. */
static enum status verify_setting(struct trade *t, struct trade_setting *s)
{
	const struct trade_setting *like;

	if (s->checked > 0 || s->unverified || !trade_measured(t, s))
		return STATUS_OK;
	like = verified_like(t, s);
	if (like) {
		s->checked = like->checked;
		s->different = like->different;
		s->unverified = like->unverified;
		return STATUS_OK;
	}
	if (clock_seconds() > t->began + t->budget)
		return STATUS_OK;
	return interrupt_asked() ? STATUS_SIGINT : verify(t, s);
}

static enum status verify_all(struct trade *t)
{
	char option[40], *list[] = { option };
	struct diag silent = { 0 };
	enum status st = STATUS_OK;

	snprintf(option, sizeof(option), "--verify=%u", t->verify);
	if (!t->verify || trade_allowed(t, list, 1, &silent))
		return STATUS_OK;
	progress_begin(&t->progress, "checking hits", clock_seconds());
	for (int pass = 0; pass < 2; pass++) { /* the front is what may be recommended */
		for (uint32_t i = 0; i < t->settings && !st; i++) {
			struct trade_setting *s = &t->setting[i];

			if (pass || s->front || !i)
				st = verify_setting(t, s);
		}
	}
	progress_end(&t->progress, clock_seconds());
	return st;
}

/* What verdicts lack, and nothing else: settings that could not be told apart are measured again, as long as
 * that may help, and those of few runs as often as others. */
static enum status playoff(struct trade *t)
{
	enum status st = trade_decide(t);

	for (uint32_t i = 1; i < t->settings; i++)
		t->setting[i].target = t->setting[i].runs;
	for (uint32_t i = 0; i < t->verdicts && !st; i++) {
		const struct trade_verdict *v = &t->verdict[i];
		uint32_t target = v->outcome == TRADE_TIED ? PLAYOFFS * t->repeat : t->repeat;

		if (v->outcome != TRADE_TIED && v->outcome != TRADE_UNSURE)
			continue;
		for (uint32_t k = 0; k <= v->ties; k++) {
			const struct trade_setting *one = k ? v->tied[k - 1] : v->pick;
			struct trade_setting *s = &t->setting[one - t->setting];

			s->target = s->target > target ? s->target : target;
		}
	}
	if (!st)
		st = passes(t, "deciding", 1);
	trade_summarise(t);
	if (!st)
		st = trade_decide(t);
	return !st && t->confirm ? trade_confirm(t) : st;
}

enum status trade_measure(struct trade *t)
{
	enum status st;

	t->complete = true;
	t->began = clock_seconds();
	st = stage_alone(t);
	if (!st)
		st = stage_parameters(t);
	if (!st)
		st = stage_combined(t);
	if (!st)
		st = verify_all(t);
	trade_summarise(t);
	if (!st)
		return playoff(t);
	if (st == STATUS_SIGINT) {
		t->complete = false;
		trade_decide(t);
	}
	return st;
}
