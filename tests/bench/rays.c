/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Rays a second, by kind of ray, mesh and accelerator; no test. All accelerators get the same rays in
 * rounds, one after another, in one process; what is printed are medians of the rounds, of CPU time of the
 * one thread, and ratios of each round to the first accelerator's.
 *
 *	rays [-c] [-n ROUNDS] [-s WIDTH] [-m MESH,..] [-t THREADS] [-b BUILDS] [ACCEL ..]	(-c: counters, too)
 *
 * Kinds: camera (32x32 tiles), shadow (one a hit, to a point), bounce (cosine, one a hit), shuffled (the same
 * in no order), ao (short, one a hit). An accelerator is as alidade -a has it, or, if Embree was found when
 * this was built: embree1, embree8, embree16, Embree's own calls without any of Alidade. With @exact or @fast
 * behind it, it is asked for that precision, and in exact order what the host has to do is done too.
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
#include "peers.h"

enum { CAMERA, SHADOW, BOUNCE, SHUFFLED, AO, KINDS };
static const char *const kind_name[] = { "camera", "shadow", "bounce", "shuffled", "ao" };
enum { BATCH = 1024, ENGINES = 16, ROUNDS = 64 };

struct engine {
	const char *name;
	struct accel_choice choice;
	uint32_t precision;
	ald_accel *it; /* NULL: a peer */
	ald_query q;
	struct peer *peer;
	double build, bytes; /* build: seconds by the clock, the median */
	double seconds[KINDS][ROUNDS];
	uint64_t sum[KINDS]; /* hits, for the eye */
};

struct bench {
	struct mesh mesh;
	struct test_host host;
	struct engine engine[ENGINES];
	uint32_t engines, rounds, width, height, threads, counts, builds;
	ald_ray *ray[KINDS];
	uint32_t n[KINDS];
	ald_hit *hit;
	uint8_t *hidden;
};

static double cpu_now(void)
{
	struct timespec t;

	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- meshes ---- */

static void add_box(struct mesh *m, const ald_vec *c, ald_vec axis[3])
{
	static const uint8_t side[12][3] = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 },
					     { 0, 1, 4 }, { 1, 5, 4 }, { 2, 6, 3 }, { 3, 6, 7 },
					     { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
	uint32_t first = m->vertices;

	for (unsigned i = 0; i < 8; i++) {
		double s[3] = { i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1 };

		mesh_vertex(m, c->x + s[0] * axis[0].x + s[1] * axis[1].x + s[2] * axis[2].x,
			    c->y + s[0] * axis[0].y + s[1] * axis[1].y + s[2] * axis[2].y,
			    c->z + s[0] * axis[0].z + s[1] * axis[1].z + s[2] * axis[2].z);
	}
	for (unsigned i = 0; i < 12; i++)
		mesh_triangle(m, first + side[i][0], first + side[i][1], first + side[i][2]);
}

static ald_vec cross(ald_vec a, ald_vec b)
{
	return (ald_vec){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static ald_vec unit(ald_vec a)
{
	double s = 1 / sqrt(a.x * a.x + a.y * a.y + a.z * a.z);

	return (ald_vec){ a.x * s, a.y * s, a.z * s };
}

static ald_vec any_way(uint64_t *seed)
{
	for (;;) {
		ald_vec v = { 2 * random_unit(seed) - 1, 2 * random_unit(seed) - 1,
			      2 * random_unit(seed) - 1 };
		double d = v.x * v.x + v.y * v.y + v.z * v.z;

		if (d > 0.01 && d < 1)
			return unit(v);
	}
}

static ald_vec times(ald_vec a, double s)
{
	return (ald_vec){ a.x * s, a.y * s, a.z * s };
}

/* Long thin boxes in a room. */
static void mesh_beams(struct mesh *m, uint32_t n, double least, double more)
{
	uint64_t seed = 5;
	ald_vec room[3] = { { 1.2, 0, 0 }, { 0, 1.2, 0 }, { 0, 0, 1.2 } }, middle = { 0, 0, 0 };

	mesh_group(m);
	add_box(m, &middle, room);
	for (uint32_t i = 0; i < n; i++) {
		ald_vec c = { 2 * random_unit(&seed) - 1, 2 * random_unit(&seed) - 1,
			      2 * random_unit(&seed) - 1 };
		ald_vec x = any_way(&seed), y = unit(cross(x, any_way(&seed))), z = cross(x, y);
		ald_vec axis[3] = { times(x, least + more * random_unit(&seed)), times(y, 0.001), times(z, 0.001) };

		add_box(m, &c, axis);
	}
}

/* A bumpy ball of 2 n n triangles on a stage. */
static void mesh_statue(struct mesh *m, uint32_t n)
{
	uint32_t first = m->vertices;
	ald_vec stage[3] = { { 6, 0, 0 }, { 0, 6, 0 }, { 0, 0, 0.1 } }, below = { 0, 0, -1.3 };

	mesh_group(m);
	add_box(m, &below, stage);
	first = m->vertices;
	for (uint32_t i = 0; i <= n; i++) {
		for (uint32_t j = 0; j < n; j++) {
			double a = 6.283185307179586 * j / n, b = 3.141592653589793 * (i + 0.5) / (n + 1);
			double r = 1 + 0.1 * sin(5 * a) * sin(7 * b) + 0.03 * sin(31 * a + 3) * sin(23 * b) +
				   0.01 * sin(97 * a) * sin(83 * b + 1);

			mesh_vertex(m, r * cos(a) * sin(b), r * sin(a) * sin(b), r * cos(b));
		}
	}
	for (uint32_t i = 0; i < n; i++) {
		for (uint32_t j = 0; j < n; j++) {
			uint32_t k = (j + 1) % n, at = first + i * n;

			mesh_triangle(m, at + j, at + n + j, at + n + k);
			mesh_triangle(m, at + j, at + n + k, at + k);
		}
	}
}

static bool make_mesh(struct bench *b, const char *name, ald_vec *eye, ald_vec *at, double *wide)
{
	struct mesh *m = &b->mesh;

	memset(m, 0, sizeof(*m));
	*at = (ald_vec){ 0, 0, 0 };
	*wide = 0.5;
	if (!strcmp(name, "torus")) {
		mesh_torus(m, (ald_vec){ 0, 0, 0 }, 1, 0.25, 48, 32);
		*eye = (ald_vec){ 2.5, -3, 3 };
	} else if (!strcmp(name, "statue100k") || !strcmp(name, "statue1m")) {
		mesh_statue(m, name[6] == '1' && name[7] == 'm' ? 724 : 224);
		*eye = (ald_vec){ 2, -3, 1 };
	} else if (!strcmp(name, "soup")) {
		mesh_soup(m, 500000, 1, 0.06, 3);
		*eye = (ald_vec){ 2.5, -3, 2 };
	} else if (!strcmp(name, "beams")) {
		mesh_beams(m, 20000, 0.05, 0.1);
		*eye = (ald_vec){ 0.9, -0.95, 0.9 };
		*wide = 0.8;
	} else if (!strcmp(name, "hall")) {
		mesh_beams(m, 20000, 0.3, 0.5);
		*eye = (ald_vec){ 0.9, -0.95, 0.9 };
		*wide = 0.8;
	} else if (!strncmp(name, "terrain", 7)) {
		mesh_field(m, !strcmp(name, "terrain10m") ? 2236 : 707, 10, 1, 3);
		*eye = (ald_vec){ 4, -5, 1.5 };
	} else {
		return false;
	}
	mesh_finish(m, false, false, false);
	return true;
}

/* ---- rays ---- */

static ald_ray ray_of(ald_vec o, ald_vec d, double tmax)
{
	return (ald_ray){ .org = o, .dir = d, .tmax = tmax, .mask = UINT32_MAX, .skip = ALD_NONE, .after = ALD_NONE };
}

static void camera_rays(struct bench *b, ald_vec eye, ald_vec at, double wide)
{
	ald_vec z = unit((ald_vec){ at.x - eye.x, at.y - eye.y, at.z - eye.z });
	ald_vec x = unit(cross(z, (ald_vec){ 0, 0, 1 })), y = cross(x, z);
	uint32_t w = b->width, h = b->height, n = 0;

	for (uint32_t ty = 0; ty < h; ty += 32) {
		for (uint32_t tx = 0; tx < w; tx += 32) {
			for (uint32_t i = 0; i < BATCH; i++) { /* blocks of 4 x 4 */
				uint32_t block = i / 16, px = tx + block % 8 * 4 + i % 4;
				uint32_t py = ty + block / 8 * 4 + i / 4 % 4;
				double u = ((px + 0.5) / w * 2 - 1) * wide;
				double v = (1 - (py + 0.5) / h * 2) * wide * h / w;
				ald_vec d = unit((ald_vec){ z.x + u * x.x + v * y.x, z.y + u * x.y + v * y.y,
							    z.z + u * x.z + v * y.z });

				b->ray[CAMERA][n++] = ray_of(eye, d, 1e30);
			}
		}
	}
	b->n[CAMERA] = n;
}

static void second_rays(struct bench *b, struct engine *e)
{
	uint64_t seed = 77;
	uint32_t n = 0;
	const ald_prims *p = &b->mesh.prims;
	double size = b->mesh.frame.radius / 3;
	ald_vec light = { b->mesh.frame.centre.x + size * 0.3, b->mesh.frame.centre.y - size * 0.2,
			  b->mesh.frame.centre.z + size };

	if (b->mesh.prims.count == 240012)
		light = (ald_vec){ 0.1, 0.2, 0.9 };
	for (uint32_t i = 0; i < b->n[CAMERA]; i++)
		b->hit[i] = (ald_hit){ .t = b->ray[CAMERA][i].tmax, .prim = ALD_NONE };
	e->choice.plugin->intersect_n(e->it, &e->q, b->ray[CAMERA], b->hit, b->n[CAMERA], 0);
	for (uint32_t i = 0; i < b->n[CAMERA]; i++) {
		const ald_ray *r = &b->ray[CAMERA][i];
		const ald_hit *h = &b->hit[i];
		ald_vec v[3], e1, e2, g, d, o;
		double s;

		if (h->prim == ALD_NONE)
			continue;
		ald_corners(p, h->prim, 0, v);
		e1 = (ald_vec){ v[1].x - v[0].x, v[1].y - v[0].y, v[1].z - v[0].z };
		e2 = (ald_vec){ v[2].x - v[0].x, v[2].y - v[0].y, v[2].z - v[0].z };
		g = cross(e1, e2);
		if (g.x * g.x + g.y * g.y + g.z * g.z == 0)
			continue;
		g = unit(g);
		if (g.x * r->dir.x + g.y * r->dir.y + g.z * r->dir.z > 0)
			g = times(g, -1);
		s = 1e-6 * size;
		o = (ald_vec){ r->org.x + h->t * r->dir.x + s * g.x, r->org.y + h->t * r->dir.y + s * g.y,
			       r->org.z + h->t * r->dir.z + s * g.z };
		d = (ald_vec){ light.x - o.x, light.y - o.y, light.z - o.z };
		b->ray[SHADOW][n] = ray_of(o, d, 1);
		d = any_way(&seed);
		d = unit((ald_vec){ d.x + 1.001 * g.x, d.y + 1.001 * g.y, d.z + 1.001 * g.z });
		b->ray[BOUNCE][n] = ray_of(o, d, 1e30);
		d = any_way(&seed);
		d = unit((ald_vec){ d.x + 1.001 * g.x, d.y + 1.001 * g.y, d.z + 1.001 * g.z });
		b->ray[AO][n] = ray_of(o, d, 0.1 * size);
		n++;
	}
	b->n[SHADOW] = b->n[BOUNCE] = b->n[SHUFFLED] = b->n[AO] = n;
	memcpy(b->ray[SHUFFLED], b->ray[BOUNCE], n * sizeof(ald_ray));
	for (uint32_t i = n; i > 1; i--) {
		uint32_t j = (uint32_t)(random_next(&seed) % i);
		ald_ray t = b->ray[SHUFFLED][i - 1];

		b->ray[SHUFFLED][i - 1] = b->ray[SHUFFLED][j];
		b->ray[SHUFFLED][j] = t;
	}
}

/* ---- engines ---- */

static double clock_now(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
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

static bool load_engine(struct engine *e, const char *name)
{
	struct diag d = { 0 };
	char plain[256];
	const char *at = strchr(name, '@');

	e->name = name;
	snprintf(plain, sizeof(plain), "%.*s", at ? (int)(at - name) : 255, name);
	e->precision = at && !strcmp(at, "@exact") ? ALD_PRECISION_EXACT :
		       at && !strcmp(at, "@fast")  ? ALD_PRECISION_FAST :
						     ALD_PRECISION_DEFAULT;
	if (peer_is(name))
		return true;
	if (accel_load(&e->choice, plain, &d) == STATUS_OK && (e->choice.plugin->precisions & e->precision))
		return true;
	fprintf(stderr, "rays: no accelerator %s, or not of that precision\n", name);
	return false;
}

static void close_engine(struct engine *e)
{
	if (e->peer)
		peer_close(e->peer);
	else
		e->choice.plugin->destroy(e->it);
	e->peer = NULL;
	e->it = NULL;
}

static void release_engine(struct engine *e)
{
	close_engine(e);
	mem_free(e->q.scratch);
	if (e->choice.plugin)
		accel_unload(&e->choice);
}

static bool build_engine(struct bench *b, struct engine *e)
{
	ald_error err = { "" };
	double start;

	if (!e->choice.plugin) {
		e->peer = peer_open(e->name, &b->mesh.prims, b->threads, &e->build);
		return true;
	}
	b->mesh.prims.precision = e->precision; /* which is looked at now, and not later */
	start = clock_now();
	if (e->choice.plugin->build(&b->host.host, &b->mesh.prims, e->choice.value, &e->it, &err)) {
		fprintf(stderr, "rays: %s: %s\n", e->name, err.text);
		return false;
	}
	e->build = clock_now() - start;
	return true;
}

/* All in turns, so that none meets memory fresher than the others'. */
static bool open_engines(struct bench *b, char **names, int count)
{
	double seconds[ENGINES][ROUNDS];

	for (int i = 0; i < count && i < ENGINES; i++) {
		if (!load_engine(&b->engine[b->engines++], names[i]))
			return false;
	}
	for (uint32_t r = 0; r < b->builds; r++) {
		for (uint32_t i = 0; i < b->engines; i++) {
			struct engine *e = &b->engine[i];

			if (r)
				close_engine(e);
			if (!build_engine(b, e))
				return false;
			seconds[i][r] = e->build;
		}
	}
	for (uint32_t i = 0; i < b->engines; i++) {
		struct engine *e = &b->engine[i];
		const char *what;
		double value;

		e->build = median(seconds[i], b->builds);
		if (e->peer)
			e->bytes = peer_bytes(e->peer);
		if (e->it && e->choice.plugin->scratch_size)
			e->q.scratch = mem_zalloc(&b->host.book, "scratch", e->choice.plugin->scratch_size(e->it));
		for (uint32_t k = 0; e->it && e->choice.plugin->stat && e->choice.plugin->stat(e->it, k, &what, &value);
		     k++)
			e->bytes = strcmp(what, "memory") ? e->bytes : value;
	}
	return true;
}

static void settle(const struct bench *b, const ald_ray *r, ald_hit *hit)
{
	ald_prep prep;
	ald_vec v[3];

	if (hit->prim == ALD_NONE)
		return;
	ald_ray_prep(&b->mesh.frame, r, &prep);
	ald_corners(&b->mesh.prims, hit->prim, 0, v);
	ald_exact_settle(&prep, v, hit, 0);
}

static void fire(struct bench *b, struct engine *e, unsigned kind, uint32_t round)
{
	static const uint32_t hint[] = { ALD_COHERENT | ALD_ONE_ORIGIN, ALD_COHERENT, 0, 0, 0 };
	const ald_ray *ray = b->ray[kind];
	bool any = kind == SHADOW || kind == AO;
	double start = cpu_now();
	uint64_t sum = 0;

	for (uint32_t at = 0; at < b->n[kind]; at += BATCH) {
		uint32_t n = b->n[kind] - at < BATCH ? b->n[kind] - at : BATCH;

		for (uint32_t i = 0; i < n && !any; i++) {
			b->hit[i].t = ray[at + i].tmax;
			b->hit[i].prim = ALD_NONE;
		}
		if (e->peer)
			peer_fire(e->peer, ray + at, b->hit, any ? b->hidden : NULL, n, hint[kind]);
		else if (any)
			e->choice.plugin->occluded_n(e->it, &e->q, ray + at, b->hidden, n, hint[kind]);
		else
			e->choice.plugin->intersect_n(e->it, &e->q, ray + at, b->hit, n, hint[kind]);
		for (uint32_t i = 0; i < n && !any && e->precision == ALD_PRECISION_EXACT; i++)
			settle(b, &ray[at + i], &b->hit[i]);
		for (uint32_t i = 0; i < n; i++)
			sum += any ? b->hidden[i] : b->hit[i].prim != ALD_NONE;
	}
	e->seconds[kind][round] = cpu_now() - start;
	e->sum[kind] = sum;
}

static void report(struct bench *b, const char *mesh)
{
	printf("%s: %u triangles; million rays a second (ratio to the first), hits\n", mesh, b->mesh.prims.count);
	printf("%-34s %8s %6s", "", "build ms", "B/tri");
	for (unsigned k = 0; k < KINDS; k++)
		printf(" %15s", kind_name[k]);
	puts("");
	for (uint32_t i = 0; i < b->engines; i++) {
		const struct engine *e = &b->engine[i];

		printf("%-34s %8.0f %6.0f", e->name, e->build * 1e3, e->bytes / b->mesh.prims.count);
		for (unsigned k = 0; k < KINDS; k++) {
			double ratio[ROUNDS];

			for (uint32_t r = 0; r < b->rounds; r++)
				ratio[r] = b->engine[0].seconds[k][r] / e->seconds[k][r];
			printf(" %8.2f (%4.2f)", b->n[k] / median(e->seconds[k], b->rounds) * 1e-6,
			       median(ratio, b->rounds));
			if (e->sum[k] != b->engine[0].sum[k])
				printf("!%+lld", (long long)(e->sum[k] - b->engine[0].sum[k]));
		}
		puts("");
	}
	fflush(stdout);
}

/* What each ray cost in steps. */
static void report_counts(struct bench *b, struct engine *e)
{
	uint64_t count[ALD_COUNT_MAX];

	for (unsigned k = 0; k < KINDS && !e->peer; k++) {
		bool any = k == SHADOW || k == AO;

		memset(count, 0, sizeof(count));
		e->q.count = count;
		for (uint32_t i = 0; i < b->n[k]; i++)
			b->hit[i] = (ald_hit){ .t = b->ray[k][i].tmax, .prim = ALD_NONE };
		for (uint32_t at = 0; at < b->n[k]; at += BATCH) {
			uint32_t n = b->n[k] - at < BATCH ? b->n[k] - at : BATCH;

			if (any)
				e->choice.plugin->occluded_n(e->it, &e->q, b->ray[k] + at, b->hidden, n, 0);
			else
				e->choice.plugin->intersect_n(e->it, &e->q, b->ray[k] + at, b->hit + at, n, 0);
		}
		e->q.count = NULL;
		printf("  %s: %s: nodes %.2f, primitives %.2f, volumes %.2f a ray\n", e->name, kind_name[k],
		       (double)count[ALD_COUNT_NODES] / b->n[k], (double)count[ALD_COUNT_PRIMS] / b->n[k],
		       (double)count[ALD_COUNT_VOLUME_TESTS] / b->n[k]);
	}
}

static int run(struct bench *b, const char *mesh, char **names, int count)
{
	ald_vec eye, at;
	double wide;

	if (!make_mesh(b, mesh, &eye, &at, &wide)) {
		fprintf(stderr, "rays: no mesh %s: torus, statue100k, statue1m, soup, beams, hall, terrain, terrain10m\n",
			mesh);
		return 2;
	}
	memset(b->engine, 0, sizeof(b->engine));
	b->engines = 0;
	test_host_init(&b->host, b->threads, 0);
	if (!open_engines(b, names, count))
		return 1;
	camera_rays(b, eye, at, wide);
	for (uint32_t i = 0; i < b->engines; i++) {
		if (b->engine[i].it) {
			second_rays(b, &b->engine[i]);
			break;
		}
	}
	for (uint32_t r = 0; r < b->rounds; r++) {
		for (unsigned k = 0; k < KINDS; k++) {
			for (uint32_t i = 0; i < b->engines; i++)
				fire(b, &b->engine[(i + r) % b->engines], k, r);
		}
	}
	report(b, mesh);
	for (uint32_t i = 0; i < b->engines && b->counts; i++)
		report_counts(b, &b->engine[i]);
	for (uint32_t i = 0; i < b->engines; i++)
		release_engine(&b->engine[i]);
	test_host_release(&b->host);
	mesh_release(&b->mesh);
	return 0;
}

int main(int argc, char **argv)
{
	static char *usual[] = { "bvh8", "octree" };
	static char all[] = "torus,statue100k,statue1m,soup,beams,terrain";
	struct bench *b = calloc(1, sizeof(*b));
	char *meshes = all;
	size_t rays;
	int c, status = 0;

	b->rounds = 7;
	b->width = 512;
	b->threads = 1;
	b->builds = 3;
	while ((c = getopt(argc, argv, "n:s:m:t:b:c")) != -1) {
		if (c == 'n')
			b->rounds = (uint32_t)atoi(optarg);
		else if (c == 's')
			b->width = (uint32_t)atoi(optarg) & ~127u;
		else if (c == 'm')
			meshes = optarg;
		else if (c == 'c')
			b->counts = 1;
		else if (c == 'b')
			b->builds = (uint32_t)atoi(optarg);
		else if (c == 't')
			b->threads = (uint32_t)atoi(optarg);
		else
			return 2;
	}
	if (b->rounds < 1 || b->rounds > ROUNDS || b->builds < 1 || b->builds > ROUNDS || b->width < 128 || b->width > 8192)
		return 2;
	b->height = b->width / 4 * 3;
	rays = (size_t)b->width * b->height;
	for (unsigned k = 0; k < KINDS; k++)
		b->ray[k] = malloc(rays * sizeof(ald_ray));
	b->hit = calloc(rays, sizeof(*b->hit));
	b->hidden = calloc(BATCH, 1);
	for (char *m = strtok(meshes, ","); m && !status; m = strtok(NULL, ","))
		status = optind < argc ? run(b, m, argv + optind, argc - optind) : run(b, m, usual, 2);
	return status;
}
