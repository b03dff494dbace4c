/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Rays: camera; and one of each of these at each camera ray's hit: shadow, to a point of light (is there anything
 * between?); bounce, in a direction by the cosine (what is nearest?), shuffled, the same in no order, as they come
 * after several bounces; ao, like a bounce, but is there anything within a tenth of the scene's size?
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <stdlib.h>
#include <string.h>

#include "base/single.h"
#include "directions.h"
#include "worlds.h"

static ald_vec as_singles(ald_vec v)
{
	return (ald_vec){ as_single(v.x), as_single(v.y), as_single(v.z) };
}

static ald_ray ray_of(ald_vec o, ald_vec d, double tmax)
{
	return (ald_ray){ .org = as_singles(o), .dir = as_singles(d), .tmax = as_single(tmax), .mask = UINT32_MAX,
			  .skip = ALD_NONE, .after = ALD_NONE };
}

void shots_camera(struct shots *s, const struct world *world, uint32_t w)
{
	ald_vec z = unit(minus(world->at, world->eye)), x = unit(cross(z, (ald_vec){ 0, 0, 1 })), y = cross(x, z);
	uint32_t h = w / 4 * 3, n = 0;
	double wide = world->wide;

	for (unsigned k = 0; k < KINDS; k++)
		s->ray[k] = malloc((size_t)w * h * sizeof(ald_ray));
	for (uint32_t ty = 0; ty < h; ty += 32) {
		for (uint32_t tx = 0; tx < w; tx += 32) {
			for (uint32_t i = 0; i < 1024; i++) {
				uint32_t square = i / 64, block = i / 16;
				uint32_t px = tx + square % 4 * 8 + block % 2 * 4 + i % 4;
				uint32_t py = ty + square / 4 * 8 + block / 2 % 2 * 4 + i / 4 % 4;
				double u = ((px + 0.5) / w * 2 - 1) * wide;
				double v = (1 - (py + 0.5) / h * 2) * wide * h / w;
				ald_vec d = unit((ald_vec){ z.x + u * x.x + v * y.x, z.y + u * x.y + v * y.y,
							    z.z + u * x.z + v * y.z });

				s->ray[CAMERA][n++] = ray_of(world->eye, d, 1e30);
			}
		}
	}
	s->n[CAMERA] = n;
}

/* Towards the ray's origin; false: the triangle has none. */
static bool normal(const struct mesh *m, const struct geometry *built, const ald_ray *r, const ald_hit *hit,
		   ald_vec *out)
{
	ald_vec v[3], g;

	if (built) {
		g = forest_normal(built, r, hit);
		*out = dot(g, r->dir) > 0 ? times(g, -1) : g;
		return true;
	}
	ald_corners(&m->prims, hit->prim, 0, v);
	g = cross(minus(v[1], v[0]), minus(v[2], v[0]));
	if (dot(g, g) == 0)
		return false;
	g = unit(g);
	*out = dot(g, r->dir) > 0 ? times(g, -1) : g;
	return true;
}

static ald_vec by_cosine(ald_vec n, uint64_t *seed)
{
	ald_vec d = any_way(seed);

	return unit((ald_vec){ d.x + 1.001 * n.x, d.y + 1.001 * n.y, d.z + 1.001 * n.z });
}

static void shuffle(ald_ray *ray, uint32_t n, uint64_t *seed)
{
	for (uint32_t i = n; i > 1; i--) {
		uint32_t j = (uint32_t)(random_next(seed) % i);
		ald_ray t = ray[i - 1];

		ray[i - 1] = ray[j];
		ray[j] = t;
	}
}

void shots_second(struct shots *s, const struct world *w, const struct geometry *built, const ald_hit *hit)
{
	uint64_t seed = 77;
	uint32_t n = 0;
	double size = w->radius / 3, off = 1e-5 * size;

	for (uint32_t i = 0; i < s->n[CAMERA]; i++) {
		const ald_ray *r = &s->ray[CAMERA][i];
		ald_vec g, o;
		double t = hit[i].t;

		if (hit[i].prim == ALD_NONE || !normal(&w->mesh, built, r, &hit[i], &g))
			continue;
		o = (ald_vec){ r->org.x + t * r->dir.x + off * g.x, r->org.y + t * r->dir.y + off * g.y,
			       r->org.z + t * r->dir.z + off * g.z };
		s->ray[SHADOW][n] = ray_of(o, minus(w->light, o), 1);
		s->ray[BOUNCE][n] = ray_of(o, by_cosine(g, &seed), 1e30);
		s->ray[AO][n] = ray_of(o, by_cosine(g, &seed), 0.1 * size);
		n++;
	}
	s->n[SHADOW] = s->n[BOUNCE] = s->n[SHUFFLED] = s->n[AO] = n;
	memcpy(s->ray[SHUFFLED], s->ray[BOUNCE], n * sizeof(ald_ray));
	shuffle(s->ray[SHUFFLED], n, &seed);
}

void shots_release(struct shots *s)
{
	for (unsigned k = 0; k < KINDS; k++)
		free(s->ray[k]);
}
