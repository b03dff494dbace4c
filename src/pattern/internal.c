/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * POV-Ray's internal functions (functions.inc, which lists their names and parameters): those that scenes use.
 * f_ridged_mf is Musgrave's ridged multifractal (Texturing and Modeling, chapter 16), with signs and order as
 * measured; f_helix1, f_superellipsoid and f_rounded_box take superellipses of exponent 2 / shape.
 */
#include <config.h>

#include "pattern/function.h"

#include <math.h>

#include "pattern/noise.h"

#define PI 3.14159265358979323846

static uint32_t default_generator(const struct scene *s)
{
	if (s->noise_generator)
		return s->noise_generator;
	return s->version < 350 ? NOISE_ORIGINAL : NOISE_RANGED;
}

/* As a parameter: the lowest two bits count, and 0 is the original one. */
static uint32_t generator(double v)
{
	uint32_t n = (uint32_t)(int32_t)fmin(fmax(v, -1e9), 1e9) & 3;

	return n ? n : NOISE_ORIGINAL;
}

static double noise3d(const struct scene *s, const double *a)
{
	return noise_value(vec_make(a[0], a[1], a[2]), default_generator(s));
}

static double noise_by(const struct scene *s, const double *a)
{
	(void)s;
	return noise_value(vec_make(a[0], a[1], a[2]), generator(a[3]));
}

static double radius(const struct scene *s, const double *a)
{
	(void)s;
	return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static double polar_angle(const struct scene *s, const double *a)
{
	(void)s;
	return atan2(sqrt(a[0] * a[0] + a[2] * a[2]), a[1]);
}

static double azimuth(const struct scene *s, const double *a)
{
	(void)s;
	return atan2(a[0], a[2]);
}

static double sphere(const struct scene *s, const double *a)
{
	return radius(s, a) - a[3];
}

static double ellipsoid(const struct scene *s, const double *a)
{
	return radius(s, (double[3]){ a[0] * a[3], a[1] * a[4], a[2] * a[5] });
}

static double torus(const struct scene *s, const double *a)
{
	double ring = sqrt(a[0] * a[0] + a[2] * a[2]) - a[3];

	(void)s;
	return sqrt(ring * ring + a[1] * a[1]) - a[4];
}

/* How far v lies outside of -half..half. */
static double beyond(double v, double half)
{
	return fmax(fabs(v) - half, 0);
}

/* Parameters: radius of the edges, half the sizes. POV-Ray makes it a millionth larger. */
static double rounded_box(const struct scene *s, const double *a)
{
	double r = a[3];

	return radius(s, (double[3]){ beyond(a[0], a[4] - r), beyond(a[1], a[5] - r), beyond(a[2], a[6] - r) }) - r -
	       1e-6;
}

static double superellipsoid(const struct scene *s, const double *a)
{
	double east = 2 / a[3], north = 2 / a[4];
	double flat = pow(fabs(a[0]), east) + pow(fabs(a[1]), east);

	(void)s;
	return 1 - pow(pow(flat, a[3] / a[4]) + pow(fabs(a[2]), north), a[4] / 2);
}

/* A cross section: 1 is round, 0 square, between them rounded squares. */
static double section(double x, double z, double shape)
{
	double e;

	if (shape == 0)
		return fmax(fabs(x), fabs(z));
	e = 2 / shape;
	return shape == 1 ? sqrt(x * x + z * z) : pow(pow(fabs(x), e) + pow(fabs(z), e), shape / 2);
}

/* Parameters: how many, turns, minor and major radius, height of a tube, cross section, its rotation. */
static double helix1(const struct scene *s, const double *a)
{
	double round = sqrt(a[0] * a[0] + a[2] * a[2]);
	double turn = fmod(a[3] * (atan2(a[2], round > 0 ? a[0] : 1e-6) + a[1] * a[4]), 2 * PI);
	double x = round - a[6], z, angle = a[9] * (PI / 180), across;

	(void)s;
	if (turn < 0)
		turn += 2 * PI;
	z = (turn - PI) / a[7] / (a[4] * a[3]);
	across = x * cos(angle) - z * sin(angle);
	return fmin(a[6] + round, section(across, x * sin(angle) + z * cos(angle), a[8])) - a[5];
}

/* Parameters: H, lacunarity, octaves, offset, gain, noise generator. */
static double ridged_mf(const struct scene *s, const double *a)
{
	vec p = vec_make(a[0], a[1], a[2]);
	double frequency = 1, signal = 0, sum = 0, weight;
	uint32_t g = generator(a[8]), octaves = a[5] < 1000 ? (uint32_t)fmax(ceil(a[5]), 1) : 1000;

	(void)s;
	for (uint32_t i = 0; i < octaves; i++) {
		weight = i ? fmin(fmax(signal * a[7], 0), 1) : 1;
		signal = a[6] - fabs(2 * noise_value(p, g) - 1);
		signal *= signal * weight;
		sum += signal * pow(frequency, -a[3]);
		frequency *= a[4];
		p = vec_scale(p, a[4]);
	}
	return sum;
}

static const struct {
	const char *name;
	uint32_t extra; /* parameters besides x, y and z */
	double (*eval)(const struct scene *, const double *); /* NULL: not here */
} table[] = {
	{ "f_algbr_cyl1", 5, NULL }, { "f_algbr_cyl2", 5, NULL }, { "f_algbr_cyl3", 5, NULL },
	{ "f_algbr_cyl4", 5, NULL }, { "f_bicorn", 2, NULL }, { "f_bifolia", 2, NULL }, { "f_blob", 5, NULL },
	{ "f_blob2", 4, NULL }, { "f_boy_surface", 2, NULL }, { "f_comma", 1, NULL },
	{ "f_cross_ellipsoids", 4, NULL }, { "f_crossed_trough", 1, NULL }, { "f_cubic_saddle", 1, NULL },
	{ "f_cushion", 1, NULL }, { "f_devils_curve", 1, NULL }, { "f_devils_curve_2d", 6, NULL },
	{ "f_dupin_cyclid", 6, NULL }, { "f_ellipsoid", 3, ellipsoid }, { "f_enneper", 1, NULL },
	{ "f_flange_cover", 4, NULL }, { "f_folium_surface", 3, NULL }, { "f_folium_surface_2d", 6, NULL },
	{ "f_glob", 1, NULL }, { "f_heart", 1, NULL }, { "f_helical_torus", 10, NULL },
	{ "f_helix1", 7, helix1 }, { "f_helix2", 7, NULL }, { "f_hex_x", 1, NULL }, { "f_hex_y", 1, NULL },
	{ "f_hetero_mf", 6, NULL }, { "f_hunt_surface", 1, NULL }, { "f_hyperbolic_torus", 3, NULL },
	{ "f_isect_ellipsoids", 4, NULL }, { "f_kampyle_of_eudoxus", 3, NULL },
	{ "f_kampyle_of_eudoxus_2d", 6, NULL }, { "f_klein_bottle", 1, NULL },
	{ "f_kummer_surface_v1", 1, NULL }, { "f_kummer_surface_v2", 4, NULL },
	{ "f_lemniscate_of_gerono", 1, NULL }, { "f_lemniscate_of_gerono_2d", 6, NULL }, { "f_mesh1", 5, NULL },
	{ "f_mitre", 1, NULL }, { "f_nodal_cubic", 1, NULL }, { "f_odd", 1, NULL },
	{ "f_ovals_of_cassini", 4, NULL }, { "f_paraboloid", 1, NULL }, { "f_parabolic_torus", 3, NULL },
	{ "f_ph", 0, polar_angle }, { "f_pillow", 1, NULL }, { "f_piriform", 1, NULL },
	{ "f_piriform_2d", 7, NULL }, { "f_poly4", 5, NULL }, { "f_polytubes", 6, NULL },
	{ "f_quantum", 1, NULL }, { "f_quartic_paraboloid", 1, NULL }, { "f_quartic_saddle", 1, NULL },
	{ "f_quartic_cylinder", 3, NULL }, { "f_r", 0, radius }, { "f_ridge", 6, NULL },
	{ "f_ridged_mf", 6, ridged_mf }, { "f_rounded_box", 4, rounded_box }, { "f_sphere", 1, sphere },
	{ "f_spikes", 5, NULL }, { "f_spikes_2d", 4, NULL }, { "f_spiral", 6, NULL },
	{ "f_steiners_roman", 1, NULL }, { "f_strophoid", 4, NULL }, { "f_strophoid_2d", 7, NULL },
	{ "f_superellipsoid", 2, superellipsoid }, { "f_th", 0, azimuth }, { "f_torus", 2, torus },
	{ "f_torus2", 3, NULL }, { "f_torus_gumdrop", 1, NULL }, { "f_umbrella", 1, NULL },
	{ "f_witch_of_agnesi", 2, NULL }, { "f_witch_of_agnesi_2d", 6, NULL }, { "f_noise3d", 0, noise3d },
	{ "f_pattern", 0, NULL }, { "f_noise_generator", 1, noise_by },
};
#define INTERNALS (sizeof(table) / sizeof(*table))

uint32_t internal_params(uint32_t n)
{
	return n < INTERNALS ? 3 + table[n].extra : 0;
}

const char *internal_name(uint32_t n)
{
	return n < INTERNALS ? table[n].name : NULL;
}

bool internal_here(uint32_t n)
{
	return n < INTERNALS && table[n].eval;
}

double internal_eval(const struct scene *s, uint32_t n, const double *arg)
{
	return internal_here(n) ? table[n].eval(s, arg) : 0;
}
