/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Lattice noise after Perlin, An Image Synthesizer (SIGGRAPH 1985). How the cells are hashed, and each
 * formula's constants, are POV-Ray's, measured: values are within 1e-12 of those it prints.
 */
#include "pattern/noise.h"

#include "pattern/cell_table.h"
#include "pattern/noise_table.h"

#define CELLS (NOISE_SHUFFLED - 1) /* cells repeat after this many plus one, along each axis */
#define ORIGIN 10000 /* POV-Ray's cells are counted from here, down */
#define EPSILON 1e-10
#define BELOW (1 - EPSILON) /* a whole number that comes out a little low is still that number */

/* A cast to int as x86 does it, at a loss of nothing in reach. */
static inline int whole(double v)
{
	return v > -2147483649.0 && v < 2147483648.0 ? (int)v : INT32_MIN;
}

static inline double curve(double t)
{
	return t * t * (3 - 2 * t);
}

/* One axis of a cell: the corners' numbers, the distances from them, and their weights. */
struct side {
	uint32_t cell[2];
	double t[2], weight[2];
};

static inline void side_find(struct side *s, double x)
{
	int low = x >= 0 ? whole(x) : whole(x - BELOW);

	s->cell[0] = ((uint32_t)low + ORIGIN) & CELLS;
	s->cell[1] = s->cell[0] + 1;
	s->t[0] = x - low;
	s->t[1] = s->t[0] - 1;
	s->weight[1] = curve(s->t[0]);
	s->weight[0] = 1 - s->weight[1];
}

static inline uint32_t hash(uint32_t before, uint32_t next)
{
	return noise_shuffled[(before ^ next) & CELLS];
}

/* A corner's value there: a height and a plane's slopes, four reals in a row. */
static inline double plane_at(const double *r, double x, double y, double z)
{
	return r[0] * 0.5 + r[1] * x + r[2] * y + r[3] * z;
}

static double lattice(vec p)
{
	struct side x, y, z;
	double sum = 0;

	side_find(&x, p.x);
	side_find(&y, p.y);
	side_find(&z, p.z);
	for (unsigned i = 0; i < 2; i++) {
		uint32_t column = hash(x.cell[i], 0);

		for (unsigned j = 0; j < 2; j++) {
			uint32_t row = hash(column, y.cell[j]);
			const double *a = noise_real + (hash(row, z.cell[0]) & 255);
			const double *b = noise_real + (hash(row, z.cell[1]) & 255);

			sum += x.weight[i] * y.weight[j] *
			       (z.weight[0] * plane_at(a, x.t[i], y.t[j], z.t[0]) +
				z.weight[1] * plane_at(b, x.t[i], y.t[j], z.t[1]));
		}
	}
	return sum;
}

vec noise_vector(vec p)
{
	struct side x, y, z;
	vec sum = { 0, 0, 0 };

	side_find(&x, p.x);
	side_find(&y, p.y);
	side_find(&z, p.z);
	for (unsigned i = 0; i < 2; i++) {
		uint32_t column = hash(x.cell[i], 0);

		for (unsigned j = 0; j < 2; j++) {
			uint32_t row = hash(column, y.cell[j]);
			double across = x.weight[i] * y.weight[j];

			for (unsigned k = 0; k < 2; k++) {
				const double *r = noise_real + (hash(row, z.cell[k]) & 255);
				double weight = across * z.weight[k];

				sum.x += weight * plane_at(r, x.t[i], y.t[j], z.t[k]);
				sum.y += weight * plane_at(r + 4, x.t[i], y.t[j], z.t[k]);
				sum.z += weight * plane_at(r + 8, x.t[i], y.t[j], z.t[k]);
			}
		}
	}
	return sum;
}

#define GRADIENTS (NOISE_ENTRIES - 1)

static inline void gradient_side(struct side *s, double x)
{
	double t = x + 10000000.023157213; /* so that 0, where many scenes are, is no corner */
	double low = floor(t);

	s->cell[0] = (uint32_t)whole(low) & GRADIENTS;
	s->cell[1] = (s->cell[0] + 1) & GRADIENTS;
	s->t[0] = t - low;
	s->t[1] = s->t[0] - 1;
	s->weight[1] = curve(s->t[0]);
	s->weight[0] = 1 - s->weight[1];
}

static inline double gradient_at(uint32_t entry, double x, double y, double z)
{
	const int16_t *g = noise_gradient + 3 * (entry & GRADIENTS);
	double a = g[0], b = g[1], c = g[2];

	return (a * x + b * y + c * z) / sqrt(a * a + b * b + c * c);
}

static double gradients(vec p)
{
	struct side x, y, z;
	double sum = 0;

	gradient_side(&x, p.x);
	gradient_side(&y, p.y);
	gradient_side(&z, p.z);
	for (unsigned i = 0; i < 2; i++) {
		uint32_t column = noise_permutation[x.cell[i]];

		for (unsigned j = 0; j < 2; j++) {
			uint32_t row = noise_permutation[(column + y.cell[j]) & GRADIENTS];

			sum += x.weight[i] * y.weight[j] *
			       (z.weight[0] * gradient_at(row + z.cell[0], x.t[i], y.t[j], z.t[0]) +
				z.weight[1] * gradient_at(row + z.cell[1], x.t[i], y.t[j], z.t[1]));
		}
	}
	return sum;
}

static inline double clip(double v)
{
	return v > 0 ? v < 1 ? v : 1 : 0; /* what is no number is 0 */
}

double noise_value(vec p, uint32_t generator)
{
	if (generator == NOISE_PERLIN)
		return clip(0.5 * (1.59 * gradients(p) + 0.985));
	if (generator == NOISE_RANGED)
		return clip((lattice(p) + 1.05242) * 0.48985582);
	return clip(lattice(p) + 0.5);
}

double noise_contrast(vec p, uint32_t generator)
{
	double v = noise_value(p, generator);

	return generator == NOISE_ORIGINAL ? v : clip(2 * v - 0.5);
}

double noise_turbulence(vec p, uint32_t generator, uint32_t octaves, double lambda, double omega)
{
	double sum = noise_contrast(p, generator), l = lambda, o = omega;

	for (uint32_t i = 1; i < octaves; i++, l *= lambda, o *= omega) {
		double v = noise_value(vec_scale(p, l), generator);

		sum += o * (generator == NOISE_ORIGINAL ? v : 2 * v - 0.5); /* not clipped here */
	}
	return sum;
}

vec noise_vector_turbulence(vec p, uint32_t octaves, double lambda, double omega)
{
	vec sum = noise_vector(p);
	double l = lambda, o = omega;

	for (uint32_t i = 1; i < octaves; i++, l *= lambda, o *= omega)
		sum = vec_mad(sum, noise_vector(vec_scale(p, l)), o);
	return sum;
}

struct noise_cell noise_cell_at(vec corner)
{
	uint32_t at = hash((uint32_t)whole(corner.x) & CELLS, 0);
	const uint32_t *r;

	at = hash(hash(at, (uint32_t)whole(corner.y) & CELLS), (uint32_t)whole(corner.z) & CELLS);
	r = cell_random + at;
	return (struct noise_cell){ corner, { r[0] * 0x1p-32, r[1] * 0x1p-32, r[2] * 0x1p-32 } };
}

struct noise_cell noise_cell(vec p)
{
	return noise_cell_at(vec_make(floor(p.x + EPSILON), floor(p.y + EPSILON), floor(p.z + EPSILON)));
}

/* The n-th number after a seed, of the generator behind the language's rand(). */
static uint32_t congruential(uint32_t seed, uint32_t n)
{
	while (n--)
		seed = seed * 1812433253u + 12345u;
	return seed;
}

struct noise_wave noise_wave(uint32_t i)
{
	const double *w = cell_wave + 4 * i;
	uint32_t random;

	if (i < CELL_WAVES)
		return (struct noise_wave){ { w[0], w[1], w[2] }, w[3] };
	random = congruential((uint32_t)-560851967, i + 1) >> 16 & 0x7fff;

	return (struct noise_wave){ vec_unit(noise_vector(vec_make(i, 0, 0))),
				    random * 0.000030518509476 + 0.01 };
}
