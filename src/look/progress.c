/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Percentages are rounded down, so that 100 means all of it.
 */
#include <config.h>

#include "look/progress.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/json_write.h"

#define BAR_EVERY 0.1 /* seconds between two pictures of the bar */
#define LINE_EVERY 10.0
#define LINE_SOONEST 1.0 /* work that is over sooner leaves no lines */
#define JSON_EVERY 0.2
#define ETA_SOONEST 0.5 /* before that, the time left would be a guess */

static bool can_erase(FILE *out)
{
	const char *term = getenv("TERM");

	return isatty(fileno(out)) && term && *term && strcmp(term, "dumb") != 0;
}

static uint32_t terminal_columns(FILE *out)
{
	struct winsize size;

	if (!ioctl(fileno(out), TIOCGWINSZ, &size) && size.ws_col >= 20)
		return size.ws_col;
	return 80;
}

void progress_init(struct progress *p, enum progress_mode mode, FILE *out)
{
	memset(p, 0, sizeof(*p));
	if (mode == PROGRESS_AUTO)
		mode = can_erase(out) ? PROGRESS_BAR : PROGRESS_LINES;
	p->mode = mode;
	p->out = mode == PROGRESS_JSON ? stdout : out;
	p->columns = terminal_columns(out);
}

void progress_erase(struct progress *p)
{
	if (!p->bar)
		return;
	fprintf(p->out, "\r%*s\r", (int)p->columns - 1, "");
	fflush(p->out);
	p->bar = false;
}

/* Seconds left, or -1 while they can't be told. */
static double time_left(const struct progress *p, uint64_t done, uint64_t total, double now)
{
	double spent = now - p->began;

	if (!done || spent < ETA_SOONEST)
		return -1;
	return spent * ((double)(total - done) / (double)done);
}

/* "0:07", "12:34", "3:00:00" */
static void clock_text(char *out, size_t size, double seconds)
{
	uint64_t s = (uint64_t)(seconds + 0.5);

	if (s >= 3600)
		snprintf(out, size, "%llu:%02u:%02u", (unsigned long long)(s / 3600),
			 (unsigned)(s / 60 % 60), (unsigned)(s % 60));
	else
		snprintf(out, size, "%u:%02u", (unsigned)(s / 60), (unsigned)(s % 60));
}

/* "frame 12 (3 of 50), rendering" */
static void phase_text(char *out, size_t size, const struct progress *p)
{
	if (p->count)
		snprintf(out, size, "frame %u (%llu of %llu), %s", p->frame, (unsigned long long)p->index,
			 (unsigned long long)p->count, p->phase);
	else
		snprintf(out, size, "%s", p->phase);
}

static void show_bar(struct progress *p, uint64_t done, uint64_t total, double now)
{
	double left = time_left(p, done, total, now);
	char text[240], bar[42] = "", time[24] = "", phase[120];
	int room, full;

	phase_text(phase, sizeof(phase), p);
	if (!total) {
		/* A shorter text than the last frame's leaves nothing of it. */
		snprintf(text, sizeof(text), "%.*s ...", (int)p->columns - 5, phase);
		fprintf(p->out, "\r%-*s", p->count ? (int)p->columns - 1 : 0, text);
	} else {
		if (left >= 0)
			clock_text(time, sizeof(time), left);
		room = (int)p->columns - (int)strlen(phase) - 24;
		room = room > 40 ? 40 : room < 4 ? 4 : room;
		full = (int)((double)done / (double)total * room);
		for (int i = 0; i < room; i++)
			bar[i] = i < full ? '#' : '.';
		snprintf(text, sizeof(text), "%s [%s] %3u %%  %s%-8s", phase, bar,
			 (unsigned)(100 * done / total), time, left >= 0 ? " left" : "");
		fprintf(p->out, "\r%.*s", (int)p->columns - 1, text);
	}
	fflush(p->out);
	p->bar = true;
	p->shown = now;
}

static void show_line(struct progress *p, uint64_t done, uint64_t total, double now)
{
	double left = time_left(p, done, total, now);
	char time[24], phase[120];

	phase_text(phase, sizeof(phase), p);
	clock_text(time, sizeof(time), left > 0 ? left : 0);
	fprintf(p->out, "%s: %u %% after %.0f s%s%s%s\n", phase, (unsigned)(100 * done / total),
		now - p->began, left >= 0 ? ", about " : "", left >= 0 ? time : "",
		left >= 0 ? " left" : "");
	fflush(p->out);
	p->shown = now;
	p->tenths = (uint32_t)(10 * done / total);
}

static double microseconds(double seconds)
{
	return round(1e6 * seconds) / 1e6;
}

static void show_json(struct progress *p, const char *kind, uint64_t done, uint64_t total, double now)
{
	double left = time_left(p, done, total, now);
	struct json_writer j;

	jw_init(&j, p->out, JW_LINE);
	jw_object(&j, NULL);
	jw_string(&j, "kind", kind);
	jw_string(&j, "phase", p->phase);
	if (p->count) {
		jw_uint(&j, "frame", p->frame);
		jw_uint(&j, "frame_index", p->index);
		jw_uint(&j, "frame_count", p->count);
	}
	if (total) {
		jw_uint(&j, "done", done);
		jw_uint(&j, "total", total);
	}
	jw_double(&j, "elapsed", microseconds(now - p->began));
	if (left >= 0 && total)
		jw_double(&j, "eta", microseconds(left));
	jw_end(&j);
	jw_finish(&j);
	p->shown = now;
}

void progress_begin(struct progress *p, const char *phase, double now)
{
	p->phase = phase;
	p->began = p->shown = now;
	p->tenths = 0;
	if (p->mode == PROGRESS_BAR)
		show_bar(p, 0, 0, now);
	else if (p->mode == PROGRESS_JSON)
		show_json(p, "begin", 0, 0, now);
}

void progress_update(struct progress *p, uint64_t done, uint64_t total, double now)
{
	double since = now - p->shown;

	if (!p->phase || !total)
		return;
	if (p->mode == PROGRESS_BAR && (since >= BAR_EVERY || done == total))
		show_bar(p, done, total, now);
	else if (p->mode == PROGRESS_JSON && (since >= JSON_EVERY || done == total))
		show_json(p, "progress", done, total, now);
	else if (p->mode == PROGRESS_LINES &&
		 (since >= LINE_EVERY ||
		  (since >= LINE_SOONEST && 10 * done / total > p->tenths)))
		show_line(p, done, total, now);
}

void progress_end(struct progress *p, double now)
{
	progress_erase(p);
	if (p->mode == PROGRESS_JSON && p->phase)
		show_json(p, "end", 0, 0, now);
	p->phase = NULL;
}
