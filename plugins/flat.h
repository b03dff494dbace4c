/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What none, box and sphere have in common: ranges of primitives, each tested from end to end for those
 * rays of a batch that may hit something in it.
 *
 * Rays are taken in packs. All rays of a pack are tested with sixteen triangles, which stay in registers
 * meanwhile, then with the next sixteen: lines.h says how, and what that can't rule out is decided by
 * alidade/kernel.h. flat.c makes the structure, flat_walk.h is compiled for each instruction set.
 */
#ifndef FLAT_H
#define FLAT_H

#include <alidade/accel.h>
#include <alidade/fast.h>

#include "isa.h"
#include "lines.h"

struct range {
	uint32_t first, tris, end; /* ids first .. tris-1 are triangles, tris .. end-1 are not */
	uint32_t group; /* where its triangles begin */
};

enum flat_kind { FLAT_NONE, FLAT_BALL, FLAT_BOX };

struct ball {
	ald_vec centre;
	double radius;
};

struct flat;

struct flat_isa {
	void (*nearest)(const struct flat *, ald_query *, const ald_ray *, ald_hit *, uint32_t n);
	void (*occluded)(const struct flat *, ald_query *, const ald_ray *, uint8_t *, uint32_t n);
};

struct flat {
	const ald_host *host;
	const ald_prims *prims;
	const struct flat_isa *isa;
	enum flat_kind kind;
	ald_box box; /* around everything */
	ald_frame frame;
	struct space space;
	struct group *group;
	ald_fast_triangles *fast; /* two for each group with ALD_PRECISION_FAST, else NULL */
	struct range *range;
	uint32_t ranges;
	/* Around each range, one of these: */
	struct ball *ball;
	ald_box *volume;
	float (*tight)[8]; /* the same in floats and X: centre, half size (a ball: its radius, thrice) */
	uint64_t bytes;
};

extern const struct flat_isa flat_plain, flat_sse, flat_avx2, flat_avx512;

/* One range for everything (FLAT_NONE), or one for each of the contract's groups. isa: a parameter's value. */
int flat_init(struct flat *, const ald_host *, const ald_prims *, enum flat_kind, unsigned isa, ald_error *);
/* What flat_init() takes; of ald_accel, whose size is told, too. */
void flat_predict(const ald_prims *, enum flat_kind, size_t accel, ald_memory *out);
void flat_release(struct flat *);
int flat_intersect(const struct flat *, ald_query *, const ald_ray *, ald_hit *);
int flat_occluded(const struct flat *, ald_query *, const ald_ray *);
int flat_stat(const struct flat *, uint32_t i, const char **name, double *value);
int flat_tour(const struct flat *, const ald_ray *only, ald_visit *, void *arg);

/* Does the ray enter the volume around a range, at most as far as tmax, and where. */
ALD_INLINE int flat_enter(const struct flat *f, uint32_t range, const ald_prep *p, double tmin, double tmax,
			  double *enter)
{
	if (f->kind == FLAT_BALL)
		return ald_sphere_ray(p, &f->ball[range].centre, f->ball[range].radius, tmin, tmax, enter);
	return ald_box_ray(p, &f->volume[range], tmin, tmax, enter);
}

ALD_INLINE int flat_enter_fast(const struct flat *f, uint32_t range, const ald_fast_prep *p, double tmin, double tmax,
			       double *enter)
{
	if (f->kind == FLAT_BALL)
		return ald_fast_sphere_ray(p, &f->ball[range].centre, f->ball[range].radius, tmin, tmax, enter);
	return ald_fast_box_ray(p, &f->volume[range], tmin, tmax, enter);
}

#endif
