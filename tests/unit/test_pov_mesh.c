/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Meshes: lists read as bytes and as tokens, textures of faces and corners, and wrong input of all kinds.
 */
#include <config.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/pool.h"
#include "pov_fixture.h"
#include "read/pov/scan.h"
#include "read/pov/share.h"

#define VERTICES "mesh2 { vertex_vectors { 4, <0,0,0>, <1,0,0>, <0,1,0>, <0,0,1> } "

static void expect(const char *text, const char *want, bool there)
{
	struct fixture f;

	fixture_read(&f, text, false);
	fixture_dump(&f, SCENE_DUMP_ARRAYS);
	if (f.status || !strstr(f.dump, want) == there)
		fail_msg("%s\n%s'%s' was%s expected in\n%s", text, f.messages, want, there ? "" : " not",
			 f.dump);
	fixture_release(&f);
}

static void expect_message(const char *text, const char *want, enum status status)
{
	struct fixture f;

	fixture_read(&f, text, false);
	if (f.status != status || !strstr(f.messages, want))
		fail_msg("%s\ngave status %d and\n%swanted\n%s", text, f.status, f.messages, want);
	fixture_release(&f);
}

/* However a list is written, the mesh is the same. */
static void test_ways(void **unused)
{
	static const char *const way[] = {
		"mesh2{vertex_vectors{4,<0,0,0>,<1,0,0>,<0,1,0>,<0,0,1>}face_indices{2,<0,1,2>,<1,2,3>}}",
		"mesh2 { vertex_vectors { 4 <0,0,0> <1,0,0> <0,1,0> <0,0,1> } "
		"face_indices { 2 <0,1,2> <1,2,3> } }",
		"mesh2 {\n\tvertex_vectors {\r\n4,\r\n< 0.0, +0, 0e5 > ,\n<1.000000,0.,.0>, /* one */ <0,1,0>,"
		" // two\n<0,0,1>, }\nface_indices { 2, <0,1,2>, <1,2,3>, } }",
		"#declare A = <1,0,0>; mesh2 { vertex_vectors { 4, <0,0,0>, A, y, <0,0,.5>*2 } "
		"face_indices { 2, <0,1,2>, <1,2,3> } }",
		"#declare N = 2; mesh2 { vertex_vectors { N*2, <0,0,0>, <1,0,0>, <0,1,0>, <0,0,1> } "
		"face_indices { N, <0,1,N>, <1,2,N+1> } }",
		"mesh2 { vertex_vectors { 4, #declare B = 0; #while (B < 3) <(B=1), (B=2), 0>, #declare B = B+1; "
		"#end <0,0,1> } face_indices { 2, <0,1,2>, <1,2,3> } }",
		"#macro V(X,Y,Z) <X,Y,Z>, #end mesh2 { vertex_vectors { 4, V(0,0,0) V(1,0,0) V(0,1,0) V(0,0,1)"
		"} face_indices { 2, <0,1,2>, <1,2,3> } }",
		"#macro M() mesh2 { vertex_vectors { 4, <0,0,0>, <1,0,0>, <0,1,0>, <0,0,1> } "
		"face_indices { 2, <0,1,2>, <1,2,3> } } #end M()",
	};

	(void)unused;
	for (size_t i = 0; i < sizeof(way) / sizeof(way[0]); i++)
		expect(way[i],
		       "mesh 0 vertices 4 triangles 2 smooth 0 normals 0 textures_per_face 0\n"
		       "  vertex 0 0 0 0\n  vertex 1 1 0 0\n  vertex 2 0 1 0\n  vertex 3 0 0 1\n"
		       "  triangle 0 0 1 2\n  triangle 1 1 2 3\n", true);
}

#define T3 "texture_list { 3, texture { pigment { rgb x } } texture { pigment { rgb y } } " \
	   "texture { pigment { rgb z } } } "

static void test_textures(void **unused)
{
	(void)unused;
	/* One for all faces, whichever way it is said: the object gets it, and the mesh no numbers. */
	expect(VERTICES T3 "face_indices { 2, <0,1,2>, 1, <1,2,3>, 1 } }", "textures_per_face 0\n", true);
	expect(VERTICES T3 "face_indices { 2, <0,1,2>, 1,1,1, <1,2,3>, 1,1,1 } pigment { rgb 1 } }",
	       "texture 0 layers 1\n  pigment colour < 0 1 0 >", true);
	expect(VERTICES T3 "face_indices { 2, <0,1,2>, 1,1,1, <1,2,3>, 1 } pigment { rgb 1 } }",
	       "texture 1 layers", false);
	expect(VERTICES "texture_list { 1 texture { } } face_indices { 1, <0,1,2>, 0,0,0 } }",
	       "texture 0 layers", true);
	/* One a face; numbers are the scene's, in the order of first use. */
	expect(VERTICES T3 "face_indices { 3, <0,1,2>, 2, <1,2,3>, 0, <0,1,3>, 2 } }",
	       "  texture 0 0\n  texture 1 1\n  texture 2 0\n", true);
	/* Faces without one have the object's. */
	expect(VERTICES T3 "face_indices { 2, <0,1,2>, <1,2,3>, 0 } pigment { rgb 1 } }",
	       "  texture 0 none\n  texture 1 0\n", true);
	expect(VERTICES T3 "face_indices { 2, <0,1,2>, <1,2,3> } pigment { rgb 1 } }",
	       "texture 0 layers 1\n  pigment colour < 1 1 1 >", true);
	/* Three a face, from the first that needs it. */
	expect(VERTICES T3 "face_indices { 4, <0,1,2>, 0, <1,2,3>, 0, <0,1,3>, 0,1,2, <0,2,3> } }",
	       "  texture 0 0 0 0\n  texture 1 0 0 0\n  texture 2 0 1 2\n  texture 3 none none none\n", true);
	expect(VERTICES T3 "face_indices { 3, <0,1,2>, 0, <1,2,3>, 1, <0,1,3>, 0,1,2 } }",
	       "  texture 0 0 0 0\n  texture 1 1 1 1\n  texture 2 0 1 2\n", true);
	/* What no face uses may be unsupported; names in the list; declarations in the braces. */
	expect(VERTICES "texture_list { 2, texture { pigment { checker rgb 1 rgb 0 } }, "
	       "texture { pigment { rgb x } }, } face_indices { 1, <0,1,2>, 1 } }", "colour < 1 0 0 >", true);
	expect(VERTICES "\n#declare MAT = texture { pigment { rgb x } }\ntexture_list { 1 texture { MAT } }"
	       "face_indices { 1, <0,1,2>, 0,0,0 } interior { ior 2 } radiosity { importance 0.5 } "
	       "photons { target } }", "colour < 1 0 0 >", true);
	/* Shared: one mesh, and its numbers are made the scene's only once. */
	expect("#declare D = " VERTICES T3 "face_indices { 2, <0,1,2>, 2, <1,2,3>, 0 } } "
	       "object { D } object { D translate x } sphere { 0, 1 texture { pigment { rgb x } } }",
	       "  texture 0 0\n  texture 1 1\n"
	       "roots from 0\nobject 0 mesh 0 next 1\nobject 1 mesh 0 next 2 place", true);
	/* mesh { } */
	expect("#declare A = texture { pigment { rgb x } } #declare B = texture { pigment { rgb y } } "
	       "mesh { triangle { 0, x, y texture { A } } triangle { 0, x, z uv_vectors <0,0>, <1,0>, <0,1> } "
	       "triangle { 0, y, z texture_list { A B, A } } }",
	       "  texture 0 0 0 0\n  texture 1 none none none\n  texture 2 0 1 0\n", true);
}

#define N2 "normal_vectors { 3, <0,0,2>, <1,0,0>, <0,-4,0> } "

static void test_normals(void **unused)
{
	(void)unused;
	expect(VERTICES N2 "face_indices { 1, <0,1,2> } normal_indices { 1, <0,1,2> } }",
	       "smooth 1 normals 3 textures_per_face 0\n", true);
	expect(VERTICES N2 "face_indices { 1, <0,1,2> } normal_indices { 1, <0,1,2> } }",
	       "  normal 0 0 0 1\n  normal 1 1 0 0\n  normal 2 0 -1 0\n", true);
	/* As many as vertices, and no normal_indices: face_indices serve. */
	expect(VERTICES "normal_vectors { 4, x, y, z, x } face_indices { 1, <0,1,2> } }",
	       "smooth 1 normals 4 textures_per_face 0\n", true);
	/* The rest is flat. */
	expect(VERTICES N2 "face_indices { 2, <0,1,2>, <1,2,3> } normal_indices { 1, <0,1,2> } }",
	       "triangles 2 smooth 1", true);
	/* Three times the same normal is a flat face; all flat: no normals are kept. */
	expect(VERTICES N2 "face_indices { 1, <0,1,2> } normal_indices { 1, <1,1,1> } }",
	       "triangles 1 smooth 0 normals 0", true);
	/* Smooth ones first, with all that belongs to them; without area: kept, until it is known where they stand. */
	expect(VERTICES N2 T3 "face_indices { 5, <0,1,2>, 0, <1,1,2>, 1, <1,2,3>, 2, <0,2,3>, 1, <0,1,3>, 1 } "
	       "normal_indices { 4, <1,1,1>, <0,1,2>, <2,1,0>, <0,0,1> } }",
	       "  triangle 0 1 1 2\n  triangle 1 1 2 3\n  triangle 2 0 2 3\n  triangle 3 0 1 2\n  triangle 4 0 1 3\n"
	       "  normal_index 0 0 1 2\n  normal_index 1 2 1 0\n  normal_index 2 0 0 1\n"
	       "  texture 0 0\n  texture 1 1\n  texture 2 0\n  texture 3 2\n  texture 4 0\n", true);
	expect(VERTICES "face_indices { 3, <0,1,2>, <1,1,2>, <2,2,2> } }", "triangles 3 smooth 0", true);
	expect(VERTICES "face_indices { 1, <1,1,2> } } sphere { 0, 1 }", "object 1 sphere", true);
	expect_message(VERTICES "normal_vectors { 1, <0,0,0> } face_indices { 1, <0,1,2> } "
		       "normal_indices { 0 } }", "1:66: warning: a normal in normal_vectors has no direction",
		       STATUS_OK);
	expect(VERTICES "face_indices { 1, <0,1,2> } inside_vector <0,2,0> }", "inside < 0 2 0 >", true);
}

/* Each is one error, at its place; or after a list that scanning has read the beginning of. */
static void test_errors(void **unused)
{
	static const char *const row[][2] = {
		{ VERTICES "\nface_indices { 2, <0,1,2>,\n <0,1,4> } }",
		  "3:2: error: index 4 in face_indices is out of range: vertices are counted from 0, and the "
		  "last is 3\n" },
		{ VERTICES "\nface_indices { 1, <0,-1,2> } }", "2:19: error: index -1 in face_indices" },
		{ VERTICES "\nface_indices { 1, <0,1,99999999999> } }", "2:19: error: index 99999999999 in" },
		{ VERTICES "\nface_indices { 2, <0,1,2> } }",
		  "2:27: error: face_indices announces 2, but has only 1\n" },
		{ VERTICES "\nface_indices { 1, <0,1,2>, <0,1,3> } }",
		  "2:28: error: face_indices announces 1, but more follow\n" },
		{ "mesh2 { vertex_vectors { 3, <0,0,0>, <1,0,0>,", "error: the file ends in vertex_vectors, after "
		  "2 of 3\n" },
		{ "mesh2 { vertex_vectors { 3, <0,0,0>, <1,0,", "error: " },
		{ "mesh2 { vertex_vectors { 3, <0,0,0>, <1,0,0", "error: " },
		{ "mesh2 { vertex_vectors { 1", "error: " },
		{ "mesh2 { vertex_vectors", "error: " },
		{ VERTICES "face_indices { 1, <0,1,2>", "the file ends inside face_indices" },
		{ VERTICES "face_indices { 1, <0,1,2> }", "the file ends inside mesh2 { ... }: a } is missing\n" },
		{ VERTICES, "the file ends in mesh2 { ... } before its face_indices\n" },
		{ "mesh2 { vertex_vectors { 3, <0,0,0>,\n <1,0,1e400>, <0,1,0> } face_indices { 1, <0,1,2> } }",
		  "2:7: error: the number 1e400 is too large" },
		{ "mesh2 { vertex_vectors { 3, <0,0,0>,\n <1,0,nan>, <0,1,0> } face_indices { 1, <0,1,2> } }",
		  "2:7: error: " },
		{ "mesh2 { vertex_vectors { 3, <0,0,0>,\n <1,0,1/0>, <0,1,0> } face_indices { 1, <0,1,2> } }",
		  "2:2: error: " },
		{ "mesh2 { vertex_vectors { 0 } face_indices { 1, <0,1,2> } }", "1:26: error: 0 vertex_vectors" },
		{ "mesh2 { vertex_vectors { 4294967295, <0,0,0> } }", "1:26: error: " },
		{ "mesh2 { vertex_vectors { 99999999, <0,0,0> } }",
		  "1:44: error: vertex_vectors announces 99999999, but has only 1\n" },
		{ "mesh2 { face_indices { 1, <0,1,2> } }", "1:9: error: vertex_vectors has to come before" },
		{ VERTICES "vertex_vectors { 1, <0,0,0> } }", "error: the mesh has a second vertex_vectors\n" },
		{ VERTICES T3 "\nface_indices { 1, <0,1,2>, 3 } }",
		  "2:28: error: texture number 3 is out of range: the textures of texture_list are counted "
		  "from 0, and the last is 2\n" },
		{ VERTICES "texture_list { 0 }\nface_indices { 1, <0,1,2>, 0 } }",
		  "2:28: error: a face has texture number 0, but the mesh has no textures" },
		{ VERTICES T3 "\nface_indices { 1, <0,1,2>, 0,0 } }", "2:19: error: a face has two texture" },
		{ VERTICES "\ntexture_list { 2 texture { } }\nface_indices { 1, <0,1,2>, 0 } }",
		  "2:30: error: texture_list announces 2, but has only 1\n" },
		{ VERTICES "\ntexture_list { 1 texture { } texture { } }\nface_indices { 1, <0,1,2>, 0 } }",
		  "2:30: error: texture_list announces 1, but more follow\n" },
		{ VERTICES "\ntexture_list { 36\n}\nface_indices { 1, <0,1,2>, 0 } }", /* the add-on can */
		  "3:1: error: texture_list announces 36, but has only 0\n" },
		{ VERTICES N2 "face_indices { 1, <0,1,2> } }",
		  "error: normal_indices is missing: the mesh has 3 normals for 4 vertices\n" },
		{ VERTICES N2 "face_indices { 1, <0,1,2> } \nnormal_indices { 1, <0,1,3> } }",
		  "2:21: error: index 3 in normal_indices is out of range" },
		{ VERTICES N2 "face_indices { 1, <0,1,2> } \nnormal_indices { 2, <0,1,2>, <0,1,2> } }",
		  "2:1: error: normal_indices announces 2, but the mesh has only 1 faces\n" },
		{ VERTICES "face_indices { 1, <0,1,2> } normal_indices { 1, <0,0,0> } }",
		  "error: normal_indices in a mesh without normals\n" },
		{ VERTICES "uv_vectors { 2, <0,0>, <1,1> } face_indices { 1, <0,1,2> }\n uv_indices { 2, <0,0,0>, "
		  "<0,0,0> } }", "2:2: error: uv_indices announces 2, but the mesh has 1 faces" },
		{ VERTICES "uv_vectors { 2, <0,0>, <1,1> } face_indices { 1, <0,1,2> }\n"
		  "uv_indices { 1, <0,1,2> } }", "2:17: error: index 2 in uv_indices is out of range" },
		{ VERTICES "uv_vectors { 2, <0,0>, <1,1> } face_indices { 1, <0,1,2> } }",
		  "error: uv_indices is missing" },
		{ "mesh { }", "1:8: error: the mesh has no triangles\n" },
		{ "mesh { triangle { 0, x, y texture { Foo } } }",
		  "1:37: error: the name of a declared texture is expected, not the undeclared identifier Foo" },
		{ VERTICES T3 "\nface_indices { 1, <0,1,2>, 0 } pigment { rgb 1 } texture_list { 0 } }",
		  "error: texture_list is not expected in mesh2" },
	};

	(void)unused;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++)
		expect_message(row[i][0], row[i][1], STATUS_SCENE);
}

/* Cut anywhere, a scene ends in an error and not in a crash. */
static void test_cuts(void **unused)
{
	static const char whole[] =
		"#declare T = texture { pigment { rgb x } }\n" VERTICES N2
		"uv_vectors { 2, <0.25,0>, <1,1> } texture_list { 2 texture { T } texture { } } face_indices { 2, "
		"<0,1,2>, 0,0,1, <1,2,3>, 1 } normal_indices { 1, <0,1,2> } uv_indices { 2, <0,1,1>, <1,0,1> } "
		"rotate <1,2,3> }";
	const struct read_options options = { 0 };

	(void)unused;
	for (size_t n = 0; n <= strlen(whole); n++) {
		struct fixture f;
		char *cut = malloc(n ? n : 1);

		assert_non_null(cut);
		memcpy(cut, whole, n);
		fixture_read_bytes(&f, cut, n, &options);
		if (n > 43 && n < strlen(whole))
			assert_int_equal(f.status, STATUS_SCENE);
		if (n == strlen(whole))
			assert_int_equal(f.status, STATUS_OK);
		assert_int_equal(f.diag.errors, f.status != STATUS_OK);
		fixture_release(&f);
		free(cut);
	}
}

/* Long lists, which several threads share. */

enum { LONG = 40000 }; /* elements: about 1 MB */

struct oddity { /* at element at of vertices or faces stands this instead of it */
	const char *name;
	unsigned at;
	const char *vertex, *face;
	unsigned every, most; /* faces have textures: each every-th face some of most numbers, 1 or 3 of them */
};

/* A face's numbers of textures: a thousand faces have three of them each, later ones fewer. */
static const char *numbers(const struct oddity *o, unsigned i, char out[32])
{
	out[0] = 0;
	if (o->every && i % o->every == 0)
		snprintf(out, 32, i / 1000 == 7 && o->most > 2 ? ", %u, %u,%u" : ", %u", i / 64 % o->most, i % 3,
			 i % 2);
	return out;
}

static const char *turn(const struct oddity *o, unsigned i, const char *odd, const char *plain)
{
	return i == o->at && odd ? odd : plain;
}

/* A mesh2 with all lists there are. Every hundredth element has a comment, in every seventh of which are brackets. */
static char *long_mesh(const struct oddity *o, int announced, bool comments)
{
	static const char *const remark[] = { "// <1,2,3>, <\n", "/* plain */", "/* } */ ", "\r\n\t", "//\n",
					      " /* < */ ", "" };
	size_t size;
	char *text, one[128], number[32];
	FILE *f = open_memstream(&text, &size);

	assert_non_null(f);
	fprintf(f, "#declare A = %s; mesh2 { vertex_vectors { %d,\n",
		o->every ? "texture { pigment { rgb x } }" : "<1,2,3>", announced);
	for (unsigned i = 0; i < LONG; i++) {
		snprintf(one, sizeof(one), "<%u.%06u, -%u, %u.5e-3>", i % 7, i, i % 1000, i);
		fprintf(f, "%s%s,\n", turn(o, i, o->vertex, one), comments && i % 100 == 3 ? remark[i / 100 % 7] : "");
	}
	fprintf(f, "} normal_vectors { %d,", LONG);
	for (unsigned i = 0; i < LONG; i++)
		fprintf(f, "<%u, 1, %d>%s", i % 91, i % 1000 ? 1 : 0, i % 5 ? ", " : "\n");
	fprintf(f, "} uv_vectors { %d, ", LONG);
	for (unsigned i = 0; i < LONG; i++)
		fprintf(f, "<0.%u, 1.%u>,", i, i % 91);
	if (o->every)
		fprintf(f, "} texture_list { 3 texture { A } texture { } texture { A }");
	fprintf(f, "} face_indices { %d,\n", LONG);
	for (unsigned i = 0; i < LONG; i++) {
		snprintf(one, sizeof(one), "<%u, %u, %u>%s", i, (i + 1) % LONG, (i * 7 + 3) % LONG,
			 numbers(o, i, number));
		fprintf(f, "%s%s,\n", turn(o, i, o->face, one), comments && i % 100 == 9 ? remark[i / 100 % 7] : "");
	}
	fprintf(f, "} normal_indices { %d,\n", LONG - 1);
	for (unsigned i = 0; i + 1 < LONG; i++)
		fprintf(f, "<%u, %u, %u>,\n", i, i / 2, i / 3);
	fprintf(f, "} uv_indices { %d,\n", LONG);
	for (unsigned i = 0; i < LONG; i++)
		fprintf(f, "<%u, %u, %u>,\n", i / 5, i / 2, i);
	fprintf(f, "} texture { uv_mapping pigment { checker rgb 0, rgb 1 } } }\n");
	fclose(f);
	return text;
}

static void read_with(struct fixture *f, const char *text, uint32_t threads)
{
	struct read_options options = { .pool = threads ? pool_new(threads) : NULL };

	fixture_read_bytes(f, text, strlen(text), &options);
	fixture_dump(f, SCENE_DUMP_ARRAYS);
	pool_free(options.pool);
}

static void expect_same(const struct oddity *o, int announced, bool comments)
{
	char *text = long_mesh(o, announced, comments);
	struct fixture alone, f;

	read_with(&alone, text, 0);
	if (!o->at && announced == LONG)
		assert_int_equal(alone.status, STATUS_OK);
	for (uint32_t threads = 1; threads <= 5; threads += 2) {
		read_with(&f, text, threads);
		if (f.status != alone.status || strcmp(f.messages, alone.messages) || strcmp(f.dump, alone.dump))
			fail_msg("%s, %d, %u threads: status %d, alone %d\n%s%s", o->name, announced, threads, f.status,
				 alone.status, f.messages, alone.messages);
		fixture_release(&f);
	}
	fixture_release(&alone);
	free(text);
}

static void test_long_lists(void **unused)
{
	static const struct oddity odd[] = {
		{ "plain", 0, NULL, NULL, 0, 0 },
		{ "one texture", 0, NULL, NULL, 1, 1 },
		{ "none or one", 0, NULL, NULL, 3, 1 },
		{ "late textures", 0, NULL, NULL, 12345, 2 },
		{ "textures", 0, NULL, NULL, 2, 3 },
		{ "textures, and an expression", 33333, NULL, "<1,2,3>, 1 + 1", 1, 2 },
		{ "textures, and three once", 33333, NULL, "<1,2,3>, 1,0,2", 1, 2 },
		{ "two textures", 23333, NULL, "<1,2,3>, 1,0", 1, 2 },
		{ "a texture that is none", 23333, NULL, "<1,2,3>, 3", 1, 2 },
		{ "a name", 20001, "A", NULL, 0, 0 },
		{ "an expression", 9999, "<1,2,3> + x", NULL, 0, 0 },
		{ "no number", 39999, "<1,2,z>", NULL, 0, 0 },
		{ "too large", 31000, "<1,2,1e400>", NULL, 0, 0 },
		{ "a comment in it", 20000, "<1,/* <2,3> */2,3>", "<0,/*}*/1,2>", 0, 0 },
		{ "an index that is none", 21000, NULL, "<1,2,40000>", 0, 0 },
		{ "a texture's number", 21000, NULL, "<1,2,3>, 0", 0, 0 },
		{ "an index with a point", 30000, NULL, "<1,2,3.5>", 0, 0 },
		{ "empty", 30000, "", NULL, 0, 0 },
		{ "two", 12345, "<1,2,3> <4,5,6>", "<1,2,3> <4,5,6>", 0, 0 },
		{ "an end", 12345, "}", "}", 0, 0 },
	};

	(void)unused;
	for (size_t i = 0; i < sizeof(odd) / sizeof(odd[0]); i++) {
		expect_same(&odd[i], LONG, false);
		expect_same(&odd[i], LONG, true);
	}
	expect_same(&odd[0], LONG - 1, false);
	expect_same(&odd[0], LONG + 1, false);
	expect_same(&odd[0], 5, false);
}

static const char *take_vector(void *list, const char *at, const char *end, size_t i)
{
	return scan_vector(at, end, (double *)list + 3 * i);
}

/* Behind a long list errors still have their line and column. */
static void test_long_place(void **unused)
{
	struct oddity odd = { "wrong", LONG - 1, NULL, "<1,2,3>, 3", 1, 1 };
	char *text = long_mesh(&odd, LONG, false), *wrong = strstr(text, "3>, 3,\n") + 4, *line = wrong, place[32];
	unsigned lines = 1;

	(void)unused;
	for (const char *p = text; p < wrong; p++)
		lines += *p == '\n';
	while (line[-1] != '\n')
		line--;
	snprintf(place, sizeof(place), "%u:%u: error", lines, (unsigned)(wrong - line) + 1);
	for (uint32_t threads = 0; threads <= 2; threads += 2) {
		struct fixture f;

		read_with(&f, text, threads);
		assert_int_equal(f.status, STATUS_SCENE);
		if (strncmp(f.messages, place, strlen(place)))
			fail_msg("not at %s: %s", place, f.messages);
		fixture_release(&f);
	}
	free(text);
}

/* All of a plain list is shared, and of another what stands before the comment that misleads. */
static void test_share(void **unused)
{
	static double got[3 * LONG];
	char *text = malloc(32 * (size_t)LONG), *to = text;
	struct pool *pool = pool_new(3);
	const char *at = text;

	(void)unused;
	assert_non_null(text);
	for (unsigned i = 0; i < LONG; i++)
		to += sprintf(to, "<%u,%u,%u>,\n", i, i + 1, 0);
	assert_int_equal(share_scan(NULL, take_vector, got, 0, LONG, &at, to), 0);
	assert_int_equal(share_scan(pool, take_vector, got, 7, LONG - 7, &at, to), LONG - 7);
	for (unsigned i = 7; i < LONG; i++)
		assert_true(got[3 * i] == i - 7 && got[3 * i + 1] == i - 6);
	at = text;
	memcpy(strstr(text, "<20000,"), "/*<*/<2,", 8);
	assert_in_range(share_scan(pool, take_vector, got, 0, LONG, &at, to), 10000, 21000);
	pool_free(pool);
	free(text);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_ways),   cmocka_unit_test(test_textures),
		cmocka_unit_test(test_normals), cmocka_unit_test(test_errors),
		cmocka_unit_test(test_cuts),   cmocka_unit_test(test_long_lists),
		cmocka_unit_test(test_share),	cmocka_unit_test(test_long_place),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
