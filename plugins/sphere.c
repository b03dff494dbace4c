/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * sphere: one bounding sphere around each object (the contract's groups), centred on the middle of its
 * box, as small as its furthest corner lets it be.
 */
#include "flat.h"

static const ald_param params[] = { ISA_PARAM, { NULL, NULL, 0, 0, 0, 0, NULL } };

struct ald_accel {
	struct flat flat;
};

static void sphere_destroy(ald_accel *a)
{
	const ald_host *host = a->flat.host;

	flat_release(&a->flat);
	host->free(host->ctx, a);
}

static int sphere_build(const ald_host *host, const ald_prims *prims, const double *value, ald_accel **out,
		        ald_error *err)
{
	ald_accel *a = host->alloc(host->ctx, sizeof(*a), "volumes");
	int status;

	if (!a)
		return ALD_NO_MEMORY;
	status = flat_init(&a->flat, host, prims, FLAT_BALL, (unsigned)value[0], err);
	if (status)
		sphere_destroy(a);
	else
		*out = a;
	return status;
}

static int sphere_predict(const ald_host *host, const ald_prims *prims, const double *value, ald_memory *out)
{
	(void)host;
	(void)value;
	flat_predict(prims, FLAT_BALL, sizeof(ald_accel), out);
	return ALD_OK;
}

static void sphere_intersect_n(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n,
			     uint32_t hints)
{
	(void)hints;
	a->flat.isa->nearest(&a->flat, q, ray, hit, n);
}

static void sphere_occluded_n(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden, uint32_t n,
			    uint32_t hints)
{
	(void)hints;
	a->flat.isa->occluded(&a->flat, q, ray, hidden, n);
}

static int sphere_intersect(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	return flat_intersect(&a->flat, q, ray, hit);
}

static int sphere_occluded(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	return flat_occluded(&a->flat, q, ray);
}

static int sphere_stat(const ald_accel *a, uint32_t i, const char **name, double *value)
{
	return flat_stat(&a->flat, i, name, value);
}

static int sphere_walk(const ald_accel *a, const ald_ray *only, ald_visit *visit, void *arg)
{
	return flat_tour(&a->flat, only, visit, arg);
}

const ald_accel_plugin ald_accel_entry = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "sphere",
	.version = "1",
	.license = "Apache-2.0",
	.summary = "one bounding sphere around each object",
	.params = params,
	.precisions = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT | ALD_PRECISION_FAST,
	.build = sphere_build,
	.intersect = sphere_intersect,
	.destroy = sphere_destroy,
	.occluded = sphere_occluded,
	.intersect_n = sphere_intersect_n,
	.occluded_n = sphere_occluded_n,
	.stat = sphere_stat,
	.walk = sphere_walk,
	.predict = sphere_predict,
};
