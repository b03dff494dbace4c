/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What is the same in all runs: the scene and the options that the user gave for it.
 */
#include <config.h>

#include <string.h>

#include "base/interrupt.h"
#include "scene/scene.h"
#include "settings.h"
#include "trade.h"

/* base and scene, as alidade understands them; to be released whatever the status is. */
static enum status parse_base(struct trade *t, struct settings *s)
{
	char *argv[256] = { (char *)(uintptr_t) "alidade" };
	int argc = 1;

	settings_init(s, &t->book);
	if (t->base_count > 250)
		return diag_fail(&t->diag, STATUS_USAGE, NULL, "too many options");
	for (uint32_t i = 0; i < t->base_count; i++)
		argv[argc++] = (char *)(uintptr_t)t->base[i];
	argv[argc++] = (char *)(uintptr_t) "--";
	argv[argc++] = (char *)(uintptr_t)t->scene;
	return settings_parse(s, argc, argv, &t->diag);
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
