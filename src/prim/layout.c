/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Filling levels: counting what there is, memory in one go, then triangles, analytic primitives and
 * instances in this order.
 */
#include "prim/layout.h"

struct sums {
	uint64_t triangles, vertices, prims, pieces, bodies, instances, groups, planes;
};

static bool is_bounded(enum shape_kind k)
{
	return k == SHAPE_SPHERE || k == SHAPE_BOX || k == SHAPE_CONE || k == SHAPE_DISC ||
	       k == SHAPE_TORUS || k == SHAPE_SUPERELLIPSOID;
}

/* Without bounds, but where constructive solid geometry gives it some. */
static bool is_infinite(enum shape_kind k)
{
	return k == SHAPE_PLANE || k == SHAPE_ALGEBRAIC;
}

static unsigned leaf_mask(unsigned flags)
{
	unsigned m = PRIM_OTHER;

	if (flags & OBJECT_PROJECTED)
		return PRIM_PROJECTED;
	if (!(flags & OBJECT_NO_IMAGE))
		m |= PRIM_CAMERA;
	if (!(flags & OBJECT_NO_REFLECTION))
		m |= PRIM_REFLECTED;
	if (!(flags & OBJECT_NO_RADIOSITY))
		m |= flags & OBJECT_NO_REFLECTION ? PRIM_GATHER : PRIM_GATHER | PRIM_GATHER_REFLECTED;
	if (!(flags & OBJECT_NO_SHADOW))
		m |= PRIM_SHADOW_OPAQUE | PRIM_SHADOW_CLEAR;
	return m;
}

/* Shadow bits of a face of a mesh whose object has these textures. */
static unsigned face_mask(const struct scene *s, const struct mesh *m, uint32_t face, unsigned own)
{
	unsigned bits = 0;

	if (!m->texture)
		return own;
	for (uint32_t k = 0; k < m->textures_per_face; k++) {
		uint32_t t = m->texture[(size_t)face * m->textures_per_face + k];

		bits |= t == SCENE_NONE ? own : prim_texture_mask(s, t);
	}
	/* Blended corners let light through if one of them does. */
	return bits & PRIM_SHADOW_CLEAR && own != (PRIM_SHADOW_OPAQUE | PRIM_SHADOW_CLEAR) ?
		       PRIM_SHADOW_CLEAR :
		       bits;
}

static uint32_t face_of(const struct prim_level *l, uint32_t g, uint32_t id)
{
	uint32_t n = id - l->group_first[g];

	return l->group[g].face ? l->group[g].face[n] : n;
}

static void mask_triangles(struct prim_set *s, struct prim_level *l, uint32_t g, uint32_t end,
			   const struct mesh *m, unsigned flags, unsigned own)
{
	for (uint32_t i = l->group_first[g]; i < end; i++)
		l->mask[i] = (flags & ~(unsigned)(PRIM_SHADOW_OPAQUE | PRIM_SHADOW_CLEAR)) |
			     (flags & face_mask(s->scene, m, face_of(l, g, i), own));
}

static bool mesh_has_clear_faces(const struct scene *s, const struct mesh *m)
{
	size_t n = m->texture ? (size_t)m->triangle_count * m->textures_per_face : 0;

	for (size_t i = 0; i < n; i++) {
		if (m->texture[i] != SCENE_NONE && texture_translucent(&s->texture[m->texture[i]]))
			return true;
	}
	return false;
}

/* A mesh with some clear faces and an interior_texture: light that comes from inside meets the latter,
 * whatever the face's own texture is. Shading looks at each hit, so all faces count as clear. */
static void mask_clear(struct prim_level *l, uint32_t first, uint32_t end)
{
	for (uint32_t i = first; i < end; i++) {
		if (l->mask[i] & PRIM_SHADOW_OPAQUE)
			l->mask[i] ^= PRIM_SHADOW_OPAQUE | (~l->mask[i] & PRIM_SHADOW_CLEAR);
	}
}

static void *take(struct prim_set *s, uint64_t n, size_t size, bool *ok)
{
	void *p = mem_zalloc(s->book, "geometry",
			     n > SIZE_MAX / 2 ? SIZE_MAX : mem_product((size_t)n + 1, size));

	*ok = *ok && p;
	return p;
}

static enum status take_level(struct prim_set *s, struct prim_level *l, const struct sums *n, bool mask,
			      struct diag *diag)
{
	uint64_t ids = n->triangles + n->prims + n->pieces + n->instances;
	bool ok = true;

	if (ids + n->planes >= UINT32_MAX - 1 || n->vertices >= UINT32_MAX)
		return diag_fail(diag, STATUS_FAILED, NULL,
				 "the scene has %llu primitives; at most 4294967293 can be numbered",
				 (unsigned long long)(ids + n->planes));
	l->group_first = take(s, n->groups, sizeof(*l->group_first), &ok);
	l->group = take(s, n->groups, sizeof(*l->group), &ok);
	l->vertex = take(s, n->vertices, 3 * sizeof(double), &ok);
	l->index = take(s, n->triangles, 3 * sizeof(uint32_t), &ok);
	l->prim = take(s, n->prims, sizeof(*l->prim), &ok);
	l->piece = take(s, n->pieces, sizeof(*l->piece), &ok);
	l->body = take(s, n->bodies, sizeof(*l->body), &ok);
	l->instance = take(s, n->instances, sizeof(*l->instance), &ok);
	if (mask)
		l->mask = take(s, ids, sizeof(*l->mask), &ok);
	if (!ok)
		return diag_no_memory(diag, "the geometry",
				      n->vertices * 24 + n->triangles * 16 +
					      (n->prims + n->bodies) * sizeof(*l->prim) +
					      n->pieces * sizeof(*l->piece) +
					      n->instances * sizeof(*l->instance));
	return STATUS_OK;
}

static void join_triangles(struct prim_level *l)
{
	for (uint32_t i = 0; i < l->tri_count; i++) {
		vec v[3];

		prim_triangle(l, i, v);
		for (unsigned k = 0; k < 3; k++)
			ald_box_join(&l->box, &(ald_box){ v[k], v[k] });
	}
	if (!l->tri_count)
		return;
	for (unsigned k = 0; k < 3; k++) {
		(&l->box.lo.x)[k] -= l->pad;
		(&l->box.hi.x)[k] += l->pad;
	}
}

enum status layout_mesh_level(struct prim_set *s, uint32_t level, struct diag *diag)
{
	struct prim_level *l = &s->level[level];
	const struct mesh *m = NULL;
	uint32_t leaf = 0;
	struct sums n = { .groups = 1 };
	ald_box box = ald_box_empty();
	struct mat mat;
	enum status st;

	while (leaf < s->leaf_count && s->leaf[leaf].level != level)
		leaf++;
	if (leaf < s->leaf_count)
		m = &s->scene->mesh[s->leaf[leaf].mesh];
	l->box = ald_box_empty();
	if (!m)
		return STATUS_OK;
	n.triangles = m->triangle_count;
	n.vertices = m->vertex_count;
	prim_join_mesh(&box, m, &mat_identity);
	prim_level_frame(l, &box);
	st = take_level(s, l, &n, m->texture != NULL, diag);
	if (st)
		return st;
	mat = prim_bake_mat(l, NULL);
	st = prim_bake_mesh(s, l, m, leaf, &mat, diag);
	if (st)
		return st;
	l->group[0].leaf = SCENE_NONE;
	l->group_first[1] = l->tri_count;
	l->count = l->tri_count;
	prim_narrow_vertices(l);
	if (l->mask)
		mask_triangles(s, l, 0, l->tri_count, m, ~0u, PRIM_SHADOW_OPAQUE | PRIM_SHADOW_CLEAR);
	join_triangles(l);
	return STATUS_OK;
}

/* The corners of an instanced mesh's box rather than its vertices: there may be many instances. */
static bool join_instance(const struct prim_level *in, const struct xform *place, ald_box *box)
{
	for (unsigned i = 0; in->count && i < 8; i++) {
		vec c = { i & 1 ? in->box.hi.x : in->box.lo.x, i & 2 ? in->box.hi.y : in->box.lo.y,
			  i & 4 ? in->box.hi.z : in->box.lo.z };

		c = mat_point(&place->fwd, vec_add(vec_scale(c, 1 / in->scale), in->shift));
		if (prim_sane(c))
			ald_box_join(box, &(ald_box){ c, c });
	}
	return in->count > 0;
}

/* The shape's data, made when the first object asks for it; NULL: no memory. */
static const void *body_data(struct prim_set *s, const struct object *o)
{
	const struct body_ops *ops = body_ops_of(o->kind);
	uint32_t count, i = ops->shape(s->scene, o, &count);
	void ***list = &s->body_data[o->kind];

	if (!*list)
		*list = mem_zalloc(s->book, "geometry", mem_product(count, sizeof(**list)));
	if (!*list)
		return NULL;
	if (!(*list)[i]) {
		(*list)[i] = arena_zalloc(&s->arena, ops->bytes(s->scene, o));
		if ((*list)[i])
			ops->make(s->scene, o, (*list)[i]);
	}
	return (*list)[i];
}

static bool box_is_sane(struct prim_leaf *f, const ald_box *b)
{
	f->absurd = !prim_sane(b->lo) || !prim_sane(b->hi);
	return !f->absurd;
}

static bool body_box(struct prim_set *s, struct prim_leaf *f, ald_box *box)
{
	const struct object *o = &s->scene->object[f->object];
	const struct body_data *data = body_data(s, o);
	ald_box all = ald_box_empty();
	struct prim_piece q;
	struct prim p;

	if (!data || !body_make(&p, o, &f->place, vec_make(0, 0, 0), 1, data))
		return false;
	for (uint32_t i = 0; i < data->pieces; i++) {
		if (!piece_make(&q, &p, 0, i, 0, 0))
			return false;
		ald_box_join(&all, &q.box);
	}
	if (data->pieces && !box_is_sane(f, &all))
		return false;
	ald_box_join(box, &all);
	return data->pieces > 0;
}

/* Where a leaf lies in the world; false: nowhere, or without bounds. */
static bool leaf_box(struct prim_set *s, struct prim_leaf *f, ald_box *box)
{
	const struct object *o = &s->scene->object[f->object];
	struct prim p;

	if (f->level)
		return join_instance(&s->level[f->level], &f->place, box);
	if (f->kind == SHAPE_MESH)
		return prim_join_mesh(box, &s->scene->mesh[f->mesh], &f->place.fwd);
	if (body_ops_of(f->kind))
		return body_box(s, f, box);
	if (!is_bounded(f->kind) ||
	    !prim_make(&p, o, &f->place, vec_make(0, 0, 0), 1, 0, 0) || !box_is_sane(f, &p.box))
		return false;
	ald_box_join(box, &p.box);
	return true;
}

static void count_world(struct prim_set *s, struct sums *n)
{
	for (uint32_t i = 0; i < s->leaf_count; i++) {
		const struct prim_leaf *f = &s->leaf[i];

		n->groups++;
		if (f->level) {
			n->instances++;
		} else if (f->kind == SHAPE_MESH) {
			n->triangles += s->scene->mesh[f->mesh].triangle_count;
			n->vertices += s->scene->mesh[f->mesh].vertex_count;
		} else if (is_bounded(f->kind)) {
			n->prims += f->node == SCENE_NONE ? 1 : 2; /* see add_hidden() */
		} else if (body_ops_of(f->kind)) {
			n->bodies++;
			n->pieces += body_ops_of(f->kind)->pieces(s->scene, &s->scene->object[f->object]);
		} else if (f->kind == SHAPE_PLANE) {
			n->planes++;
			n->prims += f->node != SCENE_NONE;
		} else if (is_infinite(f->kind)) {
			n->planes++;
			n->prims++;
		}
	}
}

static void add_group(struct prim_level *l, uint32_t leaf)
{
	l->group[l->group_count].leaf = leaf;
	l->group_first[l->group_count++] = l->count;
}

static unsigned solid_mask(const struct prim_set *s, const struct prim_leaf *f)
{
	return leaf_mask(f->flags) &
	       (prim_leaf_mask(s->scene, f) | ~(unsigned)(PRIM_SHADOW_OPAQUE | PRIM_SHADOW_CLEAR));
}

/* See prim/sweep_inner.c. */
static bool shows_inner(const struct scene *s, const struct prim_leaf *f)
{
	return f->kind == SHAPE_SWEEP && s->sweep[s->object[f->object].shape.sweep].kind != SWEEP_LINEAR &&
	       f->node == SCENE_NONE && prim_leaf_mask(s, f) == PRIM_SHADOW_CLEAR;
}

/* All pieces or none. */
static enum status add_body(struct prim_set *s, struct prim_level *l, uint32_t leaf, struct diag *diag)
{
	const struct prim_leaf *f = &s->leaf[leaf];
	const struct object *o = &s->scene->object[f->object];
	const struct body_data *data = body_data(s, o);
	struct prim *p = &l->body[l->body_count];
	ald_box all = ald_box_empty();
	uint32_t pieces = f->cut ? 0 : data ? data->pieces : 0;
	unsigned mask = solid_mask(s, f);

	if (!data)
		return diag_no_memory(diag, "the geometry", 0);
	if (!data->pieces || f->absurd || !body_make(p, o, &f->place, l->shift, l->scale, data)) {
		prim_drop(s, leaf, 1, 0);
		return STATUS_OK;
	}
	p->node = f->node;
	p->inner = shows_inner(s->scene, f);
	for (uint32_t i = 0; i < pieces; i++) {
		struct prim_piece *q = &l->piece[l->piece_count + i];

		if (!piece_make(q, p, l->body_count, i, l->size, l->pad)) {
			prim_drop(s, leaf, 1, 0);
			return STATUS_OK;
		}
		ald_box_join(&all, &q->box);
	}
	s->leaf[leaf].item = l->body_count++;
	if (!pieces)
		return STATUS_OK;
	add_group(l, leaf);
	for (uint32_t i = 0; i < pieces; i++)
		l->mask[l->count++] = mask;
	l->piece_count += pieces;
	ald_box_join(&l->box, &all);
	return STATUS_OK;
}

/* What other solids leave of a box, in level coordinates and grown as the box is. */
static void clip_box(const struct prim_set *s, const struct prim_leaf *f, const struct prim_level *l,
		     struct prim *p)
{
	const ald_box *clip = f->node == SCENE_NONE ? NULL : &csg_at(&s->csg, f->node)->clip;

	for (unsigned k = 0; clip && k < 3; k++) {
		double shift = (&l->shift.x)[k], mid = (&p->centre.x)[k];
		double lo = ((&clip->lo.x)[k] - shift) * l->scale, hi = ((&clip->hi.x)[k] - shift) * l->scale;
		double grow = l->pad + 16 * ALD_U * (fabs(lo) + fabs(hi) + fabs(shift) * l->scale) +
			      prim_map_error(&p->to, &p->from, k, l->size + fabs(mid));

		(&p->box.lo.x)[k] = fmax((&p->box.lo.x)[k], lo - grow);
		(&p->box.hi.x)[k] = fmin((&p->box.hi.x)[k], hi + grow);
	}
}

static bool box_is_sound(const ald_box *b)
{
	return vec_finite(b->lo) && vec_finite(b->hi) && b->lo.x <= b->hi.x && b->lo.y <= b->hi.y &&
	       b->lo.z <= b->hi.z;
}

/* Other solids leave nothing of it. */
static bool is_cut_off(const struct prim_set *s, const struct prim_leaf *f)
{
	const ald_box *b;

	if (f->node == SCENE_NONE)
		return false;
	b = &csg_at(&s->csg, f->node)->clip;
	return f->cut || b->lo.x > b->hi.x || b->lo.y > b->hi.y || b->lo.z > b->hi.z;
}

static bool make_solid(const struct prim_set *s, const struct prim_level *l, const struct prim_leaf *f,
		       struct prim *p)
{
	const struct object *o = &s->scene->object[f->object];
	bool ok;

	if (f->kind == SHAPE_PLANE)
		ok = prim_make_plane(p, o, &f->place, l->shift, l->scale);
	else if (f->kind == SHAPE_ALGEBRAIC)
		ok = prim_make_algebraic(p, &s->scene->algebraic[o->shape.algebraic], &f->place, l->shift,
					 l->scale);
	else
		ok = prim_make(p, o, &f->place, l->shift, l->scale, l->size, l->pad);

	p->node = f->node;
	return ok;
}

/* Some of its surface shows, within a box. */
static bool is_visible(const struct prim_set *s, const struct prim_leaf *f)
{
	return f->node == SCENE_NONE ? is_bounded(f->kind) :
				       (is_bounded(f->kind) || is_infinite(f->kind)) && !f->cut &&
					       box_is_sound(&csg_at(&s->csg, f->node)->clip);
}

static void add_prim(struct prim_set *s, struct prim_level *l, uint32_t leaf)
{
	const struct prim_leaf *f = &s->leaf[leaf];
	struct prim *p = &l->prim[l->prim_count];

	if (f->absurd || !make_solid(s, l, f, p)) {
		prim_drop(s, leaf, 1, 0);
		return;
	}
	clip_box(s, f, l, p);
	add_group(l, leaf);
	l->mask[l->count++] = solid_mask(s, f);
	s->leaf[leaf].item = l->prim_count++;
	ald_box_join(&l->box, &p->box);
}

/* Solids of which nothing shows in a box, and closed ones in the place of open cones: they only cut. */
static void add_hidden(struct prim_set *s, struct prim_level *l, uint32_t leaf)
{
	struct prim_leaf *f = &s->leaf[leaf];
	struct prim *p = &l->prim[l->prim_count + l->hidden_prims];

	if (f->absurd || !make_solid(s, l, f, p))
		return;
	p->open = false;
	f->item = l->prim_count + l->hidden_prims++;
}

struct mat prim_instance_from(const struct prim_set *s, const struct prim_instance *p)
{
	double scale = s->level[p->level].scale / s->level[0].scale;
	struct mat from = s->leaf[p->leaf].place.fwd;

	for (unsigned j = 0; j < 3; j++) {
		for (unsigned i = 0; i < 3; i++)
			from.m[i][j] /= scale;
		from.m[3][j] = 0;
	}
	return from;
}

/* The inner box's corners, mapped, and grown by what mapping a ray can do to it. */
static void bound_instance(const struct prim_set *s, struct prim_instance *p, const struct prim_level *in,
			   const struct prim_level *out)
{
	const struct mat from = prim_instance_from(s, p);

	p->box = ald_box_empty();
	for (unsigned i = 0; i < 8; i++) {
		vec c = { i & 1 ? in->box.hi.x : in->box.lo.x, i & 2 ? in->box.hi.y : in->box.lo.y,
			  i & 4 ? in->box.hi.z : in->box.lo.z };
		vec q = vec_add(mat_dir(&from, c), p->centre);

		ald_box_join(&p->box, &(ald_box){ q, q });
	}
	for (unsigned k = 0; k < 3; k++) {
		double lo = (&p->box.lo.x)[k], hi = (&p->box.hi.x)[k];
		double size = out->size + fabs(lo) + fabs(hi);
		double grow = out->pad + prim_map_error(&p->to, &from, k, size) + 8 * ALD_U * size;

		(&p->box.lo.x)[k] = lo - grow;
		(&p->box.hi.x)[k] = hi + grow;
	}
}

static void add_instance(struct prim_set *s, struct prim_level *l, uint32_t leaf)
{
	const struct prim_leaf *f = &s->leaf[leaf];
	const struct prim_level *in = &s->level[f->level];
	struct prim_instance *p = &l->instance[l->instance_count + l->hidden_instances];
	unsigned shadow = prim_leaf_mask(s->scene, f);
	const unsigned both = PRIM_SHADOW_OPAQUE | PRIM_SHADOW_CLEAR;
	double scale = in->scale / l->scale;

	if (!in->count)
		return;
	*p = (struct prim_instance){ .leaf = leaf, .level = f->level, .node = f->node };
	p->centre = prim_level_point(l, mat_point(&f->place.fwd, in->shift));
	for (unsigned i = 0; i < 3; i++) {
		for (unsigned j = 0; j < 3; j++)
			p->to.m[i][j] = f->place.inv.m[i][j] * scale;
	}
	bound_instance(s, p, in, l);
	if (!vec_finite(p->box.lo) || !vec_finite(p->box.hi)) {
		prim_drop(s, leaf, in->count, 0);
		return;
	}
	if (f->cut) {
		s->leaf[leaf].item = l->instance_count + l->hidden_instances++;
		return;
	}
	add_group(l, leaf);
	for (uint32_t i = 0; in->mask && i < in->count; i++) {
		if ((in->mask[i] & both) != both) /* faces with textures of their own */
			shadow |= in->mask[i];
	}
	l->mask[l->count++] = leaf_mask(f->flags) &
			      (shadow | ~(unsigned)(PRIM_SHADOW_OPAQUE | PRIM_SHADOW_CLEAR));
	s->leaf[leaf].item = l->instance_count++;
	ald_box_join(&l->box, &p->box);
}

/* What no box holds; but for a plane it is one of the primitives that have no ids as well. */
static void add_unbounded(struct prim_set *s, struct prim_level *l, uint32_t leaf)
{
	const struct prim_leaf *f = &s->leaf[leaf];
	struct prim_unbounded *p = &s->unbounded[s->unbounded_count];

	if (f->kind == SHAPE_PLANE ?
		    !plane_make(&p->plane, &s->scene->object[f->object], &f->place, l->shift, l->scale) :
		    !make_solid(s, l, f, &l->prim[l->prim_count + l->hidden_prims])) {
		prim_drop(s, leaf, 1, 0);
		return;
	}
	p->leaf = leaf;
	p->prim = SCENE_NONE;
	p->node = f->node;
	p->mask = solid_mask(s, f);
	if (f->kind == SHAPE_PLANE) {
		s->leaf[leaf].item = s->unbounded_count++;
		return;
	}
	p->prim = s->leaf[leaf].item = l->prim_count + l->hidden_prims++;
	s->unbounded_count++;
}

static enum status bake_world(struct prim_set *s, struct prim_level *l, struct diag *diag)
{
	for (uint32_t i = 0; i < s->leaf_count; i++) {
		const struct prim_leaf *f = &s->leaf[i];
		const struct mesh *m;
		struct mat mat;
		enum status st;

		if (f->kind != SHAPE_MESH || f->level)
			continue;
		m = &s->scene->mesh[f->mesh];
		mat = prim_bake_mat(l, &f->place);
		st = prim_bake_mesh(s, l, m, i, &mat, diag);
		if (st)
			return st;
		mask_triangles(s, l, l->group_count - 1, l->tri_count, m, leaf_mask(f->flags),
			       prim_leaf_mask(s->scene, f));
		if (f->interior_texture != SCENE_NONE && mesh_has_clear_faces(s->scene, m))
			mask_clear(l, l->group_first[l->group_count - 1], l->tri_count);
	}
	l->count = l->tri_count;
	return STATUS_OK;
}

/* The frame of level 0: of the geometry with the camera, since its rays start there. */
static void world_frame(struct prim_level *l, const ald_box *world, const struct scene *s)
{
	ald_box all = *world;

	if (s->has_camera && prim_sane(s->camera.location))
		ald_box_join(&all, &(ald_box){ s->camera.location, s->camera.location });
	prim_level_frame(l, &all);
}

bool prim_same_frame(const struct prim_set *s, const struct scene *other)
{
	const struct prim_level *old = &s->level[0];
	struct prim_level l;

	world_frame(&l, &s->world, other);
	return l.scale == old->scale && l.size == old->size && !memcmp(&l.shift, &old->shift, sizeof(vec));
}

/* Instances that only cut stand behind all others. */
static enum status add_solids(struct prim_set *s, struct prim_level *l, struct diag *diag)
{
	enum status st = STATUS_OK;

	for (uint32_t i = 0; i < s->leaf_count; i++) {
		if (is_visible(s, &s->leaf[i]))
			add_prim(s, l, i);
	}
	for (uint32_t i = 0; i < s->leaf_count; i++) {
		if (is_infinite(s->leaf[i].kind) && !is_visible(s, &s->leaf[i]) &&
		    !is_cut_off(s, &s->leaf[i]))
			add_unbounded(s, l, i);
	}
	for (uint32_t i = 0; i < s->leaf_count && s->csg.node.count; i++) {
		const struct prim_leaf *f = &s->leaf[i];
		bool open = f->kind == SHAPE_CONE && s->scene->object[f->object].shape.cone.open;

		bool held = f->kind == SHAPE_ALGEBRAIC && f->item != SCENE_NONE;

		if (f->node != SCENE_NONE && (is_bounded(f->kind) || is_infinite(f->kind)) && !held &&
		    (open || !is_visible(s, f)))
			add_hidden(s, l, i);
	}
	for (uint32_t i = 0; i < s->leaf_count && !st; i++) {
		if (body_ops_of(s->leaf[i].kind))
			st = add_body(s, l, i, diag);
	}
	for (unsigned cut = 0; cut < 2; cut++) {
		for (uint32_t i = 0; i < s->leaf_count; i++) {
			if (s->leaf[i].level && s->leaf[i].cut == cut)
				add_instance(s, l, i);
		}
	}
	return st;
}

/* Where what shows of every leaf lies, as far as constructive solid geometry says. */
static void bound_csg(struct prim_set *s)
{
	for (uint32_t i = 0; i < s->leaf_count; i++) {
		struct prim_leaf *f = &s->leaf[i];
		ald_box own = ald_box_empty();
		struct csg_node *n;

		if (f->node == SCENE_NONE)
			continue;
		n = csg_at(&s->csg, f->node);
		if (leaf_box(s, f, &own))
			n->clip = own;
		if (!(f->flags & OBJECT_INVERSE) && f->kind != SHAPE_DISC)
			n->box = n->clip;
	}
	csg_join_boxes(&s->csg);
	for (uint32_t i = 0; i < s->csg.node.count; i++) {
		struct csg_node *n = csg_at(&s->csg, i);

		if (n->op == CSG_LEAF)
			n->clip = csg_clip(&s->csg, i, n->clip);
	}
}

/* Of all that shows. */
static void join_leaf(struct prim_set *s, struct prim_leaf *f)
{
	if (f->node == SCENE_NONE)
		leaf_box(s, f, &s->world);
	else if (!f->cut && box_is_sound(&csg_at(&s->csg, f->node)->clip))
		ald_box_join(&s->world, &csg_at(&s->csg, f->node)->clip);
}

/* From world coordinates to the level's, grown as for a primitive. */
static void place_csg(struct prim_set *s, const struct prim_level *l)
{
	for (uint32_t i = 0; i < s->csg.node.count; i++) {
		ald_box *b = &csg_at(&s->csg, i)->box;

		for (unsigned k = 0; k < 3; k++) {
			double shift = (&l->shift.x)[k];
			double lo = ((&b->lo.x)[k] - shift) * l->scale, hi = ((&b->hi.x)[k] - shift) * l->scale;
			double grow = 64 * (l->pad + ALD_U * (fabs(lo) + fabs(hi) + fabs(shift) * l->scale));

			(&b->lo.x)[k] = isfinite(lo) ? lo - grow : lo;
			(&b->hi.x)[k] = isfinite(hi) ? hi + grow : hi;
		}
	}
}

enum status layout_world(struct prim_set *s, struct diag *diag)
{
	struct prim_level *l = &s->level[0];
	struct sums n = { .groups = 0 };
	bool ok = true;
	enum status st;

	s->world = ald_box_empty();
	bound_csg(s);
	for (uint32_t i = 0; i < s->leaf_count; i++)
		join_leaf(s, &s->leaf[i]);
	world_frame(l, &s->world, s->scene);
	count_world(s, &n);
	s->unbounded = take(s, n.planes, sizeof(*s->unbounded), &ok);
	st = ok ? take_level(s, l, &n, true, diag) :
		  diag_no_memory(diag, "the list of planes", n.planes * sizeof(*s->unbounded));
	if (st)
		return st;
	st = bake_world(s, l, diag);
	if (st)
		return st;
	prim_narrow_vertices(l);
	l->box = ald_box_empty();
	join_triangles(l);
	place_csg(s, l);
	st = add_solids(s, l, diag);
	l->group_first[l->group_count] = l->count;
	return st;
}
