/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's packets: a lot of rays that go about the same way, together through the tree. Against the eight
 * children of a node goes the whole lot's hull, as interval arithmetic has it (Boulos, Wald, Shirley:
 * Geometric and Arithmetic Culling Methods for Entire Ray Packets, 2006); what that leaves is met by each ray
 * when its turn comes, then with what is known of hits by then. Where few rays are left they go on alone
 * (Benthin, Wald, Woop, Ernst: Combining Single and Packet-Ray Tracing, 2012). Bounds on errors are those of
 * single rays.
 */
#ifndef BVH8_PACK_H
#define BVH8_PACK_H

#include "bvh8_beam.h"

#if ISA_LEVEL >= 2
#define PACK_PENDING (8 * LOT)
#define PACK_FEW 1u /* rays that go on alone */

struct pack {
	/* Loaded and stored whole, so these come first, on the boundaries of the whole. */
	float back[LOT], zfar[LOT], sure_lo[LOT], sure_hi[LOT], oz[LOT];
	struct lot *lot;
	uint32_t from; /* of the batch: the lot's first */
	uint32_t live, found, asked; /* lanes; asked: the doubles were, before the end */
	uint32_t near[3], far[3]; /* which planes of a node */
	uint32_t axis[3];
	f8 edge_near[3], edge_far[3], slow[3], fast[3]; /* the hull: origins, inverse directions */
	float reach; /* tfar of the farthest */
	float side, grow, zerror, extent; /* extent: see beam's reach */
	uint32_t boxes, entered; /* how many were tested, and by how many rays they were entered */
	uint32_t pending;
	float low[PACK_PENDING + LOT], high[PACK_PENDING + LOT]; /* see beam; high in exact order only */
	uint32_t lane[PACK_PENDING + LOT], id[PACK_PENDING + LOT];
	uint32_t stack[STACK_MAX + WIDTH];
	struct beam beam;
} __attribute__((aligned(64)));

/* Do the rays of a lot go the same way, by their signs and main axes? */
V int lot_agrees(const struct lot *l, uint32_t live)
{
	uint32_t mixed = 0;

	for (unsigned k = 0; k < 3; k++) {
		uint32_t s = l->sign[k] & live, m = l->main[k] & live;

		mixed |= (s && s != live) | (m && m != live);
	}
	return !mixed;
}

V void pack_begin(const ald_accel *a, struct pack *p, uint32_t live)
{
	const struct lot *l = p->lot;
	unsigned first = (unsigned)__builtin_ctz(live);
	uint32_t kz = (l->main[1] >> first & 1) + 2 * (l->main[2] >> first & 1);
	float pad = f16_most(f16_pick(live, f16_load(l->pad), f16_all(0))), far = 1 + 4 * pad / EDGE_ERROR;
	f16 depth = f16_load(l->depth), back, zerror;

	p->live = live;
	p->found = p->asked = p->pending = 0;
	p->axis[2] = kz;
	p->axis[0] = kz == 2 ? 0 : kz + 1;
	p->axis[1] = p->axis[0] == 2 ? 0 : p->axis[0] + 1;
	p->side = l->sign[kz] >> first & 1 ? -1.0f : 1.0f;
	p->zerror = a->fast ? 0 : far * DEPTH_ERROR;
	p->grow = a->fast ? 0 : far * far;
	p->extent = 1 / (6 * EDGE_ERROR) / (far * far);
	for (unsigned k = 0; k < 3; k++) {
		uint32_t down = l->sign[k] >> first & 1;
		f16 o = f16_load(l->o[k]), v = f16_load(l->inverse[k]);
		float lo = f16_least(f16_pick(live, o, f16_all(INFINITY))) - (BOX_ERROR + pad);
		float hi = f16_most(f16_pick(live, o, f16_all(-INFINITY))) + (BOX_ERROR + pad);

		p->near[k] = 2 * k + down;
		p->far[k] = 2 * k + 1 - down;
		p->edge_near[k] = f8_all(down ? lo : hi);
		p->edge_far[k] = f8_all(down ? hi : lo);
		p->slow[k] = f8_all(f16_least(f16_pick(live, v, f16_all(INFINITY))));
		p->fast[k] = f8_all(f16_most(f16_pick(live, v, f16_all(-INFINITY))));
	}
	back = f16_mul(f16_load(l->inverse[kz]), f16_all(p->side));
	zerror = f16_all(p->zerror);
	f16_store(p->back, back);
	f16_store(p->oz, f16_mul(f16_load(l->o[kz]), f16_all(p->side)));
	f16_store(p->zfar, f16_mul_add(f16_load(l->tfar), depth, zerror));
	f16_store(p->sure_lo, f16_mul_add(f16_load(l->first), depth, zerror));
	f16_store(p->sure_hi, f16_mul_sub(f16_load(l->last), depth, zerror));
	p->reach = f16_most(f16_pick(live, f16_load(l->tfar), f16_all(-INFINITY)));
}

/* The children that some ray may enter go on the stack, the nearest last: as boxes of their parent. */
V uint32_t pack_node(const ald_accel *a, struct pack *p, uint32_t ref, uint32_t top)
{
	const struct node *n = &a->node[ref];
	f8 t0 = f8_all(0), t1 = f8_all(p->reach);

	for (unsigned k = 0; k < 3; k++) {
		f8 x = f8_sub(f8_load(n->plane[p->near[k]]), p->edge_near[k]);
		f8 y = f8_sub(f8_load(n->plane[p->far[k]]), p->edge_far[k]);

		t0 = f8_max(f8_min(f8_mul(x, p->slow[k]), f8_mul(x, p->fast[k])), t0);
		t1 = f8_min(f8_max(f8_mul(y, p->slow[k]), f8_mul(y, p->fast[k])), t1);
	}
	return top + f8_order_lanes(t0, t1, ref * WIDTH, p->stack + top);
}

/* The rays that enter child k of a node. */
V uint32_t pack_box(const struct pack *p, const struct node *n, unsigned k)
{
	const struct lot *l = p->lot;
	f16 t0 = f16_all(0), t1 = f16_load(l->tfar);

	for (unsigned j = 0; j < 3; j++) {
		f16 v = f16_load(l->inverse[j]);

		t0 = f16_max(f16_mul_add(f16_all(n->plane[p->near[j]][k]), v, f16_load(l->near_o[j])), t0);
		t1 = f16_min(f16_mul_add(f16_all(n->plane[p->far[j]][k]), v, f16_load(l->far_o[j])), t1);
	}
	return f16_le(t0, t1) & p->live;
}

/* Give the doubles what is pending. */
V void pack_settle(const ald_accel *a, const struct batch *s, struct asked *q, struct pack *p)
{
	for (uint32_t i = 0; i < p->pending; i++) {
		uint32_t lane = p->lane[i];

		if (q->n == ASKED_MAX)
			ask(a, s, q);
		q->ray[q->n] = p->from + lane;
		q->id[q->n] = p->id[i];
		q->n += !(p->low[i] > p->lot->tfar[lane]) & !(p->found >> lane & 1);
		p->asked |= 1u << lane;
	}
	p->pending = 0;
}

/* beam_certain() for all: their triangles are pending no more. */
V void pack_certain(const struct batch *s, struct pack *p)
{
	const struct lot *l = p->lot;
	uint32_t best[LOT], some = 0, sure;

	for (uint32_t i = 0; i < p->pending; i++) {
		uint32_t lane = p->lane[i];

		if (!(some >> lane & 1) || p->low[i] < p->low[best[lane]])
			best[lane] = i;
		some |= 1u << lane;
	}
	sure = some & ~p->asked;
	for (uint32_t i = 0; i < p->pending; i++) {
		uint32_t lane = p->lane[i], b = best[lane];

		if (p->id[i] != p->id[b] && !(p->low[i] > p->high[b]))
			sure &= ~(1u << lane);
	}
	for (uint32_t bits = sure; bits; bits &= bits - 1) {
		unsigned lane = (unsigned)__builtin_ctz(bits);
		uint32_t b = best[lane];
		ald_hit *hit = &s->hit[p->from + lane];

		if (hit->prim == ALD_NONE && p->high[b] < INFINITY)
			*hit = certain_hit(p->low[b], p->high[b], l->tscale[lane], l->shift[lane], p->id[b]);
		else
			sure &= ~(1u << lane);
	}
	for (uint32_t i = 0; i < p->pending; i++)
		p->low[i] = sure >> p->lane[i] & 1 ? INFINITY : p->low[i];
}

struct corner {
	f16 x, y, z;
};

V struct corner pack_corner(const struct pack *p, const float (*v)[SEATS], unsigned k)
{
	const struct lot *l = p->lot;
	struct corner c;

	c.z = f16_sub(f16_all(v[p->axis[2]][k] * p->side), f16_load(p->oz));
	c.x = f16_sub(f16_all(v[p->axis[0]][k]), f16_load(l->o[p->axis[0]]));
	c.y = f16_sub(f16_all(v[p->axis[1]][k]), f16_load(l->o[p->axis[1]]));
	c.x = f16_sub_mul(c.x, f16_load(l->shear[0]), c.z);
	c.y = f16_sub_mul(c.y, f16_load(l->shear[1]), c.z);
	return c;
}

V f16 larger(struct corner c)
{
	return f16_max(f16_size(c.x), f16_size(c.y));
}

/* As beam_meet_fast(). */
V void pack_meet_fast(const ald_accel *a, const struct batch *s, struct pack *p, const struct block *n, unsigned k,
		      uint32_t lanes, f16 u, f16 v, f16 sum, int any)
{
	float w[3][LOT] __attribute__((aligned(64)));
	struct lot *l = p->lot;

	f16_store(w[0], u);
	f16_store(w[1], v);
	f16_store(w[2], sum);
	for (; lanes; lanes &= lanes - 1) {
		unsigned i = (unsigned)__builtin_ctz(lanes);
		const ald_ray *r = &s->ray[p->from + i];
		ald_hit own = { .t = r->tmax, .prim = ALD_NONE }, *h = any ? &own : &s->hit[p->from + i];
		float t;

		if (!fast_hit(a, r, n, k, w[0][i], w[1][i], w[2][i], h))
			continue;
		t = limit_of(h->t, l->shift[i], l->tscale[i]);
		if (t < l->tfar[i]) {
			l->tfar[i] = t;
			p->zfar[i] = t * l->depth[i];
		}
		p->found |= (uint32_t)any << i;
	}
	p->live &= ~p->found;
}

/* As beam_block(), beam_sure() and beam_meet(). */
V void pack_triangle(const ald_accel *a, const struct batch *s, struct asked *q, struct pack *p,
		     const struct block *n, unsigned k, uint32_t lanes, int any)
{
	struct lot *l = p->lot;
	struct corner c0 = pack_corner(p, n->v[0], k), c1 = pack_corner(p, n->v[1], k);
	struct corner c2 = pack_corner(p, n->v[2], k);
	f16 w0 = f16_mul_sub(c2.x, c1.y, f16_mul(c2.y, c1.x)), w1 = f16_mul_sub(c0.x, c2.y, f16_mul(c0.y, c2.x));
	f16 w2 = f16_mul_sub(c1.x, c0.y, f16_mul(c1.y, c0.x)), least = f16_min(w0, f16_min(w1, w2));
	f16 most = f16_max(w0, f16_max(w1, w2)), zmin = f16_min(c0.z, f16_min(c1.z, c2.z)), zmax, z, sum, off, size;
	f16 low, high, unsure, back, t;
	float slack = n->slack[k] * p->grow;
	uint32_t maybe, sure;

	maybe = f16_le(f16_all(-slack), least) | f16_le(most, f16_all(slack));
	maybe &= f16_le(zmin, f16_load(p->zfar)) & lanes;
	if (a->fast) {
		pack_meet_fast(a, s, p, n, k, maybe, w1, w2, f16_add(f16_add(w0, w1), w2), any);
		return;
	}
	for (uint32_t bits = maybe; bits; bits &= bits - 1) {
		unsigned i = (unsigned)__builtin_ctz(bits);

		if (!ald_sees(a->prims, &s->ray[p->from + i], n->id[k]))
			maybe &= ~(1u << i);
	}
	if (!maybe)
		return;
	sum = f16_add(f16_add(w0, w1), w2);
	z = f16_div(f16_mul_add(w0, c0.z, f16_mul_add(w1, c1.z, f16_mul(w2, c2.z))), sum);
	zmax = f16_max(c0.z, f16_max(c1.z, c2.z));
	off = f16_max(f16_sub(f16_size(sum), f16_all(3 * slack)), f16_all(0x1p-100f));
	off = f16_div(f16_mul(f16_all(3 * slack), f16_sub(zmax, zmin)), off);
	off = f16_add(off, f16_all(p->zerror));
	low = f16_sub(z, off);
	high = f16_add(z, off);
	unsure = f16_sub(zmin, f16_all(p->zerror));
	size = f16_max(larger(c0), f16_max(larger(c1), larger(c2)));
	sure = f16_le(f16_all(slack), least) | f16_le(most, f16_all(-slack));
	sure &= f16_le(size, f16_all(n->slack[k] * p->grow * p->extent));
	sure &= f16_le(high, f16_load(p->sure_hi)) & f16_le(f16_load(p->sure_lo), low) & maybe;
	back = f16_load(p->back);
	low = f16_mul(f16_max(f16_pick(sure, low, unsure), unsure), back);
	low = f16_sub_mul(low, f16_size(low), f16_all(0x1p-20f));
	t = f16_mul(high, f16_mul(back, f16_all(1 + 0x1p-20f)));
	if (any) {
		p->found |= sure;
		p->live &= ~sure;
		maybe &= ~sure;
	} else {
		f16 tfar = f16_load(l->tfar);

		tfar = f16_min(f16_pick(sure, t, tfar), tfar);
		f16_store(l->tfar, tfar);
		f16_store(p->zfar, f16_mul_add(tfar, f16_load(l->depth), f16_all(p->zerror)));
	}
	if (a->frame.exact && !any)
		f16_pack(p->high + p->pending, p->lane + p->pending, f16_pick(sure, t, f16_all(INFINITY)), maybe);
	f16_pack(p->low + p->pending, p->lane + p->pending, low, maybe);
	for (unsigned i = 0; i < LOT; i++)
		p->id[p->pending + i] = n->id[k];
	p->pending += (uint32_t)__builtin_popcount(maybe);
	if (p->pending > PACK_PENDING)
		pack_settle(a, s, q, p);
}

V void pack_others(const ald_accel *a, const struct batch *s, ald_query *q, struct pack *p, uint32_t ref,
		   uint32_t lanes, int any)
{
	struct lot *l = p->lot;

	for (; lanes; lanes &= lanes - 1) {
		unsigned lane = (unsigned)__builtin_ctz(lanes);
		struct beam *b = &p->beam;

		beam_begin(a, b, l, lane, s, p->from + lane);
		b->ref = ref;
		beam_others(a, q, b, any);
		l->tfar[lane] = b->tfar < l->tfar[lane] ? b->tfar : l->tfar[lane];
		p->zfar[lane] = l->tfar[lane] * l->depth[lane] + p->zerror;
		p->found |= b->found << lane;
	}
	p->live &= ~p->found;
}

/* What is pending of a ray that went alone. */
V void pack_take(const ald_accel *a, const struct batch *s, struct asked *q, struct pack *p, unsigned lane)
{
	const struct beam *b = &p->beam;

	p->asked |= b->asked << lane;
	for (uint32_t i = 0; i < b->pending; i++, p->pending++) {
		p->low[p->pending] = b->low[i];
		p->high[p->pending] = b->high[i];
		p->id[p->pending] = b->id[i];
		p->lane[p->pending] = lane;
	}
	if (p->pending > PACK_PENDING)
		pack_settle(a, s, q, p);
}

/* On alone, from here. */
V void pack_alone(const ald_accel *a, const struct batch *s, struct asked *asked, ald_query *q, struct pack *p,
		  uint32_t ref, uint32_t lanes, int any)
{
	struct beam *b = &p->beam;

	for (; lanes; lanes &= lanes - 1) {
		unsigned lane = (unsigned)__builtin_ctz(lanes);

		beam_begin(a, b, p->lot, lane, s, p->from + lane);
		b->below[1] = ref;
		beam_on(a, s, asked, q, b, any);
		if (a->frame.exact && !any)
			pack_take(a, s, asked, p, lane);
		else
			beam_end(a, s, asked, b, any);
		p->lot->tfar[lane] = b->tfar;
		p->zfar[lane] = b->zfar;
		p->found |= b->found << lane;
	}
	p->live &= ~p->found;
}

V void pack_leaf(const ald_accel *a, const struct batch *s, struct asked *q, struct pack *p, uint32_t ref,
		 uint32_t lanes, int any)
{
	const struct block *n = &a->block[ref & REF_INDEX];
	const struct block *end = n + (ref >> REF_SHIFT & 7) + 1;

	for (; n < end; n++) {
		for (unsigned k = 0; k < SEATS && n->slack[k] >= 0; k++)
			pack_triangle(a, s, q, p, n, k, lanes & p->live, any);
	}
	p->reach = f16_most(f16_pick(p->live, f16_load(p->lot->tfar), f16_all(-INFINITY)));
}

/* p->lot and p->from are set. */
V void pack_walk(const ald_accel *a, const struct batch *s, struct asked *asked, ald_query *q, struct pack *p,
		 uint32_t live, int any)
{
	uint32_t top = 0, ref = a->root, lanes = live;

	pack_begin(a, p, live);
	for (;;) {
		if (ref >= REF_OTHERS)
			pack_others(a, s, q, p, ref, lanes, any);
		else if (ref >= REF_LEAF)
			pack_leaf(a, s, asked, p, ref, lanes, any);
		else
			top = pack_node(a, p, ref, top);
		for (lanes = 0; top && p->live && !lanes;) {
			const struct node *n = &a->node[p->stack[--top] / WIDTH];
			unsigned k = p->stack[top] % WIDTH;

			lanes = pack_box(p, n, k);
			p->boxes++;
			p->entered += (uint32_t)__builtin_popcount(lanes);
			ref = n->child[k];
			if (lanes && (uint32_t)__builtin_popcount(lanes) <= PACK_FEW && ref < REF_OTHERS) {
				pack_alone(a, s, asked, q, p, ref, lanes, any);
				lanes = 0;
			}
		}
		if (!lanes)
			break;
	}
	for (uint32_t found = p->found; any && found; found &= found - 1)
		s->hidden[p->from + (uint32_t)__builtin_ctz(found)] = 1;
	if (a->frame.exact && !any)
		pack_certain(s, p);
	pack_settle(a, s, asked, p);
}
#endif

#endif
