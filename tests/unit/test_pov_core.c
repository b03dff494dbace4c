/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The reader's core: its values against those that POV-Ray's own #debug gave for the same scenes
 * (tests/pov/core, see golden.sh there), errors with their exact places, limits, includes, .ini files.
 */
#include <config.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "read/limits.h"
#include "read/pov/number.h"
#include "read/pov/parser.h"

struct heard {
	char debug[1 << 16];
	char error[1024], warning[1024]; /* the first */
	size_t length;
};

static void listen(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	struct heard *h = arg;

	if (level == DIAG_DEBUG && h->length + strlen(text) + 2 < sizeof(h->debug))
		h->length += (size_t)sprintf(h->debug + h->length, "%s", text);
	else if (level == DIAG_ERROR && !h->error[0])
		diag_format(h->error, sizeof(h->error), level, pos, text);
	else if (level == DIAG_WARNING && !h->warning[0])
		diag_format(h->warning, sizeof(h->warning), level, pos, text);
}

static enum status read_file(const char *path, const struct read_options *given, struct heard *h,
			     struct read_job *job)
{
	const struct read_options none = { .include_dirs = NULL };
	struct diag diag = { .sink = listen, .arg = h };
	struct mem_book book;
	struct scene scene;
	enum status st;

	memset(h, 0, sizeof(*h));
	mem_book_init(&book, 0);
	scene_init(&scene, &book);
	st = read_scene(path, given ? given : &none, &scene, job, &diag);
	if (job && job->output)
		job->output = strdup(job->output);
	scene_release(&scene);
	assert_int_equal(book.now, 0);
	assert_int_equal(st != STATUS_OK, diag.errors > 0);
	return st;
}

static enum status read_text(const char *text, const struct read_options *given, struct heard *h)
{
	const struct read_options none = { .include_dirs = NULL };
	struct diag diag = { .sink = listen, .arg = h };
	struct mem_book book;
	struct scene scene;
	enum status st;

	memset(h, 0, sizeof(*h));
	mem_book_init(&book, 0);
	scene_init(&scene, &book);
	st = pov_read("t.pov", text, strlen(text), given ? given : &none, &scene, &diag);
	scene_release(&scene);
	assert_int_equal(book.now, 0);
	assert_int_equal(st != STATUS_OK, diag.errors > 0);
	assert_true(diag.errors <= 1);
	return st;
}

static void write_file(const char *path, const char *text)
{
	FILE *f = fopen(path, "w");

	assert_non_null(f);
	fputs(text, f);
	fclose(f);
}

static void golden(void **state)
{
	static const char *const name[] = { "arrays", "colours", "control", "functions", "gamma", "linear",
					    "macros", "numbers", "rand", "splines", "strings", "vectors" };
	const char *dir = getenv("srcdir");
	static char want[1 << 16];
	static struct heard h;
	char path[1024];
	FILE *f;

	(void)state;
	for (size_t i = 0; i < sizeof(name) / sizeof(name[0]); i++) {
		snprintf(path, sizeof(path), "%s/tests/pov/core/%s.txt", dir ? dir : ".", name[i]);
		f = fopen(path, "r");
		assert_non_null(f);
		want[0] = 0;
		assert_non_null(fgets(want, sizeof(want), f));
		fclose(f);
		want[strcspn(want, "\n")] = 0;
		snprintf(path, sizeof(path), "%s/tests/pov/core/%s.pov", dir ? dir : ".", name[i]);
		read_file(path, NULL, &h, NULL);
		assert_string_equal(h.error, "");
		assert_string_equal(h.debug, want);
	}
}

static void errors(void **state)
{
	static const struct {
		const char *text, *error;
	} row[] = {
		{ "#declare A = ;", "t.pov:1:14: error: expected a value, found ;" },
		{ "#declare A = 1 +\n  B;", "t.pov:2:3: error: expected a number, found the undeclared" },
		{ "\n\n  box = 3", "t.pov:3:7: error: " },
		{ "#declare A = \"abc", "t.pov:1:14: error: the string that begins here" },
		{ "/* /* */", "t.pov:1:1: error: the comment that begins here" },
		{ "#declare A = 1e400;", "t.pov:1:14: error: the number 1e400 is too large" },
		{ "#declare A = nan;", "t.pov:1:14: error: expected a value, found the undeclared identifier nan" },
		{ "sphere { <0, nan, 0>, 1 }", "t.pov:1:14: error: expected a number" },
		{ "sphere { <0, exp(1000), 0>, 1 }", "t.pov:1:10: error: the value here is not a finite" },
		{ "#declare sphere = 1;", "t.pov:1:10: error: expected an identifier to declare" },
		{ "#declare A 1;", "t.pov:1:12: error: expected =" },
		{ "#if (1)\n1", "t.pov:2:1: error: " },
		{ "#if (1)\n", "t.pov:1:1: error: this directive has no #end" },
		{ "\n #if (0)\n", "t.pov:2:2: error: this #if has no #end" },
		{ " #end", "t.pov:1:2: error: #end without" },
		{ "#else", "t.pov:1:1: error: #else without" },
		{ "#case (1)", "t.pov:1:1: error: #case without" },
		{ "#break", "t.pov:1:1: error: #break without" },
		{ "#while (1", "t.pov:1:10: error: expected )" },
		{ "#foo", "t.pov:1:1: error: #foo is no directive" },
		{ "#macro M(A) A", "t.pov:1:1: error: this macro has no #end" },
		{ "#macro M(A)\n A + box #end\n#declare X = M(1);", "t.pov:2:6: error: expected a number, found box" },
		{ "#macro M(A, B) #end M(1)", "t.pov:1:24: error: macro M has 2 parameters, but only 1" },
		{ "#macro M(A) #end M(1, 2)", "t.pov:1:23: error: macro M has 1 parameters; expected )" },
		{ "#macro M(A) #end M(Unknown)", "t.pov:1:20: error: expected a value, found the undeclared" },
		{ "#declare A = array[2]{1,2,3}", "t.pov:1:27: error: more than the 2 elements" },
		{ "#declare A = array[2]{1,2}\n#declare B = A[2];", "t.pov:2:16: error: index 2 is outside" },
		{ "#declare A = array[2]{1,2}\n#declare B = A[-1];", "t.pov:2:16: error: index -1 is outside" },
		{ "#declare A = array[2]\n#declare B = A[1] + 1;", "t.pov:2:14: error: expected a value" },
		{ "#declare A = array[0];", "t.pov:1:20: error: 0 array elements" },
		{ "#declare S = \"a\"; #declare A = S + 1;", "t.pov:1:34: error: + cannot stand here" },
		{ "#declare S = \"a\"; #declare A = 1 + S;", "t.pov:1:36: error: expected a number, but S is" },
		{ "#declare V = <1,2,3>; sphere { 0, V }", "t.pov:1:37: error: expected a float" },
		{ "sphere { <1,2,3,4>, 1 }", "t.pov:1:10: error: expected a vector of 3 components" },
		{ "#declare A = <1,2>.z;", "t.pov:1:20: error: there is no component z" },
		{ "#declare A = sqrt(-1);", "t.pov:1:14: error: sqrt of -1" },
		{ "#declare A = substr(\"abc\", 2, 3);", "t.pov:1:32: error: substr" },
		{ "#declare A = rand(0);", "t.pov:1:21: error: there is no random number stream" },
		{ "#declare C = srgb 1;", "t.pov:1:14: error: srgb needs assumed_gamma" },
		{ "#error \"no good\"", "t.pov:1:1: error: #error: no good" },
		{ "#include \"nowhere.inc\"", "t.pov:1:10: error: include file \"nowhere.inc\" was not found" },
		{ "#declare F = function(x) { x*2 }\n#declare A = F();", "t.pov:2:16: error: expected a number" },
		{ "#declare F = function { sqr(x) }", "t.pov:1:25: error: expected a number, a parameter or" },
		{ "#declare F = function { F(x) }", "t.pov:1:25: error: the undeclared identifier F is no parameter" },
		{ "#declare F = function(a) { x }", "t.pov:1:28: error: x is no parameter of this function" },
		{ "#declare F = function { x / 0 }", "t.pov:1:31: error: division by zero" },
		{ "#declare F = function { --x }", "t.pov:1:26: error: expected a number" },
		{ "#declare F = function { sin(x, y) }", "t.pov:1:25: error: sin takes 1 argument, not 2" },
		{ "#declare F = function { max(x) }", "t.pov:1:25: error: max takes 2 arguments, not 1" },
		{ "#declare F = function { internal(99) }", "t.pov:1:25: error: there is no internal function 99" },
		{ "#declare F = function { internal(23) }\n#declare A = F(0, 0, 0, 0);",
		  "t.pov:1:37: error: the internal function f_heart is not supported" },
		{ "#declare F = function { pigment { agate } }\n#declare G = function { F(x, y, z) }",
		  "t.pov:2:36: error: expected . after a function that gives several numbers" },
		{ "#declare F = function { x }\n#declare G = function { F(x, y) }",
		  "t.pov:2:25: error: F takes 3 arguments, not 2" },
		{ "#declare F = function { sum(i, 1, 2) }", "t.pov:1:36: error: expected , before what is added up" },
		{ "#declare S = spline { cubic_spline }", "t.pov:1:14: error: the spline has no points" },
		{ "#declare S = spline { 0, <1,2,3> }\n#declare A = S(3, 4);",
		  "t.pov:2:19: error: expected a kind of spline" },
		{ "sphere { 0, 1 pigment { function (a) { a } } }", "t.pov:1:34: error: this function takes 1" },
		{ "#fopen F \"x\" write", "t.pov:1:1: error: the scene wants to write the file" },
		{ "sphere { trace(A, 0, 1), 1 }", "t.pov:1:10: error: the function trace is not supported" },
		{ "#declare T = transform { matrix <0,0,0, 0,0,0, 0,0,0, 0,0,0> }", "t.pov:1:33: error: this matrix" },
		{ "sphere { 0, 1 \xc3\xa9 }", "t.pov:1:15: error: the byte 0xc3" },
		{ "\"text\"", "t.pov:1:1: error: \"text\" cannot stand here" },
	};
	static struct heard h;
	int bad = 0;

	(void)state;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++) {
		read_text(row[i].text, NULL, &h);
		if (strncmp(h.error, row[i].error, strlen(row[i].error))) {
			print_error("%s\n\tgives   %s\n\tand not %s\n", row[i].text, h.error, row[i].error);
			bad++;
		}
	}
	assert_int_equal(bad, 0);
}

/* What is declared and never used is no error. */
static void harmless(void **state)
{
	static const char *const text[] = {
		"#declare F = function(x, y) { sin(x) * y }",
		"#declare S = spline { cubic_spline 0, <1,2,3> 1, <3,4,5> }",
		"#declare F = function { pigment { agate } } #declare G = F;",
		"#macro M() garbage ( { #declare #if (1) \"}\" #end #end",
		"#if (0) garbage \" # \" #nonsense #if (1) #end { #end",
		"#ifdef (X) #end #ifndef (X) #end",
		"#declare A = 1 #declare B = 2 #undef A #undef B",
		"#declare deprecated once \"use B\" A = 1;",
		"declare A = 1; default { finish { ambient 0 } } version 3.7;",
		"#version 3.7; ;;",
		"\xef\xbb\xbf#declare A = 1;",
		("#declare F = <0,1,2>; mesh2 { vertex_vectors { 4, 0, x, y, x+y } "
		 "face_indices { 2, F+0, F+1, } }"),
		"sphere { <0,0,0>, 1 #declare A = 3; scale A #undef A }#",
	};
	static struct heard h;

	(void)state;
	for (size_t i = 0; i < sizeof(text) / sizeof(text[0]); i++) {
		read_text(text[i], NULL, &h);
		assert_string_equal(h.error, "");
	}
}

/* What would never end is not a number. */
static void endless_functions(void **state)
{
	static const char *const text[] = {
		"#declare F = function { sum(i, 1, 1e15, i) } #debug str(F(1, 2, 3), 0, 0)",
		"#declare F = function { sum(i, 1e17, 2e17, i) } #debug str(F(1, 2, 3), 0, 0)",
		("#declare F = function { x } #local I = 0; #while (I < 40) #declare F = function { F(y, x, z) + "
		 "F(x, y, z) } #local I = I + 1; #end #debug str(F(1, 2, 3), 0, 0)"),
	};
	static struct heard h;

	(void)state;
	for (size_t i = 0; i < sizeof(text) / sizeof(text[0]); i++) {
		read_text(text[i], NULL, &h);
		assert_string_equal(h.error, "");
		assert_string_equal(h.debug, "nan");
	}
}

static void lenient(void **state)
{
	const struct read_options o = { .lenient = true };
	static struct heard h;

	(void)state;
	assert_int_equal(read_text("#declare F = function(x) { x }\n#declare A = F(3) + 2;\n"
				   "#fopen H \"x\" write #write (H, \"a\" 1, <1,2>) #fclose H\n"
				   "#debug str(A, 0, 0)", &o, &h), STATUS_OK);
	assert_string_equal(h.debug, "5");
	assert_string_equal(h.warning, "t.pov:3:1: warning: the file \"x\" is not written; --write=DIR "
				       "lets the scene write into DIR");
}

static char *repeat(const char *head, const char *text, size_t n)
{
	size_t a = strlen(head), b = strlen(text);
	char *s = malloc(a + n * b + 1);

	assert_non_null(s);
	memcpy(s, head, a);
	for (size_t i = 0; i < n; i++)
		memcpy(s + a + i * b, text, b);
	s[a + n * b] = 0;
	return s;
}

/* Deep nesting must not use up the stack. */
static void nesting(void **state)
{
	static const struct {
		const char *head, *text;
	} row[] = {
		{ "#declare A = ", "(" }, { "#declare A = ", "-" }, { "#declare A = ", "<" },
		{ "#declare A = ", "sin(" }, { "#declare A = ", "(1?" }, { "#declare A = (1", "?1:1" },
		{ "", "#declare A = " }, { "#declare A = ", "concat(" }, { "", "#if (1)\n" },
		{ "", "#switch (1) #case (1) " }, { "union ", "{ union" }, { "#declare A = union ", "{ union" },
		{ "#declare A = ", "transform {" }, { "#declare B = array[2]{1,1} #declare A = ", "B[" },
		{ "#macro M(A) A #end #declare X = ", "M(" }, { "#default ", "{ #default" },
	};
	static struct heard h;
	char *s;

	(void)state;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++) {
		s = repeat(row[i].head, row[i].text, 200000);
		assert_int_equal(read_text(s, NULL, &h), STATUS_SCENE);
		assert_non_null(strstr(h.error, "the limit is 500 (raise it with --limit nesting=N)"));
		free(s);
	}
}

static void limits(void **state)
{
	static const struct {
		const char *text, *name;
	} row[] = {
		{ "#while (1) #end", "loop_steps=" },
		{ "#for (I, 0, 1e12) #end", "loop_steps=" },
		{ "#macro M() M() #end M()", "macro_depth=" },
		{ "#macro M(A) #if (A < 60) M(A + 1) M(A + 1) #end #end M(0)", "tokens=" },
		{ "#while (1) #declare A = 1; #declare A = 2; #declare A = 3; #end", "tokens=" },
		{ "#while (1) /* xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx */ #end",
		  "tokens=" },
		{ "#declare S = \"abcdefgh\"; #while (1) #declare S = concat(S, S); #end", "string_bytes=" },
		{ "#declare S = \"a\"; #while (1) #declare S = concat(S, \"bcdefghi\"); #end", "memory=" },
		{ "#while (1) #declare A = array[10000]; #end", "memory=" },
		{ "#declare A = array[4000][4000][4000];", "elements=" },
	};
	struct read_options o = { .limits = { .loop_steps = 20000, .tokens = 100000, .memory = 8 << 20,
					      .string_bytes = 1 << 16 } };
	static struct heard h;
	char want[64];

	(void)state;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++) {
		if (i == 4 || i == 5) /* these would reach the loop's limit first */
			o.limits.loop_steps = 1000000;
		assert_int_equal(read_text(row[i].text, &o, &h), STATUS_SCENE);
		snprintf(want, sizeof(want), "--limit %s", row[i].name);
		if (!strstr(h.error, want))
			fail_msg("%s: %s", row[i].text, h.error);
		o.limits.loop_steps = i == 6 ? 1000000 : 20000;
		if (i == 6)
			o.limits.tokens = 100000000;
	}
	assert_int_equal(read_text("#declare A = array[2147483648];", NULL, &h), STATUS_SCENE);
	assert_string_equal(h.error, "t.pov:1:20: error: 2147483648 array elements: there can be 1 to 100000000");
}

static void limit_names(void **state)
{
	struct read_limits l = { .nesting = 0 };

	(void)state;
	for (size_t i = 0; i < read_limit_count; i++)
		assert_true(read_limits_set(&l, read_limit_table[i].name, 7));
	assert_int_equal(l.nesting, 7);
	assert_int_equal(l.memory, 7);
	assert_true(l.seconds == 7);
	assert_false(read_limits_set(&l, "nothing", 7));
	assert_false(read_limits_set(&l, "tokens", 0));
	assert_false(read_limits_set(&l, "tokens", -1));
	assert_int_equal(read_limits_fill(&(struct read_limits){ .nesting = 3 }).nesting, 3);
	assert_int_equal(read_limits_fill(&(struct read_limits){ .nesting = 3 }).macro_depth, 200);
}

static bool stop(void *arg)
{
	return ++*(int *)arg > 1;
}

static void stopping(void **state)
{
	static struct heard h;
	int asked = 0;
	struct read_options o = { .stop = stop, .stop_arg = &asked };
	struct diag diag = { .sink = listen, .arg = &h };
	struct mem_book book;
	struct scene scene;

	(void)state;
	mem_book_init(&book, 0);
	scene_init(&scene, &book);
	assert_int_equal(pov_read("t.pov", "#while (1) #end", 15, &o, &scene, &diag), STATUS_SIGINT);
	scene_release(&scene);
	assert_int_equal(asked, 2);
}

static void includes(void **state)
{
	char dir[] = "/tmp/alidade-test-XXXXXX", path[256], want[1024];
	const char *folder[1];
	struct read_options o = { .include_dirs = folder, .include_dir_count = 1, .no_system_includes = true };
	static struct heard h;

	(void)state;
	assert_non_null(mkdtemp(dir));
	assert_int_equal(chdir(dir), 0);
	assert_int_equal(system("mkdir scene scene/sub lib"), 0);
	write_file("scene/a.pov", "#local Here = 1;\n#include \"sub/b.inc\"\n#debug concat(str(B, 0, 0), "
				  "str(defined(L), 0, 0), C, D, M(1), str(Here, 0, 0))\n");
	write_file("scene/sub/b.inc", "#declare B = Here + 1; #local L = 3; #include \"c.inc\" #include \"d.inc\"\n"
				      "#macro M(A)\n\"m\" #end");
	write_file("scene/sub/c.inc", "#declare C = \"c\";"); /* found beside the including file */
	write_file("lib/d.inc", "#declare D = \"d\";");
	folder[0] = "lib";
	assert_int_equal(read_file("scene/a.pov", &o, &h, NULL), STATUS_OK);
	assert_string_equal(h.debug, "20cdm1");
	o.include_dir_count = 0;
	assert_int_equal(read_file("scene/a.pov", &o, &h, NULL), STATUS_SCENE);
	assert_string_equal(h.error, "scene/sub/b.inc:1:64: error: include file \"d.inc\" was not found (looked "
				     "in the including file's and the scene's folder, -L folders)");
	/* A circle, and an error within an included macro. */
	write_file("circle.pov", "#include \"circle.pov\"");
	assert_int_equal(read_file("circle.pov", &o, &h, NULL), STATUS_SCENE);
	assert_non_null(strstr(h.error, "circle.pov:1:10: error: files include each other too deeply"));
	write_file("m.inc", "#macro M()\n  #declare A = 1 + * 2;\n#end");
	write_file("m.pov", "#include \"m.inc\"\nM()");
	assert_int_equal(read_file("m.pov", &o, &h, NULL), STATUS_SCENE);
	assert_string_equal(h.error, "m.inc:2:20: error: expected a number, found *");
	/* Folders and devices are no include files. */
	write_file("dev.pov", "#include \"/dev/zero\"");
	assert_int_equal(read_file("dev.pov", &o, &h, NULL), STATUS_SCENE);
	write_file("dir.pov", "#include \"lib\"");
	assert_int_equal(read_file("dir.pov", &o, &h, NULL), STATUS_SCENE);
	/* What is no scene at all. */
	assert_int_equal(read_file("nothing.pov", NULL, &h, NULL), STATUS_SCENE);
	assert_string_equal(h.error, "nothing.pov: error: the scene cannot be opened: No such file or directory");
	assert_int_equal(read_file("lib", NULL, &h, NULL), STATUS_SCENE);
	assert_string_equal(h.error, "lib: error: is a folder, not a scene file");
	write_file("empty.pov", " \n");
	assert_int_equal(read_file("empty.pov", NULL, &h, NULL), STATUS_SCENE);
	assert_string_equal(h.error, "empty.pov: error: the file is empty");
	assert_int_equal(chdir("/"), 0);
	snprintf(path, sizeof(path), "rm -r %s", dir);
	snprintf(want, sizeof(want), "%s", path);
	assert_int_equal(system(want), 0);
}

static void ini(void **state)
{
	const struct read_define define = { "N", "3" };
	struct read_options o = { .defines = &define, .define_count = 1 };
	char dir[] = "/tmp/alidade-test-XXXXXX", path[256];
	static struct heard h;
	struct read_job job;

	(void)state;
	assert_non_null(mkdtemp(dir));
	assert_int_equal(chdir(dir), 0);
	assert_int_equal(system("mkdir scene"), 0);
	write_file("scene/a.pov", "#debug concat(str(image_width, 0, 0), \"x\", str(image_height, 0, 0), "
				  "str(N, 0, 0), T)");
	write_file("scene/a.ini", "; a comment\nVersion=3.7\nAll_File='log'\nInput_File_Name='a.pov'\n"
				  "Output_File_Name=\"../out.png\"\nWidth=320\nHeight = 200\nStart_Row=0.25\n"
				  "Antialias=on\nAntialias_Depth=2\nSampling_Method=2\nAntialias_Threshold=0.03\n"
				  "Output_Alpha=1\nWidht=1\nDeclare=N=2\nDeclare=T=\"t\"\n");
	assert_int_equal(read_file("scene/a.ini", &o, &h, &job), STATUS_OK);
	assert_string_equal(h.debug, "320x2003t"); /* the command line's N wins */
	assert_string_equal(h.warning, "scene/a.ini:14:1: warning: the option Widht is not known and ignored");
	assert_string_equal(job.output, "scene/../out.png");
	free(job.output);
	assert_int_equal(job.set, READ_JOB_WIDTH | READ_JOB_HEIGHT | READ_JOB_OUTPUT | READ_JOB_START_ROW |
				  READ_JOB_AA | READ_JOB_AA_DEPTH | READ_JOB_AA_METHOD |
				  READ_JOB_AA_THRESHOLD | READ_JOB_ALPHA);
	assert_int_equal(job.width, 320);
	assert_true(job.aa && job.alpha && job.start_row == 0.25 && job.aa_threshold == 0.03);
	write_file("bad.ini", "Input_File_Name=a.pov\nWidth=many\n");
	assert_int_equal(read_file("bad.ini", NULL, &h, NULL), STATUS_SCENE);
	assert_string_equal(h.error, "bad.ini:2:1: error: Width=many: the value is no number");
	write_file("none.ini", "Width=10\n");
	assert_int_equal(read_file("none.ini", NULL, &h, NULL), STATUS_SCENE);
	write_file("self.ini", "Input_File_Name=self.ini\n");
	assert_int_equal(read_file("self.ini", NULL, &h, NULL), STATUS_SCENE);
	assert_int_equal(chdir("/"), 0);
	snprintf(path, sizeof(path), "rm -r %s", dir);
	assert_int_equal(system(path), 0);
}

static void numbers(void **state)
{
	static const char *const text[] = {
		"0", "1", "0.1", "123456.789012", "9007199254740993", "9007199254740992", "1e22", "1e23",
		"1.7976931348623157e308", "4.9e-324", "2.2250738585072011e-308", ".5", "5.", "0.000000",
		"12345678901234567890123", "3.14159265358979323846264338327950288", "1e-400", "00001.5",
		"8.5070591730234615847396907784e37", "0.30000000000000004", "179769313486231570000e288",
	};
	double v;
	const char *end, *stray = "1ex";
	char buf[64];
	uint64_t rng = 1;

	(void)state;
	for (size_t i = 0; i < sizeof(text) / sizeof(text[0]); i++) {
		end = number_parse(text[i], text[i] + strlen(text[i]), &v);
		assert_ptr_equal(end, text[i] + strlen(text[i]));
		assert_memory_equal(&v, &(double){ strtod(text[i], NULL) }, sizeof(v));
	}
	for (int i = 0; i < 200000; i++) {
		rng = rng * 6364136223846793005u + 1442695040888963407u;
		snprintf(buf, sizeof(buf), i & 1 ? "%.6f" : "%.17g", (double)(rng >> 11) / (1 << (i % 30)) * 1e-12);
		assert_non_null(number_parse(buf, buf + strlen(buf), &v));
		assert_memory_equal(&v, &(double){ strtod(buf, NULL) }, sizeof(v));
	}
	assert_null(number_parse(".", ".", &v));
	assert_null(number_parse("x", "x", &v));
	end = number_parse(stray, stray + 3, &v);
	assert_int_equal(*end, 'e');
}

int main(void)
{
	const struct CMUnitTest test[] = {
		cmocka_unit_test(golden), cmocka_unit_test(errors), cmocka_unit_test(endless_functions),
		 cmocka_unit_test(harmless),
		cmocka_unit_test(lenient), cmocka_unit_test(nesting), cmocka_unit_test(limits),
		cmocka_unit_test(limit_names), cmocka_unit_test(stopping), cmocka_unit_test(includes),
		cmocka_unit_test(ini), cmocka_unit_test(numbers),
	};

	return cmocka_run_group_tests(test, NULL, NULL);
}
