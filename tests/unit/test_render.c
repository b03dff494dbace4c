/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Whole pictures of a small scene: a crop equals the same part of the whole; tile side and threads change no
 * byte; stopping leaves whole tiles; what is not finite is counted and found.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "render/foresee.h"
#include "render/render.h"

#define WIDTH 70
#define HEIGHT 50

struct stage {
	struct mem_book book;
	struct diag diag;
	struct scene scene;
	struct geometry *geometry;
};

static uint32_t add_texture(struct scene *s, struct rgbft colour, double mirror)
{
	uint32_t t = scene_add_texture(s, 1);

	s->texture[t].layer[0].pigment.colour = colour;
	s->texture[t].layer[0].finish = finish_default();
	s->texture[t].layer[0].finish.reflection_min = rgb_make(mirror, mirror, mirror);
	s->texture[t].layer[0].finish.reflection_max = rgb_make(mirror, mirror, mirror);
	return t;
}

static void add_sphere(struct scene *s, vec centre, double radius, uint32_t texture, double ior)
{
	uint32_t o = scene_add_object(s), in = scene_add_interior(s);

	s->interior[in] = (struct interior){ .ior = ior, .dispersion = 1 };
	s->object[o].kind = SHAPE_SPHERE;
	s->object[o].shape.sphere.centre = centre;
	s->object[o].shape.sphere.radius = radius;
	s->object[o].texture = texture;
	s->object[o].interior = in;
	scene_add_root(s, o);
}

static void add_floor(struct scene *s, uint32_t texture)
{
	uint32_t o = scene_add_object(s);

	s->object[o].kind = SHAPE_PLANE;
	s->object[o].shape.plane.normal = vec_make(0, 1, 0);
	s->object[o].texture = texture;
	scene_add_root(s, o);
}

static void add_lamp(struct scene *s, vec at, bool area)
{
	uint32_t l = scene_add_light(s);

	s->light[l] = (struct light){ .location = at, .colour = { 0.8, 0.7, 0.6 }, .group = SCENE_NONE,
				      .area = area, .size1 = 5,
			     .size2 = 5, .axis1 = { 1, 0, 0 }, .axis2 = { 0, 0, 1 }, .adaptive = 1,
			     .jitter = area };
}

static int set_up(void **state)
{
	static struct stage st;
	struct scene *s = &st.scene;
	struct pool *pool = pool_new(1);

	memset(&st, 0, sizeof(st));
	mem_book_init(&st.book, 0);
	scene_init(s, &st.book);
	s->background = (struct rgbft){ 0.2, 0.3, 0.5, 0, 0 };
	s->camera = (struct camera){ .location = { 0, 1.5, -5 }, .direction = { 0, -0.1, 1 },
				     .right = { 1.4, 0, 0 }, .up = { 0, 1, 0 } };
	add_sphere(s, vec_make(-1.1, 1, 0), 0.9, add_texture(s, (struct rgbft){ 1, 0.9, 0.8, 0.9, 0 }, 0.1), 1.5);
	add_sphere(s, vec_make(1.1, 1, 0), 0.9, add_texture(s, (struct rgbft){ 0.8, 0.2, 0.1, 0, 0 }, 0.5), 1);
	add_floor(s, add_texture(s, (struct rgbft){ 0.7, 0.7, 0.6, 0, 0 }, 0));
	add_lamp(s, vec_make(3, 6, -4), true);
	add_lamp(s, vec_make(-3, 2, -4), false);
	assert_int_equal(geometry_build(&st.geometry, s, NULL, pool, &st.book, false, &st.diag), 0);
	pool_free(pool);
	*state = &st;
	return 0;
}

static int tear_down(void **state)
{
	struct stage *st = *state;

	geometry_free(st->geometry);
	scene_release(&st->scene);
	return st->book.now != 0; /* nothing leaks */
}

static enum status render(struct stage *st, const struct render_options *o, uint32_t threads,
			  struct image *out, struct render_counts *counts)
{
	struct pool *pool = pool_new(threads);
	struct geometry *g;
	struct render_options whole = *o;
	enum status status;

	/* The geometry keeps things for each thread of the pool that it was built with. */
	assert_int_equal(geometry_build(&g, &st->scene, NULL, pool, &st->book, false, &st->diag), 0);
	whole.width = WIDTH;
	whole.height = HEIGHT;
	status = render_scene(&st->scene, g, &whole, pool, &st->book, out, counts, &st->diag);
	geometry_free(g);
	pool_free(pool);
	return status;
}

static void assert_same(const struct image *a, const struct image *b, uint32_t x, uint32_t y)
{
	for (uint32_t row = 0; row < b->height; row++)
		assert_memory_equal(a->pixel + ((size_t)(row + y) * a->width + x) * 4,
				    b->pixel + (size_t)row * b->width * 4, b->width * 4 * sizeof(float));
}

static void nothing_but_the_scene_decides(void **state)
{
	const struct render_options way[] = {
		{ .aa = RENDER_AA_NONE },
		{ .aa = RENDER_AA_GRID, .aa_n = 3 },
		{ .aa = RENDER_AA_GRID, .aa_n = 17 },
		{ .aa = RENDER_AA_POV1, .aa_n = 3, .aa_threshold = 0.1 },
		{ .aa = RENDER_AA_POV2, .aa_n = 3, .aa_threshold = 0.1 },
		{ .spp = 21 },
		{ .budget = true, .noise = 0.1 },
		{ .budget = true, .spp = 11 },
	};
	struct stage *st = *state;

	for (size_t i = 0; i < sizeof(way) / sizeof(way[0]); i++) {
		struct render_options o = way[i];
		struct render_counts counts;
		struct image whole, other;

		assert_int_equal(render(st, &o, 1, &whole, &counts), 0);
		assert_int_equal(counts.pixels, WIDTH * HEIGHT);
		assert_true(counts.cast[RENDER_SHADOW] > 0 && counts.cast[RENDER_REFRACTED] > 0);
		o.tile = 7;
		assert_int_equal(render(st, &o, 3, &other, &counts), 0);
		assert_same(&whole, &other, 0, 0);
		image_release(&other);
		o.tile = 0;
		o.crop_x = 11, o.crop_y = 5, o.crop_width = 40, o.crop_height = 33;
		assert_int_equal(render(st, &o, 2, &other, &counts), 0);
		assert_int_equal(other.width, 40);
		assert_same(&whole, &other, 11, 5);
		image_release(&other);
		image_release(&whole);
	}
}

/* A guess: within a factor of three, and exact where nothing is to be guessed. */
static void rays_are_foreseen(void **state)
{
	const struct render_options way[] = {
		{ .aa = RENDER_AA_NONE },
		{ .aa = RENDER_AA_GRID, .aa_n = 3 },
		{ .aa = RENDER_AA_POV1, .aa_n = 3, .aa_threshold = 0.1 },
		{ .aa = RENDER_AA_POV2, .aa_n = 2, .aa_threshold = 0.1 },
		{ .spp = 8 },
		{ .aa = RENDER_AA_GRID, .aa_n = 2, .camera_only = true },
		{ .crop_x = 10, .crop_y = 10, .crop_width = 50, .crop_height = 30 },
	};
	struct stage *st = *state;

	for (size_t i = 0; i < sizeof(way) / sizeof(way[0]); i++) {
		struct render_options o = way[i];
		struct render_counts counts;
		struct image out;
		double foreseen, cast = 0;

		assert_int_equal(render(st, &o, 1, &out, &counts), 0);
		image_release(&out);
		for (unsigned k = 0; k < RENDER_RAY_KINDS; k++)
			cast += (double)counts.cast[k];
		o.width = WIDTH;
		o.height = HEIGHT;
		foreseen = render_foresee(&st->scene, &o);
		if (foreseen > 3 * cast || cast > 3 * foreseen || (o.camera_only && foreseen < cast) ||
		    (o.camera_only && foreseen > cast))
			fail_msg("way %zu: %g rays are foreseen, %g are cast", i, foreseen, cast);
	}
}

static void adaptive_methods_refine_edges(void **state)
{
	struct render_options o = { .aa = RENDER_AA_POV2, .aa_n = 1, .aa_threshold = 0.03 };
	struct render_counts corners, finer;
	struct stage *st = *state;
	struct image a, b;

	assert_int_equal(render(st, &o, 1, &a, &corners), 0);
	assert_int_equal(corners.samples, (uint64_t)(WIDTH + 1) * (HEIGHT + 1) +
		/* shared corners are traced again by the neighbouring tile */
		(uint64_t)2 * (HEIGHT + 1) + (uint64_t)1 * (WIDTH + 1) + 2);
	o.aa_n = 3;
	assert_int_equal(render(st, &o, 1, &b, &finer), 0);
	assert_true(finer.samples > corners.samples + 500);
	assert_true(finer.samples < corners.samples + (uint64_t)64 * WIDTH * HEIGHT / 2);
	image_release(&a);
	image_release(&b);
}

/* A lamp in the middle of a tilted disc lights both sides as if the disc were not there. */
static void a_surface_does_not_hide_its_own_lamp(void **state)
{
	struct render_options o = { .aa = RENDER_AA_NONE };
	struct render_counts counts;
	struct stage *st = *state;
	struct scene *s = &st->scene;
	uint32_t disc = scene_add_object(s);
	struct image with, without;

	s->object[disc].kind = SHAPE_DISC;
	s->object[disc].shape.disc.centre = s->light[1].location;
	s->object[disc].shape.disc.normal = vec_unit(vec_make(0.03, 1, -0.04));
	s->object[disc].shape.disc.radius = 0.4;
	s->object[disc].texture = 1; /* opaque */
	s->object[s->last_root].next_sibling = disc;
	s->light[0].shadowless = true; /* that one does cast the disc's shadow */
	s->object[disc].flags = 0;
	assert_int_equal(render(st, &o, 1, &with, &counts), 0);
	s->object[disc].flags = OBJECT_NO_SHADOW;
	assert_int_equal(render(st, &o, 1, &without, &counts), 0);
	assert_same(&without, &with, 0, 0);
	image_release(&with);
	image_release(&without);
	s->light[0].shadowless = false;
	s->object[s->last_root].next_sibling = SCENE_NONE;
	s->object_count--;
}

/* Glass that mirrors doubles its rays at each surface: what is held must not grow with them. */
static void memory_grows_with_depth_only(void **state)
{
	struct render_options o = { .crop_x = 22, .crop_y = 22, .crop_width = 6, .crop_height = 6 };
	struct render_counts counts;
	struct stage *st = *state;
	struct scene *s = &st->scene;
	struct mem_account *account = mem_account_get(&st->book, "render");
	struct texture keep = s->texture[0];
	struct layer glass = keep.layer[0];
	uint32_t last = s->last_root, objects = s->object_count;
	struct image out;

	for (int i = 1; i < 5; i++) /* shells within the first sphere */
		add_sphere(s, vec_make(-1.1, 1, 0), 0.9 - 0.15 * i, 0, 1.5 - 0.1 * i);

	glass.pigment.colour = (struct rgbft){ 1, 1, 1, 0, 1 };
	glass.finish.reflection_min = glass.finish.reflection_max = rgb_make(1, 1, 1);
	s->texture[0].layer = &glass;
	s->max_trace_level = 17;
	s->light_count = 0;
	atomic_store(&account->peak, 0);
	assert_int_equal(render(st, &o, 1, &out, &counts), 0);
	assert_true(counts.cast[RENDER_REFLECTED] > 200000);
	assert_true(atomic_load(&account->peak) < 32 * 1024 * 1024);
	image_release(&out);
	s->texture[0] = keep;
	s->max_trace_level = 5;
	s->light_count = 2;
	s->object[last].next_sibling = SCENE_NONE;
	s->last_root = last;
	s->object_count = objects;
}

static void note_done(void *arg, uint64_t done, uint64_t total)
{
	(void)total;
	*(uint64_t *)arg = done;
}

static bool stop_soon(void *arg)
{
	return *(uint64_t *)arg >= 200;
}

static void stopping_keeps_what_is_done(void **state)
{
	uint64_t done = 0;
	struct render_options o = { .tile = 10, .stop = stop_soon, .progress = note_done, .arg = &done };
	struct render_counts counts;
	struct image whole, part;
	struct stage *st = *state;

	assert_int_equal(render(st, &o, 1, &part, &counts), STATUS_SIGINT);
	assert_int_equal(counts.pixels, 200);
	o.stop = NULL;
	assert_int_equal(render(st, &o, 1, &whole, &counts), 0);
	assert_memory_equal(whole.pixel, part.pixel, 20 * 4 * sizeof(float)); /* two tiles' first row */
	assert_true(part.pixel[20 * 4 + 3] == 0);
	image_release(&whole);
	image_release(&part);
}

static void nan_is_never_stored(void **state)
{
	struct render_options o = { .aa = RENDER_AA_NONE };
	struct render_counts counts;
	struct stage *st = *state;
	struct image out;
	struct rgb keep = st->scene.light[1].colour;

	st->scene.light[1].colour.g = (double)NAN;
	assert_int_equal(render(st, &o, 2, &out, &counts), STATUS_NONFINITE);
	assert_true(counts.nonfinite > 100);
	assert_int_equal(image_nonfinite(&out), 0);
	for (uint32_t i = 0; i < counts.nonfinite_y * WIDTH + counts.nonfinite_x; i++)
		assert_true(out.pixel[i * 4 + 3] == 1);
	image_release(&out);
	st->scene.light[1].colour = keep;
}

static void options_are_checked(void **state)
{
	struct render_options o = { .crop_x = 60, .crop_width = 20, .crop_height = 2 };
	struct render_counts counts;
	struct stage *st = *state;
	struct image out;

	assert_int_equal(render(st, &o, 1, &out, &counts), STATUS_USAGE);
	o = (struct render_options){ .aa = RENDER_AA_GRID };
	assert_int_equal(render(st, &o, 1, &out, &counts), STATUS_USAGE);
	o = (struct render_options){ .tile = 100000 };
	assert_int_equal(render(st, &o, 1, &out, &counts), STATUS_USAGE);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(nothing_but_the_scene_decides),
		cmocka_unit_test(rays_are_foreseen), cmocka_unit_test(adaptive_methods_refine_edges),
		cmocka_unit_test(a_surface_does_not_hide_its_own_lamp),
		cmocka_unit_test(memory_grows_with_depth_only),
		cmocka_unit_test(stopping_keeps_what_is_done),
		cmocka_unit_test(nan_is_never_stored),
		cmocka_unit_test(options_are_checked),
	};

	return cmocka_run_group_tests(tests, set_up, tear_down);
}
