/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * An accelerator that lies: it keeps quiet about one primitive, in answer to one of the three questions, and is
 * right otherwise. For the test that alidade --verify finds it out.
 */
#include <alidade/accel.h>

enum { LIE_NEAREST, LIE_OCCLUDED, LIE_NEXT, LIE_NEVER };

struct ald_accel {
	const ald_host *host;
	const ald_prims *prims;
	int lie;
	uint32_t about;
};

static int liar_build(const ald_host *host, const ald_prims *prims, const double *value, ald_accel **out,
		      ald_error *err)
{
	ald_accel *a = host->alloc(host->ctx, sizeof(*a), "lies");

	(void)err;
	if (!a)
		return ALD_NO_MEMORY;
	a->host = host;
	a->prims = prims;
	a->lie = (int)value[0];
	a->about = (uint32_t)value[1];
	*out = a;
	return ALD_OK;
}

static int ask(const ald_accel *a, ald_query *q, const ald_ray *r, ald_hit *h, int lie)
{
	int any = 0;

	for (uint32_t i = 0; i < a->prims->count; i++) {
		if (!lie || i != a->about)
			any |= a->prims->intersect(a->prims, i, q, r, h);
	}
	return any;
}

static int liar_intersect(const ald_accel *a, ald_query *q, const ald_ray *r, ald_hit *h)
{
	return ask(a, q, r, h, a->lie == (r->after == ALD_NONE ? LIE_NEAREST : LIE_NEXT));
}

static int liar_occluded(const ald_accel *a, ald_query *q, const ald_ray *r)
{
	ald_hit h = { .t = r->tmax, .prim = ALD_NONE };

	return ask(a, q, r, &h, a->lie == LIE_OCCLUDED);
}

static void liar_destroy(ald_accel *a)
{
	a->host->free(a->host->ctx, a);
}

static const char *const label[] = { "nearest", "occluded", "next", "never", NULL };
static const ald_param params[] = {
	{ "lie", "to which question", ALD_CHOICE, LIE_NEVER, 0, 3, label },
	{ "about", "which primitive", ALD_INT, 0, 0, 4294967295.0, NULL },
	{ NULL, NULL, 0, 0, 0, 0, NULL },
};

const ald_accel_plugin ald_accel_entry = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "liar",
	.version = "1",
	.license = "Apache-2.0",
	.summary = "lies",
	.params = params,
	.precisions = ALD_PRECISION_DEFAULT,
	.build = liar_build,
	.intersect = liar_intersect,
	.destroy = liar_destroy,
	.occluded = liar_occluded,
};
