/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The part of scene_hash() that textures are: patterns and maps once each, in the order of the scene's
 * lists, and wherever they are used by their numbers. Structs with gaps go field by field.
 */
#include <stddef.h>
#include <string.h>

#include "scene/function.h"
#include "scene/hash.h"

static uint64_t hash_warp(uint64_t h, const struct warp *w)
{
	h = HASH(h, w->kind);
	switch (w->kind) {
	case WARP_TRANSFORM:
		return HASH(h, w->w.place.fwd);
	case WARP_TURBULENCE:
		h = HASH(h, w->w.turbulence.amount);
		h = HASH(h, w->w.turbulence.octaves);
		h = HASH(h, w->w.turbulence.lambda);
		return HASH(h, w->w.turbulence.omega);
	case WARP_REPEAT:
		h = HASH(h, w->w.repeat.axis);
		h = HASH(h, w->w.repeat.width);
		h = HASH(h, w->w.repeat.offset);
		return HASH(h, w->w.repeat.flip);
	case WARP_BLACK_HOLE:
		h = HASH(h, w->w.hole.centre);
		h = HASH(h, w->w.hole.radius);
		h = HASH(h, w->w.hole.power);
		h = HASH(h, w->w.hole.strength);
		h = hash_bytes(h, &w->w.hole.inverse, 4); /* the flags stand together */
		h = HASH(h, w->w.hole.repeat);
		return HASH(h, w->w.hole.uncertainty);
	case WARP_CUBIC:
		return h;
	default:
		h = HASH(h, w->w.map.orientation);
		h = HASH(h, w->w.map.exponent);
		h = HASH(h, w->w.map.distance);
		return HASH(h, w->w.map.major);
	}
}

static uint64_t hash_picture(uint64_t h, const struct picture_place *p)
{
	const struct picture *f = p->picture;

	if (f) {
		h = HASH(h, f->hash);
		h = HASH(h, f->width);
		h = HASH(h, f->height);
	}
	h = HASH(h, p->map_type);
	h = HASH(h, p->interpolate);
	h = HASH(h, p->use);
	h = HASH(h, p->once);
	h = HASH(h, p->premultiplied);
	if (p->entry && f)
		h = hash_bytes(h, p->entry, f->palette_count * sizeof(*p->entry));
	h = HASH(h, p->repeat_u);
	h = HASH(h, p->repeat_v);
	h = HASH(h, p->offset_u);
	h = HASH(h, p->offset_v);
	h = HASH(h, p->filter_all);
	h = HASH(h, p->transmit_all);
	h = HASH(h, p->gamma);
	return HASH(h, p->gamma_then);
}

static uint64_t hash_pigment(uint64_t h, const struct pigment *p)
{
	const uint32_t none = SCENE_NONE;

	h = HASH(h, p->uv);
	h = HASH(h, p->colour);
	if (!p->pattern)
		return HASH(h, none);
	h = HASH(h, p->pattern->id);
	return p->map.count ? HASH(h, p->map.id) : HASH(h, none);
}

uint64_t hash_normal(uint64_t h, const struct normal *n)
{
	const uint32_t none = SCENE_NONE;

	if (!n || !n->pattern)
		return HASH(h, none);
	h = HASH(h, n->uv);
	h = HASH(h, n->no_bump_scale);
	h = HASH(h, n->pattern->id);
	h = HASH(h, n->amount);
	h = HASH(h, n->accuracy);
	return n->map.count ? HASH(h, n->map.id) : HASH(h, none);
}

static uint64_t hash_texture(uint64_t h, const struct texture *t)
{
	h = HASH(h, t->count);
	h = HASH(h, t->uv);
	if (t->pattern) {
		h = HASH(h, t->pattern->id);
		return HASH(h, t->map.id);
	}
	for (uint32_t i = 0; i < t->count; i++) {
		const struct layer *l = &t->layer[i];

		h = hash_pigment(h, &l->pigment);
		h = hash_normal(h, l->normal);
		h = hash_bytes(h, &l->finish, offsetof(struct finish, reflection_fresnel));
		h = HASH(h, l->finish.reflection_fresnel);
		h = HASH(h, l->finish.conserve_energy);
		h = HASH(h, l->finish.subsurface);
	}
	return h;
}

/* The union was cleared before it was filled. */
static uint64_t hash_parameters(uint64_t h, const struct pattern *q)
{
	switch (q->kind) {
	case PATTERN_IMAGE_MAP:
	case PATTERN_MATERIAL_MAP:
	case PATTERN_BUMP_MAP:
	case PATTERN_IMAGE:
		return hash_picture(h, &q->of.image);
	case PATTERN_PIGMENT:
		return hash_pigment(h, q->of.pigment);
	case PATTERN_FUNCTION:
		return HASH(h, q->of.function->hash);
	default:
		return HASH(h, q->of);
	}
}

static uint64_t hash_pattern(uint64_t h, const struct pattern *q)
{
	h = HASH(h, q->kind);
	for (uint32_t i = 0; i < q->warp_count; i++)
		h = hash_warp(h, &q->warp[i]);
	h = HASH(h, q->wave);
	h = HASH(h, q->frequency);
	h = HASH(h, q->phase);
	h = HASH(h, q->exponent);
	h = HASH(h, q->noise);
	h = HASH(h, q->turbulence.amount);
	h = HASH(h, q->turbulence.octaves);
	h = HASH(h, q->turbulence.lambda);
	h = HASH(h, q->turbulence.omega);
	return hash_parameters(h, q);
}

static uint64_t hash_map(uint64_t h, const struct map *m)
{
	h = HASH(h, m->kind);
	for (uint32_t i = 0; i < m->count; i++) {
		const struct map_entry *e = &m->entry[i];

		h = HASH(h, e->at);
		switch (m->kind) {
		case MAP_COLOUR:
			h = HASH(h, e->is.colour);
			break;
		case MAP_PIGMENT:
			h = hash_pigment(h, e->is.pigment);
			break;
		case MAP_NORMAL:
			h = hash_normal(h, e->is.normal);
			break;
		case MAP_TEXTURE:
			h = hash_texture(h, e->is.texture);
			break;
		default:
			h = HASH(h, e->is.slope);
		}
	}
	return h;
}

static uint64_t hash_place(uint64_t h, const struct xform *x)
{
	return x ? HASH(h, x->fwd) : h;
}

/* Where textures lie on things. */
static uint64_t hash_places(uint64_t h, const struct scene *s)
{
	for (uint32_t i = 0; i < s->object_count; i++) {
		h = hash_place(h, s->object[i].texture_place);
		h = hash_place(h, s->object[i].interior_texture_place);
	}
	for (uint32_t i = 0; i < s->mesh_count; i++) {
		const struct mesh *m = &s->mesh[i];

		if (m->uv)
			h = hash_bytes(h, m->uv, (size_t)m->uv_count * 2 * sizeof(*m->uv));
		if (m->uv_index)
			h = hash_bytes(h, m->uv_index, (size_t)m->triangle_count * 3 * sizeof(*m->uv_index));
	}
	return h;
}

uint64_t hash_media(uint64_t h, uint32_t count, const struct media *media)
{
	for (const struct media *m = media; m < media + count; m++) {
		h = HASH(h, m->absorption);
		h = HASH(h, m->emission);
		h = HASH(h, m->scattering);
		h = HASH(h, m->phase);
		h = HASH(h, m->extinction);
		h = HASH(h, m->eccentricity);
		h = HASH(h, m->method);
		h = HASH(h, m->intervals);
		h = HASH(h, m->samples_min);
		h = HASH(h, m->samples_max);
		h = HASH(h, m->aa_level);
		h = HASH(h, m->aa_threshold);
		h = HASH(h, m->jitter);
		h = HASH(h, m->ratio);
		for (uint32_t i = 0; i < m->density_count; i++)
			h = hash_pigment(h, &m->density[i]);
		h = hash_place(h, m->place);
	}
	return h;
}

uint64_t hash_textures(uint64_t h, const struct scene *s)
{
	for (uint32_t i = 0; i < s->pattern_count; i++)
		h = hash_pattern(h, s->pattern[i]);
	for (uint32_t i = 0; i < s->map_count; i++)
		h = hash_map(h, &s->map[i]);
	for (uint32_t i = 0; i < s->texture_count; i++)
		h = hash_texture(h, &s->texture[i]);
	return hash_places(h, s);
}
