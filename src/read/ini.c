/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Lines of Option=value; comments begin with ; or #, also behind a value. What follows a [section] is
 * for those who name it to POV-Ray. Options that have no meaning here are ignored, unknown ones are
 * named in a warning, so that a misspelt one is noticed.
 */
#include <config.h>

#include "read/ini.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "read/pov/number.h"

struct reader {
	struct ini *ini;
	struct scene *scene;
	struct diag *diag;
	struct diag_pos pos;
	bool section;
	const char *folder; /* of the .ini, with its slash */
	struct read_define *define; /* room for one a line */
	const char **library;
	enum status status;
};

static const char *skip_blank(const char *at, const char *end)
{
	while (at < end && (*at == ' ' || *at == '\t' || *at == '\r'))
		at++;
	return at;
}

static bool is_name(char c)
{
	return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* The first line that is neither empty nor a ; comment decides: Name=, or [section]. A scene begins with
 * # or with a word and a brace. */
bool ini_recognise(const char *bytes, size_t size)
{
	const char *at = bytes, *end = bytes + size, *newline;

	if (size >= 3 && !memcmp(at, "\xef\xbb\xbf", 3))
		at += 3;
	for (;;) {
		at = skip_blank(at, end);
		if (at >= end)
			return false;
		if (*at != ';' && *at != '\n')
			break;
		newline = memchr(at, '\n', (size_t)(end - at));
		if (!newline)
			return false;
		at = newline + 1;
	}
	if (*at == '[')
		return true;
	if (!is_name(*at))
		return false;
	while (at < end && is_name(*at))
		at++;
	at = skip_blank(at, end);
	return at < end && *at == '=';
}

static void *keep(struct reader *r, size_t bytes)
{
	void *p = arena_zalloc(&r->scene->arena, bytes);

	if (!p)
		r->status = diag_no_memory(r->diag, "the .ini file", bytes);
	return p;
}

static bool number(struct reader *r, const char *name, const char *value, double *out)
{
	const char *end = value + strlen(value), *at = value;
	bool negative = *at == '-';

	at = number_parse(at + (*at == '-' || *at == '+'), end, out);
	if (at && skip_blank(at, end) == end && isfinite(*out)) {
		if (negative)
			*out = -*out;
		return true;
	}
	r->status = diag_fail(r->diag, STATUS_SCENE, &r->pos, "%s=%s: the value is no number", name, value);
	return false;
}

static bool count(struct reader *r, const char *name, const char *value, uint32_t max, uint32_t *out)
{
	double v;

	if (!number(r, name, value, &v))
		return false;
	if (v >= 1 && v <= max && v == floor(v)) {
		*out = (uint32_t)v;
		return true;
	}
	r->status = diag_fail(r->diag, STATUS_SCENE, &r->pos, "%s=%s: it must be a whole number from 1 to %u",
			      name, value, max);
	return false;
}

static bool boolean(struct reader *r, const char *name, const char *value, bool *out)
{
	static const char *const yes[] = { "on", "true", "yes", "1" };
	static const char *const no[] = { "off", "false", "no", "0" };

	for (size_t i = 0; i < 4; i++) {
		if (!strcasecmp(value, yes[i]) || !strcasecmp(value, no[i])) {
			*out = !strcasecmp(value, yes[i]);
			return true;
		}
	}
	r->status = diag_fail(r->diag, STATUS_SCENE, &r->pos, "%s=%s: it must be on or off", name, value);
	return false;
}

/* A path in the .ini is relative to the folder of the .ini. */
static char *path_value(struct reader *r, const char *value)
{
	size_t a = *value == '/' ? 0 : strlen(r->folder), b = strlen(value);
	char *path = keep(r, a + b + 1);

	if (path) {
		memcpy(path, r->folder, a);
		memcpy(path + a, value, b);
	}
	return path;
}

/* Declare=NAME=VALUE */
static void declare(struct reader *r, const char *value)
{
	const char *equals = strchr(value, '=');
	char *name;

	if (!equals || equals == value) {
		r->status = diag_fail(r->diag, STATUS_SCENE, &r->pos,
				      "Declare=%s: it must be Declare=NAME=VALUE", value);
		return;
	}
	name = keep(r, (size_t)(equals - value) + 1);
	if (!name)
		return;
	memcpy(name, value, (size_t)(equals - value));
	while (*name && name[strlen(name) - 1] == ' ')
		name[strlen(name) - 1] = 0;
	r->define[r->ini->define_count++] =
		(struct read_define){ name, skip_blank(equals + 1, equals + 1 + strlen(equals + 1)) };
}

enum option { IGNORED, INPUT, OUTPUT, WIDTH, HEIGHT, AA, AA_DEPTH, AA_THRESHOLD, AA_METHOD, AA_GAMMA,
	      START_ROW, END_ROW, START_COLUMN, END_COLUMN, ALPHA, DECLARE, LIBRARY };

/* Those that are ignored concern POV-Ray's own output, speed or window. */
static const struct {
	const char *name;
	enum option option;
} option_table[] = {
	{ "All_Console", IGNORED }, { "All_File", IGNORED }, { "Antialias", AA },
	{ "Antialias_Depth", AA_DEPTH }, { "Antialias_Gamma", AA_GAMMA },
	{ "Antialias_Threshold", AA_THRESHOLD }, { "Bits_Per_Color", IGNORED },
	{ "Bounding", IGNORED }, { "Bounding_Method", IGNORED }, { "Bounding_Threshold", IGNORED },
	{ "Compression", IGNORED }, { "Continue_Trace", IGNORED }, { "Create_Ini", IGNORED },
	{ "Debug_Console", IGNORED }, { "Debug_File", IGNORED }, { "Declare", DECLARE },
	{ "Display", IGNORED }, { "Display_Gamma", IGNORED }, { "Dither", IGNORED },
	{ "Dither_Method", IGNORED }, { "End_Column", END_COLUMN }, { "End_Row", END_ROW },
	{ "Fatal_Console", IGNORED }, { "Fatal_File", IGNORED }, { "File_Gamma", IGNORED },
	{ "Grayscale_Output", IGNORED }, { "Height", HEIGHT }, { "Input_File_Name", INPUT },
	{ "Jitter", IGNORED }, { "Jitter_Amount", IGNORED }, { "Library_Path", LIBRARY },
	{ "Light_Buffer", IGNORED }, { "Max_Image_Buffer_Memory", IGNORED },
	{ "Output_Alpha", ALPHA }, { "Output_File_Name", OUTPUT }, { "Output_File_Type", IGNORED },
	{ "Output_To_File", IGNORED }, { "Palette", IGNORED }, { "Pause_When_Done", IGNORED },
	{ "Preview_End_Size", IGNORED }, { "Preview_Start_Size", IGNORED }, { "Quality", IGNORED },
	{ "Remove_Bounds", IGNORED }, { "Render_Block_Size", IGNORED }, { "Render_Console", IGNORED },
	{ "Render_File", IGNORED }, { "Render_Pattern", IGNORED }, { "Sampling_Method", AA_METHOD },
	{ "Split_Unions", IGNORED }, { "Start_Column", START_COLUMN }, { "Start_Row", START_ROW },
	{ "Statistic_Console", IGNORED }, { "Statistic_File", IGNORED }, { "Test_Abort", IGNORED },
	{ "Test_Abort_Count", IGNORED }, { "Verbose", IGNORED }, { "Version", IGNORED },
	{ "Video_Mode", IGNORED }, { "Vista_Buffer", IGNORED }, { "Warning_Console", IGNORED },
	{ "Warning_File", IGNORED }, { "Warning_Level", IGNORED }, { "Width", WIDTH },
	{ "Work_Threads", IGNORED },
};

static void apply(struct reader *r, enum option option, const char *name, char *value)
{
	struct read_job *j = r->ini->job;
	bool ok = true;
	char *path;

	switch (option) {
	case IGNORED: return;
	case INPUT: r->ini->input = path_value(r, value); return;
	case OUTPUT:
		path = path_value(r, value);
		j->output = path;
		j->set |= READ_JOB_OUTPUT;
		return;
	case LIBRARY:
		r->library[r->ini->folder_count] = path_value(r, value);
		r->ini->folder_count++;
		return;
	case DECLARE: declare(r, value); return;
	case WIDTH: ok = count(r, name, value, 1 << 20, &j->width); break;
	case HEIGHT: ok = count(r, name, value, 1 << 20, &j->height); break;
	case AA: ok = boolean(r, name, value, &j->aa); break;
	case AA_DEPTH: ok = count(r, name, value, 9, &j->aa_depth); break;
	case AA_THRESHOLD: ok = number(r, name, value, &j->aa_threshold); break;
	case AA_METHOD: ok = count(r, name, value, 2, &j->aa_method); break;
	case AA_GAMMA: ok = number(r, name, value, &j->aa_gamma); break;
	case START_ROW: ok = number(r, name, value, &j->start_row); break;
	case END_ROW: ok = number(r, name, value, &j->end_row); break;
	case START_COLUMN: ok = number(r, name, value, &j->start_column); break;
	case END_COLUMN: ok = number(r, name, value, &j->end_column); break;
	case ALPHA: ok = boolean(r, name, value, &j->alpha); break;
	}
	static const unsigned bit[] = {
		[WIDTH] = READ_JOB_WIDTH, [HEIGHT] = READ_JOB_HEIGHT, [AA] = READ_JOB_AA,
		[AA_DEPTH] = READ_JOB_AA_DEPTH, [AA_THRESHOLD] = READ_JOB_AA_THRESHOLD,
		[AA_METHOD] = READ_JOB_AA_METHOD, [AA_GAMMA] = READ_JOB_AA_GAMMA,
		[START_ROW] = READ_JOB_START_ROW, [END_ROW] = READ_JOB_END_ROW,
		[START_COLUMN] = READ_JOB_START_COLUMN, [END_COLUMN] = READ_JOB_END_COLUMN,
		[ALPHA] = READ_JOB_ALPHA
	};
	if (ok)
		j->set |= bit[option];
}

/* A value without its quotes, and without the comment behind it; a # within a word is part of it. */
static void trim(const char **from, const char **to)
{
	const char *at = *from, *end = *to, *close;

	if (at < end && (*at == '"' || *at == '\'')) {
		close = memchr(at + 1, *at, (size_t)(end - at - 1));
		if (close) {
			*from = at + 1;
			*to = close;
			return;
		}
	}
	for (const char *p = at; p < end; p++) {
		if (*p == ';' || (*p == '#' && (p == at || p[-1] == ' ' || p[-1] == '\t')))
			end = p;
	}
	while (end > at && (end[-1] == ' ' || end[-1] == '\t' || end[-1] == '\r'))
		end--;
	*to = end;
}

/* One line, without its newline. */
static void line(struct reader *r, const char *at, const char *end)
{
	const char *name = at = skip_blank(at, end);
	char option[64], *value;

	if (at < end && *at == '[')
		r->section = true;
	if (at == end || *at == ';' || *at == '#' || r->section)
		return;
	while (at < end && is_name(*at))
		at++;
	if (at == name || (size_t)(at - name) >= sizeof(option) || skip_blank(at, end) == end ||
	    *skip_blank(at, end) != '=') {
		r->status = diag_fail(r->diag, STATUS_SCENE, &r->pos, "expected Option=value");
		return;
	}
	memcpy(option, name, (size_t)(at - name));
	option[at - name] = 0;
	at = skip_blank(skip_blank(at, end) + 1, end);
	trim(&at, &end);
	value = keep(r, (size_t)(end - at) + 1);
	if (!value)
		return;
	memcpy(value, at, (size_t)(end - at));
	for (size_t i = 0; i < sizeof(option_table) / sizeof(option_table[0]); i++) {
		if (!strcasecmp(option_table[i].name, option)) {
			apply(r, option_table[i].option, option_table[i].name, value);
			return;
		}
	}
	diag_report(r->diag, DIAG_WARNING, &r->pos, "the option %s is not known and ignored", option);
}

static bool prepare(struct reader *r, const char *path, const char *bytes, size_t size,
		    const struct read_options *o)
{
	const char *slash = strrchr(path, '/');
	uint32_t lines = 1;
	char *folder = keep(r, slash ? (size_t)(slash - path) + 2 : 1);

	for (const char *p = bytes; (p = memchr(p, '\n', (size_t)(bytes + size - p))); p++)
		lines++;
	r->define = keep(r, (lines + o->define_count) * sizeof(*r->define));
	r->library = keep(r, (lines + o->include_dir_count) * sizeof(*r->library));
	if (r->status)
		return false;
	if (slash)
		memcpy(folder, path, (size_t)(slash - path) + 1);
	r->folder = folder;
	if (o->include_dir_count)
		memcpy(r->library, o->include_dirs, o->include_dir_count * sizeof(*r->library));
	r->ini->folder_count = o->include_dir_count;
	r->ini->folder = r->library;
	return true;
}

enum status ini_read(struct ini *ini, const char *path, const char *bytes, size_t size,
		     const struct read_options *o, struct scene *scene, struct diag *diag)
{
	struct reader r = { .ini = ini, .scene = scene, .diag = diag, .pos = { path, 0, 0 } };
	const char *at = bytes, *end = bytes + size, *newline;

	if (!prepare(&r, path, bytes, size, o))
		return r.status;
	if (size >= 3 && !memcmp(at, "\xef\xbb\xbf", 3))
		at += 3;
	while (at < end && !r.status) {
		newline = memchr(at, '\n', (size_t)(end - at));
		r.pos.line++;
		r.pos.col = 1;
		line(&r, at, newline ? newline : end);
		at = newline ? newline + 1 : end;
	}
	/* The command line's declarations come last and win. */
	for (uint32_t i = 0; i < o->define_count && r.define; i++)
		r.define[ini->define_count++] = o->defines[i];
	ini->define = r.define;
	r.pos.line = r.pos.col = 0;
	if (!r.status && !ini->input)
		r.status = diag_fail(diag, STATUS_SCENE, &r.pos, "names no scene: Input_File_Name is missing");
	return r.status;
}
