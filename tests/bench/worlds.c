/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 *	torus		3,072 triangles, the lecture's
 *	statue100k	a bumpy ball of 100,352 on a stage of 12 large ones; statue1m: 1,048,352
 *	suzanne		Blender's monkey, refined by Loop's rule (Smooth Subdivision Surfaces Based on Triangles,
 *			1987) to 990,208, on the stage
 *	soup		500,000, not joined, of sizes from 0 to 6 % of the whole, needles and lines among them
 *	terrain		a fractal height field of 999,698; terrain10m: 9,999,392; terrainN: of 2 N N
 *	forest		10,000 instances of a tree of 10,000
 *	beams		20,000 thin boxes, turned any way, in a room: 240,012; hall: about five times as long
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "directions.h"
#include "forest.h"
#include "suzanne.h"
#include "worlds.h"

const char *const kind_name[KINDS] = { "camera", "shadow", "bounce", "shuffled", "ao" };
const uint32_t kind_hints[KINDS] = { ALD_COHERENT | ALD_ONE_ORIGIN, ALD_COHERENT, 0, 0, 0 };
const char worlds_usual[] = "torus,statue100k,suzanne,soup,terrain,forest,hall";
const char worlds_all[] = "torus,statue100k,suzanne,soup,terrain,terrain10m,forest,beams,hall";

/* ---- meshes ---- */

static void add_box(struct mesh *m, const ald_vec *c, ald_vec axis[3])
{
	static const uint8_t side[12][3] = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 },
					     { 0, 1, 4 }, { 1, 5, 4 }, { 2, 6, 3 }, { 3, 6, 7 },
					     { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
	uint32_t first = m->vertices;

	for (unsigned i = 0; i < 8; i++) {
		double s[3] = { i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1 };

		mesh_vertex(m, c->x + s[0] * axis[0].x + s[1] * axis[1].x + s[2] * axis[2].x,
			    c->y + s[0] * axis[0].y + s[1] * axis[1].y + s[2] * axis[2].y,
			    c->z + s[0] * axis[0].z + s[1] * axis[1].z + s[2] * axis[2].z);
	}
	for (unsigned i = 0; i < 12; i++)
		mesh_triangle(m, first + side[i][0], first + side[i][1], first + side[i][2]);
}

static void add_stage(struct mesh *m, double z)
{
	ald_vec stage[3] = { { 6, 0, 0 }, { 0, 6, 0 }, { 0, 0, 0.1 } }, below = { 0, 0, z };

	mesh_group(m);
	add_box(m, &below, stage);
}

static void add_beams(struct mesh *m, uint32_t n, double least, double more)
{
	uint64_t seed = 5;
	ald_vec room[3] = { { 1.2, 0, 0 }, { 0, 1.2, 0 }, { 0, 0, 1.2 } }, middle = { 0, 0, 0 };

	mesh_group(m);
	add_box(m, &middle, room);
	for (uint32_t i = 0; i < n; i++) {
		ald_vec c = { 2 * random_unit(&seed) - 1, 2 * random_unit(&seed) - 1,
			      2 * random_unit(&seed) - 1 };
		ald_vec x = any_way(&seed), y = unit(cross(x, any_way(&seed))), z = cross(x, y);
		ald_vec axis[3] = { times(x, least + more * random_unit(&seed)),
				    times(y, 0.001), times(z, 0.001) };

		add_box(m, &c, axis);
	}
}

static void add_statue(struct mesh *m, uint32_t n)
{
	uint32_t first;

	add_stage(m, -1.3);
	first = m->vertices;
	for (uint32_t i = 0; i <= n; i++) {
		for (uint32_t j = 0; j < n; j++) {
			double a = 6.283185307179586 * j / n, b = 3.141592653589793 * (i + 0.5) / (n + 1);
			double r = 1 + 0.1 * sin(5 * a) * sin(7 * b) + 0.03 * sin(31 * a + 3) * sin(23 * b) +
				   0.01 * sin(97 * a) * sin(83 * b + 1);

			mesh_vertex(m, r * cos(a) * sin(b), r * sin(a) * sin(b), r * cos(b));
		}
	}
	for (uint32_t i = 0; i < n; i++) {
		for (uint32_t j = 0; j < n; j++) {
			uint32_t k = (j + 1) % n, at = first + i * n;

			mesh_triangle(m, at + j, at + n + j, at + n + k);
			mesh_triangle(m, at + j, at + n + k, at + k);
		}
	}
}

/* Value noise, nine octaves, each half as high. */
static double height_noise(int64_t x, int64_t y, uint32_t octave)
{
	uint64_t s = (uint64_t)x * 0x9e3779b1u ^ (uint64_t)y * 0x85ebca77c2b2ae63u ^ octave;

	return 2 * random_unit(&s) - 1;
}

static double height(double x, double y)
{
	double z = 0, size = 0.25;

	for (uint32_t k = 0; k < 9; k++, size *= 0.5) {
		double u = (0.8 * x - 0.6 * y) * (3 << k), v = (0.6 * x + 0.8 * y) * (3 << k);
		int64_t i = (int64_t)floor(u), j = (int64_t)floor(v);
		double a = u - (double)i, b = v - (double)j;

		a *= a * (3 - 2 * a);
		b *= b * (3 - 2 * b);
		z += size * ((1 - b) * ((1 - a) * height_noise(i, j, k) + a * height_noise(i + 1, j, k)) +
			     b * ((1 - a) * height_noise(i, j + 1, k) + a * height_noise(i + 1, j + 1, k)));
	}
	return z;
}

static void add_terrain(struct mesh *m, uint32_t n)
{
	mesh_group(m);
	for (uint32_t i = 0; i <= n; i++) {
		for (uint32_t j = 0; j <= n; j++) {
			double x = (double)i / n, y = (double)j / n;

			mesh_vertex(m, 10 * x - 5, 10 * y - 5, 5 * height(x, y));
		}
	}
	for (uint32_t i = 0; i < n; i++) {
		for (uint32_t j = 0; j < n; j++) {
			uint32_t a = i * (n + 1) + j, b = a + n + 1;

			mesh_triangle(m, a, b, b + 1);
			mesh_triangle(m, a, b + 1, a + 1);
		}
	}
}

static void add_suzanne(struct mesh *m)
{
	struct surf s;
	uint32_t first;

	add_stage(m, -1.1);
	surf_suzanne(&s, 5);
	first = m->vertices;
	for (uint32_t i = 0; i < s.vertices; i++)
		mesh_vertex(m, s.v[i][0], s.v[i][1], s.v[i][2]);
	for (uint32_t i = 0; i < s.triangles; i++)
		mesh_triangle(m, first + s.t[i][0], first + s.t[i][1], first + s.t[i][2]);
	free(s.v);
	free(s.t);
}

static bool add_named(struct world *w, const char *name)
{
	struct mesh *m = &w->mesh;
	uint32_t n;

	if (!strcmp(name, "torus")) {
		mesh_torus(m, (ald_vec){ 0, 0, 0 }, 1, 0.25, 48, 32);
		w->eye = (ald_vec){ 2.5, -3, 3 };
		w->share = 4;
	} else if (!strcmp(name, "statue100k") || !strcmp(name, "statue1m")) {
		add_statue(m, name[7] == 'm' ? 724 : 224);
		w->eye = (ald_vec){ 2, -3, 1 };
	} else if (!strcmp(name, "suzanne")) {
		add_suzanne(m);
		w->eye = (ald_vec){ 1.5, -3, 1 };
	} else if (!strcmp(name, "soup")) {
		mesh_soup(m, 500000, 1, 0.06, 3);
		w->eye = (ald_vec){ 2.5, -3, 2 };
	} else if (!strcmp(name, "beams") || !strcmp(name, "hall")) {
		add_beams(m, 20000, *name == 'h' ? 0.3 : 0.05, *name == 'h' ? 0.5 : 0.1);
		w->eye = (ald_vec){ 0.9, -0.95, 0.9 };
		w->light = (ald_vec){ 0.1, 0.2, 0.9 };
		w->wide = 0.8;
		w->share = 0.25;
	} else if (!strcmp(name, "forest")) {
		forest_tree(m);
		w->forest = forest_plant();
		w->eye = (ald_vec){ 30, -55, 14 };
		w->light = (ald_vec){ 10, -7, 40 };
	} else if (!strncmp(name, "terrain", 7)) {
		n = !name[7] ? 707 : !strcmp(name + 7, "10m") ? 2236 : (uint32_t)strtoul(name + 7, NULL, 10);
		if (!n || n > 20000)
			return false;
		add_terrain(m, n);
		w->eye = (ald_vec){ 4, -5, 2.5 };
	} else {
		return false;
	}
	return true;
}

bool world_make(struct world *w, const char *name)
{
	const ald_frame *f = &w->mesh.frame;

	memset(w, 0, sizeof(*w));
	snprintf(w->name, sizeof(w->name), "%s", name);
	w->wide = 0.5;
	w->share = 1;
	w->light.x = ALD_NAN;
	if (!add_named(w, name))
		return false;
	mesh_finish(&w->mesh, false, false, false);
	w->centre = f->centre;
	w->radius = f->radius;
	if (w->forest) {
		w->centre = (ald_vec){ 0, 0, 1 };
		w->radius = 72;
		if (!forest_read(w->forest, &w->mesh.prims, w->mesh.vertices))
			return false;
	}
	if (w->light.x != w->light.x) {
		w->light.x = w->centre.x + 0.1 * w->radius;
		w->light.y = w->centre.y - 0.067 * w->radius;
		w->light.z = w->centre.z + 0.333 * w->radius;
	}
	return true;
}

void world_release(struct world *w)
{
	forest_free(w->forest);
	mesh_release(&w->mesh);
}

uint32_t world_triangles(const struct world *w)
{
	return w->mesh.prims.tri_count * (w->forest ? (uint32_t)TREES : 1);
}
