/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Lines of Option=value, or of switches as on POV-Ray's command line; comments begin with ; or #, also
 * behind a value. What follows a [section] is for those who name it to POV-Ray. Options that have no meaning
 * here are ignored, unknown ones are named in a warning, so that a misspelt one is noticed.
 */
#include <config.h>

#include "read/ini.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

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
	if (*at == '[' || *at == '+' || *at == '-')
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
	      START_ROW, END_ROW, START_COLUMN, END_COLUMN, ALPHA, DECLARE, LIBRARY, INITIAL_FRAME,
	      FINAL_FRAME, INITIAL_CLOCK, FINAL_CLOCK, SUBSET_START, SUBSET_END, FRAME_STEP, CLOCK, CYCLIC,
	      FIELDS, COMMAND };

/* Those that are ignored concern POV-Ray's own output, speed or window. */
static const struct {
	const char *name;
	enum option option;
} option_table[] = {
	{ "All_Console", IGNORED }, { "All_File", IGNORED }, { "Antialias", AA },
	{ "Antialias_Depth", AA_DEPTH }, { "Antialias_Gamma", AA_GAMMA },
	{ "Antialias_Threshold", AA_THRESHOLD }, { "Bits_Per_Color", IGNORED },
	{ "Bounding", IGNORED }, { "Bounding_Method", IGNORED }, { "Bounding_Threshold", IGNORED },
	{ "Clock", CLOCK }, { "Compression", IGNORED }, { "Continue_Trace", IGNORED },
	{ "Create_Ini", IGNORED }, { "Cyclic_Animation", CYCLIC }, { "Debug_Console", IGNORED },
	{ "Debug_File", IGNORED }, { "Declare", DECLARE }, { "Display", IGNORED },
	{ "Display_Gamma", IGNORED }, { "Dither", IGNORED }, { "Dither_Method", IGNORED },
	{ "End_Column", END_COLUMN }, { "End_Row", END_ROW }, { "Fatal_Console", IGNORED },
	{ "Fatal_Error_Command", COMMAND }, { "Fatal_Error_Return", IGNORED },
	{ "Fatal_File", IGNORED }, { "Field_Render", FIELDS }, { "File_Gamma", IGNORED },
	{ "Final_Clock", FINAL_CLOCK }, { "Final_Frame", FINAL_FRAME },
	{ "Frame_Step", FRAME_STEP }, { "Grayscale_Output", IGNORED }, { "Height", HEIGHT },
	{ "Initial_Clock", INITIAL_CLOCK }, { "Initial_Frame", INITIAL_FRAME },
	{ "Input_File_Name", INPUT }, { "Jitter", IGNORED }, { "Jitter_Amount", IGNORED },
	{ "Library_Path", LIBRARY }, { "Light_Buffer", IGNORED },
	{ "Max_Image_Buffer_Memory", IGNORED }, { "Odd_Field", IGNORED }, { "Output_Alpha", ALPHA },
	{ "Output_File_Name", OUTPUT }, { "Output_File_Type", IGNORED },
	{ "Output_To_File", IGNORED }, { "Palette", IGNORED }, { "Pause_When_Done", IGNORED },
	{ "Post_Frame_Command", COMMAND }, { "Post_Frame_Return", IGNORED },
	{ "Post_Scene_Command", COMMAND }, { "Post_Scene_Return", IGNORED },
	{ "Pre_Frame_Command", COMMAND }, { "Pre_Frame_Return", IGNORED },
	{ "Pre_Scene_Command", COMMAND }, { "Pre_Scene_Return", IGNORED },
	{ "Preview_End_Size", IGNORED }, { "Preview_Start_Size", IGNORED }, { "Quality", IGNORED },
	{ "Remove_Bounds", IGNORED }, { "Render_Block_Size", IGNORED },
	{ "Render_Console", IGNORED }, { "Render_File", IGNORED }, { "Render_Pattern", IGNORED },
	{ "Sampling_Method", AA_METHOD }, { "Split_Unions", IGNORED },
	{ "Start_Column", START_COLUMN }, { "Start_Row", START_ROW },
	{ "Statistic_Console", IGNORED }, { "Statistic_File", IGNORED },
	{ "Subset_End_Frame", SUBSET_END }, { "Subset_Start_Frame", SUBSET_START },
	{ "Test_Abort", IGNORED }, { "Test_Abort_Count", IGNORED },
	{ "User_Abort_Command", COMMAND }, { "User_Abort_Return", IGNORED }, { "Verbose", IGNORED },
	{ "Version", IGNORED }, { "Video_Mode", IGNORED }, { "Vista_Buffer", IGNORED },
	{ "Warning_Console", IGNORED }, { "Warning_File", IGNORED }, { "Warning_Level", IGNORED },
	{ "Width", WIDTH }, { "Work_Threads", IGNORED },
};

static bool frame_number(struct reader *r, const char *name, const char *value, uint32_t *out)
{
	double v;

	if (!number(r, name, value, &v))
		return false;
	if (v <= FRAME_MAX && v == floor(v)) {
		*out = v > 0 ? (uint32_t)v : 0; /* as POV-Ray */
		return true;
	}
	r->status = diag_fail(r->diag, STATUS_SCENE, &r->pos, "%s=%s: it must be a whole number up to %u",
			      name, value, FRAME_MAX);
	return false;
}

/* Half pictures for interlaced television: POV-Ray 3.7 has the option and draws whole ones. */
static bool field_render(struct reader *r, const char *name, const char *value)
{
	bool on = false;

	if (boolean(r, name, value, &on) && on)
		r->status = diag_fail(r->diag, STATUS_SCENE, &r->pos,
				      "%s is not supported: whole frames are drawn; leave it out", name);
	return !r->status;
}

static void apply_frames(struct reader *r, enum option option, const char *name, const char *value)
{
	struct frame_settings *f = &r->ini->job->frames;

	switch (option) {
	case INITIAL_FRAME:
		f->set |= FRAMES_INITIAL;
		frame_number(r, name, value, &f->initial_frame);
		break;
	case FINAL_FRAME:
		f->set |= FRAMES_FINAL;
		frame_number(r, name, value, &f->final_frame);
		break;
	case FRAME_STEP:
		f->set |= FRAMES_STEP;
		count(r, name, value, FRAME_MAX, &f->step);
		break;
	case INITIAL_CLOCK:
		f->set |= FRAMES_INITIAL_CLOCK;
		number(r, name, value, &f->initial_clock);
		break;
	case FINAL_CLOCK:
		f->set |= FRAMES_FINAL_CLOCK;
		number(r, name, value, &f->final_clock);
		break;
	case SUBSET_START:
		f->set |= FRAMES_SUBSET_START;
		number(r, name, value, &f->subset_start);
		break;
	case SUBSET_END:
		f->set |= FRAMES_SUBSET_END;
		number(r, name, value, &f->subset_end);
		break;
	case CLOCK:
		/* Taken for a still picture only, as in POV-Ray: frames_plan() is told so by the caller. */
		f->set |= FRAMES_CLOCK;
		number(r, name, value, &f->clock);
		break;
	case CYCLIC: boolean(r, name, value, &f->cyclic); break;
	default: field_render(r, name, value); break;
	}
}

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
	case COMMAND:
		if (*value)
			diag_report(r->diag, DIAG_WARNING, &r->pos, "%s is ignored: no commands are run", name);
		return;
	default: apply_frames(r, option, name, value); return;
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

static void take_option(struct reader *r, const char *name, char *value)
{
	for (size_t i = 0; i < sizeof(option_table) / sizeof(option_table[0]); i++) {
		if (!strcasecmp(option_table[i].name, name)) {
			apply(r, option_table[i].option, option_table[i].name, value);
			return;
		}
	}
	diag_report(r->diag, DIAG_WARNING, &r->pos, "the option %s is not known and ignored", name);
}

/* Of POV-Ray's command line: those that change the picture. A longer name stands before a shorter one
 * that begins it. boolean: + is on and - is off, and what follows is a value of its own. */
static const struct {
	const char *name;
	enum option option;
	bool boolean;
} switch_table[] = {
	{ "KFI", INITIAL_FRAME, false }, { "KFF", FINAL_FRAME, false }, { "KI", INITIAL_CLOCK, false },
	{ "KF", FINAL_CLOCK, false }, { "KC", CYCLIC, true }, { "K", CLOCK, false },
	{ "SF", SUBSET_START, false }, { "EF", SUBSET_END, false }, { "UF", FIELDS, true },
	{ "UO", IGNORED, true }, { "UA", ALPHA, true }, { "SR", START_ROW, false },
	{ "ER", END_ROW, false }, { "SC", START_COLUMN, false }, { "EC", END_COLUMN, false },
	{ "W", WIDTH, false }, { "H", HEIGHT, false }, { "I", INPUT, false }, { "O", OUTPUT, false },
	{ "L", LIBRARY, false }, { "AM", AA_METHOD, false }, { "AG", AA_GAMMA, false },
	{ "R", AA_DEPTH, false }, { "A", AA, true },
};

/* One switch with its sign; at its end there is a 0. */
static void take_switch(struct reader *r, char *text)
{
	char sign[] = "on", *value;

	if (*text == '-')
		memcpy(sign, "no", sizeof(sign));
	for (size_t i = 0; i < sizeof(switch_table) / sizeof(switch_table[0]); i++) {
		size_t length = strlen(switch_table[i].name);

		if (strncasecmp(text + 1, switch_table[i].name, length))
			continue;
		value = text + 1 + length;
		apply(r, switch_table[i].option, switch_table[i].name,
		      switch_table[i].boolean ? sign : value);
		if (switch_table[i].option == AA && *value && !r->status)
			apply(r, AA_THRESHOLD, "A", value);
		return;
	}
	diag_report(r->diag, DIAG_WARNING, &r->pos, "the switch %s is ignored", text);
}

static void switches(struct reader *r, const char *at, const char *end)
{
	const char *from, *to;
	char *text, *equals;

	for (at = skip_blank(at, end); at < end && *at != ';' && !r->status; at = skip_blank(to, end)) {
		for (from = to = at; to < end && !memchr(" \t\r;", *to, 4); to++)
			;
		text = keep(r, (size_t)(to - from) + 1);
		if (!text)
			return;
		memcpy(text, from, (size_t)(to - from));
		equals = strchr(text, '=');
		if (*text != '+' && *text != '-' && equals) {
			*equals = 0;
			take_option(r, text, equals + 1);
			continue;
		}
		if (*text != '+' && *text != '-') {
			r->status = diag_fail(r->diag, STATUS_SCENE, &r->pos,
					      "\"%s\": expected another switch with its + or -", text);
			return;
		}
		take_switch(r, text);
	}
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
	if (*at == '+' || *at == '-') {
		switches(r, at, end);
		return;
	}
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
	take_option(r, option, value);
}

static bool prepare(struct reader *r, const char *path, const char *bytes, size_t size,
		    const struct read_options *o)
{
	const char *slash = strrchr(path, '/');
	size_t lines = 1;
	char *folder = keep(r, slash ? (size_t)(slash - path) + 2 : 1);

	/* Or for more: a line of switches may have several of each. */
	for (const char *p = bytes; p < bytes + size; p++)
		lines += *p == '\n' || *p == '+' || *p == '-' || *p == '=';
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

/* An .ini that names no scene goes with the .pov of its name, if there is one: POV-Ray's examples are so, and
 * are given both names. */
static void find_beside(struct reader *r, const char *path)
{
	size_t length = strlen(path);
	char *scene;

	if (length < 4 || strcasecmp(path + length - 4, ".ini"))
		return;
	scene = keep(r, length + 1);
	if (!scene)
		return;
	memcpy(scene, path, length - 4);
	memcpy(scene + length - 4, ".pov", 5);
	if (!access(scene, R_OK))
		r->ini->input = scene;
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
		find_beside(&r, path);
	if (!r.status && !ini->input)
		r.status = diag_fail(diag, STATUS_SCENE, &r.pos, "names no scene: Input_File_Name is missing");
	return r.status;
}
