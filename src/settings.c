/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include <config.h>

#include "settings.h"

#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "alidade/accel.h"
#include "read/limits.h"

enum {
	KEY_ALPHA = OPTION_LONG_ONLY, KEY_AA, KEY_BITS, KEY_BLUR_SAMPLES, KEY_CAMERA_ONLY,
	KEY_CLOCK, KEY_CROP, KEY_DRY_RUN, KEY_ERROR_LAYER, KEY_INDIRECT, KEY_INDIRECT_ERROR,
	KEY_INDIRECT_SAMPLES, KEY_LENIENT, KEY_LIMIT, KEY_LIST_ACCELS, KEY_MEMORY, KEY_NOISE,
	KEY_PRECISION, KEY_PRINT_COMPLETION, KEY_PROGRESS, KEY_RANGE, KEY_SEED, KEY_SKIP_EXISTING, KEY_SPP,
	KEY_STATS, KEY_TERMINATOR, KEY_TEXTURE_FILTER, KEY_TILE, KEY_TIME, KEY_VERIFY, KEY_VERSION, KEY_WRITE
};

#define INDIRECT_MAX (1u << 20)
#define INDIRECT_WORDS "exact cache off"
#define AA_WORDS "none 2 3 4 pov1 pov2"
/* A test holds these against read_limit_table. */
#define LIMIT_WORDS \
	"nesting= macro_depth= include_depth= loop_steps= string_bytes= tokens= elements= objects= " \
	"texture_pixels= texture_bytes= memory= seconds="

static const struct option_spec alidade_option[] = {
	{ "output", 'o', OPTION_ARG, "FILE", COMPLETE_FILE, NULL,
	  "write the picture to FILE; its ending names the format: .png, .exr, .ppm, .pfm, or what "
	  "OpenImageIO knows; otherwise the scene's name with .png, in the current folder",
	  "Picture" },
	{ "size", 's', OPTION_ARG, "WxH", COMPLETE_WORDS, "320x240 640x480 800x600 1280x720 1920x1080",
	  "width and height in pixels; 800x600 unless an .ini file says otherwise", NULL },
	{ "crop", KEY_CROP, OPTION_ARG, "X,Y,W,H", COMPLETE_NOTHING, NULL,
	  "render and write only this part of the picture: left, top, width, height in pixels", NULL },
	{ "aa", KEY_AA, OPTION_ARG, "METHOD", COMPLETE_WORDS, AA_WORDS,
	  "anti-aliasing: none; N for N x N rays a pixel; pov1 or pov2 for POV-Ray's adaptive methods, "
	  "with :threshold=..,depth=..,gamma=..; none is the default",
	  NULL },
	{ "spp", KEY_SPP, OPTION_ARG, "N", COMPLETE_WORDS, "16 64 256 1024",
	  "N samples a pixel, of its area and of all that is random: focal blur, soft shadows, indirect light; "
	  "instead of --aa",
	  NULL },
	{ "noise", KEY_NOISE, OPTION_ARG, "E", COMPLETE_WORDS, "0.004 0.01 0.02 0.05",
	  "samples until each pixel's standard error, as the picture shows it, is below E; black to white is 1, a step "
	  "of 8 bits 0.004",
	  NULL },
	{ "time", KEY_TIME, OPTION_ARG, "S", COMPLETE_WORDS, "1 10 60 600",
	  "the best picture that S seconds can give, with reading and building; with --noise, no longer than that "
	  "takes",
	  NULL },
	{ "blur-samples", KEY_BLUR_SAMPLES, OPTION_ARG, "N", COMPLETE_NOTHING, NULL,
	  "focal blur: N rays a sample; otherwise as many as a good picture takes", NULL },
	{ "indirect", KEY_INDIRECT, OPTION_ARG, "METHOD", COMPLETE_WORDS, INDIRECT_WORDS,
	  "indirect light of scenes with a radiosity block: exact; cache, faster and a little off; or off; exact "
	  "is the default",
	  NULL },
	{ "indirect-samples", KEY_INDIRECT_SAMPLES, OPTION_ARG, "N", COMPLETE_WORDS, "32 128 512 2048",
	  "rays of indirect light a pixel, about; more make less noise; 512 is the default", NULL },
	{ "indirect-error", KEY_INDIRECT_ERROR, OPTION_ARG, "X", COMPLETE_WORDS, "0.5 1 2 4",
	  "with a cache: let light between its places be off X times as far as by default; more is faster",
	  NULL },
	{ "error-layer", KEY_ERROR_LAYER, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "estimate the noise of indirect light: a layer Error in an .exr picture, and its mean in --stats",
	  NULL },
	{ "seed", KEY_SEED, OPTION_ARG, "N", COMPLETE_NOTHING, NULL,
	  "take other random numbers; 0 is the default", NULL },
	{ "texture-filter", KEY_TEXTURE_FILTER, OPTION_ARG, "HOW", COMPLETE_WORDS, "pov mip",
	  "pictures on things: pov, one place of them a ray, as POV-Ray, or mip, the mean of what a pixel "
	  "covers; pov is the default",
	  NULL },
	{ "terminator", KEY_TERMINATOR, OPTION_ARG, "HOW", COMPLETE_WORDS, "pov hanika",
	  "where shadows begin on coarse meshes with smooth normals: pov, at the faces, as POV-Ray, or hanika, "
	  "as on the smooth surface; pov is the default",
	  NULL },
	{ "bits", KEY_BITS, OPTION_ARG, "N", COMPLETE_WORDS, "8 16 32",
	  "bits a channel: 8 or 16 for .png and .ppm, 16 or 32 for .exr", NULL },
	{ "alpha", KEY_ALPHA, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "keep the alpha channel: what shows no object is transparent", NULL },

	{ "frames", 'f', OPTION_ARG, "LIST", COMPLETE_NOTHING, NULL,
	  "draw these frames, as in 1,3..9 or 0..100:10; #### in the scene's or the output's name stands for "
	  "the number, which otherwise comes before the output's ending",
	  "Animation" },
	{ "range", KEY_RANGE, OPTION_ARG, "A..B", COMPLETE_NOTHING, NULL,
	  "the first and the last frame of the whole animation, with ,clock=X..Y (0..1) and ,cyclic; without "
	  "-f all of it is drawn",
	  NULL },
	{ "clock", KEY_CLOCK, OPTION_ARG, "X", COMPLETE_NOTHING, NULL, "the scene's clock is X", NULL },
	{ "skip-existing", KEY_SKIP_EXISTING, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "leave out frames whose picture is there: go on with an animation that was stopped", NULL },

	{ "accel", 'a', OPTION_ARG, "NAME", COMPLETE_ACCEL, NULL,
	  "the acceleration structure, with its parameters: NAME:key=value,..; bvh8 is the default",
	  "Speed" },
	{ "list-accels", KEY_LIST_ACCELS, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "list the accelerators that are installed, with their parameters, and exit", NULL },
	{ "precision", KEY_PRECISION, OPTION_ARG, "HOW", COMPLETE_WORDS, "default exact fast",
	  "which of two surfaces is nearer: default, by doubles; exact, however close they are; fast, by floats, "
	  "with errors that show at edges",
	  NULL },
	{ "threads", 't', OPTION_ARG, "N", COMPLETE_NOTHING, NULL,
	  "use N threads; otherwise one for each processor; the picture is the same", NULL },
	{ "jobs", 'j', OPTION_ARG, "N", COMPLETE_NOTHING, NULL, NULL, NULL },
	{ "memory", KEY_MEMORY, OPTION_ARG, "SIZE", COMPLETE_NOTHING, NULL,
	  "stop with an error rather than use more than SIZE, as in 512M or 4G", NULL },
	{ "tile", KEY_TILE, OPTION_ARG, "N", COMPLETE_NOTHING, NULL,
	  "side of the squares that threads take in turn, in pixels", NULL },
	{ "verify", KEY_VERIFY, OPTION_ARG, "N", COMPLETE_WORDS, "1 100 10000",
	  "trace one ray in N again without an accelerator and report what differs, with status 7; slow in "
	  "large scenes", NULL },
	{ "camera-only", KEY_CAMERA_ONLY, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "cast camera rays only and shade nothing, for counting and timing; white is a hit", NULL },

	{ "include", 'L', OPTION_ARG, "DIR", COMPLETE_DIR, NULL,
	  "look for included files in DIR too; may be given again", "Scene" },
	{ "define", 'D', OPTION_ARG, "NAME=VALUE", COMPLETE_NOTHING, NULL,
	  "declare NAME for the scene, a number or a string; may be given again", NULL },
	{ "write", KEY_WRITE, OPTION_ARG, "DIR", COMPLETE_DIR, NULL,
	  "let the scene write files (#fopen, #write), below DIR only", NULL },
	{ "lenient", KEY_LENIENT, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "warn about what is not supported and render the rest", NULL },
	{ "limit", KEY_LIMIT, OPTION_ARG, "NAME=N", COMPLETE_WORDS, LIMIT_WORDS,
	  "change what a scene file may ask for: nesting, macro_depth, include_depth, loop_steps, "
	  "string_bytes, tokens, elements, objects, texture_pixels, texture_bytes, memory, seconds",
	  NULL },
	{ "dry-run", KEY_DRY_RUN, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "read the scene and build its structure, say what they require, and render nothing; with -v "
	  "the whole scene is listed too", NULL },

	{ "stats", KEY_STATS, OPTION_MAYBE_ARG, "FILE", COMPLETE_FILE, NULL,
	  "count rays, tests and hits and report them on standard error, or as JSON in FILE", "Reports" },
	{ "progress", KEY_PROGRESS, OPTION_ARG, "HOW", COMPLETE_WORDS, "auto bar lines json none",
	  "show progress as a bar, as lines, as JSON lines on standard output, or not; auto takes a bar "
	  "on a terminal and lines elsewhere",
	  NULL },
	{ "quiet", 'q', OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "print errors only: no warnings, no progress", NULL },
	{ "verbose", 'v', OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "print notes too; twice: everything", NULL },
	{ "help", 'h', OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL, "print this and exit", NULL },
	{ "version", KEY_VERSION, OPTION_ALONE, NULL, COMPLETE_NOTHING, NULL,
	  "print the version and what is built in, and exit", NULL },
	{ "print-completion", KEY_PRINT_COMPLETION, OPTION_ARG, "SHELL", COMPLETE_NOTHING, NULL, NULL, NULL },
	{ 0 },
};

const struct option_program settings_program = {
	.name = "alidade",
	.operands = "SCENE",
	.summary = "Render a POV-Ray scene file (.pov, or an .ini that names one; - is standard input)",
	.endings = "pov ini",
	.option = alidade_option,
};

void settings_init(struct settings *s, struct mem_book *book)
{
	memset(s, 0, sizeof(*s));
	arena_init(&s->arena, book, "settings");
	s->accel = "bvh8";
	s->precision = ALD_PRECISION_DEFAULT;
	s->render.aa_gamma = 2.5;
	s->render.indirect = INDIRECT_EXACT;
}

void settings_release(struct settings *s)
{
	arena_release(&s->arena);
}

static enum status wrong(struct diag *d, const struct option_spec *o, const char *value, const char *want)
{
	return diag_fail(d, STATUS_USAGE, NULL, "--%s=%s: expected %s", o->name, value, want);
}

static enum status set_crop(struct settings *s, const struct option_spec *o, const char *value,
			    struct diag *d)
{
	static const char want[] = "X,Y,W,H in pixels, as in 0,0,64,48";
	uint32_t *to[] = { &s->render.crop_x, &s->render.crop_y, &s->render.crop_width,
			   &s->render.crop_height };
	const char *cursor = value;
	struct option_pair pair;
	uint64_t n;

	for (size_t i = 0; i < 4; i++) {
		if (!option_next_pair(&cursor, &pair) || pair.value[0] ||
		    !option_integer(pair.key, i < 2 ? 0 : 1, SETTINGS_SIDE_MAX, &n))
			return wrong(d, o, value, want);
		*to[i] = (uint32_t)n;
	}
	s->given |= GIVEN_CROP;
	return *cursor ? wrong(d, o, value, want) : STATUS_OK;
}

static enum status set_aa_pair(struct settings *s, const struct option_spec *o,
			       const struct option_pair *pair, const char *value, struct diag *d)
{
	uint64_t n;

	if (!strcmp(pair->key, "threshold")) {
		if (!option_real(pair->value, 0, 3, &s->render.aa_threshold))
			return wrong(d, o, value, "threshold=0 to 3");
	} else if (!strcmp(pair->key, "depth")) {
		if (!option_integer(pair->value, 1, 9, &n))
			return wrong(d, o, value, "depth=1 to 9");
		s->render.aa_n = (uint32_t)n;
	} else if (!strcmp(pair->key, "gamma")) {
		if (!option_real(pair->value, 0.1, 10, &s->render.aa_gamma))
			return wrong(d, o, value, "gamma=0.1 to 10");
	} else {
		return wrong(d, o, value, "threshold, depth or gamma");
	}
	return STATUS_OK;
}

/* POV-Ray's own defaults for its two methods (manual 3.2.8.7). */
static enum status set_aa(struct settings *s, const struct option_spec *o, const char *value, struct diag *d)
{
	size_t name = strcspn(value, ":");
	const char *cursor = value[name] ? value + name + 1 : NULL;
	struct option_pair pair;
	enum status st;
	uint64_t n;

	s->given |= GIVEN_AA;
	s->render.aa_gamma = 2.5;
	s->render.aa_threshold = 0.3;
	s->render.aa_n = 3;
	if (!strcmp(value, "none")) {
		s->render.aa = RENDER_AA_NONE;
	} else if (option_integer(value, 1, 64, &n)) {
		s->render.aa = n > 1 ? RENDER_AA_GRID : RENDER_AA_NONE;
		s->render.aa_n = (uint32_t)n;
	} else if (name == 4 && (!strncmp(value, "pov1", 4) || !strncmp(value, "pov2", 4))) {
		s->render.aa = value[3] == '1' ? RENDER_AA_POV1 : RENDER_AA_POV2;
	} else {
		return wrong(d, o, value, "none, a number from 1 to 64, pov1 or pov2");
	}
	while (option_next_pair(&cursor, &pair)) {
		st = set_aa_pair(s, o, &pair, value, d);
		if (st)
			return st;
	}
	return STATUS_OK;
}

static bool set_clocks(struct settings *s, char *value)
{
	char *dots = strstr(value, "..");

	if (!dots)
		return false;
	*dots = 0;
	s->frames.set |= FRAMES_INITIAL_CLOCK | FRAMES_FINAL_CLOCK;
	return option_real(value, -1e30, 1e30, &s->frames.initial_clock) &&
	       option_real(dots + 2, -1e30, 1e30, &s->frames.final_clock);
}

static enum status set_range(struct settings *s, const struct option_spec *o, const char *value,
			     struct diag *d)
{
	struct frame_span span[FRAME_SPANS];
	const char *cursor = value;
	struct option_pair pair;
	uint32_t count;
	bool good = option_next_pair(&cursor, &pair) && !pair.value[0] &&
		    frames_parse(pair.key, span, &count) && span[0].step == 1;

	if (good) {
		s->frames.set |= FRAMES_INITIAL | FRAMES_FINAL;
		s->frames.initial_frame = span[0].first;
		s->frames.final_frame = span[0].last;
		s->given |= GIVEN_RANGE;
	}
	while (good && option_next_pair(&cursor, &pair)) {
		if (!strcmp(pair.key, "clock"))
			good = set_clocks(s, pair.value);
		else if ((good = !strcmp(pair.key, "cyclic") && !pair.value[0]))
			s->frames.cyclic = true;
	}
	return good ? STATUS_OK : wrong(d, o, value, "FIRST..LAST, and perhaps ,clock=0..1 and ,cyclic");
}

static enum status set_frames(struct settings *s, const struct option_spec *o, const char *value,
			      struct diag *d)
{
	if (frames_parse(value, s->frame, &s->frame_count))
		return STATUS_OK;
	return wrong(d, o, value, "frame numbers and spans FIRST..LAST or FIRST..LAST:STEP, as in 1,3..9");
}

static enum status set_clock(struct settings *s, const struct option_spec *o, const char *value,
			     struct diag *d)
{
	s->frames.set |= FRAMES_CLOCK;
	return option_real(value, -1e30, 1e30, &s->frames.clock) ? STATUS_OK : wrong(d, o, value, "a number");
}

static enum status set_indirect(struct settings *s, const struct option_spec *o, const char *value,
				struct diag *d)
{
	if (!strcmp(value, "exact"))
		s->render.indirect = INDIRECT_EXACT;
	else if (!strcmp(value, "cache"))
		s->render.indirect = INDIRECT_CACHE;
	else if (!strcmp(value, "off"))
		s->render.indirect = INDIRECT_OFF;
	else
		return wrong(d, o, value, "exact, cache or off");
	return STATUS_OK;
}

static enum status set_precision(struct settings *s, const struct option_spec *o, const char *value,
				 struct diag *d)
{
	if (!strcmp(value, "exact"))
		s->precision = ALD_PRECISION_EXACT;
	else if (!strcmp(value, "fast"))
		s->precision = ALD_PRECISION_FAST;
	else if (!strcmp(value, "default"))
		s->precision = ALD_PRECISION_DEFAULT;
	else
		return wrong(d, o, value, "default, exact or fast");
	return STATUS_OK;
}

static enum status set_seed(struct settings *s, const struct option_spec *o, const char *value,
			    struct diag *d)
{
	return option_integer(value, 0, UINT64_MAX, &s->render.seed) ? STATUS_OK
								      : wrong(d, o, value, "a number");
}

static enum status set_limit(struct settings *s, const struct option_spec *o, const char *value,
			     struct diag *d)
{
	const char *cursor = value;
	struct option_pair pair;
	double x;

	if (!option_next_pair(&cursor, &pair) || *cursor || !option_real(pair.value, 0, 1e18, &x))
		return wrong(d, o, value, "NAME=N");
	if (!read_limits_set(&s->read.limits, pair.key, x))
		return wrong(d, o, value, "one of the names that --help lists, and a number above 0");
	return STATUS_OK;
}

/* The lists may grow with every -L and -D; they are short, so each time a new one is made. */
static enum status add_dir(struct settings *s, const char *value, struct diag *d)
{
	uint32_t n = s->read.include_dir_count;
	const char **list = arena_alloc(&s->arena, (n + 1) * sizeof(*list));

	if (!list)
		return diag_no_memory(d, "the list of folders", (n + 1) * sizeof(*list));
	if (n)
		memcpy(list, s->read.include_dirs, n * sizeof(*list));
	list[n] = value;
	s->read.include_dirs = list;
	s->read.include_dir_count = n + 1;
	return STATUS_OK;
}

static bool is_name(const char *s, size_t length)
{
	if (!length || !(isalpha((unsigned char)*s) || *s == '_'))
		return false;
	for (size_t i = 1; i < length; i++) {
		if (!(isalnum((unsigned char)s[i]) || s[i] == '_'))
			return false;
	}
	return true;
}

/* A value that is no number is a string, and gets the quotes that the shell has eaten. */
static enum status add_define(struct settings *s, const struct option_spec *o, const char *value,
			      struct diag *d)
{
	uint32_t n = s->read.define_count;
	struct read_define *list = arena_alloc(&s->arena, (n + 1) * sizeof(*list));
	const char *equals = strchr(value, '=');
	size_t room = strlen(value) + 3;
	char *text = arena_alloc(&s->arena, room);
	char *name = arena_strdup(&s->arena, value);
	double x;

	if (!list || !text || !name)
		return diag_no_memory(d, "the list of definitions", (n + 1) * sizeof(*list) + room);
	if (!equals || !is_name(value, (size_t)(equals - value)))
		return wrong(d, o, value, "NAME=VALUE, NAME of letters, digits and _");
	name[equals - value] = 0;
	if (equals[1] == '"' || option_real(equals + 1, -HUGE_VAL, HUGE_VAL, &x))
		snprintf(text, room, "%s", equals + 1);
	else
		snprintf(text, room, "\"%s\"", equals + 1);
	if (n)
		memcpy(list, s->read.defines, n * sizeof(*list));
	list[n] = (struct read_define){ name, text };
	s->read.defines = list;
	s->read.define_count = n + 1;
	return STATUS_OK;
}

static enum status set_number(const struct option_spec *o, const char *value, uint32_t min, uint32_t max,
			      uint32_t *out, struct diag *d)
{
	uint64_t n;

	if (!option_integer(value, min, max, &n))
		return diag_fail(d, STATUS_USAGE, NULL, "--%s=%s: expected a number from %u to %u",
				 o->name, value, min, max);
	*out = (uint32_t)n;
	return STATUS_OK;
}

static enum status set_output(struct settings *s, const char *value, struct diag *d)
{
	if (!strcmp(value, "-"))
		return diag_fail(d, STATUS_USAGE, NULL,
				 "--output=-: a picture needs a file's name, whose ending is its format");
	s->output = arena_strdup(&s->arena, value);
	s->given |= GIVEN_OUTPUT;
	return s->output ? STATUS_OK : diag_no_memory(d, "the output's name", strlen(value));
}

static enum status set_progress(struct settings *s, const struct option_spec *o, const char *value,
				struct diag *d)
{
	static const char *const mode[] = { "auto", "bar", "lines", "json", "none" };

	for (int i = 0; i < 5; i++) {
		if (!strcmp(value, mode[i])) {
			s->progress = (enum progress_mode)i;
			return STATUS_OK;
		}
	}
	return wrong(d, o, value, o->words);
}

static enum status set_bits(struct settings *s, const struct option_spec *o, const char *value,
			    struct diag *d)
{
	enum status st = set_number(o, value, 8, 32, &s->bits, d);

	if (!st && s->bits != 8 && s->bits != 16 && s->bits != 32)
		return wrong(d, o, value, "8, 16 or 32");
	return st;
}

static enum status set_flag(struct settings *s, const struct option_spec *o, const char *value)
{
	switch (o->key) {
	case KEY_ALPHA:
		s->alpha = true;
		s->given |= GIVEN_ALPHA;
		break;
	case KEY_LIST_ACCELS:
		s->action = ACTION_LIST_ACCELS;
		break;
	case KEY_CAMERA_ONLY:
		s->render.camera_only = true;
		break;
	case KEY_LENIENT:
		s->read.lenient = true;
		break;
	case KEY_SKIP_EXISTING:
		s->skip_existing = true;
		break;
	case KEY_ERROR_LAYER:
		s->given |= GIVEN_ERROR;
		break;
	case KEY_DRY_RUN:
		s->dry_run = true;
		break;
	case KEY_STATS:
		s->stats = true;
		s->stats_file = value;
		break;
	case 'q':
		s->verbosity = -1;
		break;
	case 'v':
		s->verbosity = s->verbosity < 0 ? 1 : s->verbosity + 1;
		break;
	case 'h':
		s->action = ACTION_HELP;
		break;
	case KEY_VERSION:
		s->action = ACTION_VERSION;
		break;
	case KEY_PRINT_COMPLETION:
		s->action = ACTION_COMPLETION;
		s->shell = value;
		break;
	}
	return STATUS_OK;
}

static enum status set_option(void *arg, const struct option_spec *o, const char *value, struct diag *d)
{
	struct settings *s = arg;

	switch (o->key) {
	case 'o':
		return set_output(s, value, d);
	case 's':
		if (!option_extent(value, SETTINGS_SIDE_MAX, &s->render.width, &s->render.height))
			return wrong(d, o, value, "WIDTHxHEIGHT in pixels, as in 640x480");
		s->given |= GIVEN_SIZE;
		return STATUS_OK;
	case KEY_CROP:
		return set_crop(s, o, value, d);
	case KEY_AA:
		return set_aa(s, o, value, d);
	case KEY_NOISE:
		s->render.budget = true;
		return option_real(value, 0, 1, &s->render.noise) ? STATUS_OK :
								    wrong(d, o, value, "a number from 0 to 1");
	case KEY_TIME:
		s->render.budget = true;
		return option_real(value, 1e-6, 1e9, &s->render.seconds) ?
			       STATUS_OK :
			       wrong(d, o, value, "a number of seconds above 0");
	case KEY_SPP:
		return set_number(o, value, 1, RENDER_SPP_LIMIT, &s->render.spp, d);
	case KEY_BLUR_SAMPLES:
		return set_number(o, value, 1, 65536, &s->render.blur_samples, d);
	case KEY_TEXTURE_FILTER:
		s->render.texture_mip = !strcmp(value, "mip");
		return s->render.texture_mip || !strcmp(value, "pov") ? STATUS_OK : wrong(d, o, value, "pov or mip");
	case KEY_TERMINATOR:
		s->render.lift = !strcmp(value, "hanika");
		return s->render.lift || !strcmp(value, "pov") ? STATUS_OK : wrong(d, o, value, "pov or hanika");
	case KEY_INDIRECT:
		return set_indirect(s, o, value, d);
	case KEY_PRECISION:
		return set_precision(s, o, value, d);
	case KEY_SEED:
		return set_seed(s, o, value, d);
	case KEY_BITS:
		return set_bits(s, o, value, d);
	case 'f':
		return set_frames(s, o, value, d);
	case KEY_RANGE:
		return set_range(s, o, value, d);
	case KEY_CLOCK:
		return set_clock(s, o, value, d);
	case 'a':
		s->accel = value;
		return STATUS_OK;
	case 't':
	case 'j':
		return set_number(o, value, 1, 1024, &s->threads, d);
	case KEY_MEMORY:
		return option_bytes(value, &s->memory) ? STATUS_OK
						       : wrong(d, o, value, "a size, as in 512M or 4G");
	case KEY_VERIFY:
		s->render.verify = true;
		return set_number(o, value, 1, UINT32_MAX, &s->verify, d);
	case KEY_TILE:
		return set_number(o, value, 1, 4096, &s->render.tile, d);
	case 'L':
		return add_dir(s, value, d);
	case 'D':
		return add_define(s, o, value, d);
	case KEY_INDIRECT_ERROR:
		return option_real(value, 0.125, 16, &s->render.indirect_slack) ?
			       STATUS_OK :
			       wrong(d, o, value, "a number from 0.125 to 16");
	case KEY_INDIRECT_SAMPLES:
		return set_number(o, value, 1, INDIRECT_MAX, &s->render.indirect_samples, d);
	case KEY_WRITE:
		s->read.write_dir = value;
		return STATUS_OK;
	case KEY_LIMIT:
		return set_limit(s, o, value, d);
	case KEY_PROGRESS:
		return set_progress(s, o, value, d);
	default:
		return set_flag(s, o, value);
	}
}

enum status settings_parse(struct settings *s, int argc, char **argv, struct diag *d)
{
	int operand;
	enum status st = options_parse(&settings_program, argc, argv, set_option, s, &operand, d);

	if (st || s->action != ACTION_RENDER)
		return st;
	if (operand >= argc)
		return diag_fail(d, STATUS_USAGE, NULL, "no scene given; usage: alidade [option ...] SCENE");
	if (operand + 1 < argc)
		return diag_fail(d, STATUS_USAGE, NULL, "one scene at a time: \"%s\" and \"%s\" were given",
				 argv[operand], argv[operand + 1]);
	s->scene = argv[operand];
	if (!*s->scene)
		return diag_fail(d, STATUS_USAGE, NULL, "the scene's name is empty");
	s->read.width = s->render.width;
	s->read.height = s->render.height;
	s->read.quiet_debug = s->verbosity < 0;
	if (s->verbosity < 0)
		s->progress = PROGRESS_NONE;
	return STATUS_OK;
}
