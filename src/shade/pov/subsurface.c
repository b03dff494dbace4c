/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Light that goes below a surface and comes out elsewhere (manual 3.4.6.3.8): light scattered often, by the dipole
 * of pov/dipole.h; light scattered once, after Jensen et al. (2001); and what is seen straight through.
 *
 * POV-Ray finds all three with random numbers. Here is what these tend to, found with low-discrepancy sequences of
 * the hit's own, in rounds until it is good enough. What it is that they tend to, as its pictures show:
 * - Light scattered often is looked for from a point below the hit, as deep as light goes freely on average, but no
 *   deeper than half way to the far side. Rays go in all directions; a place counts as large as the ray's cone there
 *   (cosines below a hundredth count as that), and what is found is divided by how many rays found anything, be it
 *   another thing. So open surfaces are brighter than they ought to be, by up to a factor of two.
 * - Light scattered once is weighed with its way out twice: once by how often points that deep are chosen, and once
 *   more. It, and what is seen straight through, stops at the first thing inside of the solid.
 * - Lamps shine straight to below, their rays bend nowhere but in the formulas, and only shadows outside count.
 *   Surfaces are lit on either side. Area lamps are points but for their shadows.
 * - Neither bumps nor the opacity of a layer matter; what lies above it filters it.
 * - Through what is seen straight through, the same is found on the next such surface, and not beyond.
 */
#include "shade/pov/subsurface.h"

#include "shade/indirect.h"
#include "shade/light.h"
#include "shade/pov/below.h"
#include "shade/pov/lights.h"
#include "shade/pov/shadow.h"

#define PI 3.14159265358979323846
#define CHUNK 4096 /* rays at once, a place's own count apart */
#define SLOT 0x600000000u /* of a node's random numbers, one for each part */
#define LEAST_COSINE 0.01 /* of a ray to the surface that it finds */
#define BESIDE 1e-10 /* as in pov/lights.c */
#define ROUNDS_LEAST 4 /* which tell how good they are, */
#define ROUNDS_MOST 32
#define ROUND_FEWEST 8 /* if they have so many rays */
#define GOOD 0.008 /* a standard error of the light, times its power below: a 250th of white in sRGB */
#define GOOD_POWER 0.583
#define SINGLE_SHARE 16 /* rays that look for light scattered often to points where it is scattered once */
#define FAINT_RAYS 2 /* of what is gathered: its other paths tell the rest */

static double of(struct rgb c, int i)
{
	return i == 0 ? c.r : i == 1 ? c.g : c.b;
}

static bool wants_indirect(const struct below *b, const struct node *n)
{
	const struct scene *s = b->sh->scene;

	return s->subsurface.radiosity && b->sh->indirect.method != INDIRECT_OFF &&
	       n->bounce < s->radiosity.recursion_limit && (n->bounce || !b->sh->indirect.filling);
}

/* How many rays: fewer where the pixel shows little of them. Rays that gather are as many as they are. */
static void count_rays(const struct below *b, const struct node *n, struct place *p)
{
	const struct subsurface *s = &b->sh->scene->subsurface;
	bool blind = b->sh->indirect.filling && !n->bounce; /* nobody looks at it */

	p->rays = FAINT_RAYS;
	p->singles = p->least = p->most = 1;
	p->first = n->path;
	if (!n->bounce) {
		p->rays = b->sh->subsurface_rays;
		if (wants_indirect(b, n) && b->sh->indirect.samples > p->rays)
			p->rays = b->sh->indirect.samples;
		p->rays = indirect_power(p->rays * fmin(1, n->weight));
		p->singles = p->rays > SINGLE_SHARE ? p->rays / SINGLE_SHARE : 1;
		if (p->rays >= ROUNDS_LEAST * ROUND_FEWEST && !wants_indirect(b, n) && !b->sh->one_path) {
			p->rays /= ROUNDS_LEAST;
			p->least = ROUNDS_LEAST;
			p->most = ROUNDS_MOST;
		}
	}
	if (!s->samples || blind) {
		p->rays = 0;
		p->most = 1;
	}
	if (!s->single_samples || blind)
		p->singles = 0;
}

/* False: all of it is black. */
static bool begin_place(const struct below *b, uint32_t layer, struct place *p)
{
	const struct beneath *l = BUF_AT(&b->t->beneath, struct beneath, layer);
	const struct node *n = BUF_AT(&b->t->node, struct node, l->met.node);
	uint32_t interior = l->met.interior;
	double ior = interior == SCENE_NONE ? 1 : b->sh->scene->interior[interior].ior, albedo = 0;
	bool any = false;

	*p = (struct place){ .layer = l, .key = rng_child(n->key, SLOT + (l->part - l->met.first_part)) };
	for (int i = 0; i < 3; i++) {
		double want = of(l->reflectance, i);

		if (!i || want != of(l->reflectance, i - 1))
			albedo = dipole_albedo(want, ior);
		p->colour[i] = dipole_make(of(l->finish->translucency, i), albedo, l->ior);
		any |= p->colour[i].albedo > 0;
	}
	p->cosine = fmin(1, -vec_dot(n->dir, l->met.ns));
	p->fresnel = dipole_fresnel(p->cosine, l->ior);
	p->cosine_below = sqrt(fmax(0, 1 - (1 - p->cosine * p->cosine) / (l->ior * l->ior)));
	p->bent = below_refract(n->dir, l->met.ns, 1 / l->ior, &p->into);
	p->way = HUGE_VAL;
	count_rays(b, n, p);
	return any;
}

/* Light comes in here, perhaps. */
static bool push_sample(struct below *b, const struct surface *s, const ald_hit *hit, const struct sample *sample,
			uint32_t round)
{
	const struct place *p = place_at(b, sample->place);
	uint32_t i = tree_push(b->t, &b->t->met, 1), k = tree_push(b->t, &b->t->below.sample, 1);

	if (i == TREE_NONE || k == TREE_NONE)
		return false;
	*BUF_AT(&b->t->met, struct met, i) = (struct met){ .node = p->layer->met.node,
							   .p = s->p,
							   .n = s->n,
							   .ns = s->ns,
							   .error = s->error,
							   .skip = s->planar ? hit->prim : ALD_NONE,
							   .object = s->object,
							   .interior = s->interior,
							   .flags = s->flags,
							   .round = round };
	*BUF_AT(&b->t->below.sample, struct sample, k) = *sample;
	return true;
}

/* What a place where light comes in adds to the hit, for light of all colours; nothing of black ones. */
static struct rgb profile(const struct below *b, const struct place *p, vec in, double cosine, double area)
{
	vec way = vec_sub(in, p->layer->met.p);
	double d2 = vec_dot(way, way) * b->mm * b->mm;
	double f = p->fresnel * dipole_fresnel(cosine, p->layer->ior) * area;

	return rgb_make(f * dipole_profile(&p->colour[0], d2), f * dipole_profile(&p->colour[1], d2),
			f * dipole_profile(&p->colour[2], d2));
}

static uint32_t push_scatter(struct below *b, struct place *p, const struct scatter *s)
{
	struct part *part = BUF_AT(&b->t->part, struct part, p->layer->part);
	uint32_t i = tree_push(b->t, &b->t->scatter, 1);

	if (i == TREE_NONE)
		return i;
	if (!part->scatter_count++)
		part->first_scatter = i;
	*BUF_AT(&b->t->scatter, struct scatter, i) = *s;
	return i;
}

/* A ray that gathers indirect light where light comes in; around the surface's own normal, whichever side of it
 * is the outer one. */
static bool push_gathered(struct below *b, struct place *p, const struct surface *s, const ald_hit *hit,
			  const struct probe *probe, double area)
{
	uint32_t index = probe->index;
	const struct node parent = *node_of(b, p);
	const struct radiosity *r = &b->sh->scene->radiosity;
	struct sobol q = below_sequence(p, probe->flat);
	struct scatter to = { .gathered = true, .child = tree_push(b->t, &b->t->node, 1) };
	vec dir = indirect_hemisphere(s->ns, sobol_at(&q, index, 2), sobol_at(&q, index, 3));

	if (to.child == TREE_NONE)
		return false;
	*BUF_AT(&b->t->node, struct node, to.child) =
		(struct node){ .org = vec_mad(s->p, s->n, vec_dot(s->n, dir) < 0 ? -s->error : s->error),
			       .dir = dir,
			       .weight = fmax(r->adc_bailout, pow(0.5 * r->brightness, parent.bounce + 1)),
			       .key = rng_child(rng_child(p->key, 2), probe->flat),
			       .level = indirect_level(parent.bounce + 1),
			       .bounce = parent.bounce + 1,
			       .path = parent.bounce ? parent.path : index,
			       .beneath = parent.beneath + 1,
			       .inside = TREE_NONE,
			       .skip = s->planar ? hit->prim : ALD_NONE,
			       .pixel = { parent.pixel[0], parent.pixel[1] },
			       .kind = NODE_GATHERED };
	to.factor = rgb_mul(p->layer->filter, profile(b, p, s->p, 1, area));
	return push_scatter(b, p, &to) != TREE_NONE;
}

/* By what a sum over rays is divided. POV-Ray sends one ray only below the second surface, and divides by one if it
 * finds nothing, too. */
static double divisor(const struct below *b, const struct place *p)
{
	double rays = (double)p->rays * (p->rounds + 1), n = node_of(b, p)->beneath ? rays : rays - p->lost;

	return n > 1e-3 * rays ? n : HUGE_VAL;
}

/* The rays of one place that look for light scattered often; the first is number ray. */
static bool take_often(struct below *b, uint32_t place, uint32_t ray)
{
	struct place *p = place_at(b, place);
	uint32_t first = b->t->scatter.count;
	bool gather = wants_indirect(b, node_of(b, p));

	for (uint32_t k = 0; k < p->rays; k++) {
		const struct probe *probe = BUF_AT(&b->t->below.probe, struct probe, ray + k);
		const ald_ray *r = BUF_AT(&b->t->ray, ald_ray, ray + k);
		struct sample sample = { .place = place };
		const ald_hit *hit;
		struct surface s;
		double far, weight = below_weight(p, r->dir, b->mm);

		if (!below_found(b, ray + k, &hit, &s)) {
			p->lost += weight;
			continue;
		}
		if (!same_solid(p, &s))
			continue;
		far = hit->t * b->mm;
		sample.area = weight * 4 * PI * far * far / fmax(LEAST_COSINE, fabs(vec_dot(r->dir, s.ns)));
		if ((b->sh->scene->light_count &&
		     !push_sample(b, &s, hit, &sample, (p->first + p->rounds) * p->rays + k)) ||
		    (gather && !push_gathered(b, p, &s, hit, probe, sample.area)))
			return false;
	}
	for (uint32_t i = first; i < b->t->scatter.count; i++) {
		struct scatter *s = BUF_AT(&b->t->scatter, struct scatter, i);

		s->factor = rgb_scale(s->factor, 1 / divisor(b, p));
	}
	return true;
}

/* What is seen straight through. */
static bool push_through(struct below *b, struct place *p)
{
	const struct node parent = *node_of(b, p);
	uint32_t level = parent.level + (parent.straight ? 0 : 1);
	struct rgb left = { 0, 0, 0 };
	struct scatter to;
	double weight;

	if (!p->leaves)
		return true;
	left.r = p->colour[0].albedo > 0 ? exp(-p->colour[0].extinct * p->way) : 0;
	left.g = p->colour[1].albedo > 0 ? exp(-p->colour[1].extinct * p->way) : 0;
	left.b = p->colour[2].albedo > 0 ? exp(-p->colour[2].extinct * p->way) : 0;
	weight = rgb_max(left);
	if (!(weight > shade_bailout(b->sh, parent.bounce)) || !shade_worth(b->sh, parent.bounce, level, weight))
		return true;
	to = (struct scatter){ .factor = rgb_mul(p->layer->filter, left), .child = tree_push(b->t, &b->t->node, 1) };
	if (to.child == TREE_NONE)
		return false;
	*BUF_AT(&b->t->node, struct node, to.child) =
		(struct node){ .org = p->exit,
			       .dir = p->exit_dir,
			       .weight = weight,
			       .key = rng_child(p->key, 3),
			       .width = parent.width + parent.spread * (p->layer->met.t + p->way / b->mm),
			       .spread = parent.spread,
			       .level = level,
			       .bounce = parent.bounce,
			       .path = parent.path,
			       .beneath = parent.beneath + 1,
			       .way = parent.way + p->layer->met.t + p->way / b->mm,
			       .inside = TREE_NONE,
			       .skip = p->exit_skip,
			       .pixel = { parent.pixel[0], parent.pixel[1] },
			       .kind = NODE_REFRACTED,
			       .mirrored = parent.mirrored };
	return push_scatter(b, p, &to) != TREE_NONE;
}

/* Lamps of the hit's own light_group. */
static bool lights_it(const struct below *b, uint32_t place, uint32_t light)
{
	const struct scene *s = b->sh->scene;

	return scene_lit_by(s, &s->light[light], place_at(b, place)->layer->met.light_set);
}

/* The colours that scatter as this one does, which share its points. */
static unsigned alike(const struct place *p, int colour)
{
	unsigned bits = 0;

	for (int i = 0; i < 3; i++) {
		if (p->colour[i].extinct == p->colour[colour].extinct && p->colour[i].albedo > 0) {
			if (i < colour)
				return 0;
			bits |= 1u << i;
		}
	}
	return bits;
}

/* From points along the bent ray, chosen as deep as light goes, to the lamps. */
static bool send_once(struct below *b)
{
	const struct scene *s = b->sh->scene;

	below_forget(b);
	for (uint32_t i = 0; i < b->t->below.place.count; i++) {
		const struct place *p = place_at(b, i);
		struct sobol q = sobol_make(rng_child(p->key, 1));

		for (uint32_t k = 0; p->bent && k < 3 * p->singles; k++) {
			uint32_t at = p->first * p->singles + k / 3;
			unsigned colours = alike(p, (int)(k % 3));
			struct probe probe = { .place = i, .index = at, .colours = colours };
			vec from;

			if (!colours)
				continue;
			probe.out = -log(1 - sobol_at(&q, at, k % 3)) / p->colour[k % 3].extinct;
			if (probe.out >= p->way)
				continue;
			from = vec_mad(p->layer->met.p, p->into, probe.out / b->mm);
			for (probe.light = 0; probe.light < s->light_count; probe.light++) {
				vec to;

				if (!lights_it(b, i, probe.light))
					continue;
				to = light_towards(&s->light[probe.light], from, vec_make(0, 0, 0)).dir;

				if (!below_push(b, from, to, HUGE_VAL, ALD_NONE, &probe))
					return false;
			}
		}
	}
	return below_trace(b);
}

static bool take_once(struct below *b)
{
	for (uint32_t i = 0; i < b->t->ray.count; i++) {
		const struct probe *probe = BUF_AT(&b->t->below.probe, struct probe, i);
		struct sample sample = { .place = probe->place, .out = probe->out, .colours = probe->colours };
		uint32_t light = probe->light;
		const ald_hit *hit;
		struct surface s;

		if (!below_found(b, i, &hit, &s) || !same_solid(place_at(b, probe->place), &s))
			continue;
		sample.in = hit->t * b->mm;
		if (!push_sample(b, &s, hit, &sample, probe->index))
			return false;
		lights_ask(b->sh, b->t, b->t->met.count - 1, light);
	}
	return !b->t->no_memory;
}

/* Light that comes in at a sample, scattered once. */
static void add_once(struct place *p, const struct sample *s, struct rgb light, double cosine)
{
	double ior = p->layer->ior, below2 = 1 - (1 - cosine * cosine) / (ior * ior), below, f, weight[3] = { 0 };

	if (!(below2 > BESIDE * BESIDE))
		return;
	below = sqrt(below2);
	f = dipole_fresnel(cosine, ior) * p->fresnel / 4 * cosine / (1 + p->cosine_below / below);
	for (int i = 0; i < 3; i++) {
		const struct dipole *d = &p->colour[i];

		if (s->colours & 1u << i)
			weight[i] = f * d->scatter / d->extinct *
				    exp(-(s->in * cosine / below + s->out) * d->extinct);
	}
	p->once = rgb_add(p->once, rgb_mul(light, rgb_make(weight[0], weight[1], weight[2])));
}

static void add_light(struct below *b)
{
	for (uint32_t i = 0; i < b->t->lit.count; i++) {
		const struct lit *lit = BUF_AT(&b->t->lit, struct lit, i);
		const struct met *m = BUF_AT(&b->t->met, struct met, lit->hit);
		const struct sample *s = BUF_AT(&b->t->below.sample, struct sample, lit->hit);
		struct place *p = place_at(b, s->place);
		double cosine = fmin(1, fabs(vec_dot(m->ns, lit->dir)));

		if (shadow_dark(lit->colour) || cosine < BESIDE)
			continue;
		if (s->colours)
			add_once(p, s, lit->colour, cosine);
		else
			p->often = rgb_add(p->often, rgb_mul(rgb_scale(lit->colour, cosine),
							     profile(b, p, m->p, cosine, s->area)));
	}
}

static double standard_error(double sum, double square, double n)
{
	double mean = sum / n;

	return sqrt(fmax(0, square / n - mean * mean) / (n - 1)) / (GOOD * pow(fmax(mean, 0.01), GOOD_POWER));
}

/* One more round is known; true if it was the last. The error is that of independent rounds; theirs is less. */
static bool take_round(const struct below *b, struct place *p)
{
	struct rgb mean = rgb_scale(rgb_add(p->often, rgb_scale(p->before, -1)), 1.0 / p->rays);
	double n = p->rounds + 1, error;

	if (n >= p->most)
		return true;
	p->before = p->often;
	p->sum = rgb_add(p->sum, mean);
	p->square = rgb_add(p->square, rgb_mul(mean, mean));
	if (n < p->least)
		return false;
	error = fmax(standard_error(p->sum.r, p->square.r, n), standard_error(p->sum.g, p->square.g, n));
	error = fmax(error, standard_error(p->sum.b, p->square.b, n));
	return error * fmin(1, node_of(b, p)->weight) <= 1;
}

/* False: that was the last, or memory is out. */
static bool shade_round(struct below *b, bool first)
{
	struct tree *t = b->t;
	uint32_t ray = 0, often;
	bool left = false;

	tree_reset_wave(t);
	t->below.sample.count = 0;
	if (!below_send(b))
		return false;
	for (uint32_t i = 0; i < t->below.place.count; i++) {
		struct place *p = place_at(b, i);

		if (p->done)
			continue;
		if (!take_often(b, i, ray) || (first && !push_through(b, p)))
			return false;
		ray += p->rays;
	}
	often = t->met.count;
	for (uint32_t i = 0; i < often; i++) {
		for (uint32_t j = 0; j < b->sh->scene->light_count; j++) {
			if (lights_it(b, BUF_AT(&t->below.sample, struct sample, i)->place, j))
				lights_ask(b->sh, t, i, j);
		}
	}
	if (first && (!send_once(b) || !take_once(b)))
		return false;
	lights_answer(b->sh, t, b->thread, 0, b->counts);
	if (t->no_memory)
		return false;
	add_light(b);
	for (uint32_t i = 0; i < t->below.place.count; i++) {
		struct place *p = place_at(b, i);

		if (p->done)
			continue;
		p->done = take_round(b, p);
		p->rounds += !p->done;
		left |= !p->done;
	}
	return left;
}

/* The places of a chunk, all the way. */
static void shade_chunk(struct below *b)
{
	struct tree *t = b->t;
	bool first = true;

	if (!below_look(b))
		return;
	while (shade_round(b, first))
		first = false;
	for (uint32_t i = 0; i < t->below.place.count && !t->no_memory; i++) {
		const struct place *p = place_at(b, i);
		struct part *part = BUF_AT(&t->part, struct part, p->layer->part);
		struct rgb c = rgb_scale(p->often, 1 / divisor(b, p));

		if (p->singles)
			c = rgb_add(c, rgb_scale(p->once, 1.0 / p->singles));
		part->own = rgb_add(part->own, rgb_mul(p->layer->filter, c));
	}
}

void shade_subsurface(const struct shader *sh, struct tree *t, uint32_t thread, struct shade_counts *counts)
{
	struct below b = { sh, t, thread, counts, sh->scene->subsurface.mm_per_unit };
	uint32_t rays = 0;

	t->below.place.count = 0;
	for (uint32_t i = 0; i < t->beneath.count && !t->no_memory; i++) {
		struct place p;
		uint32_t k;

		if (!begin_place(&b, i, &p))
			continue;
		k = tree_push(t, &t->below.place, 1);
		if (k == TREE_NONE)
			break;
		*place_at(&b, k) = p;
		rays += p.rays;
		if (rays < CHUNK)
			continue;
		shade_chunk(&b);
		t->below.place.count = 0;
		rays = 0;
	}
	if (t->below.place.count && !t->no_memory)
		shade_chunk(&b);
	t->below.place.count = t->beneath.count = 0;
}

void subsurface_sizes(struct tree *t)
{
	t->below.place.size = sizeof(struct place);
	t->below.probe.size = sizeof(struct probe);
	t->below.sample.size = sizeof(struct sample);
}
