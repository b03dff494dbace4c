/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The short way from a hit to its colour, for what most pixels of many scenes show: an opaque surface of one layer that
 * mirrors nothing, under lamps that are points, in clear air. Nothing is asked for but shadows, so no parts, layers
 * and questions are kept of it; its light goes straight to its node. The operations are those of texture.c, lights.c
 * and fold.c in the same order, and so are the bits; without the factors that are 1 and the terms that are 0.
 */
#include "shade/light.h"
#include "shade/pov/finish.h"
#include "shade/pov/lights.h"
#include "shade/pov/shadow.h"
#include "shade/shade.h"

/* Lamps that one ray asks for; the texture's side is plain_layer()'s. */
bool shade_plain(const struct shader *sh)
{
	const struct scene *s = sh->scene;

	if (sh->indirect.method != INDIRECT_OFF || sh->media || sh->fog || sh->clear_shadows || sh->projected ||
	    sh->lifts || !(s->adc_bailout >= 0 && s->adc_bailout < 1))
		return false;
	for (uint32_t i = 0; i < s->light_count; i++) {
		if (s->light[i].area || s->light[i].area_illumination || s->light[i].shadowless)
			return false;
	}
	return true;
}

const struct layer *plain_layer(const struct shader *sh, const struct texture *tex)
{
	const struct layer *l = tex->layer;

	if (!tex->plain || tex->count != 1 || l->pigment.colour.filter != 0 || l->pigment.colour.transmit != 0 ||
	    finish_is_mirror(&l->finish) || l->finish.irid > 0 || l->finish.crand > 0 ||
	    (sh->subsurface && l->finish.subsurface))
		return NULL;
	return l;
}

bool shade_plain_only(const struct shader *sh)
{
	const struct scene *s = sh->scene;

	if (s->sky || s->rainbow_count || s->camera.normal)
		return false;
	for (uint32_t i = 0; i < s->texture_count; i++) {
		if (!plain_layer(sh, &s->texture[i]))
			return false;
	}
	return true;
}

/* 0 is added as the long way does: it makes -0 a 0. */
struct rgb plain_base(const struct shader *sh, const struct layer *l)
{
	struct rgb own = rgb_add(rgb_mul(l->finish.ambient, sh->scene->ambient_light), l->finish.emission);

	return rgb_add(rgb_make(0, 0, 0), rgb_mul(rgbft_rgb(l->pigment.colour), own));
}

bool plain_hit(const struct shader *sh, struct tree *t, uint32_t to, vec dir, const uint32_t pixel[2],
	       const struct surface *s, uint32_t prim)
{
	bool from_inside = vec_dot(s->ns, dir) > 0;
	const struct layer *layer;
	struct plain *p;
	uint32_t i;

	if ((from_inside && s->interior_texture != SCENE_NONE) || s->texture[0] == SCENE_NONE || !surface_is_even(s))
		return false;
	layer = plain_layer(sh, &sh->scene->texture[s->texture[0]]);
	if (!layer)
		return false;
	i = tree_push(t, &t->plain, 1);
	if (i == TREE_NONE)
		return true;
	p = BUF_AT(&t->plain, struct plain, i);
	p->to = to;
	p->dir = dir;
	p->pixel[0] = pixel[0];
	p->pixel[1] = pixel[1];
	p->lit = finish_needs_light(&layer->finish, false);
	p->colour = plain_base(sh, layer);
	p->skip = s->planar ? prim : ALD_NONE;
	p->light_set = s->light_set;
	p->both_sides = s->flags & OBJECT_DOUBLE_ILLUMINATE;
	p->p = s->p;
	p->n = s->n;
	p->ns = from_inside ? vec_neg(s->ns) : s->ns;
	p->error = s->error;
	p->layer = layer;
	return true;
}

/* A question to each light that can do anything to a surface; false: there is none. */
static bool ask(const struct shader *sh, const struct plain *p, const struct light *l, ald_ray *ray,
		 struct plain_light *out)
{
	struct light_ray r = light_towards(l, p->p, vec_make(0, 0, 0));

	out->behind = false;
	if (!p->both_sides && !(vec_dot(p->ns, r.dir) >= LIGHT_BESIDE)) {
		if (p->layer->finish.diffuse_back == 0)
			return false;
		out->behind = true;
	}
	out->colour = rgb_scale(l->colour, light_attenuation(l, p->p, &r));
	if (shadow_dark(out->colour))
		return false;
	out->dir = r.dir;
	ray->org = shadow_origin(p->p, p->n, p->error, r.dir);
	ray->dir = r.dir;
	ray->tmin = 0;
	ray->tmax = shadow_depth(p->p, r.depth);
	ray->mask = TRACE_SHADOW_OPAQUE;
	ray->skip = p->skip;
	ray->after = ray->after_sub[0] = ray->after_sub[1] = ALD_NONE;
	if (sh->marks)
		trace_mark(ray, p->pixel, TRACE_FOR_SHADOW);
	return true;
}

static void fall(struct tree *t, const struct plain_light *in)
{
	struct plain *p = BUF_AT(&t->plain, struct plain, in->plain);
	struct finish_light f; /* set one by one: clearing it first takes longer */

	f.to_light = in->dir;
	f.eye = p->dir;
	f.normal = p->ns;
	f.light = in->colour;
	f.pigment = rgbft_rgb(p->layer->pigment.colour);
	f.opacity = 1;
	f.noise = 0;
	f.behind = in->behind;
	f.highlights = true;
	f.beneath = false;
	p->colour = rgb_add(p->colour, finish_shade(&p->layer->finish, &f));
}

/* What tree.ray asks. */
static void answer(const struct shader *sh, struct tree *t, uint32_t thread, uint32_t n, uint32_t hints,
		   struct shade_counts *counts)
{
	const uint8_t *hidden = t->hidden.data;

	trace_occluded(sh->geometry, thread, t->ray.data, t->hidden.data, n, hints);
	counts->shadow_cast += n;
	for (uint32_t i = 0; i < n; i++) {
		if (hidden[i])
			counts->shadow_hit++;
		else
			fall(t, BUF_AT(&t->plain_light, struct plain_light, i));
	}
}

void plain_light(const struct shader *sh, struct tree *t, uint32_t thread, uint32_t hints,
		 struct shade_counts *counts)
{
	uint32_t most = t->plain.count;

	if (!most)
		return;
	t->ray.count = t->hidden.count = t->plain_light.count = 0;
	if (tree_push(t, &t->ray, most) == TREE_NONE || tree_push(t, &t->hidden, most) == TREE_NONE ||
	    tree_push(t, &t->plain_light, most) == TREE_NONE)
		return;
	for (uint32_t j = 0; j < sh->scene->light_count; j++) {
		const struct light *l = &sh->scene->light[j];
		uint32_t n = 0;

		for (uint32_t i = 0; i < most; i++) {
			const struct plain *p = BUF_AT(&t->plain, struct plain, i);
			struct plain_light *to = BUF_AT(&t->plain_light, struct plain_light, n);

			if (!p->lit || !scene_lit_by(sh->scene, l, p->light_set) ||
			    !ask(sh, p, l, BUF_AT(&t->ray, ald_ray, n), to))
				continue;
			to->plain = i;
			n++;
		}
		if (n)
			answer(sh, t, thread, n, hints, counts);
	}
}
