/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * box: one axis-aligned box around each object (the contract's groups).
 */
#include "flat.h"

struct ald_accel {
	struct flat flat;
	ald_box *volume; /* of each range */
};

static void box_destroy(ald_accel *a)
{
	const ald_host *host = a->flat.host;

	flat_release(&a->flat);
	host->free(host->ctx, a->volume);
	host->free(host->ctx, a);
}

static int box_volumes(ald_accel *a, const ald_host *host)
{
	const struct flat *f = &a->flat;

	a->volume = host->alloc(host->ctx, (f->ranges + (size_t)1) * sizeof(*a->volume), "volumes");
	if (!a->volume)
		return ALD_NO_MEMORY;
	for (uint32_t g = 0; g < f->ranges; g++)
		flat_box(f->prims, f->range[g].first, f->range[g].end, &a->volume[g]);
	a->flat.bytes += f->ranges * sizeof(*a->volume);
	return ALD_OK;
}

static int box_build(const ald_host *host, const ald_prims *prims, const double *value,
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
		status = box_volumes(a, host);
	if (status)
		box_destroy(a);
	else
		*out = a;
	return status;
}

ALD_INLINE int box_enter(const ald_accel *a, uint32_t range, const ald_prep *prep, double tmin,
			 double tmax, double *enter)
{
	return ald_box_ray(prep, &a->volume[range], tmin, tmax, enter);
}

ALD_INLINE int box_enter_fast(const ald_accel *a, uint32_t range, const ald_fast_prep *prep, double tmin, double tmax,
			   double *enter)
{
	return ald_fast_box_ray(prep, &a->volume[range], tmin, tmax, enter);
}

static const struct flat_volume box_volume = { box_enter, box_enter_fast };

WIDE static void box_intersect_n(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit,
				  uint32_t n, uint32_t hints)
{
	(void)hints;
	flat_nearest(&a->flat, a, &box_volume, q, ray, hit, n);
}

WIDE static void box_occluded_n(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden,
				 uint32_t n, uint32_t hints)
{
	(void)hints;
	flat_occluded(&a->flat, a, &box_volume, q, ray, hidden, n);
}

static int box_intersect(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	ald_hit old = *hit;

	box_intersect_n(a, q, ray, hit, 1, 0);
	return hit->t != old.t || hit->prim != old.prim;
}

static int box_occluded(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	uint8_t hidden;

	box_occluded_n(a, q, ray, &hidden, 1, 0);
	return hidden;
}

static int box_stat(const ald_accel *a, uint32_t i, const char **name, double *value)
{
	if (i > 1)
		return 0;
	*name = i ? "memory" : "volumes";
	*value = i ? (double)a->flat.bytes : a->flat.ranges;
	return 1;
}

static int box_walk(const ald_accel *a, const ald_ray *only, ald_visit *visit, void *arg)
{
	ald_prep prep;

	if (only)
		ald_ray_prep(&a->flat.frame, only, &prep);
	for (uint32_t g = 0; g < a->flat.ranges; g++) {
		ald_volume v = { .kind = ALD_VOLUME_BOX, .depth = 0 };
		double t;

		v.prims = a->flat.range[g].end - a->flat.range[g].first;
		v.box = a->volume[g];
		if (only && !box_enter(a, g, &prep, only->tmin, only->tmax, &t))
			continue;
		if (visit(arg, &v) < 0)
			return -1;
	}
	return 0;
}

const ald_accel_plugin ald_accel_entry = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "box",
	.version = "1",
	.license = "Apache-2.0",
	.summary = "one axis-aligned box around each object",
	.precisions = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT | ALD_PRECISION_FAST,
	.build = box_build,
	.intersect = box_intersect,
	.destroy = box_destroy,
	.occluded = box_occluded,
	.intersect_n = box_intersect_n,
	.occluded_n = box_occluded_n,
	.stat = box_stat,
	.walk = box_walk,
};
