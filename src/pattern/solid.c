/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Patterns that are plain formulas of the point (manual 3.4.7.1).
 */
#include "pattern/family.h"
#include "pattern/noise.h"
#include "pattern/random.h"

#define PI 3.14159265358979323846

/* 1 in the middle, falling to 0 at a distance of 1. */
static double falling(double distance)
{
	return distance > 1 ? 0 : 1 - distance;
}

double solid_boxed(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	(void)s;
	(void)q;
	return falling(fmax(fabs(at->p.x), fmax(fabs(at->p.y), fabs(at->p.z))));
}

double solid_cylindrical(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	(void)s;
	(void)q;
	return falling(sqrt(at->p.x * at->p.x + at->p.z * at->p.z));
}

double solid_planar(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	(void)s;
	(void)q;
	return falling(fabs(at->p.y));
}

double solid_spherical(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	(void)s;
	(void)q;
	return falling(vec_length(at->p));
}

double solid_gradient(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	double x = vec_dot(at->p, q->of.gradient);

	(void)s;
	return x > 1 ? fmod(x, 1) : x;
}

double solid_onion(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	(void)s;
	(void)q;
	return fmod(vec_length(at->p), 1);
}

double solid_radial(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	(void)s;
	(void)q;
	if (fabs(at->p.x) < 0.001 && fabs(at->p.z) < 0.001)
		return 0.25;
	return 0.25 + (atan2(at->p.x, at->p.z) + PI) / (2 * PI);
}

double solid_leopard(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	double x = (sin(at->p.x) + sin(at->p.y) + sin(at->p.z)) / 3;

	(void)s;
	(void)q;
	return x * x;
}

/* A cubic Bezier curve from 0 to 1 over the distance from a cube's middle, with the controls between. */
double solid_quilt(const struct pattern *q, double t)
{
	double u = 1 - t;

	return 1.154700538 *
	       (t * t * t + 3 * t * u * u * q->of.quilted.control0 + 3 * t * t * u * q->of.quilted.control1);
}

/* A negative whole number is the end of the quilt below it, as faces of boxes show. */
static double below(double x)
{
	return x >= 0 ? floor(x) : -floor(-x) - 1;
}

vec solid_quilt_place(vec p)
{
	return vec_make(p.x - below(p.x) - 0.5, p.y - below(p.y) - 0.5, p.z - below(p.z) - 0.5);
}

double solid_quilted(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	vec v = solid_quilt_place(at->p);

	(void)s;
	return fabs(solid_quilt(q, vec_length(v))) * (fabs(v.x) + fabs(v.y) + fabs(v.z)) / 3;
}

/* The spiral's phase: around z, outward and along z. */
static double winding(const struct scene *s, const struct pattern *q, const struct pattern_point *at,
		      double *radius)
{
	double turbulence = q->turbulence.amount.x;

	double r = sqrt(at->p.x * at->p.x + at->p.y * at->p.y), angle = 0;

	if (r != 0)
		angle = at->p.x < 0 ? 1.5 * PI - asin(at->p.y / r) : 0.5 * PI + asin(at->p.y / r);
	*radius = r;
	if (turbulence != 0)
		turbulence *= noise_turbulence(at->p, pattern_generator(s, q), q->turbulence.octaves,
					       q->turbulence.lambda, q->turbulence.omega);
	return at->p.z + r + q->of.arms * angle / (2 * PI) + turbulence;
}

double solid_spiral1(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	double r;

	return winding(s, q, at, &r);
}

double solid_spiral2(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	double r, phase = winding(s, q, at, &r);

	return wave_triangle(r) + wave_triangle(phase);
}
