/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * An accelerator that accelerates nothing, with the plainest code that keeps the rules: the oracle that
 * tests hold plugins against, and what is used when no plugin was chosen.
 */
#include "accel/geometry.h"

struct ald_accel {
	const ald_host *host;
	const ald_prims *prims;
	ald_frame frame;
};

static int brute_build(const ald_host *host, const ald_prims *prims, const double *value, ald_accel **out,
		       ald_error *err)
{
	ald_accel *a = host->alloc(host->ctx, sizeof(*a), "brute force");
	ald_box all = ald_box_empty(), b;

	(void)value;
	(void)err;
	if (!a)
		return ALD_NO_MEMORY;
	for (uint32_t i = 0; i < prims->count; i++) {
		prims->bounds(prims, i, &b);
		ald_box_join(&all, &b);
	}
	*a = (ald_accel){ host, prims, ald_frame_for(prims, &all) };
	*out = a;
	return ALD_OK;
}

static int brute_predict(const ald_host *host, const ald_prims *prims, const double *value, ald_memory *out)
{
	(void)host;
	(void)prims;
	(void)value;
	*out = (ald_memory){ sizeof(ald_accel), sizeof(ald_accel), 0 };
	return ALD_OK;
}

static int brute_intersect(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	const ald_prims *p = a->prims;
	uint32_t group = 0;
	ald_prep prep;
	ald_vec v[3];
	int any = 0;

	ald_ray_prep(&a->frame, ray, &prep);
	for (uint32_t i = 0; i < p->count; i++) {
		if (!ald_sees(p, ray, i))
			continue;
		if (q->count)
			q->count[ALD_COUNT_PRIMS]++;
		if (i >= p->tri_count) {
			any |= p->intersect(p, i, q, ray, hit);
			continue;
		}
		while (p->origin && p->group_first[group + 1] <= i)
			group++;
		ald_corners(p, i, group, v);
		any |= ald_triangle(&prep, ray, v, i, hit);
	}
	return any;
}

static void brute_destroy(ald_accel *a)
{
	if (a)
		a->host->free(a->host->ctx, a);
}

const ald_accel_plugin accel_brute = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "brute",
	.version = "1",
	.license = "Apache-2.0",
	.summary = "every primitive, one after the other",
	.precisions = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT,
	.build = brute_build,
	.intersect = brute_intersect,
	.destroy = brute_destroy,
	.predict = brute_predict,
};
