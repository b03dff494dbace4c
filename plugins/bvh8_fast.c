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

#define HIGH_BITS 10u
#define ZOOMS 6u /* cells in cells */
#define CROPS_OF(n) ((n) / (CROP / 4) + 1) /* crops that so many references make at most: see divide() */

/* Where crops go: the whole list, or a stretch of it, for what one job makes. */
struct list {
	struct crop *crop;
	uint32_t n, room;
};

struct sorter {
	const struct fast *f;
	uint64_t *from, *to;
	uint32_t first, n, pieces, shift, mask;
	uint32_t (*count)[1u << LOW_BITS]; /* of a piece: of each digit; then, where its next goes */
	struct range *bound; /* of a piece */
	struct grid grid;
	int alone; /* within a job */
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
	uint32_t first, end;

	piece_of(s, job, &first, &end);
	count_digits(&s->from[first], end - first, s->shift, s->mask, s->count[job]);
}

static void move_job(void *arg, uint32_t job)
{
	const struct sorter *s = arg;
	uint32_t *at = s->count[job], first, end;

	piece_of(s, job, &first, &end);
	for (uint32_t i = first; i < end; i++)
		s->to[at[s->from[i] >> s->shift & s->mask]++] = s->from[i];
}

/* Each piece's first of each digit, in the order in which they stand in memory. */
static void deal(const struct sorter *s)
{
	uint32_t next[1u << LOW_BITS] = { 0 }, at = s->first;

	for (uint32_t p = 0; p < s->pieces; p++) {
		for (uint32_t i = 0; i <= s->mask; i++)
			next[i] += s->count[p][i];
	}
	for (uint32_t i = 0; i <= s->mask; i++) {
		uint32_t n = next[i];

		next[i] = at;
		at += n;
	}
	for (uint32_t p = 0; p < s->pieces; p++) {
		for (uint32_t i = 0; i <= s->mask; i++) {
			uint32_t n = s->count[p][i];

			s->count[p][i] = next[i];
			next[i] += n;
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

static void each_piece(struct sorter *s, void (*job)(void *sorter, uint32_t piece))
{
	const ald_host *h = s->f->b->host;

	if (!s->alone) {
		h->parallel(h->ctx, s->pieces, job, s);
		return;
	}
	for (uint32_t i = 0; i < s->pieces; i++)
		job(s, i);
}

/* counted: by the lower digit, already. */
static void sort(struct sorter *s, int counted)
{
	s->shift = 32;
	s->mask = (1u << LOW_BITS) - 1;
	if (!counted)
		each_piece(s, count_job);
	deal(s);
	each_piece(s, move_job);
	s->from = s->f->spare;
	s->to = s->f->b->key;
	s->shift = 32 + LOW_BITS;
	s->mask = (1u << HIGH_BITS) - 1;
	each_piece(s, count_job);
	deal(s);
	each_piece(s, move_job);
}

static int add_crop(struct fast *f, struct list *l, uint32_t first, uint32_t count)
{
	const ald_host *h = f->b->host;
	struct crop *more;

	if (l->n == l->room) {
		more = bvh8_take(h, 2 * (uint64_t)l->room, sizeof(*more), "bvh8: building");
		if (!more)
			return ALD_NO_MEMORY;
		memcpy(more, l->crop, l->n * sizeof(*more));
		h->free(h->ctx, l->crop);
		l->crop = more;
		l->room *= 2;
	}
	l->crop[l->n++] = (struct crop){ .first = first, .count = count };
	return ALD_OK;
}

/* To be divided, see zoom_all(). */
static int add_later(struct fast *f, struct list *l, uint32_t first, uint32_t count, uint32_t round)
{
	int status = add_crop(f, l, first, count);

	if (!status)
		l->crop[l->n - 1].round = round;
	return status;
}

static uint32_t cell_of(const struct fast *f, uint32_t i)
{
	return (uint32_t)(f->b->key[i] >> 32);
}

static int make_crops(struct fast *f, struct list *l, uint32_t first, uint32_t n, uint32_t round);
static void zoom(struct fast *f, struct list *l, uint32_t first, uint32_t n, uint32_t round);

/* Runs of cells, as many as a crop holds; larger cells are divided, by one job each unless they are huge. Two runs
 * that are neighbours are more than a crop together, and so is each of the larger cells: hence CROPS_OF. */
static int divide(struct fast *f, struct list *l, uint32_t first, uint32_t n, uint32_t round, int alone)
{
	uint32_t end = first + n;
	int status = ALD_OK;

	for (uint32_t at = first, to; at < end && !status; at = to) {
		to = end - at > CROP ? at + CROP : end;
		while (to < end && to > at && cell_of(f, to - 1) == cell_of(f, to))
			to--;
		if (to > at) {
			status = add_crop(f, l, at, to - at);
			continue;
		}
		for (to = at + CROP; to < end && cell_of(f, to) == cell_of(f, at);)
			to++;
		if (alone)
			zoom(f, l, at, to - at, round + 1);
		else if (to - at > PIECE)
			status = make_crops(f, l, at, to - at, round + 1);
		else
			status = add_later(f, l, at, to - at, round + 1);
	}
	return status;
}

static int cut_evenly(struct fast *f, struct list *l, uint32_t first, uint32_t n)
{
	int status = ALD_OK;

	for (uint32_t at = 0; at < n && !status; at += CROP)
		status = add_crop(f, l, first + at, n - at < CROP ? n - at : CROP);
	return status;
}

/* What is in one place: by cells of its own. 0: it can't be told apart. */
static int zoom_in(struct sorter *s, uint32_t round)
{
	if (round >= ZOOMS)
		return 0;
	each_piece(s, bound_job);
	if (!cells(s))
		return 0;
	each_piece(s, code_job);
	sort(s, 0);
	return 1;
}

static void zoom(struct fast *f, struct list *l, uint32_t first, uint32_t n, uint32_t round)
{
	uint32_t count[1][1u << LOW_BITS];
	struct range bound;
	struct sorter s = { .f = f, .from = f->b->key, .to = f->spare, .first = first, .n = n, .pieces = 1,
			    .count = count, .bound = &bound, .alone = 1 };

	if (zoom_in(&s, round))
		divide(f, l, first, n, round, 1);
	else
		cut_evenly(f, l, first, n);
}

static int make_crops(struct fast *f, struct list *l, uint32_t first, uint32_t n, uint32_t round)
{
	const ald_host *h = f->b->host;
	struct sorter s = { .f = f, .from = f->b->key, .to = f->spare, .first = first, .n = n };
	int status = ALD_OK, told_apart = 0;

	if (h->progress(h->ctx, 0.1))
		return ALD_CANCELLED;
	if (n <= CROP)
		return add_crop(f, l, first, n);
	s.pieces = (n + PIECE - 1) / PIECE;
	s.count = round ? bvh8_take(h, s.pieces, sizeof(*s.count), "bvh8: building") : f->count;
	s.bound = bvh8_take(h, s.pieces, sizeof(*s.bound), "bvh8: building");
	if (!s.count || !s.bound) {
		status = ALD_NO_MEMORY;
	} else if (round) {
		told_apart = zoom_in(&s, round);
	} else { /* the codes are there */
		sort(&s, f->counted);
		told_apart = 1;
	}
	if (round)
		h->free(h->ctx, s.count);
	h->free(h->ctx, s.bound);
	if (status)
		return status;
	return told_apart ? divide(f, l, first, n, round, 0) : cut_evenly(f, l, first, n);
}

struct zooms {
	struct fast *f;
	const struct crop *from;
	struct list *to; /* of each: a stretch of the new list */
};

static void zoom_job(void *arg, uint32_t job)
{
	const struct zooms *z = arg;
	const struct crop *c = &z->from[job];

	if (c->count > CROP)
		zoom(z->f, &z->to[job], c->first, c->count, c->round);
	else
		add_crop(z->f, &z->to[job], c->first, c->count);
}

/* Cells that are crops for now, and too large, are divided, each by one job. */
static int zoom_all(struct fast *f, struct list *l)
{
	const ald_host *h = f->b->host;
	struct zooms z = { .f = f, .from = l->crop };
	uint64_t room = 0;
	struct list all;

	for (uint32_t i = 0; i < l->n; i++)
		room += l->crop[i].count > CROP ? CROPS_OF(l->crop[i].count) : 1;
	if (room == l->n)
		return ALD_OK;
	all = (struct list){ .crop = bvh8_take(h, room, sizeof(*all.crop), "bvh8: building") };
	z.to = bvh8_take(h, l->n, sizeof(*z.to), "bvh8: building");
	if (!all.crop || !z.to) {
		h->free(h->ctx, all.crop);
		h->free(h->ctx, z.to);
		return ALD_NO_MEMORY;
	}
	room = 0;
	for (uint32_t i = 0; i < l->n; i++) {
		uint32_t most = l->crop[i].count > CROP ? CROPS_OF(l->crop[i].count) : 1;

		z.to[i] = (struct list){ .crop = &all.crop[room], .room = most };
		room += most;
	}
	h->parallel(h->ctx, l->n, zoom_job, &z);
	for (uint32_t i = 0; i < l->n; i++) {
		memmove(&all.crop[all.n], z.to[i].crop, z.to[i].n * sizeof(*all.crop));
		all.n += z.to[i].n;
	}
	h->free(h->ctx, l->crop);
	h->free(h->ctx, z.to);
	*l = all;
	return ALD_OK;
}

/* ---- keys ---- */

/* Cells for the middles of all that is in the scene's box. */
static struct coder coder_of(struct fast *f)
{
	const ald_accel *a = f->b->a;
	float low[4] __attribute__((aligned(16))) = { 0 };
	double half[3], most = 0, k;

	for (unsigned i = 0; i < 3; i++) {
		half[i] = (ald_get(&a->box.hi, i) - a->centre[i]) * a->scale;
		low[i] = (float)(-2 * half[i]);
		most = ald_max(half[i], most);
	}
	k = most > 0x1p-60 ? 0.9999 * (double)CELLS / (4 * most) : 0;
	return (struct coder){ .scale = k * a->scale,
			       .from = { -2 * k * half[0], -2 * k * half[1], -2 * k * half[2] },
			       .grid = grid_of(q4_load(low), (float)(4 * most), CELLS),
			       .f = f };
}

/* Codes, in the order of primitives and without gaps, and how often each lower digit is in each piece. */
static int make_keys(struct fast *f, void (*key)(void *coder, uint32_t job))
{
	struct builder *b = f->b;
	const ald_host *h = b->host;
	struct coder s = coder_of(f);

	s.pieces = (b->refs + PIECE - 1) / PIECE;
	f->count = bvh8_take(h, s.pieces, sizeof(*f->count), "bvh8: building");
	b->key = bvh8_take(h, b->refs, sizeof(*b->key), "bvh8: building");
	s.valid = bvh8_take(h, s.pieces, sizeof(*s.valid), "bvh8: building");
	if (!f->count || !b->key || !s.valid) {
		h->free(h->ctx, s.valid);
		return ALD_NO_MEMORY;
	}
	h->parallel(h->ctx, (s.pieces + h->threads - 1) / h->threads * h->threads, key, &s);
	b->refs = 0;
	f->counted = 1;
	for (uint32_t i = 0; i < s.pieces; i++) {
		if (b->refs < i * PIECE) {
			memmove(&b->key[b->refs], &b->key[i * PIECE], s.valid[i] * sizeof(*b->key));
			f->counted = 0;
		}
		b->refs += s.valid[i];
	}
	b->room = b->a->held = b->refs;
	h->free(h->ctx, s.valid);
	return ALD_OK;
}

/* ---- trees ---- */

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
	const ald_accel *a = f->b->a;
	const ald_host *h = f->b->host;
	size_t ahead = (1 + AHEAD_OF(h->threads)) * HUGE_PAGE; /* the rest when it is time, see crop_reach() */
	size_t nodes = f->node_room * sizeof(*a->node), blocks = f->block_room * sizeof(*a->block);

	f->next = 0;
	f->nodes = f->blocks = f->others = 0;
	bvh8_touch_all(h, a->node, nodes < ahead ? nodes : ahead);
	bvh8_touch_all(h, a->block, blocks < ahead ? blocks : ahead);
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
	const ald_host *h = f->b->host;
	ald_accel *a = f->b->a;
	int status = grow(f, crop);

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
	status = take_tree(f);
	return status ? status : grow(f, crop);
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

/* From references to crops; what sorting needs besides them is there already, for triangles later on. */
static int order(struct fast *f)
{
	struct builder *b = f->b;
	const ald_host *h = b->host;
	struct list l = { .n = 0 };
	int status;

	fast_room(b, &f->node_room, &f->block_room, &f->other_room);
	l.room = 2 * (b->refs / CROP) + 8;
	l.crop = bvh8_take(h, l.room, sizeof(*l.crop), "bvh8: building");
	status = l.crop ? take_tree(f) : ALD_NO_MEMORY;
	f->spare = (uint64_t *)(void *)b->a->block;
	if (!status && b->refs > CROP)
		bvh8_touch_all(h, f->spare, b->refs * sizeof(*f->spare));
	if (!status)
		status = make_crops(f, &l, 0, b->refs, 0);
	if (!status)
		status = zoom_all(f, &l);
	f->crop = l.crop;
	f->crops = l.n;
	return status;
}

int bvh8_fast(struct builder *b, const struct bvh8_crop *jobs)
{
	const ald_host *h = b->host;
	struct fast f = { .b = b };
	int status;

	b->a->root = EMPTY;
	status = make_keys(&f, jobs->key);
	if (!status && b->refs)
		status = order(&f);
	h->free(h->ctx, f.count);
	if (!status && b->refs)
		status = take_rest(&f, jobs->desk);
	if (!status && b->refs)
		status = grow_twice(&f, jobs->crop);
	if (!status && b->refs)
		tell(&f);
	h->free(h->ctx, f.crop);
	h->free(h->ctx, f.tip);
	h->free(h->ctx, f.desk);
	return status;
}
