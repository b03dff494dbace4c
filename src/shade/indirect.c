/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Gathering as POV-Ray's radiosity block describes it (manual 3.4.4.3), without its cache: each hit is a
 * sample of its own. What a gathered ray sees was found by reading and by measuring POV-Ray 3.7
 * (the scenes of tests/indirect): no highlights, area lights as points, neither fog nor media unless
 * asked for, mirrors and glass as other rays see them, a level and a weight of its own, and the block's
 * adc_bailout. Whether a hit gathers at all is decided by the first layer that would show enough of
 * it. Light of the far side is what the second value of diffuse takes. An object's importance only decides
 * how many rays are spent on it.
 *
 * Directions come from low-discrepancy sequences, one for each hit and each bounce after it, and are mapped
 * to the hemisphere through the disc of Shirley and Chiu (1997). With a cache, hits that the camera sees
 * ask it first; while it is being filled, those that it cannot answer become its records.
 */
#include "shade/indirect.h"

#include "base/sobol.h"
#include "shade/cache.h"
#include "shade/frame.h"
#include "shade/pov/shadow.h"

#define GATHER_SLOT 0x500000000u /* of a node's random numbers; two for each gather */
#define ROULETTE_SLOT 0x600000000u /* the same, for each child */
#define FOLLOWED 2 /* times its share is the chance that a child is followed */
#define TRIES 32
#define LEAST_PIXELS 0.5 /* a record's radius, without slack; measured in hair: RMSE 0.011 with 2, 0.003 with this */
#define PI 3.14159265358979323846

vec indirect_hemisphere(vec normal, double u, double v)
{
	double a = 2 * u - 1, b = 2 * v - 1, r, phi;

	if (fabs(a) > fabs(b)) {
		r = a;
		phi = PI / 4 * (b / a);
	} else {
		r = b;
		phi = b == 0 ? 0 : PI / 2 - PI / 4 * (a / b);
	}
	return frame_around(normal, r * cos(phi), r * sin(phi), sqrt(fmax(0, 1 - r * r)));
}

vec indirect_direction(vec normal, uint32_t index, uint64_t key)
{
	struct sobol s = sobol_make(key);

	return indirect_hemisphere(normal, sobol_at(&s, index, 0), sobol_at(&s, index, 1));
}

struct indirect_part indirect_part(const struct shader *sh, const struct node *n)
{
	return (struct indirect_part){ .wanted = sh->indirect.method != INDIRECT_OFF &&
						 n->bounce < sh->scene->radiosity.recursion_limit,
				       .front = TREE_NONE,
				       .back = TREE_NONE };
}

static bool same(vec a, vec b)
{
	return a.x == b.x && a.y == b.y && a.z == b.z;
}

/*
 * Every surface that mirrors asks for two rays or more, so that a path of several bounces becomes a large tree,
 * which brings little: a path is one sample of hundreds. Paths of one set share their keys and differ by their
 * numbers, so the chances are stratified over them. max_sample is no mean: light has to come as evenly as it can.
 */
bool indirect_follow(const struct shader *sh, const struct node *n, uint64_t slot, double share, double *scale)
{
	double chance = FOLLOWED * share;
	struct sobol s;

	*scale = 1;
	if (!n->bounce || !(chance < 1) || sh->scene->radiosity.max_sample > 0)
		return true;
	*scale = 1 / chance;
	s = sobol_make(rng_child(n->key, ROULETTE_SLOT + slot));
	return sobol_at(&s, n->path, 0) < chance;
}

/* The hit's gather around this normal, made if there is none. */
static uint32_t find_gather(struct tree *t, const struct met *m, vec normal, bool around_raw, bool back)
{
	uint32_t i;

	for (i = m->first_gather; i < t->gather.count; i++) {
		const struct gather *g = BUF_AT(&t->gather, struct gather, i);

		if (same(g->normal, normal) && g->back == back)
			return i;
	}
	i = tree_push(t, &t->gather, 1);
	if (i != TREE_NONE)
		*BUF_AT(&t->gather, struct gather, i) =
			(struct gather){ .normal = normal, .around_raw = around_raw, .back = back };
	return i;
}

static void add_side(const struct shader *sh, struct tree *t, const struct met *m, uint32_t *gather,
		     struct rgb colour, vec normal, bool back, double share)
{
	const struct node *n = BUF_AT(&t->node, struct node, m->node);
	vec raw = back ? vec_neg(m->ns) : m->ns;
	struct gather *g;

	if (*gather == TREE_NONE) {
		if (!(rgb_grey(colour) > shade_bailout(sh, n->bounce)))
			return;
		if (!sh->scene->radiosity.normal)
			normal = raw;
		*gather = find_gather(t, m, normal, same(normal, raw), back);
		if (*gather == TREE_NONE)
			return;
	}
	g = BUF_AT(&t->gather, struct gather, *gather);
	g->factor = rgb_add(g->factor, rgb_scale(colour, share));
}

void indirect_layer(const struct shader *sh, struct tree *t, const struct met *m,
		    struct indirect_part *p, const struct finish *f, struct rgb colour, vec normal, double share)
{
	add_side(sh, t, m, &p->front, rgb_scale(colour, f->indirect), normal, false, share);
	if (f->indirect_back != 0)
		add_side(sh, t, m, &p->back, rgb_scale(colour, f->indirect_back), vec_neg(normal), true,
			 share);
}

/* How many rays: fewer where the pixel shows little of them, a power of two, as the points are best
 * then, and enough for each replication to have some. */
uint32_t indirect_power(double want)
{
	uint32_t count = 1;

	while (count * 1.4142 < want)
		count *= 2;
	return count;
}

static uint32_t ray_count(const struct shader *sh, const struct node *n, const struct gather *g)
{
	double share = fmin(1, n->weight) * fmin(1, rgb_max(g->factor));

	return indirect_power((double)sh->indirect.samples / sh->indirect.replications * share) *
	       sh->indirect.replications;
}

/* A bent normal may throw rays into the surface; POV-Ray takes other directions then. */
static vec above(const struct gather *g, const struct met *m, vec dir, uint32_t index, uint64_t key)
{
	vec raw = g->back ? vec_neg(m->ns) : m->ns;

	if (g->around_raw)
		return dir;
	for (uint64_t i = 0; i < TRIES && vec_dot(dir, raw) <= 0; i++)
		dir = indirect_direction(g->normal, index, rng_child(key, i));
	return vec_dot(dir, raw) > 0 ? dir : indirect_direction(raw, index, key);
}

/* Strata for a record: Ward's gradients need to know which rays are neighbours. */
static vec stratum_direction(const struct shader *sh, const struct gather *g, uint32_t i, uint64_t key)
{
	struct cache_grid grid = cache_grid(sh->indirect.samples);

	return cache_direction(&grid, g->normal, i, rng_unit(rng_child(key, 2 * i + 2)),
			       rng_unit(rng_child(key, 2 * i + 3)));
}

static void fill_rays(const struct shader *sh, struct tree *t, const struct met *m, const struct gather *g,
		      uint64_t slot)
{
	const struct node parent = *BUF_AT(&t->node, struct node, m->node);
	const struct radiosity *r = &sh->scene->radiosity;
	uint32_t set = g->count / g->replications;
	struct node child = { .weight = fmax(r->adc_bailout, pow(0.5 * r->brightness, parent.bounce + 1)),
			      .level = indirect_level(parent.bounce + 1),
			      .bounce = parent.bounce + 1,
			      .beneath = parent.beneath,
			      .inside = TREE_NONE,
			      .skip = m->skip,
			      .pixel = { parent.pixel[0], parent.pixel[1] },
			      .kind = NODE_GATHERED };

	for (uint32_t i = 0; i < g->count; i++) {
		uint64_t key = rng_child(parent.key, slot);

		if (!parent.bounce)
			key = rng_child(key, i / set);
		child.path = parent.bounce ? parent.path : parent.path * set + i % set;
		child.key = rng_child(key, 1);
		child.dir = g->recorded ? stratum_direction(sh, g, i, key) :
					  indirect_direction(g->normal, child.path, key);
		child.dir = above(g, m, child.dir, child.path, key);
		child.org = shadow_origin(m->p, m->n, m->error, child.dir);
		*BUF_AT(&t->node, struct node, g->first + i) = child;
	}
}

/* What the cache knows; and whether what it does not know becomes a record. */
static void ask_cache(const struct shader *sh, const struct node *n, const struct met *m, struct gather *g)
{
	const struct indirect *in = &sh->indirect;

	g->known = cache_find(in->cache, m->p, g->normal, in->filling ? 1 : CACHE_REACH, &g->light);
	g->recorded = in->filling && !g->known;
	g->p = m->p;
	g->pixel = in->pixel + in->pixel_angle * (n->way + m->t);
}

static uint32_t gather_size(const struct shader *sh, const struct node *n, struct gather *g, uint64_t slot)
{
	struct cache_grid grid;
	double scale;

	if (g->known)
		return 0;
	if (n->bounce) {
		if (!indirect_follow(sh, n, slot, rgb_max(g->factor), &scale))
			return 0;
		g->factor = rgb_scale(g->factor, scale);
		return 1;
	}
	if (!g->recorded)
		return ray_count(sh, n, g);
	grid = cache_grid(sh->indirect.samples);
	return grid.rows * grid.columns;
}

void indirect_spawn(const struct shader *sh, struct tree *t, const struct met *m)
{
	const struct node *n = BUF_AT(&t->node, struct node, m->node);

	for (uint32_t i = 0; i < n->gather_count; i++) {
		struct gather *g = BUF_AT(&t->gather, struct gather, n->first_gather + i);

		if (sh->indirect.cache && !n->bounce)
			ask_cache(sh, n, m, g);
		g->count = gather_size(sh, n, g, GATHER_SLOT + i);
		if (!g->count)
			continue;
		g->replications = n->bounce ? 1 : sh->indirect.replications;
		g->first = tree_push(t, &t->node, g->count);
		if (g->first == TREE_NONE) {
			g->count = 0;
			return;
		}
		fill_rays(sh, t, m, g, GATHER_SLOT + i);
		n = BUF_AT(&t->node, struct node, m->node);
	}
}

static struct rgb limited(const struct radiosity *r, struct rgb c)
{
	double most = rgb_max(c);

	return r->max_sample > 0 && most > r->max_sample ? rgb_scale(c, r->max_sample / most) : c;
}

/* As the surface sees it (manual 3.4.4.3.2, .5): a mean on its way to grey, made brighter. */
static struct rgb seen(const struct radiosity *r, struct rgb c)
{
	double grey = rgb_grey(c) * r->gray_threshold, keep = 1 - r->gray_threshold;

	return rgb_scale(rgb_make(c.r * keep + grey, c.g * keep + grey, c.b * keep + grey), r->brightness);
}

struct rgb indirect_one(const struct radiosity *r, struct rgb colour)
{
	return seen(r, limited(r, colour));
}

struct rgb indirect_fold(const struct radiosity *r, const struct tree *t, const struct gather *g,
			 struct rgb *variance)
{
	struct rgb sum = { 0, 0, 0 }, squares = { 0, 0, 0 };
	uint32_t sets = g->replications, each;

	if (variance)
		*variance = squares;
	if (g->known)
		return seen(r, g->light);
	if (!g->count)
		return sum;
	each = g->count / sets;
	for (uint32_t i = 0; i < sets; i++) {
		struct rgb set = { 0, 0, 0 };

		for (uint32_t k = 0; k < each; k++)
			set = rgb_add(set, limited(r, BUF_AT(&t->node, struct node, g->first + i * each + k)
							      ->colour));
		set = seen(r, rgb_scale(set, 1.0 / each));
		sum = rgb_add(sum, set);
		squares = rgb_add(squares, rgb_mul(set, set));
	}
	sum = rgb_scale(sum, 1.0 / sets);
	if (variance && sets > 1) {
		squares = rgb_add(rgb_scale(squares, 1.0 / sets), rgb_scale(rgb_mul(sum, sum), -1));
		*variance = rgb_scale(squares, 1.0 / (sets - 1));
	}
	return sum;
}

void indirect_record(const struct radiosity *r, const struct indirect *in, struct tree *t, const struct node *n,
		     uint32_t slot)
{
	const struct gather *g = BUF_AT(&t->gather, struct gather, n->first_gather + slot);
	struct cache_grid grid = cache_grid(in->samples);
	struct cache_limits limits = { LEAST_PIXELS * in->slack * g->pixel, in->reach * g->pixel, in->slack };
	struct cache_record *record;
	struct cache_ray *ray;
	uint32_t i;

	t->strata.count = 0;
	i = tree_push(t, &t->record, 1);
	if (i == TREE_NONE || tree_push(t, &t->strata, g->count) == TREE_NONE)
		return;
	ray = t->strata.data;
	for (uint32_t k = 0; k < g->count; k++) {
		const struct node *child = BUF_AT(&t->node, struct node, g->first + k);

		/* What is nearer than a tenth of a pixel is as good as that. */
		ray[k] = (struct cache_ray){ limited(r, child->colour), fmax(child->length, 0.1 * g->pixel) };
	}
	record = BUF_AT(&t->record, struct cache_record, i);
	record->p = g->p;
	record->n = g->normal;
	record->key = rng_child(n->key, slot);
	cache_make(record, &grid, ray, &limits);
}
