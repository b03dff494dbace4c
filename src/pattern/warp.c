/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Warps: where a point goes before the pattern is asked (manual 3.4.7.7).
 */
#include "pattern/noise.h"
#include "base/single.h"
#include "pattern/pattern.h"

#define PI 3.14159265358979323846
#define TINY 1e-10 /* what POV-Ray takes for 0 */
#define FAR 1e17 /* coordinates go no further */

static double *component(vec *v, unsigned k)
{
	return k == 0 ? &v->x : k == 1 ? &v->y : &v->z;
}

static vec warp_repeat(const struct warp *w, vec p)
{
	unsigned k = w->w.repeat.axis;
	double x = *component(&p, k), width = w->w.repeat.width;
	double block = as_single(floor(x / width));
	vec q = p;

	*component(&q, k) = x - block * width;
	if (fmod(block, 2) != 0) {
		q = vec_make(q.x * w->w.repeat.flip.x, q.y * w->w.repeat.flip.y, q.z * w->w.repeat.flip.z);
		if (*component((vec *)&w->w.repeat.flip, k) < 0)
			*component(&q, k) += width;
	}
	return vec_mad(q, w->w.repeat.offset, block);
}

static double block_of(double x, double size)
{
	return size >= TINY ? floor(x / size) : 0;
}

static vec by_components(vec a, vec b)
{
	return vec_make(a.x * b.x, a.y * b.y, a.z * b.z);
}

/* In the block that p is in, where it may be anywhere within the uncertainty. */
static vec hole_centre(const struct warp *w, vec p)
{
	vec size = w->w.hole.repeat, centre = w->w.hole.centre;
	vec block = { block_of(p.x, size.x), block_of(p.y, size.y), block_of(p.z, size.z) };

	if (w->w.hole.uncertain)
		centre = vec_add(centre, by_components(noise_cell_at(block).random, w->w.hole.uncertainty));
	return vec_add(centre, by_components(block, size));
}

static vec warp_hole(const struct warp *w, vec p)
{
	vec centre = w->w.hole.centre, away;
	double length, pull;

	if (w->w.hole.repeats)
		centre = hole_centre(w, p);
	away = vec_sub(p, centre);
	length = vec_length(away);
	if (length >= w->w.hole.radius || w->w.hole.none)
		return p;
	pull = pow((w->w.hole.radius - length) / w->w.hole.radius, w->w.hole.power) * w->w.hole.strength;
	if (pull > 1)
		pull = 1;
	return vec_mad(p, away, w->w.hole.inverse ? -pull : pull);
}

/* From the flat coordinates to the axis that is to be along the view. */
static vec orient(const struct warp *w, double x, double y, double z)
{
	vec o = w->w.map.orientation;

	if (o.x == 0 && o.y == 0 && o.z == 1)
		return vec_make(x, y, z);
	return vec_make(o.x * z + o.y * x + o.z * x, o.x * y - o.y * z + o.z * y,
			o.y * y - o.x * x + o.z * z);
}

/* Around the y axis from x towards z, 0 to 1. length: of (x, z). */
static double turn(double x, double z, double length)
{
	double angle = acos(x / length);

	if (z == 0)
		return x > 0 ? 0 : 0.5;
	return (z < 0 ? 2 * PI - angle : angle) / (2 * PI);
}

static double stretch(const struct warp *w, double length)
{
	double e = w->w.map.exponent;

	return e == 1 ? length : e != 0 ? pow(length, e) : 1;
}

static vec warp_cylindrical(const struct warp *w, vec p)
{
	double length = sqrt(p.x * p.x + p.z * p.z);

	if (length == 0)
		return p;
	return orient(w, turn(p.x, p.z, length) * stretch(w, length), p.y, length);
}

static vec warp_spherical(const struct warp *w, vec p)
{
	double distance = vec_length(p), length, across = 0, up, s;
	vec q;

	if (distance == 0)
		return p;
	q = vec_scale(p, 1 / distance);
	up = 0.5 + asin(q.y) / PI;
	length = sqrt(q.x * q.x + q.z * q.z);
	if (length != 0) /* POV-Ray's pi where the z coordinate is 0 is measured in turns as well */
		across = turn(q.x, q.z, length);
	s = stretch(w, distance);
	return orient(w, across * s, up * s, distance);
}

static vec warp_toroidal(const struct warp *w, vec p)
{
	double length = sqrt(p.x * p.x + p.z * p.z), across, around, x, s;

	if (length == 0)
		return p;
	across = turn(p.x, p.z, length);
	x = length - w->w.map.major;
	length = sqrt(x * x + p.y * p.y);
	around = acos(-x / length);
	if (p.y > 0)
		around = 2 * PI - around;
	s = stretch(w, length);
	return orient(w, across * s, around / (2 * PI) * s, length);
}

/* A cube's faces unfolded to a cross, four wide and three high. */
static vec warp_cubic(vec p)
{
	double ax = fabs(p.x), ay = fabs(p.y), az = fabs(p.z);
	const double third = 1.0 / 3;

	if (p.x >= 0 && ax >= ay && ax >= az)
		return vec_make(0.75 - 0.125 * (p.z / ax + 1), third + third * (p.y / ax + 1) / 2, ax);
	if (p.y >= 0 && ay >= ax && ay >= az)
		return vec_make(0.25 + 0.125 * (p.x / ay + 1), 1 - third * (p.z / ay + 1) / 2, ay);
	if (p.z >= 0 && az >= ax && az >= ay)
		return vec_make(0.25 + 0.125 * (p.x / az + 1), third + third * (p.y / az + 1) / 2, az);
	if (p.x < 0 && ax >= ay && ax >= az)
		return vec_make(0.125 * (p.z / ax + 1), third + third * (p.y / ax + 1) / 2, ax);
	if (p.y < 0 && ay >= ax && ay >= az)
		return vec_make(0.25 + 0.125 * (p.x / ay + 1), third * (p.z / ay + 1) / 2, ay);
	return vec_make(1 - 0.125 * (p.x / az + 1), third + third * (p.y / az + 1) / 2, az);
}

static vec shake(vec p, vec amount, uint32_t octaves, double lambda, double omega)
{
	vec t = noise_vector_turbulence(p, octaves, lambda, omega);

	return vec_add(p, vec_make(t.x * amount.x, t.y * amount.y, t.z * amount.z));
}

static vec warp_one(const struct warp *w, vec p)
{
	switch (w->kind) {
	case WARP_TRANSFORM:
		return mat_point(&w->w.place.inv, p);
	case WARP_TURBULENCE:
		return shake(p, w->w.turbulence.amount, w->w.turbulence.octaves,
			     w->w.turbulence.lambda, w->w.turbulence.omega);
	case WARP_REPEAT:
		return warp_repeat(w, p);
	case WARP_BLACK_HOLE:
		return warp_hole(w, p);
	case WARP_PLANAR:
		return orient(w, p.x, p.y, w->w.map.distance);
	case WARP_CYLINDRICAL:
		return warp_cylindrical(w, p);
	case WARP_SPHERICAL:
		return warp_spherical(w, p);
	case WARP_TOROIDAL:
		return warp_toroidal(w, p);
	case WARP_CUBIC:
		return warp_cubic(p);
	default:
		return p;
	}
}

vec pattern_warp(const struct pattern *q, vec p)
{
	const vec *t = &q->turbulence.amount;

	for (uint32_t i = 0; i < q->warp_count; i++)
		p = warp_one(&q->warp[i], p);
	if ((t->x != 0 || t->y != 0 || t->z != 0) && q->kind != PATTERN_MARBLE && q->kind != PATTERN_WOOD)
		p = shake(p, *t, q->turbulence.octaves, q->turbulence.lambda, q->turbulence.omega);
	for (unsigned k = 0; k < 3; k++) {
		double *x = component(&p, k);

		*x = *x > FAR ? FAR : *x < -FAR ? -FAR : *x;
	}
	return p;
}
