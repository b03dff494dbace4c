/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What is the same in all runs: the scene and the options that the user gave for it.
 */
#include <config.h>

#include <string.h>

#include "accel/load.h"
#include "base/interrupt.h"
#include "scene/hash.h"
#include "scene/scene.h"
#include "settings.h"
#include "trade.h"

/* base, other options and the scene, as alidade understands them; s is to be released whatever the status
 * is. */
static enum status parse(const struct trade *t, char *const *option, uint32_t options, struct settings *s,
			 struct mem_book *book, struct diag *d)
{
	char *argv[256] = { (char *)(uintptr_t) "alidade" };
	int argc = 1;

	settings_init(s, book);
	if (t->base_count + options > 250)
		return diag_fail(d, STATUS_USAGE, NULL, "too many options");
	/* getopt_long() moves the pointers about, not the text. */
	for (uint32_t i = 0; i < t->base_count; i++)
		argv[argc++] = (char *)(uintptr_t)t->base[i];
	for (uint32_t i = 0; i < options; i++)
		argv[argc++] = option[i];
	argv[argc++] = (char *)(uintptr_t) "--";
	argv[argc++] = (char *)(uintptr_t)t->scene;
	return settings_parse(s, argc, argv, d);
}

static enum status parse_base(struct trade *t, struct settings *s)
{
	return parse(t, NULL, 0, s, &t->book, &t->diag);
}

enum status trade_allowed(const struct trade *t, char *const *option, uint32_t options, struct diag *d)
{
	struct settings s;
	struct mem_book book;
	enum status st;

	mem_book_init(&book, 0);
	st = parse(t, option, options, &s, &book, d);
	if (!st)
		st = settings_finish(&s, &t->about.job, d);
	settings_release(&s);
	return st;
}

static bool serves(const struct settings *s)
{
	struct accel_choice c;
	struct diag silent = { 0 };
	bool yes;

	if (accel_load(&c, s->accel, &silent))
		return true; /* that is told, once it is measured */
	yes = !accel_set_precision(&c, s->precision, &silent);
	accel_unload(&c);
	return yes;
}

static bool served(const struct settings *s, struct trade_served *known)
{
	uint64_t key = HASH(trade_hash_text(HASH_START, s->accel), s->precision);
	uint64_t at = key % TRADE_SERVED;

	if (s->precision == ALD_PRECISION_DEFAULT)
		return true;
	if (known->key[at] != key) {
		known->key[at] = key;
		known->yes[at] = serves(s);
	}
	return known->yes[at];
}

bool trade_goes(const struct trade *t, char *const *option, uint32_t options, struct trade_served *known)
{
	struct settings s;
	struct mem_book book;
	struct diag silent = { 0 };
	bool yes;

	mem_book_init(&book, 0);
	yes = !parse(t, option, options, &s, &book, &silent) && !settings_finish(&s, &t->about.job, &silent) &&
	      served(&s, known);
	settings_release(&s);
	return yes;
}

/* Only parameters can make an accelerator inexact. */
static const char *inexact_parameter(struct trade *t, const char *spec)
{
	struct accel_choice c;
	struct diag silent = { 0 };
	const ald_param *p;
	const char *text = "";

	if (!strchr(spec, ':') || accel_load(&c, spec, &silent))
		return text;
	p = accel_inexact(&c);
	if (p)
		text = trade_text(t, "%s of %s (%s)", p->name, c.plugin->name, p->help);
	accel_unload(&c);
	return text;
}

const char *trade_inexact(struct trade *t, char *const *option, uint32_t options)
{
	struct settings s;
	struct mem_book book;
	struct diag silent = { 0 };
	const char *text = "";

	mem_book_init(&book, 0);
	if (!parse(t, option, options, &s, &book, &silent))
		text = s.precision == ALD_PRECISION_FAST ? "--precision=fast" : inexact_parameter(t, s.accel);
	settings_release(&s);
	return text;
}

/* settings_describe() tells what decides the picture; of the levels that we choose ourselves those of
 * these options say nothing but that. */
bool trade_changes_nothing(const struct trade *t, const struct trade_level *l)
{
	struct settings s;
	struct mem_book book;
	struct diag silent = { 0 };
	char text[sizeof(t->about.options)];
	bool same = true;

	for (uint32_t i = 0; i < l->options; i++)
		same = same && (!strncmp(l->option[i], "--aa=", 5) || !strncmp(l->option[i], "--indirect", 10));
	if (!same)
		return false;
	mem_book_init(&book, 0);
	same = !parse(t, l->option, l->options, &s, &book, &silent) &&
	       !settings_finish(&s, &t->about.job, &silent);
	if (same) {
		settings_describe(&s, text, sizeof(text));
		same = !strcmp(text, t->about.options);
	}
	settings_release(&s);
	return same;
}

/* What would draw no picture, or put it elsewhere. */
static const char *misplaced(const struct settings *s)
{
	if (s->action != ACTION_RENDER || s->dry_run)
		return "no picture is drawn with one of these options";
	if (s->given & GIVEN_OUTPUT)
		return "-o is for alidade-trade to give";
	if (s->stats)
		return "--stats is for alidade-trade to give: counting takes time";
	if (s->frame_count || s->given & GIVEN_RANGE || s->skip_existing)
		return "one picture is measured, no animation; --clock names one";
	if (s->progress != PROGRESS_AUTO || s->verbosity)
		return "what alidade says is read here: leave --progress, -q and -v to alidade-trade";
	return NULL;
}

enum status trade_check_base(struct trade *t)
{
	struct settings s;
	enum status st = parse_base(t, &s);
	const char *why = st ? NULL : misplaced(&s);

	if (!st && !strcmp(t->scene, "-"))
		st = diag_fail(&t->diag, STATUS_USAGE, NULL,
			       "standard input can be read only once; a scene that is to be measured is a file");
	else if (why)
		st = diag_fail(&t->diag, STATUS_USAGE, NULL, "after --: %s", why);
	if (!st) {
		t->seed = s.render.seed;
		t->base_accel = trade_text(t, "%s", s.accel);
		st = t->base_accel ? STATUS_OK : STATUS_FAILED;
	}
	settings_release(&s);
	return st;
}

static bool asked_to_stop(void *arg)
{
	(void)arg;
	return interrupt_asked();
}

static enum status look(struct trade *t, void *arg, void *out)
{
	struct trade_about *about = out;
	struct scene scene;
	struct settings s;
	struct read_job job;
	struct frame_plan plan;
	enum status st = parse_base(t, &s);

	(void)arg;
	scene_init(&scene, &t->book);
	s.read.stop = asked_to_stop;
	s.read.quiet_debug = true;
	if (!st)
		st = read_scene(s.scene, &s.read, &scene, &job, &t->diag);
	if (!st) {
		settings_plan(&s, &job, &plan);
		if (plan.animated)
			st = diag_fail(&t->diag, STATUS_USAGE, NULL,
				       "%s: an animation: measure one picture of it, its .pov with --clock",
				       t->scene);
	}
	if (!st)
		st = settings_finish(&s, &job, &t->diag);
	if (!st) {
		about->job = job;
		about->job.output = NULL; /* it is the scene's */
		settings_describe(&s, about->options, sizeof(about->options));
		about->hash = scene_hash(&scene);
		about->width = s.render.crop_width ? s.render.crop_width : s.render.width;
		about->height = s.render.crop_width ? s.render.crop_height : s.render.height;
		about->radiosity = scene.radiosity.given && s.render.indirect != INDIRECT_OFF;
	}
	scene_release(&scene);
	settings_release(&s);
	return st;
}

enum status trade_look(struct trade *t)
{
	return trade_apart(t, look, NULL, &t->about, sizeof(t->about));
}
