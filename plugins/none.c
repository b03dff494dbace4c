/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * none: no structure at all. Every ray is tested with every primitive, as fast as the machine can; what
 * this answers is what every other accelerator has to answer, to the bit.
 */
#include "flat.h"

static const ald_param params[] = { ISA_PARAM, { NULL, NULL, 0, 0, 0, 0, NULL } };

struct ald_accel {
	struct flat flat;
};

static void none_destroy(ald_accel *a)
{
	const ald_host *host = a->flat.host;

	flat_release(&a->flat);
	host->free(host->ctx, a);
}

static int none_build(const ald_host *host, const ald_prims *prims, const double *value, ald_accel **out,
		      ald_error *err)
{
	ald_accel *a = host->alloc(host->ctx, sizeof(*a), "volumes");
	int status;

	if (!a)
		return ALD_NO_MEMORY;
	status = flat_init(&a->flat, host, prims, FLAT_NONE, (unsigned)value[0], err);
	if (status)
		none_destroy(a);
	else
		*out = a;
	return status;
}

static int none_predict(const ald_host *host, const ald_prims *prims, const double *value, ald_memory *out)
{
	(void)host;
	(void)value;
	flat_predict(prims, FLAT_NONE, sizeof(ald_accel), out);
	return ALD_OK;
}

static void none_intersect_n(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n,
			     uint32_t hints)
{
	(void)hints;
	a->flat.isa->nearest(&a->flat, q, ray, hit, n);
}

static void none_occluded_n(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden, uint32_t n,
			    uint32_t hints)
{
	(void)hints;
	a->flat.isa->occluded(&a->flat, q, ray, hidden, n);
}

static int none_intersect(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	return flat_intersect(&a->flat, q, ray, hit);
}

static int none_occluded(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	return flat_occluded(&a->flat, q, ray);
}

static int none_stat(const ald_accel *a, uint32_t i, const char **name, double *value)
{
	return flat_stat(&a->flat, i, name, value);
}

const ald_accel_plugin ald_accel_entry = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "none",
	.version = "1",
	.license = "Apache-2.0",
	.summary = "no structure: every ray is tested with every primitive",
	.params = params,
	.precisions = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT | ALD_PRECISION_FAST,
	.build = none_build,
	.intersect = none_intersect,
	.destroy = none_destroy,
	.occluded = none_occluded,
	.intersect_n = none_intersect_n,
	.occluded_n = none_occluded_n,
	.stat = none_stat,
	.predict = none_predict,
};
