/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Where rays from below surfaces go. The hit's base, as POV-Ray has it, is where they start; one half of those
 * that look for light scattered often goes in all directions evenly, the other to where the dipole would have its
 * light on what is close by, if that were flat: the hit's own surface, the far side, and the nearest surface beside.
 * Over a plane the dipole's integral is known. All are weighed together by the balance heuristic (Veach and Guibas,
 * Optimally Combining Sampling Techniques for Monte Carlo Rendering, 1995).
 */
#include "shade/pov/below.h"

#include "shade/frame.h"
#include "shade/pov/shadow.h"

#define PI 3.14159265358979323846
#define ANYTHING UINT32_MAX /* POV-Ray's rays below surfaces see also what is hidden from all others */
#define PROBES 4 /* to find what is close by besides the hit's own surface */
#define OTHER 0.9 /* cosine between the normals of surfaces that are not alike */

bool below_refract(vec dir, vec normal, double ratio, vec *out)
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

bool below_push(struct below *b, vec org, vec dir, double most, uint32_t skip, const struct probe *probe)
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
	if (b->sh->marks)
		trace_mark(BUF_AT(&b->t->ray, ald_ray, i), node_of(b, place_at(b, probe->place))->pixel,
			   TRACE_FOR_SUBSURFACE);
	return true;
}

void below_forget(struct below *b)
{
	b->t->ray.count = b->t->hit.count = b->t->below.probe.count = 0;
}

bool below_trace(struct below *b)
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

bool below_found(const struct below *b, uint32_t i, const ald_hit **hit, struct surface *s)
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

double below_weight(const struct place *p, vec dir, double mm)
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

/* What lies below the hit, and along the bent ray. */
static bool look_below(struct below *b)
{
	struct tree *t = b->t;

	below_forget(b);
	for (uint32_t i = 0; i < t->below.place.count; i++) {
		const struct place *p = place_at(b, i);
		const struct met *m = &p->layer->met;
		vec down = vec_neg(m->ns), into = p->bent ? p->into : down;
		struct probe probe = { .place = i };

		if (!below_push(b, shadow_origin(m->p, m->n, m->error, down), down, 2 * free_path(p) / b->mm, m->skip,
				&probe) ||
		    !below_push(b, shadow_origin(m->p, m->n, m->error, into), into, HUGE_VAL, m->skip, &probe))
			return false;
	}
	return below_trace(b);
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
	if (below_found(b, ray, &hit, &s)) {
		depth = same_solid(p, &s) ? hit->t / 2 : fmin(depth, hit->t * (1 - 0x1p-40));
		if (same_solid(p, &s))
			add_flat(p, s.p, s.ns, b->mm);
	}
	p->base = vec_mad(m->p, m->ns, -depth);
}

static void take_way(const struct below *b, struct place *p, uint32_t ray)
{
	const ald_hit *hit;
	struct surface s;

	if (!p->bent || !below_found(b, ray, &hit, &s))
		return;
	p->way = hit->t * b->mm;
	if (!same_solid(p, &s) || !below_refract(p->into, s.ns, p->layer->ior, &p->exit_dir))
		return;
	p->leaves = true;
	p->exit = vec_mad(s.p, s.n, vec_dot(s.n, p->exit_dir) < 0 ? -s.error : s.error);
	p->exit_skip = s.planar ? hit->prim : ALD_NONE;
}

/* What is close to the bases, along their hits' surfaces. */
static bool look_around(struct below *b)
{
	below_forget(b);
	for (uint32_t i = 0; i < b->t->below.place.count; i++) {
		const struct place *p = place_at(b, i);
		struct probe probe = { .place = i };

		for (uint32_t k = 0; k < PROBES; k++) {
			double x = k & 1 ? 0 : k & 2 ? -1 : 1, y = !(k & 1) ? 0 : k & 2 ? -1 : 1;
			vec dir = frame_around(p->layer->met.ns, x, y, 0);

			if (!below_push(b, p->base, dir, HUGE_VAL, ALD_NONE, &probe))
				return false;
		}
	}
	return below_trace(b);
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

		if (!below_found(b, ray + k, &hit, &s) || !same_solid(p, &s) ||
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

static vec all_around(double u, double v)
{
	double z = 1 - 2 * u, r = sqrt(fmax(0, 1 - z * z)), phi = 2 * PI * v;

	return vec_make(r * cos(phi), r * sin(phi), z);
}

struct sobol below_sequence(const struct place *p, uint32_t flat)
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
	struct sobol s = below_sequence(p, flat);

	for (uint32_t k = 0; k < rays; k++) {
		struct probe probe = { .place = place, .flat = flat, .index = (p->first + p->rounds) * rays + k };
		double u = sobol_at(&s, probe.index, 0), v = sobol_at(&s, probe.index, 1);
		vec dir = flat ? to_flat(p, &p->flat[flat - 1], u, v, b->mm) : all_around(u, v);

		if (!below_push(b, p->base, dir, HUGE_VAL, ALD_NONE, &probe))
			return false;
	}
	return true;
}

bool below_send(struct below *b)
{
	below_forget(b);
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
	return below_trace(b);
}

bool below_look(struct below *b)
{
	if (!look_below(b))
		return false;
	for (uint32_t i = 0; i < b->t->below.place.count; i++) {
		take_base(b, place_at(b, i), 2 * i);
		take_way(b, place_at(b, i), 2 * i + 1);
	}
	if (!look_around(b))
		return false;
	for (uint32_t i = 0; i < b->t->below.place.count; i++)
		take_around(b, place_at(b, i), PROBES * i);
	return true;
}
