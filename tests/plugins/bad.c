/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A plugin that is wrong in the way that -DBAD_... asks for. Its constructor tells on itself, so that a
 * test can see whether any of its code was run.
 */
#include <alidade/accel.h>

#include <stdio.h>

#ifdef BAD_CONSTRUCTOR
__attribute__((constructor)) static void started(void)
{
	puts("code was run");
}
#endif

#ifndef BAD_NAME
#define BAD_NAME "bad"
#endif
#ifndef BAD_ABI
#define BAD_ABI ALD_ACCEL_ABI
#endif
#ifndef BAD_SIZE
#define BAD_SIZE sizeof(ald_accel_plugin)
#endif
#ifndef BAD_PRECISIONS
#define BAD_PRECISIONS ALD_PRECISION_DEFAULT
#endif
#ifndef BAD_INEXACT
#define BAD_INEXACT 0
#endif
#ifndef BAD_SUMMARY
#define BAD_SUMMARY "for tests"
#endif

static int bad_build(const ald_host *host, const ald_prims *prims, const double *value, ald_accel **out,
		     ald_error *err)
{
	(void)host;
	(void)prims;
	(void)value;
	(void)out;
	(void)err;
	return ALD_FAILED;
}

static int bad_intersect(const ald_accel *a, ald_query *q, const ald_ray *r, ald_hit *h)
{
	(void)a;
	(void)q;
	(void)r;
	(void)h;
	return 0;
}

static void bad_destroy(ald_accel *a)
{
	(void)a;
}

#ifdef BAD_PARAMS
static const ald_param params[] = { BAD_PARAMS, { NULL, NULL, 0, 0, 0, 0, NULL } };
#else
static const ald_param params[] = { { NULL, NULL, 0, 0, 0, 0, NULL } };
#endif

#ifdef BAD_FUNCTION
int not_a_structure(void) __asm__("ald_accel_entry");
__attribute__((visibility("default"))) int not_a_structure(void)
{
	return bad_build(NULL, NULL, NULL, NULL, NULL) + bad_intersect(NULL, NULL, NULL, NULL) +
	       (int)params[0].type + (bad_destroy(NULL), 0);
}
#else
#ifdef BAD_SYMBOL
#define ald_accel_entry BAD_SYMBOL
extern const ald_accel_plugin ald_accel_entry;
#endif
__attribute__((visibility("default"))) const ald_accel_plugin ald_accel_entry = {
	.abi = BAD_ABI,
	.size = BAD_SIZE,
	.name = BAD_NAME,
	.version = "1",
	.license = "Apache-2.0",
	.summary = BAD_SUMMARY,
	.params = params,
	.precisions = BAD_PRECISIONS,
	.build = bad_build,
#ifndef BAD_NO_INTERSECT
	.intersect = bad_intersect,
#endif
	.destroy = bad_destroy,
	.inexact = BAD_INEXACT,
};
#endif
