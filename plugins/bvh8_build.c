/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Building a bvh8: boxes of the primitives, then a binary tree over them (bvh8_sah.c, bvh8_fast.c), then
 * the wide one (bvh8_wide.c).
 */
#if defined __linux__ && !defined _DEFAULT_SOURCE
#define _DEFAULT_SOURCE /* madvise() */
#endif
#include "bvh8_corner.h"
#include "bvh8_fast.h"

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
	uint32_t all; /* whether all can */
};

struct scan {
	struct builder *b;
	struct chunk *chunk;
	struct grid grid;
};

/* The triangles with the outermost sides: no other's bounds, grown by the same, can be farther out. */
struct outer {
	d2 lo_xy, hi_xy, lo_z, hi_z;
	uint32_t id[6]; /* low sides, high sides */
};

V void outer_add(struct outer *o, const struct corners *v, uint32_t id)
{
	d2 lo_xy = d2_min(d2_min(v->xy[0], v->xy[1]), v->xy[2]), lo_z = d2_min(d2_min(v->z[0], v->z[1]), v->z[2]);
	d2 hi_xy = d2_max(d2_max(v->xy[0], v->xy[1]), v->xy[2]), hi_z = d2_max(d2_max(v->z[0], v->z[1]), v->z[2]);
	unsigned lo = d2_less(lo_xy, o->lo_xy) | d2_less(lo_z, o->lo_z) << 2;
	unsigned hi = d2_less(o->hi_xy, hi_xy) | d2_less(o->hi_z, hi_z) << 2;

	if (!(lo | hi))
		return;
	o->lo_xy = d2_min(lo_xy, o->lo_xy);
	o->lo_z = d2_min(lo_z, o->lo_z);
	o->hi_xy = d2_max(hi_xy, o->hi_xy);
	o->hi_z = d2_max(hi_z, o->hi_z);
	for (unsigned k = 0; k < 3; k++) {
		if (lo >> k & 1)
			o->id[k] = id;
		if (hi >> k & 1)
			o->id[3 + k] = id;
	}
}

/* 0: it can't be hit: some number is none, or two corners are one, and no line meets that. */
V int can_be_hit(const struct corners *c)
{
	unsigned number = 3;
	d2 none = d2_two(0, 0);

	UNROLL for (unsigned k = 0; k < 3; k++) {
		number &= d2_same(d2_sub(c->xy[k], c->xy[k]), none);
		number &= d2_same(d2_sub(c->z[k], c->z[k]), none);
		if ((d2_same(c->xy[k], c->xy[(k + 1) % 3]) & d2_same(c->z[k], c->z[(k + 1) % 3])) == 3)
			return 0;
	}
	return number == 3;
}

static void scan_job(void *arg, uint32_t job)
{
	struct scan *s = arg;
	const ald_prims *p = s->b->prims;
	struct chunk c = { ald_box_empty(), 0, 0 };
	uint32_t end = p->count - job * CHUNK < CHUNK ? p->count : (job + 1) * CHUNK, first = job * CHUNK;
	struct outer o = { .lo_xy = d2_two(DBL_MAX, DBL_MAX), .hi_xy = d2_two(-DBL_MAX, -DBL_MAX) };
	struct corners v;
	ald_box box;

	o.lo_z = o.lo_xy;
	o.hi_z = o.hi_xy;
	for (unsigned k = 0; k < 6; k++)
		o.id[k] = first;
	for (uint32_t id = first; id < end; id++) {
		int valid = 1;

		if (id < p->tri_count) {
			read_corners(p, id, &v);
			valid = can_be_hit(&v);
		}
		c.valid += (uint32_t)valid;
		if (!valid || id >= p->tri_count) {
			p->bounds(p, id, &box);
			ald_box_join(&c.box, &box);
		} else {
			outer_add(&o, &v, id);
		}
	}
	for (unsigned k = 0; k < 6; k++) {
		p->bounds(p, o.id[k], &box);
		ald_box_join(&c.box, &box);
	}
	s->chunk[job] = c;
}

int bvh8_can_be_hit(const ald_prims *p, uint32_t id)
{
	struct corners v;

	if (id >= p->tri_count)
		return 1;
	read_corners(p, id, &v);
	return can_be_hit(&v);
}

static void ref_job(void *arg, uint32_t job)
{
	struct scan *s = arg;
	const struct builder *b = s->b;
	const ald_prims *p = b->prims;
	uint32_t end = p->count - job * CHUNK < CHUNK ? p->count : (job + 1) * CHUNK;
	uint32_t at = s->chunk[job].valid, all = s->chunk[job].all;
	struct to_x x = to_x(b->a);
	hull h;

	for (uint32_t id = job * CHUNK; id < end; id++) {
		if (!all && !bvh8_can_be_hit(p, id))
			continue;
		h = prim_hull(b->a, &x, p, id);
		if (b->key) {
			b->key[at++] = grid_key(&s->grid, hull_mid(h), id);
			continue;
		}
		ref_store(&b->ref[at], h);
		b->ref[at].id = id;
		b->ref[at++].zero = 0;
	}
}

/* From the scene's box the coordinates X. The box is that of all bounds(), as in other accelerators: the
 * kernel's own bounds depend on it. */
void bvh8_place(ald_accel *a, const ald_box *box)
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

/* Cells for the middles, doubled, of all that is in the scene's box. */
static struct grid scene_grid(const ald_accel *a)
{
	float half[4] __attribute__((aligned(16))) = { 0 }, most = 0;

	for (unsigned k = 0; k < 3; k++) {
		half[k] = (float)((ald_get(&a->box.hi, k) - a->centre[k]) * a->scale);
		most = half[k] > most ? half[k] : most;
	}
	return grid_of(q4_mul(q4_load(half), q4_all(-2)), 4 * most, CELLS);
}

/* Measured, in nanoseconds: what building fast saves of each triangle, and what its tree costs each ray more, which
 * grows with the tree. Where triangles are to be cut, far more is saved and lost: about as much at RAYS_THIN rays to a
 * triangle. */
#define SAVED 155.0
#define RAYS_THIN 2.0

static double lost(double refs)
{
	double ns = 10 + 15 * log10(refs / 1e5);

	return ns > 5 ? ns : 5;
}

int bvh8_is_fast(struct builder *b)
{
	const ald_host *h = b->host;
	double rays = h->size > offsetof(ald_host, rays) ? h->rays : 0;

	if (b->value[P_BUILD] != BUILD_AUTO)
		return b->value[P_BUILD] == BUILD_FAST;
	if (!(rays > 0) || !b->refs || rays * lost(b->refs) > SAVED * b->refs)
		return 0;
	return rays < RAYS_THIN * b->refs || !bvh8_is_thin(b);
}

int bvh8_refs(struct builder *b)
{
	const ald_host *h = b->host;
	uint32_t jobs = (b->prims->count + CHUNK - 1) / CHUNK, refs = 0;
	struct scan s = { .b = b, .chunk = bvh8_take(h, jobs, sizeof(*s.chunk), "bvh8: building") };
	ald_box box = ald_box_empty();

	if (!s.chunk)
		return ALD_NO_MEMORY;
	h->parallel(h->ctx, jobs, scan_job, &s);
	for (uint32_t i = 0; i < jobs; i++) {
		uint32_t n = s.chunk[i].valid;

		ald_box_join(&box, &s.chunk[i].box);
		s.chunk[i].all = n == (b->prims->count - i * CHUNK < CHUNK ? b->prims->count - i * CHUNK : CHUNK);
		s.chunk[i].valid = refs;
		refs += n;
	}
	if (!b->prims->count)
		box = (ald_box){ { 0, 0, 0 }, { 0, 0, 0 } };
	bvh8_place(b->a, &box);
	b->refs = b->room = refs;
	b->a->hasty = b->fast = bvh8_is_fast(b);
	if (b->fast)
		b->key = bvh8_take(h, refs, sizeof(*b->key), "bvh8: building");
	else
		b->ref = bvh8_take(h, refs, sizeof(*b->ref), "bvh8: building");
	s.grid = scene_grid(b->a);
	if (b->ref || b->key)
		h->parallel(h->ctx, jobs, ref_job, &s);
	h->free(h->ctx, s.chunk);
	return b->ref || b->key ? ALD_OK : ALD_NO_MEMORY;
}
