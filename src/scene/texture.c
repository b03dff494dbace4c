/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "scene/scene.h"

#include <string.h>

struct finish finish_default(void)
{
	return (struct finish){ .ambient = { 0.1, 0.1, 0.1 },
				.diffuse = 0.6,
				.indirect = 0.6,
				.brilliance = 1,
				.phong_size = 40,
				.roughness = 0.05,
				.reflection_falloff = 1,
				.reflection_exponent = 1 };
}

static bool colour_clear(const struct rgbft *c)
{
	return c->filter != 0 || c->transmit != 0;
}

static bool layers_clear(const struct texture *t)
{
	for (uint32_t i = 0; i < t->count; i++) {
		const struct pigment *p = &t->layer[i].pigment;

		if (p->pattern ? !p->clear : !colour_clear(&p->colour))
			return false;
	}
	return true;
}

bool texture_translucent(const struct texture *t)
{
	return t->pattern ? t->clear : layers_clear(t);
}

void map_examine(struct map *m)
{
	m->wants_uv = m->clear = false;
	for (uint32_t i = 0; i < m->count; i++) {
		const struct map_entry *e = &m->entry[i];

		switch (m->kind) {
		case MAP_COLOUR:
			m->clear |= colour_clear(&e->is.colour);
			break;
		case MAP_PIGMENT:
			m->clear |= e->is.pigment->clear;
			m->wants_uv |= e->is.pigment->wants_uv;
			break;
		case MAP_NORMAL:
			m->wants_uv |= e->is.normal->wants_uv;
			break;
		case MAP_TEXTURE:
			m->clear |= e->is.texture->clear;
			m->wants_uv |= e->is.texture->wants_uv;
			break;
		default:
			return;
		}
	}
}

void pigment_examine(struct pigment *p)
{
	const struct pattern *q = p->pattern;

	p->wants_uv = p->uv && q;
	p->clear = colour_clear(&p->colour);
	if (!q)
		return;
	p->wants_uv |= q->wants_uv || p->map.wants_uv;
	p->clear = p->map.clear || (q->kind == PATTERN_IMAGE_MAP && q->of.image.clear);
}

void normal_examine(struct normal *n)
{
	n->wants_uv = n->uv || n->map.wants_uv || (n->pattern && n->pattern->wants_uv);
}

void texture_examine(struct texture *t)
{
	t->plain = !t->pattern;
	t->wants_uv = t->uv;
	t->clear = texture_translucent(t);
	for (uint32_t i = 0; i < t->count; i++) {
		const struct layer *l = &t->layer[i];

		t->plain &= !l->pigment.pattern && !l->normal;
		t->wants_uv |= l->pigment.wants_uv || (l->normal && l->normal->wants_uv);
	}
	if (!t->pattern)
		return;
	t->clear = t->map.clear;
	t->wants_uv |= t->map.wants_uv || t->pattern->wants_uv;
}

/* Deep copies. */

struct copy {
	const void *from; /* NULL: free */
	void *to;
};

static size_t place_of(const struct copies *c, const void *from)
{
	uint64_t h = (uint64_t)(uintptr_t)from * 0x9e3779b97f4a7c15u;
	size_t i = (size_t)(h >> 32) & (c->room - 1);

	while (c->copy[i].from && c->copy[i].from != from)
		i = (i + 1) & (c->room - 1);
	return i;
}

static void *copied(const struct copies *c, const void *from)
{
	return c->room ? c->copy[place_of(c, from)].to : NULL;
}

static bool remember(struct copies *c, const void *from, void *to)
{
	if (2 * (c->count + 1) > c->room) {
		struct copies more = { .book = c->book, .room = c->room ? 2 * c->room : 64 };

		more.copy = mem_zalloc(c->book, "scene", mem_product(more.room, sizeof(*more.copy)));
		if (!more.copy)
			return false;
		for (uint32_t i = 0; i < c->room; i++) {
			if (c->copy[i].from)
				more.copy[place_of(&more, c->copy[i].from)] = c->copy[i];
		}
		more.count = c->count;
		mem_free(c->copy);
		*c = more;
	}
	c->copy[place_of(c, from)] = (struct copy){ from, to };
	c->count++;
	return true;
}

void copies_release(struct copies *c)
{
	mem_free(c->copy);
	*c = (struct copies){ .book = c->book };
}

void *copies_take(struct scene *s, struct copies *c, const void *from, size_t bytes, bool *new)
{
	void *to = copied(c, from);

	*new = !to;
	if (to)
		return to;
	to = arena_memdup(&s->arena, from, bytes);
	return to && remember(c, from, to) ? to : NULL;
}

static bool adopt_map(struct scene *, struct copies *, struct map *);

/* The rest of a pigment that has been copied as it is. */
static bool adopt_pigment(struct scene *s, struct copies *c, struct pigment *p)
{
	if (!p->pattern) {
		p->map = (struct map){ .kind = MAP_NONE };
		return true;
	}
	return scene_adopt_pattern(s, c, &p->pattern) && adopt_map(s, c, &p->map);
}

struct pigment *scene_adopt_pigment(struct scene *s, struct copies *c, const struct pigment *from)
{
	bool new;
	struct pigment *to = copies_take(s, c, from, sizeof(*to), &new);

	return to && (!new || adopt_pigment(s, c, to)) ? to : NULL;
}

bool scene_adopt_normal(struct scene *s, struct copies *c, struct normal **n)
{
	bool new;

	if (!*n)
		return true;
	*n = copies_take(s, c, *n, sizeof(**n), &new);
	return *n && (!new || (scene_adopt_pattern(s, c, &(*n)->pattern) && adopt_map(s, c, &(*n)->map)));
}

bool scene_adopt_pattern(struct scene *s, struct copies *c, struct pattern **p)
{
	struct pattern *q;
	bool new;

	if (!*p)
		return true;
	*p = q = copies_take(s, c, *p, sizeof(**p), &new);
	if (!q || !new)
		return q != NULL;
	if (q->warp_count) {
		q->warp = (void *)arena_memdup(&s->arena, q->warp, mem_product(q->warp_count, sizeof(*q->warp)));
		if (!q->warp)
			return false;
	}
	if (q->kind == PATTERN_PIGMENT) {
		q->of.pigment = scene_adopt_pigment(s, c, q->of.pigment);
		if (!q->of.pigment)
			return false;
	}
	if (q->kind == PATTERN_FUNCTION) {
		q->of.function = scene_adopt_function(s, c, q->of.function);
		if (!q->of.function)
			return false;
	}
	q->id = scene_add_pattern(s, q);
	return q->id != SCENE_NONE;
}

bool scene_adopt_texture(struct scene *s, struct copies *c, const struct texture *from, struct texture *to)
{
	*to = *from;
	if (to->pattern) {
		to->layer = NULL;
		return scene_adopt_pattern(s, c, &to->pattern) && adopt_map(s, c, &to->map);
	}
	to->layer = (void *)arena_memdup(&s->arena, from->layer, mem_product(from->count, sizeof(*to->layer)));
	for (uint32_t i = 0; to->layer && i < to->count; i++) {
		if (!adopt_pigment(s, c, &to->layer[i].pigment) || !scene_adopt_normal(s, c, &to->layer[i].normal))
			return false;
	}
	return to->layer != NULL;
}

static struct texture *adopt_entry(struct scene *s, struct copies *c, const struct texture *from)
{
	bool new;
	struct texture *to = copies_take(s, c, from, sizeof(*to), &new);

	return to && (!new || scene_adopt_texture(s, c, from, to)) ? to : NULL;
}

static bool adopt_item(struct scene *s, struct copies *c, enum map_kind kind, struct map_entry *e)
{
	switch (kind) {
	case MAP_PIGMENT:
		e->is.pigment = scene_adopt_pigment(s, c, e->is.pigment);
		return e->is.pigment;
	case MAP_NORMAL:
		return scene_adopt_normal(s, c, &e->is.normal);
	case MAP_TEXTURE:
		e->is.texture = adopt_entry(s, c, e->is.texture);
		return e->is.texture;
	default:
		return true;
	}
}

static bool adopt_entries(struct scene *s, struct copies *c, struct map *m)
{
	m->entry = (void *)arena_memdup(&s->arena, m->entry, mem_product(m->count, sizeof(*m->entry)));
	for (uint32_t i = 0; m->entry && i < m->count; i++) {
		if (!adopt_item(s, c, m->kind, &m->entry[i]))
			return false;
	}
	return m->entry;
}

/* Maps are known by their entries. */
static bool adopt_map(struct scene *s, struct copies *c, struct map *m)
{
	const struct map_entry *from = m->entry;
	const struct map *known;
	struct map *made;

	if (!m->count)
		return true;
	known = copied(c, from);
	if (known) {
		*m = *known;
		return true;
	}
	if (!adopt_entries(s, c, m))
		return false;
	m->id = scene_add_map(s, m);
	if (m->id == SCENE_NONE)
		return false;
	s->map[m->id].id = m->id;
	made = (void *)arena_memdup(&s->arena, m, sizeof(*m));
	return made && remember(c, from, made);
}
