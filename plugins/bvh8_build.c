/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Building a bvh8: boxes of the primitives, then a binary tree over them (bvh8_sah.c, bvh8_morton.c), then
 * the wide one (bvh8_wide.c).
 */
#if defined __linux__ && !defined _DEFAULT_SOURCE
#define _DEFAULT_SOURCE /* madvise() */
#endif
#include "bvh8.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

#define CHUNK 4096u /* primitives a job looks at */

void *bvh8_take(const ald_host *host, uint64_t n, size_t each, const char *what)
{
	void *p;

	if (n > SIZE_MAX / each)
		return NULL;
	p = host->alloc(host->ctx, n ? (size_t)n * each : 1, what);
#if defined __linux__ && defined MADV_HUGEPAGE
	if (p && n * each >= (size_t)2 << 20) { /* walks miss the cache; not the page table, too */
		uintptr_t from = ((uintptr_t)p + 4095) & ~(uintptr_t)4095;

		(void)madvise((void *)from, (size_t)(n * each) - 4096, MADV_HUGEPAGE);
	}
#endif
	return p;
}

struct chunk {
	ald_box box;
	uint32_t valid; /* primitives that can be hit; then: where its first reference goes */
};

struct scan {
	struct builder *b;
	struct chunk *chunk;
};

static int same(const ald_vec *a, const ald_vec *b)
{
	return a->x == b->x && a->y == b->y && a->z == b->z;
}

/* 0: it can't be hit: some number is none, or two corners are one, and no line meets that. Triangles:
 * the box that holds them tightly, which the rays' errors take care of. */
static int box_of(const ald_prims *p, uint32_t id, ald_box *box)
{
	ald_vec v[3];
	double sum = 0;

	if (id >= p->tri_count) {
		p->bounds(p, id, box);
		return 1;
	}
	ald_corners(p, id, p->origin ? ald_group_of(p, id) : 0, v);
	*box = (ald_box){ v[0], v[0] };
	for (unsigned k = 0; k < 3; k++) {
		ald_box point = { v[k], v[k] };

		ald_box_join(box, &point);
		sum += (v[k].x - v[k].x) + (v[k].y - v[k].y) + (v[k].z - v[k].z);
	}
	return sum == 0 && !same(&v[0], &v[1]) && !same(&v[1], &v[2]) && !same(&v[2], &v[0]);
}

/* The triangles with the outermost sides: no other's bounds, grown by the same, can be farther out. */
struct outer {
	double side[6]; /* low, and high negated */
	uint32_t id[6];
};

static void outer_add(struct outer *o, const ald_box *box, uint32_t id)
{
	for (unsigned k = 0; k < 6; k++) {
		double x = k < 3 ? ald_get(&box->lo, k) : -ald_get(&box->hi, k - 3);

		if (x < o->side[k]) {
			o->side[k] = x;
			o->id[k] = id;
		}
	}
}

static void scan_job(void *arg, uint32_t job)
{
	struct scan *s = arg;
	const ald_prims *p = s->b->prims;
	struct chunk c = { ald_box_empty(), 0 };
	uint32_t end = p->count - job * CHUNK < CHUNK ? p->count : (job + 1) * CHUNK, first = job * CHUNK;
	struct outer o;
	ald_box box;

	for (unsigned k = 0; k < 6; k++) {
		o.side[k] = DBL_MAX;
		o.id[k] = first;
	}
	for (uint32_t id = first; id < end; id++) {
		int valid = box_of(p, id, &box);

		c.valid += (uint32_t)valid;
		if (!valid || id >= p->tri_count) {
			p->bounds(p, id, &box);
			ald_box_join(&c.box, &box);
		} else {
			outer_add(&o, &box, id);
		}
	}
	for (unsigned k = 0; k < 6; k++) {
		p->bounds(p, o.id[k], &box);
		ald_box_join(&c.box, &box);
	}
	s->chunk[job] = c;
}

static void ref_job(void *arg, uint32_t job)
{
	struct scan *s = arg;
	const struct builder *b = s->b;
	const ald_prims *p = b->prims;
	uint32_t end = p->count - job * CHUNK < CHUNK ? p->count : (job + 1) * CHUNK;
	struct ref *r = b->ref + s->chunk[job].valid;
	ald_box box;

	for (uint32_t id = job * CHUNK; id < end; id++) {
		if (!box_of(p, id, &box))
			continue;
		for (unsigned k = 0; k < 3; k++) {
			r->lo[k] = ald_float_down((ald_get(&box.lo, k) - b->a->centre[k]) * b->a->scale);
			r->minus_hi[k] = -ald_float_up((ald_get(&box.hi, k) - b->a->centre[k]) * b->a->scale);
		}
		r->id = id;
		r->zero = 0;
		r++;
	}
}

/* From the scene's box the coordinates X. The box is that of all bounds(), as in other accelerators: the
 * kernel's own bounds depend on it. */
static void place(ald_accel *a, const ald_box *box)
{
	double size = 0;
	int power;

	a->box = *box;
	for (unsigned k = 0; k < 3; k++) {
		double lo = (&box->lo.x)[k], hi = (&box->hi.x)[k];

		a->centre[k] = lo + (hi - lo) / 2;
		size = ald_max((hi - lo) / 2 * (1 + 4 * ALD_U), size);
	}
	frexp(size, &power);
	a->scale = ldexp(1, power < -900 || size == 0 ? 900 : -power);
	a->frame = ald_frame_for(a->prims, &a->box);
}

int bvh8_refs(struct builder *b)
{
	const ald_host *h = b->host;
	uint32_t jobs = (b->prims->count + CHUNK - 1) / CHUNK, refs = 0;
	struct scan s = { b, bvh8_take(h, jobs, sizeof(*s.chunk), "bvh8: building") };
	ald_box box = ald_box_empty();

	if (!s.chunk)
		return ALD_NO_MEMORY;
	h->parallel(h->ctx, jobs, scan_job, &s);
	for (uint32_t i = 0; i < jobs; i++) {
		uint32_t n = s.chunk[i].valid;

		ald_box_join(&box, &s.chunk[i].box);
		s.chunk[i].valid = refs;
		refs += n;
	}
	if (!b->prims->count)
		box = (ald_box){ { 0, 0, 0 }, { 0, 0, 0 } };
	place(b->a, &box);
	b->refs = b->room = refs;
	b->ref = bvh8_take(h, refs, sizeof(*b->ref), "bvh8: building");
	if (b->ref)
		h->parallel(h->ctx, jobs, ref_job, &s);
	h->free(h->ctx, s.chunk);
	return b->ref ? ALD_OK : ALD_NO_MEMORY;
}
