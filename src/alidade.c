/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * alidade: options -> read -> build -> render -> write, for each frame. What each step does is in the folder
 * that it is named after; this file only calls them in turn, prints, and exits.
 */
#include <config.h>

#include <errno.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "accel/load.h"
#include "accel/trace.h"
#include "accel/verify.h"
#include "base/clock.h"
#include "base/diag.h"
#include "base/interrupt.h"
#include "base/mem.h"
#include "base/pool.h"
#include "base/process.h"
#include "base/room.h"
#include "image/image.h"
#include "look/progress.h"
#include "look/reached.h"
#include "pattern/mip.h"
#include "look/require.h"
#include "look/stats.h"
#include "read/pictures.h"
#include "read/read.h"
#include "render/foresee.h"
#include "render/render.h"
#include "scene/dump.h"
#include "scene/scene.h"
#include "settings.h"

#define WARNINGS_SHOWN 20 /* unless -v was given */
#define SAID 256

/* One run of the program. Whatever has been made so far is taken down by run_release(). */
struct run {
	struct settings settings;
	struct diag diag;
	struct progress progress;
	struct mem_book book;
	struct pool *pool;
	struct accel_choice accel;
	struct frame_plan plan;
	struct read_stdin standard_input;
	struct read_pictures pictures;
	struct scene store[2]; /* this frame's scene, and the one that the geometry was built from */
	struct scene *scene;
	struct read_job job;
	struct geometry *geometry;
	const struct scene *built; /* what geometry stands for; NULL: there is none */
	bool reused;
	uint64_t drawn, skipped, reuses; /* frames */
	struct image image;
	struct render_counts counts;
	double began; /* this frame */
	double read_seconds, write_seconds;
	FILE *stats;
	char scene_name[4096], output[4096]; /* of this frame */
	char accel_text[1024], options_text[256];
	uint64_t said[SAID]; /* hashes of warnings: each frame would repeat them */
	uint32_t said_count;
};

/* Has this text been shown in an earlier frame? */
static bool said_before(struct run *run, const char *text)
{
	uint64_t h = 14695981039346656037u;

	if (!run->plan.animated)
		return false;
	for (const char *c = text; *c; c++)
		h = (h ^ (unsigned char)*c) * 1099511628211u;
	for (uint32_t i = 0; i < run->said_count; i++) {
		if (run->said[i] == h)
			return true;
	}
	if (run->said_count < SAID)
		run->said[run->said_count++] = h;
	return false;
}

static void print_message(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	struct run *run = arg;
	int verbosity = run->settings.verbosity;
	char line[4096];

	if ((int)level > verbosity + 1)
		return;
	diag_format(line, sizeof(line), level, pos, text);
	if (level == DIAG_WARNING && said_before(run, line)) {
		run->diag.warnings--;
		return;
	}
	if (level == DIAG_WARNING && verbosity < 1 && run->diag.warnings > WARNINGS_SHOWN)
		return;
	progress_erase(&run->progress);
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

/* The geometry keeps the scene it was built from; the other place is for the new one. */
static enum status run_read(struct run *run)
{
	struct settings *s = &run->settings;
	double began = clock_seconds();
	enum status st;

	run->scene = run->built == &run->store[0] ? &run->store[1] : &run->store[0];
	scene_release(run->scene);
	scene_init(run->scene, &run->book);
	s->read.stop = asked_to_stop;
	s->read.pool = run->pool;
	if (run->plan.animated) {
		s->read.pictures = &run->pictures;
		read_pictures_begin(&run->pictures);
	}
	progress_begin(&run->progress, "reading", began);
	st = read_scene(run->scene_name, &s->read, run->scene, &run->job, &run->diag);
	if (run->plan.animated)
		read_pictures_end(&run->pictures);
	else
		read_stdin_release(&run->standard_input);
	run->read_seconds = clock_seconds() - began;
	progress_end(&run->progress, clock_seconds());
	if (st)
		return st;
	return settings_finish(s, &run->job, &run->diag);
}

/* Rays that the geometry will serve: of an animation all frames', until it shows that its shapes move. */
static double foresee(const struct run *run)
{
	double rays = render_foresee(run->scene, &run->settings.render);
	bool moves = run->progress.index > 1;

	return moves || !run->progress.count ? rays : rays * (double)run->progress.count;
}

/* From the earlier frame's, or if that can't be, anew. */
static enum status run_geometry(struct run *run)
{
	enum status st = STATUS_FAILED;

	if (run->geometry)
		st = geometry_renew(run->geometry, run->scene, &run->accel, run->settings.stats, &run->diag);
	if (!st)
		return st;
	geometry_free(run->geometry);
	run->geometry = NULL;
	run->built = NULL;
	if (st == STATUS_SIGINT)
		return st;
	return geometry_build(&run->geometry, run->scene, &run->accel, run->pool, &run->book, run->settings.stats,
			      &run->diag);
}

static enum status run_build(struct run *run)
{
	enum status st;

	progress_begin(&run->progress, "building", clock_seconds());
	run->reused = run->geometry && geometry_reuse(run->geometry, run->scene);
	if (run->reused) {
		run->reuses++;
		progress_end(&run->progress, clock_seconds());
		return STATUS_OK;
	}
	run->accel.rays = foresee(run);
	run->accel.guard = true;
	run->accel.later = render_memory(&run->settings.render, pool_threads(run->pool));
	st = run_geometry(run);
	if (!st)
		run->built = run->scene;
	if (!st && run->settings.verify)
		st = verify_begin(run->geometry, run->settings.verify, run->pool, &run->diag);
	progress_end(&run->progress, clock_seconds());
	return st;
}

static enum status run_render(struct run *run)
{
	struct render_options *options = &run->settings.render;
	enum status st;

	options->deadline = options->seconds > 0 ? run->began + options->seconds : 0;
	options->progress = show_progress;
	options->stop = asked_to_stop;
	options->arg = run;
	progress_begin(&run->progress, "rendering", clock_seconds());
	st = render_scene(run->scene, run->geometry, options, run->pool, &run->book, &run->image,
			  &run->counts, &run->diag);
	progress_end(&run->progress, clock_seconds());
	return st;
}

/* The alpha channel goes unless it was asked for; colours are premultiplied, so what is left is the
 * picture on black. In place: rows close up. */
static void drop_alpha(struct image *image)
{
	size_t pixels = (size_t)image->width * image->height;
	uint32_t n = image->channels;

	for (size_t i = 0; i < pixels; i++) {
		float *to = image->pixel + (n - 1) * i, *from = image->pixel + n * i;

		to[0] = from[0];
		to[1] = from[1];
		to[2] = from[2];
		for (uint32_t k = 4; k < n; k++)
			to[k - 1] = from[k];
	}
	memmove(image->name[3], image->name[4], (n - 4) * sizeof(image->name[0]));
	image->channels--;
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
	const char *path = run->output;
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
	snprintf(hash, sizeof(hash), "%016" PRIx64, scene_hash(run->scene));
	if (!s->alpha)
		drop_alpha(&run->image);
	progress_begin(&run->progress, "writing", began);
	st = image_write(&run->image, path, s->bits, note, sizeof(note) / sizeof(*note), run->pool,
			 &run->diag);
	run->write_seconds = clock_seconds() - began;
	progress_end(&run->progress, clock_seconds());
	if (!st && !complete)
		fprintf(stderr, "alidade: stopped; what is there is in %s\n", path);
	return st;
}

/* JSON is one object, or for an animation an array of one for each frame. */
static enum status put_stats(struct run *run, const struct stats *stats)
{
	const char *path = run->settings.stats_file;
	bool good;

	if (!run->stats) {
		run->stats = fopen(path, "w");
		if (!run->stats)
			return diag_fail(&run->diag, STATUS_FAILED, NULL, "%s: %s", path, strerror(errno));
		good = !run->plan.animated || fputs("[\n", run->stats) >= 0;
	} else {
		good = fputs(",\n", run->stats) >= 0;
	}
	good = good && stats_json(stats, run->stats) && !fflush(run->stats);
	if (!good)
		return diag_fail(&run->diag, STATUS_FAILED, NULL, "%s: could not be written: %s", path,
				 strerror(errno));
	return STATUS_OK;
}

/* Ends the array also where an error or a signal ended the animation. */
static enum status close_stats(struct run *run)
{
	bool good = true;

	if (!run->stats)
		return STATUS_OK;
	if (run->plan.animated)
		good = fputs("]\n", run->stats) >= 0;
	if (fclose(run->stats))
		good = false;
	run->stats = NULL;
	if (good)
		return STATUS_OK;
	return diag_fail(&run->diag, STATUS_FAILED, NULL, "%s: could not be written: %s",
			 run->settings.stats_file, strerror(errno));
}

static enum status write_stats(struct run *run, bool complete)
{
	const struct settings *s = &run->settings;
	const struct stats stats = {
		.version = PACKAGE_VERSION, .scene = run->scene_name, .output = run->output,
		.options = run->options_text, .accel = run->accel_text,
		.scene_hash = scene_hash(run->scene), .threads = pool_threads(run->pool),
		.width = run->image.width, .height = run->image.height, .geometry = run->geometry,
		.render = &run->counts, .book = &run->book, .process_most = room_process_most(),
		.read_seconds = run->read_seconds,
		.write_seconds = run->write_seconds, .complete = complete,
		.animated = run->plan.animated, .frame = s->read.frame.number,
		.clock = s->read.frame.clock, .reused = run->reused, .pictures_kept = run->pictures.kept,
	};

	if (s->stats_file)
		return put_stats(run, &stats);
	stats_text(&stats, stderr);
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

static void report_differences(struct run *run, const struct verify_list *list, enum diag_level level)
{
	char line[2048];

	for (uint32_t i = 0; i < list->count; i++) {
		verify_describe(run->geometry, &list->one[i], line, sizeof(line));
		diag_report(&run->diag, level, NULL, "%s", line);
	}
}

/* Errors, so that -q does not silence them. False: there are some. What the precision costs is none. */
static bool report_verified(struct run *run)
{
	struct verify_counts c;
	uint64_t checked = 0, different = 0, inexact = 0;

	verify_get(run->geometry, &c);
	for (int q = 0; q < VERIFY_QUESTIONS; q++) {
		checked += c.checked[q];
		different += c.different[q];
		inexact += c.inexact[q];
	}
	report_differences(run, &c.first, DIAG_ERROR);
	report_differences(run, &c.first_inexact, DIAG_INFO);
	if (inexact)
		diag_report(&run->diag, DIAG_INFO, NULL,
			    "of %" PRIu64 " rays that were traced again in exact order, %" PRIu64 " met another "
			    "primitive; --precision=exact would have found it", checked, inexact);
	if (different)
		diag_report(&run->diag, DIAG_ERROR, NULL,
			    "of %" PRIu64 " rays that were traced again without the accelerator, %" PRIu64
			    " got another answer: %s is not to be trusted with this scene; please report it, with "
			    "the scene", checked, different, run->accel_text);
	else if (c.every)
		diag_report(&run->diag, DIAG_INFO, NULL,
			    "%" PRIu64 " rays were traced again without the accelerator, and got the same answers",
			    checked);
	return different == 0;
}

/* An error if it was missed, so that -q does not silence it. */
static void report_reached(struct run *run)
{
	const struct render_reached *r = &run->counts.reached;
	char line[1024];

	reached_text(r, clock_seconds() - run->began, line, sizeof(line));
	if (r->missed)
		diag_report(&run->diag, DIAG_ERROR, NULL, "%s", line);
	else if (run->settings.verbosity >= 0)
		fprintf(stderr, "alidade: %s\n", line);
}

/* Render and write; the picture is written whole, or what there is of it beside an older one. */
static enum status run_picture(struct run *run)
{
	enum status st, written = STATUS_OK;
	bool complete;

	st = run_build(run);
	if (!st && run->settings.render.texture_mip)
		st = mip_build(run->scene, run->pool, &run->diag);
	if (st)
		return st;
	if (interrupt_asked())
		return STATUS_SIGINT;
	st = run_render(run);
	if (st && st != STATUS_SIGINT && st != STATUS_NONFINITE && st != STATUS_BUDGET)
		return st;
	complete = st != STATUS_SIGINT;
	if (run->counts.nonfinite)
		report_nonfinite(run);
	if (!report_verified(run))
		st = st == STATUS_SIGINT ? st : STATUS_VERIFY;
	if (complete && run->counts.reached.told)
		report_reached(run);
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
	require_text(run->scene, run->geometry, run->accel_text, &run->book,
		     run->settings.verbosity > 0, stdout);
	if (run->settings.verbosity > 0)
		scene_dump(run->scene, SCENE_DUMP_PLACES, stdout);
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
	if (!st)
		st = accel_set_precision(&run->accel, s->precision, &run->diag);
	if (st)
		return st;
	accel_describe(&run->accel, run->accel_text, sizeof(run->accel_text));
	return STATUS_OK;
}

static enum status name_frame(struct run *run, char *out, const char *name, bool insert)
{
	const struct frame_now *f = &run->settings.read.frame;
	bool good;

	if (run->plan.animated)
		good = frames_name(out, sizeof(run->output), name, f->number, run->plan.digits, insert);
	else
		good = (size_t)snprintf(out, sizeof(run->output), "%s", name) < sizeof(run->output);
	return good ? STATUS_OK :
		      diag_fail(&run->diag, STATUS_USAGE, NULL, "the file name is too long: %s", name);
}

/* Pictures appear under their names only when they are whole. */
static bool is_there(const char *path)
{
	struct stat st;

	return !stat(path, &st) && st.st_size > 0;
}

static bool can_skip(const struct run *run)
{
	return run->settings.skip_existing && !run->settings.dry_run && is_there(run->output);
}

/* The scene is read, so that all is known of it that an .ini says: draw it. */
static enum status run_known(struct run *run)
{
	struct settings *s = &run->settings;
	enum status st;

	if (s->dry_run) {
		if (run->plan.animated)
			printf("frame %u, clock %g\n", s->read.frame.number, s->read.frame.clock);
		return run_dry(run);
	}
	st = name_frame(run, run->output, s->output, true);
	if (!st && !(s->given & GIVEN_OUTPUT))
		st = image_can_write(run->output, s->bits, &run->diag);
	if (st)
		return st;
	if (can_skip(run)) { /* only now is the name known */
		run->skipped++;
		return STATUS_OK;
	}
	settings_describe(s, run->options_text, sizeof(run->options_text));
	st = run_picture(run);
	image_release(&run->image);
	if (!st)
		run->drawn++;
	return st;
}

static enum status run_frame(struct run *run)
{
	struct settings *s = &run->settings;
	enum status st = name_frame(run, run->scene_name, s->scene, false);

	if (!st && s->given & GIVEN_OUTPUT && !s->dry_run) {
		st = name_frame(run, run->output, s->output, true);
		if (!st && can_skip(run)) {
			run->skipped++;
			return STATUS_OK;
		}
		if (!st)
			st = image_can_write(run->output, s->bits, &run->diag);
	}
	if (!st)
		st = run_read(run);
	return st ? st : run_known(run);
}

/* Where an animation stopped, and what there is of it. */
static void tell_stop(const struct run *run, uint64_t left)
{
	fprintf(stderr, "alidade: stopped at frame %u; %" PRIu64 " frame%s drawn%s, %" PRIu64 " not; "
		"--skip-existing goes on from there\n", run->settings.read.frame.number, run->drawn,
		run->drawn == 1 ? " was" : "s were", run->skipped ? ", others were there" : "", left);
}

static enum status run_frames(struct run *run)
{
	uint64_t count = frames_count(&run->plan);
	enum status st = STATUS_OK, worst = STATUS_OK;

	run->settings.read.frame_digits = run->plan.digits;
	for (uint64_t i = 0; i < count && !st; i++) {
		frames_now(&run->plan, frames_number(&run->plan, i), &run->settings.read.frame);
		run->progress.frame = run->settings.read.frame.number;
		run->progress.index = i + 1;
		run->progress.count = run->plan.animated ? count : 0;
		if (i)
			run->began = clock_seconds();
		st = interrupt_asked() ? STATUS_SIGINT : run_frame(run);
		if (st == STATUS_NONFINITE || st == STATUS_VERIFY || st == STATUS_BUDGET) { /* a picture all the same */
			run->drawn++;
			worst = st > worst ? st : worst;
			st = STATUS_OK;
		}
		if (st && run->plan.animated)
			tell_stop(run, count - i);
	}
	return st ? st : worst;
}

static enum status run_all(struct run *run)
{
	struct settings *s = &run->settings;
	enum status st = run_start(run), closed;
	struct read_job job;

	if (st)
		return st;
	s->read.standard_input = &run->standard_input;
	if (s->frame_count && frames_has_place(s->scene))
		job = (struct read_job){ .set = 0 };
	else
		read_job_peek(s->scene, &s->read, &run->book, &job);
	settings_plan(s, &job, &run->plan);
	st = run_frames(run);
	closed = close_stats(run);
	return st ? st : closed;
}

static void run_release(struct run *run)
{
	image_release(&run->image);
	geometry_free(run->geometry);
	scene_release(&run->store[0]);
	scene_release(&run->store[1]);
	read_stdin_release(&run->standard_input);
	read_pictures_release(&run->pictures);
	accel_unload(&run->accel);
	pool_free(run->pool);
	settings_release(&run->settings);
}

static void print_params(const ald_param *p, uint32_t inexact)
{
	for (; p && p->name; p++, inexact >>= 1) {
		printf("    %s=", p->name);
		if (p->type == ALD_BOOL)
			printf("%s  (0 or 1)", p->def != 0 ? "1" : "0");
		else if (p->type == ALD_CHOICE)
			for (int i = 0; p->label && p->label[i]; i++)
				printf("%s%s%s", i ? "|" : "", p->label[i], i == (int)p->def ? "*" : "");
		else
			printf("%.17g  (%.17g to %.17g)", p->def, p->min, p->max);
		printf("  %s%s\n", inexact & 1 ? "inexact, unless as by default: " : "", p->help);
	}
}

static void print_accel(void *arg, const struct accel_choice *a)
{
	const struct run *run = arg;

	printf("%-10s  %s\n", a->plugin->name, a->plugin->summary);
	if (run->settings.verbosity > 0)
		printf("    version %s, %s, %s\n", a->plugin->version, a->plugin->license,
		       a->handle ? a->path : "built in");
	print_params(a->plugin->params, a->plugin->inexact);
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

	process_begin();
	run.began = clock_seconds();
	run.diag = (struct diag){ print_message, &run, 0, 0 };
	mem_book_init(&run.book, 0);
	run.pictures.book = &run.book;
	scene_init(&run.store[0], &run.book);
	scene_init(&run.store[1], &run.book);
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
