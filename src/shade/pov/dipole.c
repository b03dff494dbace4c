/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * POV-Ray's own choices, which its pictures depend on: another fit of the diffuse Fresnel reflectance than the
 * paper's, albedos from a table of a hundred steps, and all light passing where an index below 1 reflects it all.
 */
#include "shade/pov/dipole.h"

#define PI 3.14159265358979323846
#define STEPS 100
#define PRECISE 1e-10

/* Of light that comes from all directions below the surface. */
static double diffuse_fresnel(double ior)
{
	double x = 1 - 1 / ior;

	if (ior < 1)
		return ior * ior - pow(ior, 2.25);
	return (x + 3 * pow(x, 4.5)) / 4;
}

static double boundary(double ior)
{
	double f = diffuse_fresnel(ior);

	return (1 + f) / (1 - f);
}

/* Jensen and Buhler's equation for the reflectance of a flat surface in even light. */
static double reflected(double albedo, double boundary)
{
	double root = sqrt(3 * (1 - albedo));

	return albedo / 2 * (1 + exp(-4.0 / 3 * boundary * root)) * exp(-root);
}

/* The albedo at a step of the table: false position, with the Illinois rule. */
static double solve(int step, double boundary)
{
	double want = (double)step / STEPS, low = 0, high = 1, at_low = -want, at_high = 1 - want, x = want;

	if (step <= 0 || step >= STEPS)
		return step > 0;
	for (int i = 0, side = 0; i < 100; i++) {
		double at;

		x = low + (high - low) * at_low / (at_low - at_high);
		at = reflected(x, boundary) - want;
		if (fabs(at) < PRECISE)
			break;
		if (at < 0) {
			low = x;
			at_low = at;
			at_high *= side < 0 ? 0.5 : 1;
			side = -1;
		} else {
			high = x;
			at_high = at;
			at_low *= side > 0 ? 0.5 : 1;
			side = 1;
		}
	}
	return x;
}

double dipole_albedo(double reflectance, double ior)
{
	double x = fmin(fmax(reflectance, 0), 1) * STEPS, part = x - floor(x), a = boundary(ior);
	int step = (int)x;

	if (part == 0)
		return solve(step, a);
	return (1 - part) * solve(step, a) + part * solve(step + 1, a);
}

struct dipole dipole_make(double translucency, double albedo, double ior)
{
	struct dipole d = { .albedo = albedo };

	if (!(albedo > 0))
		return (struct dipole){ .albedo = 0 };
	d.scatter = 1 / translucency;
	d.extinct = d.scatter / albedo;
	d.absorb = d.extinct - d.scatter;
	d.decay = sqrt(3 * d.absorb * d.extinct);
	d.real = 1 / d.extinct;
	d.mirrored = d.real * (1 + boundary(ior) * 4 / 3);
	return d;
}

/* What one of the sources, at this depth, brings. */
static double source(const struct dipole *d, double depth, double distance2)
{
	double r2 = depth * depth + distance2, r = sqrt(r2);

	return depth * (d->decay + 1 / r) * exp(-d->decay * r) / r2;
}

double dipole_profile(const struct dipole *d, double distance2)
{
	if (!(d->albedo > 0))
		return 0;
	return d->albedo / (4 * PI) * (source(d, d->real, distance2) + source(d, d->mirrored, distance2));
}

double dipole_fresnel(double cosine, double ior)
{
	double g2 = ior * ior + cosine * cosine - 1, g, a, b;

	if (g2 < 0)
		return 1;
	g = sqrt(g2);
	if (g + cosine <= 0)
		return 0;
	a = (g - cosine) / (g + cosine);
	b = (cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1);
	return 1 - fmin(1, fmax(0, 0.5 * a * a * (1 + b * b)));
}
