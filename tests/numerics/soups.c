/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "soups.h"

#include <stdlib.h>
#include <string.h>

#include "base/rng.h"

#define PI 3.14159265358979323846

double random_unit(uint64_t *seed)
{
	return rng_unit(*seed += 0x9e3779b97f4a7c15u); /* splitmix64 */
}

double random_signed(uint64_t *seed)
{
	return 2 * random_unit(seed) - 1;
}

uint32_t random_below(uint64_t *seed, uint32_t n)
{
	return (uint32_t)(random_unit(seed) * n);
}

vec random_direction(uint64_t *seed)
{
	vec v;
	double l;

	do {
		v = vec_make(random_signed(seed), random_signed(seed), random_signed(seed));
		l = vec_length(v);
	} while (l > 1 || l < 0.01);
	return vec_scale(v, 1 / l);
}

double as_float(double x)
{
	int e;
	double m = frexp(x, &e);

	return ldexp(rint(ldexp(m, 24)), e - 24);
}

static uint32_t add_vertex(struct soup *s, vec v)
{
	if (s->vertices == s->vertex_room) {
		s->vertex_room = 2 * s->vertex_room + 1024;
		s->vertex = realloc(s->vertex, s->vertex_room * sizeof(*s->vertex));
	}
	s->vertex[s->vertices] = v;
	return s->vertices++;
}

static void add_triangle(struct soup *s, uint32_t a, uint32_t b, uint32_t c)
{
	if (s->triangles == s->triangle_room) {
		s->triangle_room = 2 * s->triangle_room + 1024;
		s->triangle = realloc(s->triangle, s->triangle_room * sizeof(*s->triangle));
	}
	memcpy(s->triangle[s->triangles++], (uint32_t[3]){ a, b, c }, sizeof(*s->triangle));
}

void soup_triangle(struct soup *s, vec a, vec b, vec c)
{
	uint32_t i = add_vertex(s, a), j = add_vertex(s, b);

	add_triangle(s, i, j, add_vertex(s, c));
}

/* The vertex of s, from first on, that equals v, or a new one. */
static uint32_t shared_vertex(struct soup *s, uint32_t first, vec v)
{
	for (uint32_t i = first; i < s->vertices; i++) {
		if (s->vertex[i].x == v.x && s->vertex[i].y == v.y && s->vertex[i].z == v.z)
			return i;
	}
	return add_vertex(s, v);
}

static void split(struct soup *s, uint32_t first, vec a, vec b, vec c, unsigned depth)
{
	vec ab = vec_unit(vec_add(a, b)), bc = vec_unit(vec_add(b, c)), ca = vec_unit(vec_add(c, a));

	if (!depth) {
		uint32_t i = shared_vertex(s, first, a), j = shared_vertex(s, first, b);

		add_triangle(s, i, j, shared_vertex(s, first, c));
		return;
	}
	split(s, first, a, ab, ca, depth - 1);
	split(s, first, ab, b, bc, depth - 1);
	split(s, first, ca, bc, c, depth - 1);
	split(s, first, ab, bc, ca, depth - 1);
}

void soup_bumpy(struct soup *s, double bump, uint64_t *seed)
{
	static const double g = 1.6180339887498949;
	static const unsigned char face[20][3] = {
		{ 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 }, { 0, 10, 11 }, { 1, 5, 9 }, { 5, 11, 4 },
		{ 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 }, { 3, 4, 2 }, { 3, 2, 6 }, { 3, 6, 8 },
		{ 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 }, { 8, 6, 7 }, { 9, 8, 1 },
	};
	const double v[12][3] = {
		{ -1, g, 0 }, { 1, g, 0 }, { -1, -g, 0 }, { 1, -g, 0 }, { 0, -1, g }, { 0, 1, g },
		{ 0, -1, -g }, { 0, 1, -g }, { g, 0, -1 }, { g, 0, 1 }, { -g, 0, -1 }, { -g, 0, 1 },
	};
	uint32_t first = s->vertices;
	vec p[12];

	for (unsigned i = 0; i < 12; i++)
		p[i] = vec_unit(vec_make(v[i][0], v[i][1], v[i][2]));
	for (unsigned i = 0; i < 20; i++)
		split(s, first, p[face[i][0]], p[face[i][1]], p[face[i][2]], 3);
	for (uint32_t i = first; i < s->vertices; i++)
		s->vertex[i] = vec_scale(s->vertex[i], 1 + bump * random_signed(seed));
}

void soup_uv(struct soup *s)
{
	enum { RINGS = 24, SEGMENTS = 48 };
	uint32_t top = add_vertex(s, vec_make(0, 1, 0)), bottom = add_vertex(s, vec_make(0, -1, 0));
	uint32_t ring = s->vertices;

	for (unsigned i = 1; i < RINGS; i++) {
		for (unsigned k = 0; k < SEGMENTS; k++) {
			double a = PI * i / RINGS, b = 2 * PI * k / SEGMENTS;

			add_vertex(s, vec_make(sin(a) * cos(b), cos(a), sin(a) * sin(b)));
		}
	}
	for (unsigned k = 0; k < SEGMENTS; k++) {
		unsigned l = (k + 1) % SEGMENTS;
		uint32_t last = ring + (RINGS - 2) * SEGMENTS;

		add_triangle(s, top, ring + l, ring + k);
		for (uint32_t i = ring; i < last; i += SEGMENTS) {
			add_triangle(s, i + k, i + l, i + SEGMENTS + l);
			add_triangle(s, i + k, i + SEGMENTS + l, i + SEGMENTS + k);
		}
		add_triangle(s, bottom, last + k, last + l);
	}
}

void soup_box(struct soup *s)
{
	enum { N = 8 };
	uint32_t first = s->vertices;

	for (unsigned f = 0; f < 6; f++) {
		unsigned axis = f / 2, x = (axis + 1) % 3, y = (axis + 2) % 3;

		for (unsigned i = 0; i < N; i++) {
			for (unsigned j = 0; j < N; j++) {
				uint32_t q[4];

				for (unsigned c = 0; c < 4; c++) {
					vec v = { 0, 0, 0 };

					(&v.x)[axis] = f & 1 ? 1 : -1;
					(&v.x)[x] = 2.0 * (i + (c == 1 || c == 2)) / N - 1;
					(&v.x)[y] = 2.0 * (j + (c >= 2)) / N - 1;
					q[c] = shared_vertex(s, first, v);
				}
				add_triangle(s, q[0], q[1], q[2]);
				add_triangle(s, q[0], q[2], q[3]);
			}
		}
	}
}

void soup_sheets(struct soup *s, double height, double gap)
{
	enum { N = 24 };

	for (unsigned sheet = 0; sheet < 2; sheet++) {
		uint32_t first = s->vertices;

		for (unsigned i = 0; i <= N; i++) {
			for (unsigned j = 0; j <= N; j++)
				add_vertex(s, vec_make(2.0 * i / N - 1, 2.0 * j / N - 1,
						       sheet ? height + gap : height));
		}
		for (unsigned i = 0; i < N; i++) {
			for (unsigned j = 0; j < N; j++) {
				uint32_t a = first + i * (N + 1) + j, b = a + N + 1;

				add_triangle(s, a, b, b + 1);
				add_triangle(s, a, b + 1, a + 1);
			}
		}
	}
}

void soup_needles(struct soup *s, uint32_t n, double aspect, uint64_t *seed)
{
	while (n--) {
		vec a = vec_scale(random_direction(seed), random_unit(seed)), d = random_direction(seed);
		vec side = vec_scale(random_direction(seed), 1 / aspect);

		soup_triangle(s, a, vec_add(a, d), vec_add(vec_mad(a, d, random_unit(seed)), side));
	}
}

void soup_degenerates(struct soup *s)
{
	uint32_t n = s->triangles;

	for (uint32_t i = 0; i < n; i++) {
		uint32_t a = s->triangle[i][0], b = s->triangle[i][1], c = s->triangle[i][2];

		add_triangle(s, a, a, b);
		add_triangle(s, a, b, b);
		add_triangle(s, c, c, c);
		add_triangle(s, a, add_vertex(s, s->vertex[a]), b);
	}
}

void soup_turn(struct soup *s, const struct mat *m)
{
	for (uint32_t i = 0; i < s->vertices; i++)
		s->vertex[i] = mat_point(m, s->vertex[i]);
}

void soup_stretch(struct soup *s, vec by)
{
	for (uint32_t i = 0; i < s->vertices; i++) {
		s->vertex[i].x *= by.x;
		s->vertex[i].y *= by.y;
		s->vertex[i].z *= by.z;
	}
}

void soup_place(struct soup *s, double scale, vec offset, bool floats)
{
	for (uint32_t i = 0; i < s->vertices; i++) {
		for (unsigned k = 0; k < 3; k++) {
			double *x = &s->vertex[i].x + k;

			*x *= scale;
			if (floats)
				*x = as_float(*x);
			*x += (&offset.x)[k];
			if (floats)
				*x = as_float(*x);
		}
	}
}

void soup_release(struct soup *s)
{
	free(s->vertex);
	free(s->triangle);
	*s = (struct soup){ 0 };
}

static void soup_extent(const struct soup *s, vec *lo, vec *hi)
{
	*lo = vec_make(HUGE_VAL, HUGE_VAL, HUGE_VAL);
	*hi = vec_neg(*lo);
	for (uint32_t i = 0; i < s->vertices; i++) {
		vec v = s->vertex[i];

		if (!vec_finite(v))
			continue;
		*lo = vec_make(fmin(lo->x, v.x), fmin(lo->y, v.y), fmin(lo->z, v.z));
		*hi = vec_make(fmax(hi->x, v.x), fmax(hi->y, v.y), fmax(hi->z, v.z));
	}
}

double soup_diameter(const struct soup *s)
{
	vec lo, hi;

	soup_extent(s, &lo, &hi);
	return vec_length(vec_sub(hi, lo));
}

double soup_largest(const struct soup *s)
{
	vec lo, hi;

	soup_extent(s, &lo, &hi);
	lo = vec_make(fmax(fabs(lo.x), fabs(hi.x)), fmax(fabs(lo.y), fabs(hi.y)), fmax(fabs(lo.z), fabs(hi.z)));
	return fmax(lo.x, fmax(lo.y, lo.z));
}
