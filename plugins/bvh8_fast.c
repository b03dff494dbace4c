/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's fast builder. References are sorted by which of 2^21 cells they are in, along a Morton curve (Lauterbach
 * and others: Fast BVH Construction on GPUs, 2009), and where too many are in one cell, that again, by its own cells.
 * Runs of whole cells are crops, of which each is a job (bvh8_crop.h) that leaves a few trees; over these goes a top
 * by the surface area heuristic (Garanzha, Pantaleoni, McAllister: Simpler and Faster HLBVH with Work Queues, 2011).
 * Nothing depends on the number of threads: sorting is stable, and what is one job is not decided by it.
 */
#include "bvh8_corner.h"
#include "bvh8_fast.h"
#include "bvh8_part.h"

#define PIECE 32768u /* references that one job looks at together */
#define LOW_BITS 11u /* of a code, sorted first */
#define HIGH_BITS 10u
#define ZOOMS 6u /* cells in cells */

struct sorter {
	const struct fast *f;
	uint64_t *from, *to;
	uint32_t first, n, pieces, shift, mask;
	uint32_t (*count)[1u << LOW_BITS]; /* of a piece: of each digit; then, where its next goes */
	struct range *bound; /* of a piece */
	struct grid grid;
};

static void piece_of(const struct sorter *s, uint32_t job, uint32_t *first, uint32_t *end)
{
	*first = s->first + job * PIECE;
	*end = s->n - job * PIECE < PIECE ? s->first + s->n : *first + PIECE;
}

static void bound_job(void *arg, uint32_t job)
{
	const struct sorter *s = arg;
	const struct builder *b = s->f->b;
	struct to_x x = to_x(b->a);
	struct range r;
	uint32_t first, end;

	range_clear(&r);
	piece_of(s, job, &first, &end);
	for (uint32_t i = first; i < end; i++) {
		hull h = prim_hull(b->a, &x, b->prims, (uint32_t)s->from[i]);

		range_add(&r, h, hull_mid(h));
	}
	s->bound[job] = r;
}

static void code_job(void *arg, uint32_t job)
{
	const struct sorter *s = arg;
	const struct builder *b = s->f->b;
	struct to_x x = to_x(b->a);
	uint32_t first, end;

	piece_of(s, job, &first, &end);
	for (uint32_t i = first; i < end; i++) {
		uint32_t id = (uint32_t)s->from[i];

		s->from[i] = grid_key(&s->grid, hull_mid(prim_hull(b->a, &x, b->prims, id)), id);
	}
}

static void count_job(void *arg, uint32_t job)
{
	const struct sorter *s = arg;
	uint32_t *count = s->count[job], first, end;

	piece_of(s, job, &first, &end);
	memset(count, 0, sizeof(*s->count));
	for (uint32_t i = first; i < end; i++)
		count[s->from[i] >> s->shift & s->mask]++;
}

static void move_job(void *arg, uint32_t job)
{
	const struct sorter *s = arg;
	uint32_t *at = s->count[job], first, end;

	piece_of(s, job, &first, &end);
	for (uint32_t i = first; i < end; i++)
		s->to[at[s->from[i] >> s->shift & s->mask]++] = s->from[i];
}

static void deal(const struct sorter *s)
{
	uint32_t at = s->first;

	for (uint32_t i = 0; i <= s->mask; i++) {
		for (uint32_t p = 0; p < s->pieces; p++) {
			uint32_t n = s->count[p][i];

			s->count[p][i] = at;
			at += n;
		}
	}
}

/* From the middles' bounds to cells. 0: all are in one place. */
static int cells(struct sorter *s)
{
	float size[4] __attribute__((aligned(16))), most;
	struct range all;

	range_clear(&all);
	for (uint32_t i = 0; i < s->pieces; i++)
		range_join(&all, &s->bound[i]);
	q4_store(size, q4_sub(all.hi, all.lo));
	most = size[0] > size[1] ? size[0] : size[1];
	most = most > size[2] ? most : size[2];
	s->grid = grid_of(all.lo, most, CELLS);
	return most > 0x1p-60f;
}

static void sort(struct sorter *s)
{
	const ald_host *h = s->f->b->host;

	s->shift = 32;
	s->mask = (1u << LOW_BITS) - 1;
	h->parallel(h->ctx, s->pieces, count_job, s);
	deal(s);
	h->parallel(h->ctx, s->pieces, move_job, s);
	s->from = s->f->spare;
	s->to = s->f->b->key;
	s->shift = 32 + LOW_BITS;
	s->mask = (1u << HIGH_BITS) - 1;
	h->parallel(h->ctx, s->pieces, count_job, s);
	deal(s);
	h->parallel(h->ctx, s->pieces, move_job, s);
}

static int add_crop(struct fast *f, uint32_t first, uint32_t count)
{
	const ald_host *h = f->b->host;
	struct crop *more;

	if (f->crops == f->room) {
		more = bvh8_take(h, 2 * (uint64_t)f->room, sizeof(*more), "bvh8: building");
		if (!more)
			return ALD_NO_MEMORY;
		memcpy(more, f->crop, f->crops * sizeof(*more));
		h->free(h->ctx, f->crop);
		f->crop = more;
		f->room *= 2;
	}
	f->crop[f->crops++] = (struct crop){ .first = first, .count = count };
	return ALD_OK;
}

static uint32_t cell_of(const struct fast *f, uint32_t i)
{
	return (uint32_t)(f->b->key[i] >> 32);
}

static int make_crops(struct fast *f, uint32_t first, uint32_t n, uint32_t round);

/* Runs of cells, as many as a crop holds; larger cells are divided. */
static int divide(struct fast *f, uint32_t first, uint32_t n, uint32_t round)
{
	uint32_t end = first + n;
	int status = ALD_OK;

	for (uint32_t at = first, to; at < end && !status; at = to) {
		to = end - at > CROP ? at + CROP : end;
		while (to < end && to > at && cell_of(f, to - 1) == cell_of(f, to))
			to--;
		if (to > at) {
			status = add_crop(f, at, to - at);
			continue;
		}
		for (to = at + CROP; to < end && cell_of(f, to) == cell_of(f, at);)
			to++;
		status = make_crops(f, at, to - at, round + 1);
	}
	return status;
}

static int make_crops(struct fast *f, uint32_t first, uint32_t n, uint32_t round)
{
	const ald_host *h = f->b->host;
	struct sorter s = { .f = f, .from = f->b->key, .to = f->spare, .first = first, .n = n };
	int status = ALD_OK, more = n > CROP && round < ZOOMS;

	if (h->progress(h->ctx, 0.1))
		return ALD_CANCELLED;
	s.pieces = (n + PIECE - 1) / PIECE;
	if (more) {
		s.count = bvh8_take(h, s.pieces, sizeof(*s.count), "bvh8: building");
		s.bound = bvh8_take(h, s.pieces, sizeof(*s.bound), "bvh8: building");
		status = s.count && s.bound ? ALD_OK : ALD_NO_MEMORY;
		if (!status && round) { /* else the codes are there */
			h->parallel(h->ctx, s.pieces, bound_job, &s);
			more = cells(&s);
			if (more)
				h->parallel(h->ctx, s.pieces, code_job, &s);
		}
		if (!status && more)
			sort(&s);
		h->free(h->ctx, s.count);
		h->free(h->ctx, s.bound);
		if (!status && more)
			return divide(f, first, n, round);
	}
	for (uint32_t at = 0; at < n && !status; at += CROP)
		status = add_crop(f, first + at, n - at < CROP ? n - at : CROP);
	return status;
}

/* ---- the top ---- */

struct crown {
	struct builder *b;
	const struct twig *tip;
	uint32_t twigs; /* where the next two go */
	uint32_t steep; /* levels after which ranges are halved, so that no tree is deeper than LEVELS_MAX */
};

/* id: of a reference, the part which it stands for. */
static void crown_grow(struct crown *c, struct ref *ref, struct range *r)
{
	struct builder *b = c->b;
	struct range left = *r, right = *r;
	struct split s = { FAR, 3, 0 };
	struct bins bins;
	uint32_t at = 0, kid = c->twigs;

	if (r->count == 1) {
		b->twig[r->twig] = c->tip[ref->id];
		b->part[1 + ref->id].twig = r->twig;
		return;
	}
	if (r->depth < c->steep) {
		bins_begin(&bins, r);
		bins_add(&bins, ref, r->count);
		s = best_split(&bins);
	}
	if (s.axis < 3)
		at = part(ref, r->count, &bins, &s, &left, &right);
	if (!at || at == r->count) {
		at = r->count / 2;
		halve(ref, r->count, at, r);
		measure(ref, at, &left);
		measure(ref + at, r->count - at, &right);
	}
	set_twig(&b->twig[r->twig], r, kid, 0);
	c->twigs += 2;
	left.count = at;
	right.count = r->count - at;
	left.twig = kid;
	right.twig = kid + 1;
	left.depth = right.depth = r->depth + 1;
	crown_grow(c, ref, &left);
	crown_grow(c, ref + at, &right);
}

/* Tips together, parts with them. */
static uint32_t gather(struct fast *f)
{
	struct builder *b = f->b;
	uint32_t n = 0;

	for (uint32_t i = 0; i < f->crops; i++) {
		for (uint32_t k = 0; k < f->crop[i].tips; k++, n++) {
			f->tip[n] = f->tip[TIPS * i + k];
			b->part[1 + n] = b->part[1 + TIPS * i + k];
		}
	}
	return n;
}

static int crown(struct fast *f)
{
	struct builder *b = f->b;
	const ald_host *h = b->host;
	struct crown c = { .b = b, .tip = f->tip, .twigs = b->root + 1, .steep = LEVELS_MAX - DEEP };
	struct range root = { .twig = b->root };
	struct ref *ref;

	b->tasks = root.count = gather(f);
	ref = bvh8_take(h, root.count, sizeof(*ref), "bvh8: building");
	if (!ref)
		return ALD_NO_MEMORY;
	for (uint32_t i = 0; i < root.count; i++) {
		ref[i].id = i;
		ref[i].zero = 0;
		for (unsigned k = 0; k < 3; k++) {
			ref[i].lo[k] = f->tip[i].lo[k];
			ref[i].minus_hi[k] = -f->tip[i].hi[k];
		}
	}
	for (uint32_t n = root.count; n; n /= 2)
		c.steep -= c.steep > 0;
	measure(ref, root.count, &root);
	b->whole = hull_area(root.box) > 0 ? hull_area(root.box) : 1;
	crown_grow(&c, ref, &root);
	b->top = (c.twigs - b->root - 1) / 2;
	h->free(h->ctx, ref);
	return ALD_OK;
}

/* What does not depend on how many crops there will be. The room of seats serves for sorting before. */
static int take_first(struct fast *f)
{
	struct builder *b = f->b;
	const ald_host *h = b->host;
	int one = b->value[P_LEAF] < SEATS || b->prims->tri_count < b->prims->count;

	b->twigs_a_ref = one ? 2 : 1;
	if (b->refs > UINT32_MAX / 4)
		return ALD_NO_MEMORY;
	b->root = b->twigs_a_ref * b->refs;
	f->room = 2 * (b->refs / CROP) + 8;
	f->crop = bvh8_take(h, f->room, sizeof(*f->crop), "bvh8: building");
	b->seat = bvh8_take(h, (b->root + 1) / 2, sizeof(*b->seat), "bvh8: building");
	f->spare = (uint64_t *)(void *)b->seat;
	return f->crop && b->seat ? ALD_OK : ALD_NO_MEMORY;
}

static int take_rest(struct fast *f)
{
	struct builder *b = f->b;
	const ald_host *h = b->host;
	uint64_t tips = TIPS * (uint64_t)f->crops;

	b->twig = bvh8_take(h, b->root + 2 * tips, sizeof(*b->twig), "bvh8: building");
	b->top_seat = bvh8_take(h, tips, sizeof(*b->top_seat), "bvh8: building");
	b->part = bvh8_take(h, tips + 1, sizeof(*b->part), "bvh8: building");
	f->tip = bvh8_take(h, tips, sizeof(*f->tip), "bvh8: building");
	if (!b->twig || !b->top_seat || !b->part || !f->tip)
		return ALD_NO_MEMORY;
	b->part[0] = (struct part){ .seat = b->top_seat };
	return ALD_OK;
}

int bvh8_fast(struct builder *b, void (*crop)(void *fast, uint32_t i))
{
	const ald_host *h = b->host;
	struct fast f = { .b = b };
	int status = take_first(&f);

	if (!status)
		status = make_crops(&f, 0, b->refs, 0);
	if (!status)
		status = take_rest(&f);
	if (!status) {
		h->parallel(h->ctx, f.crops, crop, &f);
		if (f.crops)
			status = crown(&f);
	}
	h->free(h->ctx, f.crop);
	h->free(h->ctx, f.tip);
	return status;
}
