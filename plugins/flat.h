/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What none, box and sphere have in common: ranges of primitives, each tested from end to end for those
 * rays of a batch that may hit something in it.
 *
 * Triangles are copied, eight by eight, so that one ray meets eight at a time. Rays are taken in
 * packs and triangles in blocks that stay in the cache while the whole pack passes over them. Functions
 * are inlined into their callers, which are compiled for several instruction sets (WIDE); the bits are
 * the same on all.
 */
#ifndef FLAT_H
#define FLAT_H

#include <alidade/accel.h>
#include <alidade/fast.h>
#include <alidade/kernel.h>

#define PACK 64u /* rays */
#define BLOCKS 32u /* of ALD_LANES triangles: 18 KiB */

#if defined __x86_64__ && defined __GNUC__ && !defined __AVX2__ && !defined __SANITIZE_ADDRESS__
#define WIDE __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define WIDE
#endif

struct range {
	uint32_t first, tris, end; /* ids first .. tris-1 are triangles, tris .. end-1 are not */
	uint32_t block; /* where its triangles begin */
};

struct flat {
	const ald_host *host;
	const ald_prims *prims;
	ald_box box; /* around everything */
	ald_frame frame;
	ald_triangles *block; /* one of these two is NULL */
	ald_fast_triangles *fast; /* ALD_PRECISION_FAST */
	struct range *range;
	uint32_t ranges;
	uint64_t bytes;
};

struct pack {
	const struct flat *flat;
	ald_query *q;
	const ald_ray *ray;
	ald_hit *hit;
	uint32_t n;
	ald_prep prep[PACK]; /* of these two one is used */
	ald_fast_prep fast[PACK];
	uint8_t live[PACK]; /* to be tested with the range at hand */
	uint8_t found[PACK]; /* a better hit was found in it */
};

static void flat_release(struct flat *f)
{
	f->host->free(f->host->ctx, f->block);
	f->host->free(f->host->ctx, f->fast);
	f->host->free(f->host->ctx, f->range);
}

static void flat_box(const ald_prims *p, uint32_t first, uint32_t end, ald_box *out)
{
	ald_box box;

	*out = ald_box_empty();
	for (uint32_t i = first; i < end; i++) {
		p->bounds(p, i, &box);
		ald_box_join(out, &box);
	}
}

static void flat_fill(struct flat *f, const struct range *r, uint32_t group)
{
	const double nan = ALD_NAN;
	uint32_t n = r->tris - r->first;

	for (uint32_t i = 0; i < (n + ALD_LANES - 1) / ALD_LANES * ALD_LANES; i++) {
		ald_vec v[3] = { { nan, nan, nan }, { nan, nan, nan }, { nan, nan, nan } };

		if (i < n) {
			uint32_t id = r->first + i;

			if (f->prims->origin && group == ALD_NONE)
				ald_corners(f->prims, id, ald_group_of(f->prims, id), v);
			else
				ald_corners(f->prims, id, group, v);
		}
		if (f->fast)
			ald_fast_triangles_set(&f->fast[r->block + i / ALD_LANES], i % ALD_LANES, v);
		else
			ald_triangles_set(&f->block[r->block + i / ALD_LANES], i % ALD_LANES, v);
	}
}

/* One range for everything, or one for each group. */
static int flat_init(struct flat *f, const ald_host *host, const ald_prims *prims, int by_group)
{
	uint32_t blocks = 0;
	size_t each;

	*f = (struct flat){ .host = host, .prims = prims, .ranges = by_group ? prims->group_count : 1 };
	flat_box(prims, 0, prims->count, &f->box);
	if (!prims->count)
		f->box = (ald_box){ { 0, 0, 0 }, { 0, 0, 0 } };
	f->frame = ald_frame_for(prims, &f->box);
	f->range = host->alloc(host->ctx, (f->ranges + (size_t)1) * sizeof(*f->range), "volumes");
	if (!f->range)
		return ALD_NO_MEMORY;
	for (uint32_t g = 0; g < f->ranges; g++) {
		uint32_t first = by_group ? prims->group_first[g] : 0;
		uint32_t end = by_group ? prims->group_first[g + 1] : prims->count;
		uint32_t tris = end < prims->tri_count ? end : prims->tri_count;

		if (tris < first)
			tris = first;
		f->range[g] = (struct range){ first, tris, end, blocks };
		blocks += (tris - first + ALD_LANES - 1) / ALD_LANES;
	}
	if (prims->precision == ALD_PRECISION_FAST) {
		each = sizeof(*f->fast);
		f->fast = host->alloc(host->ctx, (blocks + (size_t)1) * each, "triangles");
	} else {
		each = sizeof(*f->block);
		f->block = host->alloc(host->ctx, (blocks + (size_t)1) * each, "triangles");
	}
	if (!f->block && !f->fast)
		return ALD_NO_MEMORY;
	for (uint32_t g = 0; g < f->ranges; g++)
		flat_fill(f, &f->range[g], by_group ? g : ALD_NONE);
	f->bytes = blocks * each + f->ranges * sizeof(*f->range);
	return ALD_OK;
}

ALD_INLINE int flat_confirm(struct pack *p, uint32_t i, const ald_triangles *b, uint32_t bits, uint32_t id)
{
	int found = 0;

	for (; bits; bits &= bits - 1) {
		unsigned k = (unsigned)__builtin_ctz(bits);
		ald_vec v[3];

		if (!ald_sees(p->flat->prims, &p->ray[i], id + k))
			continue;
		for (unsigned j = 0; j < 3; j++)
			v[j] = (ald_vec){ b->v[j][0][k], b->v[j][1][k], b->v[j][2][k] };
		found |= ald_triangle(&p->prep[i], &p->ray[i], v, id + k, &p->hit[i]);
	}
	return found;
}

ALD_INLINE int flat_confirm_fast(struct pack *p, uint32_t i, const ald_fast_triangles *b, uint32_t bits, uint32_t id)
{
	int found = 0;

	for (; bits; bits &= bits - 1) {
		unsigned k = (unsigned)__builtin_ctz(bits);

		if (ald_sees(p->flat->prims, &p->ray[i], id + k))
			found |= ald_fast_triangle(&p->fast[i], &p->ray[i], b, k, id + k, &p->hit[i]);
	}
	return found;
}

/* Ray i against blocks from .. to-1 of a range; returns how many it was tested with (with any: up to
 * the block that hid it). */
ALD_INLINE uint32_t flat_one(struct pack *p, uint32_t i, const struct range *r, uint32_t from,
			     uint32_t to, int any, int fast)
{
	const struct flat *f = p->flat;
	uint32_t n = r->tris - r->first;

	for (uint32_t at = from; at < to; at++) {
		uint32_t b = r->block + at, id = r->first + at * ALD_LANES;
		uint32_t bits = fast ? ald_fast_triangle_n(&p->fast[i], &f->fast[b]) :
				       ald_triangle_n(&p->prep[i], &f->block[b]);

		if (bits && (fast ? flat_confirm_fast(p, i, &f->fast[b], bits, id) :
				    flat_confirm(p, i, &f->block[b], bits, id))) {
			p->found[i] = 1;
			if (any) {
				to = at + 1;
				break;
			}
		}
	}
	return (to * ALD_LANES < n ? to * ALD_LANES : n) - from * ALD_LANES;
}

ALD_INLINE void flat_triangles(struct pack *p, const struct range *r, int any, int fast)
{
	uint32_t blocks = (r->tris - r->first + ALD_LANES - 1) / ALD_LANES;
	uint64_t tests = 0;

	for (uint32_t at = 0; at < blocks; at += BLOCKS) {
		uint32_t to = blocks - at < BLOCKS ? blocks : at + BLOCKS;

		for (uint32_t i = 0; i < p->n; i++) {
			if (p->live[i] && !(any && p->found[i]))
				tests += flat_one(p, i, r, at, to, any, fast);
		}
	}
	if (p->q->count)
		p->q->count[ALD_COUNT_PRIMS] += tests;
}

ALD_INLINE void flat_others(struct pack *p, const struct range *r, int any)
{
	const ald_prims *prims = p->flat->prims;
	ald_hit old[PACK];
	uint8_t live[PACK];

	for (uint32_t id = r->tris; id < r->end; id++) {
		uint32_t seen = 0, tests = 0;

		for (uint32_t i = 0; i < p->n; i++) {
			int test = p->live[i] && !(any && p->found[i]);

			live[i] = test && ald_sees(prims, &p->ray[i], id);
			tests += (uint32_t)test;
			seen += live[i];
			old[i] = p->hit[i];
		}
		if (p->q->count)
			p->q->count[ALD_COUNT_PRIMS] += tests;
		if (!seen)
			continue;
		prims->intersect_n(prims, id, p->q, p->ray, p->hit, live, p->n);
		for (uint32_t i = 0; i < p->n; i++)
			p->found[i] |= live[i] &&
				       (p->hit[i].t != old[i].t || p->hit[i].prim != old[i].prim);
	}
}

ALD_INLINE void flat_begin(struct pack *p, const struct flat *f, ald_query *q, const ald_ray *ray,
			   ald_hit *hit, uint32_t n, int fast)
{
	p->flat = f;
	p->q = q;
	p->ray = ray;
	p->hit = hit;
	p->n = n;
	memset(p->found, 0, sizeof(p->found));
	for (uint32_t i = 0; i < n; i++) {
		if (fast)
			ald_fast_ray(&ray[i], &p->fast[i]);
		else
			ald_ray_prep(&f->frame, &ray[i], &p->prep[i]);
	}
}

/* Does a ray enter the volume around a range, at most as far as tmax, and where. NULL for such functions: there
 * is no volume. */
struct flat_volume {
	int (*enter)(const ald_accel *, uint32_t range, const ald_prep *, double tmin, double tmax, double *enter);
	int (*fast)(const ald_accel *, uint32_t range, const ald_fast_prep *, double tmin, double tmax,
		    double *enter);
};

/* Which rays have to be tested with a range: those that meet its volume before what they have hit (R3).
 * Returns how many. */
ALD_INLINE uint32_t flat_meet(struct pack *p, const ald_accel *a, uint32_t range, const struct flat_volume *volume,
			      int any, int fast)
{
	uint32_t tests = 0, hits = 0;

	for (uint32_t i = 0; i < p->n; i++) {
		double t, far = p->hit[i].t;

		p->live[i] = !(any && p->found[i]);
		tests += p->live[i];
		if (volume && p->live[i] && fast)
			p->live[i] = volume->fast(a, range, &p->fast[i], p->ray[i].tmin, far, &t) && !(t > far);
		else if (volume && p->live[i])
			p->live[i] = volume->enter(a, range, &p->prep[i], p->ray[i].tmin, far, &t) && !(t > far);
		hits += p->live[i];
	}
	if (volume && p->q->count) {
		p->q->count[ALD_COUNT_VOLUME_TESTS] += tests;
		p->q->count[ALD_COUNT_VOLUME_HITS] += hits;
	}
	return hits;
}

ALD_INLINE void flat_pack(struct pack *p, const ald_accel *a, const struct flat_volume *volume, int any, int fast)
{
	const struct flat *f = p->flat;

	for (uint32_t r = 0; r < f->ranges; r++) {
		uint32_t useful = 0, before = 0;

		if (!flat_meet(p, a, r, volume, any, fast))
			continue;
		for (uint32_t i = 0; i < p->n; i++) {
			p->found[i] = any && p->found[i];
			before += p->found[i];
		}
		flat_triangles(p, &f->range[r], any, fast);
		if (f->range[r].tris < f->range[r].end)
			flat_others(p, &f->range[r], any);
		for (uint32_t i = 0; i < p->n; i++)
			useful += p->found[i];
		if (volume && p->q->count)
			p->q->count[ALD_COUNT_VOLUME_USEFUL] += useful - before;
	}
}

ALD_INLINE void flat_nearest(const struct flat *f, const ald_accel *a, const struct flat_volume *volume, ald_query *q,
			     const ald_ray *ray, ald_hit *hit, uint32_t n)
{
	struct pack p;

	for (uint32_t at = 0; at < n; at += PACK) {
		uint32_t m = n - at < PACK ? n - at : PACK;

		flat_begin(&p, f, q, ray + at, hit + at, m, !!f->fast);
		if (f->fast)
			flat_pack(&p, a, volume, 0, 1);
		else
			flat_pack(&p, a, volume, 0, 0);
	}
}

ALD_INLINE void flat_occluded(const struct flat *f, const ald_accel *a, const struct flat_volume *volume, ald_query *q,
			      const ald_ray *ray, uint8_t *hidden, uint32_t n)
{
	ald_hit hit[PACK];
	struct pack p;

	for (uint32_t at = 0; at < n; at += PACK) {
		uint32_t m = n - at < PACK ? n - at : PACK;

		for (uint32_t i = 0; i < m; i++)
			hit[i] = (ald_hit){ .t = ray[at + i].tmax, .prim = ALD_NONE };
		flat_begin(&p, f, q, ray + at, hit, m, !!f->fast);
		if (f->fast)
			flat_pack(&p, a, volume, 1, 1);
		else
			flat_pack(&p, a, volume, 1, 0);
		memcpy(hidden + at, p.found, m);
	}
}

#endif
