/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Settings once the scene or its .ini file is known: what was not given on the command line.
 */
#include <config.h>

#include "settings.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "accel/load.h"

/* The last part of path, with ending in place of its own. */
static enum status name_after(struct settings *s, const char *path, const char *ending, struct diag *d)
{
	const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot;
	size_t length, room;

	if (!strcmp(path, "-"))
		base = "stdin";
	dot = strrchr(base, '.');
	length = dot && dot != base ? (size_t)(dot - base) : strlen(base);
	room = length + strlen(ending) + 1;
	s->output = arena_alloc(&s->arena, room);
	if (!s->output)
		return diag_no_memory(d, "the output's name", room);
	snprintf(s->output, room, "%.*s%s", (int)length, base, ending);
	return STATUS_OK;
}

/* The picture's name from an .ini; POV-Ray adds the ending where there is none. */
static enum status take_output(struct settings *s, const char *name, struct diag *d)
{
	const char *slash = strrchr(name, '/'), *base = slash ? slash + 1 : name;
	size_t room = strlen(name) + 5;

	s->output = arena_alloc(&s->arena, room);
	if (!s->output)
		return diag_no_memory(d, "the output's name", room);
	snprintf(s->output, room, "%s%s", name, strrchr(base, '.') ? "" : ".png");
	return STATUS_OK;
}

/* Rows and columns as POV-Ray takes them (measured): the first is 1; below 1 they are shares of the
 * side, rounded down; the end is inclusive, and as a share stands for the pixel before it. */
static bool job_span(const struct read_job *job, unsigned start_bit, double start, double end,
		     uint32_t side, uint32_t *from, uint32_t *length)
{
	bool has_start = job->set & start_bit, has_end = job->set & (start_bit << 1);
	double a = !has_start ? 0 : start < 1 ? floor(start * side) : floor(start) - 1;
	double b = !has_end ? side : end <= 1 ? floor(end * side) : floor(end);

	if (!(a >= 0 && b <= side && a < b))
		return false;
	*from = (uint32_t)a;
	*length = (uint32_t)(b - a);
	return true;
}

static enum status take_crop(struct settings *s, const struct read_job *job, struct diag *d)
{
	struct render_options *r = &s->render;

	if (!(job->set & (READ_JOB_START_ROW | READ_JOB_END_ROW | READ_JOB_START_COLUMN |
			  READ_JOB_END_COLUMN)))
		return STATUS_OK;
	if (!job_span(job, READ_JOB_START_COLUMN, job->start_column, job->end_column, r->width,
		      &r->crop_x, &r->crop_width) ||
	    !job_span(job, READ_JOB_START_ROW, job->start_row, job->end_row, r->height, &r->crop_y,
		      &r->crop_height))
		return diag_fail(d, STATUS_SCENE, NULL,
				 "%s: Start_ and End_Row and _Column leave nothing of a picture of %ux%u",
				 s->scene, r->width, r->height);
	return STATUS_OK;
}

static void take_aa(struct settings *s, const struct read_job *job)
{
	struct render_options *r = &s->render;

	r->aa = RENDER_AA_NONE;
	if (!(job->set & READ_JOB_AA) || !job->aa)
		return;
	r->aa = job->set & READ_JOB_AA_METHOD && job->aa_method == 2 ? RENDER_AA_POV2 : RENDER_AA_POV1;
	r->aa_n = job->set & READ_JOB_AA_DEPTH ? job->aa_depth : 3;
	r->aa_threshold = job->set & READ_JOB_AA_THRESHOLD ? job->aa_threshold : 0.3;
	r->aa_gamma = job->set & READ_JOB_AA_GAMMA ? job->aa_gamma : 2.5;
}

void settings_plan(const struct settings *s, const struct read_job *job, struct frame_plan *plan)
{
	struct frame_settings f = s->frames;
	unsigned own = f.set;

	if (!(s->given & GIVEN_RANGE)) {
		f = job->frames;
		if (f.set & (FRAMES_INITIAL | FRAMES_FINAL)) /* as POV-Ray, which then forgets Clock */
			f.set &= ~(unsigned)FRAMES_CLOCK;
	}
	if (own & FRAMES_CLOCK) {
		f.set |= FRAMES_CLOCK;
		f.clock = s->frames.clock;
	}
	frames_plan(plan, &f, s->frame, s->frame_count);
}

static bool ends_in(const char *name, const char *ending)
{
	size_t n = strlen(name), m = strlen(ending);

	return n >= m && !strcmp(name + n - m, ending);
}

/* A sample is one of everything, so nothing else can say how many there are. */
static enum status check_samples(const struct settings *s, struct diag *d)
{
	const struct render_options *r = &s->render;
	const char *other = s->given & GIVEN_AA						 ? "--aa" :
			    r->blur_samples						 ? "--blur-samples" :
			    r->indirect_samples && r->indirect != INDIRECT_CACHE ? "--indirect-samples" :
										   NULL;

	if ((r->spp || r->budget) && other)
		return diag_fail(d, STATUS_USAGE, NULL,
				 "%s and %s both say how many rays a pixel gets: give one of them",
				 r->spp ? "--spp" : r->seconds > 0 ? "--time" : "--noise", other);
	if (r->budget && r->indirect == INDIRECT_CACHE)
		return diag_fail(d, STATUS_USAGE, NULL, "%s", r->seconds > 0 ?
				 "--time cannot hurry --indirect=cache, which fills its cache first" :
				 "--noise does not know how far --indirect=cache is off");
	if (r->budget && !(r->noise > 0) && !(r->seconds > 0) && !r->spp)
		return diag_fail(d, STATUS_USAGE, NULL,
				 "--noise=0 is never reached: say with --spp or --time where to end");
	return STATUS_OK;
}

enum status settings_finish(struct settings *s, const struct read_job *job, struct diag *d)
{
	struct render_options *r = &s->render;
	enum status st = STATUS_OK;

	/* What the .ini of an earlier frame said is no more. */
	if (!(s->given & GIVEN_OUTPUT))
		s->output = NULL;
	if (!(s->given & GIVEN_ALPHA))
		s->alpha = false;
	if (!(s->given & GIVEN_CROP))
		r->crop_x = r->crop_y = r->crop_width = r->crop_height = 0;
	if (!(s->given & GIVEN_SIZE)) {
		r->width = job->set & READ_JOB_WIDTH ? job->width : READ_WIDTH;
		r->height = job->set & READ_JOB_HEIGHT ? job->height : READ_HEIGHT;
	}
	if (!(s->given & GIVEN_CROP))
		st = take_crop(s, job, d);
	if (!(s->given & GIVEN_AA))
		take_aa(s, job);
	if (r->spp || r->budget)
		r->aa = RENDER_AA_NONE;
	if (!(s->given & GIVEN_ALPHA) && job->set & READ_JOB_ALPHA)
		s->alpha = job->alpha;
	r->alpha = s->alpha;
	if (!st && !s->output && job->set & READ_JOB_OUTPUT && job->output && *job->output)
		st = take_output(s, job->output, d);
	if (!st && !s->output)
		st = name_after(s, s->scene, ".png", d);
	if (st)
		return st;
	st = check_samples(s, d);
	if (st)
		return st;
	/* An .ini of another frame may name another file. */
	r->clips = image_file_encoding(s->output) == IMAGE_SRGB;
	if (r->spp && s->given & GIVEN_ERROR)
		r->budget = true;
	r->error = s->given & GIVEN_ERROR || (r->budget && ends_in(s->output, ".exr"));
	if (r->error && r->indirect == INDIRECT_CACHE)
		return diag_fail(d, STATUS_USAGE, NULL,
				 "--error-layer does not know how far --indirect=cache is off");
	if (r->error && !ends_in(s->output, ".exr"))
		return diag_fail(d, STATUS_USAGE, NULL, "--error-layer needs a picture in .exr, not %s", s->output);
	if (r->crop_width && (r->crop_x >= r->width || r->crop_width > r->width - r->crop_x ||
			      r->crop_y >= r->height || r->crop_height > r->height - r->crop_y))
		return diag_fail(d, STATUS_USAGE, NULL,
				 "--crop=%u,%u,%u,%u reaches out of the picture of %ux%u", r->crop_x,
				 r->crop_y, r->crop_width, r->crop_height, r->width, r->height);
	return STATUS_OK;
}

void settings_describe(const struct settings *s, char *out, size_t size)
{
	static const char *const aa[] = { "none", "grid", "pov1", "pov2" };
	const struct render_options *r = &s->render;
	int n = snprintf(out, size, "%ux%u", r->width, r->height);

	if (r->crop_width && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " crop %u,%u,%u,%u", r->crop_x, r->crop_y,
			      r->crop_width, r->crop_height);
	if (n >= 0 && (size_t)n < size)
		n += r->spp    ? snprintf(out + n, size - (size_t)n, " %u samples a pixel", r->spp) :
		     r->budget ? 0 :
				 snprintf(out + n, size - (size_t)n, " aa %s", aa[r->aa]);
	if (r->budget && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " noise %g", r->noise);
	if (r->seconds > 0 && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " time %g", r->seconds);
	if (r->aa != RENDER_AA_NONE && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, ":depth=%u", r->aa_n);
	if (r->aa > RENDER_AA_GRID && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, ",threshold=%g,gamma=%g", r->aa_threshold,
			      r->aa_gamma);
	if (r->camera_only && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " camera only");
	if (r->indirect != INDIRECT_EXACT && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " indirect %s",
			      r->indirect == INDIRECT_CACHE ? "cache" : "off");
	if (r->texture_mip && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " mip");
	if (r->lift && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " terminator hanika");
	if (r->indirect_samples && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " indirect samples %u", r->indirect_samples);
	if (r->indirect_slack > 0 && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " indirect error %g", r->indirect_slack);
	if (s->precision != ALD_PRECISION_DEFAULT && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " precision %s", accel_precision_name(s->precision));
	if (r->error && n >= 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " error layer");
	if (r->seed && n >= 0 && (size_t)n < size)
		snprintf(out + n, size - (size_t)n, " seed %" PRIu64, r->seed);
}
