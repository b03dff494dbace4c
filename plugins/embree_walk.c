/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * embree: rays to Embree's, one, four, eight, sixteen or many at a time, and its questions back to the kernel.
 * See embree.h for coordinates and bounds.
 */
#include "embree.h"

#include <string.h>

/* 2^-exponent and 2^exponent of x, a normal number, as frexp() has it. */
static void units(double x, double *down, double *up)
{
	uint64_t b, c;

	memcpy(&b, &x, sizeof(b));
	b = b >> 52 & 2047;
	c = (b + 1) << 52;
	b = (2045 - b) << 52;
	memcpy(down, &b, sizeof(b));
	memcpy(up, &c, sizeof(c));
}

static float walk_t(const struct beam *b, double t)
{
	t = (t - b->shift) * b->tscale;
	return (float)(t < 8 ? (t > 0 ? t : 0) : 8);
}

static float walk_limit(const struct beam *b, double t)
{
	return walk_t(b, t) * (1 + 0x1p-20f) + 0x1p-30f;
}

/* ---- what Embree asks ---- */

/* Packets of any size n are arrays of n numbers, one member of RTCRay and of RTCHit after the other; Embree has
 * functions for them in C++ only. */
enum { RAY_TFAR = 8, RAY_ID = 10, HIT_BEHIND_RAY = 12, HIT_PRIM = 5, HIT_GEOMETRY = 6 };

static float *ray_tfar(void *ray, unsigned n, unsigned k)
{
	return (float *)ray + RAY_TFAR * n + k;
}

static unsigned ray_id(const void *ray, unsigned n, unsigned k)
{
	return ((const unsigned *)ray)[RAY_ID * n + k];
}

static unsigned *hit_word(void *hit, unsigned n, unsigned k, unsigned member)
{
	return (unsigned *)hit + member * n + k;
}

static int confirm(const struct call *c, struct beam *b, uint32_t id)
{
	const ald_prims *prims = c->a->prims;
	ald_vec v[3];
	int hit;

	if (!ald_sees(prims, b->ray, id))
		return 0;
	if (c->q->count)
		c->q->count[ALD_COUNT_PRIMS]++;
	if (id < prims->tri_count) {
		ald_corners(prims, id, prims->origin ? ald_group_of(prims, id) : 0, v);
		hit = ald_triangle(&b->prep, b->ray, v, id, b->hit);
	} else {
		hit = prims->intersect(prims, id, c->q, b->ray, b->hit);
	}
	b->found |= hit;
	return hit;
}

void embree_intersect_cb(const struct RTCIntersectFunctionNArguments *args)
{
	const struct call *c = (const struct call *)args->context;
	void *ray = args->rayhit;
	unsigned n = args->N;
	float *hit = (float *)ray + HIT_BEHIND_RAY * n;

	for (unsigned k = 0; k < n; k++) {
		float *tfar = ray_tfar(ray, n, k);
		struct beam *b;

		if (!args->valid[k])
			continue;
		b = &c->beam[ray_id(ray, n, k)];
		if (c->a->native) /* which triangles may have cut */
			b->hit->t = ald_min(b->shift + (double)*tfar / b->tscale, b->hit->t);
		if (!confirm(c, b, c->a->first + args->primID))
			continue;
		*tfar = walk_limit(b, b->hit->t);
		*hit_word(hit, n, k, HIT_GEOMETRY) = args->geomID;
		*hit_word(hit, n, k, HIT_PRIM) = args->primID;
	}
}

void embree_occluded_cb(const struct RTCOccludedFunctionNArguments *args)
{
	const struct call *c = (const struct call *)args->context;

	for (unsigned k = 0; k < args->N; k++) {
		if (args->valid[k] &&
		    confirm(c, &c->beam[ray_id(args->ray, args->N, k)], c->a->first + args->primID))
			*ray_tfar(args->ray, args->N, k) = -INFINITY;
	}
}

/* native=1: what its triangles don't know of. */
static void native_filter(const struct RTCFilterFunctionNArguments *args)
{
	const struct call *c = (const struct call *)args->context;
	unsigned n = args->N;

	for (unsigned k = 0; k < n; k++) {
		const struct beam *b;
		uint32_t id;

		if (!args->valid[k] || *hit_word(args->hit, n, k, HIT_GEOMETRY) != TRIANGLES)
			continue;
		b = &c->beam[ray_id(args->ray, n, k)];
		id = *hit_word(args->hit, n, k, HIT_PRIM);
		/* A line meets a triangle once, wherever floats say that it does. */
		if (!ald_sees(c->a->prims, b->ray, id) || id == b->ray->after ||
		    b->shift + (double)*ray_tfar(args->ray, n, k) / b->tscale < b->ray->tmin)
			args->valid[k] = 0;
	}
}

/* ---- rays ---- */

/* No triangle is hit by such a ray, or all have to be asked: no floats are exact enough. */
static void every(const struct call *c, struct beam *b, uint32_t first)
{
	for (uint32_t id = first; id < c->a->prims->count && !(c->any && b->found); id++)
		confirm(c, b, id);
}

/* native=1: a ray that is given to Embree as it is. 0: the rest has to be looked at. */
static int begin_native(const ald_accel *a, struct beam *b)
{
	const double *o = &b->ray->org.x, *d = &b->ray->dir.x;
	int near = a->first == a->prims->count, fair = 0;

	for (unsigned k = 0; k < 3; k++) {
		b->org[k] = (float)((o[k] - a->centre[k]) * a->scale);
		b->dir[k] = (float)d[k];
		near &= b->org[k] > -4 && b->org[k] < 4 && d[k] > -0x1p30 && d[k] < 0x1p30;
		fair |= d[k] > 0x1p-30 || d[k] < -0x1p-30;
	}
	b->shift = 0;
	b->tscale = a->scale;
	b->tnear = (float)ald_max(b->ray->tmin * a->scale, 0);
	b->tfar = (float)ald_min(b->hit->t * a->scale, 0x1p60);
	return near & fair;
}

/* 0: there is nothing more to ask. */
static int begin(const struct call *c, struct beam *b, const ald_ray *ray, ald_hit *hit)
{
	const ald_accel *a = c->a;
	ald_prep *p = &b->prep;
	double unit, back;

	b->ray = ray;
	b->hit = hit;
	b->found = 0;
	if (a->native && begin_native(a, b))
		return 1;
	ald_ray_prep(&a->frame, ray, p);
	/* So that t does not go with where a ray goes on from, if it is Embree's. */
	if (!ald_box_ray(p, &a->box, a->native ? -DBL_MAX : ray->tmin, hit->t, &b->shift))
		return 0;
	if (a->native && !(b->shift > 0))
		b->shift = 0;
	if (!(p->shear[0] == p->shear[0])) {
		every(c, b, a->prims->tri_count);
		return 0;
	}
	if (!(4 * p->pad * a->scale <= FAR_MOST)) {
		every(c, b, 0);
		return 0;
	}
	units(p->d[p->kz], &unit, &back);
	b->tscale = a->scale * back;
	for (unsigned k = 0; k < 3; k++) {
		b->org[k] = (float)(((p->o[k] - a->centre[k]) + b->shift * p->d[k]) * a->scale);
		b->dir[k] = (float)(p->d[k] * unit);
	}
	b->tnear = a->native ? walk_t(b, ray->tmin) : 0;
	b->tfar = walk_limit(b, hit->t);
	return 1;
}

/* native=1: what it found among its triangles. */
static void native_hit(struct beam *b, uint32_t geometry, uint32_t prim, float t, float u, float v)
{
	double at = b->shift + (double)t / b->tscale;

	if (geometry != TRIANGLES)
		return;
	*b->hit = (ald_hit){ .t = at < b->hit->t ? at : b->hit->t, .u = (double)u, .v = (double)v, .prim = prim };
	b->found = 1;
}

static void fire1(struct call *c, uint32_t id)
{
	struct beam *b = &c->beam[id];
	struct RTCRayHit r = { .ray = { b->org[0], b->org[1], b->org[2], b->tnear, b->dir[0], b->dir[1], b->dir[2], 0,
					b->tfar, UINT32_MAX, id, 0 } };

	if (c->any) {
		rtcOccluded1(c->a->scene, &c->context, &r.ray);
		b->found |= r.ray.tfar < 0;
		return;
	}
	r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
	rtcIntersect1(c->a->scene, &c->context, &r);
	if (c->a->native)
		native_hit(b, r.hit.geomID, r.hit.primID, r.ray.tfar, r.hit.u, r.hit.v);
}

#define FILL(r, k, b, i)                                                                                               \
	do {                                                                                                           \
		(r).ray.org_x[k] = (b)->org[0];                                                                        \
		(r).ray.org_y[k] = (b)->org[1];                                                                        \
		(r).ray.org_z[k] = (b)->org[2];                                                                        \
		(r).ray.dir_x[k] = (b)->dir[0];                                                                        \
		(r).ray.dir_y[k] = (b)->dir[1];                                                                        \
		(r).ray.dir_z[k] = (b)->dir[2];                                                                        \
		(r).ray.tnear[k] = (b)->tnear;                                                                         \
		(r).ray.tfar[k] = (b)->tfar;                                                                           \
		(r).ray.time[k] = 0;                                                                                   \
		(r).ray.mask[k] = UINT32_MAX;                                                                          \
		(r).ray.id[k] = (i);                                                                                   \
		(r).ray.flags[k] = 0;                                                                                  \
		(r).hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;                                                           \
	} while (0)

#define EMPTY(c, r, k, b)                                                                                              \
	do {                                                                                                           \
		if ((c)->any)                                                                                          \
			(b)->found |= (r).ray.tfar[k] < 0;                                                             \
		else if ((c)->a->native)                                                                               \
			native_hit(b, (r).hit.geomID[k], (r).hit.primID[k], (r).ray.tfar[k], (r).hit.u[k],             \
				   (r).hit.v[k]);                                                                      \
	} while (0)

/* Of the n beams whose numbers are in live. */
#define FIRE(W)                                                                                                        \
	static void fire##W(struct call *c, const uint8_t *live, uint32_t n)                                           \
	{                                                                                                              \
		for (uint32_t at = 0; at < n; at += W) {                                                               \
			struct RTCRayHit##W r;                                                                         \
			int valid[W] __attribute__((aligned(64)));                                                     \
\
			for (uint32_t k = 0; k < W; k++) {                                                             \
				uint32_t i = live[at + k < n ? at + k : n - 1];                                        \
\
				valid[k] = at + k < n ? -1 : 0;                                                        \
				FILL(r, k, &c->beam[i], i);                                                            \
			}                                                                                              \
			if (c->any)                                                                                    \
				rtcOccluded##W(valid, c->a->scene, &c->context, &r.ray);                               \
			else                                                                                           \
				rtcIntersect##W(valid, c->a->scene, &c->context, &r);                                  \
			for (uint32_t k = 0; k < W && at + k < n; k++)                                                 \
				EMPTY(c, r, k, &c->beam[live[at + k]]);                                                \
		}                                                                                                      \
	}

FIRE(4)
FIRE(8)
FIRE(16)

static void fire_stream(struct call *c, const uint8_t *live, uint32_t n)
{
	struct RTCRayHit r[STREAM];

	for (uint32_t k = 0; k < n; k++) {
		const struct beam *b = &c->beam[live[k]];

		r[k].ray = (struct RTCRay){ b->org[0], b->org[1], b->org[2], b->tnear, b->dir[0], b->dir[1],
					    b->dir[2], 0, b->tfar, UINT32_MAX, live[k], 0 };
		r[k].hit.geomID = RTC_INVALID_GEOMETRY_ID;
	}
	if (c->any)
		rtcOccluded1M(c->a->scene, &c->context, &r[0].ray, n, sizeof(r[0]));
	else
		rtcIntersect1M(c->a->scene, &c->context, r, n, sizeof(r[0]));
	for (uint32_t k = 0; k < n; k++) {
		struct beam *b = &c->beam[live[k]];

		if (c->any)
			b->found |= r[k].ray.tfar < 0;
		else if (c->a->native)
			native_hit(b, r[k].hit.geomID, r[k].hit.primID, r[k].ray.tfar, r[k].hit.u, r[k].hit.v);
	}
}

void embree_fire(struct call *c, const ald_ray *ray, ald_hit *hit, uint32_t n, unsigned packet)
{
	const ald_prims *prims = c->a->prims;
	uint8_t live[STREAM];
	uint32_t lives = 0;
	int filtered = prims->mask != NULL;

	for (uint32_t i = 0; i < n; i++) {
		if (begin(c, &c->beam[i], &ray[i], &hit[i]))
			live[lives++] = (uint8_t)i;
		filtered |= ray[i].skip != ALD_NONE || ray[i].after != ALD_NONE || ray[i].tmin > 0;
	}
	c->context.filter = c->a->native && filtered ? native_filter : NULL;
	if (!lives || !c->a->scene)
		return;
	if (packet == PACKET_4)
		fire4(c, live, lives);
	else if (packet == PACKET_8)
		fire8(c, live, lives);
	else if (packet == PACKET_16)
		fire16(c, live, lives);
	else if (packet == PACKET_STREAM)
		fire_stream(c, live, lives);
	else
		for (uint32_t i = 0; i < lives; i++)
			fire1(c, live[i]);
}
