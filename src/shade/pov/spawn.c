/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The rays that mirrors and glass ask for (manual 3.4.6.3.6, 3.4.8.1). Refraction by Heckbert's form
 * of Snell's law (Glassner, An Introduction to Ray Tracing, 1989, chapter 7).
 */
#include "base/rng.h"
#include "shade/indirect.h"
#include "shade/pov/interior.h"
#include "shade/pov/shadow.h"
#include "shade/pov/spectrum.h"
#include "shade/shade.h"

#define SAME 1e-10 /* indices closer than this bend nothing */

struct spawn {
	vec dir;
	double weight;
	enum node_kind kind;
	uint32_t inside;
	bool straight, clear_sky;
	double band;
	uint64_t slot; /* of the parent's random numbers */
	uint32_t first; /* the hit's first child, of those that may be shared; TREE_NONE: none may */
};

/*
 * The child that is this ray already, or TREE_NONE. Textures that are blended and layers that all mirror ask for the
 * same rays, each for itself, in POV-Ray: trees of 4 to the power of their depth where 2 do. One node serves them all,
 * with the mean of their weights, so that as much is cut off for faintness as where each goes its way; what it is
 * inside of is the same, as one hit has one interior.
 */
static uint32_t find_node(struct tree *t, const struct spawn *s)
{
	for (uint32_t i = s->first; i < t->node.count; i++) {
		struct node *n = BUF_AT(&t->node, struct node, i);

		if (n->dir.x != s->dir.x || n->dir.y != s->dir.y || n->dir.z != s->dir.z || n->kind != s->kind ||
		    n->straight != s->straight || n->clear_sky != s->clear_sky || n->band != s->band)
			continue;
		n->weight += (s->weight - n->weight) / (++n->sharers + 1);
		return i;
	}
	return TREE_NONE;
}

/* A child of m's node, or TREE_NONE if it is too deep or too faint. */
static uint32_t add_node(const struct shader *sh, struct tree *t, const struct met *m,
			 const struct spawn *s)
{
	static const struct node blank = { .skip = ALD_NONE };
	const struct node *parent = BUF_AT(&t->node, struct node, m->node); /* gone after the push */
	struct node *n;
	uint32_t level = parent->level + (parent->straight ? 0 : 1), i;
	uint32_t bounce = parent->bounce, path = parent->path, beneath = parent->beneath;
	double way = parent->way + m->t;
	uint64_t key = rng_child(parent->key, s->slot);
	double spread = parent->spread, width = parent->width + spread * m->t;
	uint32_t x = parent->pixel[0], y = parent->pixel[1];
	bool seen_in_mirror = parent->mirrored || s->kind == NODE_REFLECTED;

	if (!shade_worth(sh, bounce, level, s->weight))
		return TREE_NONE;
	i = find_node(t, s);
	if (i != TREE_NONE)
		return i;
	i = tree_push(t, &t->node, 1);
	if (i == TREE_NONE)
		return i;
	n = BUF_AT(&t->node, struct node, i);
	*n = blank;
	n->org = shadow_origin(m->p, m->n, m->error, s->dir);
	n->dir = s->dir;
	n->weight = s->weight;
	n->key = key;
	n->width = width;
	n->spread = spread;
	n->band = s->band;
	n->level = level;
	n->bounce = bounce;
	n->path = path;
	n->beneath = beneath;
	n->way = way;
	n->inside = s->inside;
	n->skip = m->skip;
	n->pixel[0] = x;
	n->pixel[1] = y;
	n->kind = s->kind;
	n->straight = s->straight;
	n->mirrored = seen_in_mirror;
	n->clear_sky = s->clear_sky;
	return i;
}

static vec mirrored(vec dir, vec normal, vec raw)
{
	vec d = vec_mad(dir, normal, -2 * vec_dot(dir, normal));
	double below = vec_dot(d, raw);

	/* A bumped normal can throw the ray into the surface: then the raw normal decides. */
	if (below < 0 && vec_dot(d, normal) < 0)
		d = vec_mad(dir, raw, -2 * vec_dot(dir, raw));
	else if (below < 0)
		d = vec_mad(d, raw, -2 * below);
	return vec_unit(d);
}

static double strongest(struct rgb c)
{
	return fmax(fabs(c.r), fmax(fabs(c.g), fabs(c.b)));
}

/* Bent by a surface of this ratio of indices, or totally reflected by it. */
static void refract(struct spawn *s, const struct spawn *ray, const struct met *m, vec normal, double ratio)
{
	double c = -vec_dot(ray->dir, normal), k = 1 + ratio * ratio * (c * c - 1);

	if (k < 0) {
		s->dir = mirrored(ray->dir, normal, m->ns); /* as it was, not turned: measured */
		s->kind = NODE_REFLECTED;
		s->inside = ray->inside;
		s->clear_sky = false;
		return;
	}
	if (c < 0) { /* a bent normal that looks away is turned, as in POV-Ray */
		normal = vec_neg(normal);
		c = -c;
	}
	s->dir = vec_unit(vec_mad(vec_scale(ray->dir, ratio), normal, ratio * c - sqrt(k)));
}

/*
 * White light in bands. What all bands do alike is done once: those that are totally reflected, which are next to
 * each other as the indices rise with the bands or fall, are one white ray.
 */
static void split(const struct shader *sh, struct tree *t, const struct met *m, uint32_t part, const struct spawn *ray,
		  struct spawn *s, const struct crossing *at)
{
	struct part p = *BUF_AT(&t->part, struct part, part);
	struct spawn total = *s;

	p.total_from = p.total_to = 0;
	p.bands = at->bands;
	for (uint32_t i = 0; i < at->bands; i++) {
		struct spawn one = *s;
		uint32_t child;

		one.band = spectrum_band(i, at->bands);
		one.slot = rng_child(s->slot, i);
		one.first = TREE_NONE; /* bands stand one after another */
		refract(&one, ray, m, p.normal, spectrum_ior(at->ratio, at->dispersion, one.band));
		if (one.kind == NODE_REFLECTED) {
			p.total_from = p.total_to ? p.total_from : i;
			p.total_to = i + 1;
			total = one;
			continue;
		}
		child = add_node(sh, t, m, &one);
		if (child == TREE_NONE)
			return; /* so will all the others be */
		p.through = p.through == TREE_NONE ? child : p.through;
	}
	if (p.total_to) {
		uint32_t child;

		total.band = 0;
		total.first = TREE_NONE;
		child = add_node(sh, t, m, &total);
		if (child == TREE_NONE)
			return;
		p.through = p.through == TREE_NONE ? child : p.through;
	}
	*BUF_AT(&t->part, struct part, part) = p;
}

/* Through the surface: straight on, bent, split, or totally reflected. */
static void spawn_through(const struct shader *sh, struct tree *t, const struct met *m, uint32_t part,
			  uint32_t first)
{
	struct part *p = BUF_AT(&t->part, struct part, part);
	const struct node *n = BUF_AT(&t->node, struct node, m->node);
	struct spawn s = { .dir = n->dir,
			   .weight = n->weight * strongest(p->filter),
			   .kind = NODE_REFRACTED,
			   .inside = n->inside,
			   .clear_sky = n->clear_sky,
			   .band = n->band,
			   .slot = 2 * (uint64_t)(part - m->first_part),
			   .first = first };
	const struct spawn ray = s;
	struct crossing at;
	uint32_t child;
	double scale;

	if (inside_contains(t, n->inside, m->object))
		p->fade = interior_fade(sh->scene, m->interior, m->t);
	at = interior_cross(sh->scene, t, &s.inside, m);
	if (fabs(at.dispersion - 1) >= SAME) {
		if (n->band == 0) {
			split(sh, t, m, part, &ray, &s, &at);
			return;
		}
		refract(&s, &ray, m, p->normal, spectrum_ior(at.ratio, at.dispersion, n->band));
	} else if (fabs(at.ratio - 1) < SAME) {
		s.straight = true;
	} else {
		refract(&s, &ray, m, p->normal, at.ratio);
	}
	p->total = s.kind == NODE_REFLECTED;
	if (!p->total) {
		if (!indirect_follow(sh, n, s.slot, strongest(rgb_mul(p->filter, p->fade)), &scale))
			return;
		p->fade = rgb_scale(p->fade, scale);
	}
	child = add_node(sh, t, m, &s);
	BUF_AT(&t->part, struct part, part)->through = child;
}

static void spawn_mirror(const struct shader *sh, struct tree *t, const struct met *m, uint32_t mirror,
			 uint32_t slot, uint32_t first)
{
	struct mirror *r = BUF_AT(&t->mirror, struct mirror, mirror);
	const struct node *n = BUF_AT(&t->node, struct node, m->node);
	struct spawn s = { .dir = mirrored(n->dir, r->normal, m->ns),
			   .weight = r->weight,
			   .kind = NODE_REFLECTED,
			   .inside = n->inside,
			   .band = n->band,
			   .slot = 2 * (uint64_t)slot + 1,
			   .first = first };
	double scale;
	uint32_t child;

	/* An exponent bends what comes, which has to be there whole. */
	if (r->exponent == 1) {
		if (!indirect_follow(sh, n, s.slot, strongest(r->reflectivity), &scale))
			return;
		r->reflectivity = rgb_scale(r->reflectivity, scale);
	}
	child = add_node(sh, t, m, &s);
	BUF_AT(&t->mirror, struct mirror, mirror)->child = child;
}

void shade_spawn(const struct shader *sh, struct tree *t)
{
	for (uint32_t i = 0; i < t->met.count && !t->no_memory; i++) {
		const struct met m = *BUF_AT(&t->met, struct met, i);
		const struct node *n = BUF_AT(&t->node, struct node, m.node);
		double bailout = shade_bailout(sh, n->bounce);
		uint32_t slot = 0;
		/* What the camera itself sees is traced as in POV-Ray. */
		uint32_t first = n->kind == NODE_CAMERA ? TREE_NONE : t->node.count;

		for (uint32_t j = m.first_part; j < m.first_part + m.part_count; j++) {
			const struct part *p = BUF_AT(&t->part, struct part, j);

			if (p->clear > bailout)
				spawn_through(sh, t, &m, j, first);
			p = BUF_AT(&t->part, struct part, j);
			if (p->total) {
				BUF_AT(&t->part, struct part, j)->mirror_count = 0;
				continue;
			}
			for (uint32_t k = 0; k < p->mirror_count; k++)
				spawn_mirror(sh, t, &m, p->first_mirror + k, slot++, first);
		}
		indirect_spawn(sh, t, &m);
	}
}
