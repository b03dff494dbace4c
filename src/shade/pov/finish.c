/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "shade/pov/finish.h"

#include "pattern/random.h"

#define HALF_PI (3.14159265358979323846 / 2)

bool finish_is_mirror(const struct finish *f)
{
	const struct rgb *a = &f->reflection_min, *b = &f->reflection_max;

	return a->r != 0 || a->g != 0 || a->b != 0 || b->r != 0 || b->g != 0 || b->b != 0;
}

bool finish_needs_light(const struct finish *f, bool beneath)
{
	return (!beneath && (f->diffuse != 0 || f->diffuse_back != 0)) || f->phong != 0 || f->specular != 0;
}

static struct rgb mix(struct rgb a, struct rgb b, double t)
{
	return rgb_add(rgb_scale(a, 1 - t), rgb_scale(b, t));
}

/* Unpolarised Fresnel reflectance of a dielectric. */
static double fresnel(double cosine, double ior)
{
	double g2 = ior * ior + cosine * cosine - 1, g, a, b, r;

	if (g2 <= 0)
		return 1;
	g = sqrt(g2);
	a = (g - cosine) / (g + cosine);
	b = (cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1);
	r = 0.5 * a * a * (1 + b * b);
	return r < 0 ? 0 : r > 1 ? 1 : r;
}

/* The empirical Fresnel curve of metals; cosine of the angle to the normal. */
static double metal_fresnel(double cosine)
{
	double x, d, f;

	cosine = cosine > 1 ? 1 : cosine < -1 ? -1 : cosine;
	x = acos(cosine) / HALF_PI;
	d = x - 1.12;
	f = 0.014567225 / (d * d) - 0.011612903;
	return f < 0 ? 0 : f > 1 ? 1 : f;
}

/* 1 for no metal, towards the pigment for one. */
static struct rgb metal_tint(double metallic, double cosine, struct rgb pigment)
{
	double m = metallic * (1 - metal_fresnel(cosine));

	return rgb_make(1 + m * (pigment.r - 1), 1 + m * (pigment.g - 1), 1 + m * (pigment.b - 1));
}

/* Before a metal's own colour tints it. */
static struct rgb untinted(const struct finish *f, double cosine, double ior)
{
	double x = 1 - cosine;

	if (f->reflection_fresnel)
		return mix(f->reflection_min, f->reflection_max, fresnel(cosine, ior));
	if (f->reflection_falloff != 1)
		x = pow(x < 0 ? 0 : x, f->reflection_falloff);
	return mix(f->reflection_min, f->reflection_max, x);
}

struct rgb finish_reflectivity(const struct finish *f, double cosine, double ior, struct rgb pigment)
{
	struct rgb r = untinted(f, cosine, ior);

	if (f->reflection_metallic != 0)
		r = rgb_mul(r, metal_tint(f->reflection_metallic, cosine, pigment));
	return r;
}

double finish_mirror_weight(const struct finish *f, double cosine, double ior)
{
	double a, b;

	if (f->reflection_fresnel)
		return rgb_max(untinted(f, cosine, ior));
	a = rgb_max(f->reflection_max);
	b = rgb_max(f->reflection_min);
	return a > b ? a : b;
}

static struct rgb diffuse(const struct finish *f, const struct finish_light *l, double cosine)
{
	double amount = l->behind ? f->diffuse_back : f->diffuse;

	if (amount <= 0 || l->beneath)
		return rgb_make(0, 0, 0);
	cosine = fabs(cosine);
	if (f->brilliance != 1)
		cosine = pow(cosine, f->brilliance);
	return rgb_scale(rgb_mul(l->pigment, l->light), cosine * amount * l->opacity - f->crand * l->noise);
}

static double phong(const struct finish *f, const struct finish_light *l)
{
	vec mirrored = vec_mad(l->eye, l->normal, -2 * vec_dot(l->eye, l->normal));
	double c = vec_dot(mirrored, l->to_light);

	if (c <= 0 || (f->phong_size >= 60 && c <= 0.0008))
		return 0;
	return f->phong * pow(c, f->phong_size);
}

static double specular(const struct finish *f, const struct finish_light *l)
{
	vec half = vec_scale(vec_sub(l->to_light, l->eye), 0.5);
	double length = vec_length(half), c;

	if (length <= 0)
		return 0;
	c = vec_dot(half, l->normal) / length;
	return c > 0 ? f->specular * pow(c, 1 / f->roughness) : 0;
}

struct rgb finish_shade(const struct finish *f, const struct finish_light *l)
{
	double cosine = vec_dot(l->normal, l->to_light), shine = 0;
	struct rgb out = diffuse(f, l, cosine), tint = { 1, 1, 1 };

	if (l->behind || !l->highlights)
		return out;
	if (f->phong > 0)
		shine += phong(f, l);
	if (f->specular > 0)
		shine += specular(f, l);
	if (shine == 0)
		return out;
	if (f->metallic > 0)
		tint = metal_tint(f->metallic, cosine, l->pigment);
	return rgb_add(out, rgb_scale(rgb_mul(l->light, tint), shine));
}

/* Light that goes through the film and back interferes with what does not: one cosine a channel, of the
 * way through the film. Turbulence of fixed octaves varies its thickness. */
struct rgb finish_irid(const struct scene *s, const struct finish *f, vec to_light, vec eye, vec normal, vec p)
{
	const struct pattern any = { .noise = 0 }; /* the scene's */
	double thickness = f->irid_thickness, phase;

	if (f->irid_turbulence != 0)
		thickness *= 1 + f->irid_turbulence *
				 (2 * noise_turbulence(p, pattern_generator(s, &any), 5, 2, 0.5) - 1);
	phase = 4 * HALF_PI * thickness * (fabs(vec_dot(normal, to_light)) + fabs(vec_dot(normal, eye)));
	return rgb_make(1 + f->irid * cos(phase / s->irid_wavelength.r),
			1 + f->irid * cos(phase / s->irid_wavelength.g),
			1 + f->irid * cos(phase / s->irid_wavelength.b));
}
