/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * sphere: one bounding sphere around each object (the contract's groups), centred on the middle of its
 * box, as small as its furthest corner lets it be.
 */
#include "flat.h"

struct ball {
	ald_vec centre;
	double radius;
};

struct ald_accel {
	struct flat flat;
	struct ball *volume; /* of each range */
};

static void sphere_destroy(ald_accel *a)
{
	const ald_host *host = a->flat.host;

	flat_release(&a->flat);
	host->free(host->ctx, a->volume);
	host->free(host->ctx, a);
}

/* Grow the ball so that it holds the point, and what rounding may move it by. */
static void ball_hold(struct ball *b, const ald_vec *p, double pad)
{
	double x = p->x - b->centre.x, y = p->y - b->centre.y, z = p->z - b->centre.z;

	b->radius = ald_max(sqrt(x * x + y * y + z * z) * (1 + 8 * ALD_U) + pad, b->radius);
}

static void ball_around(const struct flat *f, uint32_t g, struct ball *b)
{
	const ald_prims *p = f->prims;
	const struct range *r = &f->range[g];
	ald_vec v[8];
	ald_box box;

	flat_box(p, r->first, r->end, &box);
	b->centre.x = box.lo.x + (box.hi.x - box.lo.x) / 2;
	b->centre.y = box.lo.y + (box.hi.y - box.lo.y) / 2;
	b->centre.z = box.lo.z + (box.hi.z - box.lo.z) / 2;
	b->radius = 0;
	for (uint32_t i = r->first; i < r->tris; i++) {
		ald_corners(p, i, g, v);
		for (unsigned k = 0; k < 3; k++)
			ball_hold(b, &v[k], 2 * p->pad);
	}
	for (uint32_t i = r->tris; i < r->end; i++) {
		p->bounds(p, i, &box);
		for (unsigned k = 0; k < 8; k++) {
			v[k].x = k & 1 ? box.hi.x : box.lo.x;
			v[k].y = k & 2 ? box.hi.y : box.lo.y;
			v[k].z = k & 4 ? box.hi.z : box.lo.z;
			ball_hold(b, &v[k], 0);
		}
	}
}

static int sphere_volumes(ald_accel *a, const ald_host *host)
{
	const struct flat *f = &a->flat;

	a->volume = host->alloc(host->ctx, (f->ranges + (size_t)1) * sizeof(*a->volume), "volumes");
	if (!a->volume)
		return ALD_NO_MEMORY;
	for (uint32_t g = 0; g < f->ranges; g++)
		ball_around(f, g, &a->volume[g]);
	a->flat.bytes += f->ranges * sizeof(*a->volume);
	return ALD_OK;
}

static int sphere_build(const ald_host *host, const ald_prims *prims, const double *value,
		      ald_accel **out, ald_error *err)
{
	ald_accel *a = host->alloc(host->ctx, sizeof(*a), "volumes");
	int status;

	(void)value;
	(void)err;
	if (!a)
		return ALD_NO_MEMORY;
	a->volume = NULL;
	status = flat_init(&a->flat, host, prims, 1);
	if (!status)
		status = sphere_volumes(a, host);
	if (status)
		sphere_destroy(a);
	else
		*out = a;
	return status;
}

ALD_INLINE int sphere_enter(const ald_accel *a, uint32_t range, const ald_prep *prep, double tmin,
			    double tmax, double *enter)
{
	const struct ball *b = &a->volume[range];

	return ald_sphere_ray(prep, &b->centre, b->radius, tmin, tmax, enter);
}

ALD_INLINE int sphere_enter_fast(const ald_accel *a, uint32_t range, const ald_fast_prep *prep, double tmin,
				 double tmax, double *enter)
{
	const struct ball *b = &a->volume[range];

	return ald_fast_sphere_ray(prep, &b->centre, b->radius, tmin, tmax, enter);
}

static const struct flat_volume sphere_volume = { sphere_enter, sphere_enter_fast };

WIDE static void sphere_intersect_n(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit,
				  uint32_t n, uint32_t hints)
{
	(void)hints;
	flat_nearest(&a->flat, a, &sphere_volume, q, ray, hit, n);
}

WIDE static void sphere_occluded_n(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden,
				 uint32_t n, uint32_t hints)
{
	(void)hints;
	flat_occluded(&a->flat, a, &sphere_volume, q, ray, hidden, n);
}

static int sphere_intersect(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	ald_hit old = *hit;

	sphere_intersect_n(a, q, ray, hit, 1, 0);
	return hit->t != old.t || hit->prim != old.prim;
}

static int sphere_occluded(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	uint8_t hidden;

	sphere_occluded_n(a, q, ray, &hidden, 1, 0);
	return hidden;
}

static int sphere_stat(const ald_accel *a, uint32_t i, const char **name, double *value)
{
	if (i > 1)
		return 0;
	*name = i ? "memory" : "volumes";
	*value = i ? (double)a->flat.bytes : a->flat.ranges;
	return 1;
}

static int sphere_walk(const ald_accel *a, const ald_ray *only, ald_visit *visit, void *arg)
{
	ald_prep prep;

	if (only)
		ald_ray_prep(&a->flat.frame, only, &prep);
	for (uint32_t g = 0; g < a->flat.ranges; g++) {
		ald_volume v = { .kind = ALD_VOLUME_SPHERE, .depth = 0 };
		double t;

		v.prims = a->flat.range[g].end - a->flat.range[g].first;
		v.box.lo = a->volume[g].centre;
		v.box.hi = (ald_vec){ a->volume[g].radius, 0, 0 };
		if (only && !sphere_enter(a, g, &prep, only->tmin, only->tmax, &t))
			continue;
		if (visit(arg, &v) < 0)
			return -1;
	}
	return 0;
}

const ald_accel_plugin ald_accel_entry = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "sphere",
	.version = "1",
	.license = "Apache-2.0",
	.summary = "one bounding sphere around each object",
	.precisions = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT | ALD_PRECISION_FAST,
	.build = sphere_build,
	.intersect = sphere_intersect,
	.destroy = sphere_destroy,
	.occluded = sphere_occluded,
	.intersect_n = sphere_intersect_n,
	.occluded_n = sphere_occluded_n,
	.stat = sphere_stat,
	.walk = sphere_walk,
};
