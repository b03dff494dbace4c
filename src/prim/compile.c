/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Scene to primitives: flattening, counting, and the order of things. layout.c fills what is counted
 * here.
 */
#include "prim/compile.h"

#include <stdlib.h>
#include <string.h>

#include "prim/layout.h"

/* A mesh shared by several leaves becomes instances only if that saves something. */
#define BAKE_TRIANGLES 64

#define FLAT_FLAGS                                                                                 \
	(OBJECT_NO_SHADOW | OBJECT_NO_IMAGE | OBJECT_NO_REFLECTION | OBJECT_HOLLOW |              \
	 OBJECT_DOUBLE_ILLUMINATE | OBJECT_NO_RADIOSITY)

struct walk { /* what a union hands down */
	struct xform place;
	uint32_t texture, interior_texture, interior;
	unsigned flags;
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

static void add_leaf(struct prim_set *s, uint32_t object, const struct walk *w)
{
	const struct object *o = &s->scene->object[object];

	s->leaf[s->leaf_count++] = (struct prim_leaf){
		.object = object,
		.solid = o->solid == SCENE_NONE ? object : o->solid,
		.kind = o->kind,
		.place = w->place,
		.mirrored = mat_det(&w->place.fwd) < 0,
		.texture = w->texture,
		.interior_texture = w->interior_texture,
		.interior = w->interior,
		.flags = w->flags,
		.mesh = o->kind == SHAPE_MESH ? o->shape.mesh : SCENE_NONE,
		.item = SCENE_NONE,
	};
}

static enum status flatten(struct prim_set *s, struct diag *diag)
{
	const struct scene *sc = s->scene;
	size_t bytes = mem_product(sc->object_count + 1, sizeof(struct frame));
	struct frame *stack = mem_alloc(s->book, "geometry", bytes);
	const struct walk top = { xform_identity, SCENE_NONE, SCENE_NONE, SCENE_NONE, 0 };
	uint32_t depth = 1;

	s->leaf = mem_alloc(s->book, "geometry", mem_product(sc->object_count + 1, sizeof(*s->leaf)));
	if (!stack || !s->leaf) {
		mem_free(stack);
		return diag_no_memory(diag, "the list of objects", bytes);
	}
	stack[0] = (struct frame){ sc->first_root, top };
	while (depth) {
		struct frame *f = &stack[depth - 1];
		uint32_t i = f->next;
		struct walk w;

		if (i == SCENE_NONE) {
			depth--;
			continue;
		}
		f->next = sc->object[i].next_sibling;
		w = inherit(&f->walk, &sc->object[i]);
		if (sc->object[i].kind == SHAPE_UNION)
			stack[depth++] = (struct frame){ sc->object[i].first_child, w };
		else
			add_leaf(s, i, &w);
	}
	mem_free(stack);
	return STATUS_OK;
}

/* Give meshes that are worth it a level of their own. Those with an interior_texture are baked: it changes
 * which of their faces cast which shadows. */
static enum status choose_levels(struct prim_set *s, struct diag *diag)
{
	const struct scene *sc = s->scene;
	size_t bytes = mem_product(sc->mesh_count + 1, sizeof(uint32_t));
	uint32_t *uses = mem_zalloc(s->book, "geometry", bytes), levels = 1;

	if (!uses)
		return diag_no_memory(diag, "the list of meshes", bytes);
	for (uint32_t i = 0; i < s->leaf_count; i++) {
		if (s->leaf[i].kind == SHAPE_MESH && s->leaf[i].interior_texture == SCENE_NONE)
			uses[s->leaf[i].mesh]++;
	}
	for (uint32_t m = 0; m < sc->mesh_count; m++) {
		bool shared = uses[m] > 1 && sc->mesh[m].triangle_count > BAKE_TRIANGLES;

		uses[m] = shared ? levels++ : 0;
	}
	for (uint32_t i = 0; i < s->leaf_count; i++) {
		if (s->leaf[i].kind == SHAPE_MESH && s->leaf[i].interior_texture == SCENE_NONE)
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

static void report_dropped(const struct prim_set *s, struct diag *diag)
{
	if (s->dropped)
		diag_report(diag, DIAG_WARNING, NULL,
			    "%llu primitive%s without area, or too large for a double, left out",
			    (unsigned long long)s->dropped, s->dropped == 1 ? "" : "s");
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
		report_dropped(s, diag);
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
