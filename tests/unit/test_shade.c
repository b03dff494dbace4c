/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Lights, finishes, interiors and the folding of ray trees, each against numbers worked out by hand from
 * the formulas of POV-Ray's manual. Whole pictures are compared in tests/features.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "render/fold.h"
#include "shade/camera.h"
#include "shade/light.h"
#include "shade/pov/finish.h"
#include "shade/pov/interior.h"
#include "shade/pov/spectrum.h"

#define NEAR(a, b) assert_true(fabs((a) - (b)) < 1e-12)

static void camera_looks_through_pixel_centres(void **state)
{
	struct camera c = { .kind = CAMERA_PERSPECTIVE,
			    .location = { 1, 2, 3 },
			    .direction = { 0, 0, 2 },
			    .right = { 4, 0, 0 },
			    .up = { 0, 3, 0 } };
	vec org, dir;

	(void)state;
	assert_true(camera_ray(&c, 40, 30, 80, 60, &org, &dir));
	NEAR(dir.x, 0);
	NEAR(dir.y, 0);
	NEAR(dir.z, 1);
	assert_true(camera_ray(&c, 0, 0, 80, 60, &org, &dir)); /* top left: -right/2 + up/2 */
	NEAR(dir.x / dir.z, -1);
	NEAR(dir.y / dir.z, 0.75);
	c.kind = CAMERA_ORTHOGRAPHIC;
	assert_true(camera_ray(&c, 80, 60, 80, 60, &org, &dir));
	NEAR(org.x, 3);
	NEAR(org.y, 0.5);
	NEAR(dir.z, 1);
	c.direction.z = 0;
	assert_false(camera_ray(&c, 80, 60, 80, 60, &org, &dir));
}

static void fading_doubles_up_close(void **state)
{
	struct light l = { .kind = LIGHT_POINT, .fade_distance = 2, .fade_power = 2 };
	vec p = { 0, 0, 4 };
	struct light_ray r = light_towards(&l, p, vec_make(0, 0, 0));

	(void)state;
	NEAR(r.depth, 4);
	NEAR(r.dir.z, -1);
	NEAR(light_attenuation(&l, p, &r), 2.0 / 5); /* 2 / (1 + (4/2)^2) */
	l.fade_power = 0;
	NEAR(light_attenuation(&l, p, &r), 1);
}

static void spot_falls_off_smoothly(void **state)
{
	struct light l = { .kind = LIGHT_SPOT, .direction = { 0, -1, 0 }, .radius = 0, .falloff = 60,
			   .axis_length = 1 };
	vec p = { sqrt(1 - 0.75 * 0.75), -0.75, 0 }; /* cos = .75, halfway between .5 and 1 */
	struct light_ray r = light_towards(&l, p, vec_make(0, 0, 0));

	(void)state;
	NEAR(light_attenuation(&l, p, &r), 0.5);
	l.tightness = 2;
	NEAR(light_attenuation(&l, p, &r), 0.5 * 0.75 * 0.75);
	l.falloff = 40; /* cos .766: outside */
	NEAR(light_attenuation(&l, p, &r), 0);
	l.tightness = 0; /* a cone that ends before it starts to fade is all on or all off */
	l.falloff = 41;
	l.radius = 42; /* cos .743 */
	NEAR(light_attenuation(&l, p, &r), 1);
}

static void parallel_light_measures_to_its_plane(void **state)
{
	struct light l = { .kind = LIGHT_POINT, .parallel = true, .location = { 0, 5, 0 },
			   .direction = { 0, -1, 0 }, .axis_length = 5 };
	struct light_ray r = light_towards(&l, vec_make(3, 1, 0), vec_make(0, 0, 0));

	(void)state;
	NEAR(r.dir.y, 1);
	NEAR(r.depth, 4);
}

static void area_grid_spans_its_axes(void **state)
{
	struct light l = { .area = true, .size1 = 5, .size2 = 1, .axis1 = { 2, 0, 0 },
			   .axis2 = { 0, 0, 2 } };
	vec a, b, p;

	(void)state;
	light_axes(&l, vec_make(0, -3, 0), &a, &b);
	p = light_grid_point(&l, a, b, 0, 0, 1, 0);
	NEAR(p.x, -1);
	NEAR(p.z, 0);
	p = light_grid_point(&l, a, b, 4, 0, 1, 0);
	NEAR(p.x, 1);
	l.jitter = true;
	p = light_grid_point(&l, a, b, 2, 0, 1, 0);
	assert_true(fabs(p.x) <= 0.25 && p.x != 0);
	assert_true(p.x == light_grid_point(&l, a, b, 2, 0, 1, 0).x);
	assert_true(p.x != light_grid_point(&l, a, b, 2, 0, 2, 0).x);
}

static void finish_follows_the_manual(void **state)
{
	struct finish f = finish_default();
	struct finish_light l = { .to_light = { 0, 0.6, 0.8 }, .eye = { 0, 0, -1 }, .normal = { 0, 0, 1 },
				  .light = { 1, 0.5, 2 }, .pigment = { 0.2, 0.4, 0.6 }, .opacity = 0.5,
				  .highlights = true };
	struct rgb c;

	(void)state;
	c = finish_shade(&f, &l);
	NEAR(c.r, 0.8 * 0.6 * 0.5 * 0.2);
	NEAR(c.g, 0.8 * 0.6 * 0.5 * 0.4 * 0.5);
	f.brilliance = 2;
	NEAR(finish_shade(&f, &l).b, 0.64 * 0.6 * 0.5 * 0.6 * 2);
	l.behind = true;
	NEAR(finish_shade(&f, &l).r, 0);
	f.diffuse_back = 0.25;
	NEAR(finish_shade(&f, &l).r, 0.64 * 0.25 * 0.5 * 0.2);
	l.behind = false;
	f.diffuse = 0;
	f.phong = 0.5;
	f.phong_size = 3;
	NEAR(finish_shade(&f, &l).r, 0.5 * 0.8 * 0.8 * 0.8); /* no opacity, no pigment */
	f.phong = 0;
	f.specular = 0.5;
	f.roughness = 0.25;
	NEAR(finish_shade(&f, &l).g, 0.5 * 0.5 * pow(1.8 / sqrt(0.36 + 1.8 * 1.8), 4));
	l.highlights = false;
	NEAR(finish_shade(&f, &l).g, 0);
}

static void mirrors_depend_on_the_angle(void **state)
{
	struct finish f = finish_default();
	struct rgb white = { 1, 1, 1 }, r;
	double n = 1.5, edge = (n - 1) / (n + 1);

	(void)state;
	assert_false(finish_is_mirror(&f));
	f.reflection_min = rgb_make(0.2, 0, 0);
	f.reflection_max = rgb_make(1, 0.5, 0);
	f.reflection_falloff = 2;
	r = finish_reflectivity(&f, 0.5, 1, white);
	NEAR(r.r, 0.25 * 1 + 0.75 * 0.2);
	NEAR(r.g, 0.25 * 0.5);
	f.reflection_fresnel = true;
	f.reflection_min = rgb_make(0, 0, 0);
	f.reflection_max = white;
	NEAR(finish_reflectivity(&f, 1, n, white).r, edge * edge);
	NEAR(finish_reflectivity(&f, 0, n, white).r, 1);
	NEAR(finish_reflectivity(&f, 0.5, 1 / n, white).r, 1); /* past the critical angle */
	NEAR(finish_reflectivity(&f, 0.7, 1, white).r, 0); /* same medium */
}

static double cross(const struct scene *s, struct tree *t, uint32_t *list, uint32_t object, uint32_t interior)
{
	struct met m = { .object = object, .interior = interior };

	return interior_cross(s, t, list, &m).ratio;
}

static void interiors_nest_and_overlap(void **state)
{
	struct mem_book book;
	struct scene s;
	struct tree t;
	uint32_t list = TREE_NONE, a, b;
	struct crossing c;

	(void)state;
	mem_book_init(&book, 0);
	scene_init(&s, &book);
	tree_init(&t, &book);
	a = scene_add_interior(&s);
	s.interior[a] = (struct interior){ .ior = 1.5, .dispersion = 1, .dispersion_samples = 7 };
	b = scene_add_interior(&s);
	s.interior[b] = (struct interior){ .ior = 2, .dispersion = 1.1, .dispersion_samples = 5 };

	NEAR(interior_relative_ior(&s, &t, list, 7, a), 1.5);
	NEAR(cross(&s, &t, &list, 7, a), 1 / 1.5); /* into 7 */
	NEAR(interior_relative_ior(&s, &t, list, 7, a), 1 / 1.5);
	NEAR(interior_relative_ior(&s, &t, list, 8, b), 2 / 1.5);
	NEAR(cross(&s, &t, &list, 8, b), 1.5 / 2); /* into 8, in 7 */
	NEAR(cross(&s, &t, &list, 7, a), 1); /* out of 7, still in 8 */
	assert_true(inside_contains(&t, list, 8));
	assert_false(inside_contains(&t, list, 7));
	c = interior_cross(&s, &t, &list, &(struct met){ .object = 8, .interior = b }); /* out */
	NEAR(c.ratio, 2);
	NEAR(c.dispersion, 1.1);
	assert_int_equal(c.bands, 5);
	assert_int_equal(list, TREE_NONE);

	s.interior[a].fade_distance = 2;
	s.interior[a].fade_power = 1;
	s.interior[a].fade_colour = rgb_make(0, 0.5, 1);
	NEAR(interior_fade(&s, a, 2).r, 0.5);
	NEAR(interior_fade(&s, a, 2).g, 0.75);
	NEAR(interior_fade(&s, a, 2).b, 1);
	s.interior[a].fade_power = 1001;
	NEAR(interior_fade(&s, a, 2).g, exp(-0.5));
	NEAR(interior_fade(&s, SCENE_NONE, 9).r, 1);
	tree_release(&t);
	scene_release(&s);
	assert_int_equal(book.now, 0);
}

static void bands_of_light_add_up(void **state)
{
	struct rgb all = spectrum_colour(0, 7, 7), sum = { 0, 0, 0 }, violet = spectrum_colour(0, 1, 5),
		   red = spectrum_colour(4, 5, 5), some;

	(void)state;
	for (uint32_t i = 0; i < 7; i++)
		sum = rgb_add(sum, spectrum_colour(i, i + 1, 7));
	NEAR(sum.r, all.r);
	NEAR(sum.g, 1);
	NEAR(sum.b, all.b);
	assert_true(violet.b > 4 * violet.r && red.r > 4 * red.g && red.b == 0);
	some = rgb_add(spectrum_colour(10, 12, 30), spectrum_colour(12, 20, 30));
	NEAR(some.g, spectrum_colour(1, 2, 3).g);
	NEAR(spectrum_ior(1.5, 1.2, spectrum_band(3, 7)), 1.5);
	NEAR(spectrum_ior(1.5, 1.2, 0) / spectrum_ior(1.5, 1.2, 1), 1.2);
	NEAR(spectrum_ior(1.5, 1.2, 0.3) * spectrum_ior(1 / 1.5, 1 / 1.2, 0.3), 1);
}

/* A root with one part; a refracted child seen through a filter, a mirrored one with an exponent. */
static void trees_fold_bottom_up(void **state)
{
	const struct scene scene = { .version = 370 };
	const struct shader shader = { .scene = &scene };
	struct mem_book book;
	struct tree t;
	struct node *n;

	(void)state;
	mem_book_init(&book, 0);
	tree_init(&t, &book);
	assert_int_equal(tree_push(&t, &t.node, 3), 0);
	assert_int_equal(tree_push(&t, &t.part, 1), 0);
	assert_int_equal(tree_push(&t, &t.mirror, 1), 0);
	n = t.node.data;
	n[0] = (struct node){ .part_count = 1 };
	n[1] = (struct node){ .colour = { 1, 2, 4 }, .transmit = 0.5 };
	n[2] = (struct node){ .colour = { 0.25, 0.25, 0.25 } };
	*BUF_AT(&t.part, struct part, 0) = (struct part){ .share = 0.5, .own = { 0.1, 0.2, 0.3 },
		.filter = { 0.5, 0.5, 0.25 }, .fade = { 1, 0.5, 1 }, .clear = 0.5, .through = 1,
		.mirror_count = 1 };
	*BUF_AT(&t.mirror, struct mirror, 0) = (struct mirror){ .reflectivity = { 0.8, 0, 0 },
		.exponent = 0.5, .child = 2 };
	fold_nodes(&shader, &t, 0, 1);
	NEAR(n[0].colour.r, 0.5 * (0.1 + 0.5 * 1 + 0.8 * 0.5));
	NEAR(n[0].colour.g, 0.5 * (0.2 + 0.5 * 0.5 * 2));
	NEAR(n[0].colour.b, 0.5 * (0.3 + 0.25 * 4));
	NEAR(n[0].transmit, 0.5 * (0.297 + 0.589 * 0.5 + 0.114) * 0.5 * 0.5);

	BUF_AT(&t.part, struct part, 0)->total = true; /* not filtered, and hides the background */
	n[0].colour = rgb_make(0, 0, 0);
	n[0].transmit = 0;
	fold_nodes(&shader, &t, 0, 1);
	NEAR(n[0].colour.b, 0.5 * (0.3 + 4));
	NEAR(n[0].transmit, 0);

	/* two bands, the first of them totally reflected: its node stands last */
	*BUF_AT(&t.part, struct part, 0) = (struct part){ .share = 1, .filter = { 1, 1, 1 }, .fade = { 1, 1, 1 },
		.clear = 1, .through = 1, .bands = 2, .total_to = 1 };
	n[0].colour = rgb_make(0, 0, 0);
	fold_nodes(&shader, &t, 0, 1);
	NEAR(n[0].colour.r, spectrum_colour(1, 2, 2).r * 1 + spectrum_colour(0, 1, 2).r * 0.25);
	NEAR(n[0].transmit, 0);
	tree_release(&t);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(camera_looks_through_pixel_centres),
		cmocka_unit_test(fading_doubles_up_close),
		cmocka_unit_test(spot_falls_off_smoothly),
		cmocka_unit_test(parallel_light_measures_to_its_plane),
		cmocka_unit_test(area_grid_spans_its_axes),
		cmocka_unit_test(finish_follows_the_manual),
		cmocka_unit_test(mirrors_depend_on_the_angle),
		cmocka_unit_test(interiors_nest_and_overlap),
		cmocka_unit_test(bands_of_light_add_up),
		cmocka_unit_test(trees_fold_bottom_up),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
