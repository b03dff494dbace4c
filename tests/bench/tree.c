/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The tree of the forest: a stem, 99 limbs, and 4,500 leaves of two triangles each.
 */
#include "directions.h"
#include "forest.h"

/* A tube of five sides that grows thinner, without its ends: 10 triangles. */
static void add_limb(struct mesh *m, ald_vec from, ald_vec to, double thick, double thin)
{
	ald_vec z = unit(minus(to, from)), x = unit(cross(z, (ald_vec){ 0.3, 0.8, 0.1 })), y = cross(z, x);
	uint32_t first = m->vertices;

	for (unsigned i = 0; i < 10; i++) {
		double a = 6.283185307179586 * (i / 2) / 5, r = i & 1 ? thin : thick, c = r * cos(a), s = r * sin(a);
		const ald_vec *p = i & 1 ? &to : &from;

		mesh_vertex(m, p->x + c * x.x + s * y.x, p->y + c * x.y + s * y.y, p->z + c * x.z + s * y.z);
	}
	for (uint32_t i = 0; i < 10; i += 2) {
		mesh_triangle(m, first + i, first + i + 1, first + (i + 3) % 10);
		mesh_triangle(m, first + i, first + (i + 3) % 10, first + (i + 2) % 10);
	}
}

static void add_leaf(struct mesh *m, ald_vec c, uint64_t *seed)
{
	ald_vec x = any_way(seed), y = unit(cross(x, any_way(seed)));
	double size = 0.02 + 0.03 * random_unit(seed);
	uint32_t first = m->vertices;

	for (unsigned i = 0; i < 4; i++) {
		double s = i & 1 ? 0.6 * size : -0.6 * size, t = i & 2 ? size : -size;

		mesh_vertex(m, c.x + s * x.x + t * y.x, c.y + s * x.y + t * y.y, c.z + s * x.z + t * y.z);
	}
	mesh_triangle(m, first, first + 1, first + 3);
	mesh_triangle(m, first, first + 3, first + 2);
}

void forest_tree(struct mesh *m)
{
	uint64_t seed = 9;

	mesh_group(m);
	add_limb(m, (ald_vec){ 0, 0, 0 }, (ald_vec){ 0.03, 0.02, 2 }, 0.08, 0.01);
	for (uint32_t limb = 0; limb < 99; limb++) {
		double at = 0.6 + 1.4 * limb / 99, wide = 0.75 - 0.3 * at;
		ald_vec from = { 0.015 * at, 0.01 * at, at }, way = any_way(&seed), to;

		to = (ald_vec){ from.x + wide * way.x, from.y + wide * way.y, from.z + 0.3 * fabs(way.z) };
		add_limb(m, from, to, 0.02, 0.004);
		for (uint32_t i = 0; i < (limb ? 45u : 90u); i++) {
			ald_vec off = any_way(&seed);
			double along = 0.3 + 0.7 * random_unit(&seed), far = 0.12 * random_unit(&seed);

			add_leaf(m, (ald_vec){ from.x + along * (to.x - from.x) + far * off.x,
					       from.y + along * (to.y - from.y) + far * off.y,
					       from.z + along * (to.z - from.z) + far * off.z }, &seed);
		}
	}
}
