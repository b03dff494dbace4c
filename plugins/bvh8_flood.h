/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Short rays for which any hit will do, as those that ask what is near: the order in which such a ray opens nodes
 * hardly matters, and it needs neither distances nor a stack of its own. A lot's rays, in the order they came,
 * flood the tree. While many are at a node they open it together, whatever their signs, and leave a bit for each
 * with the children (see bvh8_herd.h); then, as pairs of a ray and a node or leaf, round by round: a round opens
 * the node of each pair, and what its ray enters are pairs of a later round; leaves are met GROUP pairs at a time,
 * and who is hit is left out of the next round. So nothing branches on what one ray meets, no step waits for the
 * one before it, and what a round will read is fetched while others compute. Long rays would open too much before
 * they met anything.
 */
#ifndef BVH8_FLOOD_H
#define BVH8_FLOOD_H

#include "bvh8_ride.h"

#if ISA_LEVEL >= 2
#define FLOOD_SHORT 0.2 /* such rays are short, in scenes of size 2 */
#define FLOOD_ROUND 64u /* pairs of a round: fewer would wait for memory, more be opened in vain */
#define FLOOD_SHARED 12u /* lanes that are worth a node's planes in registers */
#define FLOOD_ROWS 24u /* lanes that are worth it to be met sixteen at a time, AVX-512 only */
/* So many pairs wait at most: from there on a round is the last pair alone, and its descendants are fewer than there
 * are children on its way down. */
#define FLOOD_DEEP 1024u
#define FLOOD_ROOM (FLOOD_DEEP + FLOOD_ROUND * WIDTH + (WIDTH - 1) * LEVELS_MAX + 32)
#define SHARED_ROOM ((WIDTH - 1) * LEVELS_MAX + 2 * WIDTH)

struct pool { /* of pairs: lanes of the lot, and references */
	uint32_t n;
	uint8_t *lane;
	uint32_t *ref;
};

struct flood { /* of a lot */
	const struct lot *lot;
	const struct batch *batch;
	struct asked *asked;
	float aim[LOT][16] __attribute__((aligned(64))), box[LOT][16]; /* see ride_rows() */
	uint64_t octant[8]; /* lanes whose directions have these signs */
	uint32_t octants;
	uint64_t found; /* lanes */
	uint32_t pending;
	uint32_t id[RIDE_PENDING + 16], lane[RIDE_PENDING + 16]; /* what the doubles are to be asked */
	struct pool now, wait, leaf;
	uint8_t in[FLOOD_ROUND];
	uint32_t share_ref[SHARED_ROOM];
	uint64_t share_lanes[SHARED_ROOM];
	uint32_t now_ref[FLOOD_ROUND + 32], leaf_ref[FLOOD_ROUND + 32], wait_ref[FLOOD_ROOM];
	uint8_t now_lane[FLOOD_ROUND + 32], leaf_lane[FLOOD_ROUND + 32], wait_lane[FLOOD_ROOM];
} __attribute__((aligned(64)));

/* Children of bits go to the end, which is n, for a lane. How many there are now; there is room for eight. */
V uint32_t pool_add(uint8_t *to_lane, uint32_t *to_ref, uint32_t n, uint32_t bits, const uint32_t *child, uint32_t lane)
{
	__m256i kids = _mm256_load_si256((const __m256i *)child);
	uint64_t lanes = lane * 0x0101010101010101u;

#if ISA_LEVEL >= 3
	_mm256_storeu_si256((__m256i *)(to_ref + n), _mm256_maskz_compress_epi32((__mmask8)bits, kids));
#else
	f8_put(to_ref + n, kids, _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)bvh8_lanes[bits])));
#endif
	memcpy(to_lane + n, &lanes, sizeof(lanes));
	return n + (uint32_t)__builtin_popcount(bits);
}

#if ISA_LEVEL >= 3
V void pool_put(struct pool *p, __mmask16 in, __m512i lane, __m512i ref)
{
	_mm_storeu_si128((__m128i *)(p->lane + p->n), _mm512_cvtepi32_epi8(_mm512_maskz_compress_epi32(in, lane)));
	_mm512_storeu_si512(p->ref + p->n, _mm512_maskz_compress_epi32(in, ref));
	p->n += (uint32_t)__builtin_popcount(in);
}

/* Pairs from w on, of lanes that are not found, to nodes or leaves; there is room for 16 more. */
V void pool_part(const struct pool *w, uint32_t from, uint64_t found, struct pool *nodes, struct pool *leaves)
{
	const __m512i out = _mm512_broadcastq_epi64(_mm_cvtsi64_si128((long long)found));
	struct pool n = *nodes, l = *leaves;

	for (uint32_t i = from; i < w->n; i += 16) {
		__m512i lane = _mm512_cvtepu8_epi32(_mm_loadu_si128((const __m128i *)(w->lane + i)));
		__m512i ref = _mm512_loadu_si512(w->ref + i), gone;
		__mmask16 in = (__mmask16)(w->n - i < 16 ? (1u << (w->n - i)) - 1 : 0xffff), leaf;

		gone = _mm512_permutexvar_epi32(_mm512_srli_epi32(lane, 5), out);
		gone = _mm512_slli_epi32(_mm512_srlv_epi32(gone, _mm512_and_si512(lane, _mm512_set1_epi32(31))), 31);
		in &= (__mmask16)~_mm512_movepi32_mask(gone);
		leaf = _mm512_movepi32_mask(ref);
		pool_put(&n, in & ~leaf, lane, ref);
		pool_put(&l, in & leaf, lane, ref);
	}
	nodes->n = n.n;
	leaves->n = l.n;
}
#else
V void pool_part(const struct pool *w, uint32_t from, uint64_t found, struct pool *nodes, struct pool *leaves)
{
	uint32_t n = nodes->n, l = leaves->n;

	for (uint32_t i = from; i < w->n; i++) {
		uint32_t lane = w->lane[i], ref = w->ref[i], in = ~(uint32_t)(found >> lane) & 1;

		nodes->lane[n] = leaves->lane[l] = (uint8_t)lane;
		nodes->ref[n] = leaves->ref[l] = ref;
		n += in & ~ref >> 31;
		l += in & ref >> 31;
	}
	nodes->n = n;
	leaves->n = l;
}
#endif

/* Which children of a node a ray enters. */
V uint32_t flood_enters(const struct node *node, const float *r)
{
	const char *n = (const char *)node;
	f8 t0 = f8_all(0), t1 = f8_all(r[AT_REACH]);

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		uint32_t at = word_of(&r[AT_PLANE + k]);
		f8 v = f8_all(r[AT_INVERSE + k]);

		t0 = f8_max(f8_mul_add(f8_load((const float *)(n + at)), v, f8_all(r[AT_NEAR_O + k])), t0);
		t1 = f8_min(f8_mul_add(f8_load((const float *)(n + (at ^ 32))), v, f8_all(r[AT_FAR_O + k])), t1);
	}
	return f8_le(t0, t1);
}

V void flood_fetch(const ald_accel *a, uint32_t ref)
{
	const char *p = (const char *)&a->node[ref];

	__builtin_prefetch(p);
	__builtin_prefetch(p + 64);
	__builtin_prefetch(p + 128);
	__builtin_prefetch(p + 192);
}

V void flood_fetch_block(const ald_accel *a, uint32_t ref)
{
	const char *p = (const char *)&a->block[ref & REF_INDEX];

	__builtin_prefetch(p);
	__builtin_prefetch(p + 64);
	__builtin_prefetch(p + 128);
	__builtin_prefetch(p + 175);
}

/* What a round is: the last that wait, or the last one where too many do. */
V void flood_turn(const ald_accel *a, struct flood *f)
{
	uint32_t n = f->wait.n < FLOOD_ROUND ? f->wait.n : FLOOD_ROUND, from;

	n = f->wait.n > FLOOD_DEEP ? 1 : n;
	from = f->wait.n - n;
	f->now.n = f->leaf.n = 0;
	pool_part(&f->wait, from, f->found, &f->now, &f->leaf);
	f->wait.n = from;
	for (uint32_t i = 0; a->far && i < f->leaf.n; i++)
		flood_fetch_block(a, f->leaf_ref[i]);
	for (uint32_t i = 0; a->far && i < f->now.n; i++)
		flood_fetch(a, f->now_ref[i]);
}

V void flood_nodes(const ald_accel *a, struct flood *f)
{
	uint32_t n = f->now.n, from = f->wait.n;

	for (uint32_t i = 0; i < n; i++)
		f->in[i] = (uint8_t)flood_enters(&a->node[f->now_ref[i]], f->box[f->now_lane[i]]);
	for (uint32_t i = 0; i < n; i++)
		from = pool_add(f->wait_lane, f->wait_ref, from, f->in[i], a->node[f->now_ref[i]].child,
				f->now_lane[i]);
	f->wait.n = from;
}

/* Ask the doubles about what is pending of rays that are not hit yet. */
V void flood_settle(const ald_accel *a, struct flood *f)
{
	struct asked *q = f->asked;

	for (uint32_t i = 0; i < f->pending; i++) {
		q->ray[q->n] = f->lot->index[f->lane[i]];
		q->id[q->n] = f->id[i];
		q->n += !(f->found >> f->lane[i] & 1);
		if (q->n == ASKED_MAX)
			ask(a, f->batch, q);
	}
	f->pending = 0;
}

/* GROUP pairs from i on, count of them to be counted, and a block of each's leaf. */
V void flood_meet(const ald_accel *a, struct flood *f, uint32_t i, uint32_t count)
{
	const char *ray[GROUP];
	uint32_t lane[4];
	const float *box[GROUP];
	struct clash m;

	UNROLL
	for (unsigned j = 0; j < GROUP; j++) {
		lane[j] = f->leaf_lane[i + j];
		ray[j] = (const char *)f->aim[lane[j]];
		box[j] = f->box[lane[j]];
	}
	clash_load(a, ray, box, f->leaf_ref + i, &m);
	m.tfar = G_SPREAD(m.aim[3], 3);
	clash_weigh(&m);
	m.maybe &= count < GROUP ? (1u << 4 * count) - 1 : UINT32_MAX;
	clash_bounds(&m);
	m.maybe &= ~clash_behind(&m) | m.sure;
	f->found |= rays_lanes(rays_of(m.sure), lane);
	m.maybe &= ~m.sure;
	if (!m.maybe)
		return;
	g_pack((float *)&f->id[f->pending], m.ids, m.maybe);
	g_pack((float *)&f->lane[f->pending], g_each(lane), m.maybe);
	f->pending += (uint32_t)__builtin_popcount(m.maybe);
	if (f->pending > RIDE_PENDING)
		flood_settle(a, f);
}

/* All that are on the list, block by block, until each has met its leaf's last. */
V void flood_leaves(const ald_accel *a, struct flood *f)
{
	uint32_t *ref = f->leaf_ref;
	uint8_t *lane = f->leaf_lane;

	while (f->leaf.n) {
		uint32_t n = 0;

		for (uint32_t j = 0; j < GROUP; j++) {
			lane[f->leaf.n + j] = lane[0];
			ref[f->leaf.n + j] = ref[0];
		}
		for (uint32_t i = 0; i < f->leaf.n; i += GROUP)
			flood_meet(a, f, i, f->leaf.n - i);
		for (uint32_t i = 0; i < f->leaf.n; i++) {
			uint32_t leaf = ref[i];
			uint8_t at = lane[i];

			lane[n] = at;
			ref[n] = leaf - ((1u << REF_SHIFT) - 1);
			n += (leaf & 7u << REF_SHIFT) != 0 && !(f->found >> at & 1);
		}
		f->leaf.n = n;
	}
}

/* Lanes are to see what stands at ref: four at a time, as there mostly are fewer. */
V void flood_add(struct flood *f, uint32_t ref, uint64_t lanes)
{
	uint32_t n = f->wait.n, end = n + (uint32_t)__builtin_popcountll(lanes);

	for (; n < end; n += 4) {
		_mm_storeu_si128((__m128i *)(f->wait_ref + n), _mm_set1_epi32((int)ref));
		UNROLL
		for (uint32_t i = 0; i < 4; i++) {
			f->wait_lane[n + i] = (uint8_t)__builtin_ctzll(lanes | (uint64_t)1 << 63);
			lanes &= lanes - 1;
		}
	}
	f->wait.n = end;
}

V void flood_ray(const struct flood *f, const f8 near[3], const f8 far[3], unsigned i, __m256i *bits)
{
	const float *r = f->box[i];
	f8 t0 = f8_all(0), t1 = f8_all(r[AT_REACH]);

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		f8 v = f8_all(r[AT_INVERSE + k]);

		t0 = f8_max(f8_mul_add(near[k], v, f8_all(r[AT_NEAR_O + k])), t0);
		t1 = f8_min(f8_mul_add(far[k], v, f8_all(r[AT_FAR_O + k])), t1);
	}
	*bits = f8_mark(*bits, t0, t1, 1u << i % 32);
}

/* Lanes that enter each of a node's children: those of each octant in turn. */
V void flood_share(const struct flood *f, const struct node *n, uint64_t lanes, uint64_t in[WIDTH])
{
	uint32_t word[2][WIDTH] __attribute__((aligned(32)));
	__m256i some = _mm256_setzero_si256(), more = some;

	for (uint32_t octants = f->octants; octants; octants &= octants - 1) {
		unsigned o = (unsigned)__builtin_ctz(octants);
		uint64_t of = lanes & f->octant[o];
		f8 near[3], far[3];

		UNROLL
		for (unsigned k = 0; k < 3; k++) {
			near[k] = f8_load(n->plane[2 * k + (o >> k & 1)]);
			far[k] = f8_load(n->plane[2 * k + (~o >> k & 1)]);
		}
		for (uint32_t bits = (uint32_t)of; bits; bits &= bits - 1)
			flood_ray(f, near, far, (unsigned)__builtin_ctz(bits), &some);
		for (uint32_t bits = (uint32_t)(of >> 32); bits; bits &= bits - 1)
			flood_ray(f, near, far, 32 + (unsigned)__builtin_ctz(bits), &more);
	}
	_mm256_store_si256((__m256i *)word[0], some);
	_mm256_store_si256((__m256i *)word[1], more);
	UNROLL
	for (unsigned c = 0; c < WIDTH; c++)
		in[c] = word[0][c] | (uint64_t)word[1][c] << 32;
}

#if ISA_LEVEL >= 3
/* The same, sixteen lanes in a step, whatever their octants. */
V void flood_rows(const struct flood *f, const struct node *n, uint64_t lanes, uint64_t in[WIDTH])
{
	const struct lot *l = f->lot;
	uint16_t row[WIDTH][LOT / 16] = { 0 };

	for (unsigned i = 0; i < LOT; i += 16) {
		f16 v[3], no[3], fo[3], tfar = f16_load(l->tfar + i);
		uint32_t up[3];

		if (!(lanes >> i & 0xffff))
			continue;
		UNROLL
		for (unsigned k = 0; k < 3; k++) {
			v[k] = f16_load(l->inverse[k] + i);
			no[k] = f16_load(l->near_o[k] + i);
			fo[k] = f16_load(l->far_o[k] + i);
			up[k] = ~(uint32_t)(l->sign[k] >> i);
		}
		UNROLL
		for (unsigned c = 0; c < WIDTH; c++) {
			f16 t0 = f16_all(0), t1 = tfar;

			UNROLL
			for (unsigned k = 0; k < 3; k++) {
				f16 lo = f16_all(n->plane[2 * k][c]), hi = f16_all(n->plane[2 * k + 1][c]);

				t0 = f16_max(f16_mul_add(f16_pick(up[k], lo, hi), v[k], no[k]), t0);
				t1 = f16_min(f16_mul_add(f16_pick(up[k], hi, lo), v[k], fo[k]), t1);
			}
			row[c][i / 16] = (uint16_t)f16_le(t0, t1);
		}
	}
	UNROLL
	for (unsigned c = 0; c < WIDTH; c++) {
		memcpy(&in[c], row[c], sizeof(*in));
		in[c] &= lanes;
	}
}
#endif

/* A node that many lanes are at; how many children are on the stack then. */
V uint32_t flood_together(const ald_accel *a, struct flood *f, uint32_t ref, uint64_t lanes, uint32_t top)
{
	const struct node *n = &a->node[ref];
	uint64_t in[WIDTH];

#if ISA_LEVEL >= 3
	if ((uint32_t)__builtin_popcountll(lanes) >= FLOOD_ROWS)
		flood_rows(f, n, lanes, in);
	else
#endif
		flood_share(f, n, lanes, in);
	UNROLL
	for (unsigned c = 0; c < WIDTH; c++) {
		f->share_ref[top] = n->child[c];
		f->share_lanes[top] = in[c];
		top += in[c] != 0;
	}
	return top;
}

/* Whatever waits. */
V void flood_rounds(const ald_accel *a, struct flood *f)
{
	while (f->wait.n) {
		flood_turn(a, f);
		flood_leaves(a, f);
		flood_nodes(a, f);
	}
}

V void flood_octants(struct flood *f, uint64_t lanes)
{
	const struct lot *l = f->lot;

	f->octants = 0;
	for (unsigned o = 0; o < 8; o++) {
		f->octant[o] = lanes;
		UNROLL
		for (unsigned k = 0; k < 3; k++)
			f->octant[o] &= o >> k & 1 ? l->sign[k] : ~l->sign[k];
		f->octants |= (uint32_t)(f->octant[o] != 0) << o;
	}
}

/* These lanes of the lot, to the end. */
V void flood_lot(const ald_accel *a, struct flood *f, uint64_t lanes)
{
	uint32_t top = lanes != 0;

	f->found = 0;
	flood_octants(f, lanes);
	for (unsigned i = 0; i < LOT; i += 8) {
		if (lanes >> i & 255)
			ride_rows(f->lot, f->batch, f->aim, f->box, i, 1);
	}
	f->share_ref[0] = a->root;
	f->share_lanes[0] = lanes;
	while (top) {
		uint32_t ref = f->share_ref[--top];

		lanes = f->share_lanes[top] & ~f->found;
		if (ref < REF_LEAF && (uint32_t)__builtin_popcountll(lanes) >= FLOOD_SHARED)
			top = flood_together(a, f, ref, lanes, top);
		else
			flood_add(f, ref, lanes);
		if (f->wait.n > FLOOD_DEEP - LOT)
			flood_rounds(a, f);
	}
	flood_rounds(a, f);
	for (uint64_t found = f->found; found; found &= found - 1)
		f->batch->hidden[f->lot->index[__builtin_ctzll(found)]] = 1;
	flood_settle(a, f);
}

/* Are most of n rays short? */
V int are_short(const ald_accel *a, const ald_ray *r, uint32_t n)
{
	uint32_t few = 0, of = 0;

	for (uint32_t i = 0; i < n; i += n / 16 + 1) {
		double x = fabs(r[i].dir.x) + fabs(r[i].dir.y) + fabs(r[i].dir.z);

		few += r[i].tmax * x * a->scale < FLOOD_SHORT;
		of++;
	}
	return 2 * few > of;
}

/* All rays of a batch. */
static __attribute__((noinline)) void serve_flood(const ald_accel *a, ald_query *q, const struct batch *b)
{
	struct source s;
	struct flood f; /* most of it is not touched, mostly */

	f.lot = &s.lot;
	f.batch = b;
	f.asked = &s.asked;
	f.now = (struct pool){ 0, f.now_lane, f.now_ref };
	f.wait = (struct pool){ 0, f.wait_lane, f.wait_ref };
	f.leaf = (struct pool){ 0, f.leaf_lane, f.leaf_ref };
	f.pending = 0;
	source_open(&s, q, b, NULL, 0, 0, b->n);
	while (source_fill(a, &s, 1))
		flood_lot(a, &f, s.left);
	ask(a, b, &s.asked);
}
#endif

#endif
