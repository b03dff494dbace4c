/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Prints a hash of what rays hit in scenes: id, t, u, v and the rest of the hit to the bit, and the surface there.
 * Run by bits.sh: whoever compiled it, however, and whatever was loaded before, it has to print the same.
 *
 *	hits [-n RAYS] [-a ACCEL]... SCENE...
 *
 * Rays are ordinary ones through the scene, aimed at corners of its meshes, along axes, and such that leave what
 * the last one hit; also shadows, and what lies behind. No libm is used to make them.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "accel/geometry.h"
#include "accel/load.h"
#include "accel/trace.h"
#include "alidade/kernel.h"
#include "base/process.h"
#include "base/rng.h"
#include "read/read.h"

enum { ACCELS = 16, BATCH = 512 };

struct run {
	struct mem_book book;
	struct pool *pool;
	struct scene scene;
	struct geometry *geometry;
	struct geometry_counts counts;
	uint64_t seed, hash, surfaces, hits;
	ald_ray ray[BATCH];
	ald_hit hit[BATCH];
	uint8_t hidden[BATCH];
};

static void say(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	(void)arg;
	if (level == DIAG_ERROR)
		fprintf(stderr, "%s:%u: %s\n", pos ? pos->file : "hits", pos ? pos->line : 0, text);
}

static void add(uint64_t *hash, const void *bytes, size_t n)
{
	const unsigned char *b = bytes;

	while (n--)
		*hash = (*hash ^ *b++) * 1099511628211u;
}

static double dice(struct run *r)
{
	return rng_unit(r->seed += 0x9e3779b97f4a7c15u);
}

static vec somewhere(struct run *r, double size)
{
	ald_box b = r->counts.box;
	vec half = vec_scale(vec_sub(b.hi, b.lo), size / 2), centre = vec_scale(vec_add(b.lo, b.hi), 0.5);
	double x = 2 * dice(r) - 1, y = 2 * dice(r) - 1; /* one by one: arguments are in no order */

	return vec_make(centre.x + half.x * x, centre.y + half.y * y, centre.z + half.z * (2 * dice(r) - 1));
}

static vec corner(struct run *r)
{
	const struct scene *s = &r->scene;
	const struct mesh *m;
	const double *at;

	if (!s->mesh_count)
		return somewhere(r, 1);
	m = &s->mesh[(uint32_t)(dice(r) * s->mesh_count)];
	if (!m->vertex_count)
		return somewhere(r, 1);
	at = m->vertex + 3 * (size_t)(dice(r) * m->vertex_count);
	return vec_make(at[0], at[1], at[2]);
}

static void make(struct run *r, uint32_t i, ald_ray *ray)
{
	vec to = i % 4 == 1 ? corner(r) : somewhere(r, 1);

	*ray = (ald_ray){ .tmax = ALD_INF, .mask = ~0u, .skip = ALD_NONE, .after = ALD_NONE,
			  .after_sub = { ALD_NONE, ALD_NONE } };
	ray->org = somewhere(r, i % 8 < 4 ? 4 : 1);
	ray->dir = vec_sub(to, ray->org);
	if (i % 4 == 2)
		(&ray->dir.x)[i / 4 % 3] = i % 8 < 4 ? 0.0 : -0.0;
	if (i % 4 == 3) { /* towards a lamp, so to speak, from where the ray before has hit */
		ray->tmax = 1;
		ray->dir = vec_scale(ray->dir, 0.5);
	}
}

static void add_hits(struct run *r)
{
	for (uint32_t i = 0; i < BATCH; i++) {
		const ald_hit *h = &r->hit[i];
		struct surface s;

		add(&r->hash, &h->prim, sizeof(h->prim));
		if (h->prim == ALD_NONE)
			continue;
		r->hits++;
		add(&r->hash, h, sizeof(*h));
		surface_at(r->geometry, &r->ray[i], h, &s);
		add(&r->surfaces, &s.p, sizeof(s.p));
		add(&r->surfaces, &s.n, sizeof(s.n));
		add(&r->surfaces, &s.ns, sizeof(s.ns));
		add(&r->surfaces, &s.error, sizeof(s.error));
	}
}

/* Behind what was hit for one half, off the surface for the other. */
static void go_on(struct run *r)
{
	for (uint32_t i = 0; i < BATCH; i++) {
		struct surface s;
		ald_ray *ray = &r->ray[i];

		if (r->hit[i].prim == ALD_NONE) {
			make(r, i, ray);
		} else if (i & 1) {
			trace_after(ray, &r->hit[i]);
		} else {
			surface_at(r->geometry, ray, &r->hit[i], &s);
			make(r, 0, ray);
			ray->dir = vec_sub(somewhere(r, 2), s.p);
			ray->org = vec_mad(s.p, s.n, vec_dot(ray->dir, s.n) < 0 ? -s.error : s.error);
			ray->skip = s.planar ? r->hit[i].prim : ALD_NONE;
		}
	}
}

static void trace(struct run *r, uint32_t rays)
{
	for (uint32_t done = 0; done < rays; done += 3 * BATCH) {
		for (uint32_t i = 0; i < BATCH; i++)
			make(r, done + i, &r->ray[i]);
		for (unsigned bounce = 0; bounce < 3; bounce++) {
			trace_nearest(r->geometry, 0, r->ray, r->hit, BATCH, 0);
			add_hits(r);
			trace_occluded(r->geometry, 0, r->ray, r->hidden, BATCH, 0);
			add(&r->hash, r->hidden, sizeof(r->hidden));
			go_on(r);
		}
	}
}

static enum status run_one(struct run *r, const char *file, const char *accel, uint32_t rays)
{
	struct diag d = { .sink = say };
	struct read_options options = { .lenient = true, .quiet_debug = true };
	struct accel_choice choice;
	enum status st = accel_load(&choice, accel, &d);

	if (st)
		return st;
	memset(r, 0, sizeof(*r));
	mem_book_init(&r->book, 0);
	scene_init(&r->scene, &r->book);
	r->pool = pool_new(1);
	st = read_scene(file, &options, &r->scene, NULL, &d);
	if (!st)
		st = geometry_build(&r->geometry, &r->scene, &choice, r->pool, &r->book, false, &d);
	if (!st) {
		geometry_get_counts(r->geometry, &r->counts);
		r->hash = r->surfaces = 14695981039346656037u;
		trace(r, rays);
		file = strrchr(file, '/') ? strrchr(file, '/') + 1 : file;
		printf("%s %" PRIu64 " hits %016" PRIx64 " surfaces %016" PRIx64 "\n", file, r->hits, r->hash,
		       r->surfaces);
	}
	geometry_free(r->geometry);
	scene_release(&r->scene);
	pool_free(r->pool);
	accel_unload(&choice);
	return st;
}

int main(int argc, char **argv)
{
	static struct run run;
	const char *accel[ACCELS] = { "none" };
	unsigned accels = 0;
	uint32_t rays = 30000;
	int c;

	process_begin();
	while ((c = getopt(argc, argv, "n:a:")) != -1) {
		if (c == 'n')
			rays = (uint32_t)strtoul(optarg, NULL, 10);
		else if (c == 'a' && accels < ACCELS)
			accel[accels++] = optarg;
		else
			return 2;
	}
	for (unsigned a = 0; a < (accels ? accels : 1); a++) {
		for (int i = optind; i < argc; i++) {
			if (run_one(&run, argv[i], accel[a], rays))
				return 1;
		}
	}
	return 0;
}
