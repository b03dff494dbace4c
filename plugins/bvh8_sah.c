/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A binary tree by the surface area heuristic over bins (Wald: On fast Construction of SAH-based Bounding
 * Volume Hierarchies, 2007). Large ranges are split level by level, each step one parallel pass over
 * pieces of them; once they are small, each is one job. What is large does not depend on the number
 * of threads, and minima, maxima and counts on no order, so the tree doesn't either.
 */
#include "bvh8.h"

#if defined __SSE2__
#include <emmintrin.h>
#endif

#define BINS 16u
#define SMALL 16384u /* references that one job builds a tree of */
#define PIECE 8192u /* references that one job looks at together */
#define STEEP 24u /* levels after which ranges are halved, so that no tree is deeper than LEVELS_MAX */
#define STEP_COST 0.5f /* of a split, in blocks */

typedef float v4 __attribute__((vector_size(16), aligned(16)));

#if defined __SSE2__
#define v4_min(a, b) ((v4)_mm_min_ps((__m128)(a), (__m128)(b)))
#define v4_max(a, b) ((v4)_mm_max_ps((__m128)(a), (__m128)(b)))
#else
static inline v4 v4_min(v4 a, v4 b)
{
	for (unsigned i = 0; i < 4; i++)
		a[i] = a[i] < b[i] ? a[i] : b[i];
	return a;
}

static inline v4 v4_max(v4 a, v4 b)
{
	for (unsigned i = 0; i < 4; i++)
		a[i] = a[i] > b[i] ? a[i] : b[i];
	return a;
}
#endif

#define FAR 0x1p100f
#define V4(x) ((v4){ x, x, x, x })

struct hull { /* boxes; their last lane means nothing */
	v4 lo, hi;
};

struct range {
	uint32_t first, count, twig, depth;
	struct hull box, mid; /* around the references, and around their centres, doubled */
};

struct bins {
	struct hull box[3][BINS];
	uint32_t n[3][BINS];
	uint32_t used;
	v4 from, scale;
};

struct split {
	float cost; /* in blocks, times the area of the range; FAR: none */
	uint32_t axis, bin; /* the right side begins with this bin; axis 3: by the place alone */
};

static inline struct hull hull_empty(void)
{
	return (struct hull){ V4(FAR), V4(-FAR) };
}

static inline void hull_join(struct hull *a, const struct hull *b)
{
	a->lo = v4_min(a->lo, b->lo);
	a->hi = v4_max(a->hi, b->hi);
}

static inline void hull_add(struct hull *a, v4 x)
{
	a->lo = v4_min(a->lo, x);
	a->hi = v4_max(a->hi, x);
}

static inline float hull_area(const struct hull *a)
{
	v4 d = a->hi - a->lo;

	return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

/* The last lane is the id, which as a float may be anything: 0 instead. */
static inline struct hull ref_hull(const struct ref *r)
{
	typedef uint32_t u4 __attribute__((vector_size(16)));
	const u4 keep = { UINT32_MAX, UINT32_MAX, UINT32_MAX, 0 };
	u4 lo, hi;

	memcpy(&lo, r->lo, sizeof(lo));
	memcpy(&hi, r->hi, sizeof(hi));
	return (struct hull){ (v4)(lo & keep), (v4)hi };
}

static void measure(const struct ref *ref, uint32_t n, struct range *r)
{
	r->box = r->mid = hull_empty();
	for (uint32_t i = 0; i < n; i++) {
		struct hull h = ref_hull(&ref[i]);

		hull_join(&r->box, &h);
		hull_add(&r->mid, h.lo + h.hi);
	}
}

static void bins_begin(struct bins *b, const struct range *r)
{
	v4 size = r->mid.hi - r->mid.lo;

	b->used = 4 + r->count / 8 < BINS ? 4 + r->count / 8 : BINS;
	b->from = r->mid.lo;
	for (unsigned k = 0; k < 4; k++)
		b->scale[k] = k < 3 && size[k] > 0x1p-60f ? (float)b->used * 0.99999f / size[k] : 0;
	for (unsigned k = 0; k < 3; k++) {
		for (unsigned i = 0; i < b->used; i++) {
			b->box[k][i] = hull_empty();
			b->n[k][i] = 0;
		}
	}
}

static inline void bin_of(const struct bins *b, const struct hull *h, uint32_t at[4])
{
	v4 x = ((h->lo + h->hi) - b->from) * b->scale;
#if defined __SSE2__
	_mm_storeu_si128((__m128i *)(void *)at, _mm_cvttps_epi32((__m128)x));
#else
	for (unsigned k = 0; k < 3; k++)
		at[k] = (uint32_t)x[k];
#endif
}

static void bins_add(struct bins *b, const struct ref *ref, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++) {
		struct hull h = ref_hull(&ref[i]);
		uint32_t at[4];

		bin_of(b, &h, at);
		for (unsigned k = 0; k < 3; k++) {
			hull_join(&b->box[k][at[k]], &h);
			b->n[k][at[k]]++;
		}
	}
}

static inline float blocks(uint32_t n)
{
	return (float)((n + SEATS - 1) / SEATS);
}

static void best_of_axis(const struct bins *b, unsigned k, struct split *best)
{
	float right[BINS];
	struct hull h = hull_empty();
	uint32_t n = 0;

	for (unsigned i = b->used - 1; i > 0; i--) {
		hull_join(&h, &b->box[k][i]);
		n += b->n[k][i];
		right[i] = n ? hull_area(&h) * blocks(n) : FAR;
	}
	h = hull_empty();
	n = 0;
	for (unsigned i = 1; i < b->used; i++) {
		float cost;

		hull_join(&h, &b->box[k][i - 1]);
		n += b->n[k][i - 1];
		cost = n ? hull_area(&h) * blocks(n) + right[i] : FAR;
		if (cost < best->cost)
			*best = (struct split){ cost, k, i };
	}
}

static struct split best_split(const struct bins *b)
{
	struct split best = { FAR, 3, 0 };

	for (unsigned k = 0; k < 3; k++) {
		if (b->scale[k] > 0)
			best_of_axis(b, k, &best);
	}
	return best;
}

static void set_twig(struct twig *t, const struct range *r, uint32_t kid, uint32_t count)
{
	for (unsigned k = 0; k < 3; k++) {
		t->lo[k] = r->box.lo[k];
		t->hi[k] = r->box.hi[k];
	}
	t->kid = kid;
	t->count = count;
}

/* Which of the range can go into a leaf: triangles, as many as fill blocks; or one of the others. */
static uint32_t others_of(const struct builder *b, const struct ref *ref, uint32_t n)
{
	uint32_t others = 0;

	if (b->prims->tri_count == b->prims->count)
		return 0;
	for (uint32_t i = 0; i < n; i++)
		others += ref[i].id >= b->prims->tri_count;
	return others;
}

/* ---- one range, in place ---- */

/* Move what goes left to the front; returns how many. */
static uint32_t part(struct ref *ref, uint32_t n, const struct bins *b, const struct split *s,
		     struct range *left, struct range *right)
{
	uint32_t i = 0, j = n;

	left->box = left->mid = right->box = right->mid = hull_empty();
	while (i < j) {
		struct hull h = ref_hull(&ref[i]);
		uint32_t at[4];
		struct ref swap;

		bin_of(b, &h, at);
		if (at[s->axis] < s->bin) {
			hull_join(&left->box, &h);
			hull_add(&left->mid, h.lo + h.hi);
			i++;
			continue;
		}
		hull_join(&right->box, &h);
		hull_add(&right->mid, h.lo + h.hi);
		swap = ref[i];
		ref[i] = ref[--j];
		ref[j] = swap;
	}
	return i;
}

/* Triangles first. */
static uint32_t part_kinds(const struct builder *b, struct ref *ref, uint32_t n)
{
	uint32_t i = 0;

	for (uint32_t j = 0; j < n; j++) {
		struct ref r = ref[j];

		if (r.id < b->prims->tri_count) {
			ref[j] = ref[i];
			ref[i++] = r;
		}
	}
	return i;
}

/* The kth in order along the axis where centres are spread most, by the centre and then the place: after
 * this, those before k are no farther than those behind. */
static void halve(struct ref *ref, uint32_t n, const struct range *r)
{
	v4 size = r->mid.hi - r->mid.lo;
	unsigned k = size[0] > size[1] ? (size[0] > size[2] ? 0 : 2) : (size[1] > size[2] ? 1 : 2);
	uint32_t lo = 0, hi = n - 1, want = n / 2;

	while (lo < hi) {
		const struct ref *m = &ref[lo + (hi - lo) / 2];
		float x = m->lo[k] + m->hi[k];
		uint32_t i = lo, j = hi;

		for (;; i++, j--) {
			struct ref swap;

			while (ref[i].lo[k] + ref[i].hi[k] < x)
				i++;
			while (ref[j].lo[k] + ref[j].hi[k] > x)
				j--;
			if (i >= j)
				break;
			swap = ref[i];
			ref[i] = ref[j];
			ref[j] = swap;
		}
		if (want <= j)
			hi = j;
		else
			lo = j + 1;
	}
}

/* Where to cut the range, its references in order; 0: it is a leaf. */
static uint32_t cut(const struct builder *b, const struct range *r, struct range *left, struct range *right)
{
	struct ref *ref = b->ref + r->first;
	uint32_t others = others_of(b, ref, r->count), at;
	uint32_t most = (uint32_t)b->value[P_LEAF];
	struct split s = { FAR, 3, 0 };
	struct bins bins;
	float leaf;

	if (others ? r->count == 1 : r->count <= (most < SEATS ? most : SEATS))
		return 0;
	if (others && others < r->count && r->count <= SEATS) {
		at = part_kinds(b, ref, r->count);
	} else {
		if (r->depth < STEEP) {
			bins_begin(&bins, r);
			bins_add(&bins, ref, r->count);
			s = best_split(&bins);
		}
		leaf = blocks(r->count) * hull_area(&r->box);
		if (r->count <= most && (others ? others == r->count && r->count <= SEATS && s.axis > 2 :
						  !(s.cost + STEP_COST * hull_area(&r->box) < leaf)))
			return 0;
		if (s.axis < 3)
			return part(ref, r->count, &bins, &s, left, right);
		halve(ref, r->count, r);
		at = r->count / 2;
	}
	measure(ref, at, left);
	measure(ref + at, r->count - at, right);
	return at;
}

/* kids: where the next two twigs go. */
static void grow(const struct builder *b, const struct range *r, uint32_t *kids)
{
	struct range left, right;
	uint32_t n = cut(b, r, &left, &right), kid = *kids;

	if (!n) {
		set_twig(&b->twig[r->twig], r, r->first, r->count);
		return;
	}
	set_twig(&b->twig[r->twig], r, kid, 0);
	*kids += 2;
	left.first = r->first;
	left.count = n;
	right.first = r->first + n;
	right.count = r->count - n;
	left.twig = kid;
	right.twig = kid + 1;
	left.depth = right.depth = r->depth + 1;
	grow(b, &left, kids);
	grow(b, &right, kids);
}

/* ---- large ranges, level by level ---- */

struct piece {
	uint32_t range, first, count;
	struct range r; /* boxes of what is in it */
	struct bins bins;
	uint32_t left, right; /* where to put the first of each side */
};

struct level {
	struct builder *b;
	struct ref *from, *to;
	struct range *range; /* to be split */
	struct split *split;
	struct piece *piece;
	uint32_t ranges, pieces;
	struct range *task; /* small enough; at the end, twig is how many inner twigs it made */
	uint32_t tasks;
	uint32_t twigs; /* of the top, behind those of the tasks */
};

static void measure_job(void *arg, uint32_t i)
{
	struct level *l = arg;
	struct piece *p = &l->piece[i];

	measure(l->from + p->first, p->count, &p->r);
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
	uint32_t left = p->left, right = p->right;

	for (uint32_t j = p->first; j < p->first + p->count; j++) {
		struct hull h = ref_hull(&l->from[j]);
		uint32_t at[4];
		int is_left;

		bin_of(&p->bins, &h, at);
		is_left = s->axis < 3 ? at[s->axis] < s->bin : j - r->first < r->count / 2;
		l->to[is_left ? left++ : right++] = l->from[j];
	}
}

static void copy_job(void *arg, uint32_t i)
{
	struct level *l = arg;
	struct range *t = &l->task[i];

	if (t->depth & 1) /* else it is there */
		memcpy(l->b->ref + t->first, l->b->spare + t->first, t->count * sizeof(struct ref));
}

static void task_job(void *arg, uint32_t i)
{
	struct level *l = arg;
	struct range r = l->task[i];
	uint32_t kids = 2 * r.first;

	measure(l->b->ref + r.first, r.count, &r);
	grow(l->b, &r, &kids);
	l->task[i].twig = kids / 2 - r.first;
}

static int cut_pieces(struct level *l)
{
	uint32_t n = 0;

	for (uint32_t i = 0; i < l->ranges; i++)
		n += (l->range[i].count + PIECE - 1) / PIECE;
	l->piece = bvh8_take(l->b->host, n, sizeof(*l->piece), "bvh8: building");
	l->split = bvh8_take(l->b->host, l->ranges, sizeof(*l->split), "bvh8: building");
	if (!l->piece || !l->split)
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

static void join_boxes(struct level *l)
{
	for (uint32_t i = 0; i < l->ranges; i++)
		l->range[i].box = l->range[i].mid = hull_empty();
	for (uint32_t i = 0; i < l->pieces; i++) {
		struct range *r = &l->range[l->piece[i].range];

		hull_join(&r->box, &l->piece[i].r.box);
		hull_join(&r->mid, &l->piece[i].r.mid);
	}
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

/* Join the bins of pieces, and decide; then tell pieces where to go. Returns how many go left. */
static uint32_t decide(struct level *l, uint32_t i, uint32_t first, uint32_t end)
{
	struct bins all = l->piece[first].bins;
	uint32_t left = l->range[i].first, right, n = 0;

	for (uint32_t p = first + 1; p < end; p++) {
		const struct bins *b = &l->piece[p].bins;

		for (unsigned k = 0; k < 3; k++) {
			for (unsigned j = 0; j < all.used; j++) {
				hull_join(&all.box[k][j], &b->box[k][j]);
				all.n[k][j] += b->n[k][j];
			}
		}
	}
	l->split[i] = (struct split){ FAR, 3, 0 };
	if (l->range[i].depth < STEEP)
		l->split[i] = best_split(&all);
	for (uint32_t p = first; p < end; p++)
		n += goes_left(l, &l->piece[p]);
	right = left + n;
	for (uint32_t p = first; p < end; p++) {
		uint32_t m = goes_left(l, &l->piece[p]);

		l->piece[p].left = left;
		l->piece[p].right = right;
		left += m;
		right += l->piece[p].count - m;
	}
	return n;
}

static int next_level(struct level *l, struct range **next)
{
	uint32_t n = 0, at = 0, end;

	*next = bvh8_take(l->b->host, 2 * (uint64_t)l->ranges, sizeof(**next), "bvh8: building");
	if (!*next)
		return ALD_NO_MEMORY;
	for (uint32_t i = 0; i < l->ranges; i++, at = end) {
		const struct range *r = &l->range[i];
		uint32_t left;

		for (end = at; end < l->pieces && l->piece[end].range == i; end++)
			;
		left = decide(l, i, at, end);
		set_twig(&l->b->twig[r->twig], r, l->twigs, 0);
		for (unsigned k = 0; k < 2; k++) {
			struct range kid = { .first = k ? r->first + left : r->first,
					     .count = k ? r->count - left : left,
					     .twig = l->twigs++,
					     .depth = r->depth + 1 };

			if (kid.count > SMALL)
				(*next)[n++] = kid;
			else
				l->task[l->tasks++] = kid;
		}
	}
	l->ranges = n;
	return ALD_OK;
}

static int split_level(struct level *l, uint32_t depth)
{
	const ald_host *h = l->b->host;
	struct range *next = NULL;
	int status = cut_pieces(l);

	l->from = depth & 1 ? l->b->spare : l->b->ref;
	l->to = depth & 1 ? l->b->ref : l->b->spare;
	if (!status) {
		h->parallel(h->ctx, l->pieces, measure_job, l);
		join_boxes(l);
		h->parallel(h->ctx, l->pieces, bin_job, l);
		status = next_level(l, &next);
	}
	if (!status)
		h->parallel(h->ctx, l->pieces, move_job, l);
	h->free(h->ctx, l->piece);
	h->free(h->ctx, l->split);
	h->free(h->ctx, l->range);
	l->piece = NULL;
	l->split = NULL;
	l->range = next;
	return status;
}

/* Ranges at the top are larger than SMALL, and no two share a reference: fewer than this at each level,
 * and twice as many pairs of twigs. */
static uint32_t top_twigs(uint32_t refs)
{
	return 2 * 64 * (refs / SMALL + 1);
}

int bvh8_sah(struct builder *b)
{
	const ald_host *h = b->host;
	struct level l = { .b = b, .twigs = 2 * b->refs + 1 };
	uint64_t twigs = 2 * (uint64_t)b->refs + 1 + top_twigs(b->refs);
	uint32_t depth = 0;
	int status = ALD_OK;

	if (twigs > UINT32_MAX / 2)
		return ALD_NO_MEMORY;
	b->twig = bvh8_take(h, twigs, sizeof(*b->twig), "bvh8: building");
	l.task = bvh8_take(h, top_twigs(b->refs), sizeof(*l.task), "bvh8: building");
	l.range = bvh8_take(h, 1, sizeof(*l.range), "bvh8: building");
	if (!b->twig || !l.task || !l.range)
		status = ALD_NO_MEMORY;
	b->spare = (struct ref *)(void *)b->twig; /* until the tasks begin */
	if (!status) {
		struct range root = { .count = b->refs, .twig = 2 * b->refs };

		if (root.count > SMALL)
			l.range[l.ranges++] = root;
		else
			l.task[l.tasks++] = root;
	}
	for (; !status && l.ranges; depth++) {
		if (h->progress(h->ctx, 0.1 + depth * 0.01))
			status = ALD_CANCELLED;
		else
			status = split_level(&l, depth);
	}
	if (!status) {
		h->parallel(h->ctx, l.tasks, copy_job, &l);
		h->parallel(h->ctx, l.tasks, task_job, &l);
		b->inner = (l.twigs - 2 * b->refs - 1) / 2;
		for (uint32_t i = 0; i < l.tasks; i++)
			b->inner += l.task[i].twig;
	}
	h->free(h->ctx, l.range);
	h->free(h->ctx, l.task);
	return status;
}
