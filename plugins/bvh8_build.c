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
	if (p && n * each >= HUGE_PAGE) { /* walks miss the cache; not the page table, too */
		uintptr_t from = (uintptr_t)p & ~(uintptr_t)4095; /* else the first huge page is none */

		(void)madvise((void *)from, (uintptr_t)p - from + (size_t)(n * each), MADV_HUGEPAGE);
	}
#endif
	return p;
}

void bvh8_touch(const void *p, size_t from, size_t to)
{
#if defined __linux__ && defined MADV_POPULATE_WRITE
	uintptr_t at = ((uintptr_t)p + from + 4095) & ~(uintptr_t)4095, end = ((uintptr_t)p + to) & ~(uintptr_t)4095;

	if (end > at)
		(void)madvise((void *)at, end - at, MADV_POPULATE_WRITE);
#else
	(void)p;
	(void)from;
	(void)to;
#endif
}

struct fresh {
	const char *p;
	size_t bytes, before; /* in the first huge page, before p */
};

static void touch_job(void *arg, uint32_t job)
{
	const struct fresh *f = arg;
	size_t end = (job + (size_t)1) * HUGE_PAGE - f->before;

	bvh8_touch(f->p, job ? end - HUGE_PAGE : 0, end < f->bytes ? end : f->bytes);
}

void bvh8_touch_all(const ald_host *h, const void *p, size_t bytes)
{
	struct fresh f = { p, bytes, (uintptr_t)p % HUGE_PAGE };

	if (h->threads > 1 && bytes > HUGE_PAGE)
		h->parallel(h->ctx, (uint32_t)((f.before + bytes + HUGE_PAGE - 1) / HUGE_PAGE), touch_job, &f);
}

struct scan {
	const ald_prims *prims;
	ald_box *box; /* of a chunk's bounds */
	struct builder *b; /* not needed for that */
	uint32_t *valid; /* of a chunk: primitives that can be hit */
};

static uint32_t end_of(const ald_prims *p, uint32_t job)
{
	return p->count - job * CHUNK < CHUNK ? p->count : (job + 1) * CHUNK;
}

static void box_job(void *arg, uint32_t job)
{
	struct scan *s = arg;
	const ald_prims *p = s->prims;
	ald_box all = ald_box_empty(), box;

	for (uint32_t id = job * CHUNK; id < end_of(p, job); id++) {
		p->bounds(p, id, &box);
		ald_box_join(&all, &box);
	}
	s->box[job] = all;
}

int bvh8_find_box(const ald_host *h, const ald_prims *p, ald_box *box)
{
	uint32_t jobs = (p->count + CHUNK - 1) / CHUNK;
	struct scan s = { .prims = p };

	*box = (ald_box){ { 0, 0, 0 }, { 0, 0, 0 } };
	if (!p->count)
		return ALD_OK;
	if (p->size >= offsetof(ald_prims, box) + sizeof(p->box)) {
		*box = p->box;
		if (box->lo.x <= box->hi.x && box->lo.y <= box->hi.y && box->lo.z <= box->hi.z)
			return ALD_OK;
	}
	s.box = bvh8_take(h, jobs, sizeof(*s.box), "bvh8: building");
	if (!s.box)
		return ALD_NO_MEMORY;
	h->parallel(h->ctx, jobs, box_job, &s);
	*box = ald_box_empty();
	for (uint32_t i = 0; i < jobs; i++)
		ald_box_join(box, &s.box[i]);
	h->free(h->ctx, s.box);
	return ALD_OK;
}

int bvh8_can_be_hit(const ald_prims *p, uint32_t id)
{
	d4 v[3];

	if (id >= p->tri_count)
		return 1;
	read_corners(p, id, v);
	return can_be_hit(v);
}

static void ref_job(void *arg, uint32_t job)
{
	struct scan *s = arg;
	const struct builder *b = s->b;
	const ald_prims *p = b->prims;
	uint32_t end = end_of(p, job), at = job * CHUNK;
	struct to_x x = to_x(b->a);
	d4 c[3];

	for (uint32_t id = job * CHUNK; id < end; id++) {
		hull h;

		if (id < p->tri_count) {
			q4 v[3];

			read_corners(p, id, c);
			if (!can_be_hit(c))
				continue;
			corners_x(&x, c, v);
			h = corners_hull(v);
		} else {
			h = prim_hull(b->a, &x, p, id);
		}
		ref_store(&b->ref[at], h);
		b->ref[at].id = id;
		b->ref[at++].zero = 0;
	}
	s->valid[job] = at - job * CHUNK;
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

/* Boxes in the order of primitives, without gaps. */
static int make_refs(struct scan *s, uint32_t jobs)
{
	struct builder *b = s->b;
	const ald_host *h = b->host;

	b->ref = bvh8_take(h, b->refs, sizeof(*b->ref), "bvh8: building");
	s->valid = bvh8_take(h, jobs, sizeof(*s->valid), "bvh8: building");
	if (!b->ref || !s->valid) {
		h->free(h->ctx, s->valid);
		return ALD_NO_MEMORY;
	}
	bvh8_touch_all(h, b->ref, b->refs * sizeof(*b->ref));
	h->parallel(h->ctx, jobs, ref_job, s);
	b->refs = 0;
	for (uint32_t i = 0; i < jobs; i++) {
		if (b->refs < i * CHUNK)
			memmove(&b->ref[b->refs], &b->ref[i * CHUNK], s->valid[i] * sizeof(*b->ref));
		b->refs += s->valid[i];
	}
	b->room = b->a->held = b->refs;
	h->free(h->ctx, s->valid);
	return ALD_OK;
}

int bvh8_refs(struct builder *b)
{
	uint32_t jobs = (b->prims->count + CHUNK - 1) / CHUNK;
	struct scan s = { .prims = b->prims, .b = b };
	ald_box box;
	int status = bvh8_find_box(b->host, b->prims, &box);

	if (status)
		return status;
	bvh8_place(b->a, &box);
	b->refs = b->room = b->prims->count;
	b->a->hasty = b->fast = bvh8_is_fast(b);
	return b->fast ? ALD_OK : make_refs(&s, jobs);
}
