/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Triangle meshes laid into a level: transformed once, in double, and kept in float only where every
 * coordinate is one already.
 */
#include "prim/compile.h"
#include "base/single.h"

#include <string.h>

static vec mesh_vertex(const struct mesh *m, uint32_t i)
{
	const double *p = m->vertex + 3 * (size_t)i;

	return vec_make(p[0], p[1], p[2]);
}

/* Scale by a power of two, so that the extent lies in [1, 2): exact. The shift is taken per axis only
 * where the box lies more than its own size off the origin, because then p - shift is exact as well
 * (Sterbenz): nothing is lost, and far scenes are as good as near ones. */
void prim_level_frame(struct prim_level *l, const ald_box *box)
{
	double size = 0;
	int e = 0;

	l->shift = vec_make(0, 0, 0);
	l->scale = 1;
	for (unsigned k = 0; k < 3; k++) {
		double lo = (&box->lo.x)[k], hi = (&box->hi.x)[k], mid = lo + (hi - lo) / 2;

		if (!(lo <= hi))
			continue;
		size = fmax(size, hi - lo);
		if (fabs(mid) > 1.001 * (hi - lo))
			(&l->shift.x)[k] = mid;
	}
	if (size > 0 && isfinite(size)) {
		frexp(size, &e);
		l->scale = ldexp(1, 1 - e);
	}
	/* Rounded up to where the scale would change, so that a camera that moves a little changes nothing. */
	l->size = size > 0 ? 2 : 1;
	l->pad = 16 * ALD_U * l->size;
}

struct mat prim_bake_mat(const struct prim_level *l, const struct xform *place)
{
	struct mat m = place ? place->fwd : mat_identity;

	for (unsigned k = 0; k < 3; k++) {
		m.m[3][k] = (m.m[3][k] - (&l->shift.x)[k]) * l->scale;
		for (unsigned i = 0; i < 3; i++)
			m.m[i][k] *= l->scale;
	}
	return m;
}

bool prim_join_mesh(ald_box *box, const struct mesh *m, const struct mat *mat)
{
	bool any = false;

	for (uint32_t i = 0; i < m->vertex_count; i++) {
		vec p = mat_point(mat, mesh_vertex(m, i));

		if (!prim_sane(p))
			continue;
		ald_box_join(box, &(ald_box){ p, p });
		any = true;
	}
	return any;
}

static bool within(vec p, double most)
{
	return fabs(p.x) <= most && fabs(p.y) <= most && fabs(p.z) <= most;
}

/* What rounding makes nothing may still have area: a sliver in a seam, without which there would be a crack. */
static bool has_area(vec a, vec b, vec c, double most)
{
	vec n = vec_cross(vec_sub(b, a), vec_sub(c, a));
	ald_prep p = { .o = { a.x, a.y, a.z } };

	if (!within(a, most) || !within(b, most) || !within(c, most))
		return false;
	if (n.x != 0 || n.y != 0 || n.z != 0)
		return true;
	for (unsigned k = 0; k < 3; k++) {
		p.kz = k;
		p.d[0] = k == 0;
		p.d[1] = k == 1;
		p.d[2] = k == 2;
		if (ald_exact_volume(&p, &b, &c) != 0)
			return true;
	}
	return false;
}

/* The number of a dropped face as the file has it, as far as that is known: smooth faces stand first in m. */
static uint32_t file_face(const struct mesh *m, uint32_t i)
{
	bool sorted = m->smooth_count && m->smooth_count < m->triangle_count;

	return sorted && m->empty_face != SCENE_NONE ? m->empty_face : i;
}

/* From now on the group's faces have to be looked up: the first n are in order. */
static enum status start_faces(struct prim_group *g, struct mem_book *book, uint32_t n, uint32_t room,
			       struct diag *diag)
{
	size_t bytes = mem_product(room, sizeof(uint32_t));

	g->face = mem_alloc(book, "geometry", bytes);
	if (!g->face)
		return diag_no_memory(diag, "the list of faces", bytes);
	for (uint32_t i = 0; i < n; i++)
		g->face[i] = i;
	return STATUS_OK;
}

enum status prim_bake_mesh(struct prim_set *s, struct prim_level *l, const struct mesh *m, uint32_t leaf,
			   const struct mat *mat, struct diag *diag)
{
	struct prim_group *g = &l->group[l->group_count];
	uint32_t base = l->vertex_count, first = l->tri_count;
	double *vertex = (double *)l->vertex + 3 * (size_t)base;
	const vec *v = (const vec *)l->vertex;
	double most = PRIM_ABSURD * l->scale;

	g->leaf = leaf;
	l->group_first[l->group_count++] = first;
	for (uint32_t i = 0; i < m->vertex_count; i++) {
		vec p = mat_point(mat, mesh_vertex(m, i));

		vertex[3 * (size_t)i] = p.x;
		vertex[3 * (size_t)i + 1] = p.y;
		vertex[3 * (size_t)i + 2] = p.z;
	}
	l->vertex_count += m->vertex_count;
	for (uint32_t i = 0; i < m->triangle_count; i++) {
		const uint32_t *in = m->index + 3 * (size_t)i;
		uint32_t *out = l->index + 3 * (size_t)l->tri_count;
		uint32_t n = l->tri_count - first;

		if (in[0] >= m->vertex_count || in[1] >= m->vertex_count || in[2] >= m->vertex_count ||
		    !has_area(v[base + in[0]], v[base + in[1]], v[base + in[2]], most)) {
			prim_drop(s, leaf, 1, file_face(m, i));
			if (!g->face && start_faces(g, s->book, n, m->triangle_count, diag))
				return STATUS_FAILED;
			continue;
		}
		for (unsigned k = 0; k < 3; k++)
			out[k] = base + in[k];
		if (g->face)
			g->face[n] = i;
		l->tri_count++;
	}
	return STATUS_OK;
}

void prim_narrow_vertices(struct prim_level *l)
{
	size_t n = 3 * (size_t)l->vertex_count;
	const double *wide = l->vertex;
	float *narrow = l->vertex;
	void *less;

	l->vertex_double = true;
	for (size_t i = 0; i < n; i++) {
		if (as_single(wide[i]) != wide[i])
			return;
	}
	/* In place: the i-th float ends before the i-th double. */
	for (size_t i = 0; i < n; i++) {
		float f = (float)wide[i];

		memmove(&narrow[i], &f, sizeof(f));
	}
	l->vertex_double = false;
	less = n ? mem_realloc(l->vertex, n * sizeof(float)) : NULL;
	if (less)
		l->vertex = less;
}
