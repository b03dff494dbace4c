/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The bounds: coordinates relative to the reference are rounded once, as are differences of corners; a weight
 * adds six products of at most five roundings each to three of four, in five additions. Sixteen epsilons (32
 * roundoffs) of the sum of all products' sizes are more than twice that. `tiny` is for products that underflow.
 * What overflows or is not a number passes every comparison as "may be met".
 */
#include "sieve.h"

#include <float.h>
#include <stdlib.h>

enum { LEAF = 2, DEPTH = 64 };

struct node {
	double centre[3], half[3]; /* of a box that holds the true corners */
	uint32_t first, count; /* of order[]; count 0: children are first and first + 1 */
};

struct sieve {
	const struct soup *soup;
	vec reference;
	vec *corner; /* relative to it */
	double reach; /* no difference of corners is larger */
	uint32_t *order, nodes;
	struct node *node;
};

struct line {
	double d[3], m[3], tiny;
};

static double get(const vec *v, unsigned k)
{
	return (&v->x)[k];
}

static bool finite_triangle(const struct soup *s, uint32_t i)
{
	const uint32_t *t = s->triangle[i];

	return vec_finite(s->vertex[t[0]]) && vec_finite(s->vertex[t[1]]) && vec_finite(s->vertex[t[2]]);
}

static void span(const struct sieve *s, const uint32_t *id, uint32_t n, double lo[3], double hi[3])
{
	for (unsigned k = 0; k < 3; k++) {
		lo[k] = HUGE_VAL;
		hi[k] = -HUGE_VAL;
		for (uint32_t i = 0; i < 3 * n; i++) {
			double x = get(&s->corner[s->soup->triangle[id[i / 3]][i % 3]], k);

			lo[k] = fmin(lo[k], x);
			hi[k] = fmax(hi[k], x);
		}
	}
}

static double middle(const struct sieve *s, uint32_t id, unsigned k)
{
	const uint32_t *t = s->soup->triangle[id];

	return get(&s->corner[t[0]], k) / 3 + get(&s->corner[t[1]], k) / 3 + get(&s->corner[t[2]], k) / 3;
}

/* Puts the triangles before the pivot first; how many they are. */
static uint32_t part(const struct sieve *s, uint32_t *id, uint32_t n, unsigned axis, double pivot)
{
	uint32_t left = 0;

	for (uint32_t i = 0; i < n; i++) {
		uint32_t t = id[i];

		if (!(middle(s, t, axis) < pivot))
			continue;
		id[i] = id[left];
		id[left++] = t;
	}
	return left;
}

static void grow(struct sieve *s, uint32_t at, uint32_t first, uint32_t n, unsigned depth)
{
	struct node *node = &s->node[at];
	double lo[3], hi[3], sum = 0;
	uint32_t left, child;
	unsigned axis = 0;

	span(s, s->order + first, n, lo, hi);
	for (unsigned k = 0; k < 3; k++) {
		double largest = fmax(fabs(lo[k]), fabs(hi[k]));

		node->centre[k] = lo[k] / 2 + hi[k] / 2;
		node->half[k] = fmax(hi[k] - node->centre[k], node->centre[k] - lo[k]) +
				4 * DBL_EPSILON * largest + DBL_MIN;
		if (hi[k] - lo[k] > hi[axis] - lo[axis])
			axis = k;
	}
	node->first = first;
	node->count = n;
	if (n <= LEAF || depth == DEPTH)
		return;
	for (uint32_t i = 0; i < n; i++)
		sum += middle(s, s->order[first + i], axis) / n;
	left = part(s, s->order + first, n, axis, sum);
	if (left == 0 || left == n)
		left = n / 2;
	child = s->nodes;
	s->nodes += 2;
	node->first = child;
	node->count = 0;
	grow(s, child, first, left, depth + 1);
	grow(s, child + 1, first + left, n - left, depth + 1);
}

/* The middle of the mesh if that is far from where coordinates begin: then it saves digits. */
static vec choose_reference(const struct soup *s)
{
	vec lo = { HUGE_VAL, HUGE_VAL, HUGE_VAL }, hi = vec_neg(lo), c;

	for (uint32_t i = 0; i < s->vertices; i++) {
		vec v = s->vertex[i];

		if (!vec_finite(v))
			continue;
		lo = vec_make(fmin(lo.x, v.x), fmin(lo.y, v.y), fmin(lo.z, v.z));
		hi = vec_make(fmax(hi.x, v.x), fmax(hi.y, v.y), fmax(hi.z, v.z));
	}
	c = vec_add(vec_scale(lo, 0.5), vec_scale(hi, 0.5));
	return vec_length(c) > 4 * vec_length(vec_sub(hi, lo)) ? c : vec_make(0, 0, 0);
}

struct sieve *sieve_new(const struct soup *soup)
{
	struct sieve *s = calloc(1, sizeof(*s));
	uint32_t n = 0;

	s->soup = soup;
	s->reference = choose_reference(soup);
	s->corner = calloc(soup->vertices + 1, sizeof(*s->corner));
	s->order = calloc(soup->triangles + 1, sizeof(*s->order));
	s->node = calloc(2 * (size_t)soup->triangles + 1, sizeof(*s->node));
	for (uint32_t i = 0; i < soup->vertices; i++) {
		s->corner[i] = vec_sub(soup->vertex[i], s->reference);
		for (unsigned k = 0; k < 3 && vec_finite(soup->vertex[i]); k++)
			s->reach = fmax(s->reach, 4 * fabs(get(&s->corner[i], k)));
	}
	for (uint32_t i = 0; i < soup->triangles; i++) {
		if (finite_triangle(soup, i))
			s->order[n++] = i;
	}
	if (n) {
		s->nodes = 1;
		grow(s, 0, 0, n, 0);
	}
	return s;
}

void sieve_free(struct sieve *s)
{
	free(s->corner);
	free(s->order);
	free(s->node);
	free(s);
}

vec sieve_reference(const struct sieve *s)
{
	return s->reference;
}

static bool misses_box(const struct line *l, const struct node *n)
{
	for (unsigned k = 0; k < 3; k++) {
		unsigned i = k == 2 ? 0 : k + 1, j = i == 2 ? 0 : i + 1;
		double di = fabs(l->d[i]), dj = fabs(l->d[j]);
		double f = l->d[i] * n->centre[j] - l->d[j] * n->centre[i] + l->m[k];
		double reach = di * n->half[j] + dj * n->half[i];
		double size = di * fabs(n->centre[j]) + dj * fabs(n->centre[i]) + fabs(l->m[k]) + reach;

		if (fabs(f) > reach + 16 * DBL_EPSILON * size + l->tiny)
			return true;
	}
	return false;
}

/* Two weights, each off 0 by more than it can be wrong, differ in sign. */
static bool misses_triangle(const struct sieve *s, const struct line *l, uint32_t id)
{
	const uint32_t *t = s->soup->triangle[id];
	bool pos = false, neg = false;

	for (unsigned e = 0; e < 3; e++) {
		uint32_t a = t[e], b = t[e == 2 ? 0 : e + 1];
		const vec *p = &s->corner[a], *q = &s->corner[b];
		double w = 0, size = 0;

		for (unsigned k = 0; k < 3; k++) {
			unsigned i = k == 2 ? 0 : k + 1, j = i == 2 ? 0 : i + 1;
			double x = get(p, i) * get(q, j), y = get(p, j) * get(q, i);
			double z = l->m[k] * (get(&s->soup->vertex[b], k) - get(&s->soup->vertex[a], k));

			w += l->d[k] * (x - y) + z;
			size += fabs(l->d[k]) * (fabs(x) + fabs(y)) + fabs(z);
		}
		size = 16 * DBL_EPSILON * size + l->tiny;
		pos |= w > size;
		neg |= w < -size;
	}
	return pos && neg;
}

static uint32_t insert(uint32_t *id, uint32_t n, uint32_t new)
{
	uint32_t i = n;

	for (; i > 0 && id[i - 1] > new; i--)
		id[i] = id[i - 1];
	id[i] = new;
	return n + 1;
}

uint32_t sieve_line(const struct sieve *s, vec d, vec m, uint32_t *id)
{
	struct line l = { { d.x, d.y, d.z }, { m.x, m.y, m.z }, 0 };
	uint32_t stack[2 * DEPTH + 2], deep = 0, n = 0;

	l.tiny = 64 * DBL_MIN * (1 + fabs(d.x) + fabs(d.y) + fabs(d.z) + s->reach);
	if (s->nodes)
		stack[deep++] = 0;
	while (deep) {
		const struct node *node = &s->node[stack[--deep]];

		if (misses_box(&l, node))
			continue;
		if (!node->count) {
			stack[deep++] = node->first + 1;
			stack[deep++] = node->first;
			continue;
		}
		for (uint32_t i = 0; i < node->count; i++) {
			if (!misses_triangle(s, &l, s->order[node->first + i]))
				n = insert(id, n, s->order[node->first + i]);
		}
	}
	return n;
}
