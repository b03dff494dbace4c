/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The operations are those of surface.c in their order, of which eight lanes at a time are asked for.
 */
#include "accel/facet.h"

#include "accel/geometry.h"

bool facet_find(const struct geometry *g, uint32_t id, struct facet_kind *k)
{
	const struct prim_level *l = &g->set.level[0];
	const struct scene *s = g->set.scene;
	const struct prim_leaf *f;
	uint32_t group;

	if (id - k->from < k->end - k->from)
		return k->even;
	if (id >= l->tri_count)
		return false;
	group = level_group(l, id);
	f = &g->set.leaf[l->group[group].leaf];
	k->from = l->group_first[group];
	k->end = l->group_first[group + 1];
	k->flags = f->flags;
	k->light_set = s->object[f->object].light_set;
	k->leaf = f;
	k->mesh = &s->mesh[f->mesh];
	k->face = l->group[group].face;
	k->even = !k->mesh->grid && f->interior_texture == SCENE_NONE;
	return k->even;
}

static bool one_texture(const struct facet_kind *k, uint32_t face, uint32_t *texture)
{
	const struct mesh *m = k->mesh;
	const uint32_t *t;

	*texture = k->leaf->texture;
	if (!m->texture)
		return true;
	t = m->texture + (size_t)face * m->textures_per_face;
	if (m->textures_per_face == 3 && (t[0] != t[1] || t[0] != t[2]))
		return false;
	*texture = *t != SCENE_NONE ? *t : *texture;
	return true;
}

static vec smooth_normal(const struct facet_kind *k, uint32_t face, const ald_hit *hit)
{
	const struct mesh *m = k->mesh;
	const uint32_t *i = (m->normal_index ? m->normal_index : m->index) + 3 * (size_t)face;
	double bary[3] = { 1 - hit->u - hit->v, hit->u, hit->v };
	vec n = { 0, 0, 0 };

	for (unsigned j = 0; j < 3; j++) {
		const float *v = m->normal + 3 * (size_t)i[j];

		n = vec_mad(n, vec_make((double)v[0], (double)v[1], (double)v[2]), bary[j]);
	}
	return mat_normal(&k->leaf->place.inv, n);
}

static inline void put_corner(double (*to)[LANES], unsigned lane, vec c)
{
	to[0][lane] = c.x;
	to[1][lane] = c.y;
	to[2][lane] = c.z;
}

bool facet_take(const struct geometry *g, const struct facet_kind *k, const ald_hit *hit, struct facet_hits *to,
		unsigned lane, uint32_t *texture)
{
	uint32_t face = hit->prim - k->from;
	vec c[3], n = { 0, 0, 0 };

	face = k->face ? k->face[face] : face;
	if (!one_texture(k, face, texture))
		return false;
	prim_triangle(&g->set.level[0], hit->prim, c);
	put_corner(to->corner[0], lane, c[0]); /* no loop, as in prim_triangle() */
	put_corner(to->corner[1], lane, c[1]);
	put_corner(to->corner[2], lane, c[2]);
	if (k->mesh->normal && face < k->mesh->smooth_count)
		n = smooth_normal(k, face, hit);
	to->normal[0][lane] = n.x;
	to->normal[1][lane] = n.y;
	to->normal[2][lane] = n.z;
	to->u[lane] = hit->u;
	to->v[lane] = hit->v;
	to->side[lane] = k->leaf->mirrored ? -1 : 1;
	return true;
}

LANED vec corner_at(const struct facet_hits *h, unsigned corner, unsigned i)
{
	return vec_make(h->corner[corner][0][i], h->corner[corner][1][i], h->corner[corner][2][i]);
}

/* No number where vec_unit() leaves a 0 what it is, without a branch. */
LANED vec unit_lane(vec a)
{
	return vec_scale(a, 1 / vec_length(a));
}

LANED void place_lane(const struct facet_hits *h, vec shift, double unscale, double scale, struct facets *out,
		      unsigned i)
{
	vec a = corner_at(h, 0, i), b = corner_at(h, 1, i), c = corner_at(h, 2, i);
	vec raw = vec_make(h->normal[0][i], h->normal[1][i], h->normal[2][i]), p, n, ns;
	double u = h->u[i], v = h->v[i], w = 1 - u - v, big, error, nothing;
	int smooth;

	p = vec_add(vec_add(vec_scale(a, w), vec_scale(b, u)), vec_scale(c, v));
	n = vec_cross(vec_sub(c, a), vec_sub(b, a));
	big = ald_max(ald_max(fabs(n.x), fabs(n.y)), fabs(n.z));
	n = vec_scale(unit_lane(vec_scale(n, near_inverse(big))), h->side[i]);
	error = 64 * ALD_U * ald_max(ald_max(size_of(a), size_of(b)), size_of(c));
	p = vec_add(vec_scale(p, unscale), shift);
	ns = unit_lane(raw);
	nothing = ns.x * 0 + ns.y * 0 + ns.z * 0;
	smooth = (nothing == 0) & (vec_dot(ns, ns) > 0.5);
	out->p[0][i] = p.x;
	out->p[1][i] = p.y;
	out->p[2][i] = p.z;
	out->n[0][i] = n.x;
	out->n[1][i] = n.y;
	out->n[2][i] = n.z;
	out->ns[0][i] = smooth ? ns.x : n.x;
	out->ns[1][i] = smooth ? ns.y : n.y;
	out->ns[2][i] = smooth ? ns.z : n.z;
	out->error[i] = error / scale + 4 * ALD_U * (size_of(p) + size_of(shift));
	out->size[i] = big;
}

WIDE static void place_all(const struct facet_hits *restrict h, vec shift, double unscale, double scale,
			   struct facets *restrict out)
{
	for (unsigned i = 0; i < LANES; i++)
		place_lane(h, shift, unscale, scale, out, i);
}

void facet_place(const struct geometry *g, const struct facet_hits *h, struct facets *out)
{
	const struct prim_level *l = &g->set.level[0];

	place_all(h, l->shift, 1 / l->scale, l->scale, out);
}
