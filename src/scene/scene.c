/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "scene/function.h"
#include "scene/hash.h"
#include "scene/scene.h"

#include <string.h>

void scene_init(struct scene *s, struct mem_book *book)
{
	memset(s, 0, sizeof(*s));
	s->book = book;
	arena_init(&s->arena, book, "scene");
	s->version = 370;
	s->assumed_gamma = 1;
	s->max_trace_level = 5;
	s->number_of_waves = 10;
	s->adc_bailout = 1.0 / 255.0;
	s->ambient_light = rgb_make(1, 1, 1);
	s->irid_wavelength = rgb_make(0.70, 0.52, 0.48);
	s->radiosity = (struct radiosity){ .recursion_limit = 2,
					   .brightness = 1,
					   .adc_bailout = 0.01,
					   .max_sample = -1,
					   .count = 35,
					   .nearest_count = 5,
					   .error_bound = 1.8,
					   .low_error_factor = 0.5,
					   .minimum_reuse = 0.015,
					   .maximum_reuse = 0.2,
					   .pretrace_start = 0.08,
					   .pretrace_end = 0.04 };
	s->subsurface = (struct subsurface){ .samples = 50, .single_samples = 50, .mm_per_unit = 10 };
	s->first_root = s->last_root = SCENE_NONE;
}

void scene_release(struct scene *s)
{
	for (uint32_t i = 0; i < s->mesh_count; i++) {
		mem_free(s->mesh[i].vertex);
		mem_free(s->mesh[i].index);
		mem_free(s->mesh[i].normal);
		mem_free(s->mesh[i].normal_index);
		mem_free(s->mesh[i].texture);
		mem_free(s->mesh[i].uv);
		mem_free(s->mesh[i].uv_index);
	}
	for (uint32_t i = 0; i < s->picture_count; i++) {
		if (s->picture[i] && !s->picture[i]->kept)
			mem_free(s->picture[i]->sample);
	}
	for (struct mip *m = s->mip; m; m = m->next) {
		for (uint32_t i = 0; i < m->count; i++)
			mem_free(m->level[i].texel);
	}
	mem_free(s->picture);
	mem_free(s->fog);
	mem_free(s->rainbow);
	mem_free(s->light);
	mem_free(s->light_set);
	mem_free(s->texture);
	mem_free(s->pattern);
	mem_free(s->map);
	mem_free(s->interior);
	mem_free(s->mesh);
	mem_free(s->sweep);
	mem_free(s->blob);
	mem_free(s->lathe);
	mem_free(s->prism);
	mem_free(s->isosurface);
	mem_free(s->algebraic);
	mem_free(s->object);
	arena_release(&s->arena);
}

/* Room for one more in a growing array, cleared; its index or SCENE_NONE. */
static uint32_t grow(struct scene *s, void **array, uint32_t *count, uint32_t *room, size_t size)
{
	if (*count == *room) {
		uint32_t more = *room ? *room * 2 : 8;
		void *p;

		if (more <= *room)
			return SCENE_NONE;
		p = *array ? mem_realloc(*array, mem_product(more, size)) :
			     mem_alloc(s->book, "scene", mem_product(more, size));
		if (!p)
			return SCENE_NONE;
		*array = p;
		*room = more;
	}
	memset((char *)*array + *count * size, 0, size);
	return (*count)++;
}

uint32_t scene_add_fog(struct scene *s)
{
	void *p = s->fog;
	uint32_t i = grow(s, &p, &s->fog_count, &s->fog_room, sizeof(*s->fog));

	s->fog = p;
	return i;
}

uint32_t scene_add_rainbow(struct scene *s, uint32_t entries)
{
	struct map_entry *entry = arena_zalloc(&s->arena, mem_product(entries, sizeof(*entry)));
	void *p = s->rainbow;
	uint32_t i;

	if (!entry)
		return SCENE_NONE;
	i = grow(s, &p, &s->rainbow_count, &s->rainbow_room, sizeof(*s->rainbow));
	s->rainbow = p;
	if (i != SCENE_NONE)
		s->rainbow[i] = (struct rainbow){ .count = entries, .entry = entry };
	return i;
}

uint32_t scene_add_light(struct scene *s)
{
	void *p = s->light;
	uint32_t i = grow(s, &p, &s->light_count, &s->light_room, sizeof(*s->light));

	s->light = p;
	if (i != SCENE_NONE)
		s->light[i].group = SCENE_NONE;
	return i;
}

uint32_t scene_add_light_set(struct scene *s)
{
	void *p = s->light_set;
	uint32_t i = grow(s, &p, &s->light_set_count, &s->light_set_room, sizeof(*s->light_set));

	s->light_set = p;
	return i;
}

uint32_t scene_add_texture(struct scene *s, uint32_t layers)
{
	struct layer *layer = arena_zalloc(&s->arena, mem_product(layers, sizeof(*layer)));
	void *p = s->texture;
	uint32_t i;

	if (!layer)
		return SCENE_NONE;
	i = grow(s, &p, &s->texture_count, &s->texture_room, sizeof(*s->texture));
	s->texture = p;
	if (i != SCENE_NONE)
		s->texture[i] = (struct texture){ .count = layers, .layer = layer, .plain = true };
	return i;
}

uint32_t scene_add_interior(struct scene *s)
{
	void *p = s->interior;
	uint32_t i = grow(s, &p, &s->interior_count, &s->interior_room, sizeof(*s->interior));

	s->interior = p;
	return i;
}

struct picture *scene_add_picture(struct scene *s)
{
	struct picture *picture = arena_zalloc(&s->arena, sizeof(*picture));
	void *p = s->picture;
	uint32_t i;

	if (!picture)
		return NULL;
	i = grow(s, &p, &s->picture_count, &s->picture_room, sizeof(*s->picture));
	s->picture = p;
	if (i == SCENE_NONE)
		return NULL;
	s->picture[i] = picture;
	return picture;
}

uint32_t scene_add_pattern(struct scene *s, struct pattern *pattern)
{
	void *p = s->pattern;
	uint32_t i = grow(s, &p, &s->pattern_count, &s->pattern_room, sizeof(*s->pattern));

	s->pattern = p;
	if (i != SCENE_NONE)
		s->pattern[i] = pattern;
	return i;
}

uint32_t scene_add_map(struct scene *s, const struct map *map)
{
	void *p = s->map;
	uint32_t i = grow(s, &p, &s->map_count, &s->map_room, sizeof(*s->map));

	s->map = p;
	if (i != SCENE_NONE)
		s->map[i] = *map;
	return i;
}

uint32_t scene_add_mesh(struct scene *s)
{
	void *p = s->mesh;
	uint32_t i = grow(s, &p, &s->mesh_count, &s->mesh_room, sizeof(*s->mesh));

	s->mesh = p;
	if (i != SCENE_NONE)
		s->mesh[i].empty_face = SCENE_NONE;
	return i;
}

uint32_t scene_add_sweep(struct scene *s, uint32_t points)
{
	void *point = arena_zalloc(&s->arena, mem_product(points, sizeof(*s->sweep->point))), *p = s->sweep;
	uint32_t i;

	if (!point)
		return SCENE_NONE;
	i = grow(s, &p, &s->sweep_count, &s->sweep_room, sizeof(*s->sweep));
	s->sweep = p;
	if (i != SCENE_NONE)
		s->sweep[i] = (struct sweep){ .count = points, .point = point };
	return i;
}

uint32_t scene_add_lathe(struct scene *s, uint32_t points)
{
	void *point = arena_zalloc(&s->arena, mem_product(points, sizeof(*s->lathe->point))), *p = s->lathe;
	uint32_t i;

	if (!point)
		return SCENE_NONE;
	i = grow(s, &p, &s->lathe_count, &s->lathe_room, sizeof(*s->lathe));
	s->lathe = p;
	if (i != SCENE_NONE)
		s->lathe[i] = (struct lathe){ .count = points, .point = point };
	return i;
}

uint32_t scene_add_prism(struct scene *s, uint32_t points)
{
	void *point = arena_zalloc(&s->arena, mem_product(points, sizeof(*s->prism->point))), *p = s->prism;
	uint32_t i;

	if (!point)
		return SCENE_NONE;
	i = grow(s, &p, &s->prism_count, &s->prism_room, sizeof(*s->prism));
	s->prism = p;
	if (i != SCENE_NONE)
		s->prism[i] = (struct prism){ .count = points, .point = point };
	return i;
}

uint32_t scene_add_isosurface(struct scene *s, const struct isosurface *iso)
{
	void *p = s->isosurface;
	uint32_t i = grow(s, &p, &s->isosurface_count, &s->isosurface_room, sizeof(*s->isosurface));

	s->isosurface = p;
	if (i != SCENE_NONE)
		s->isosurface[i] = *iso;
	return i;
}

uint32_t scene_add_algebraic(struct scene *s, uint32_t degree)
{
	double *term = arena_zalloc(&s->arena, algebraic_terms(degree) * sizeof(*term));
	void *p = s->algebraic;
	uint32_t i;

	if (!term)
		return SCENE_NONE;
	i = grow(s, &p, &s->algebraic_count, &s->algebraic_room, sizeof(*s->algebraic));
	s->algebraic = p;
	if (i != SCENE_NONE)
		s->algebraic[i] = (struct algebraic){ degree, 1, term };
	return i;
}

uint32_t scene_add_blob(struct scene *s, uint32_t parts)
{
	struct blob_part *part = arena_zalloc(&s->arena, mem_product(parts, sizeof(*part)));
	void *p = s->blob;
	uint32_t i;

	if (!part)
		return SCENE_NONE;
	for (uint32_t k = 0; k < parts; k++)
		part[k].texture = SCENE_NONE;
	i = grow(s, &p, &s->blob_count, &s->blob_room, sizeof(*s->blob));
	s->blob = p;
	if (i != SCENE_NONE)
		s->blob[i] = (struct blob){ .threshold = 1, .count = parts, .part = part };
	return i;
}

uint32_t scene_add_object(struct scene *s)
{
	void *p = s->object;
	uint32_t i = grow(s, &p, &s->object_count, &s->object_room, sizeof(*s->object));
	struct object *o;

	s->object = p;
	if (i == SCENE_NONE)
		return i;
	o = &s->object[i];
	o->place = xform_identity;
	o->texture = o->interior_texture = o->interior = o->solid = o->light_set = SCENE_NONE;
	o->first_child = o->next_sibling = o->first_clip = SCENE_NONE;
	return i;
}

void scene_add_root(struct scene *s, uint32_t o)
{
	if (s->last_root == SCENE_NONE)
		s->first_root = o;
	else
		s->object[s->last_root].next_sibling = o;
	s->last_root = o;
}


static uint64_t hash_mesh(uint64_t h, const struct mesh *m)
{
	h = HASH(h, m->vertex_count);
	h = HASH(h, m->triangle_count);
	h = HASH(h, m->smooth_count);
	h = HASH(h, m->textures_per_face);
	h = HASH(h, m->lone);
	h = HASH(h, m->grid);
	h = HASH(h, m->has_inside);
	h = hash_words(h, m->vertex, (size_t)m->vertex_count * 3 * sizeof(double));
	h = hash_words(h, m->index, (size_t)m->triangle_count * 3 * sizeof(uint32_t));
	if (m->normal)
		h = hash_words(h, m->normal, (size_t)m->normal_count * 3 * sizeof(float));
	if (m->normal_index)
		h = hash_words(h, m->normal_index, (size_t)m->smooth_count * 3 * sizeof(uint32_t));
	if (m->texture)
		h = hash_words(h, m->texture,
			       (size_t)m->triangle_count * m->textures_per_face * sizeof(uint32_t));
	if (m->uv)
		h = hash_words(h, m->uv, (size_t)m->uv_count * 2 * sizeof(float));
	if (m->uv_index)
		h = hash_words(h, m->uv_index, (size_t)m->triangle_count * 3 * sizeof(uint32_t));
	return HASH(h, m->inside);
}

static uint64_t hash_place(uint64_t h, const struct xform *x)
{
	return x ? HASH(h, x->fwd) : HASH(h, (char){ 0 });
}

/* Structs are hashed field by field where padding could differ; those made of doubles alone, whole. */
static uint64_t hash_object(uint64_t h, const struct object *o)
{
	h = HASH(h, o->kind);
	h = HASH(h, o->place.fwd);
	h = HASH(h, o->texture);
	h = HASH(h, o->interior_texture);
	h = hash_place(h, o->texture_place);
	h = hash_place(h, o->interior_texture_place);
	h = HASH(h, o->interior);
	h = HASH(h, o->solid);
	h = HASH(h, o->flags);
	h = HASH(h, o->light_set);
	h = HASH(h, o->first_child);
	h = HASH(h, o->next_sibling);
	h = HASH(h, o->first_clip);
	return HASH(h, o->shape); /* cleared when made, so its padding is 0 */
}

static uint64_t hash_sky(uint64_t h, const struct sky_sphere *sky)
{
	h = HASH(h, sky->count);
	h = HASH(h, sky->emission);
	h = HASH(h, sky->place.fwd);
	for (uint32_t i = 0; i < sky->count; i++)
		h = HASH(h, sky->pigment[i]->colour);
	return h;
}

static uint64_t hash_fog(uint64_t h, const struct fog *f)
{
	h = HASH(h, f->ground);
	h = HASH(h, f->distance);
	h = HASH(h, f->colour);
	h = HASH(h, f->up);
	h = HASH(h, f->offset);
	h = HASH(h, f->alt);
	h = HASH(h, f->turbulence);
	h = HASH(h, f->turb_depth);
	h = HASH(h, f->lambda);
	h = HASH(h, f->omega);
	return HASH(h, f->octaves);
}

static uint64_t hash_rainbow(uint64_t h, const struct rainbow *r)
{
	h = HASH(h, r->angle);
	h = HASH(h, r->width);
	h = HASH(h, r->distance);
	h = HASH(h, r->arc);
	h = HASH(h, r->falloff);
	h = HASH(h, r->direction);
	h = HASH(h, r->up);
	for (uint32_t i = 0; i < r->count; i++) {
		h = HASH(h, r->entry[i].at);
		h = HASH(h, r->entry[i].is.colour);
	}
	return h;
}

static uint64_t hash_light(uint64_t h, const struct light *l)
{
	h = HASH(h, l->kind);
	h = HASH(h, l->group);
	h = HASH(h, l->projected);
	h = HASH(h, l->no_media);
	h = HASH(h, l->attenuated);
	h = hash_bytes(h, &l->parallel, 7); /* the flags stand together */
	h = HASH(h, l->adaptive);
	h = HASH(h, l->size1);
	h = HASH(h, l->size2);
	h = HASH(h, l->location);
	h = HASH(h, l->direction);
	h = HASH(h, l->axis_length);
	h = HASH(h, l->axis1);
	h = HASH(h, l->axis2);
	h = HASH(h, l->colour);
	h = HASH(h, l->radius);
	h = HASH(h, l->falloff);
	h = HASH(h, l->tightness);
	h = HASH(h, l->fade_distance);
	return HASH(h, l->fade_power);
}

static uint64_t hash_blob(uint64_t h, const struct blob *b)
{
	h = HASH(h, b->threshold);
	for (uint32_t i = 0; i < b->count; i++) {
		const struct blob_part *p = &b->part[i];

		h = HASH(h, p->cylinder);
		h = HASH(h, p->base);
		h = HASH(h, p->apex);
		h = HASH(h, p->radius);
		h = HASH(h, p->strength);
		h = HASH(h, p->texture);
		if (p->place)
			h = HASH(h, p->place->fwd);
		if (p->texture_place)
			h = HASH(h, p->texture_place->fwd);
	}
	return h;
}

static uint64_t hash_isosurface(uint64_t h, const struct isosurface *i)
{
	h = HASH(h, i->function->hash);
	h = HASH(h, i->threshold);
	h = HASH(h, i->accuracy);
	h = HASH(h, i->max_gradient);
	h = HASH(h, i->evaluate);
	h = HASH(h, i->open);
	h = HASH(h, i->sphere);
	h = HASH(h, i->lo);
	return HASH(h, i->hi);
}

static uint64_t hash_shapes(uint64_t h, const struct scene *s)
{
	for (uint32_t i = 0; i < s->mesh_count; i++)
		h = hash_mesh(h, &s->mesh[i]);
	for (uint32_t i = 0; i < s->sweep_count; i++) {
		h = HASH(h, s->sweep[i].kind);
		h = hash_words(h, s->sweep[i].point, s->sweep[i].count * sizeof(*s->sweep[i].point));
	}
	for (uint32_t i = 0; i < s->lathe_count; i++) {
		h = HASH(h, s->lathe[i].kind);
		h = hash_words(h, s->lathe[i].point, s->lathe[i].count * sizeof(*s->lathe[i].point));
	}
	for (uint32_t i = 0; i < s->prism_count; i++) {
		const struct prism *p = &s->prism[i];

		h = HASH(HASH(HASH(h, p->kind), p->conic), p->open);
		h = HASH(HASH(h, p->lo), p->hi);
		h = hash_words(h, p->point, p->count * sizeof(*p->point));
	}
	for (uint32_t i = 0; i < s->isosurface_count; i++)
		h = hash_isosurface(h, &s->isosurface[i]);
	/* Their functions may ask patterns and pigments, which know the scene's noise. */
	if (s->isosurface_count) {
		h = HASH(h, s->version);
		h = HASH(h, s->noise_generator);
		h = HASH(h, s->number_of_waves);
		h = hash_textures(h, s);
	}
	for (uint32_t i = 0; i < s->algebraic_count; i++) {
		const struct algebraic *f = &s->algebraic[i];

		h = HASH(HASH(h, f->degree), f->size);
		h = hash_words(h, f->term, algebraic_terms(f->degree) * sizeof(*f->term));
	}
	for (uint32_t i = 0; i < s->blob_count; i++)
		h = hash_blob(h, &s->blob[i]);
	for (uint32_t i = 0; i < s->object_count; i++)
		h = hash_object(h, &s->object[i]);
	return h;
}

uint64_t scene_hash_shapes(const struct scene *s)
{
	uint64_t h = HASH_START;

	/* Of textures, what a ray's kind may pass is all that matters to shapes. */
	for (uint32_t i = 0; i < s->texture_count; i++)
		h = HASH(h, (char){ texture_translucent(&s->texture[i]) });
	h = HASH(h, s->first_root);
	return hash_shapes(h, s);
}

/* Only what decides the light. */
static uint64_t hash_radiosity(uint64_t h, const struct radiosity *r)
{
	h = HASH(h, r->normal);
	h = HASH(h, r->media);
	h = HASH(h, r->subsurface);
	h = HASH(h, r->recursion_limit);
	h = HASH(h, r->brightness);
	h = HASH(h, r->gray_threshold);
	h = HASH(h, r->adc_bailout);
	return HASH(h, r->max_sample);
}

static uint64_t hash_subsurface(uint64_t h, const struct subsurface *s)
{
	h = HASH(h, s->radiosity);
	h = HASH(h, s->samples);
	h = HASH(h, s->single_samples);
	return HASH(h, s->mm_per_unit);
}

static uint64_t hash_interior(uint64_t h, const struct interior *in)
{
	h = HASH(h, in->ior);
	h = HASH(h, in->caustics);
	h = HASH(h, in->fade_distance);
	h = HASH(h, in->fade_power);
	h = HASH(h, in->fade_colour);
	h = HASH(h, in->dispersion);
	h = HASH(h, in->dispersion_samples);
	return hash_media(h, in->media_count, in->media);
}

uint64_t scene_hash(const struct scene *s)
{
	uint64_t h = HASH_START;

	h = HASH(h, s->version);
	h = HASH(h, s->assumed_gamma);
	h = HASH(h, s->max_trace_level);
	h = HASH(h, s->noise_generator);
	h = HASH(h, s->number_of_waves);
	h = HASH(h, s->adc_bailout);
	h = HASH(h, s->ambient_light);
	h = HASH(h, s->irid_wavelength);
	h = HASH(h, s->background);
	if (s->radiosity.given)
		h = hash_radiosity(h, &s->radiosity);
	if (s->subsurface.given && s->subsurface.used)
		h = hash_subsurface(h, &s->subsurface);
	h = hash_media(h, s->media_count, s->media);
	h = HASH(h, s->camera.kind);
	h = HASH(h, s->camera.location);
	h = HASH(h, s->camera.direction);
	h = HASH(h, s->camera.right);
	h = HASH(h, s->camera.up);
	h = HASH(h, s->camera.angle);
	h = HASH(h, s->camera.angle_up);
	h = HASH(h, s->camera.aperture);
	h = HASH(h, s->camera.focal_distance);
	h = HASH(h, s->camera.blur_samples);
	h = hash_normal(h, s->camera.normal);
	if (s->sky)
		h = hash_sky(h, s->sky);
	for (uint32_t i = 0; i < s->fog_count; i++)
		h = hash_fog(h, &s->fog[i]);
	for (uint32_t i = 0; i < s->rainbow_count; i++)
		h = hash_rainbow(h, &s->rainbow[i]);
	for (uint32_t i = 0; i < s->light_count; i++)
		h = hash_light(h, &s->light[i]);
	for (uint32_t i = 0; i < s->light_set_count; i++) {
		h = HASH(h, s->light_set[i].group);
		h = HASH(h, s->light_set[i].global);
	}
	h = hash_textures(h, s);
	for (uint32_t i = 0; i < s->interior_count; i++)
		h = hash_interior(h, &s->interior[i]);
	return hash_shapes(h, s);
}

const char *shape_name(enum shape_kind kind)
{
	static const char *const name[SHAPE_KINDS] = {
		[SHAPE_MESH] = "mesh", [SHAPE_SPHERE] = "sphere", [SHAPE_BOX] = "box",
		[SHAPE_CONE] = "cone or cylinder", [SHAPE_PLANE] = "plane", [SHAPE_DISC] = "disc",
		[SHAPE_TORUS] = "torus", [SHAPE_SUPERELLIPSOID] = "superellipsoid",
		[SHAPE_SWEEP] = "sphere_sweep", [SHAPE_BLOB] = "blob", [SHAPE_LATHE] = "lathe",
		[SHAPE_PRISM] = "prism", [SHAPE_ALGEBRAIC] = "polynomial surface",
		[SHAPE_ISOSURFACE] = "isosurface",
		[SHAPE_UNION] = "union", [SHAPE_MERGE] = "merge",
		[SHAPE_INTERSECTION] = "intersection",
	};

	return name[kind];
}
