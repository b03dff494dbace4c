/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "shade/light.h"

#include "base/rng.h"

#define DEGREE (3.14159265358979323846 / 180)

struct light_ray light_towards(const struct light *l, vec p, vec shift)
{
	vec centre = vec_add(l->location, shift), to = vec_sub(centre, p);
	struct light_ray r;

	if (l->kind == LIGHT_CYLINDER) {
		/* Parallel beams against the axis; the shifted centre tilts it, as point_at stays. */
		vec back = vec_sub(shift, vec_scale(l->direction, l->axis_length));

		r.dir = vec_unit(back);
		r.depth = vec_dot(to, r.dir);
	} else {
		r.depth = vec_length(to);
		r.dir = vec_scale(to, 1 / r.depth);
	}
	if (l->parallel) {
		vec back = vec_neg(l->direction);

		if (l->area)
			back = vec_unit(vec_sub(shift, vec_scale(l->direction, l->axis_length)));
		r.depth *= vec_dot(back, r.dir);
		r.dir = back;
	}
	return r;
}

/* 1 from high on, else 0 below low, a smooth cubic between. Where high is below low, as Blender writes
 * some cones, high decides: measured. */
static double smooth(double low, double high, double x)
{
	if (x >= high)
		return 1;
	if (x < low)
		return 0;
	x = (x - low) / (high - low);
	return (3 - 2 * x) * x * x;
}

static double spot_cone(const struct light *l, const struct light_ray *r)
{
	double c = -vec_dot(r->dir, l->direction), radius = cos(l->radius * DEGREE);
	double a;

	if (c <= 0)
		return 0;
	a = l->tightness != 0 ? pow(c, l->tightness) : 1;
	if (radius > 0)
		a *= smooth(cos(l->falloff * DEGREE), radius, c);
	return a;
}

static double cylinder_beam(const struct light *l, vec p)
{
	vec from = vec_sub(p, l->location);
	double along = vec_dot(from, l->direction), off, inner, a;

	if (along <= 0)
		return 0;
	off = sqrt(fmax(0, vec_dot(from, from) - along * along));
	if (off >= l->falloff)
		return 0;
	inner = 1 - off / l->falloff;
	a = l->tightness != 0 ? pow(inner, l->tightness) : 1;
	if (l->radius > 0 && off > l->radius)
		a *= smooth(0, 1 - l->radius / l->falloff, inner);
	return a;
}

/* Lamps fade with the square of the distance, unless their maker had other things in mind. */
static double power(double x, double n)
{
	return n == 2 ? x * x : pow(x, n);
}

double light_attenuation(const struct light *l, vec p, const struct light_ray *r)
{
	double a = 1;

	if (l->kind == LIGHT_SPOT)
		a = spot_cone(l, r);
	else if (l->kind == LIGHT_CYLINDER)
		a = cylinder_beam(l, p);
	if (a > 0 && l->fade_power > 0 && l->fade_distance != 0)
		a *= 2 / (1 + power(r->depth / l->fade_distance, l->fade_power));
	return a;
}

void light_axes(const struct light *l, vec p, vec *axis1, vec *axis2)
{
	struct light_ray r;
	double length;
	vec side;

	*axis1 = l->axis1;
	*axis2 = l->axis2;
	if (!l->orient)
		return;
	r = light_towards(l, p, vec_make(0, 0, 0));
	length = vec_length(l->axis1);
	side = fabs(fabs(r.dir.z) - 1) < 0.01 ? vec_make(0, 1, 0) : vec_make(0, 0, 1);
	*axis1 = vec_unit(vec_cross(r.dir, side));
	*axis2 = vec_scale(vec_unit(vec_cross(r.dir, *axis1)), length);
	*axis1 = vec_scale(*axis1, length);
}

/* A grid coordinate in -0.5 .. 0.5. */
static double grid(double i, uint32_t n)
{
	return n > 1 ? i / (double)(n - 1) - 0.5 : 0;
}

/* An additive recurrence of low discrepancy in two dimensions (Roberts, 2018), from a random start. */
static double jitter(uint64_t key, uint32_t i, uint32_t round)
{
	static const double step[] = { 0.7548776662466927, 0.5698402909980532 };
	double x = rng_unit(rng_child(key, i)) + round * step[i];

	return x - floor(x) - 0.5;
}

vec light_grid_point(const struct light *l, vec axis1, vec axis2, uint32_t u, uint32_t v, uint64_t key,
		     uint32_t round)
{
	double a = u, b = v;

	if (l->jitter) {
		a += jitter(key, 0, round);
		b += jitter(key, 1, round);
	}
	a = grid(a, l->size1);
	b = grid(b, l->size2);
	if (l->circular) {
		double longer, r;

		/* Squares of the grid become circles; POV-Ray shifts by a thousandth of the light so
		 * that the middle point is no special case. */
		a += 0.001;
		b += 0.001;
		longer = fmax(fabs(a), fabs(b));
		r = sqrt(a * a + b * b);
		if (r > 0) {
			a *= longer / r;
			b *= longer / r;
		}
	}
	return vec_add(vec_scale(axis1, a), vec_scale(axis2, b));
}

/* Where the ray is within a spotlight's cone. May run to infinity. */
static bool cone_reach(const struct light *l, vec org, vec dir, double *from, double *to)
{
	double k = cos(l->falloff * DEGREE), m = 1 / (k * k);
	vec v = vec_sub(org, l->location);
	double along = vec_dot(dir, l->direction), at = vec_dot(v, l->direction);
	double a = 1 - along * along * m, b = vec_dot(v, dir) - along * at * m;
	double c = vec_dot(v, v) - at * at * m, d = b * b - a * c, t1, t2;
	bool within = vec_dot(v, v) > 0 && at >= k * vec_length(v);

	*from = 0;
	*to = HUGE_VAL;
	if (a == 0 || d <= 0)
		return within;
	d = sqrt(d);
	t1 = fmin((-b - d) / a, (-b + d) / a);
	t2 = fmax((-b - d) / a, (-b + d) / a);
	/* Roots on the cone's mirror image behind the lamp do not count. */
	if (at + t1 * along <= 0 && at + t2 * along <= 0)
		return false;
	if (at + t1 * along <= 0) {
		*from = within ? 0 : t2;
		*to = within && t2 > 0 ? t2 : HUGE_VAL;
	} else if (at + t2 * along <= 0) {
		*from = within ? 0 : t1;
		*to = within ? t1 : HUGE_VAL;
	} else {
		*from = t1;
		*to = t2;
	}
	return true;
}

static bool cylinder_reach(const struct light *l, vec org, vec dir, double *from, double *to)
{
	vec v = vec_sub(org, l->location);
	double along = vec_dot(dir, l->direction), at = vec_dot(v, l->direction);
	double a = 1 - along * along, b = vec_dot(v, dir) - along * at;
	double c = vec_dot(v, v) - at * at - l->falloff * l->falloff, d = b * b - a * c;

	if (a <= 0 || d <= 0 || (along <= 0 && at < 0))
		return false;
	d = sqrt(d);
	*from = (-b - d) / a;
	*to = (-b + d) / a;
	if (at + *from * along <= 0 && at + *to * along <= 0)
		return false;
	if (at + *from * along <= 0)
		*from = 0;
	else if (at + *to * along <= 0)
		*to = HUGE_VAL;
	return true;
}

bool light_reach(const struct light *l, vec org, vec dir, double length, double *from, double *to)
{
	*from = 0;
	*to = length;
	if (l->kind == LIGHT_SPOT && !cone_reach(l, org, dir, from, to))
		return false;
	if (l->kind == LIGHT_CYLINDER && !cylinder_reach(l, org, dir, from, to))
		return false;
	if (*from >= length || *to <= 0)
		return false;
	*from = fmax(*from, 0);
	*to = fmin(*to, length);
	return true;
}
