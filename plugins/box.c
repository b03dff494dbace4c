/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * box: one axis-aligned box around each object (the contract's groups).
 */
#include "flat.h"

static const ald_param params[] = { ISA_PARAM, { NULL, NULL, 0, 0, 0, 0, NULL } };

struct ald_accel {
	struct flat flat;
};

static void box_destroy(ald_accel *a)
{
	const ald_host *host = a->flat.host;

	flat_release(&a->flat);
	host->free(host->ctx, a);
}

static int box_build(const ald_host *host, const ald_prims *prims, const double *value, ald_accel **out,
		     ald_error *err)
{
	ald_accel *a = host->alloc(host->ctx, sizeof(*a), "volumes");
	int status;

	if (!a)
		return ALD_NO_MEMORY;
	status = flat_init(&a->flat, host, prims, FLAT_BOX, (unsigned)value[0], err);
	if (status)
		box_destroy(a);
	else
		*out = a;
	return status;
}

static int box_predict(const ald_host *host, const ald_prims *prims, const double *value, ald_memory *out)
{
	(void)host;
	(void)value;
	flat_predict(prims, FLAT_BOX, sizeof(ald_accel), out);
	return ALD_OK;
}

static void box_intersect_n(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n,
			     uint32_t hints)
{
	(void)hints;
	a->flat.isa->nearest(&a->flat, q, ray, hit, n);
}

static void box_occluded_n(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden, uint32_t n,
			    uint32_t hints)
{
	(void)hints;
	a->flat.isa->occluded(&a->flat, q, ray, hidden, n);
}

static int box_intersect(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	return flat_intersect(&a->flat, q, ray, hit);
}

static int box_occluded(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	return flat_occluded(&a->flat, q, ray);
}

static int box_stat(const ald_accel *a, uint32_t i, const char **name, double *value)
{
	return flat_stat(&a->flat, i, name, value);
}

static int box_walk(const ald_accel *a, const ald_ray *only, ald_visit *visit, void *arg)
{
	return flat_tour(&a->flat, only, visit, arg);
}

const ald_accel_plugin ald_accel_entry = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "box",
	.version = "1",
	.license = "Apache-2.0",
	.summary = "one axis-aligned box around each object",
	.params = params,
	.precisions = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT | ALD_PRECISION_FAST,
	.build = box_build,
	.intersect = box_intersect,
	.destroy = box_destroy,
	.occluded = box_occluded,
	.intersect_n = box_intersect_n,
	.occluded_n = box_occluded_n,
	.stat = box_stat,
	.walk = box_walk,
	.predict = box_predict,
};
