/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * alidade: options -> read -> build -> render -> write. What each step does is in the folder that it is
 * named after; this file only calls them in turn, prints, and exits.
 */
#include <config.h>

#include <errno.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accel/load.h"
#include "accel/trace.h"
#include "base/clock.h"
#include "base/diag.h"
#include "base/interrupt.h"
#include "base/mem.h"
#include "base/pool.h"
#include "image/image.h"
#include "look/progress.h"
#include "look/require.h"
#include "look/stats.h"
#include "read/read.h"
#include "render/render.h"
#include "scene/dump.h"
#include "scene/scene.h"
#include "settings.h"

#define WARNINGS_SHOWN 20 /* unless -v was given */

/* One run of the program. Whatever has been made so far is taken down by run_release(). */
struct run {
	struct settings settings;
	struct diag diag;
	struct progress progress;
	struct mem_book book;
	struct pool *pool;
	struct accel_choice accel;
	struct scene scene;
	struct read_job job;
	struct geometry *geometry;
	struct image image;
	struct render_counts counts;
	double read_seconds, write_seconds;
	char accel_text[1024], options_text[256];
};

static void print_message(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	struct run *run = arg;
	int verbosity = run->settings.verbosity;
	char line[4096];

	if ((int)level > verbosity + 1)
		return;
	if (level == DIAG_WARNING && verbosity < 1 && run->diag.warnings > WARNINGS_SHOWN)
		return;
	progress_erase(&run->progress);
	diag_format(line, sizeof(line), level, pos, text);
	fprintf(stderr, "alidade: %s\n", line);
}

static void print_hidden_warnings(const struct run *run)
{
	if (run->settings.verbosity == 0 && run->diag.warnings > WARNINGS_SHOWN)
		fprintf(stderr, "alidade: %u more warnings; -v shows them\n",
			run->diag.warnings - WARNINGS_SHOWN);
}

static bool asked_to_stop(void *arg)
{
	(void)arg;
	return interrupt_asked();
}

static void show_progress(void *arg, uint64_t done, uint64_t total)
{
	struct run *run = arg;

	progress_update(&run->progress, done, total, clock_seconds());
}

static enum status run_read(struct run *run)
{
	struct settings *s = &run->settings;
	double began = clock_seconds();
	enum status st;

	s->read.stop = asked_to_stop;
	progress_begin(&run->progress, "reading", began);
	st = read_scene(s->scene, &s->read, &run->scene, &run->job, &run->diag);
	run->read_seconds = clock_seconds() - began;
	progress_end(&run->progress, clock_seconds());
	if (st)
		return st;
	return settings_finish(s, &run->job, &run->diag);
}

static enum status run_build(struct run *run)
{
	enum status st;

	progress_begin(&run->progress, "building", clock_seconds());
	st = geometry_build(&run->geometry, &run->scene, &run->accel, run->pool, &run->book,
			    run->settings.stats, &run->diag);
	progress_end(&run->progress, clock_seconds());
	return st;
}

static enum status run_render(struct run *run)
{
	struct render_options *options = &run->settings.render;
	enum status st;

	options->progress = show_progress;
	options->stop = asked_to_stop;
	options->arg = run;
	progress_begin(&run->progress, "rendering", clock_seconds());
	st = render_scene(&run->scene, run->geometry, options, run->pool, &run->book, &run->image,
			  &run->counts, &run->diag);
	progress_end(&run->progress, clock_seconds());
	return st;
}

/* The alpha channel goes unless it was asked for; colours are premultiplied, so what is left is the
 * picture on black. In place: rows close up. */
static void drop_alpha(struct image *image)
{
	size_t pixels = (size_t)image->width * image->height;

	if (image->channels != 4)
		return;
	for (size_t i = 0; i < pixels; i++)
		memmove(image->pixel + 3 * i, image->pixel + 4 * i, 3 * sizeof(*image->pixel));
	image->channels = 3;
}

/* dir/name.png -> dir/name.partial.png */
static void partial_name(char *out, size_t size, const char *path)
{
	const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
	int stem = (int)(dot ? (size_t)(dot - path) : strlen(path));

	snprintf(out, size, "%.*s.partial%s", stem, path, dot ? dot : "");
}

static enum status run_write(struct run *run, bool complete)
{
	const struct settings *s = &run->settings;
	char hash[24], partial[4096];
	const char *path = s->output;
	const struct image_note note[] = {
		{ "Software", PACKAGE_STRING },
		{ "alidade.scene", hash },
		{ "alidade.options", run->options_text },
		{ "alidade.accelerator", run->accel_text },
	};
	double began = clock_seconds();
	enum status st;

	if (!complete) {
		partial_name(partial, sizeof(partial), path);
		path = partial;
	}
	snprintf(hash, sizeof(hash), "%016" PRIx64, scene_hash(&run->scene));
	if (!s->alpha)
		drop_alpha(&run->image);
	st = image_write(&run->image, path, s->bits, note, sizeof(note) / sizeof(*note), &run->diag);
	run->write_seconds = clock_seconds() - began;
	if (!st && !complete)
		fprintf(stderr, "alidade: stopped; what is there is in %s\n", path);
	return st;
}

static enum status write_stats(struct run *run, bool complete)
{
	const struct settings *s = &run->settings;
	const struct stats stats = {
		.version = PACKAGE_VERSION, .scene = s->scene, .output = s->output,
		.options = run->options_text, .accel = run->accel_text,
		.scene_hash = scene_hash(&run->scene), .threads = pool_threads(run->pool),
		.width = run->image.width, .height = run->image.height, .geometry = run->geometry,
		.render = &run->counts, .book = &run->book, .read_seconds = run->read_seconds,
		.write_seconds = run->write_seconds, .complete = complete,
	};
	FILE *out;
	bool good;

	if (!s->stats_file) {
		stats_text(&stats, stderr);
		return STATUS_OK;
	}
	out = fopen(s->stats_file, "w");
	if (!out)
		return diag_fail(&run->diag, STATUS_FAILED, NULL, "%s: %s", s->stats_file, strerror(errno));
	good = stats_json(&stats, out);
	if (fclose(out) || !good)
		return diag_fail(&run->diag, STATUS_FAILED, NULL, "%s: could not be written: %s",
				 s->stats_file, strerror(errno));
	return STATUS_OK;
}

static void report_nonfinite(struct run *run)
{
	/* An error, so that -q does not silence it. */
	diag_report(&run->diag, DIAG_ERROR, NULL,
		    "%" PRIu64 " pixels have samples that are not finite numbers, the first at %u,%u; they "
		    "are black in the picture. Unless the scene's numbers are extreme, please report it "
		    "with the scene",
		    run->counts.nonfinite, run->counts.nonfinite_x, run->counts.nonfinite_y);
}

/* Render and write; the picture is written whole, or what there is of it beside an older one. */
static enum status run_picture(struct run *run)
{
	enum status st, written = STATUS_OK;
	bool complete;

	st = run_build(run);
	if (st)
		return st;
	if (interrupt_asked())
		return STATUS_SIGINT;
	st = run_render(run);
	if (st && st != STATUS_SIGINT && st != STATUS_NONFINITE)
		return st;
	complete = st != STATUS_SIGINT;
	if (run->counts.nonfinite)
		report_nonfinite(run);
	if (complete || run->counts.pixels)
		written = run_write(run, complete);
	if (!written && run->settings.stats)
		written = write_stats(run, complete);
	return written ? written : st;
}

static enum status run_dry(struct run *run)
{
	enum status st = run_build(run);

	if (st)
		return st;
	require_text(&run->scene, run->geometry, run->accel_text, &run->book, stdout);
	if (run->settings.verbosity > 0)
		scene_dump(&run->scene, SCENE_DUMP_PLACES, stdout);
	return STATUS_OK;
}

static enum status run_start(struct run *run)
{
	struct settings *s = &run->settings;
	enum status st;

	interrupt_install();
	progress_init(&run->progress, s->progress, stderr);
	run->book.limit = s->memory;
	run->pool = pool_new(s->threads ? s->threads : pool_cores());
	if (!run->pool)
		return diag_fail(&run->diag, STATUS_FAILED, NULL, "could not start %u threads",
				 s->threads ? s->threads : pool_cores());
	st = accel_load(&run->accel, s->accel, &run->diag);
	if (st)
		return st;
	accel_describe(&run->accel, run->accel_text, sizeof(run->accel_text));
	if (!s->output || s->dry_run)
		return STATUS_OK;
	return image_can_write(s->output, s->bits, &run->diag);
}

static enum status run_all(struct run *run)
{
	struct settings *s = &run->settings;
	enum status st = run_start(run);

	if (!st)
		st = run_read(run);
	if (!st && s->dry_run)
		return run_dry(run);
	if (!st && !(s->given & GIVEN_OUTPUT))
		st = image_can_write(s->output, s->bits, &run->diag);
	if (st)
		return st;
	settings_describe(s, run->options_text, sizeof(run->options_text));
	return run_picture(run);
}

static void run_release(struct run *run)
{
	image_release(&run->image);
	geometry_free(run->geometry);
	scene_release(&run->scene);
	accel_unload(&run->accel);
	pool_free(run->pool);
	settings_release(&run->settings);
}

static void print_params(const ald_param *p)
{
	for (; p && p->name; p++) {
		printf("    %s=", p->name);
		if (p->type == ALD_BOOL)
			printf("%s  (0 or 1)", p->def != 0 ? "1" : "0");
		else if (p->type == ALD_CHOICE)
			for (int i = 0; p->label && p->label[i]; i++)
				printf("%s%s%s", i ? "|" : "", p->label[i], i == (int)p->def ? "*" : "");
		else
			printf("%.17g  (%.17g to %.17g)", p->def, p->min, p->max);
		printf("  %s\n", p->help);
	}
}

static void print_accel(void *arg, const struct accel_choice *a)
{
	const struct run *run = arg;

	printf("%-10s  %s\n", a->plugin->name, a->plugin->summary);
	if (run->settings.verbosity > 0)
		printf("    version %s, %s, %s\n", a->plugin->version, a->plugin->license,
		       a->handle ? a->path : "built in");
	print_params(a->plugin->params);
}

static void print_version(void)
{
	puts(PACKAGE_STRING);
	printf("accelerator interface %u, plugins in %s\n", ALD_ACCEL_ABI, ALIDADE_PLUGIN_DIR);
#ifdef HAVE_OPENEXR
	puts("pictures: ppm, pfm, png, exr; others through the OpenImageIO module where it is installed");
#else
	puts("pictures: ppm, pfm, png; others through the OpenImageIO module where it is installed");
#endif
	puts("Copyright 2026 The Alidade authors. Licence: Apache-2.0. There is no warranty.");
}

static enum status act(struct run *run)
{
	switch (run->settings.action) {
	case ACTION_HELP:
		options_help(&settings_program, stdout);
		return STATUS_OK;
	case ACTION_VERSION:
		print_version();
		return STATUS_OK;
	case ACTION_LIST_ACCELS:
		return accel_list(print_accel, run, &run->diag);
	case ACTION_COMPLETION:
		if (!options_completion(&settings_program, run->settings.shell, stdout))
			return diag_fail(&run->diag, STATUS_USAGE, NULL,
					 "--print-completion=%s: expected bash, zsh or fish",
					 run->settings.shell);
		return STATUS_OK;
	default:
		return run_all(run);
	}
}

int main(int argc, char **argv)
{
	struct run run = { 0 };
	int status;

	run.diag = (struct diag){ print_message, &run, 0, 0 };
	mem_book_init(&run.book, 0);
	scene_init(&run.scene, &run.book);
	settings_init(&run.settings, &run.book);
	status = (int)settings_parse(&run.settings, argc, argv, &run.diag);
	if (!status)
		status = (int)act(&run);
	if (status == STATUS_SIGINT && interrupt_status())
		status = interrupt_status();
	print_hidden_warnings(&run);
	run_release(&run);
	if (fflush(stdout) || ferror(stdout)) {
		fprintf(stderr, "alidade: error: standard output: %s\n", strerror(errno));
		status = status ? status : STATUS_FAILED;
	}
	return status;
}
