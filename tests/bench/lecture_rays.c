/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The lecture's rays without the rest of a renderer: one through each pixel of 512 x 512, against its torus of
 * 3,072 triangles; no test. What a structure gains is told as a ratio to plain brute force: one ray with one
 * triangle after another (Moeller, Trumbore: Fast, Minimum Storage Ray/Triangle Intersection, 1997), which
 * gives up as early as it can. All get the same rays in rounds, in one process and on one thread; times are
 * medians of the rounds, ratios medians of each round's.
 *
 *	lecture_rays [-n ROUNDS] [-k camera|lamp|any] [-o] [ACCEL ..]	(-o: only these; ratios to the first)
 *
 * lamp: lines from all over the place to one point; any: of no common point. Both for the nearest hit.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "../unit/rays.h"
#include "accel/load.h"

enum { SIZE = 512, RAYS = SIZE * SIZE, BATCH = 1024, ENGINES = 64, ROUNDS = 64 };

struct engine {
	const char *name;
	struct accel_choice choice;
	ald_accel *it; /* NULL: plain brute force */
	ald_query q;
	uint64_t count[ALD_COUNT_MAX], hits;
	double build, bytes;
	double seconds[ROUNDS];
};

struct triangle {
	float a[3], e[3], g[3];
};

struct bench {
	struct mesh mesh;
	struct test_host host;
	struct engine engine[ENGINES];
	uint32_t engines, rounds, hints;
	struct triangle *triangle;
	ald_ray *ray, *batch;
	ald_hit *hit;
};

static double now(void)
{
	struct timespec t;

	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- the scene ---- */

static void turn(ald_vec *v, unsigned axis, double angle)
{
	double *p = &v->x, c = cos(angle), s = sin(angle);
	unsigned i = (axis + 1) % 3, j = (axis + 2) % 3;
	double x = p[i] * c - p[j] * s, y = p[i] * s + p[j] * c;

	p[i] = x;
	p[j] = y;
}

/* As scenes/lecture has it. */
static void make_mesh(struct bench *b)
{
	struct mesh *m = &b->mesh;

	mesh_torus(m, (ald_vec){ 0, 0, 0 }, 1, 0.36, 64, 24);
	for (uint32_t i = 0; i < m->vertices; i++) {
		turn(&m->vertex[i], 0, 0.5);
		turn(&m->vertex[i], 1, -0.35);
		turn(&m->vertex[i], 2, 0.2);
	}
	mesh_finish(m, false, false, false);
	b->triangle = malloc(m->prims.count * sizeof(*b->triangle));
	for (uint32_t i = 0; i < m->prims.count; i++) {
		ald_vec v[3];

		ald_corners(&m->prims, i, 0, v);
		for (unsigned k = 0; k < 3; k++) {
			b->triangle[i].a[k] = (float)ald_get(&v[0], k);
			b->triangle[i].e[k] = (float)(ald_get(&v[1], k) - ald_get(&v[0], k));
			b->triangle[i].g[k] = (float)(ald_get(&v[2], k) - ald_get(&v[0], k));
		}
	}
}

static ald_vec towards(ald_vec from, ald_vec to)
{
	return (ald_vec){ to.x - from.x, to.y - from.y, to.z - from.z };
}

/* In tiles of 32 x 32 pixels, as the renderer has them. */
static void make_rays(struct bench *b, const char *kind)
{
	ald_vec eye = { 0, -9.78, 2.25 }, lamp = { 4, -6, 6 };
	double length = sqrt(9.78 * 9.78 + 2.25 * 2.25), wide = 18.0 / 50;
	ald_vec z = { 0, 9.78 / length, -2.25 / length }, y = { 0, 2.25 / length, 9.78 / length };
	uint64_t seed = 1;
	uint32_t n = 0;

	for (uint32_t at = 0; at < RAYS; at++) {
		uint32_t tile = at / BATCH, in = at % BATCH;
		uint32_t px = tile % (SIZE / 32) * 32 + in % 32, py = tile / (SIZE / 32) * 32 + in / 32;
		double u = ((px + 0.5) / SIZE * 2 - 1) * wide, v = (1 - (py + 0.5) / SIZE * 2) * wide;
		bool camera = kind[0] == 'c';
		ald_vec o = eye, d = { u, z.y + v * y.y, z.z + v * y.z };

		if (!camera) {
			double *p = &o.x;

			for (unsigned k = 0; k < 3; k++)
				p[k] = 4 * random_unit(&seed) - 2;
			d = (ald_vec){ random_unit(&seed) - 0.5, random_unit(&seed) - 0.5, random_unit(&seed) - 0.5 };
		}
		if (kind[0] == 'l')
			d = towards(o, lamp);
		b->ray[n++] = (ald_ray){ .org = o, .dir = d, .tmax = 1e30, .mask = UINT32_MAX, .skip = ALD_NONE,
					 .after = ALD_NONE };
	}
	b->hints = strcmp(kind, "camera") ? 0 : ALD_COHERENT | ALD_ONE_ORIGIN;
}

/* ---- plain brute force ---- */

static float dot(const float a[3], const float b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const float a[3], const float b[3], float out[3])
{
	out[0] = a[1] * b[2] - a[2] * b[1];
	out[1] = a[2] * b[0] - a[0] * b[2];
	out[2] = a[0] * b[1] - a[1] * b[0];
}

static void plain_ray(const struct triangle *t, uint32_t n, const ald_ray *r, ald_hit *hit)
{
	float o[3] = { (float)r->org.x, (float)r->org.y, (float)r->org.z };
	float d[3] = { (float)r->dir.x, (float)r->dir.y, (float)r->dir.z }, best = (float)r->tmax;

	for (uint32_t i = 0; i < n; i++, t++) {
		float p[3], q[3], s[3] = { o[0] - t->a[0], o[1] - t->a[1], o[2] - t->a[2] }, det, inverse, u, v, far;

		cross(d, t->g, p);
		det = dot(t->e, p);
		if (det == 0)
			continue;
		inverse = 1 / det;
		u = dot(s, p) * inverse;
		if (u < 0 || u > 1)
			continue;
		cross(s, t->e, q);
		v = dot(d, q) * inverse;
		if (v < 0 || u + v > 1)
			continue;
		far = dot(t->g, q) * inverse;
		if (far <= 0 || far >= best)
			continue;
		best = far;
		*hit = (ald_hit){ .t = (double)far, .u = (double)u, .v = (double)v, .prim = i };
	}
}

/* ---- engines ---- */

static bool open_engine(struct bench *b, struct engine *e, const char *name)
{
	struct diag d = { 0 };
	ald_error err = { "" };
	double start;

	e->name = name;
	if (!strcmp(name, "plain"))
		return true;
	if (accel_load(&e->choice, name, &d) != STATUS_OK) {
		fprintf(stderr, "lecture_rays: no accelerator %s\n", name);
		return false;
	}
	start = now();
	if (e->choice.plugin->build(&b->host.host, &b->mesh.prims, e->choice.value, &e->it, &err)) {
		fprintf(stderr, "lecture_rays: %s: %s\n", name, err.text);
		return false;
	}
	e->build = now() - start;
	if (e->choice.plugin->scratch_size)
		e->q.scratch = mem_zalloc(&b->host.book, "scratch", e->choice.plugin->scratch_size(e->it));
	for (uint32_t i = 0; e->choice.plugin->stat; i++) {
		const char *what;
		double value;

		if (!e->choice.plugin->stat(e->it, i, &what, &value))
			break;
		if (!strcmp(what, "memory"))
			e->bytes = value;
	}
	return true;
}

static void close_engine(struct engine *e)
{
	if (!e->it)
		return;
	e->choice.plugin->destroy(e->it);
	mem_free(e->q.scratch);
	accel_unload(&e->choice);
}

/* Returns the seconds. A batch has just been made when it is traced, as in a renderer; this is not timed. */
static double fire(struct bench *b, struct engine *e)
{
	double took = 0, start;

	e->hits = 0;
	for (uint32_t at = 0; at < RAYS; at += BATCH) {
		memcpy(b->batch, b->ray + at, BATCH * sizeof(*b->ray));
		for (uint32_t i = 0; i < BATCH; i++) {
			b->hit[i].t = b->batch[i].tmax;
			b->hit[i].prim = ALD_NONE;
		}
		start = now();
		if (e->it)
			e->choice.plugin->intersect_n(e->it, &e->q, b->batch, b->hit, BATCH, b->hints);
		else
			for (uint32_t i = 0; i < BATCH; i++)
				plain_ray(b->triangle, b->mesh.prims.count, &b->batch[i], &b->hit[i]);
		took += now() - start;
		for (uint32_t i = 0; i < BATCH; i++)
			e->hits += b->hit[i].prim != ALD_NONE;
	}
	return took;
}

/* So often that the clock is no matter. */
static void time_round(struct bench *b, struct engine *e, uint32_t round)
{
	double took = 0;
	uint32_t n = 0;

	for (; took < 0.03; n++)
		took += fire(b, e);
	e->seconds[round] = took / n;
}

static void count(struct bench *b, struct engine *e)
{
	if (!e->it)
		return;
	e->q.count = e->count;
	fire(b, e);
	e->q.count = NULL;
}

static int by_size(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;

	return (x > y) - (x < y);
}

static double median(const double *x, uint32_t n)
{
	double v[ROUNDS];

	memcpy(v, x, n * sizeof(*v));
	qsort(v, n, sizeof(*v), by_size);
	return n % 2 ? v[n / 2] : (v[n / 2 - 1] + v[n / 2]) / 2;
}

static void report(const struct bench *b)
{
	double tests = (double)RAYS * b->mesh.prims.count;

	printf("%-40s %9s %9s %9s %9s %8s %8s %8s %8s %9s\n", "accelerator", "build ms", "KiB", "ms", "ratio",
	       "tests", "nodes", "volumes", "hits", "Gtests/s");
	for (uint32_t i = 0; i < b->engines; i++) {
		const struct engine *e = &b->engine[i];
		double ratio[ROUNDS], seconds = median(e->seconds, b->rounds);
		double prims = e->it ? (double)e->count[ALD_COUNT_PRIMS] : tests;

		for (uint32_t r = 0; r < b->rounds; r++)
			ratio[r] = b->engine[0].seconds[r] / e->seconds[r];
		printf("%-40s %9.2f %9.0f %9.3f %9.2f %8.1f %8.2f %8.2f %8llu %9.3f\n", e->name, e->build * 1e3,
		       e->bytes / 1024, seconds * 1e3, median(ratio, b->rounds), prims / RAYS,
		       (double)e->count[ALD_COUNT_NODES] / RAYS, (double)e->count[ALD_COUNT_VOLUME_TESTS] / RAYS,
		       (unsigned long long)e->hits, prims / seconds * 1e-9);
	}
}

int main(int argc, char **argv)
{
	static char *usual[] = { "none", "sphere", "box", "octree", "bvh8" };
	struct bench *b = calloc(1, sizeof(*b));
	const char *kind = "camera";
	int c, names = 5, status = 0, only = 0;
	char **name = usual;

	b->rounds = 5;
	while ((c = getopt(argc, argv, "n:k:o")) != -1) {
		if (c == 'n')
			b->rounds = (uint32_t)atoi(optarg);
		else if (c == 'k')
			kind = optarg;
		else if (c == 'o')
			only = 1;
		else
			return 2;
	}
	if (b->rounds < 1 || b->rounds > ROUNDS ||
	    (strcmp(kind, "camera") && strcmp(kind, "lamp") && strcmp(kind, "any")))
		return 2;
	if (optind < argc) {
		name = argv + optind;
		names = argc - optind;
	}
	b->ray = malloc(RAYS * sizeof(*b->ray));
	b->batch = malloc(BATCH * sizeof(*b->batch));
	b->hit = calloc(BATCH, sizeof(*b->hit));
	make_mesh(b);
	make_rays(b, kind);
	test_host_init(&b->host, 1, 0);
	if (!only)
		open_engine(b, &b->engine[b->engines++], "plain");
	for (int i = 0; i < names && b->engines < ENGINES && !status; i++)
		status = !open_engine(b, &b->engine[b->engines++], name[i]);
	for (uint32_t r = 0; r < b->rounds && !status; r++) {
		for (uint32_t i = 0; i < b->engines; i++)
			time_round(b, &b->engine[(i + r) % b->engines], r);
	}
	for (uint32_t i = 0; i < b->engines && !status; i++)
		count(b, &b->engine[i]);
	if (!status)
		report(b);
	for (uint32_t i = 0; i < b->engines; i++)
		close_engine(&b->engine[i]);
	test_host_release(&b->host);
	mesh_release(&b->mesh);
	return status;
}
