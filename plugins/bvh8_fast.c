/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's fast builder. References are sorted by which of 2^21 cells they are in, along a Morton curve (Lauterbach
 * and others: Fast BVH Construction on GPUs, 2009), and where too many are in one cell, that again, by its own cells.
 * Runs of whole cells are crops, of which each is made a few trees (bvh8_crop.h), and these one (bvh8_crown.c).
 * Nothing depends on the number of threads but where in memory what one crop has been made stands: sorting is stable,
 * and what is one crop is not decided by it.
 */
#include "bvh8_corner.h"
#include "bvh8_fast.h"

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
	uint32_t *count = s->count[job], odd[1u << LOW_BITS], first, end, i;

	piece_of(s, job, &first, &end);
	memset(count, 0, sizeof(*s->count));
	memset(odd, 0, sizeof(odd)); /* neighbours mostly have one digit, and would wait for each other */
	for (i = first; i + 1 < end; i += 2) {
		count[s->from[i] >> s->shift & s->mask]++;
		odd[s->from[i + 1] >> s->shift & s->mask]++;
	}
	if (i < end)
		count[s->from[i] >> s->shift & s->mask]++;
	for (i = 0; i <= s->mask; i++)
		count[i] += odd[i];
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

/* What does not depend on how many crops there will be. */
static int take_first(struct fast *f)
{
	struct builder *b = f->b;
	const ald_host *h = b->host;

	f->room = 2 * (b->refs / CROP) + 8;
	f->crop = bvh8_take(h, f->room, sizeof(*f->crop), "bvh8: building");
	f->spare = bvh8_take(h, b->refs, sizeof(*f->spare), "bvh8: building");
	return f->crop && f->spare ? ALD_OK : ALD_NO_MEMORY;
}

static int take_rest(struct fast *f, size_t desk)
{
	const ald_host *h = f->b->host;

	f->tip = bvh8_take(h, TIPS * (uint64_t)f->crops, sizeof(*f->tip), "bvh8: building");
	f->desk = bvh8_take(h, h->threads, desk, "bvh8: building");
	return f->tip && f->desk ? ALD_OK : ALD_NO_MEMORY;
}

static int take_tree(struct fast *f)
{
	ald_accel *a = f->b->a;
	const ald_host *h = f->b->host;

	a->node = bvh8_take(h, f->node_room, sizeof(*a->node), "bvh8: nodes");
	a->block = bvh8_take(h, f->block_room, sizeof(*a->block), "bvh8: triangles");
	a->other = bvh8_take(h, f->other_room, sizeof(*a->other), "bvh8: references");
	return a->node && a->block && a->other ? ALD_OK : ALD_NO_MEMORY;
}

/* One try, with the room that there is. */
static int grow(struct fast *f, void (*crop)(void *fast, uint32_t desk))
{
	const ald_host *h = f->b->host;
	int status = take_tree(f);

	f->next = 0;
	f->nodes = f->blocks = f->others = 0;
	if (status)
		return status;
	h->parallel(h->ctx, h->threads, crop, f);
	return h->progress(h->ctx, 0.8) ? ALD_CANCELLED : bvh8_crown(f);
}

static int fits(const struct fast *f)
{
	return f->nodes <= f->node_room && f->blocks <= f->block_room && f->others <= f->other_room;
}

/* Where there is too little room, all there is to know is how much would have been enough. */
static int grow_twice(struct fast *f, void (*crop)(void *fast, uint32_t desk))
{
	const struct builder *b = f->b;
	const ald_host *h = b->host;
	ald_accel *a = b->a;
	int status;

	fast_room(b, &f->node_room, &f->block_room, &f->other_room);
	status = grow(f, crop);
	if (status || fits(f))
		return status;
	h->free(h->ctx, a->node);
	h->free(h->ctx, a->block);
	h->free(h->ctx, a->other);
	a->node = NULL;
	a->block = NULL;
	a->other = NULL;
	f->block_room = f->blocks;
	f->node_room = f->nodes;
	f->other_room = f->others;
	if (f->nodes >= REF_LEAF || f->blocks > REF_INDEX || f->others > REF_INDEX)
		return ALD_NO_MEMORY;
	return grow(f, crop);
}

static void trim(const struct fast *f, void *p, uint64_t n, size_t each)
{
	const ald_host *h = f->b->host;

	if (h->size > offsetof(ald_host, trim) && h->trim)
		h->trim(h->ctx, p, n * each);
}

static void tell(const struct fast *f)
{
	struct builder *b = f->b;
	ald_accel *a = b->a;

	trim(f, a->node, f->nodes, sizeof(*a->node));
	trim(f, a->block, f->blocks, sizeof(*a->block));
	trim(f, a->other, f->others, sizeof(*a->other));
	a->nodes = (uint32_t)f->nodes;
	a->blocks = (uint32_t)f->blocks;
	a->others = (uint32_t)f->others;
	a->refs = b->refs;
	a->bytes += a->nodes * sizeof(*a->node) + a->blocks * sizeof(*a->block) + a->others * sizeof(*a->other);
	for (uint32_t i = 0; i < f->crops; i++) {
		a->leaves += f->crop[i].leaves;
		a->cost += f->crop[i].cost / (double)b->whole;
	}
}

int bvh8_fast(struct builder *b, void (*crop)(void *fast, uint32_t desk), size_t desk)
{
	const ald_host *h = b->host;
	struct fast f = { .b = b };
	int status;

	b->a->root = EMPTY;
	if (!b->refs)
		return ALD_OK;
	status = take_first(&f);
	if (!status)
		status = make_crops(&f, 0, b->refs, 0);
	h->free(h->ctx, f.spare);
	if (!status)
		status = take_rest(&f, desk);
	if (!status)
		status = grow_twice(&f, crop);
	if (!status)
		tell(&f);
	h->free(h->ctx, f.crop);
	h->free(h->ctx, f.tip);
	h->free(h->ctx, f.desk);
	return status;
}
