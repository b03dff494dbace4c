/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pigments and textures at a point: a colour, or a pattern's value led through a map (manual 3.4.6.1, 3.4.6.4).
 * What stands in a map is asked at the point behind the pattern's warps, as POV-Ray does it.
 */
#include "pattern/family.h"
#include "pattern/footprint.h"

static struct rgbft add_scaled(struct rgbft a, struct rgbft b, double s)
{
	return (struct rgbft){ a.r + b.r * s, a.g + b.g * s, a.b + b.b * s, a.filter + b.filter * s,
			       a.transmit + b.transmit * s };
}

static struct rgbft entry_colour(const struct scene *s, const struct map *m, uint32_t i,
				 const struct pattern_point *at)
{
	return m->kind == MAP_COLOUR ? m->entry[i].is.colour : pigment_at(s, m->entry[i].is.pigment, at);
}

static struct rgbft average(const struct scene *s, const struct map *m, const struct pattern_point *at)
{
	struct rgbft sum = { 0 };
	double total = 0;

	for (uint32_t i = 0; i < m->count; i++) {
		sum = add_scaled(sum, entry_colour(s, m, i, at), m->entry[i].at);
		total += m->entry[i].at;
	}
	return add_scaled((struct rgbft){ 0 }, sum, 1 / total);
}

struct rgbft pigment_at(const struct scene *s, const struct pigment *pigment,
			const struct pattern_point *at)
{
	const struct pattern *q = pigment->pattern;
	const struct map *m = &pigment->map;
	struct pattern_point inner;
	struct footprint foot;
	struct rgbft first;
	uint32_t a, b;
	double t;

	if (!q)
		return pigment->colour;
	inner = *at;
	inner.foot = footprint_within(q, pigment->uv, at, &foot);
	inner.p = pattern_warp(q, pigment->uv ? vec_make(at->u, at->v, 0) : at->p);
	if (pattern_brings_colour(q->kind))
		return pattern_colour(s, q, &inner);
	if (q->kind == PATTERN_AVERAGE)
		return average(s, m, &inner);
	if (!m->count)
		m = pattern_own_map(q);
	map_find(m, pattern_value_warped(s, q, &inner), &a, &b, &t);
	first = entry_colour(s, m, a, &inner);
	if (a == b)
		return first;
	return add_scaled(add_scaled((struct rgbft){ 0 }, first, 1 - t), entry_colour(s, m, b, &inner), t);
}

/* What normals in the map are told of the way to the world: the pattern's transforms come first. */
static const struct xform *place_within(const struct pattern *q, const struct xform *place, struct xform *room)
{
	for (uint32_t i = 0; i < q->warp_count; i++) {
		if (q->warp[i].kind != WARP_TRANSFORM)
			continue;
		*room = place ? xform_mul(&q->warp[i].w.place, place) : q->warp[i].w.place;
		place = room;
	}
	return place;
}

static void visit_average(const struct scene *s, const struct map *m, const struct pattern_point *at,
			  double share, texture_visitor *visit, void *self)
{
	double total = 0;

	for (uint32_t i = 0; i < m->count; i++)
		total += m->entry[i].at;
	for (uint32_t i = 0; i < m->count; i++)
		texture_visit(s, m->entry[i].is.texture, at, share * m->entry[i].at / total, visit, self);
}

void texture_visit(const struct scene *s, const struct texture *texture, const struct pattern_point *at,
		   double share, texture_visitor *visit, void *self)
{
	const struct pattern *q = texture->pattern;
	const struct map *m = &texture->map;
	struct pattern_point inner = *at;
	struct footprint foot;
	struct xform room;
	uint32_t a, b;
	double value, t;

	if (texture->uv)
		inner.p = vec_make(at->u, at->v, 0);
	inner.foot = q ? footprint_within(q, texture->uv, at, &foot) :
		     texture->uv ? footprint_at_uv(at, &foot) : at->foot;
	if (!q) {
		visit(self, texture, &inner, share);
		return;
	}
	inner.p = pattern_warp(q, inner.p);
	inner.place = place_within(q, at->place, &room);
	inner.within = true;
	if (q->kind == PATTERN_AVERAGE) {
		visit_average(s, m, &inner, share, visit, self);
		return;
	}
	value = pattern_value_warped(s, q, &inner);
	/* Numbers beyond the last texture begin anew, but the first of them stays with the last: measured. */
	if (q->kind == PATTERN_MATERIAL_MAP && value > m->count)
		value = fmod(value, m->count);
	map_find(m, value, &a, &b, &t);
	/* The upper entry first, as POV-Ray has it: slope minds. */
	if (a != b)
		texture_visit(s, m->entry[b].is.texture, &inner, share * t, visit, self);
	texture_visit(s, m->entry[a].is.texture, &inner, a == b ? share : share * (1 - t), visit, self);
}
