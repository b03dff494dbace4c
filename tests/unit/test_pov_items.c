/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What the blocks of a scene file become in the scene: cameras, lights, textures, interiors, objects.
 */
#include <config.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "pov_fixture.h"

/* The dump of the scene that text makes has to contain want, or not. */
static void expect_dump(const char *text, const char *want, bool there)
{
	struct fixture f;

	fixture_read(&f, text, false);
	fixture_dump(&f, SCENE_DUMP_ARRAYS);
	if (f.status || !strstr(f.dump, want) == there)
		fail_msg("%s\n%s'%s' was%s expected in\n%s", text, f.messages, want, there ? "" : " not",
			 f.dump);
	fixture_release(&f);
}

/* Where the middles of the upper left and lower right of 4 x 3 pixels hit a sphere of radius 50 about
 * <0,0,0>, measured with POV-Ray 3.7 (half float colours: good to 0.03). */
static const struct {
	const char *version, *camera;
	double first[3], last[3];
} measured[] = {
	{ "3.7", "camera { }", { -21.39, 14.31, 42.87 }, { 21.39, -14.28, 42.87 } },
	{ "3.7", "camera { location <1,2,-6> look_at <0,1,0> angle 40 right x*16/9 }",
	  { -22.24, 0.54, 44.78 }, { 6.93, -13.94, 47.51 } },
	/* as the add-on writes it */
	{ "3.7",
	  "camera { location <0,0,0> look_at <0,0,-1> right <-1.7777777777777777,0,0> up <0,1,0> "
	  "angle 39.597753 rotate <-26.440706,46.691945,-0.000003> "
	  "translate <7.358891,4.958310,6.925791> }",
	  { -43.79, -13.89, -19.73 }, { -17.19, -27.92, -37.76 } },
	{ "3.7",
	  "camera { orthographic angle location <0,0,0> look_at <0,0,-1> right <-7.314286,0,0> "
	  "up <0,4.114286,0> rotate <-26.440706,46.691945,0> translate <7.358891,4.958310,6.925791> }",
	  { -34.81, -21.04, -29.06 }, { -30.16, -23.51, -32.21 } },
	{ "3.7", "camera { orthographic location <2,3,-8> look_at <0,1,0> }",
	  { -16.04, -8.01, 46.68 }, { -7.52, -13.55, 47.56 } },
	{ "3.7", "camera { orthographic location <2,3,-8> look_at <0,1,0> right 6*x up 4*y }",
	  { -14.09, -9.52, 47.02 }, { -9.57, -12.13, 47.56 } },
	{ "3.7", "camera { orthographic angle 30 location <2,3,-8> look_at <0,1,0> right 6*x up 4*y }",
	  { -13.53, -9.84, 47.12 }, { -10.13, -11.82, 47.51 } },
	/* the order of the words does not matter */
	{ "3.7",
	  "camera { sky <1,1,0> angle 70 look_at <0,3,1> location <-4,1,-5> direction 2*z up 1.2*y }",
	  { 12.70, 41.16, 25.34 }, { 28.22, -16.70, 37.74 } },
	/* right-handed and backwards */
	{ "3.7", "camera { right -x direction -1.5*z location <1,1,1> look_at <5,0,2> }",
	  { 44.04, 0.10, 23.63 }, { 45.75, -20.21, 0.10 } },
	/* along the sky vector */
	{ "3.7", "camera { location <0,6,0> look_at <0,0,0> angle 50 }",
	  { -17.90, -45.14, 11.96 }, { 17.87, -45.14, -11.96 } },
	{ "3.7",
	  "camera { location <3,0,0> rotate 30*y scale <1,1.5,-1> translate <0,1,0> angle 60 }",
	  { 8.01, 19.73, -45.24 }, { 39.26, -17.19, -25.72 } },
	{ "3.6", "camera { angle 60 right 1.6*x location <1,2,-3> look_at <0,0,1> }",
	  { -30.70, -8.50, 38.53 }, { 11.87, -29.17, 38.82 } },
	/* each word acts at once before version 3.5 */
	{ "3.1",
	  "camera { location <1,2,-3> look_at <0,0,1> angle 60 right 1.6*x rotate 20*y sky <1,1,0> "
	  "look_at 0 }",
	  { -4.13, 0.10, 49.80 }, { 6.05, -44.95, 21.04 } },
	{ "3.7",
	  "#declare C = camera { location <1,2,-6> look_at 0 angle 30 } "
	  "camera { C translate <0,1,0> rotate 45*z }",
	  { -8.25, -18.31, 45.80 }, { 17.63, -12.40, 45.12 } },
	/* the last one counts */
	{ "3.7", "camera { location 5 look_at 0 } camera { }", { -21.39, 14.31, 42.87 },
	  { 21.39, -14.28, 42.87 } },
};

static void test_focal_blur(void **unused)
{
	static const struct {
		const char *text;
		double aperture, distance;
		uint32_t samples;
	} row[] = {
		{ "camera { aperture 1 }", 0, 1, 0 },
		{ "camera { blur_samples 9 }", 0, 1, 9 },
		{ "camera { aperture 1 blur_samples 9 location 1 focal_point <1, 1, -4> scale 3 }", 1, 5,
		  9 },
		{ "camera { aperture 1 blur_samples 2, 20 angle 90 right x*4 }", 1, 2, 20 },
		{ "camera { aperture 1 blur_samples 9 direction z*7 }", 1, 1, 9 },
		{ "camera { aperture 1 blur_samples 9 direction z*7 look_at x }", 1, 7, 9 },
		{ "#declare C = camera { aperture 2 blur_samples 9 focal_point z*3 } camera { C scale 2 }",
		  2, 3, 9 },
	};

	(void)unused;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++) {
		struct fixture f;

		fixture_read(&f, row[i].text, false);
		assert_int_equal(f.status, STATUS_OK);
		assert_true(f.scene.camera.aperture == row[i].aperture);
		assert_true(fabs(f.scene.camera.focal_distance - row[i].distance) < 1e-12);
		assert_int_equal(f.scene.camera.blur_samples, row[i].samples);
		fixture_release(&f);
	}
}

/* Angles that stay angles, and those that POV-Ray takes where none is given. */
static void test_camera_angles(void **unused)
{
	static const struct {
		const char *text;
		enum camera_kind kind;
		double angle, angle_up;
	} row[] = {
		{ "camera { fisheye angle 200 }", CAMERA_FISHEYE, 200, 0 },
		{ "camera { fisheye }", CAMERA_FISHEYE, 90, 180 },
		{ "camera { spherical }", CAMERA_SPHERICAL, 360, 180 },
		{ "camera { spherical angle 100 }", CAMERA_SPHERICAL, 100, 50 },
		{ "camera { spherical angle 100, 20 }", CAMERA_SPHERICAL, 100, 20 },
		{ "camera { cylinder 4 angle 270 }", CAMERA_CYLINDER_4, 270, 0 },
		{ "#declare C = camera { ultra_wide_angle angle 70 } camera { C rotate y }",
		  CAMERA_ULTRA_WIDE_ANGLE, 70, 0 },
	};

	(void)unused;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++) {
		struct fixture f;

		fixture_read(&f, row[i].text, false);
		assert_int_equal(f.status, STATUS_OK);
		assert_int_equal(f.scene.camera.kind, row[i].kind);
		assert_true(f.scene.camera.angle == row[i].angle);
		assert_true(f.scene.camera.angle_up == row[i].angle_up);
		fixture_release(&f);
	}
}

static void expect_hit(const struct camera *c, double x, double y, const double want[3],
		       const char *text)
{
	vec side = vec_mad(vec_scale(c->right, x), c->up, y), at = c->location, dir = c->direction;
	double b, t;

	if (c->kind == CAMERA_ORTHOGRAPHIC)
		at = vec_add(at, side);
	else
		dir = vec_add(dir, side);
	dir = vec_unit(dir);
	b = vec_dot(at, dir);
	t = -b + sqrt(b * b - (vec_dot(at, at) - 2500));
	at = vec_mad(at, dir, t);
	if (!(fabs(at.x - want[0]) < 0.05 && fabs(at.y - want[1]) < 0.05 && fabs(at.z - want[2]) < 0.05))
		fail_msg("%s\nsees %.3f %.3f %.3f, not %.3f %.3f %.3f", text, at.x, at.y, at.z, want[0],
			 want[1], want[2]);
}

static void test_cameras(void **unused)
{
	struct fixture f;
	char text[600];

	(void)unused;
	for (size_t i = 0; i < sizeof(measured) / sizeof(measured[0]); i++) {
		snprintf(text, sizeof(text), "#version %s; global_settings { assumed_gamma 1 } %s",
			 measured[i].version, measured[i].camera);
		fixture_read(&f, text, false);
		if (f.status)
			fail_msg("%s\n%s", text, f.messages);
		assert_true(f.scene.has_camera);
		expect_hit(&f.scene.camera, -0.375, 1.0 / 3, measured[i].first, text);
		expect_hit(&f.scene.camera, 0.375, -1.0 / 3, measured[i].last, text);
		fixture_release(&f);
	}
}

static void test_lights(void **unused)
{
	static const char *const row[][2] = {
		{ "", "light 0 point location < 4 2 3 > colour < 1 0.5 0.25 >\n" },
		{ "fade_distance 3 fade_power 2", "fade_distance 3 fade_power 2\n" },
		{ "shadowless", "shadowless\n" },
		{ "spotlight point_at <4,0,3>",
		  "spot location < 4 2 3 > colour < 1 0.5 0.25 > direction < 0 -1 0 > axis_length 2 "
		  "radius 30 falloff 45 tightness 0\n" },
		{ "spotlight radius 5 falloff 7 tightness 9 point_at <4,0,3>",
		  "radius 5 falloff 7 tightness 9\n" },
		/* of these three the last one counts: measured with POV-Ray */
		{ "spotlight point_at 0 shadowless", "light 0 point location < 4 2 3 > colour < 1 0.5 0.25 > "
		  "shadowless\n" },
		{ "shadowless spotlight point_at <4,0,3>", "colour < 1 0.5 0.25 > direction < 0 -1 0 >" },
		{ "cylinder point_at <4,0,3>", "cylinder location < 4 2 3 > colour < 1 0.5 0.25 > parallel "
		  "direction < 0 -1 0 > axis_length 2 radius 0.75 falloff 1 tightness 0\n" },
		/* point_at is <0,0,1> if it is not given: measured too */
		{ "parallel", "parallel direction < -0.8164965809277261 -0.4082482904638631 " },
		{ "parallel point_at <4,0,3> scale <1,-1,2>",
		  "location < 4 -2 6 > colour < 1 0.5 0.25 > parallel direction < 0 1 0 >\n" },
		{ "area_light <2,0,0>, <0,0,2>, 4, 3 adaptive 2 jitter circular orient area_illumination on",
		  "area < 2 0 0 > by < 0 0 2 > points 4 3 adaptive 2 area_illumination jitter circular "
		  "orient\n" },
		{ "area_light x, z, 1, 1 rotate 90*y", "points 1 1\n" },
		{ "media_attenuation on media_interaction off photons { refraction on }",
		  "light 0 point location < 4 2 3 > colour < 1 0.5 0.25 > attenuated no_media\n" },
		{ "media_attenuation off media_interaction on", "colour < 1 0.5 0.25 >\n" },
	};
	char text[600];

	(void)unused;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++) {
		snprintf(text, sizeof(text), "light_source { <4,2,3>, rgb <1,.5,.25> %s }", row[i][0]);
		expect_dump(text, row[i][1], true);
	}
	/* In a union, and declared: transforms reach the light. */
	expect_dump("#declare L = light_source { x, 1 spotlight point_at 0 } "
		    "union { object { L translate y } sphere { 0, 1 } scale 2 }",
		    "spot location < 2 2 0 > colour < 1 1 1 > direction < -1 0 0 > axis_length 2", true);
}

#define BASE "ambient < 0.1 0.1 0.1 > emission < 0 0 0 > "
#define SHINE "phong 0 phong_size 40 specular 0 roughness 0.05 metallic 0 "
#define MIRROR "reflection < 0 0 0 > to < 0 0 0 > falloff 1 exponent 1 reflection_metallic 0"

static void test_finishes(void **unused)
{
	static const char *const row[][2] = {
		{ "", BASE "diffuse 0.6 diffuse_back 0 brilliance 1 " SHINE MIRROR "\n" },
		{ "ambient 0.5", "ambient < 0.5 0.5 0.5 >" },
		{ "ambient rgb <1,0,.5>", "ambient < 1 0 0.5 >" },
		{ "emission <1,0,.5>", "emission < 1 0 0.5 >" },
		{ "diffuse .25", "diffuse 0.25 diffuse_back 0 " },
		{ "diffuse .25, .5", "diffuse 0.25 diffuse_back 0.5 " },
		{ "diffuse albedo .25 brilliance 3", "diffuse 0.5 diffuse_back 0 brilliance 3 " },
		{ "phong .5 phong_size 9", "phong 0.5 phong_size 9 " },
		{ "phong albedo .5 phong_size 9", "phong 2.5 phong_size 9 " },
		{ "specular .5 roughness .25", "specular 0.5 roughness 0.25 " },
		/* (4 + 2) / (4 (2 - 1/4)) */
		{ "specular albedo .7 roughness .25", "specular 0.6 roughness 0.25 " },
		{ "metallic", "roughness 0.05 metallic 1 " },
		{ "metallic .5", "roughness 0.05 metallic 0.5 " },
		{ "reflection .5", "reflection < 0.5 0.5 0.5 > to < 0.5 0.5 0.5 > falloff 1" },
		{ "reflection rgb <1,0,.5>", "reflection < 1 0 0.5 > to < 1 0 0.5 >" },
		{ "reflection { .25 }", "reflection < 0.25 0.25 0.25 > to < 0.25 0.25 0.25 >" },
		{ "reflection { .25, .5 falloff 3 exponent 1.25 metallic }",
		  "reflection < 0.25 0.25 0.25 > to < 0.5 0.5 0.5 > falloff 3 exponent 1.25 "
		  "reflection_metallic 1\n" },
		{ "reflection { .5 fresnel 1}", "reflection < 0 0 0 > to < 0.5 0.5 0.5 > falloff 1 exponent 1 "
		  "reflection_metallic 0 fresnel\n" },
		{ "reflection { .25, .5 fresnel }", "reflection < 0.25 0.25 0.25 > to < 0.5 0.5 0.5 >" },
		{ "reflection { .5 fresnel off }", "reflection < 0.5 0.5 0.5 > to < 0.5 0.5 0.5 >" },
		{ "reflection .5 reflection_exponent 2", "exponent 2 " },
		{ "conserve_energy", "reflection_metallic 0 conserve_energy\n" },
		{ "crand 0 irid { 0 thickness 1 } subsurface { translucency 1 }", BASE },
		{ "subsurface { translucency <3, 2, 1> anisotropy .5 }", "translucency < 3 2 1 >\n" },
		{ "subsurface { translucency 1.5 }", "translucency < 1.5 1.5 1.5 >\n" },
		{ "subsurface { translucency <1, 0, .5> }", "translucency < 1 0.01 0.5 >\n" },
		{ "subsurface { }", "reflection_metallic 0\n" }, /* light does not go below at all */
	};
	char text[600];

	(void)unused;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++) {
		snprintf(text, sizeof(text), "sphere { 0, 1 finish { %s } }", row[i][0]);
		expect_dump(text, row[i][1], true);
		/* The same by name, changed behind the name, and in #default. */
		snprintf(text, sizeof(text), "#declare F = finish { %s } sphere { 0, 1 finish { F } }",
			 row[i][0]);
		expect_dump(text, row[i][1], true);
		snprintf(text, sizeof(text), "#default { finish { %s } } sphere { 0, 1 }", row[i][0]);
		expect_dump(text, row[i][1], true);
	}
	/* albedo counts where it is written, not again where the finish is used. */
	expect_dump("#declare F = finish { diffuse albedo .5 brilliance 3 } "
		    "sphere { 0, 1 finish { F brilliance 1 } }", "diffuse 1 diffuse_back 0 brilliance 1",
		    true);
}

#define ONE(colour) "layers 1\n  pigment colour < " colour " > filter 0 transmit 0\n"

static void test_textures(void **unused)
{
	(void)unused;
	/* Without #default the pigment is black. */
	expect_dump("sphere { 0, 1 }", ONE("0 0 0"), true);
	expect_dump("sphere { 0, 1 texture { } }", ONE("0 0 0"), true);
	expect_dump("sphere { 0, 1 pigment { color rgbft <1,0,0.5,0.25,0.125> } }",
		    "colour < 1 0 0.5 > filter 0.25 transmit 0.125", true);
	/* The second pigment counts; identifiers of pigments in a texture; transforms mean nothing. */
	expect_dump("sphere { 0, 1 texture { pigment { rgb x } pigment { rgb y } scale 2 } }",
		    ONE("0 1 0"), true);
	expect_dump("#declare P = pigment { rgb x rotate 3 } sphere { 0, 1 texture { P } }", ONE("1 0 0"),
		    true);
	expect_dump("#declare P = pigment { rgb x } sphere { 0, 1 uv_mapping pigment { P } }",
		    ONE("1 0 0"), true);
	expect_dump("#declare C = rgb x; sphere { 0, 1 pigment { C } }", ONE("1 0 0"), true);
	/* Layers: the last texture lies on top, and a pigment behind it changes that one. */
	expect_dump("sphere { 0, 1 texture { pigment { rgb x } } texture { pigment { rgbt <0,1,0,.5> } } }",
		    "layers 2\n  pigment colour < 0 1 0 > filter 0 transmit 0.5\n", true);
	expect_dump("#declare T = texture { pigment { rgb x } } texture { pigment { rgb y } }; "
		    "sphere { 0, 1 texture { T } pigment { rgb z } }",
		    "layers 2\n  pigment colour < 0 0 1 >", true);
	expect_dump("#declare T = texture { pigment { rgb x } } "
		    "sphere { 0, 1 texture { T pigment { rgb z } } } sphere { 0, 1 texture { T } }",
		    "texture 1 " ONE("1 0 0"), true);
	/* material { } */
	expect_dump("#declare M = material { texture { pigment { rgb x } } interior { ior 1.5 } } "
		    "sphere { 0, 1 material { M } }", ONE("1 0 0"), true);
	expect_dump("#declare M = material { texture { pigment { rgb x } } interior { ior 1.5 } } "
		    "sphere { 0, 1 material { M } }", "interior 0 ior 1.5 ", true);
	expect_dump("sphere { 0, 1 pigment { rgb x } interior { ior 0 } }", "interior 0 ior 1 ", true);
	/* What is only declared is no error. */
	expect_dump("#declare P = pigment { checker rgb 1 rgb 0 } #declare N = normal { bumps 1 } "
		    "#declare T = texture { marble texture_map { [0 P] [1 P] } } "
		    "#declare O = julia_fractal { <1,0,0,0> } #declare D = difference { object { O } object { O } } "
		    "#declare S = sky_sphere { pigment { P } } sphere { 0, 1 pigment { rgb x } }",
		    ONE("1 0 0"), true);
}

static void test_defaults(void **unused)
{
	(void)unused;
	/* The default where an object is used counts, not where it was declared (measured) ... */
	expect_dump("#default { pigment { rgb x } } #declare S = sphere { 0, 1 } "
		    "#default { pigment { rgb y } } object { S }", ONE("0 1 0"), true);
	expect_dump("union { sphere { 0, 1 } #default { pigment { rgb y } } }", ONE("0 1 0"), true);
	/* ... but a texture is complete where it is written. */
	expect_dump("#default { pigment { rgb x } } #declare T = texture { finish { ambient 0 } } "
		    "#default { pigment { rgb y } } sphere { 0, 1 texture { T } }", ONE("1 0 0"), true);
	/* Objects before a #default keep the old one. */
	expect_dump("sphere { 0, 1 } #default { pigment { rgb y } }", ONE("0 0 0"), true);
	expect_dump("#default { texture { pigment { rgb z } finish { ambient 1 } } } sphere { 0, 1 }",
		    ONE("0 0 1") "  finish ambient < 1 1 1 >", true);
}

static void test_objects(void **unused)
{
	static const char *const row[][2] = {
		{ "sphere { <1,2,3>, 4 }", "sphere < 1 2 3 > radius 4 " },
		{ "box { <1,-2,3>, <-1,2,-3> }", "box < -1 -2 -3 > to < 1 2 3 > " },
		{ "cylinder { 0, 2*y, 3 open }", "cone < 0 0 0 > radius 3 to < 0 2 0 > radius 3 open" },
		{ "cone { 0, 1, 2*y, 0 }", "cone < 0 0 0 > radius 1 to < 0 2 0 > radius 0 " },
		{ "plane { 2*y, 3 }", "plane < 0 1 0 > distance 3 " },
		{ "disc { 1, <0,0,-5>, 2, .5 }", "disc < 1 1 1 > normal < 0 0 -1 > radius 2 hole 0.5 " },
		{ "disc { 1, <0,0,-5>, 2 }", "radius 2 hole 0 " },
		{ "torus { 3, 1 sturm }", "torus 3 minor 1 " },
		{ "triangle { 0, x, y }", "mesh 0 vertices 3 triangles 1 smooth 0 normals 0" },
		{ "smooth_triangle { 0, -z, x, <1,0,-1>, y, -z }", "triangles 1 smooth 1 normals 3" },
		/* all normals the same: POV-Ray's triangle is flat */
		{ "smooth_triangle { 0, x+y, x, x+y, y, x+y }", "triangles 1 smooth 0 normals 0" },
		{ "sphere { 0, 1 no_shadow no_image no_reflection hollow double_illuminate inverse }",
		  "no_shadow no_image no_reflection hollow double_illuminate inverse\n" },
		{ "sphere { 0, 1 hollow hollow off inverse inverse no_image off }", "texture 0\n" },
		{ "sphere { 0, 1 hierarchy off photons { target } radiosity { importance .5 } "
		  "bounded_by { box { -1, 1 } } }", "radius 1 texture 0\n" },
		{ "union { sphere { 0, 1 } sphere { 0, 2 } hollow no_shadow split_union off }",
		  "sphere < 0 0 0 > radius 2 texture 0 no_shadow hollow\n" },
		/* what a part says itself wins for hollow, what the union says for double_illuminate */
		{ "union { sphere { 0, 1 hollow off double_illuminate off } hollow double_illuminate }",
		  "radius 1 texture 0 double_illuminate\n" },
		{ "sphere { 0, 1 interior { ior 1.5 caustics .5 fade_distance 2 fade_power 1001 "
		  "fade_color <1,.5,0> dispersion 1 } }",
		  "interior 0 ior 1.5 caustics 0.5 fade_distance 2 fade_power 1001 fade_colour < 1 0.5 0 >" },
		{ "sphere { 0, 1 interior { fade_power 2 } }", "fade_distance 0 fade_power 2 " },
		{ "sphere { 0, 1 interior { ior 1.5 dispersion 1.02 } }", "dispersion 1.02 samples 7\n" },
		/* whole bands only */
		{ "sphere { 0, 1 interior { dispersion_samples 3.9 ior 1.5 dispersion 0.9 } }",
		  "dispersion 0.9 samples 3\n" },
		/* POV-Ray wants an ior beside it */
		{ "sphere { 0, 1 interior { dispersion 1.1 } }", "fade_colour < 0 0 0 >\n" },
		/* lights in no group, in one, and in one within; what they look like is lit by others too */
		{ "light_group { sphere { 0, 1 } light_source { 0, 1 } }", "light 0 point location < 0 0 0 > colour "
		  "< 1 1 1 > group 0\nlight_set 0 group 0\n" },
		{ "light_group { sphere { 0, 1 } global_lights on translate x }",
		  "light_set 0 group 0 global_lights\n" },
		{ "light_group { sphere { 0, 1 } }", "radius 1 texture 0 light_set 0\n" },
		{ "light_group { light_group { sphere { 0, 1 } global_lights } }",
		  "light_set 0 group 0\nlight_set 1 group 1\n" },
		{ "light_group { union { light_source { 0, 1 } sphere { 0, 1 } } }", "colour < 1 1 1 >\n" },
		{ "light_group { light_source { 0, 1 looks_like { sphere { 0, 1 } } } }",
		  "light_set 0 group 0\nlight_set 1 group 0 global_lights\n" },
		{ "light_source { 0, 1 projected_through { sphere { 0, 1 } } translate x }",
		  "light_set 0 projected\n" },
		{ "#declare A = sphere { 0, 1 } object { A translate x }", "place < 1 0 0 0 1 0 0 0 1 1 0 0 >" },
		{ "#declare A = sphere { 0, 1 } object { A translate x } A",
		  "object 1 sphere < 0 0 0 > radius 1 texture 0\n" },
		{ "#declare A = sphere { 0, 1 } sphere { A scale 2 }", "place < 2 0 0 0 2 0 0 0 2 0 0 0 >" },
		/* the add-on declares inside an object's braces */
		{ "sphere { 0, 1 #declare T = texture { pigment { rgb x } }; texture { T } }", ONE("1 0 0") },
		/* POV-Ray turns a scale of 0 into 1 */
		{ "sphere { 0, 1 scale <2,0,2> }", "place < 2 0 0 0 1 0 0 0 2 0 0 0 >" },
	};

	(void)unused;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++)
		expect_dump(row[i][0], row[i][1], true);
}

/* Textures and interiors go down into unions; media count only in hollow objects. */
static void test_unions(void **unused)
{
	(void)unused;
	expect_dump("#declare U = union { sphere { 0, 1 } } union { object { U } pigment { rgb z } }",
		    ONE("0 0 1"), true);
	expect_dump("union { sphere { 0, 1 pigment { rgb x } } pigment { rgb z } }", ONE("1 0 0"), true);
	expect_dump("union { sphere { 0, 1 pigment { rgb x } } interior { ior 2 } }", "interior 0 ior 2", true);
	expect_dump("union { sphere { 0, 1 } sphere { 0, 2 } interior { ior 2 } }", "interior 1 ior", false);
	expect_dump("union { sphere { 0, 1 pigment { rgb z } } pigment { rgb x } "
		    "interior_texture { pigment { rgb y } } }", "texture 0 interior_texture 1", true);
	expect_dump("sphere { 0, 1 interior { media { emission 1 } } }", "interior 0 ior 1 ", true);
	/* The order of the file is kept, and unions stand where they were written. */
	expect_dump("sphere { 0, 1 } union { sphere { 0, 2 } union { box { 0, 1 } } } sphere { 0, 3 }",
		    "object 0 sphere < 0 0 0 > radius 1 texture 0 next 1\n"
		    "object 1 union first_child 2 next 5\n"
		    "object 2 sphere < 0 0 0 > radius 2 texture 0 next 3\n"
		    "object 3 union first_child 4\n"
		    "object 4 box < 0 0 0 > to < 1 1 1 > texture 0\n"
		    "object 5 sphere < 0 0 0 > radius 3 texture 0\n", true);
}

static void test_settings(void **unused)
{
	(void)unused;
	expect_dump("global_settings { assumed_gamma 2.5 max_trace_level 7 adc_bailout .25 "
		    "ambient_light rgb <1,.5,0> number_of_waves 3 noise_generator 2 "
		    "irid_wavelength rgb 1 charset utf8 max_intersections 9 mm_per_unit 2 } "
		    "background { rgbt <.5,0,1,.25> }",
		    "assumed_gamma 2.5 max_trace_level 7 adc_bailout 0.25 ambient_light < 1 0.5 0 > "
		    "background < 0.5 0 1 > filter 0 transmit 0.25\n", true);
	expect_dump("#version 3.7; sphere { 0, 1 }", "version 370 assumed_gamma 1 max_trace_level 5", true);
	expect_dump("#version 3.6; sphere { 0, 1 }", "version 360 assumed_gamma 0 ", true);
	expect_dump("global_settings { max_trace_level 1000 }", "max_trace_level 256 ", true);
	expect_dump("sphere { 0, 1 finish { subsurface { translucency 1 } } } "
		    "global_settings { mm_per_unit 4 subsurface { radiosity samples 9.5, 8 } }",
		    "subsurface samples 9 8 mm_per_unit 4 radiosity\n", true);
	expect_dump("global_settings { subsurface { samples 0, -3 radiosity off } }",
		    "subsurface samples 0 0 mm_per_unit 10\n", true);
	expect_dump("global_settings { mm_per_unit 3 }", "subsurface", false);
	/* photons of objects need the global block too */
	expect_dump("global_settings { photons { count 9 } subsurface { samples 9, 9 } } sphere { 0, 1 }",
		    "sphere", true);
}

/* Whole files as Blender's add-on wrote them (tests/pov/blender/export.py). */
static void read_export(struct fixture *f, const char *name)
{
	const struct read_options options = { 0 };
	const char *srcdir = getenv("srcdir");
	static char bytes[1 << 20];
	char path[1024];
	size_t size;
	FILE *file;

	snprintf(path, sizeof(path), "%s/tests/pov/blender/%s.pov", srcdir ? srcdir : ".", name);
	file = fopen(path, "rb");
	if (!file)
		fail_msg("cannot open %s", path);
	size = fread(bytes, 1, sizeof(bytes), file);
	fclose(file);
	fixture_read_bytes(f, bytes, size, &options);
	if (f->status)
		fail_msg("%s: %s", name, f->messages);
	fixture_dump(f, 0);
}

static void test_exports(void **unused)
{
	static const char *const want[][2] = {
		{ "default", "camera perspective location < 7.358891 4.95831 6.925791 >" },
		{ "default", "light 0 point location < 4.076245 5.903862 -1.005454 > colour < 1 1 1 > "
			     "fade_distance 3.872982 fade_power 2\n" },
		/* texture { } is #default's srgb 0.8; flat faces need no normals */
		{ "default", "mesh 0 vertices 8 triangles 12 smooth 0 normals 0 textures_per_face 0\n" },
		{ "default", "interior 0 ior 1.3 caustics 0.15 " },
		{ "default", "object 0 mesh 0 texture 0 interior 0 place < 1 0 0 0 0 -1 0 1 0 0 0 0 >\n" },
		{ "default", "pigment colour < 0.60382" },
		{ "ortho", "camera orthographic location < 7.358891 4.95831 6.925791 >" },
		{ "many", "light 0 point location < -4 5 0 > colour < 1 1 1 > area < 1 0 0 > by < 0 0 -1 > "
			  "points 1 1 area_illumination fade_distance 50 fade_power 2\n" },
		{ "many", "light 2 spot location < 4 6 0 > colour < 1 1 1 > direction < 0 -1 0 > "
			  "axis_length 1 radius 19.125 falloff 22.5 tightness 0 " },
		{ "many", "light 3 point location < 0 9 0 > colour < 1 1 1 > parallel direction < 0 -1 0 >" },
		{ "many", "mesh 0 vertices 8 triangles 12 smooth 0 normals 0 textures_per_face 3\n" },
		{ "many", "mesh 1 vertices 42 triangles 80 smooth 80 normals 42 textures_per_face 1\n" },
		{ "many", "object 1 mesh 1 interior 1 next 2 place" },
		{ "many", "object 2 mesh 1 interior 1 next 3 place < 1 0 0 0 0 1 0 0.5 0 2.5 0 0 >\n" },
		{ "many", "texture 25 layers 1\n  pigment colour < 0.8" },
	};

	(void)unused;
	for (size_t i = 0; i < sizeof(want) / sizeof(want[0]); i++) {
		struct fixture f;

		read_export(&f, want[i][0]);
		if (!strstr(f.dump, want[i][1]))
			fail_msg("%s: '%s' was expected in\n%s", want[i][0], want[i][1], f.dump);
		assert_string_equal(f.messages, "");
		fixture_release(&f);
	}
}

/* What is used and cannot be rendered: its place and name; with --lenient a warning, and the rest. */
static void test_unsupported(void **unused)
{
	static const char *const row[][2] = {
		{ "julia_fractal { <1,0,0,0> }", "1:1: error: julia_fractal is" },
		{ "prism { 0, 1, 4, <0,0>, <1,1>, <1,0>, <0,0> pigment { uv_mapping checker rgb 0 rgb 1 } }",
		  "1:1: error: uv_mapping of a prism is" },
		{ "lathe { linear_spline 2, <0,0>, <1,1> pigment { uv_mapping checker rgb 0 rgb 1 } }",
		  "1:1: error: uv_mapping of a lathe is" },
		{ "text { ttf \"a.ttf\" \"Hi\" 1, 0 }", "1:1: error: text is" },
		{ "sphere { 0, 1\n pigment { pavement } }", "2:12: error: pavement in a pigment is" },
		{ "#declare P = pigment { pavement }\nsphere { 0, 1 pigment { P } }",
		  "1:24: error: pavement in a" },
		{ "sphere { 0, 1\n texture { pavement texture_map { [0 pigment { rgb 1 }] } } }",
		  "2:12: error: pavement in a" },
		{ "rainbow { angle 1 width 1 direction x color_map { [0 rgb 1] } jitter 0.1 }",
		  "1:63: error: jitter of a rainbow is" },
		{ "sphere { 0, 1 clipped_by { bounded_by } }", "1:28: error: clipped_by { bounded_by } is" },
		{ "difference { sphere { 0, 1 } box { 0, 1 } cutaway_textures }",
		  "1:43: error: cutaway_textures is" },
		{ "#declare A = light_group { sphere { 0, 1 } }\nlight_group { A }",
		  "1:14: error: a light_group in another, used by name, is" },
		{ "sphere { 0, 1 finish { ior 1.3 } }", "1:24: error: ior in a finish is" },
		{ "global_settings { photons { count 10 } } sphere { 0, 1 photons { target } }",
		  "1:19: error: photons is" },
		{ "camera { mesh_camera { 1 0 } }", "1:10: error: mesh_camera is" },
		{ "camera { fisheye normal { bumps 1 } }", "error: a normal in this kind of camera is" },
	};

	(void)unused;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++) {
		struct fixture f;

		fixture_read(&f, row[i][0], false);
		if (f.status != STATUS_SCENE || !strstr(f.messages, row[i][1]) || f.diag.errors != 1)
			fail_msg("%s gave %d\n%s, not\n%s", row[i][0], f.status, f.messages, row[i][1]);
		fixture_release(&f);
		fixture_read(&f, row[i][0], true);
		if (f.status || f.diag.warnings != 1)
			fail_msg("%s leniently gave %d\n%s", row[i][0], f.status, f.messages);
		fixture_release(&f);
	}
}

static void test_errors(void **unused)
{
	static const char *const row[][2] = {
		{ "sphere { 0,\n -1 }", "2:2: error: the sphere's radius is -1, but cannot be negative\n" },
		{ "sphere { 0, 1e308*10 }", "1:13: error: " },
		{ "cylinder { y, y, 1 }", "1:1: error: the cylinder has both its ends at one point\n" },
		{ "lathe { linear_spline 3, <-1,0>, <-1,1>, <-1,2> }",
		  "1:34: error: the lathe's point lies at radius -1; only its first and last one" },
		{ "height_field { function 1, 8 { x } }",
		  "1:25: error: a height_field needs at least 2 x 2 points, not 1 x 8" },
		{ "height_field { function 60000, 60000 { x } }",
		  "a height_field of 60000 x 60000 points is too large; the limit is 67108864 points" },
		{ "difference { box { 0, 1 } union { height_field { function 9, 9 { x } water_level .5 } } }",
		  "1:35: error: a height_field with water_level as a part of a solid is not supported yet" },
		{ "sphere { 0, 1 clipped_by { height_field { function 9, 9 { x } water_level .5 } } }",
		  "1:28: error: a height_field with water_level as a part of a solid is not supported yet" },
		{ "quadric { 0, 0, 0, 1 }", "all coefficients of x, y and z are 0, which is no surface" },
		{ "poly { 36, <0> }", "" },
		{ "polynomial { 2, xyz(1, 1, 1): 3 }",
		  "error: the powers 1, 1 and 1 are more than the degree 2 together" },
		{ "cubic { <1, 2, 3> }", "" },
		{ "isosurface { max_gradient 1 }", "1:14: error: expected function at the beginning of an isosurface" },
		{ "isosurface { function { x } accuracy 0 }", "1:38: error: accuracy is 0, but has to be more than 0" },
		{ "isosurface { function { x } contained_by { box { 0, x } } }",
		  "error: the isosurface's container has no room in it\n" },
		{ "isosurface { function { x } contained_by { plane { x, 1 } } }",
		  "1:44: error: contained_by takes a box or a sphere, not plane\n" },
		{ "plane { 0, 1 }", "1:9: error: the plane's normal has no direction\n" },
		{ "disc { 0, 0, 1 }", "1:11: error: the disc's normal has no direction\n" },
		{ "object { }", "1:10: error: an object is expected in object { ... }, not }\n" },
		{ "sphere { 0, 1 pigmnt { } }", "1:15: error: the undeclared identifier pigmnt is not expected" },
		{ "sphere { 0, 1 texture { T } }", "1:25: error: the undeclared identifier T is not expected" },
		{ "sphere { 0, 1 pigment { rgb 1 }", "error: the file ends inside sphere { ... }: a } is" },
		{ "camera { angle 180 }", "1:16: error: angle is 180, but has to be below 180 degrees\n" },
		{ "sky_sphere { emission 2 }", "1:1: error: sky_sphere needs a pigment\n" },
		{ "rainbow { angle 9 width 9 }", "1:1: error: the rainbow's direction is missing" },
		{ "rainbow { direction y }", "1:1: error: the rainbow's up points along its direction\n" },
		{ "rainbow { direction x width -1 }", "1:1: error: the rainbow's width is negative\n" },
		{ "fog { distance -1 }", "1:1: error: the fog's distance is -1, but cannot be negative\n" },
		{ "fog { distance 1 fog_type 2 }", "1:1: error: ground fog needs fog_alt" },
		{ "fog { distance 1 fog_type 3 }", "1:27: error: fog_type is 3, but has to be 1" },
		{ "fog { distance 1 up 0 }", "1:1: error: the fog's up has no direction\n" },
		{ "camera { cylinder 5 }", "1:19: error: cylinder cameras are of type 1 to 4, not 5" },
		{ "camera { angle -1 }", "1:16: error: angle is -1, but cannot be negative\n" },
		{ "camera { location 1 look_at 1 }", "1:29: error: look_at is the camera's location" },
		{ "camera { right x up x }", "1:1: error: the camera's right, up and direction lie in one" },
		{ "light_group { sphere { 0, 1 } hollow }", "1:31: error: hollow is not expected in light_group" },
		{ "light_source { 0, 1 projected_through { sphere { 0, 1 } }\nprojected_through { sphere { 0, 1 } } }",
		  "2:1: error: a light can be projected_through one object only" },
		{ "light_source { 0, 1 projected_through { 3 } }", "1:41: error: projected_through needs an object" },
		{ "light_source { 0, 1 point_at y }", "1:21: error: point_at is for a spotlight" },
		{ "light_source { 0, 1 radius 3 }", "1:21: error: radius is for a spotlight" },
		{ "light_source { y, 1 spotlight point_at y }", "1:1: error: the light's point_at is its" },
		{ "light_source { y, 1 area_light x, z, 1, 4 circular }", "error: a circular area_light needs" },
		{ "light_source { y, 1 area_light x, z, 0, 4 }", "1:38: error: 0 points along" },
		{ "sphere { 0, 1 finish { roughness -1 } }", "1:34: error: roughness is -1" },
		{ "sphere { 0, 1 finish { reflection { 1 exponent 0 } } }", "1:48: error: reflection's exponent" },
		{ "global_settings { assumed_gamma 0 }", "1:33: error: assumed_gamma is 0" },
		{ "sphere { 0, 1 scale <1e200,1,1> scale <1e200,1,1> }", "error: the object's transforms have no" },
		{ "sphere { 0, 1 interior { ior -1 } }", "1:30: error: ior is -1" },
		{ "sphere { 0, 1 interior { dispersion 0 } }", "1:37: error: dispersion is 0" },
		{ "sphere { 0, 1 interior { dispersion_samples 1 } }",
		  "1:45: error: dispersion_samples is 1, but has to be from 2 to 1000\n" },
		{ "pigment { rgb 1 }", "1:1: error: pigment cannot stand here" },
		{ "#declare A = location;", "1:14: error: location cannot be declared\n" },
		{ "#default { texture { pigment { rgb 1 } } texture { } finish { ambient 1 } } #declare "
		  "T = texture { } texture { } #default { texture { T } }", "error: #default takes no layered" },
		{ "#declare A = sphere { 0, 1 } #declare I = 0; #while (I < 40) #declare A = union { object { A } "
		  "object { A } } #declare I = I + 1; #end object { A }", "error: too many objects: the limit is" },
		{ "#declare A = sphere { 0, 1 } #declare I = 0; #while (I < 2000) #declare A = union { object { A } "
		  "} #declare I = I + 1; #end object { A }", "error: unions stand in unions more than 1000 deep" },
	};

	(void)unused;
	for (size_t i = 0; i < sizeof(row) / sizeof(row[0]); i++) {
		struct fixture f;

		fixture_read(&f, row[i][0], false);
		if (f.status != STATUS_SCENE || !strstr(f.messages, row[i][1]) || f.diag.errors != 1)
			fail_msg("%s gave %d\n%s, not\n%s", row[i][0], f.status, f.messages, row[i][1]);
		fixture_release(&f);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_camera_angles),
		cmocka_unit_test(test_focal_blur),
		cmocka_unit_test(test_cameras),	 cmocka_unit_test(test_lights),
		cmocka_unit_test(test_finishes), cmocka_unit_test(test_textures),
		cmocka_unit_test(test_defaults), cmocka_unit_test(test_objects),
		cmocka_unit_test(test_unions),	 cmocka_unit_test(test_settings),
		cmocka_unit_test(test_exports),	 cmocka_unit_test(test_unsupported),
		cmocka_unit_test(test_errors),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
