/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "shade/pov/plain_lanes.h"

#include <string.h>

#include "shade/light.h"
#include "shade/pov/finish.h"
#include "shade/pov/lights.h"
#include "shade/pov/shadow.h"

void plain_paint(const struct shader *sh, struct paint *out)
{
	const struct scene *s = sh->scene;

	for (uint32_t i = 0; i < s->texture_count; i++) {
		const struct layer *l = plain_layer(sh, &s->texture[i]);
		const struct finish *f;

		out[i] = (struct paint){ .finish = NULL };
		if (!l)
			continue;
		f = &l->finish;
		out[i].finish = f;
		out[i].base = plain_base(sh, l);
		out[i].pigment = rgbft_rgb(l->pigment.colour);
		out[i].diffuse = f->diffuse;
		out[i].back = f->diffuse_back;
		out[i].noise = f->crand * 0;
		out[i].lit = finish_needs_light(f, false);
		out[i].dull = f->brilliance == 1 && !(f->phong > 0) && !(f->specular > 0);
	}
}

bool plain_lanes_begin(struct plain_lanes *b, const struct shader *sh, uint32_t thread)
{
	b->count = b->sort = b->sorts = 0;
	return trace_room(sh->geometry, thread, &b->room);
}

/* ---- where the hits are ---- */

/* eye: a slice of each axis. */
WIDE static void face_rays(struct facets *restrict f, const double *restrict x, const double *restrict y,
			   const double *restrict z)
{
	for (unsigned i = 0; i < LANES; i++) {
		vec ns = vec_make(f->ns[0][i], f->ns[1][i], f->ns[2][i]);
		double side = vec_dot(ns, vec_make(x[i], y[i], z[i])) > 0 ? -1 : 1;

		f->ns[0][i] = ns.x * side;
		f->ns[1][i] = ns.y * side;
		f->ns[2][i] = ns.z * side;
	}
}

static void put_lane(struct facets *f, unsigned i, const struct surface *s)
{
	const vec *from[3] = { &s->p, &s->n, &s->ns };
	double(*to[3])[LANES] = { f->p, f->n, f->ns };

	for (unsigned k = 0; k < 3; k++) {
		to[k][0][i] = from[k]->x;
		to[k][1][i] = from[k]->y;
		to[k][2][i] = from[k]->z;
	}
	f->error[i] = s->error;
}

/* The lanes at are full, or all that there will be. Beyond the last are older ones. */
static void place(struct plain_lanes *b, const struct shader *sh, uint32_t at)
{
	struct facets *f = &b->placed[at / LANES];

	facet_place(sh->geometry, &b->now, f);
	for (unsigned i = 0; i < LANES && at + i < b->count; i++) {
		struct surface s;

		if (f->size[i] > FACET_SLIVER)
			continue;
		surface_at(sh->geometry, NULL, &b->hit[b->ray[at + i]], &s);
		put_lane(f, i, &s);
	}
	face_rays(f, b->eye[0] + at, b->eye[1] + at, b->eye[2] + at);
}

/* Hits that have less in common than those before begin another sort. */
static uint32_t sort_of(struct plain_lanes *b, const struct facet_kind *k, uint32_t texture)
{
	uint32_t last = b->count - 1;
	bool both = k->flags & OBJECT_DOUBLE_ILLUMINATE;

	if (!b->count || texture != b->texture[last] || k->light_set != b->light_set[last] || both != b->both[last])
		b->sort = ++b->sorts;
	return b->sort;
}

bool plain_lanes_take(struct plain_lanes *b, const struct shader *sh, const struct paint *paint, uint32_t ray,
		      const ald_hit *hit)
{
	uint32_t at = b->count, texture, sort;
	unsigned lane = at % LANES;

	if (!facet_find(sh->geometry, hit->prim, &b->kind) ||
	    !facet_take(sh->geometry, &b->kind, hit, &b->now, lane, &texture) || texture == SCENE_NONE ||
	    !paint[texture].finish)
		return false;
	sort = sort_of(b, &b->kind, texture);
	b->group[at / LANES] = lane && b->group[at / LANES] != sort ? 0 : sort;
	b->ray[at] = ray;
	b->eye[0][at] = b->dir[0][ray]; /* no loop, as in prim_triangle() */
	b->eye[1][at] = b->dir[1][ray];
	b->eye[2][at] = b->dir[2][ray];
	b->prim[at] = hit->prim;
	b->texture[at] = texture;
	b->light_set[at] = b->kind.light_set;
	b->both[at] = b->kind.flags & OBJECT_DOUBLE_ILLUMINATE;
	b->count = at + 1;
	if (lane == LANES - 1)
		place(b, sh, at + 1 - LANES);
	return true;
}

/* ---- light ---- */

struct lamp {
	const struct light *light;
	vec at; /* its place, if it is but a point, */
	bool point, fades; /* whose light may fade with the square of the distance */
};

/* From eight hits to the lamp. */
struct to_lamp {
	double dir[3][LANES], depth[LANES], part[LANES]; /* part: of its light, that arrives */
};

/* What becomes of it, and the rays that ask for it, in the room's coordinates. */
struct from_lamp {
	double sum[3][LANES];
	double org[3][LANES], dir[3][LANES], reach[LANES];
	double asked[LANES], sound[LANES], behind[LANES], none[LANES]; /* 0 or not; none: the sum is nothing */
};

static struct lamp lamp_of(const struct light *l)
{
	bool fades = l->fade_power > 0 && l->fade_distance != 0;

	return (struct lamp){ .light = l, .at = vec_add(l->location, vec_make(0, 0, 0)), .fades = fades,
			      .point = l->kind == LIGHT_POINT && !l->parallel && (!fades || l->fade_power == 2) };
}

LANED void towards_lane(const double *px, const double *py, const double *pz, vec lamp, double fade, int fades,
			struct to_lamp *out, unsigned i)
{
	vec to = vec_sub(lamp, vec_make(px[i], py[i], pz[i])), dir;
	double depth = vec_length(to), x = depth / fade, part = 2 / (1 + x * x);

	dir = vec_scale(to, 1 / depth);
	out->dir[0][i] = dir.x;
	out->dir[1][i] = dir.y;
	out->dir[2][i] = dir.z;
	out->depth[i] = depth;
	out->part[i] = fades ? part : 1;
}

WIDE static void towards_all(const double *restrict px, const double *restrict py, const double *restrict pz, vec lamp,
			     double fade, struct to_lamp *restrict out)
{
	for (unsigned i = 0; i < LANES; i++)
		towards_lane(px, py, pz, lamp, fade, 1, out, i);
}

WIDE static void towards_even(const double *restrict px, const double *restrict py, const double *restrict pz, vec lamp,
			      struct to_lamp *restrict out)
{
	for (unsigned i = 0; i < LANES; i++)
		towards_lane(px, py, pz, lamp, 1, 0, out, i);
}

static void towards(const struct plain_lanes *b, uint32_t at, const struct lamp *l, struct to_lamp *out)
{
	const struct facets *f = &b->placed[at / LANES];
	const double *x = f->p[0], *y = f->p[1], *z = f->p[2];

	if (l->point && l->fades) {
		towards_all(x, y, z, l->at, l->light->fade_distance, out);
		return;
	}
	if (l->point) {
		towards_even(x, y, z, l->at, out);
		return;
	}
	for (unsigned i = 0; i < LANES; i++) {
		vec p = vec_make(x[i], y[i], z[i]);
		struct light_ray r = light_towards(l->light, p, vec_make(0, 0, 0));

		out->dir[0][i] = r.dir.x;
		out->dir[1][i] = r.dir.y;
		out->dir[2][i] = r.dir.z;
		out->depth[i] = r.depth;
		out->part[i] = light_attenuation(l->light, p, &r);
	}
}

/* What plain.c's ask() and finish_shade() say, without branches. */
LANED void light_lane(vec p, vec n, vec ns, double error, const struct to_lamp *to, const struct paint_lanes *m,
		      struct rgb colour, vec shift, double scale, struct from_lamp *out, unsigned i)
{
	vec dir = vec_make(to->dir[0][i], to->dir[1][i], to->dir[2][i]), org, in;
	double cosine = vec_dot(ns, dir), depth = to->depth[i], reach, amount, sum, nothing;
	struct rgb c = rgb_scale(colour, to->part[i]);
	int behind = (m->both[i] == 0) & !(cosine >= LIGHT_BESIDE);
	int dark = (fabs(c.r) < SHADOW_DARK) & (fabs(c.g) < SHADOW_DARK) & (fabs(c.b) < SHADOW_DARK);
	int lit = (m->lit[i] != 0) & (!behind | (m->back[i] != 0)) & !dark;

	org = shadow_origin(p, n, error, dir);
	reach = shadow_depth(p, depth);
	nothing = org.x * 0 + org.y * 0 + org.z * 0 + dir.x * 0 + dir.y * 0 + dir.z * 0;
	amount = behind ? m->back[i] : m->diffuse[i];
	sum = fabs(cosine) * amount * 1 - m->noise[i];
	in = vec_scale(vec_sub(org, shift), scale);
	out->org[0][i] = in.x;
	out->org[1][i] = in.y;
	out->org[2][i] = in.z;
	out->dir[0][i] = dir.x * scale;
	out->dir[1][i] = dir.y * scale;
	out->dir[2][i] = dir.z * scale;
	out->reach[i] = reach;
	out->sum[0][i] = m->pigment[0][i] * c.r * sum;
	out->sum[1][i] = m->pigment[1][i] * c.g * sum;
	out->sum[2][i] = m->pigment[2][i] * c.b * sum;
	out->none[i] = amount <= 0 ? 1 : 0;
	out->asked[i] = lit ? 1 : 0;
	out->behind[i] = behind ? 1 : 0;
	out->sound[i] = ((nothing == 0) & ((dir.x != 0) | (dir.y != 0) | (dir.z != 0)) & (0 <= reach)) ? 1 : 0;
}

WIDE static void light_all(const struct facets *restrict h, const struct to_lamp *restrict to,
			   const struct paint_lanes *restrict m, struct rgb colour, vec shift, double scale,
			   struct from_lamp *restrict out)
{
	for (unsigned i = 0; i < LANES; i++)
		light_lane(vec_make(h->p[0][i], h->p[1][i], h->p[2][i]), vec_make(h->n[0][i], h->n[1][i], h->n[2][i]),
			   vec_make(h->ns[0][i], h->ns[1][i], h->ns[2][i]), h->error[i], to, m, colour, shift, scale,
			   out, i);
}

static void paint_lane(struct plain_lanes *b, const struct shader *sh, const struct paint *paint, const struct light *l,
		       uint32_t at, unsigned i)
{
	const struct paint *p = &paint[b->texture[at]];
	struct paint_lanes *to = &b->paint;

	to->pigment[0][i] = p->pigment.r;
	to->pigment[1][i] = p->pigment.g;
	to->pigment[2][i] = p->pigment.b;
	to->diffuse[i] = p->diffuse;
	to->back[i] = p->back;
	to->noise[i] = p->noise;
	to->lit[i] = p->lit && scene_lit_by(sh->scene, l, b->light_set[at]);
	to->both[i] = b->both[at];
}

static void put_ray(struct plain_lanes *b, const struct from_lamp *f, uint32_t at, unsigned i)
{
	ald_ray *r = &b->room.ray[b->asked];

	r->org = vec_make(f->org[0][i], f->org[1][i], f->org[2][i]);
	r->dir = vec_make(f->dir[0][i], f->dir[1][i], f->dir[2][i]);
	r->tmin = 0;
	r->tmax = f->reach[i];
	r->mask = TRACE_SHADOW_OPAQUE;
	r->skip = b->prim[at + i];
	r->after = r->after_sub[0] = r->after_sub[1] = ALD_NONE;
	r->reserved[0] = r->reserved[1] = r->reserved[2] = 0;
	if (f->sound[i] == 0)
		trace_nothing(r);
	b->asks[b->asked] = at + i;
	b->light[b->asked] = rgb_make(f->sum[0][i], f->sum[1][i], f->sum[2][i]);
	if (f->none[i] != 0)
		b->light[b->asked] = rgb_make(0, 0, 0);
	b->asked++;
}

/* Highlights, and what goes by a power of the cosine: one by one. */
static struct rgb shine(const struct plain_lanes *b, const struct paint *p, const struct light *l,
			const struct to_lamp *to, const struct from_lamp *from, uint32_t at, unsigned i)
{
	const struct facets *h = &b->placed[at / LANES];
	struct finish_light f = {
		.to_light = { to->dir[0][i], to->dir[1][i], to->dir[2][i] },
		.eye = { b->eye[0][at + i], b->eye[1][at + i], b->eye[2][at + i] },
		.normal = { h->ns[0][i], h->ns[1][i], h->ns[2][i] },
		.light = rgb_scale(l->colour, to->part[i]), .pigment = p->pigment, .opacity = 1,
		.behind = from->behind[i] != 0, .highlights = true,
	};

	return finish_shade(p->finish, &f);
}

static void ask_eight(struct plain_lanes *b, const struct shader *sh, const struct paint *paint, const struct lamp *l,
		      uint32_t at, uint32_t *painted)
{
	uint32_t left = b->count - at, sort = b->group[at / LANES];
	unsigned lanes = left < LANES ? left : LANES;
	struct from_lamp from;
	struct to_lamp to;

	if (!sort || sort != *painted || lanes < LANES) {
		for (unsigned i = 0; i < LANES; i++)
			paint_lane(b, sh, paint, l->light, i < lanes ? at + i : at, i);
		*painted = sort;
	}
	towards(b, at, l, &to);
	light_all(&b->placed[at / LANES], &to, &b->paint, l->light->colour, b->room.shift, b->room.scale, &from);
	for (unsigned i = 0; i < lanes; i++) {
		const struct paint *p = &paint[b->texture[at + i]];

		if (from.asked[i] == 0)
			continue;
		put_ray(b, &from, at, i);
		if (!p->dull)
			b->light[b->asked - 1] = shine(b, p, l->light, &to, &from, at, i);
	}
}

static void answer(struct plain_lanes *b, const struct shader *sh, uint32_t thread, uint32_t hints, struct seen *out,
		   struct shade_counts *counts)
{
	trace_room_occluded(sh->geometry, thread, b->hidden, b->asked, hints);
	counts->shadow_cast += b->asked;
	for (uint32_t k = 0; k < b->asked; k++) {
		struct seen *s = &out[b->ray[b->asks[k]]];

		if (b->hidden[k])
			counts->shadow_hit++;
		else
			s->colour = rgb_add(s->colour, b->light[k]);
	}
}

void plain_lanes_light(struct plain_lanes *b, const struct shader *sh, const struct paint *paint, uint32_t thread,
		       uint32_t hints, struct seen *out, struct shade_counts *counts)
{
	if (b->count % LANES)
		place(b, sh, b->count - b->count % LANES);
	for (uint32_t i = 0; i < b->count; i++)
		out[b->ray[i]] = (struct seen){ paint[b->texture[i]].base, 0 };
	for (uint32_t j = 0; j < sh->scene->light_count; j++) {
		const struct lamp l = lamp_of(&sh->scene->light[j]);
		uint32_t painted = 0;

		b->asked = 0;
		for (uint32_t at = 0; at < b->count; at += LANES)
			ask_eight(b, sh, paint, &l, at, &painted);
		if (b->asked)
			answer(b, sh, thread, hints, out, counts);
	}
}
