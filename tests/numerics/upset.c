/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A library that changes how its process computes and writes numbers as soon as it is loaded, as libraries built
 * with -ffast-math and careless plugins do; with UPSET_PLUGIN it is the accelerator none too, and does the same
 * each time it is called. Made and loaded by bits.sh.
 */
#include <fenv.h>
#include <locale.h>
#include <xmmintrin.h>

enum { FLUSH_TO_ZERO = 0x8000, DENORMALS_ARE_ZERO = 0x40 };

static void upset_arithmetic(void)
{
	fesetround(FE_UPWARD);
	_mm_setcsr(_mm_getcsr() | FLUSH_TO_ZERO | DENORMALS_ARE_ZERO);
}

__attribute__((constructor)) static void upset(void)
{
	upset_arithmetic();
	setlocale(LC_ALL, "");
}

#ifdef UPSET_PLUGIN
#define ald_accel_entry none_entry
#include "../../plugins/none.c"
#undef ald_accel_entry

static int upset_build(const ald_host *h, const ald_prims *p, const double *value, ald_accel **out, ald_error *e)
{
	int result = none_entry.build(h, p, value, out, e);

	upset_arithmetic();
	return result;
}

static int upset_intersect(const ald_accel *a, ald_query *q, const ald_ray *r, ald_hit *hit)
{
	int result = none_entry.intersect(a, q, r, hit);

	upset_arithmetic();
	return result;
}

static void upset_destroy(ald_accel *a)
{
	none_entry.destroy(a);
}

static void upset_intersect_n(const ald_accel *a, ald_query *q, const ald_ray *r, ald_hit *hit, uint32_t n,
			      uint32_t hints)
{
	none_entry.intersect_n(a, q, r, hit, n, hints);
	upset_arithmetic();
}

static void upset_occluded_n(const ald_accel *a, ald_query *q, const ald_ray *r, uint8_t *hidden, uint32_t n,
			     uint32_t hints)
{
	none_entry.occluded_n(a, q, r, hidden, n, hints);
	upset_arithmetic();
}

__attribute__((visibility("default"))) const ald_accel_plugin ald_accel_entry = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "none",
	.version = "1",
	.license = "Apache-2.0",
	.summary = "none, and careless",
	.precisions = ALD_PRECISION_DEFAULT,
	.build = upset_build,
	.intersect = upset_intersect,
	.destroy = upset_destroy,
	.intersect_n = upset_intersect_n,
	.occluded_n = upset_occluded_n,
};
#endif
