/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Meshes made of triangle blocks (manual 3.4.5.2.3), single triangles (3.4.5.2.5), and what they have
 * in common with mesh2: arrays, textures, and the last steps.
 */
#include <config.h>

#include "read/pov/mesh.h"

#include <string.h>

#define TINY 1e-10 /* what POV-Ray takes for 0 */

void mesh_draft_init(struct mesh_draft *d)
{
	*d = (struct mesh_draft){ .vertex.size = 3 * sizeof(double),
				  .index.size = 3 * sizeof(uint32_t),
				  .normal.size = 3 * sizeof(float),
				  .normal_index.size = 3 * sizeof(uint32_t),
				  .uv.size = 2 * sizeof(float),
				  .uv_index.size = 3 * sizeof(uint32_t),
				  .texture.size = sizeof(uint32_t),
				  .common = SCENE_NONE };
}

void mesh_draft_release(struct mesh_draft *d)
{
	mem_free(d->vertex.data);
	mem_free(d->index.data);
	mem_free(d->normal.data);
	mem_free(d->normal_index.data);
	mem_free(d->uv.data);
	mem_free(d->uv_index.data);
	mem_free(d->texture.data);
	mesh_draft_init(d);
}

bool mesh_reserve(struct pov *p, struct mesh_array *a, size_t more, size_t expect)
{
	size_t need = a->count + more, room = a->room + a->room / 2 + 16;
	void *data;

	if (need <= a->room)
		return true;
	if (need > UINT32_MAX - 1) {
		pov_fail(p, "the mesh has more than 4294967294 elements of one kind");
		return false;
	}
	if (room < need)
		room = need;
	if (!a->data && expect > room)
		room = expect;
	data = a->data ? mem_realloc(a->data, mem_product(room, a->size)) :
			 mem_alloc(pov_book(p), "mesh", mem_product(room, a->size));
	if (!data)
		return pov_no_memory(p);
	a->data = data;
	a->room = room;
	return true;
}

/* To the size that is needed. */
static void *trim(struct mesh_array *a)
{
	void *data = a->data;

	if (data && a->count && a->count < a->room) {
		data = mem_realloc(a->data, a->count * a->size);
		if (!data)
			data = a->data;
	}
	a->data = NULL;
	a->count = a->room = 0;
	return data;
}

/* From one number for all faces to one each, or from one each to three. */
static bool widen_textures(struct pov *p, struct mesh_draft *d, uint32_t to, size_t expect)
{
	struct mesh_array wide = { .size = to * sizeof(uint32_t) };
	const uint32_t *old = d->texture.data;
	uint32_t *out;

	if (!mesh_reserve(p, &wide, d->texture.count + 1, expect))
		return false;
	out = wide.data;
	for (size_t i = 0; i < d->texture.count; i++) {
		for (uint32_t k = 0; k < to; k++)
			out[i * to + k] = d->textures_per_face ? old[i] : d->common;
	}
	wide.count = d->texture.count;
	mem_free(d->texture.data);
	d->texture = wide;
	d->textures_per_face = to;
	return true;
}

bool mesh_add_texture(struct pov *p, struct mesh_draft *d, const uint32_t t[3], size_t expect)
{
	bool same = t[0] == t[1] && t[0] == t[2];
	uint32_t *out;

	if (t[0] == SCENE_NONE)
		d->partial = true;
	if (!d->texture.count)
		d->common = t[0];
	if (d->textures_per_face == 0) {
		if (same && t[0] == d->common) {
			d->texture.count++;
			return true;
		}
		if (!widen_textures(p, d, same ? 1 : 3, expect))
			return false;
	} else if (d->textures_per_face == 1 && !same && !widen_textures(p, d, 3, expect)) {
		return false;
	}
	if (!mesh_reserve(p, &d->texture, 1, expect))
		return false;
	out = (uint32_t *)d->texture.data + d->texture.count * d->textures_per_face;
	memcpy(out, t, d->textures_per_face * sizeof(*t));
	d->texture.count++;
	return true;
}

void mesh_add_untextured(struct mesh_draft *d, size_t count)
{
	if (!count)
		return;
	d->partial = true;
	d->common = SCENE_NONE;
	d->texture.count += count;
}

void mesh_normal(float out[3], vec n, bool *zero)
{
	double length;

	if (fabs(n.x) < TINY && fabs(n.y) < TINY && fabs(n.z) < TINY) {
		n.x = 1;
		*zero = true;
	}
	/* Scaled first, so that no square overflows or vanishes. */
	length = fmax(fabs(n.x), fmax(fabs(n.y), fabs(n.z)));
	n = vec_unit(vec_scale(n, 1 / length));
	out[0] = (float)n.x;
	out[1] = (float)n.y;
	out[2] = (float)n.z;
}

static vec vertex_get(const struct mesh_draft *d, uint32_t i)
{
	const double *v = (const double *)d->vertex.data + 3 * (size_t)i;

	return vec_make(v[0], v[1], v[2]);
}

static vec normal_get(const struct mesh_draft *d, uint32_t i)
{
	const float *v = (const float *)d->normal.data + 3 * (size_t)i;

	return vec_make((double)v[0], (double)v[1], (double)v[2]);
}

/* Smooth: not all three normals are the same, as POV-Ray decides it. */
static bool is_smooth(const struct mesh_draft *d, size_t face)
{
	const uint32_t *v = (const uint32_t *)d->index.data + 3 * face;
	const uint32_t *n = v;
	vec n0, n1, n2;

	if (face >= d->smooth_count)
		return false;
	if (d->normal_index.data)
		n = (const uint32_t *)d->normal_index.data + 3 * face;
	if (n[0] == n[1] && n[0] == n[2])
		return false;
	n0 = normal_get(d, n[0]);
	n1 = vec_sub(n0, normal_get(d, n[1]));
	n2 = vec_sub(n0, normal_get(d, n[2]));
	return vec_dot(n1, n1) > TINY || vec_dot(n2, n2) > TINY;
}

/* The number that the file knows it by, of the first face without area. What is without area is decided, and
 * left out, where it stands in the scene (prim/mesh.c): transforms may round it to have some, and then the seam
 * between its neighbours needs it. */
static uint32_t first_empty(const struct mesh_draft *d)
{
	const uint32_t *v = d->index.data;

	for (size_t i = 0; i < d->index.count; i++, v += 3) {
		vec a = vertex_get(d, v[0]), b = vertex_get(d, v[1]), c = vertex_get(d, v[2]);
		vec n = vec_cross(vec_sub(a, b), vec_sub(c, b));

		if (n.x == 0 && n.y == 0 && n.z == 0)
			return (uint32_t)i;
	}
	return SCENE_NONE;
}

struct face_record {
	uint32_t index[3], texture[3], uv[3];
};

static void move_face(struct mesh_draft *d, size_t to, size_t from)
{
	uint32_t *index = d->index.data, *normal = d->normal_index.data, *texture = d->texture.data;
	uint32_t *uv = d->uv_index.data;
	uint32_t per = d->textures_per_face;

	if (to == from)
		return;
	memcpy(index + 3 * to, index + 3 * from, 3 * sizeof(*index));
	if (normal)
		memcpy(normal + 3 * to, normal + 3 * from, 3 * sizeof(*normal));
	if (texture)
		memcpy(texture + per * to, texture + per * from, per * sizeof(*texture));
	if (uv)
		memcpy(uv + 3 * to, uv + 3 * from, 3 * sizeof(*uv));
}

static void save_face(const struct mesh_draft *d, struct face_record *r, size_t face)
{
	const uint32_t *texture = d->texture.data, *uv = d->uv_index.data;

	memcpy(r->index, (const uint32_t *)d->index.data + 3 * face, sizeof(r->index));
	if (texture)
		memcpy(r->texture, texture + d->textures_per_face * face,
		       d->textures_per_face * sizeof(*texture));
	if (uv)
		memcpy(r->uv, uv + 3 * face, sizeof(r->uv));
}

static void restore_face(struct mesh_draft *d, const struct face_record *r, size_t face)
{
	uint32_t *texture = d->texture.data, *uv = d->uv_index.data;

	memcpy((uint32_t *)d->index.data + 3 * face, r->index, sizeof(r->index));
	if (texture)
		memcpy(texture + d->textures_per_face * face, r->texture,
		       d->textures_per_face * sizeof(*texture));
	if (uv)
		memcpy(uv + 3 * face, r->uv, sizeof(r->uv));
}

/* Smooth faces first, then flat ones, each in the file's order. */
static bool sort_faces(struct pov *p, struct mesh_draft *d)
{
	struct face_record *flat = NULL;
	size_t n = d->index.count, smooth = 0, flats = 0, smooths = 0;

	for (size_t i = 0; i < n; i++)
		smooths += is_smooth(d, i);
	flats = n - smooths;
	if (!smooths || !flats) { /* as nearly always */
		d->smooth_count = (uint32_t)smooths;
		return true;
	}
	flat = mem_alloc(pov_book(p), "mesh", mem_product(flats, sizeof(*flat)));
	if (!flat)
		return pov_no_memory(p);
	flats = 0;
	for (size_t i = 0; i < n; i++) {
		/* What lies behind the moved ones has been saved. */
		if (is_smooth(d, i))
			move_face(d, smooth++, i);
		else
			save_face(d, &flat[flats++], i);
	}
	for (size_t i = 0; i < flats; i++)
		restore_face(d, &flat[i], smooth + i);
	mem_free(flat);
	d->smooth_count = (uint32_t)smooths;
	if (d->normal_index.data)
		d->normal_index.count = smooths;
	return true;
}

static void fill_mesh(struct mesh *m, struct mesh_draft *d)
{
	m->pos = d->pos;
	m->vertex_count = (uint32_t)d->vertex.count;
	m->triangle_count = (uint32_t)d->index.count;
	m->smooth_count = d->smooth_count;
	m->has_inside = d->has_inside;
	m->inside = d->inside;
	m->textures_per_face = d->textures_per_face;
	m->vertex = trim(&d->vertex);
	m->index = trim(&d->index);
	if (d->textures_per_face)
		m->texture = trim(&d->texture);
	if (d->uv.count) {
		m->uv_count = (uint32_t)d->uv.count;
		m->uv = trim(&d->uv);
		m->uv_index = trim(&d->uv_index);
	}
	if (d->smooth_count) {
		m->normal_count = (uint32_t)d->normal.count;
		m->normal = trim(&d->normal);
		m->normal_index = trim(&d->normal_index);
	}
}

struct pov_object *mesh_draft_finish(struct pov *p, struct mesh_draft *d)
{
	struct pov_object *o = pov_object_new(p, SHAPE_MESH, &d->pos);
	uint32_t empty = first_empty(d);

	if (!o || pov_failed(p) || !sort_faces(p, d))
		return NULL;
	o->mesh = pov_new(p, sizeof(*o->mesh));
	if (!o->mesh)
		return NULL;
	o->mesh->list = d->list;
	o->mesh->list_count = d->list_count;
	o->mesh->partial = d->partial;
	if (!d->textures_per_face && d->common != SCENE_NONE && d->index.count)
		o->mesh->uniform = d->list[d->common];
	o->mesh->index = scene_add_mesh(pov_scene(p));
	if (o->mesh->index == SCENE_NONE) {
		pov_no_memory(p);
		return NULL;
	}
	fill_mesh(&pov_scene(p)->mesh[o->mesh->index], d);
	pov_scene(p)->mesh[o->mesh->index].empty_face = empty;
	mesh_draft_release(d);
	return o;
}

/* One triangle or smooth_triangle. */
struct corner_set {
	vec at[3], normal[3];
	bool smooth;
};

static void read_corners(struct pov *p, struct corner_set *c, bool smooth)
{
	c->smooth = smooth;
	for (int i = 0; i < 3; i++) {
		c->at[i] = pov_finite_vector(p, "a corner of the triangle");
		if (smooth) {
			pov_comma(p);
			c->normal[i] = pov_finite_vector(p, "a normal of the triangle");
		}
		if (i < 2)
			pov_comma(p);
	}
}

static bool add_corners(struct pov *p, struct mesh_draft *d, const struct corner_set *c)
{
	uint32_t base = (uint32_t)d->vertex.count, *index;
	bool zero = false;
	vec face = vec_cross(vec_sub(c->at[1], c->at[0]), vec_sub(c->at[2], c->at[0]));
	double *v;
	float *n;

	if (!mesh_reserve(p, &d->vertex, 3, 0) || !mesh_reserve(p, &d->normal, 3, 0) ||
	    !mesh_reserve(p, &d->index, 1, 0))
		return false;
	v = (double *)d->vertex.data + 3 * d->vertex.count;
	n = (float *)d->normal.data + 3 * d->normal.count;
	index = (uint32_t *)d->index.data + 3 * d->index.count;
	for (uint32_t i = 0; i < 3; i++) {
		v[3 * i] = c->at[i].x;
		v[3 * i + 1] = c->at[i].y;
		v[3 * i + 2] = c->at[i].z;
		mesh_normal(n + 3 * i, c->smooth ? c->normal[i] : face, &zero);
		index[i] = base + i;
	}
	if (zero && c->smooth)
		pov_warn(p, NULL, "a normal of the triangle has no direction: <1,0,0> is taken, as in "
			 "POV-Ray");
	d->vertex.count += 3;
	d->normal.count += 3;
	d->index.count++;
	return true;
}

/* The number of a texture, which is new to the list or one of its last. */
static bool list_texture(struct pov *p, struct mesh_array *list, uint32_t *out)
{
	struct pov_texture *t = pov_take(p, ITEM_TEXTURE), **all;

	if (!t) {
		pov_fail(p, "the name of a declared texture is expected, not %s", pov_text(p));
		return false;
	}
	all = list->data;
	for (size_t i = list->count; i > 0 && i + 64 > list->count; i--) {
		if (all[i - 1] == t) {
			*out = (uint32_t)(i - 1);
			return true;
		}
	}
	if (!mesh_reserve(p, list, 1, 0))
		return false;
	all = list->data;
	*out = (uint32_t)list->count;
	all[list->count++] = t;
	return true;
}

/* Texture coordinates stand beside the vertices: zeros for those that have none. */
static bool fill_uvs(struct pov *p, struct mesh_draft *d, size_t count)
{
	if (d->uv.count >= count)
		return true;
	if (!mesh_reserve(p, &d->uv, count - d->uv.count, 0))
		return false;
	memset((float *)d->uv.data + 2 * d->uv.count, 0, 2 * (count - d->uv.count) * sizeof(float));
	d->uv.count = count;
	return true;
}

static bool read_uvs(struct pov *p, struct mesh_draft *d)
{
	struct diag_pos at = pov_here(p);
	size_t first = d->vertex.count - 3;

	if (!fill_uvs(p, d, d->vertex.count))
		return false;
	for (size_t i = 0; i < 3; i++) {
		float *out = (float *)d->uv.data + 2 * (first + i);
		double u, v;

		pov_vector2(p, &u, &v);
		if (i < 2)
			pov_comma(p);
		if (!isfinite(u) || !isfinite(v)) {
			pov_fail_at(p, &at, "a uv vector has a component that is not a finite number");
			return false;
		}
		out[0] = (float)u;
		out[1] = (float)v;
	}
	return !pov_failed(p);
}

/* uv_vectors, texture { NAME }, texture_list { NAME NAME NAME } of a triangle in a mesh. */
static bool read_face_look(struct pov *p, struct mesh_draft *d, struct mesh_array *list)
{
	uint32_t t[3] = { SCENE_NONE, SCENE_NONE, SCENE_NONE };

	if (pov_accept(p, TOK_UV_VECTORS) && !read_uvs(p, d))
		return false;
	if (pov_token(p) == TOK_TEXTURE) {
		if (!pov_open(p) || !list_texture(p, list, &t[0]) || !pov_close(p, "texture"))
			return false;
		t[1] = t[2] = t[0];
	} else if (pov_token(p) == TOK_TEXTURE_LIST) {
		if (!pov_open(p))
			return false;
		for (int i = 0; i < 3; i++) {
			if (!list_texture(p, list, &t[i]))
				return false;
			pov_comma(p);
		}
		if (!pov_close(p, "texture_list"))
			return false;
	}
	return !pov_failed(p) && mesh_add_texture(p, d, t, 0);
}

static bool read_faces(struct pov *p, struct mesh_draft *d, struct mesh_array *list)
{
	bool any_smooth = false;

	while (!pov_failed(p)) {
		bool smooth = pov_token(p) == TOK_SMOOTH_TRIANGLE;
		struct corner_set c = { 0 };

		if (pov_accept(p, TOK_INSIDE_VECTOR)) {
			d->inside = pov_finite_vector(p, "inside_vector");
			d->has_inside = vec_length(d->inside) >= TINY;
			continue;
		}
		if (!smooth && pov_token(p) != TOK_TRIANGLE)
			break;
		if (!pov_open(p))
			return false;
		read_corners(p, &c, smooth);
		if (pov_failed(p) || !add_corners(p, d, &c) || !read_face_look(p, d, list) ||
		    !pov_close(p, smooth ? "smooth_triangle" : "triangle"))
			return false;
		any_smooth |= smooth;
	}
	if (!d->index.count && !pov_failed(p))
		pov_fail(p, "the mesh has no triangles");
	d->smooth_count = any_smooth ? (uint32_t)d->index.count : 0;
	return !pov_failed(p) && (!d->uv.count || fill_uvs(p, d, d->vertex.count));
}

struct pov_object *pov_read_mesh(struct pov *p, const struct diag_pos *at)
{
	struct mesh_array list = { .size = sizeof(struct pov_texture *) };
	struct pov_object *o = NULL;
	struct mesh_draft d;

	mesh_draft_init(&d);
	d.pos = *at;
	if (read_faces(p, &d, &list)) {
		d.list_count = (uint32_t)list.count;
		d.list = list.count ? pov_copy(p, list.data, list.count * list.size) : NULL;
		o = mesh_draft_finish(p, &d);
	}
	mem_free(list.data);
	mesh_draft_release(&d);
	return o;
}

struct pov_object *pov_read_triangle(struct pov *p, const struct diag_pos *at, bool smooth)
{
	const uint32_t none[3] = { SCENE_NONE, SCENE_NONE, SCENE_NONE };
	struct pov_object *o = NULL;
	struct corner_set c = { 0 };
	struct mesh_draft d;

	mesh_draft_init(&d);
	d.pos = *at;
	read_corners(p, &c, smooth);
	if (!pov_failed(p) && add_corners(p, &d, &c) && mesh_add_texture(p, &d, none, 1)) {
		d.smooth_count = smooth;
		o = mesh_draft_finish(p, &d);
		if (o)
			pov_scene(p)->mesh[o->mesh->index].lone = true;
	}
	mesh_draft_release(&d);
	return o;
}
