/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Scene to primitives: flattening, counting, and the order of things. layout.c fills what is counted
 * here.
 */
#include "prim/compile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "prim/layout.h"

/* A mesh shared by several leaves becomes instances only if that saves something. */
#define BAKE_TRIANGLES 64

#define FLAT_FLAGS                                                                                 \
	(OBJECT_NO_SHADOW | OBJECT_NO_IMAGE | OBJECT_NO_REFLECTION | OBJECT_HOLLOW |              \
	 OBJECT_DOUBLE_ILLUMINATE | OBJECT_NO_RADIOSITY | OBJECT_PROJECTED)

struct walk { /* what a union hands down */
	struct xform place;
	uint32_t texture, interior_texture, interior;
	unsigned flags;
	uint32_t node; /* of constructive solid geometry, that what is below hangs on; or SCENE_NONE */
	uint32_t solid; /* the outermost object of it */
	bool cut;
};

static struct walk inherit(const struct walk *up, const struct object *o)
{
	struct walk w = *up;

	w.place = xform_mul(&o->place, &up->place);
	if (o->texture != SCENE_NONE)
		w.texture = o->texture;
	if (o->interior_texture != SCENE_NONE)
		w.interior_texture = o->interior_texture;
	if (o->interior != SCENE_NONE)
		w.interior = o->interior;
	w.flags = (up->flags & FLAT_FLAGS) | o->flags;
	if (up->flags & OBJECT_INVERSE) /* twice is not at all */
		w.flags ^= OBJECT_INVERSE;
	return w;
}

/* Unions nest as deep as the scene likes: the way back is kept in a stack on the heap. */
struct frame {
	uint32_t next;
	struct walk walk;
};

static bool push(struct prim_set *s, struct buf *stack, uint32_t first, const struct walk *w)
{
	if (!buf_reserve(stack, s->book, "geometry", 1))
		return false;
	*BUF_AT(stack, struct frame, stack->count) = (struct frame){ first, *w };
	stack->count++;
	return true;
}

static void add_leaf(struct prim_set *s, uint32_t object, const struct walk *w)
{
	const struct object *o = &s->scene->object[object];
	uint32_t solid = w->node != SCENE_NONE && w->interior == SCENE_NONE ? w->solid : object;

	if (w->node != SCENE_NONE)
		csg_at(&s->csg, w->node)->leaf = s->leaf_count;
	s->leaf[s->leaf_count++] = (struct prim_leaf){
		.object = object,
		.solid = o->solid == SCENE_NONE ? solid : o->solid,
		.kind = o->kind,
		.place = w->place,
		.mirrored = mat_det(&w->place.fwd) < 0,
		.texture = w->texture,
		.interior_texture = w->interior_texture,
		.interior = w->interior,
		.flags = w->flags,
		.mesh = o->kind == SHAPE_MESH ? o->shape.mesh : SCENE_NONE,
		.node = w->node,
		.cut = w->cut,
		.item = SCENE_NONE,
	};
}

static enum csg_op node_op(enum shape_kind k)
{
	return k == SHAPE_UNION	       ? CSG_UNION :
	       k == SHAPE_MERGE	       ? CSG_MERGE :
	       k == SHAPE_INTERSECTION ? CSG_INTERSECTION :
					 CSG_LEAF;
}

/* The nodes of an object, if it stands in constructive solid geometry or begins some. What clips it hangs on
 * an intersection above it, which no inverse turns over. */
static bool add_nodes(struct prim_set *s, struct buf *stack, uint32_t object, enum shape_kind kind,
		      const struct walk *up, struct walk *w)
{
	const struct object *o = &s->scene->object[object];
	bool clipped = o->first_clip != SCENE_NONE;

	if (up->node == SCENE_NONE && !clipped && kind != SHAPE_MERGE && kind != SHAPE_INTERSECTION)
		return true;
	if (up->node == SCENE_NONE)
		w->solid = object;
	if (clipped) {
		struct walk clip = *up;

		w->node = clip.node = csg_add(&s->csg, s->book, CSG_INTERSECTION, up->node);
		clip.flags &= ~(unsigned)OBJECT_INVERSE;
		clip.cut = true;
		if (clip.node == SCENE_NONE || !push(s, stack, o->first_clip, &clip))
			return false;
	}
	w->node = csg_add(&s->csg, s->book, node_op(kind), w->node);
	return w->node != SCENE_NONE;
}

static bool flatten_one(struct prim_set *s, struct buf *stack, uint32_t i, const struct walk *up)
{
	const struct object *o = &s->scene->object[i];
	enum shape_kind kind = up->flags & OBJECT_INVERSE ? shape_inverse(o->kind) : o->kind;
	struct walk w = inherit(up, o);

	if (!add_nodes(s, stack, i, kind, up, &w))
		return false;
	if (kind >= SHAPE_UNION)
		return push(s, stack, o->first_child, &w);
	add_leaf(s, i, &w);
	return true;
}

static enum status flatten(struct prim_set *s, struct diag *diag)
{
	const struct scene *sc = s->scene;
	const struct walk top = { .place = xform_identity, .texture = SCENE_NONE,
				  .interior_texture = SCENE_NONE, .interior = SCENE_NONE,
				  .node = SCENE_NONE, .solid = SCENE_NONE };
	struct buf stack = { .size = sizeof(struct frame) };
	bool ok;

	s->leaf = mem_alloc(s->book, "geometry", mem_product(sc->object_count + 1, sizeof(*s->leaf)));
	ok = s->leaf && push(s, &stack, sc->first_root, &top);
	while (ok && stack.count) {
		struct frame *f = BUF_AT(&stack, struct frame, stack.count - 1);
		const struct walk up = f->walk;
		uint32_t i = f->next;

		if (i == SCENE_NONE) {
			stack.count--;
			continue;
		}
		f->next = sc->object[i].next_sibling;
		ok = flatten_one(s, &stack, i, &up);
	}
	buf_release(&stack);
	return ok ? STATUS_OK : diag_no_memory(diag, "the list of objects", sc->object_count * sizeof(*s->leaf));
}

/* Instances are asked as one, which constructive solid geometry needs. Meshes with an interior_texture are
 * baked otherwise: it changes which of their faces cast which shadows. */
static bool may_share(const struct prim_leaf *f)
{
	return f->kind == SHAPE_MESH && (f->interior_texture == SCENE_NONE || f->node != SCENE_NONE);
}

/* Give meshes that need it or are worth it a level of their own. */
static enum status choose_levels(struct prim_set *s, struct diag *diag)
{
	const struct scene *sc = s->scene;
	size_t bytes = mem_product(sc->mesh_count + 1, sizeof(uint32_t));
	uint32_t *uses = mem_zalloc(s->book, "geometry", bytes), levels = 1;

	if (!uses)
		return diag_no_memory(diag, "the list of meshes", bytes);
	for (uint32_t i = 0; i < s->leaf_count; i++) {
		if (may_share(&s->leaf[i]))
			uses[s->leaf[i].mesh] += s->leaf[i].node == SCENE_NONE ? 1 : BAKE_TRIANGLES;
	}
	for (uint32_t m = 0; m < sc->mesh_count; m++) {
		bool shared = uses[m] > 1 && sc->mesh[m].triangle_count > BAKE_TRIANGLES;

		uses[m] = shared || uses[m] >= BAKE_TRIANGLES ? levels++ : 0;
	}
	for (uint32_t i = 0; i < s->leaf_count; i++) {
		if (may_share(&s->leaf[i]))
			s->leaf[i].level = uses[s->leaf[i].mesh];
	}
	mem_free(uses);
	bytes = mem_product(levels, sizeof(*s->level));
	s->level = mem_zalloc(s->book, "geometry", bytes);
	if (!s->level)
		return diag_no_memory(diag, "the levels of instances", bytes);
	s->level_count = levels;
	return STATUS_OK;
}

void prim_drop(struct prim_set *s, uint32_t leaf, uint64_t count, uint32_t face)
{
	uint32_t object = s->leaf[leaf].object, n = (uint32_t)s->dropped_objects;

	s->dropped += count;
	if (s->dropped_objects && s->last_dropped == leaf) {
		if (n <= PRIM_DROPPED_SHOWN)
			s->dropped_first[n - 1].count += count;
		return;
	}
	s->last_dropped = leaf;
	if (s->dropped_objects++ < PRIM_DROPPED_SHOWN)
		s->dropped_first[n] = (struct prim_dropped){ object, face, count };
}

/* "3 triangles of the mesh in a.pov:12, the first being number 7" */
static int describe_dropped(const struct prim_set *s, const struct prim_dropped *p, char *out, size_t size)
{
	const struct object *o = &s->scene->object[p->object];
	const char *kind = shape_name(o->kind);
	char where[512];

	if (o->pos.file)
		snprintf(where, sizeof(where), "%s in %s:%u", kind, o->pos.file, o->pos.line);
	else
		snprintf(where, sizeof(where), "%s that is object %u", kind, p->object);
	if (o->kind == SHAPE_MESH)
		return snprintf(out, size, "%llu triangle%s of the %s, %snumber %u",
				(unsigned long long)p->count, p->count == 1 ? "" : "s", where,
				p->count == 1 ? "" : "the first being ", p->face);
	return snprintf(out, size, "the %s", where);
}

void prim_report_dropped(const struct prim_set *s, struct diag *diag)
{
	char list[4096];
	size_t n = 0;

	if (!s->dropped)
		return;
	for (uint32_t i = 0; i < s->dropped_objects && i < PRIM_DROPPED_SHOWN && n + 3 < sizeof(list); i++) {
		int wrote;

		n += (size_t)snprintf(list + n, sizeof(list) - n, "%s", i ? "; " : "");
		wrote = describe_dropped(s, &s->dropped_first[i], list + n, sizeof(list) - n);
		n += wrote < 0 ? 0 : (size_t)wrote;
	}
	if (s->dropped_objects > PRIM_DROPPED_SHOWN && n < sizeof(list))
		snprintf(list + n, sizeof(list) - n, "; and of %llu more object%s",
			 (unsigned long long)(s->dropped_objects - PRIM_DROPPED_SHOWN),
			 s->dropped_objects - PRIM_DROPPED_SHOWN == 1 ? "" : "s");
	diag_report(diag, DIAG_WARNING, NULL,
		    "%llu primitive%s without area, or too large, left out: %s",
		    (unsigned long long)s->dropped, s->dropped == 1 ? "" : "s", list);
}

enum status prim_compile(struct prim_set *s, const struct scene *scene, struct mem_book *book,
			 struct diag *diag)
{
	enum status st;

	*s = (struct prim_set){ .scene = scene, .book = book };
	arena_init(&s->arena, book, "geometry");
	st = flatten(s, diag);
	if (!st)
		st = choose_levels(s, diag);
	for (uint32_t i = 1; !st && i < s->level_count; i++)
		st = layout_mesh_level(s, i, diag);
	if (!st)
		st = layout_world(s, diag);
	if (st)
		prim_set_release(s);
	else
		prim_report_dropped(s, diag);
	return st;
}

void prim_set_release(struct prim_set *s)
{
	for (uint32_t i = 0; i < s->level_count; i++) {
		struct prim_level *l = &s->level[i];

		for (uint32_t g = 0; g < l->group_count; g++)
			mem_free(l->group[g].face);
		mem_free(l->group_first);
		mem_free(l->group);
		mem_free(l->vertex);
		mem_free(l->index);
		mem_free(l->mask);
		mem_free(l->prim);
		mem_free(l->piece);
		mem_free(l->body);
		mem_free(l->instance);
	}
	mem_free(s->level);
	mem_free(s->leaf);
	mem_free(s->unbounded);
	for (unsigned k = 0; k < SHAPE_KINDS; k++)
		mem_free(s->body_data[k]);
	arena_release(&s->arena);
	buf_release(&s->csg.node);
	*s = (struct prim_set){ .scene = NULL };
}

/* POV-Ray lets light through solids of which one side is clear, but not through a mesh whose textures
 * are opaque, whatever its interior_texture is: measured. */
unsigned prim_leaf_mask(const struct scene *s, const struct prim_leaf *f)
{
	unsigned mask = prim_texture_mask(s, f->texture);

	if (f->kind == SHAPE_BLOB) {
		const struct blob *b = &s->blob[s->object[f->object].shape.blob];

		for (uint32_t i = 0; i < b->count; i++) {
			if (prim_texture_mask(s, b->part[i].texture) == PRIM_SHADOW_CLEAR)
				mask = PRIM_SHADOW_CLEAR;
		}
	}
	if (f->kind != SHAPE_MESH && f->interior_texture != SCENE_NONE &&
	    texture_translucent(&s->texture[f->interior_texture]))
		mask = PRIM_SHADOW_CLEAR;
	return mask;
}

unsigned prim_texture_mask(const struct scene *s, uint32_t texture)
{
	bool clear = texture != SCENE_NONE && texture_translucent(&s->texture[texture]);

	return clear ? PRIM_SHADOW_CLEAR : PRIM_SHADOW_OPAQUE;
}
