/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Patterns of blocks (manual 3.4.7.1): the number of the entry that fills space or the plane at a point.
 */
#include "pattern/family.h"

#define TINY 1e-10 /* points this far below a border count as on it, as in POV-Ray */
#define ROOT3 1.7320508075688772935

static double part(double x) /* of a unit */
{
	return x - floor(x);
}

double block_checker(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	double n = floor(at->p.x + TINY) + floor(at->p.y + TINY) + floor(at->p.z + TINY);

	(void)s;
	(void)q;
	return fmod(n, 2) != 0;
}

/* Rows of bricks along y, every other one shifted by half a brick along x and z; 0 is mortar. */
double block_brick(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	double mortar = q->of.brick.mortar;
	vec size = q->of.brick.size;
	double x = (at->p.x + mortar + TINY) / size.x, y = (at->p.y + mortar + TINY) / size.y;
	double z = (at->p.z + mortar + TINY) / size.z;
	bool shifted = part(y * 0.5) > 0.5;

	(void)s;
	if (part(y) <= mortar / size.y)
		return 0;
	if (part(shifted ? x + 0.5 : x) <= mortar / size.x)
		return 0;
	return part(shifted ? z : z + 0.5) > mortar / size.z;
}

/* Which of the six axes is the nearest: x, y, z, -x, -y, -z. */
double block_cubic(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	double x = at->p.x, y = at->p.y, z = at->p.z, ax = fabs(x), ay = fabs(y), az = fabs(z);

	(void)s;
	(void)q;
	if (x >= 0 && ax >= ay && ax >= az)
		return 0;
	if (y >= 0 && ay >= ax && ay >= az)
		return 1;
	if (z >= 0 && az >= ax && az >= ay)
		return 2;
	if (x < 0 && ax >= ay && ax >= az)
		return 3;
	return y < 0 && ay >= ax && ay >= az ? 4 : 5;
}

/* In a grid of 6 x 6 half triangles, columns 1 and 4 are cut by the hexagons' slanting edges. POV-Ray
 * mirrors the plane at x = 0. */
double block_hexagon(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	static const unsigned char outer[6] = { 0, 1, 1, 2, 2, 0 }, middle[6] = { 2, 2, 0, 0, 1, 1 };
	static const unsigned char below[6] = { 0, 2, 1, 0, 2, 1 }, above[6] = { 2, 1, 0, 2, 1, 0 };
	const double height = 0.866025404; /* of a triangle, in POV-Ray's digits */
	double x = fabs(at->p.x) / 0.5, z = at->p.z < 0 ? 5.196152424 - fabs(at->p.z) : at->p.z;
	int column, row;

	(void)s;
	(void)q;
	z /= height;
	x -= floor(x / 6) * 6;
	z -= floor(z / 6) * 6;
	column = (int)floor(x) % 6;
	row = (int)floor(z) % 6;
	if (column == 0 || column == 5)
		return outer[row];
	if (column == 2 || column == 3)
		return middle[row];
	x -= column;
	z -= row;
	if ((column + row) % 2)
		x = 1 - x;
	return x != 0 && z / x < 1 ? below[row] : above[row];
}

double block_square(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	bool x = fmod(floor(at->p.x), 2) != 0, z = fmod(floor(at->p.z), 2) != 0;

	(void)s;
	(void)q;
	return x ? (z ? 2 : 3) : z;
}

/* Six triangles around each corner of the lattice. */
double block_triangular(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	double x = at->p.x - 3 * floor(at->p.x / 3), z = at->p.z - ROOT3 * floor(at->p.z / ROOT3);
	int column = (int)floor(x), n = 1;
	bool upper = z >= ROOT3 / 2;

	(void)s;
	(void)q;
	x -= column;
	if (upper)
		z = ROOT3 - z;
	if (x != 0) {
		bool left = z / x < ROOT3, right = z / (1 - x) < ROOT3;

		n = left ? (right ? 0 : 3) : 1;
	}
	n = (n & 1 ? n + 2 * column : 6 + n - 2 * column) % 6;
	return upper ? 5 - n : n;
}
