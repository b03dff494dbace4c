/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A binary tree by all threads. Large ranges are split level by level, each step one parallel pass over pieces
 * of them; once they are small, each is one job (bvh8_grow.h). What is large does not depend on the number of
 * threads, and minima, maxima and counts on no order, so the tree doesn't either.
 */
#ifndef BVH8_SAH_H
#define BVH8_SAH_H

#include "bvh8_fill.h"
#include "bvh8_grow.h"

/* What a node costs besides its area, a reference, in areas of the scene: memory, and more children to a node. */
#define NODE_MORE 10.0f
#define SMALL 16384u /* references that one job builds a tree of */
#define PIECE 8192u /* references that one job looks at together */

struct piece {
	struct bins bins;
	struct range side[2]; /* what of it goes left and right */
	uint32_t range, first, count, to[2]; /* where to put the first of each side */
};

struct level {
	struct builder *b;
	struct ref *from, *to;
	struct range *range; /* to be split */
	struct split *split;
	uint32_t *left; /* how many of each range go left */
	struct piece *piece;
	uint32_t ranges, pieces;
	uint32_t twigs; /* of the top, behind those of the tasks */
};

static void measure_job(void *arg, uint32_t i)
{
	struct level *l = arg;
	struct piece *p = &l->piece[i];

	measure(l->from + p->first, p->count, &p->side[0]);
}

static void bin_job(void *arg, uint32_t i)
{
	struct level *l = arg;
	struct piece *p = &l->piece[i];

	bins_begin(&p->bins, &l->range[p->range]);
	bins_add(&p->bins, l->from + p->first, p->count);
}

static void move_job(void *arg, uint32_t i)
{
	struct level *l = arg;
	struct piece *p = &l->piece[i];
	const struct range *r = &l->range[p->range];
	const struct split *s = &l->split[p->range];
	struct ref *left = l->to + p->to[0], *right = l->to + p->to[1];
	struct range a = p->side[0], b = p->side[1];

	range_clear(&a);
	range_clear(&b);
	for (uint32_t j = p->first; j < p->first + p->count; j++) {
		hull h = ref_hull(&l->from[j]);
		q4 mid = hull_mid(h);
		int32_t at[4];

		__builtin_prefetch(&l->from[j + AHEAD]);
		bin_of(&p->bins, mid, at);
		if (s->axis < 3 ? at[s->axis] < (int32_t)s->bin : j - r->first < r->count / 2) {
			range_add(&a, h, mid);
			ref_store(left++, h);
		} else {
			range_add(&b, h, mid);
			ref_store(right++, h);
		}
	}
	p->side[0] = a;
	p->side[1] = b;
}

static void copy_job(void *arg, uint32_t i)
{
	struct builder *b = arg;
	const struct range *t = &((struct range *)b->task)[i];

	if (t->depth & 1) /* else it is there */
		memcpy(b->ref + t->first, b->spare + t->first, t->count * sizeof(struct ref));
}

static void task_job(void *arg, uint32_t i)
{
	struct builder *b = arg;
	struct range *t = &((struct range *)b->task)[i];
	struct grower g = { .b = b, .kids = b->twigs_a_ref * t->first };
	/* Where its references were. */
	struct rows r = { .row = (float *)(void *)&b->ref[t->first],
			  .base = g.kids,
			  .more = NODE_MORE * b->whole / (float)b->refs };

	b->part[i + 1] = (struct part){ .seat = b->seat + (size_t)b->twigs_a_ref * t->first / 2, .twig = t->twig };
	grow(&g, t);
	if (g.kids == r.base)
		return; /* a leaf, or nothing at all */
	fill_rows(&r, b->twig, g.kids);
	bvh8_seat(b, &b->part[i + 1], &r, t->twig);
}

static int cut_pieces(struct level *l)
{
	uint32_t n = 0;

	for (uint32_t i = 0; i < l->ranges; i++)
		n += (l->range[i].count + PIECE - 1) / PIECE;
	l->piece = bvh8_take(l->b->host, n, sizeof(*l->piece), "bvh8: building");
	l->split = bvh8_take(l->b->host, l->ranges, sizeof(*l->split), "bvh8: building");
	l->left = bvh8_take(l->b->host, l->ranges, sizeof(*l->left), "bvh8: building");
	if (!l->piece || !l->split || !l->left)
		return ALD_NO_MEMORY;
	l->pieces = n;
	n = 0;
	for (uint32_t i = 0; i < l->ranges; i++) {
		const struct range *r = &l->range[i];

		for (uint32_t at = 0; at < r->count; at += PIECE) {
			l->piece[n].range = i;
			l->piece[n].first = r->first + at;
			l->piece[n++].count = r->count - at < PIECE ? r->count - at : PIECE;
		}
	}
	return ALD_OK;
}

static uint32_t goes_left(const struct level *l, const struct piece *p)
{
	const struct split *s = &l->split[p->range];
	const struct range *r = &l->range[p->range];
	uint32_t n = 0, half = r->first + r->count / 2;

	if (s->axis > 2)
		return p->first >= half ? 0 : half - p->first < p->count ? half - p->first : p->count;
	for (unsigned k = 0; k < s->bin; k++)
		n += p->bins.n[s->axis][k];
	return n;
}

/* Join the bins of a range's pieces, and decide; then tell the pieces where to go. */
static void decide(struct level *l, uint32_t i, uint32_t first, uint32_t end)
{
	struct bins all = l->piece[first].bins;
	uint32_t to[2] = { l->range[i].first, l->range[i].first };

	for (uint32_t p = first + 1; p < end; p++) {
		const struct bins *b = &l->piece[p].bins;

		for (unsigned k = 0; k < 3; k++) {
			for (unsigned j = 0; j < all.used; j++) {
				all.box[k][j] = hull_join(all.box[k][j], b->box[k][j]);
				all.n[k][j] += b->n[k][j];
			}
		}
	}
	l->split[i] = (struct split){ FAR, 3, 0 };
	if (l->range[i].depth < STEEP)
		l->split[i] = best_split(&all);
	for (uint32_t p = first; p < end; p++)
		to[1] += goes_left(l, &l->piece[p]);
	l->left[i] = to[1] - to[0];
	for (uint32_t p = first; p < end; p++) {
		uint32_t m = goes_left(l, &l->piece[p]);

		memcpy(l->piece[p].to, to, sizeof(to));
		to[0] += m;
		to[1] += l->piece[p].count - m;
	}
}

static uint32_t end_of(const struct level *l, uint32_t i, uint32_t at)
{
	while (at < l->pieces && l->piece[at].range == i)
		at++;
	return at;
}

/* The two sides of range i: to be split again, or tasks. */
static void next_ranges(struct level *l, uint32_t i, uint32_t at, uint32_t end, struct range *next, uint32_t *n)
{
	struct builder *b = l->b;
	const struct range *r = &l->range[i];
	struct range kid[2] = { *r, *r };

	set_twig(&b->twig[r->twig], r, l->twigs, 0);
	kid[0].count = l->left[i];
	kid[1].first = r->first + l->left[i];
	kid[1].count = r->count - l->left[i];
	for (unsigned k = 0; k < 2; k++) {
		range_clear(&kid[k]);
		for (uint32_t p = at; p < end; p++)
			range_join(&kid[k], &l->piece[p].side[k]);
		kid[k].twig = l->twigs++;
		kid[k].depth = r->depth + 1;
		kid[k].end = kid[k].first + kid[k].count;
		kid[k].twigs = b->twigs_a_ref * kid[k].count;
		if (kid[k].count > SMALL)
			next[(*n)++] = kid[k];
		else
			((struct range *)b->task)[b->tasks++] = kid[k];
	}
}

static int next_level(struct level *l, struct range **next)
{
	const ald_host *h = l->b->host;
	uint32_t n = 0;

	*next = bvh8_take(h, 2 * (uint64_t)l->ranges, sizeof(**next), "bvh8: building");
	if (!*next)
		return ALD_NO_MEMORY;
	h->parallel(h->ctx, l->pieces, bin_job, l);
	for (uint32_t i = 0, at = 0, end; i < l->ranges; i++, at = end) {
		end = end_of(l, i, at);
		decide(l, i, at, end);
	}
	h->parallel(h->ctx, l->pieces, move_job, l);
	for (uint32_t i = 0, at = 0, end; i < l->ranges; i++, at = end) {
		end = end_of(l, i, at);
		next_ranges(l, i, at, end, *next, &n);
	}
	l->ranges = n;
	return ALD_OK;
}

static float whole_of(const struct range *root)
{
	float area = hull_area(root->box);

	return area > 0 ? area : 1;
}

static int split_level(struct level *l, uint32_t depth)
{
	const ald_host *h = l->b->host;
	struct range *next = NULL;
	int status = cut_pieces(l);

	l->from = depth & 1 ? l->b->spare : l->b->ref;
	l->to = depth & 1 ? l->b->ref : l->b->spare;
	if (!status && !depth) {
		h->parallel(h->ctx, l->pieces, measure_job, l);
		range_clear(&l->range[0]);
		for (uint32_t i = 0; i < l->pieces; i++)
			range_join(&l->range[0], &l->piece[i].side[0]);
		l->b->whole = whole_of(&l->range[0]);
	}
	if (!status)
		status = next_level(l, &next);
	h->free(h->ctx, l->piece);
	h->free(h->ctx, l->split);
	h->free(h->ctx, l->left);
	h->free(h->ctx, l->range);
	l->piece = NULL;
	l->split = NULL;
	l->left = NULL;
	l->range = next;
	return status;
}

static int split_large(struct builder *b, const struct range *root)
{
	const ald_host *h = b->host;
	struct level l = { .b = b, .twigs = b->root + 1 };
	int status = ALD_OK;

	l.range = bvh8_take(h, 1, sizeof(*l.range), "bvh8: building");
	if (!l.range)
		return ALD_NO_MEMORY;
	l.range[l.ranges++] = *root;
	for (uint32_t depth = 0; !status && l.ranges; depth++) {
		if (h->progress(h->ctx, 0.1 + depth * 0.01))
			status = ALD_CANCELLED;
		else
			status = split_level(&l, depth);
	}
	h->free(h->ctx, l.range);
	b->top = (l.twigs - b->root - 1) / 2;
	if (!status)
		h->parallel(h->ctx, b->tasks, copy_job, b);
	return status;
}

/* ---- with planes: a range is cut by one thread, all ranges of a level at once ---- */

struct front {
	struct builder *b;
	struct range *range, *next;
	uint8_t *is_cut;
};

static void cut_job(void *arg, uint32_t i)
{
	struct front *f = arg;

	f->is_cut[i] = (uint8_t)cut(f->b, &f->range[i], &f->next[2 * i], &f->next[2 * i + 1]);
}

static uint32_t next_front(struct front *f, uint32_t n, uint32_t *twigs)
{
	struct builder *b = f->b;
	uint32_t kept = 0;

	for (uint32_t i = 0; i < n; i++) {
		const struct range *r = &f->range[i];

		if (f->is_cut[i])
			set_twig(&b->twig[r->twig], r, *twigs, 0);
		else
			set_leaf(b, r);
		for (unsigned k = 0; k < 2 && f->is_cut[i]; k++) {
			struct range kid = f->next[2 * i + k];

			kid.twig = (*twigs)++;
			kid.depth = r->depth + 1;
			kid.twigs = b->twigs_a_ref * (kid.end - kid.first);
			if (kid.count > SMALL)
				f->next[kept++] = kid;
			else
				((struct range *)b->task)[b->tasks++] = kid;
		}
	}
	return kept;
}

static int cut_large(struct builder *b, const struct range *root)
{
	const ald_host *h = b->host;
	uint32_t n = 1, twigs = b->root + 1, most = 2 * (b->room / SMALL + 2);
	struct front f = { .b = b };
	int status = ALD_NO_MEMORY;

	f.range = bvh8_take(h, most, sizeof(*f.range), "bvh8: building");
	f.next = bvh8_take(h, most, sizeof(*f.next), "bvh8: building");
	f.is_cut = bvh8_take(h, most, 1, "bvh8: building");
	if (f.range && f.next && f.is_cut) {
		f.range[0] = *root;
		status = ALD_OK;
	}
	while (!status && n) {
		struct range *swap = f.range;

		if (h->progress(h->ctx, 0.1)) {
			status = ALD_CANCELLED;
			break;
		}
		h->parallel(h->ctx, n, cut_job, &f);
		n = next_front(&f, n, &twigs);
		f.range = f.next;
		f.next = swap;
	}
	h->free(h->ctx, f.range);
	h->free(h->ctx, f.next);
	h->free(h->ctx, f.is_cut);
	b->top = (twigs - b->root - 1) / 2;
	return status;
}

static int sah(struct builder *b)
{
	struct range root = { .count = b->refs, .end = b->room, .twig = b->root, .twigs = b->twigs_a_ref * b->room };
	int status = ALD_OK;

	if (root.count <= SMALL || b->corner) {
		measure(b->ref, b->refs, &root);
		b->whole = whole_of(&root);
	}
	if (root.count > SMALL)
		status = b->corner ? cut_large(b, &root) : split_large(b, &root);
	else
		((struct range *)b->task)[b->tasks++] = root;
	if (!status)
		b->host->parallel(b->host->ctx, b->tasks, task_job, b);
	return status;
}

#endif
