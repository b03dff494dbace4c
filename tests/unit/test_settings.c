/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include <config.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "read/limits.h"
#include "settings.h"

struct fixture {
	struct mem_book book;
	struct settings s;
	struct diag diag;
	char text[512], message[512];
};

static void hear(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	struct fixture *f = arg;

	(void)level;
	(void)pos;
	snprintf(f->message, sizeof(f->message), "%s", text);
}

static enum status parse(struct fixture *f, const char *line)
{
	char *argv[64] = { "alidade" }, *save = NULL;
	int argc = 1;

	memset(f, 0, sizeof(*f));
	mem_book_init(&f->book, 0);
	settings_init(&f->s, &f->book);
	f->diag = (struct diag){ hear, f, 0, 0 };
	snprintf(f->text, sizeof(f->text), "%s", line);
	for (char *w = strtok_r(f->text, " ", &save); w; w = strtok_r(NULL, " ", &save))
		argv[argc++] = w;
	return settings_parse(&f->s, argc, argv, &f->diag);
}

static enum status finish(struct fixture *f, const char *line, const struct read_job *job)
{
	enum status st = parse(f, line);

	return st ? st : settings_finish(&f->s, job, &f->diag);
}

static void test_all_options(void **state)
{
	struct fixture f;
	const struct render_options *r = &f.s.render;

	(void)state;
	assert_int_equal(parse(&f, "-o x.exr -s 64x48 --crop 1,2,3,4 --aa pov2:threshold=.1,depth=4,gamma=2 "
				   "-a none -t 3 --memory 2K --tile 16 --camera-only -L a -L b -D n=1.5 "
				   "-D w=word --lenient --limit tokens=7 --limit seconds=1.5 "
				   "--limit nesting=9 s.pov"), STATUS_OK);
	assert_string_equal(f.s.output, "x.exr");
	assert_true(r->width == 64 && r->height == 48 && f.s.read.width == 64 && f.s.read.height == 48);
	assert_true(r->crop_x == 1 && r->crop_y == 2 && r->crop_width == 3 && r->crop_height == 4);
	assert_true(r->aa == RENDER_AA_POV2 && r->aa_threshold == .1 && r->aa_n == 4 && r->aa_gamma == 2);
	assert_string_equal(f.s.accel, "none");
	assert_true(f.s.threads == 3 && f.s.memory == 2048 && r->tile == 16 && r->camera_only);
	assert_int_equal(f.s.read.include_dir_count, 2);
	assert_string_equal(f.s.read.include_dirs[0], "a");
	assert_string_equal(f.s.read.include_dirs[1], "b");
	assert_int_equal(f.s.read.define_count, 2);
	assert_string_equal(f.s.read.defines[0].name, "n");
	assert_string_equal(f.s.read.defines[0].value, "1.5");
	assert_string_equal(f.s.read.defines[1].value, "\"word\"");
	assert_true(f.s.read.lenient && f.s.read.limits.tokens == 7 && f.s.read.limits.seconds == 1.5 &&
		    f.s.read.limits.nesting == 9);
	assert_string_equal(f.s.scene, "s.pov");
	settings_release(&f.s);
}

static void test_mistakes(void **state)
{
	static const char *const wrong[] = {
		"", "a.pov b.pov", "-s 0x4 a", "-s 4 a", "--crop 1,2,3 a", "--crop 1,2,3,4,5 a",
		"--crop 1,2,0,4 a", "--aa pov3 a", "--aa 0 a", "--aa 65 a", "--aa pov1:what=1 a",
		"--aa pov1:depth=0 a", "--aa pov1:threshold=-1 a", "-t 0 a", "-t x a", "--memory 1Q a",
		"--tile 0 a", "-D x a", "-D 1=2 a", "-D a-b=2 a", "--limit what=1 a", "--limit tokens a",
		"--limit tokens=0 a", "--limit tokens=1,nesting=2 a", "--progress often a", "--bits 12 a",
		"-o - a",
	};
	struct fixture f;

	(void)state;
	for (size_t i = 0; i < sizeof(wrong) / sizeof(*wrong); i++) {
		if (parse(&f, wrong[i]) != STATUS_USAGE)
			fail_msg("\"%s\" was accepted", wrong[i]);
		assert_int_equal(f.diag.errors, 1);
		assert_true(strlen(f.message) > 10);
		settings_release(&f.s);
	}
}

/* What --help and the shells list are the reader's limits. */
static void test_limits(void **state)
{
	const struct option_spec *o = settings_program.option;
	char word[64];

	(void)state;
	while (o->name && strcmp(o->name, "limit") != 0)
		o++;
	assert_non_null(o->name);
	for (size_t i = 0; i < read_limit_count; i++) {
		assert_non_null(strstr(o->help, read_limit_table[i].name));
		snprintf(word, sizeof(word), "%s=", read_limit_table[i].name);
		assert_non_null(strstr(o->words, word));
	}
}

/* The page states each limit as "It Cm NAME", then words, then ": NUMBER". */
static void test_page_states_the_limits(void **state)
{
	const char *source = getenv("ALIDADE_SRC");
	static char page[1 << 17];
	char path[4096], name[64];
	FILE *f;

	(void)state;
	if (!source)
		skip();
	snprintf(path, sizeof(path), "%s/man/alidade.1", source);
	f = fopen(path, "r");
	assert_non_null(f);
	page[fread(page, 1, sizeof(page) - 1, f)] = 0;
	fclose(f);
	for (size_t i = 0; i < read_limit_count; i++) {
		const char *at, *end, *colon = NULL;

		snprintf(name, sizeof(name), ".It Cm %s\n", read_limit_table[i].name);
		at = strstr(page, name);
		assert_non_null(at);
		at += strlen(name);
		end = strstr(at, "\n.It "); /* the list is not the page's last */
		assert_non_null(end);
		for (const char *c = at; c < end; c++) {
			if (!strncmp(c, ": ", 2))
				colon = c;
		}
		assert_non_null(colon);
		assert_true(strtod(colon + 2, NULL) == read_limit_table[i].value);
	}
}

static void test_defaults(void **state)
{
	const struct read_job none = { 0 };
	struct fixture f;
	char text[128];

	(void)state;
	assert_int_equal(finish(&f, "dir.d/scene.one.pov", &none), STATUS_OK);
	assert_string_equal(f.s.output, "scene.one.png");
	settings_describe(&f.s, text, sizeof(text));
	assert_string_equal(text, "800x600 aa none");
	settings_release(&f.s);
	assert_int_equal(finish(&f, "-", &none), STATUS_OK);
	assert_string_equal(f.s.output, "stdin.png");
	settings_release(&f.s);
	assert_int_equal(finish(&f, "-s 10x10 --crop 5,5,6,5 a.pov", &none), STATUS_USAGE);
	settings_release(&f.s);
}

/* One number of samples; the .ini's anti-aliasing gives way to it, the command line's does not. */
static void test_samples(void **state)
{
	static const char *const both[] = { "--aa 2", "--blur-samples 9", "--indirect-samples 9" };
	const struct read_job job = { .set = READ_JOB_AA, .aa = true };
	struct fixture f;
	char text[128];

	(void)state;
	assert_int_equal(finish(&f, "--spp 64 a.ini", &job), STATUS_OK);
	settings_describe(&f.s, text, sizeof(text));
	assert_string_equal(text, "800x600 64 samples a pixel");
	settings_release(&f.s);
	for (size_t i = 0; i < 3; i++) {
		snprintf(text, sizeof(text), "--spp 4 %s a.pov", both[i]);
		assert_int_equal(finish(&f, text, &job), STATUS_USAGE);
		assert_non_null(strstr(f.message, "--spp"));
		settings_release(&f.s);
	}
	assert_int_equal(parse(&f, "--spp 0 a.pov"), STATUS_USAGE);
	settings_release(&f.s);
	assert_int_equal(finish(&f, "--noise .01 --time 5 -o a.exr a.ini", &job), STATUS_OK);
	assert_true(f.s.render.budget && f.s.render.error && !f.s.render.clips);
	assert_true(f.s.render.noise == .01 && f.s.render.seconds == 5);
	settings_describe(&f.s, text, sizeof(text));
	assert_string_equal(text, "800x600 noise 0.01 time 5 error layer");
	settings_release(&f.s);
	assert_int_equal(finish(&f, "--noise 0 --spp 9 -o a.png a.ini", &job), STATUS_OK);
	assert_true(f.s.render.budget && !f.s.render.error && f.s.render.clips);
	settings_release(&f.s);
	assert_int_equal(finish(&f, "--spp 9 --error-layer -o a.exr a.ini", &job), STATUS_OK);
	assert_true(f.s.render.budget && f.s.render.error);
	settings_release(&f.s);
	assert_int_equal(finish(&f, "--noise 0 a.ini", &job), STATUS_USAGE);
	settings_release(&f.s);
	assert_int_equal(parse(&f, "--time 0 a.pov"), STATUS_USAGE);
	settings_release(&f.s);
	assert_int_equal(parse(&f, "--noise 2 a.pov"), STATUS_USAGE);
	settings_release(&f.s);
}

/* The .ini's wishes, and the command line's, which win. Rows and columns as POV-Ray 3.7 was seen to take
 * them: 20x10 with +SC3 +EC5 +SR2 +ER3 gives columns 2..4 and rows 1..2, counted from 0; with +SC0.21
 * +EC0.49 +SR0.001 +ER0.999 columns 4..8 and rows 0..8. */
static void test_job(void **state)
{
	struct read_job job = {
		.set = READ_JOB_WIDTH | READ_JOB_HEIGHT | READ_JOB_OUTPUT | READ_JOB_AA | READ_JOB_AA_METHOD |
		       READ_JOB_START_COLUMN | READ_JOB_END_COLUMN | READ_JOB_START_ROW | READ_JOB_END_ROW,
		.output = "pic", .width = 20, .height = 10, .aa = true, .aa_method = 2,
		.start_column = 3, .end_column = 5, .start_row = 2, .end_row = 3,
	};
	struct fixture f;
	char text[128];

	(void)state;
	assert_int_equal(finish(&f, "a.ini", &job), STATUS_OK);
	assert_string_equal(f.s.output, "pic.png");
	settings_describe(&f.s, text, sizeof(text));
	assert_string_equal(text, "20x10 crop 2,1,3,2 aa pov2:depth=3,threshold=0.3,gamma=2.5");
	settings_release(&f.s);
	job.start_column = 0.21;
	job.end_column = 0.49;
	job.start_row = 0.001;
	job.end_row = 0.999;
	assert_int_equal(finish(&f, "a.ini", &job), STATUS_OK);
	settings_describe(&f.s, text, sizeof(text));
	assert_string_equal(text, "20x10 crop 4,0,5,9 aa pov2:depth=3,threshold=0.3,gamma=2.5");
	settings_release(&f.s);
	job.end_column = 0.2;
	assert_int_equal(finish(&f, "a.ini", &job), STATUS_SCENE);
	settings_release(&f.s);
	job.set = job.set & ~(unsigned)(READ_JOB_START_COLUMN | READ_JOB_END_COLUMN);
	assert_int_equal(finish(&f, "-o o.ppm -s 40x30 --aa 2 --crop 0,0,1,1 a.ini", &job), STATUS_OK);
	assert_string_equal(f.s.output, "o.ppm");
	settings_describe(&f.s, text, sizeof(text));
	assert_string_equal(text, "40x30 crop 0,0,1,1 aa grid:depth=2");
	settings_release(&f.s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_all_options), cmocka_unit_test(test_mistakes),
		cmocka_unit_test(test_limits), cmocka_unit_test(test_page_states_the_limits),
		cmocka_unit_test(test_defaults), cmocka_unit_test(test_job),
		cmocka_unit_test(test_samples),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
