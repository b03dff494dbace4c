/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Light that goes below a surface and comes out elsewhere (manual 3.4.6.3.8): light scattered often, by the dipole
 * of pov/dipole.h; light scattered once, after Jensen et al. (2001); and what is seen straight through.
 *
 * POV-Ray finds all three with random numbers. Here is what these tend to, found with low-discrepancy sequences of
 * the hit's own. Of the rays that look for light scattered often, one half goes in all directions evenly; the
 * other goes where the dipole would have it come from if the surfaces close by were flat. They are weighed together
 * by the balance heuristic (Veach and Guibas, 1995), or edges and thin slabs would be mostly noise. What POV-Ray's random numbers tend to, as its pictures show:
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

#include "base/sobol.h"
#include "shade/frame.h"
#include "shade/indirect.h"
#include "shade/light.h"
#include "shade/pov/dipole.h"
#include "shade/pov/lights.h"
#include "shade/pov/shadow.h"

#define PI 3.14159265358979323846
#define CHUNK 4096 /* rays at once, a place's own count apart */
#define SLOT 0x600000000u /* of a node's random numbers, one for each part */
#define ANYTHING UINT32_MAX /* POV-Ray's rays below surfaces see also what is hidden from all others */
#define LEAST_COSINE 0.01 /* of a ray to the surface that it finds */
#define BESIDE 1e-10 /* as in pov/lights.c */
#define ROUNDS_LEAST 4 /* which tell how good they are, */
#define ROUNDS_MOST 32
#define ROUND_FEWEST 8 /* if they have so many rays */
#define GOOD 0.008 /* a standard error of the light, times its power below: a 250th of white in sRGB */
#define GOOD_POWER 0.583
#define SINGLE_SHARE 16 /* rays that look for light scattered often to points where it is scattered once */
#define MOST_FLAT 3
#define PROBES 4 /* to find what is close by besides the hit's own surface */
#define OTHER 0.9 /* cosine between the normals of surfaces that are not alike */
#define FAINT_RAYS 2 /* of what is gathered: its other paths tell the rest */

/* A surface close by, as if it were flat. */
struct flat {
	vec foot, normal; /* of the hit on it */
	double source[2]; /* how far a dipole's sources are from there, mm */
	uint32_t rays; /* that go there */
};

/* A layer whose light is being found. */
struct place {
	const struct beneath *layer;
	struct dipole colour[3];
	vec base; /* below the hit */
	double real, mirrored, decay; /* of a dipole for all colours together */
	struct flat flat[MOST_FLAT];
	uint32_t flats, even; /* how many rays go everywhere */
	vec into; /* the ray from the eye, bent */
	bool bent; /* it is not reflected totally */
	double way; /* along it to the next surface, mm; or infinite */
	bool leaves; /* and there it leaves the solid */
	vec exit, exit_dir;
	uint32_t exit_skip;
	double cosine, cosine_below, fresnel; /* of the ray from the eye */
	uint32_t rays, singles; /* rays: a round */
	uint32_t rounds, least, most; /* that were, and have to be */
	double lost; /* the weights of rays that found nothing */
	struct rgb often, once; /* sums over rays */
	struct rgb before, sum, square; /* of the rounds: often before the last one; of their means */
	bool done;
	uint64_t key;
	uint32_t first; /* of the points of its sequences */
};

/* A ray sent from below. */
struct probe {
	uint32_t place;
	uint32_t flat, index; /* light scattered often: where it was sent to, and its number there */
	uint32_t light; /* light scattered once: which lamp */
	unsigned colours; /* and of which colours, a bit each */
	double out; /* and how far it is from there to the eye's hit, mm */
};

/* A place where light may come in: a met with the same number. */
struct sample {
	uint32_t place;
	double area; /* mm^2 */
	double in, out; /* ways below the surface, mm */
	unsigned colours; /* of light scattered once, or 0 */
};

/* All there is of a chunk. */
struct below {
	const struct shader *sh;
	struct tree *t;
	uint32_t thread;
	struct shade_counts *counts;
	double mm;
};

static double of(struct rgb c, int i)
{
	return i == 0 ? c.r : i == 1 ? c.g : c.b;
}

static struct place *place_at(const struct below *b, uint32_t i)
{
	return BUF_AT(&b->t->below.place, struct place, i);
}

static const struct node *node_of(const struct below *b, const struct place *p)
{
	return BUF_AT(&b->t->node, struct node, p->layer->met.node);
}

/* A union that was given an interior is one solid; objects that were given the same one each are not. */
static bool same_solid(const struct place *p, const struct surface *s)
{
	return p->layer->met.object == s->object;
}

/* By Snell's law, whichever side the normal is on; ratio of the near index to the far one. */
static bool refract(vec dir, vec normal, double ratio, vec *out)
{
	double c = -vec_dot(dir, normal), k;

	if (c < 0) {
		normal = vec_neg(normal);
		c = -c;
	}
	k = 1 + ratio * ratio * (c * c - 1);
	if (k < 0)
		return false;
	*out = vec_unit(vec_mad(vec_scale(dir, ratio), normal, ratio * c - sqrt(k)));
	return true;
}

static bool push_ray(struct below *b, vec org, vec dir, double most, uint32_t skip, const struct probe *probe)
{
	uint32_t i = tree_push(b->t, &b->t->ray, 1), k = tree_push(b->t, &b->t->below.probe, 1);

	if (i == TREE_NONE || k == TREE_NONE)
		return false;
	*BUF_AT(&b->t->ray, ald_ray, i) = (ald_ray){ .org = org,
						     .dir = dir,
						     .tmax = most,
						     .mask = ANYTHING,
						     .skip = skip,
						     .after = ALD_NONE,
						     .after_sub = { ALD_NONE, ALD_NONE } };
	*BUF_AT(&b->t->below.probe, struct probe, k) = *probe;
	return true;
}

static void forget_rays(struct below *b)
{
	b->t->ray.count = b->t->hit.count = b->t->below.probe.count = 0;
}

static bool trace_rays(struct below *b)
{
	uint32_t n = b->t->ray.count;
	const ald_hit *hit;

	if (tree_push(b->t, &b->t->hit, n) == TREE_NONE)
		return false;
	hit = b->t->hit.data;
	trace_nearest(b->sh->geometry, b->thread, b->t->ray.data, b->t->hit.data, n, 0);
	b->counts->subsurface_cast += n;
	for (uint32_t i = 0; i < n; i++)
		b->counts->subsurface_hit += hit[i].prim != ALD_NONE;
	return true;
}

/* The hit of a ray, if there is one. */
static bool found(const struct below *b, uint32_t i, const ald_hit **hit, struct surface *s)
{
	*hit = BUF_AT(&b->t->hit, ald_hit, i);
	if ((*hit)->prim == ALD_NONE)
		return false;
	surface_at(b->sh->geometry, BUF_AT(&b->t->ray, ald_ray, i), *hit, s);
	return true;
}

/* Within which distance a share u of a source's light comes in, mm: on a plane it is
 * 1 - near / r exp(decay (near - r)), r being the distance from the source and near its least. */
static double source_radius(double near, double decay, double u)
{
	double want = -log(1 - u), k = decay * near, t = k > 0 ? fmin(want, log1p(want / k)) : want;

	for (int i = 0; i < 8 && k > 0; i++)
		t -= (t + k * expm1(t) - want) / (1 + k * exp(t));
	return near * sqrt(fmax(0, expm1(2 * t)));
}

/* How dense these places are, a square millimetre. */
static double source_density(double near, double decay, double d2)
{
	double r = sqrt(near * near + d2);

	return near * (decay + 1 / r) * exp(decay * (near - r)) / (2 * PI * r * r);
}

/* How dense rays to there are in this direction from the base. */
static double flat_density(const struct place *p, const struct flat *f, vec dir, double mm)
{
	double c = vec_dot(dir, f->normal), t = vec_dot(vec_sub(f->foot, p->base), f->normal) / c;
	vec off = vec_sub(vec_mad(p->base, dir, t), f->foot);
	double d2 = vec_dot(off, off) * mm * mm;

	if (!(t > 0) || !isfinite(t))
		return 0;
	return (source_density(f->source[0], p->decay, d2) + source_density(f->source[1], p->decay, d2)) / 2 *
	       t * t * mm * mm / fabs(c);
}

/* What a ray counts in comparison to one of so many that all go everywhere. */
static double weigh(const struct place *p, vec dir, double mm)
{
	double sum = p->even;

	for (uint32_t i = 0; i < p->flats; i++)
		sum += p->flat[i].rays * 4 * PI * flat_density(p, &p->flat[i], dir, mm);
	return p->rays / sum;
}

/* How far light goes freely: by the grey of the coefficients. Black goes nowhere, and POV-Ray with it. */
static double free_path(const struct place *p)
{
	struct rgb have = { p->colour[0].albedo > 0, p->colour[1].albedo > 0, p->colour[2].albedo > 0 };
	struct rgb extinct = { p->colour[0].extinct, p->colour[1].extinct, p->colour[2].extinct };

	return rgb_grey(have) / rgb_grey(extinct);
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
	p->first = n->bounce ? n->path : 0;
	if (!n->bounce) {
		p->rays = indirect_power(b->sh->subsurface_rays * fmin(1, n->weight));
		p->singles = p->rays > SINGLE_SHARE ? p->rays / SINGLE_SHARE : 1;
		if (p->rays >= ROUNDS_LEAST * ROUND_FEWEST && !wants_indirect(b, n)) {
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
	p->bent = refract(n->dir, l->met.ns, 1 / l->ior, &p->into);
	p->way = HUGE_VAL;
	count_rays(b, n, p);
	return any;
}

/* What lies below the hit, and along the bent ray. */
static bool look_below(struct below *b)
{
	struct tree *t = b->t;

	forget_rays(b);
	for (uint32_t i = 0; i < t->below.place.count; i++) {
		const struct place *p = place_at(b, i);
		const struct met *m = &p->layer->met;
		vec down = vec_neg(m->ns), into = p->bent ? p->into : down;
		struct probe probe = { .place = i };

		if (!push_ray(b, shadow_origin(m, down), down, 2 * free_path(p) / b->mm, m->skip, &probe) ||
		    !push_ray(b, shadow_origin(m, into), into, HUGE_VAL, m->skip, &probe))
			return false;
	}
	return trace_rays(b);
}

static void add_flat(struct place *p, vec on, vec normal, double mm)
{
	double off = vec_dot(vec_sub(on, p->layer->met.p), normal), off2 = off * off * mm * mm;

	if (p->flats < MOST_FLAT)
		p->flat[p->flats++] = (struct flat){ .foot = vec_mad(p->layer->met.p, normal, off),
						     .normal = normal,
						     .source = { sqrt(p->real * p->real + off2),
								 sqrt(p->mirrored * p->mirrored + off2) } };
}

static void take_base(const struct below *b, struct place *p, uint32_t ray)
{
	const struct met *m = &p->layer->met;
	double depth = free_path(p) / b->mm;
	const ald_hit *hit;
	struct surface s;

	p->real = free_path(p);
	p->decay = HUGE_VAL;
	for (int i = 0; i < 3; i++) {
		if (p->colour[i].albedo > 0) {
			p->decay = fmin(p->decay, p->colour[i].decay);
			p->mirrored = p->real * p->colour[i].mirrored / p->colour[i].real;
		}
	}
	add_flat(p, m->p, m->ns, b->mm);
	if (found(b, ray, &hit, &s)) {
		depth = same_solid(p, &s) ? hit->t / 2 : fmin(depth, hit->t - BESIDE);
		if (same_solid(p, &s))
			add_flat(p, s.p, s.ns, b->mm);
	}
	p->base = vec_mad(m->p, m->ns, -depth);
}

static void take_way(const struct below *b, struct place *p, uint32_t ray)
{
	const ald_hit *hit;
	struct surface s;

	if (!p->bent || !found(b, ray, &hit, &s))
		return;
	p->way = hit->t * b->mm;
	if (!same_solid(p, &s) || !refract(p->into, s.ns, p->layer->ior, &p->exit_dir))
		return;
	p->leaves = true;
	p->exit = vec_mad(s.p, s.n, vec_dot(s.n, p->exit_dir) < 0 ? -s.error : s.error);
	p->exit_skip = s.planar ? hit->prim : ALD_NONE;
}

/* What is close to the bases, along their hits' surfaces. */
static bool look_around(struct below *b)
{
	forget_rays(b);
	for (uint32_t i = 0; i < b->t->below.place.count; i++) {
		const struct place *p = place_at(b, i);
		struct probe probe = { .place = i };

		for (uint32_t k = 0; k < PROBES; k++) {
			double x = k & 1 ? 0 : k & 2 ? -1 : 1, y = !(k & 1) ? 0 : k & 2 ? -1 : 1;
			vec dir = frame_around(p->layer->met.ns, x, y, 0);

			if (!push_ray(b, p->base, dir, HUGE_VAL, ALD_NONE, &probe))
				return false;
		}
	}
	return trace_rays(b);
}

/* The nearest of them, if it is no further than light goes freely; then the rays are shared out. */
static void take_around(const struct below *b, struct place *p, uint32_t ray)
{
	double least = free_path(p) / b->mm;
	struct surface nearest;
	bool any = false;

	for (uint32_t k = 0; k < PROBES; k++) {
		const ald_hit *hit;
		struct surface s;
		double off;

		if (!found(b, ray + k, &hit, &s) || !same_solid(p, &s) ||
		    fabs(vec_dot(s.ns, p->layer->met.ns)) > OTHER)
			continue;
		off = fabs(vec_dot(vec_sub(s.p, p->base), s.ns));
		if (off < least) {
			least = off;
			nearest = s;
			any = true;
		}
	}
	if (any)
		add_flat(p, nearest.p, nearest.ns, b->mm);
	p->even = p->rays - p->rays / 2;
	for (uint32_t i = 0; i < p->flats; i++)
		p->flat[i].rays = (p->rays / 2 + p->flats - 1 - i) / p->flats;
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

static vec all_around(double u, double v)
{
	double z = 1 - 2 * u, r = sqrt(fmax(0, 1 - z * z)), phi = 2 * PI * v;

	return vec_make(r * cos(phi), r * sin(phi), z);
}

/* The sequences of the rays that go everywhere (0) and to one of the flats. */
static struct sobol sequence(const struct place *p, uint32_t flat)
{
	return sobol_make(rng_child(p->key, flat ? 3 + flat : 0));
}

static vec to_flat(const struct place *p, const struct flat *f, double u, double v, double mm)
{
	double d = source_radius(f->source[u >= 0.5], p->decay, u >= 0.5 ? 2 * u - 1 : 2 * u) / mm, phi = 2 * PI * v;

	return vec_unit(vec_sub(vec_add(f->foot, frame_around(f->normal, d * cos(phi), d * sin(phi), 0)), p->base));
}

static bool send_some(struct below *b, uint32_t place, uint32_t flat, uint32_t rays)
{
	const struct place *p = place_at(b, place);
	struct sobol s = sequence(p, flat);

	for (uint32_t k = 0; k < rays; k++) {
		struct probe probe = { .place = place, .flat = flat, .index = (p->first + p->rounds) * rays + k };
		double u = sobol_at(&s, probe.index, 0), v = sobol_at(&s, probe.index, 1);
		vec dir = flat ? to_flat(p, &p->flat[flat - 1], u, v, b->mm) : all_around(u, v);

		if (!push_ray(b, p->base, dir, HUGE_VAL, ALD_NONE, &probe))
			return false;
	}
	return true;
}

static bool send_often(struct below *b)
{
	forget_rays(b);
	for (uint32_t i = 0; i < b->t->below.place.count; i++) {
		const struct place *p = place_at(b, i);

		if (p->done)
			continue;
		if (!send_some(b, i, 0, p->even))
			return false;
		for (uint32_t k = 0; k < p->flats; k++) {
			if (!send_some(b, i, k + 1, p->flat[k].rays))
				return false;
		}
	}
	return trace_rays(b);
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
	struct sobol q = sequence(p, probe->flat);
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
		double far, weight = weigh(p, r->dir, b->mm);

		if (!found(b, ray + k, &hit, &s)) {
			p->lost += weight;
			continue;
		}
		if (!same_solid(p, &s))
			continue;
		far = hit->t * b->mm;
		sample.area = weight * 4 * PI * far * far / fmax(LEAST_COSINE, fabs(vec_dot(r->dir, s.ns)));
		if ((b->sh->scene->light_count && !push_sample(b, &s, hit, &sample, (p->first + p->rounds) * p->rays + k)) ||
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
			       .kind = NODE_REFRACTED,
			       .mirrored = parent.mirrored };
	return push_scatter(b, p, &to) != TREE_NONE;
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

	forget_rays(b);
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
				vec to = light_towards(&s->light[probe.light], from, vec_make(0, 0, 0)).dir;

				if (!push_ray(b, from, to, HUGE_VAL, ALD_NONE, &probe))
					return false;
			}
		}
	}
	return trace_rays(b);
}

static bool take_once(struct below *b)
{
	for (uint32_t i = 0; i < b->t->ray.count; i++) {
		const struct probe *probe = BUF_AT(&b->t->below.probe, struct probe, i);
		struct sample sample = { .place = probe->place, .out = probe->out, .colours = probe->colours };
		uint32_t light = probe->light;
		const ald_hit *hit;
		struct surface s;

		if (!found(b, i, &hit, &s) || !same_solid(place_at(b, probe->place), &s))
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
	if (!send_often(b))
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
		for (uint32_t j = 0; j < b->sh->scene->light_count; j++)
			lights_ask(b->sh, t, i, j);
	}
	if (first && (!send_once(b) || !take_once(b)))
		return false;
	lights_answer(b->sh, t, b->thread, b->counts);
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

	if (!look_below(b))
		return;
	for (uint32_t i = 0; i < t->below.place.count; i++) {
		take_base(b, place_at(b, i), 2 * i);
		take_way(b, place_at(b, i), 2 * i + 1);
	}
	if (!look_around(b))
		return;
	for (uint32_t i = 0; i < t->below.place.count; i++)
		take_around(b, place_at(b, i), PROBES * i);
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
