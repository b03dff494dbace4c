/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "course.h"

static double kept(const struct course *c, double x)
{
	return c->floats ? as_float(x) : x;
}

vec kept_vec(const struct course *c, vec v)
{
	return vec_make(kept(c, v.x), kept(c, v.y), kept(c, v.z));
}

void ray_start(ald_ray *r)
{
	*r = (ald_ray){ .tmax = ALD_INF, .mask = ~0u, .skip = ALD_NONE, .after = ALD_NONE,
			.after_sub = { ALD_NONE, ALD_NONE } };
}

static vec vertex_of(const struct course *c, uint32_t triangle, unsigned k)
{
	return c->soup->vertex[c->soup->triangle[triangle][k % 3]];
}

static vec origin_of(struct course *c)
{
	vec d = random_direction(&c->seed);

	return kept_vec(c, vec_mad(c->centre, d, c->radius * (c->inside ? 0.3 * random_unit(&c->seed) : 3)));
}

static void aim(struct course *c, vec target, bool unit, ald_ray *r)
{
	r->dir = kept_vec(c, vec_sub(target, r->org));
	if (unit)
		r->dir = kept_vec(c, vec_unit(r->dir));
}

void ray_aimed(void *arg, uint32_t i, ald_ray *r)
{
	struct course *c = arg;
	uint32_t f = random_below(&c->seed, c->soup->triangles), k = random_below(&c->seed, 3);
	vec a = vertex_of(c, f, k), b = vertex_of(c, f, k + 1);
	double x = i % 3 == 0 ? 0 : i % 3 == 1 ? random_unit(&c->seed) : 0.5;

	ray_start(r);
	r->org = origin_of(c);
	aim(c, kept_vec(c, vec_mad(a, vec_sub(b, a), x)), i / 3 % 2, r);
}

void ray_ordinary(void *arg, uint32_t i, ald_ray *r)
{
	struct course *c = arg;

	ray_start(r);
	r->org = origin_of(c);
	aim(c, vec_mad(c->centre, random_direction(&c->seed), c->radius * random_unit(&c->seed)), i % 2, r);
}

void ray_mixed(void *arg, uint32_t i, ald_ray *r)
{
	struct course *c = arg;

	c->inside = i & 2;
	(i & 1 ? ray_aimed : ray_ordinary)(arg, i / 4, r);
}

static double step_ulps(const struct course *c, double x, int n)
{
	return c->floats ? (double)(n > 0 ? nextafterf((float)x, HUGE_VALF) :
				    n < 0 ? nextafterf((float)x, -HUGE_VALF) : (float)x) :
			   n > 0 ? nextafter(x, HUGE_VAL) : n < 0 ? nextafter(x, -HUGE_VAL) : x;
}

void ray_in_plane(void *arg, uint32_t i, ald_ray *r)
{
	struct course *c = arg;
	unsigned axis = i % 3, up = i / 3 % 2;
	double *o, *d, plane = up ? -HUGE_VAL : HUGE_VAL;

	for (uint32_t k = 0; k < c->soup->vertices; k++) {
		double x = (&c->soup->vertex[k].x)[axis];

		plane = up ? fmax(plane, x) : fmin(plane, x);
	}
	c->inside = false;
	ray_ordinary(arg, i, r);
	o = &r->org.x + axis;
	d = &r->dir.x + axis;
	*o = step_ulps(c, plane, up ? c->ulps : -c->ulps);
	*d = i & 8 ? 0.0 : -0.0;
}

void ray_grazing(void *arg, uint32_t i, ald_ray *r)
{
	struct course *c = arg;
	uint32_t f = random_below(&c->seed, c->soup->triangles);
	vec a = vertex_of(c, f, 0), ab = vec_sub(vertex_of(c, f, 1), a), ac = vec_sub(vertex_of(c, f, 2), a);
	double u = random_unit(&c->seed), v = random_unit(&c->seed) * (1 - u);
	vec p = vec_mad(vec_mad(a, ab, u), ac, v), n = vec_unit(vec_cross(ab, ac));
	vec d = vec_unit(vec_add(vec_scale(ab, random_signed(&c->seed)), vec_scale(ac, random_signed(&c->seed))));

	ray_start(r);
	r->dir = vec_mad(d, n, pow(10, -7 + 4 * random_unit(&c->seed)) * (i & 1 ? 1 : -1));
	r->org = kept_vec(c, vec_mad(p, r->dir, -2 * c->radius));
	r->dir = kept_vec(c, r->dir);
}

void ray_axis(void *arg, uint32_t i, ald_ray *r)
{
	struct course *c = arg;
	vec v = c->soup->vertex[random_below(&c->seed, c->soup->vertices)];
	unsigned axis = i % 3;

	ray_start(r);
	r->dir = random_direction(&c->seed);
	(&r->dir.x)[axis] = i & 4 ? 0.0 : -0.0;
	if (i & 8)
		(&r->dir.x)[(axis + 1) % 3] = i & 16 ? 0.0 : -0.0;
	r->dir = kept_vec(c, r->dir);
	r->org = kept_vec(c, vec_mad(v, r->dir, -3 * c->radius / vec_length(r->dir)));
	for (unsigned k = 0; k < 3; k++) {
		if ((&r->dir.x)[k] == 0)
			(&r->org.x)[k] = (&v.x)[k];
	}
}
