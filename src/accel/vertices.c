/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * In which precision vertices are kept, and why: for --dry-run. A level keeps floats if all its coordinates are
 * floats relative to the level's origin (prim/mesh.c); one mesh that is not makes all of the level's doubles.
 */
#include "accel/geometry.h"
#include "base/single.h"

/* What floats would do to the triangles of a group. */
static void look_at_group(const struct prim_level *l, uint32_t g, struct mesh_vertices *m)
{
	uint32_t end = l->group_first[g + 1] < l->tri_count ? l->group_first[g + 1] : l->tri_count;
	ald_box box = ald_box_empty();

	for (uint32_t i = l->group_first[g]; i < end; i++) {
		vec v[3];

		prim_triangle(l, i, v);
		for (unsigned k = 0; k < 3; k++) {
			ald_box_join(&box, &(ald_box){ v[k], v[k] });
			for (unsigned axis = 0; axis < 3; axis++) {
				double x = ald_get(&v[k], axis), off = fabs(as_single(x) - x) / l->scale;

				m->loss = fmax(m->loss, off);
			}
		}
	}
	m->size = fmax(fmax(box.hi.x - box.lo.x, box.hi.y - box.lo.y), box.hi.z - box.lo.z) / l->scale;
	for (unsigned axis = 0; axis < 3; axis++) {
		double at = ald_get(&box.lo, axis) / 2 + ald_get(&box.hi, axis) / 2;

		m->offset = fmax(m->offset, fabs(at / l->scale + ald_get(&l->shift, axis)));
	}
}

static uint32_t object_of(const struct prim_set *s, uint32_t level, uint32_t g)
{
	uint32_t leaf = s->level[level].group[g].leaf;

	for (uint32_t i = 0; leaf == SCENE_NONE && i < s->leaf_count; i++) {
		if (s->leaf[i].level == level)
			leaf = i;
	}
	return leaf == SCENE_NONE ? SCENE_NONE : s->leaf[leaf].object;
}

void geometry_get_vertices(const struct geometry *g, struct geometry_vertices *out, mesh_told *each, void *data)
{
	*out = (struct geometry_vertices){ .shift = g->set.level[0].shift, .worst = { .object = SCENE_NONE } };
	for (uint32_t i = 0; i < g->set.level_count; i++) {
		const struct prim_level *l = &g->set.level[i];

		for (uint32_t k = 0; k < l->group_count && l->group_first[k] < l->tri_count; k++) {
			struct mesh_vertices m = { .object = object_of(&g->set, i, k), .wide = l->vertex_double };

			look_at_group(l, k, &m);
			if (each && !each(data, &m))
				return;
			out->meshes++;
			out->wide += l->vertex_double;
			out->demanding += m.loss > 0;
			if (m.loss > 0 && (out->worst.object == SCENE_NONE ||
					   m.loss / m.size > out->worst.loss / out->worst.size))
				out->worst = m;
		}
	}
}
