/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's herds: up to 64 rays that go the same way, by the signs of their directions and their main axis, together
 * through the tree, with a bit for each of them on the stack (Barringer, Akenine-Moeller: Dynamic Ray Stream
 * Traversal, 2014). At a node each ray that is there meets all children in one step of SIMD and leaves its bit with
 * those that it enters; no step waits for what another ray's brings, nothing is written for a ray, and where any hit
 * will do nothing is sorted either. Where most of a herd is together still, its hull goes first against the children,
 * as interval arithmetic has it (Boulos, Wald, Shirley: Geometric and Arithmetic Culling Methods for Entire Ray
 * Packets, 2006), and what that leaves is met by sixteen rays at once, when its turn comes: whichever of the two takes
 * fewer steps. Bounds on errors are those of single rays.
 */
#ifndef BVH8_HERD_H
#define BVH8_HERD_H

#include "bvh8_leaf.h"

#if ISA_LEVEL >= 2
#define HERD_MANY 12u /* rays that are worth a hull */
#define HERD_AHEAD 3u
#define HERD_LEAST 16u
#define HERD_DOWN 4 /* rays that go down into an instance together */
#define HERD_FETCH (24 * sizeof(ald_ray)) /* how far ahead rays are fetched */
#define TESTED UINT32_MAX

/* The lanes of a row of sixteen, from lane i on, that enter a node's child. */
V uint32_t herd_box(const struct herd *h, const struct node *n, unsigned k, unsigned i)
{
	const struct lot *l = &h->lot;
	f16 t0 = f16_all(0), t1 = f16_load(l->tfar + i);

	UNROLL
	for (unsigned j = 0; j < 3; j++) {
		f16 v = f16_load(l->inverse[j] + i);

		t0 = f16_max(f16_mul_add(f16_all(n->plane[h->near[j]][k]), v, f16_load(l->near_o[j] + i)), t0);
		t1 = f16_min(f16_mul_add(f16_all(n->plane[h->far[j]][k]), v, f16_load(l->far_o[j] + i)), t1);
	}
	return f16_le(t0, t1);
}

V uint64_t herd_boxes(const struct herd *h, const struct node *n, unsigned k, uint64_t mask)
{
	uint64_t in = 0;

	for (unsigned i = 0; i < h->size; i += 16) {
		if (mask >> i & 0xffff)
			in |= (uint64_t)herd_box(h, n, k, i) << i;
	}
	return in & mask;
}

/* The lanes for which nothing that they have met is nearer. */
V uint64_t herd_reach(const struct herd *h, float enter, uint64_t mask)
{
	uint64_t in = 0;

	for (unsigned i = 0; i < h->size; i += 16)
		in |= (uint64_t)f16_le(f16_all(enter), f16_load(h->lot.tfar + i)) << i;
	return in & mask;
}

struct fan { /* where rays go on from a node: bits of lanes for each child, where the first of them enters */
	__m256i some, more;
	f8 enter;
};

V void herd_ray(const struct herd *h, const f8 near[3], const f8 far[3], unsigned i, __m256i *bits, f8 *enter, int any)
{
	const struct lot *l = &h->lot;
	f8 t0 = f8_all(0), t1 = f8_all(l->tfar[i]);

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		f8 v = f8_all(l->inverse[k][i]);

		t0 = f8_max(f8_mul_add(near[k], v, f8_all(l->near_o[k][i])), t0);
		t1 = f8_min(f8_mul_add(far[k], v, f8_all(l->far_o[k][i])), t1);
	}
	*bits = f8_mark(*bits, t0, t1, 1u << i % 32);
	if (!any)
		*enter = f8_first(*enter, t0, t1);
}

V void herd_rays(const struct herd *h, const struct node *n, uint64_t mask, struct fan *f, int any)
{
	f8 near[3], far[3];

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		near[k] = f8_load(n->plane[h->near[k]]);
		far[k] = f8_load(n->plane[h->far[k]]);
	}
	f->some = f->more = _mm256_setzero_si256();
	f->enter = f8_all(INFINITY);
	for (uint32_t bits = (uint32_t)mask; bits; bits &= bits - 1)
		herd_ray(h, near, far, (unsigned)__builtin_ctz(bits), &f->some, &f->enter, any);
	for (uint32_t bits = (uint32_t)(mask >> 32); bits; bits &= bits - 1)
		herd_ray(h, near, far, 32 + (unsigned)__builtin_ctz(bits), &f->more, &f->enter, any);
}

/* The children that some ray enters go on the stack, the nearest last. */
V uint32_t herd_node(const ald_accel *a, struct herd *h, uint32_t ref, uint64_t mask, uint32_t top, int any)
{
	const struct node *n = &a->node[ref];
	uint32_t m = (uint32_t)__builtin_popcountll(mask), from = top;
	struct fan f;

	h->steps++;
	h->rays += m;
	if (m >= HERD_MANY) {
		f8 t0 = f8_all(0), t1 = f8_all(h->reach);
		uint32_t rows = 0, some;

		UNROLL
		for (unsigned k = 0; k < 3; k++) {
			f8 x = f8_sub(f8_load(n->plane[h->near[k]]), h->edge_near[k]);
			f8 y = f8_sub(f8_load(n->plane[h->far[k]]), h->edge_far[k]);

			t0 = f8_max(f8_min(f8_mul(x, h->slow[k]), f8_mul(x, h->fast[k])), t0);
			t1 = f8_min(f8_max(f8_mul(y, h->slow[k]), f8_mul(y, h->fast[k])), t1);
		}
		some = f8_le(t0, t1);
		for (unsigned i = 0; i < h->size; i += 16)
			rows += (mask >> i & 0xffff) != 0;
		if ((uint32_t)__builtin_popcount(some) * rows <= m) {
			top += f8_order_lanes(t0, t1, n->child, ref * WIDTH, h->ref + from, h->box + from);
			_mm256_storeu_si256((__m256i *)(h->some + from), _mm256_set1_epi32((int)mask));
			_mm256_storeu_si256((__m256i *)(h->more + from), _mm256_set1_epi32((int)(mask >> 32)));
			return top;
		}
	}
	herd_rays(h, n, mask, &f, any);
	if (any)
		return top + f8_keep(f.some, f.more, n->child, h->some + top, h->more + top, h->ref + top,
				     h->box + top);
	return top + f8_sort(f.enter, f.some, f.more, n->child, h->some + top, h->more + top, h->ref + top,
			     h->box + top, h->enter + top);
}

/* Rays that come to an instance together go down into it together. */
static __attribute__((noinline)) void herd_down(const ald_accel *a, const struct batch *s, ald_query *q, struct herd *h,
						uint32_t ref, uint64_t lanes, int any)
{
	const uint32_t *list = &a->other[ref & REF_INDEX];
	ald_ray ray[LOT];
	ald_hit hit[LOT];
	uint8_t live[LOT];
	uint32_t n = 0;

	for (uint64_t left = lanes; left; left &= left - 1, n++) {
		uint32_t at = h->lot.index[__builtin_ctzll(left)];

		ray[n] = s->ray[at];
		hit[n] = any ? (ald_hit){ .t = ray[n].tmax, .prim = ALD_NONE } : s->hit[at];
		live[n] = 1;
	}
	for (uint32_t k = 1; k <= list[0]; k++) {
		a->prims->intersect_n(a->prims, list[k], q, ray, hit, live, n);
		for (uint32_t i = 0; i < n && any; i++)
			live[i] = hit[i].prim == ALD_NONE;
	}
	for (uint32_t i = 0; lanes; lanes &= lanes - 1, i++) {
		unsigned lane = (unsigned)__builtin_ctzll(lanes);
		uint32_t at = h->lot.index[lane];

		if (any) {
			h->found |= (uint64_t)!live[i] << lane;
		} else if (hit[i].prim != s->hit[at].prim || hit[i].t < s->hit[at].t) {
			s->hit[at] = hit[i];
			beam_begin(a, &h->beam, &h->lot, lane, s, at);
			beam_limit(&h->beam);
			herd_cut(a, h, lane, h->beam.tfar);
		}
	}
	h->live &= ~h->found;
}

V void herd_others(const ald_accel *a, const struct batch *s, ald_query *q, struct herd *h, uint32_t ref,
		   uint64_t lanes, int any)
{
	struct lot *l = &h->lot;

	if (a->prims->intersect_n && __builtin_popcountll(lanes) >= HERD_DOWN) {
		herd_down(a, s, q, h, ref, lanes, any);
		return;
	}

	for (; lanes; lanes &= lanes - 1) {
		unsigned lane = (unsigned)__builtin_ctzll(lanes);
		struct beam *b = &h->beam;

		beam_begin(a, b, l, lane, s, l->index[lane]);
		b->ref = ref;
		beam_others(a, q, b, any);
		if (b->tfar < l->tfar[lane])
			herd_cut(a, h, lane, b->tfar);
		h->found |= (uint64_t)b->found << lane;
	}
	h->live &= ~h->found;
}

/* Without a branch: nobody could guess which it is. (Of what is in no block, nothing useful.) */
V void herd_fetch_one(const ald_accel *a, uint32_t ref)
{
	const uintptr_t from[] = { (uintptr_t)a->node, (uintptr_t)a->block };
	const size_t each[] = { sizeof(*a->node), sizeof(*a->block) };
	const char *p = (const char *)(from[ref >> 31] + (ref & REF_INDEX) * each[ref >> 31]);

	__builtin_prefetch(p);
	__builtin_prefetch(p + 64);
	__builtin_prefetch(p + 128);
	__builtin_prefetch(p + 192);
}

/* What is next on the stack. */
V void herd_fetch(const ald_accel *a, const struct herd *h, uint32_t top)
{
	for (uint32_t i = 1; i <= HERD_AHEAD && i <= top; i++)
		herd_fetch_one(a, h->ref[top - i]);
}

/* Rays that open a node together, on average, or herds do not pay. */
V uint32_t herd_together(const ald_accel *a, int any)
{
	if (!a->far)
		return any ? 2 : 3;
	return a->far > 1 ? (any ? 2 : 6) : (any ? 3 : 12);
}

/* How many steps what comes off the stack waits for what it is to be fetched. A hit that would have spared some rays
 * the next boxes may come too late by as many, which where any will do is rare. */
V uint32_t herd_delay(const ald_accel *a, int any)
{
	return a->far > 1 ? (any ? HERD_LATER : 5) : a->far && any ? 3 : 0;
}

/* One that comes off the stack takes its turn to wait, and another is due: *ref and the lanes it is for. */
V uint64_t herd_turn(const ald_accel *a, struct herd *h, uint32_t *ref, uint64_t mask, uint32_t turn)
{
	uint64_t due = h->waiting[turn] & h->live;
	uint32_t due_ref = h->later[turn];

	herd_fetch_one(a, *ref);
	h->waiting[turn] = mask;
	h->later[turn] = *ref;
	*ref = due_ref;
	return due;
}

/* What is on top of the stack, and the lanes that are to see it. */
V uint64_t herd_pop(const ald_accel *a, const struct herd *h, uint32_t top, uint32_t *ref, int any)
{
	uint64_t mask = (h->some[top] | (uint64_t)h->more[top] << 32) & h->live;
	uint32_t box = h->box[top];

	*ref = h->ref[top];
	if (box != TESTED)
		return herd_boxes(h, &a->node[box / WIDTH], box % WIDTH, mask);
	return any ? mask : herd_reach(h, h->enter[top], mask);
}

/* The lot is filled, its live lanes, axes and planes are set. */
V void herd_walk(const ald_accel *a, const struct batch *s, struct asked *asked, ald_query *q, struct herd *h, int any)
{
	const uint32_t delay = herd_delay(a, any);
	uint32_t top = 1, waiting = 0, turn = 0;

	memset(h->waiting, 0, sizeof(h->waiting));

	herd_begin(a, h);
	h->ref[0] = a->root;
	h->some[0] = (uint32_t)h->live;
	h->more[0] = (uint32_t)(h->live >> 32);
	h->box[0] = TESTED;
	h->enter[0] = -INFINITY;
	while (top || waiting) {
		uint32_t ref = 0;
		uint64_t mask = top ? herd_pop(a, h, --top, &ref, any) : 0;

		if (delay && (mask || !top)) {
			waiting += (mask != 0) - (uint32_t)(h->waiting[turn] != 0);
			mask = herd_turn(a, h, &ref, mask, turn);
			turn = turn + 1 < delay ? turn + 1 : 0;
		}
		if (!mask)
			continue;
		if (ref < REF_LEAF) {
			top = herd_node(a, h, ref, mask, top, any);
			if (!delay)
				herd_fetch(a, h, top);
			continue;
		}
		if (!h->aimed)
			herd_aims(a, h, s);
		if (ref < REF_OTHERS)
			herd_leaf(a, s, asked, h, ref, mask, any);
		else
			herd_others(a, s, q, h, ref, mask, any);
	}
	for (uint64_t found = h->found; any && found; found &= found - 1)
		s->hidden[h->lot.index[__builtin_ctzll(found)]] = 1;
	if (a->frame.exact && !any)
		herd_certain(s, h);
	herd_settle(a, s, asked, h);
}

/* ---- a batch in herds ---- */

#define HERD_SORTED 1024u
#define WAYS 24u

/* The way that a ray goes, by signs and main axis as bvh8_lot.h has them; without a branch. */
V uint32_t way_of(const ald_ray *r)
{
	double x = fabs(r->dir.x), y = fabs(r->dir.y), z = fabs(r->dir.z);
	uint32_t first = (uint32_t)(x > y) & (uint32_t)(x > z), second = (uint32_t)!(x > y) & (uint32_t)(y > z);
	uint64_t d[3];

	memcpy(d, &r->dir, sizeof(d));
	return (2 - 2 * first - second) * 8 + (uint32_t)(d[0] >> 63 | d[1] >> 63 << 1 | d[2] >> 63 << 2);
}

/* Do rays go few ways? Then those beside each other mostly go the same one, and they need no order. */
V int herd_is_sorted(const ald_ray *ray, uint32_t n)
{
	uint32_t ways = 0, step = n / 16 + 1;

	for (uint32_t i = 0; i < n; i += step)
		ways |= 1u << way_of(&ray[i]);
	return __builtin_popcount(ways) <= 4;
}

/* Rays by the way they go: order[], and behind each way where it ends there. */
V void herd_sort(const ald_ray *ray, uint32_t n, uint16_t *order, uint32_t end[WAYS])
{
	uint8_t way[HERD_SORTED];
	uint32_t sum = 0;

	for (uint32_t i = 0; i < n; i++) {
		__builtin_prefetch((const char *)(ray + i) + HERD_FETCH);
		__builtin_prefetch((const char *)(ray + i) + HERD_FETCH + 64);
		way[i] = (uint8_t)way_of(&ray[i]);
	}
	memset(end, 0, WAYS * sizeof(*end));
	for (uint32_t i = 0; i < n; i++)
		end[way[i]]++;
	for (unsigned k = 0; k < WAYS; k++) {
		uint32_t first = sum;

		sum += end[k];
		end[k] = first;
	}
	for (uint32_t i = 0; i < n; i++)
		order[end[way[i]]++] = (uint16_t)i;
}

/* Rays of one way, of a lot that is filled. */
V void herd_way(struct herd *h, unsigned lane, uint64_t among)
{
	const struct lot *l = &h->lot;

	h->axis[2] = (uint32_t)(l->main[1] >> lane & 1) + 2 * (uint32_t)(l->main[2] >> lane & 1);
	h->axis[0] = h->axis[2] == 2 ? 0 : h->axis[2] + 1;
	h->axis[1] = h->axis[0] == 2 ? 0 : h->axis[0] + 1;
	h->side = l->sign[h->axis[2]] >> lane & 1 ? -1.0f : 1.0f;
	h->live = among & l->main[h->axis[2]];
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		uint64_t down = 0 - (l->sign[k] >> lane & 1);

		h->live &= ~(l->sign[k] ^ down);
		h->near[k] = 2 * k + (down & 1);
		h->far[k] = 2 * k + 1 - (down & 1);
	}
}

/* The n rays of lot.index[]. */
V void herd_serve(const ald_accel *a, const struct batch *b, struct asked *asked, ald_query *q, struct herd *h,
		  uint32_t n, int any)
{
	struct lot *l = &h->lot;
	uint64_t left;

	if (h->due.some && h->due.lines == h->lines)
		h->lines = h->lines == h->both ? h->both + 1 : h->both;
	lot_fill_lines(a, l, h->lines, b, n);
	lot_odd(a, q, b, l, any);
	h->size = n;
	for (left = l->live & ~l->odd; left; left &= ~h->live_first) {
		herd_way(h, (unsigned)__builtin_ctzll(left), left);
		h->live_first = h->live;
		herd_walk(a, b, asked, q, h, any);
	}
}

#endif

#endif
