/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Putting objects into the scene: what a union hands down, #default's texture for what has none, and
 * the report of what is used and cannot be rendered.
 *
 * POV-Ray decides these things where an object stands in the scene itself, not where it was declared;
 * so a #default between the two counts.
 */
#include <config.h>

#include "read/pov/items.h"

#include <string.h>

#define HANDED_DOWN ((unsigned)(OBJECT_HOLLOW | OBJECT_DOUBLE_ILLUMINATE))

/* What an object gets from the unions around it. */
struct context {
	struct pov_texture *texture, *interior_texture;
	struct xform texture_place, interior_texture_place, interior_place; /* their coordinates to the scene's */
	struct pov_interior *interior;
	unsigned flags; /* all of the unions', to be added */
	unsigned hollow, hollow_given;
	unsigned double_illuminate, double_given;
	struct xform place; /* to the scene */
	uint32_t solid; /* the union that gave the interior, or SCENE_NONE */
	bool cut; /* only its inside counts */
	bool solids; /* its inside counts too: solids are made of solids */
	uint32_t group; /* of lights that stand here themselves */
	uint32_t light_set; /* of all else */
	bool declared; /* something around has a name */
};

static bool use_object(struct pov *, struct pov_object *, const struct context *, uint32_t *index);

/* Before any of them is made. */
static bool count_objects(struct pov *p, const struct pov_object *o)
{
	uint64_t limit = pov_state(p)->object_limit;

	pov_state(p)->objects += o->weight;
	if (pov_state(p)->objects <= limit)
		return true;
	pov_fail_at(p, &o->object.pos, "too many objects: the limit is %llu (raise it with --limit objects=N)",
		    (unsigned long long)limit);
	return false;
}

static bool use_light(struct pov *p, const struct pov_object *o, const struct mat *place, uint32_t group)
{
	uint32_t i = scene_add_light(pov_scene(p));
	struct light *l;
	vec at, to;

	if (i == SCENE_NONE)
		return pov_no_memory(p);
	l = &pov_scene(p)->light[i];
	*l = *o->light;
	l->group = group;
	if (mat_is_identity(place))
		return true;
	at = mat_point(place, l->location);
	to = mat_dir(place, vec_scale(l->direction, l->axis_length));
	l->location = at;
	l->axis_length = vec_length(to);
	l->direction = vec_unit(to);
	l->axis1 = mat_dir(place, l->axis1);
	l->axis2 = mat_dir(place, l->axis2);
	if (!vec_finite(at) || !vec_finite(to) || !vec_finite(l->axis1) || !vec_finite(l->axis2)) {
		pov_fail_at(p, &o->object.pos, "the light's transforms make its vectors too large");
		return false;
	}
	return true;
}

/* As in POV-Ray, an interior that does not say what it bends splits nothing. */
static void check_dispersion(struct pov *p, const struct pov_interior *in, struct interior *made)
{
	if (in->bends || made->dispersion == 1)
		return;
	made->dispersion = 1;
	pov_warn(p, &in->splits, "dispersion without ior does nothing, as in POV-Ray; add ior before it");
}

/* Each place of an interior with media is one of its own. As in POV-Ray, media fill hollow objects only. */
static uint32_t use_interior(struct pov *p, struct pov_interior *in, bool hollow, const struct xform *place)
{
	struct scene *s = pov_scene(p);
	uint32_t count = in && hollow ? in->media_count : 0, index;
	struct interior *made;

	if (!in || pov_failed(p) || !pov_lack_use(p, &in->lack))
		return SCENE_NONE;
	if (!count && in->index != SCENE_NONE)
		return in->index;
	index = scene_add_interior(s);
	if (index == SCENE_NONE) {
		pov_no_memory(p);
		return SCENE_NONE;
	}
	made = &s->interior[index];
	*made = in->interior;
	if (fabs(in->interior.fade_distance) < 1e-10)
		made->fade_distance = 0;
	check_dispersion(p, in, made);
	if (!count)
		in->index = index;
	else if (pov_use_media(p, count, in->media, place, &made->media))
		made->media_count = count;
	return index;
}

/* A texture of an object, which may want it at (u, v, 0). */
static uint32_t use_texture(struct pov *p, struct pov_texture *t, bool uv)
{
	if (uv)
		t = pov_texture_with_uv(p, t);
	return t ? pov_use_texture(p, t) : SCENE_NONE;
}

/* The mesh's indices into its texture_list become the scene's, once. */
static bool use_mesh_textures(struct pov *p, struct pov_mesh *m, bool uv)
{
	struct mesh *mesh = &pov_scene(p)->mesh[m->index];
	size_t n = (size_t)mesh->triangle_count * mesh->textures_per_face;
	uint32_t *map;

	if (m->resolved || !mesh->texture)
		return true;
	map = pov_new(p, (m->list_count + 1) * sizeof(*map));
	if (!map)
		return false;
	for (uint32_t i = 0; i < m->list_count; i++)
		map[i] = SCENE_NONE;
	for (size_t i = 0; i < n && !pov_failed(p); i++) {
		uint32_t t = mesh->texture[i];

		if (t == SCENE_NONE)
			continue;
		if (map[t] == SCENE_NONE)
			map[t] = use_texture(p, m->list[t], uv);
		mesh->texture[i] = map[t];
	}
	m->resolved = true;
	return !pov_failed(p);
}

/* Where a texture lies, in the scene's arena; NULL: nowhere in particular. */
static struct xform *use_place(struct pov *p, uint32_t texture, const struct xform *place)
{
	struct xform *x;

	if (texture == SCENE_NONE || pov_scene(p)->texture[texture].plain || mat_is_identity(&place->fwd))
		return NULL;
	x = (void *)arena_memdup(&pov_scene(p)->arena, place, sizeof(*place));
	if (!x)
		pov_no_memory(p);
	return x;
}

/* Components' textures lie where the object does, so that a blob that is used again is another one, unless
 * no component has a texture. */
static bool use_blob(struct pov *p, struct pov_blob *b, bool uv, const struct xform *place,
		     uint32_t *index)
{
	struct scene *s = pov_scene(p);
	uint32_t count = s->blob[b->index].count, i = b->index, textures = 0;

	for (uint32_t k = 0; k < count; k++)
		textures += b->texture[k] != NULL;
	*index = i;
	if (!textures)
		return true;
	if (b->used) {
		i = scene_add_blob(s, count);
		if (i == SCENE_NONE)
			return pov_no_memory(p);
		s->blob[i].threshold = s->blob[b->index].threshold;
		memcpy(s->blob[i].part, s->blob[b->index].part, count * sizeof(*s->blob[i].part));
	}
	for (uint32_t k = 0; k < count && !pov_failed(p); k++) {
		struct xform x = xform_mul(&b->texture_place[k], place);
		uint32_t t;

		if (!b->texture[k])
			continue;
		t = use_texture(p, b->texture[k], uv);
		s->blob[i].part[k].texture = t;
		s->blob[i].part[k].texture_place = use_place(p, t, &x);
	}
	b->used = true;
	*index = i;
	return !pov_failed(p);
}

/* Lathes and prisms have surface coordinates of their own, which are not there yet. */
static bool check_uv(struct pov *p, const struct pov_object *o, uint32_t texture)
{
	bool lathe = o->object.kind == SHAPE_LATHE;

	if ((!lathe && o->object.kind != SHAPE_PRISM) || texture == SCENE_NONE ||
	    !pov_scene(p)->texture[texture].wants_uv)
		return true;
	return pov_unsupported(p, &o->object.pos, lathe ? "uv_mapping of a lathe" : "uv_mapping of a prism", NULL);
}

/* Flags, textures and interior of a shape that is no union. */
static bool use_look(struct pov *p, struct pov_object *o, const struct context *c, struct object *out)
{
	const struct xform *place = &c->texture_place;
	struct pov_texture *t = c->texture;

	if (o->mesh && o->mesh->uniform) {
		t = o->mesh->uniform;
		place = &c->place; /* faces' own textures move with the mesh */
	}
	if (o->mesh && !use_mesh_textures(p, o->mesh, o->uv))
		return false;
	if (o->blob && !use_blob(p, o->blob, o->uv, &c->place, &out->shape.blob))
		return false;
	/* A mesh whose faces all have textures of their own needs none. */
	if (!o->mesh || o->mesh->uniform || o->mesh->partial)
		out->texture = use_texture(p, t ? t : pov_default_texture(p), o->uv);
	if (c->interior_texture)
		out->interior_texture = use_texture(p, c->interior_texture, o->uv);
	if (!check_uv(p, o, out->texture) || !check_uv(p, o, out->interior_texture))
		return false;
	out->texture_place = use_place(p, out->texture, place);
	out->interior_texture_place = use_place(p, out->interior_texture, &c->interior_texture_place);
	out->flags |= c->flags | c->hollow | c->double_illuminate;
	out->light_set = c->light_set;
	out->interior = use_interior(p, c->interior, c->hollow, &c->interior_place);
	return !pov_failed(p);
}

/* c: of what surrounds o; inner: of what o surrounds, and of o itself. */
static void enter(struct pov_object *o, const struct context *c, struct context *inner)
{
	unsigned own = o->object.flags;

	*inner = *c;
	if (o->texture) {
		inner->texture = o->texture;
		inner->texture_place = xform_mul(&o->texture_place, &c->place);
	}
	if (o->interior_texture) {
		inner->interior_texture = o->interior_texture;
		inner->interior_texture_place = xform_mul(&o->interior_texture_place, &c->place);
	}
	if (o->interior) {
		inner->interior = o->interior;
		inner->interior_place = xform_mul(&o->interior_place, &c->place);
	}
	inner->flags |= own & ~HANDED_DOWN & ~(unsigned)OBJECT_INVERSE;
	/* hollow: the innermost that says so; double_illuminate: the outermost, as POV-Ray sets it in
	 * the whole tree when it reads the word. */
	if (o->given & OBJECT_HOLLOW)
		inner->hollow = own & OBJECT_HOLLOW;
	if (!c->double_given && o->given & OBJECT_DOUBLE_ILLUMINATE) {
		inner->double_given = OBJECT_DOUBLE_ILLUMINATE;
		inner->double_illuminate = own & OBJECT_DOUBLE_ILLUMINATE;
	}
	inner->place = xform_mul(&o->object.place, &c->place);
	inner->declared |= o->declared;
	inner->solids |= o->object.kind > SHAPE_UNION;
	inner->group = o->lamp ? c->group : SCENE_NONE;
}

static uint32_t add_light_set(struct pov *p, uint32_t group, bool global)
{
	uint32_t i = scene_add_light_set(pov_scene(p));

	if (i == SCENE_NONE) {
		pov_no_memory(p);
		return i;
	}
	pov_scene(p)->light_set[i] = (struct light_set){ group == SCENE_NONE ? i : group, global };
	return i;
}

/*
 * Lights of a light_group shine on all that is in it, but not on what is in a group within. Of groups in groups
 * the outermost says whether the lights in no group do. Only lights that stand directly in a group are its own:
 * those in a union there are in no group. What a group's lamp looks like is lit by the lights in no group as
 * well. All this is measured; what POV-Ray does with groups in groups that it copies depends on how deep they
 * are.
 */
static bool enter_group(struct pov *p, const struct pov_object *o, const struct context *c,
			struct context *inner)
{
	const char *const within = "a light_group in another, used by name,";
	bool global = o->global_lights;

	if (o->lamp && c->group != SCENE_NONE) {
		inner->light_set = add_light_set(p, c->group, true);
		return inner->light_set != SCENE_NONE;
	}
	if (!o->group)
		return true;
	if (c->light_set != SCENE_NONE) {
		global = pov_scene(p)->light_set[c->light_set].global;
		if (inner->declared && !pov_unsupported(p, &o->object.pos, within, "write it where it is used"))
			return false;
	}
	inner->group = inner->light_set = add_light_set(p, SCENE_NONE, global);
	return inner->group != SCENE_NONE;
}

static bool use_children(struct pov *p, struct pov_object *o, const struct context *inner,
			 uint32_t parent)
{
	uint32_t last = SCENE_NONE;

	for (struct pov_child *child = o->first; child; child = child->next) {
		struct object *object;
		uint32_t i;

		if (!use_object(p, child->object, inner, &i))
			return false;
		if (i == SCENE_NONE)
			continue; /* a light, or left out */
		object = pov_scene(p)->object;
		if (last == SCENE_NONE)
			object[parent].first_child = i;
		else
			object[last].next_sibling = i;
		last = i;
	}
	return true;
}

/* Each clip in a union that moves it as the object was moved since. */
static bool use_clips(struct pov *p, struct pov_object *o, const struct context *c, uint32_t index)
{
	for (struct pov_child *clip = o->clip; clip; clip = clip->next) {
		struct xform undo = { clip->before.inv, clip->before.fwd };
		struct xform since = xform_mul(&undo, &o->object.place);
		struct context cut = { .place = xform_mul(&since, &c->place), .cut = true, .solid = SCENE_NONE,
				       .group = SCENE_NONE, .light_set = SCENE_NONE };
		uint32_t i, wrap;

		cut.texture_place = cut.interior_texture_place = xform_identity;
		if (!use_object(p, clip->object, &cut, &i))
			return false;
		if (i == SCENE_NONE)
			continue;
		wrap = scene_add_object(pov_scene(p));
		if (wrap == SCENE_NONE)
			return pov_no_memory(p);
		pov_scene(p)->object[wrap].kind = SHAPE_UNION;
		pov_scene(p)->object[wrap].place = since;
		pov_scene(p)->object[wrap].first_child = i;
		pov_scene(p)->object[wrap].next_sibling = pov_scene(p)->object[index].first_clip;
		pov_scene(p)->object[index].first_clip = wrap;
	}
	return true;
}

static bool check_place(struct pov *p, const struct pov_object *o)
{
	const struct mat *m[] = { &o->object.place.fwd, &o->object.place.inv };

	for (int k = 0; k < 2; k++) {
		for (int i = 0; i < 4; i++) {
			if (isfinite(m[k]->m[i][0]) && isfinite(m[k]->m[i][1]) &&
			    isfinite(m[k]->m[i][2]))
				continue;
			pov_fail_at(p, &o->object.pos, "the object's transforms have no finite inverse");
			return false;
		}
	}
	return true;
}

/* What the light that was added last is projected through: among the scene's objects, and seen by it only. */
static bool use_through(struct pov *p, struct pov_object *o, const struct context *inner)
{
	struct context c = *inner;
	uint32_t light = pov_scene(p)->light_count - 1, i, wrap;

	if (!o->through || inner->cut)
		return true;
	pov_scene(p)->light[light].projected = true;
	c.light_set = light;
	if (!use_object(p, o->through, &c, &i))
		return false;
	if (i == SCENE_NONE)
		return true;
	wrap = scene_add_object(pov_scene(p));
	if (wrap == SCENE_NONE)
		return pov_no_memory(p);
	pov_scene(p)->object[wrap].kind = SHAPE_UNION;
	pov_scene(p)->object[wrap].place = inner->place;
	pov_scene(p)->object[wrap].first_child = i;
	scene_add_root(pov_scene(p), wrap);
	return true;
}

static bool check_water(struct pov *p, const struct pov_object *o, const struct context *c)
{
	return !o->water || !(c->solids || c->cut) ||
	       pov_unsupported(p, &o->object.pos, "a height_field with water_level as a part of a solid",
			       "leave out water_level, or cut with a box instead");
}

/* *index: SCENE_NONE if it is a light or, with --lenient, something left out. */
static bool use_object(struct pov *p, struct pov_object *o, const struct context *c, uint32_t *index)
{
	struct context inner;
	struct object *out;

	*index = SCENE_NONE;
	if (!check_place(p, o) || !check_water(p, o, c))
		return false;
	if (o->lack.construct) {
		if (!pov_lack_use(p, &o->lack))
			return false;
		if (!o->first && !o->light && o->object.kind == SHAPE_UNION)
			return true;
	}
	enter(o, c, &inner);
	if (o->light)
		return use_light(p, o, &inner.place.fwd, c->group) && use_through(p, o, &inner);
	if (!enter_group(p, o, c, &inner))
		return false;
	if (o->mesh && !pov_scene(p)->mesh[o->mesh->index].triangle_count)
		return true; /* all its triangles were without area */
	*index = scene_add_object(pov_scene(p));
	if (*index == SCENE_NONE)
		return pov_no_memory(p);
	out = &pov_scene(p)->object[*index];
	out->kind = o->object.kind;
	out->place = o->object.place;
	out->shape = o->object.shape;
	out->pos = o->object.pos;
	if (o->mesh)
		out->shape.mesh = o->mesh->index;
	if (o->interior)
		inner.solid = out->kind >= SHAPE_UNION ? *index : SCENE_NONE;
	out->solid = inner.solid;
	out->flags = o->object.flags & OBJECT_INVERSE;
	if (o->clip && !use_clips(p, o, c, *index))
		return false;
	if (o->object.kind >= SHAPE_UNION)
		return use_children(p, o, &inner, *index);
	return c->cut || use_look(p, o, &inner, &pov_scene(p)->object[*index]);
}

void pov_use_object(struct pov *p, struct pov_object *o)
{
	struct context c = { .place = xform_identity,
			     .texture_place = xform_identity,
			     .interior_texture_place = xform_identity,
			     .interior_place = xform_identity,
			     .solid = SCENE_NONE,
			     .group = SCENE_NONE,
			     .light_set = SCENE_NONE };
	uint32_t index;

	if (!o || pov_failed(p) || !count_objects(p, o))
		return;
	if (use_object(p, o, &c, &index) && index != SCENE_NONE)
		scene_add_root(pov_scene(p), index);
}
