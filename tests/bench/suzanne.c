/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Blender's monkey in many triangles: Loop: Smooth Subdivision Surfaces Based on Triangles, 1987, with his rules for
 * open rims (eyes and ears of hers are open).
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "suzanne.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct edge {
	uint32_t a, b, far; /* a < b; far: the corner that is not on it */
	uint32_t at; /* 3 * triangle + which */
};

static int by_ends(const void *x, const void *y)
{
	const struct edge *e = x, *f = y;

	if (e->a != f->a)
		return e->a < f->a ? -1 : 1;
	if (e->b != f->b)
		return e->b < f->b ? -1 : 1;
	return e->at < f->at ? -1 : e->at > f->at;
}

/* The vertex on an edge of so many triangles, and what its ends get from each other. */
static void split_edge(const struct surf *s, const struct edge *e, uint32_t n, double out[3],
		       double (*sum)[3], double (*rim)[3], uint32_t *count, uint32_t *rims)
{
	const double *a = s->v[e->a], *b = s->v[e->b];

	for (unsigned k = 0; k < 3; k++) {
		out[k] = n == 2 ? 0.375 * (a[k] + b[k]) + 0.125 * (s->v[e[0].far][k] + s->v[e[1].far][k]) :
				  0.5 * (a[k] + b[k]);
		sum[e->a][k] += b[k];
		sum[e->b][k] += a[k];
		if (n != 2) {
			rim[e->a][k] += b[k];
			rim[e->b][k] += a[k];
		}
	}
	count[e->a]++, count[e->b]++;
	if (n != 2)
		rims[e->a]++, rims[e->b]++;
}

static void move_corner(double v[3], const double sum[3], const double rim[3], uint32_t count, uint32_t rims)
{
	double c = 0.375 + 0.25 * cos(6.283185307179586 / count), w = (0.625 - c * c) / count;

	for (unsigned k = 0; k < 3; k++) {
		if (!rims)
			v[k] = (1 - count * w) * v[k] + w * sum[k];
		else if (rims == 2)
			v[k] = 0.75 * v[k] + 0.125 * rim[k];
	}
}

static struct edge *edges_of(const struct surf *s)
{
	struct edge *e = malloc(3 * (size_t)s->triangles * sizeof(*e));

	for (uint32_t i = 0; i < s->triangles; i++) {
		for (unsigned k = 0; k < 3; k++) {
			uint32_t a = s->t[i][k], b = s->t[i][(k + 1) % 3];

			e[3 * i + k] = (struct edge){ a < b ? a : b, a < b ? b : a, s->t[i][(k + 2) % 3],
						      3 * i + k };
		}
	}
	qsort(e, 3 * (size_t)s->triangles, sizeof(*e), by_ends);
	return e;
}

static void refine(struct surf *s)
{
	uint32_t corners = 3 * s->triangles, old = s->vertices;
	struct edge *e = edges_of(s);
	struct surf n = { .vertices = old, .triangles = 4 * s->triangles };
	double (*sum)[3] = calloc(old, sizeof(*sum)), (*rim)[3] = calloc(old, sizeof(*rim));
	uint32_t *count = calloc(old, sizeof(*count)), *rims = calloc(old, sizeof(*rims));
	uint32_t *middle = malloc(corners * sizeof(*middle));

	n.v = malloc((old + (size_t)corners) * sizeof(*n.v));
	n.t = malloc(n.triangles * sizeof(*n.t));
	for (uint32_t i = 0, end; i < corners; i = end) {
		for (end = i; end < corners && e[end].a == e[i].a && e[end].b == e[i].b; end++)
			middle[e[end].at] = n.vertices;
		split_edge(s, &e[i], end - i, n.v[n.vertices++], sum, rim, count, rims);
	}
	for (uint32_t i = 0; i < old; i++)
		move_corner(s->v[i], sum[i], rim[i], count[i], rims[i]);
	memcpy(n.v, s->v, old * sizeof(*n.v));
	for (uint32_t i = 0; i < s->triangles; i++) {
		const uint32_t *m = &middle[3 * i];

		for (unsigned k = 0; k < 3; k++)
			memcpy(n.t[4 * i + k], (uint32_t[3]){ s->t[i][k], m[k], m[(k + 2) % 3] }, sizeof(*n.t));
		memcpy(n.t[4 * i + 3], m, sizeof(*n.t));
	}
	free(e), free(sum), free(rim), free(count), free(rims), free(middle), free(s->v), free(s->t);
	*s = n;
}

/* The next number behind *at; beyond separators that the exported file has. */
static double next_number(const char **at)
{
	char *end;
	double x;

	*at += strcspn(*at, "-0123456789.");
	x = strtod(*at, &end);
	*at = end;
	return x;
}

/* Past the word, or the end of everything. */
static const char *behind(const char *text, const char *word)
{
	const char *at = strstr(text, word);

	if (!at) {
		fprintf(stderr, "rays: no %s in %s\n", word, SUZANNE);
		exit(1);
	}
	return at + strlen(word);
}

/* The first mesh2 of the file, whose faces have their textures' numbers behind them. */
static void read_suzanne(struct surf *s)
{
	enum { MOST = 1 << 20 };
	char *text = calloc(MOST, 1);
	FILE *f = fopen(SUZANNE, "r");
	const char *at;

	if (!f || !fread(text, 1, MOST - 1, f)) {
		fprintf(stderr, "rays: can't read %s\n", SUZANNE);
		exit(1);
	}
	fclose(f);
	at = behind(behind(text, "mesh2"), "vertex_vectors");
	s->vertices = (uint32_t)next_number(&at);
	s->v = malloc(s->vertices * sizeof(*s->v));
	for (uint32_t i = 0; i < 3 * s->vertices; i++)
		(&s->v[0][0])[i] = next_number(&at);
	at = behind(at, "face_indices");
	s->triangles = (uint32_t)next_number(&at);
	s->t = malloc(s->triangles * sizeof(*s->t));
	for (uint32_t i = 0; i < s->triangles; i++) {
		for (unsigned k = 0; k < 3; k++)
			s->t[i][k] = (uint32_t)next_number(&at);
		for (unsigned k = 0; k < 3; k++)
			next_number(&at);
	}
	free(text);
}

void surf_suzanne(struct surf *s, unsigned times)
{
	read_suzanne(s);
	while (times--)
		refine(s);
}
