/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Light at the hits of a wave (manual 3.4.4).
 *
 * Point lights ask one shadow question a hit. An area light is a grid of points, of which POV-Ray asks
 * the corners, then those between where they differ by more than a tenth or the adaptive level is not
 * yet reached; the mean of the four quarters is taken, so the points do not weigh alike. As the answers
 * come in batches, the recursion is run anew each round with what is known so far, until it needs
 * nothing more.
 */
#include "base/rng.h"
#include "shade/light.h"
#include "shade/pov/finish.h"
#include "shade/pov/lights.h"
#include "shade/pov/shadow.h"
#include "shade/shade.h"

#define SOFT_LEAST 4 /* rounds, where one is not enough */
#define SOFT_EVEN 20 /* points that all agree are enough */
#define SOFT_ERROR 0.01 /* of the light */

/* To gathered rays an area light is a point, as in POV-Ray. */
static bool wide(const struct light *l, const struct node *n)
{
	return l->area && !n->bounce;
}

static bool spread(const struct light *l, const struct node *n)
{
	return wide(l, n) && l->area_illumination;
}

static const struct node *node_of(const struct tree *t, const struct met *m)
{
	return BUF_AT(&t->node, struct node, m->node);
}

/* Can light from dir do anything to a layer? Sets behind: only the second value of diffuse takes it.
 * Measured: with area_illumination a lamp that is a point, be it to gathered rays only, shines on both sides
 * of what it is not hidden from. */
static bool falls_on(const struct lit_layer *layer, const struct light *l, const struct met *m,
		     const struct node *n, vec dir, bool *behind)
{
	*behind = false;
	if (m->flags & OBJECT_DOUBLE_ILLUMINATE || (l->area_illumination && !wide(l, n)))
		return true;
	if (vec_dot(layer->normal, dir) >= LIGHT_BESIDE)
		return true;
	*behind = layer->finish->diffuse_back != 0;
	return *behind;
}

static bool wanted(const struct tree *t, const struct light *l, const struct met *m, vec dir)
{
	const struct node *n = node_of(t, m);
	bool behind;

	if (spread(l, n)) /* its points lie in many directions: asked for one by one later */
		return m->layer_count > 0;
	for (uint32_t i = 0; i < m->layer_count; i++) {
		if (falls_on(BUF_AT(&t->layer, struct lit_layer, m->first_layer + i), l, m, n, dir, &behind))
			return true;
	}
	return false;
}

/* Hanika's remedy for the terminator of coarse meshes: the ray starts above the face, on the light's side. */
static void lift(const struct tree *t, const struct light *l, const struct met *m, struct shadow *s)
{
	const struct lift *f = BUF_AT(&t->lift, struct lift, m->lift - 1);
	bool near = vec_dot(m->ns, s->dir) >= 0;
	vec up = near ? f->near : f->far, to = vec_sub(vec_scale(s->dir, s->depth), up);
	double length = vec_length(to);

	s->org = vec_mad(vec_add(m->p, up), m->n, (vec_dot(m->n, m->ns) >= 0) == near ? m->error : -m->error);
	s->skip = ALD_NONE; /* above it, the face itself may well be in the way: in a hollow, from behind */
	if (l->parallel || !(length > 0))
		return;
	s->dir = vec_scale(to, 1 / length);
	s->depth = length;
}

static void ask(const struct shader *sh, struct tree *t, const struct light *l, const struct met *m,
		const struct node *n, const struct light_ray *r, struct rgb colour)
{
	bool air = shade_sees_air(sh, n);
	uint32_t i = tree_push(t, &t->shadow, 1);

	if (i == TREE_NONE)
		return;
	*BUF_AT(&t->shadow, struct shadow, i) =
		(struct shadow){ .org = shadow_origin(m->p, m->n, m->error, r->dir),
				 .dir = r->dir,
				 .depth = shadow_depth(m->p, r->depth),
				 .skip = m->skip,
				 .pixel = { n->pixel[0], n->pixel[1] },
				 .inside = n->inside,
				 .air = l->attenuated && !l->no_media && air,
				 .vacuum = !air,
				 .shadowless = l->shadowless,
				 .projector = l->projected ? (uint32_t)(l - sh->scene->light) :
							     SCENE_NONE,
				 .colour = colour };
	if (m->lift)
		lift(t, l, m, BUF_AT(&t->shadow, struct shadow, i));
}

/* A grid for an area light: all unknown. */
static uint32_t new_grid(struct tree *t, const struct light *l)
{
	uint32_t n = l->size1 * l->size2, first = tree_push(t, &t->cell, n);

	if (first == TREE_NONE)
		return first;
	for (uint32_t i = 0; i < n; i++)
		*BUF_AT(&t->cell, struct cell, first + i) = (struct cell){ .known = false };
	return first;
}

static uint32_t new_soft(struct tree *t)
{
	uint32_t i = tree_push(t, &t->soft, 1);

	if (i != TREE_NONE)
		*BUF_AT(&t->soft, struct soft, i) = (struct soft){ .rounds = 0 };
	return i;
}

/* One light at one hit: is it worth asking, and with what colour. */
static bool ask_light(const struct shader *sh, struct tree *t, uint32_t hit, uint32_t light, bool surface)
{
	const struct light *l = &sh->scene->light[light];
	const struct met *m = BUF_AT(&t->met, struct met, hit);
	struct light_ray r = light_towards(l, m->p, vec_make(0, 0, 0));
	double a = surface && spread(l, node_of(t, m)) ? 1 : light_attenuation(l, m->p, &r);
	struct lit lit = { .hit = hit,
			   .light = light,
			   .dir = r.dir,
			   .depth = r.depth,
			   .colour = rgb_scale(l->colour, a),
			   .grid = TREE_NONE,
			   .soft = TREE_NONE };
	uint32_t i;

	if (shadow_dark(lit.colour) || (surface && !wanted(t, l, m, r.dir)))
		return false;
	if (wide(l, node_of(t, m)) && !l->shadowless) {
		lit.grid = new_grid(t, l);
		if (lit.grid == TREE_NONE)
			return false;
		if (surface && l->jitter && l->size1 * l->size2 > 1 && sh->soft_rounds > 1)
			lit.soft = new_soft(t);
	}
	i = tree_push(t, &t->lit, 1);
	if (i == TREE_NONE)
		return false;
	*BUF_AT(&t->lit, struct lit, i) = lit;
	return true;
}

bool lights_ask(const struct shader *sh, struct tree *t, uint32_t hit, uint32_t light)
{
	return ask_light(sh, t, hit, light, false);
}

/* A question to it is one ray. */
static bool is_asked(const struct lit *lit, const struct light *l)
{
	return lit->grid == TREE_NONE && (!l->shadowless || l->projected);
}

/* Shadow questions of the point lights, answered in the order they were asked. */
static void ask_points(const struct shader *sh, struct tree *t, uint32_t thread, uint32_t hints,
		       struct shade_counts *counts)
{
	uint32_t next = 0;

	for (uint32_t i = 0; i < t->lit.count; i++) {
		const struct lit *lit = BUF_AT(&t->lit, struct lit, i);
		const struct met *m = BUF_AT(&t->met, struct met, lit->hit);
		const struct light *l = &sh->scene->light[lit->light];
		struct light_ray r = { lit->dir, lit->depth };

		if (is_asked(lit, l))
			ask(sh, t, l, m, node_of(t, m), &r, lit->colour);
	}
	shadow_trace(sh, t, thread, 0, hints, counts);
	if (t->no_memory)
		return;
	for (uint32_t i = 0; i < t->lit.count; i++) {
		struct lit *lit = BUF_AT(&t->lit, struct lit, i);

		if (is_asked(lit, &sh->scene->light[lit->light]))
			lit->colour = BUF_AT(&t->shadow, struct shadow, next++)->colour;
	}
}

/* An area light at one hit while its grid is being filled. */
struct area {
	const struct shader *sh;
	struct tree *t;
	const struct light *l;
	const struct met *m;
	const struct node *n;
	struct lit *lit;
	vec axis1, axis2;
	uint64_t key;
	uint32_t round;
	bool complete;
};

static bool area_cell(struct area *a, uint32_t u, uint32_t v, struct rgb *out)
{
	uint32_t index = a->lit->grid + u * a->l->size2 + v, i;
	struct cell *c = BUF_AT(&a->t->cell, struct cell, index);
	struct light_ray r;

	*out = c->colour;
	if (c->known)
		return true;
	a->complete = false;
	if (c->asked)
		return false;
	r = light_towards(a->l, a->m->p,
			  light_grid_point(a->l, a->axis1, a->axis2, u, v,
					   rng_child(a->key, u * a->l->size2 + v), a->round));
	i = tree_push(a->t, &a->t->asked, 1);
	if (i == TREE_NONE)
		return false;
	*BUF_AT(&a->t->asked, uint32_t, i) = index;
	c->asked = true;
	ask(a->sh, a->t, a->l, a->m, a->n, &r, a->lit->colour);
	return false;
}

static double distance(struct rgb a, struct rgb b)
{
	return fabs(a.r - b.r) + fabs(a.g - b.g) + fabs(a.b - b.b);
}

static bool differ(const struct rgb c[4])
{
	return distance(c[0], c[1]) > 0.1 || distance(c[1], c[3]) > 0.1 || distance(c[3], c[2]) > 0.1 ||
	       distance(c[2], c[0]) > 0.1;
}

/* The part of the grid from (u1, v1) to (u2, v2). Its depth is the logarithm of the grid's size. */
static struct rgb area_part(struct area *a, uint32_t u1, uint32_t v1, uint32_t u2, uint32_t v2,
			    uint32_t level)
{
	uint32_t ul = (u1 + u2) / 2, ur = (u1 + u2 + 1) / 2, vl = (v1 + v2) / 2, vr = (v1 + v2 + 1) / 2;
	bool known = true, finer = u2 - u1 > 1 || v2 - v1 > 1;
	struct rgb c[4];

	known &= area_cell(a, u1, v1, &c[0]);
	known &= area_cell(a, u2, v1, &c[1]);
	known &= area_cell(a, u1, v2, &c[2]);
	known &= area_cell(a, u2, v2, &c[3]);
	if (finer && (level < a->l->adaptive || (known && differ(c)))) {
		c[0] = area_part(a, u1, v1, ul, vl, level + 1);
		c[1] = area_part(a, ur, v1, u2, vl, level + 1);
		c[2] = area_part(a, u1, vr, ul, v2, level + 1);
		c[3] = area_part(a, ur, vr, u2, v2, level + 1);
	}
	return rgb_scale(rgb_add(rgb_add(rgb_add(c[0], c[1]), c[2]), c[3]), 0.25);
}

/* How many points of the grid were asked for, if all brought this; or 0. */
static uint32_t even(const struct area *a, struct rgb colour)
{
	const struct cell *c = BUF_AT(&a->t->cell, struct cell, a->lit->grid);
	uint32_t n = 0;

	for (uint32_t i = 0; i < a->l->size1 * a->l->size2; i++) {
		if (c[i].known && distance(c[i].colour, colour) > 1e-6)
			return 0;
		n += c[i].known;
	}
	return n;
}

/* The standard error of one channel's mean. */
static double soft_error(double sum, double square, double n)
{
	double mean = sum / n;

	return sqrt(fmax(0, square / n - mean * mean) / (n - 1));
}

/*
 * POV-Ray asks a jittered grid once, and leaves noise. Here its mean over all jitters is sought: the grid is
 * asked again until the mean's standard error, for independent rounds, is small; theirs are not, and do
 * better.
 */
static bool soft_enough(const struct shader *sh, const struct area *a, const struct soft *s)
{
	double n = s->rounds, e, full = rgb_max(a->l->colour);

	if (s->rounds >= sh->soft_rounds)
		return true;
	if (s->points)
		return s->points >= SOFT_EVEN;
	e = fmax(soft_error(s->sum.r, s->square.r, n), soft_error(s->sum.g, s->square.g, n));
	e = fmax(e, soft_error(s->sum.b, s->square.b, n));
	return s->rounds >= SOFT_LEAST && e * a->n->weight <= SOFT_ERROR * full;
}

/* One more round of the light is known: c becomes the mean if it is enough, or all cells are unknown anew. */
static bool soft_round(const struct shader *sh, const struct area *a, struct rgb *c)
{
	struct soft *s = BUF_AT(&a->t->soft, struct soft, a->lit->soft);
	struct cell *cell = BUF_AT(&a->t->cell, struct cell, a->lit->grid);
	uint32_t points;

	s->sum = rgb_add(s->sum, *c);
	s->square = rgb_add(s->square, rgb_mul(*c, *c));
	points = even(a, rgb_scale(s->sum, 1.0 / (s->rounds + 1)));
	s->points = points && (s->points || !s->rounds) ? s->points + points : 0;
	s->rounds++;
	if (soft_enough(sh, a, s)) {
		*c = rgb_scale(s->sum, 1.0 / s->rounds);
		return true;
	}
	for (uint32_t i = 0; i < a->l->size1 * a->l->size2; i++)
		cell[i] = (struct cell){ .known = false };
	return false;
}

static void area_round(const struct shader *sh, struct tree *t, struct lit *lit, bool *complete)
{
	struct area a = { .sh = sh, .t = t, .l = &sh->scene->light[lit->light], .lit = lit, .complete = true };
	struct rgb c;

	a.m = BUF_AT(&t->met, struct met, lit->hit);
	a.n = BUF_AT(&t->node, struct node, a.m->node);
	a.key = rng_child(a.n->key, 0x100000000u + lit->light);
	light_axes(a.l, a.m->p, &a.axis1, &a.axis2);
	if (lit->soft != TREE_NONE)
		a.round = BUF_AT(&t->soft, struct soft, lit->soft)->rounds;
	else
		a.round = a.m->round;
	c = area_part(&a, 0, 0, a.l->size1 - 1, a.l->size2 - 1, 0);
	if (a.complete && (lit->soft == TREE_NONE || soft_round(sh, &a, &c))) {
		lit->colour = c;
		lit->grid = TREE_NONE;
	} else {
		*complete = false;
	}
}

static void ask_areas(const struct shader *sh, struct tree *t, uint32_t thread,
		      struct shade_counts *counts)
{
	bool complete = false;

	while (!complete && !t->no_memory) {
		complete = true;
		t->shadow.count = t->asked.count = 0;
		for (uint32_t i = 0; i < t->lit.count; i++) {
			struct lit *lit = BUF_AT(&t->lit, struct lit, i);

			if (lit->grid != TREE_NONE)
				area_round(sh, t, lit, &complete);
		}
		if (t->no_memory)
			return;
		shadow_trace(sh, t, thread, 0, 0, counts);
		for (uint32_t i = 0; i < t->asked.count; i++) {
			struct cell *c = BUF_AT(&t->cell, struct cell, *BUF_AT(&t->asked, uint32_t, i));

			c->colour = BUF_AT(&t->shadow, struct shadow, i)->colour;
			c->known = true;
		}
	}
}

void lights_answer(const struct shader *sh, struct tree *t, uint32_t thread, uint32_t hints,
		   struct shade_counts *counts)
{
	ask_points(sh, t, thread, hints, counts);
	if (!t->no_memory)
		ask_areas(sh, t, thread, counts);
}

/* Light of one colour and direction on all layers of a hit. */
static void fall(const struct shader *sh, struct tree *t, const struct met *m, const struct light *l, vec dir, vec eye,
		 struct rgb colour)
{
	for (uint32_t i = 0; i < m->layer_count; i++) {
		const struct lit_layer *layer = BUF_AT(&t->layer, struct lit_layer, m->first_layer + i);
		struct part *p = BUF_AT(&t->part, struct part, layer->part);
		struct finish_light f = { .to_light = dir,
					  .eye = eye,
					  .normal = layer->normal,
					  .light = colour,
					  .pigment = layer->pigment,
					  .opacity = layer->opacity,
					  .beneath = layer->beneath,
					  .highlights = !l->shadowless && !node_of(t, m)->bounce };

		struct rgb c;

		if (!falls_on(layer, l, m, node_of(t, m), dir, &f.behind))
			continue;
		if (layer->finish->crand > 0)
			f.noise = rng_unit(rng_child(rng_child(node_key(node_of(t, m)), 0x400000000u + i),
						     (uint64_t)(l - sh->scene->light)));
		c = finish_shade(layer->finish, &f);
		if (layer->finish->irid > 0)
			c = rgb_mul(c, finish_irid(sh->scene, layer->finish, dir, eye, layer->normal, m->p));
		p->own = rgb_add(p->own, rgb_mul(layer->filter, c));
	}
}

/* area_illumination: every point of the grid shines by itself, all with the shadow of the whole. */
static void fall_spread(const struct shader *sh, struct tree *t, const struct met *m, const struct light *l, vec eye,
			struct rgb colour, uint64_t key)
{
	struct rgb each = rgb_scale(colour, 1.0 / ((double)l->size1 * l->size2));
	vec axis1, axis2;

	light_axes(l, m->p, &axis1, &axis2);
	for (uint32_t v = 0; v < l->size2; v++) {
		for (uint32_t u = 0; u < l->size1; u++) {
			vec shift = light_grid_point(l, axis1, axis2, u, v,
						     rng_child(key, u * l->size2 + v), m->round);
			struct light_ray r = light_towards(l, m->p, shift);

			fall(sh, t, m, l, r.dir, eye, rgb_scale(each, light_attenuation(l, m->p, &r)));
		}
	}
}

void shade_light(const struct shader *sh, struct tree *t, uint32_t thread, uint32_t hints,
		 struct shade_counts *counts)
{
	/* Light by light, so that rays which follow each other go to the same one. */
	for (uint32_t j = 0; j < sh->scene->light_count; j++) {
		for (uint32_t i = 0; i < t->met.count; i++) {
			const struct met *m = BUF_AT(&t->met, struct met, i);

			if (m->layer_count && scene_lit_by(sh->scene, &sh->scene->light[j], m->light_set))
				ask_light(sh, t, i, j, true);
		}
	}
	lights_answer(sh, t, thread, hints, counts);
	if (t->no_memory)
		return;
	for (uint32_t i = 0; i < t->lit.count; i++) {
		const struct lit *lit = BUF_AT(&t->lit, struct lit, i);
		const struct met *m = BUF_AT(&t->met, struct met, lit->hit);
		const struct node *n = BUF_AT(&t->node, struct node, m->node);
		const struct light *l = &sh->scene->light[lit->light];

		if (shadow_dark(lit->colour))
			continue;
		if (spread(l, n))
			fall_spread(sh, t, m, l, n->dir, lit->colour,
				    rng_child(n->key, 0x200000000u + lit->light));
		else
			fall(sh, t, m, l, lit->dir, n->dir, lit->colour);
	}
}
