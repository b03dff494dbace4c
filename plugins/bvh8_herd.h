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

#include "bvh8_beam.h"

#if ISA_LEVEL >= 2
#define HERD_PENDING 512u
#define HERD_MANY 6u /* rays that are worth a hull */
#define HERD_ROW 3u /* of sixteen rays, that go together against a triangle */
#define HERD_AHEAD 3u
#define HERD_LEAST 16u
#define HERD_TOGETHER 5u /* rays that open a node together, on average, or herds do not pay */
#define HERD_FETCH (24 * sizeof(ald_ray)) /* how far ahead rays are fetched */
#define TESTED UINT32_MAX

struct herd {
	struct lot lot;
	float back[LOT], zfar[LOT], sure_lo[LOT], sure_hi[LOT], before[LOT], oz[LOT], zerror[LOT];
	f8 edge_near[3], edge_far[3], slow[3], fast[3]; /* the hull: origins, inverse directions */
	uint64_t live, found, asked; /* lanes; asked: the doubles were, before the end */
	float reach; /* tfar of the farthest */
	float side, grow, extent; /* extent: see beam's reach */
	uint32_t near[3], far[3]; /* which planes of a node */
	uint32_t axis[3], size;
	uint32_t steps, rays; /* nodes that were opened, by how many rays */
	uint32_t pending;
	float low[HERD_PENDING + 16], high[HERD_PENDING + 16]; /* see beam; high in exact order only */
	uint32_t lane[HERD_PENDING + 16], id[HERD_PENDING + 16];
	/* The stack: what is to be seen, by which rays, where the first of them may enter it, and which box they
	 * are to be tested against yet, as its node's child. */
	uint32_t ref[STACK_MAX + WIDTH], some[STACK_MAX + WIDTH], more[STACK_MAX + WIDTH], box[STACK_MAX + WIDTH];
	float enter[STACK_MAX + WIDTH];
	struct beam beam;
} __attribute__((aligned(64)));

V void herd_hull(struct herd *h, float pad)
{
	const struct lot *l = &h->lot;

	for (unsigned k = 0; k < 3; k++) {
		f16 lo = f16_all(INFINITY), hi = f16_all(-INFINITY), slow = lo, fast = hi;
		float least, most;

		for (unsigned i = 0; i < h->size; i += 16) {
			uint32_t in = (uint32_t)(h->live >> i) & 0xffff;
			f16 o = f16_load(l->o[k] + i), v = f16_load(l->inverse[k] + i);

			lo = f16_min(f16_pick(in, o, lo), lo);
			hi = f16_max(f16_pick(in, o, hi), hi);
			slow = f16_min(f16_pick(in, v, slow), slow);
			fast = f16_max(f16_pick(in, v, fast), fast);
		}
		least = f16_least(lo) - (BOX_ERROR + pad);
		most = f16_most(hi) + (BOX_ERROR + pad);
		h->edge_near[k] = f8_all(h->near[k] & 1 ? least : most);
		h->edge_far[k] = f8_all(h->near[k] & 1 ? most : least);
		h->slow[k] = f8_all(f16_least(slow));
		h->fast[k] = f8_all(f16_most(fast));
	}
}

V void herd_begin(const ald_accel *a, struct herd *h)
{
	const struct lot *l = &h->lot;
	uint32_t kz = h->axis[2];
	f16 pads = f16_all(0), reach = f16_all(-INFINITY), tiny = f16_all(DEPTH_LEAST);
	float pad, far;

	h->found = h->asked = 0;
	h->pending = 0;
	for (unsigned i = 0; i < h->size; i += 16) {
		uint32_t in = (uint32_t)(h->live >> i) & 0xffff;
		f16 depth = f16_load(l->depth + i), p = f16_load(l->pad + i), t, near, far_z, tfar, zerror;

		pads = f16_max(f16_pick(in, p, pads), pads);
		zerror = a->fast ? f16_all(0) : f16_mul_add(p, f16_all(0x1p15f), tiny);
		f16_store(h->zerror + i, zerror);
		f16_store(h->back + i, f16_mul(f16_load(l->inverse[kz] + i), f16_all(h->side)));
		f16_store(h->oz + i, f16_mul(f16_load(l->o[kz] + i), f16_all(h->side)));
		near = f16_mul(f16_load(l->first + i), depth);
		t = f16_mul(f16_size(near), tiny);
		f16_store(h->sure_lo + i, f16_add(near, t));
		f16_store(h->before + i, f16_sub(near, t));
		far_z = f16_mul(f16_load(l->last + i), depth);
		f16_store(h->sure_hi + i, f16_sub_mul(far_z, f16_size(far_z), tiny));
		tfar = f16_load(l->tfar + i);
		f16_store(h->zfar + i, f16_mul_add(tfar, depth, f16_add(zerror, f16_all(a->fast ? 0 : DEPTH_ERROR))));
		reach = f16_max(f16_pick(in, tfar, reach), reach);
	}
	h->reach = f16_most(reach);
	pad = f16_most(pads);
	far = 1 + 4 * pad / EDGE_ERROR;
	h->grow = a->fast ? 0 : far * far;
	h->extent = 1 / (6 * EDGE_ERROR) / (far * far);
	herd_hull(h, pad);
}

/* The lanes of a row of sixteen, from lane i on, that enter a node's child. */
V uint32_t herd_box(const struct herd *h, const struct node *n, unsigned k, unsigned i)
{
	const struct lot *l = &h->lot;
	f16 t0 = f16_all(0), t1 = f16_load(l->tfar + i);

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
			top += f8_order_lanes(t0, t1, 0, h->box + top);
			for (uint32_t i = from; i < top; i++) {
				h->ref[i] = n->child[h->box[i]];
				h->box[i] += ref * WIDTH;
				h->some[i] = (uint32_t)mask;
				h->more[i] = (uint32_t)(mask >> 32);
			}
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

/* Give the doubles what is pending. */
V void herd_settle(const ald_accel *a, const struct batch *s, struct asked *q, struct herd *h)
{
	for (uint32_t i = 0; i < h->pending; i++) {
		uint32_t lane = h->lane[i];

		if (q->n == ASKED_MAX)
			ask(a, s, q);
		q->ray[q->n] = h->lot.index[lane];
		q->id[q->n] = h->id[i];
		q->n += !(h->low[i] > h->lot.tfar[lane]) & !(h->found >> lane & 1);
		h->asked |= (uint64_t)1 << lane;
	}
	h->pending = 0;
}

/* beam_certain() for all: their triangles are pending no more. */
V void herd_certain(const struct batch *s, struct herd *h)
{
	const struct lot *l = &h->lot;
	uint32_t best[LOT];
	uint64_t some = 0, sure;

	for (uint32_t i = 0; i < h->pending; i++) {
		uint32_t lane = h->lane[i];

		if (!(some >> lane & 1) || h->low[i] < h->low[best[lane]])
			best[lane] = i;
		some |= (uint64_t)1 << lane;
	}
	sure = some & ~h->asked;
	for (uint32_t i = 0; i < h->pending; i++) {
		uint32_t lane = h->lane[i], b = best[lane];

		if (h->id[i] != h->id[b] && !(h->low[i] > h->high[b]))
			sure &= ~((uint64_t)1 << lane);
	}
	for (uint64_t bits = sure; bits; bits &= bits - 1) {
		unsigned lane = (unsigned)__builtin_ctzll(bits);
		uint32_t b = best[lane];
		ald_hit *hit = &s->hit[l->index[lane]];

		if (hit->prim == ALD_NONE && h->high[b] < INFINITY)
			*hit = certain_hit(h->low[b], h->high[b], l->tscale[lane], l->shift[lane], h->id[b]);
		else
			sure &= ~((uint64_t)1 << lane);
	}
	for (uint32_t i = 0; i < h->pending; i++)
		h->low[i] = sure >> h->lane[i] & 1 ? INFINITY : h->low[i];
}

/* ---- triangles ---- */

struct corner {
	f16 x, y, z;
};

V struct corner herd_corner(const struct herd *h, const float (*v)[SEATS], unsigned k, unsigned i)
{
	const struct lot *l = &h->lot;
	struct corner c;

	c.z = f16_sub(f16_all(v[h->axis[2]][k] * h->side), f16_load(h->oz + i));
	c.x = f16_sub(f16_all(v[h->axis[0]][k]), f16_load(l->o[h->axis[0]] + i));
	c.y = f16_sub(f16_all(v[h->axis[1]][k]), f16_load(l->o[h->axis[1]] + i));
	c.x = f16_sub_mul(c.x, f16_load(l->shear[0] + i), c.z);
	c.y = f16_sub_mul(c.y, f16_load(l->shear[1] + i), c.z);
	return c;
}

V f16 larger(struct corner c)
{
	return f16_max(f16_size(c.x), f16_size(c.y));
}

/* As beam_meet_fast(). */
V void herd_meet_fast(const ald_accel *a, const struct batch *s, struct herd *h, const struct block *n, unsigned k,
		      unsigned row, uint32_t lanes, f16 u, f16 v, f16 sum, int any)
{
	float w[3][16] __attribute__((aligned(64)));
	struct lot *l = &h->lot;

	f16_store(w[0], u);
	f16_store(w[1], v);
	f16_store(w[2], sum);
	for (; lanes; lanes &= lanes - 1) {
		unsigned i = (unsigned)__builtin_ctz(lanes), lane = row + i;
		const ald_ray *r = &s->ray[l->index[lane]];
		ald_hit own = { .t = r->tmax, .prim = ALD_NONE }, *hit = any ? &own : &s->hit[l->index[lane]];
		float t;

		if (!fast_hit(a, r, n, k, w[0][i], w[1][i], w[2][i], hit))
			continue;
		t = limit_of(hit->t, l->shift[lane], l->tscale[lane]);
		if (t < l->tfar[lane]) {
			l->tfar[lane] = t;
			h->zfar[lane] = t * l->depth[lane];
		}
		h->found |= (uint64_t)any << lane;
	}
	h->live &= ~h->found;
}

/* As block_behind(). */
V uint32_t herd_behind(const struct herd *h, const struct block *n, unsigned k, unsigned row, f16 qz, f16 sum)
{
	const struct lot *l = &h->lot;
	uint32_t x = h->axis[0], y = h->axis[1], z = h->axis[2];
	float ex = n->v[1][x][k] - n->v[0][x][k], ey = n->v[1][y][k] - n->v[0][y][k];
	float ez = (n->v[1][z][k] - n->v[0][z][k]) * h->side, gx = n->v[2][x][k] - n->v[0][x][k];
	float gy = n->v[2][y][k] - n->v[0][y][k], gz = (n->v[2][z][k] - n->v[0][z][k]) * h->side;
	float nx = ey * gz - ez * gy, ny = ez * gx - ex * gz, nz = ex * gy - ey * gx;
	float s = n->slack[k] * (1 / (11 * EDGE_ERROR)), slack = 3 * n->slack[k] * h->grow;
	f16 qx = f16_sub(f16_all(n->v[0][x][k]), f16_load(l->o[x] + row));
	f16 qy = f16_sub(f16_all(n->v[0][y][k]), f16_load(l->o[y] + row)), most, e, up;

	most = f16_max(f16_max(f16_size(qx), f16_size(qy)), f16_size(qz));
	up = f16_mul_add(f16_all(nx), qx, f16_mul_add(f16_all(ny), qy, f16_mul(f16_all(nz), qz)));
	e = f16_mul_add(most, f16_all(s * (0x1p-20f + 0x1p-18f * s)), f16_all(s * s * 0x1p-21f));
	e = f16_mul_add(f16_load(l->pad + row), f16_all(8 * s * s), e);
	return (f16_le(e, up) & f16_le(f16_all(slack), sum)) |
	       (f16_le(e, f16_sub(f16_all(0), up)) & f16_le(sum, f16_all(-slack)));
}

/* A triangle and a row of sixteen rays. As block_meet() and beam_meet(). */
V void herd_triangle(const ald_accel *a, const struct batch *s, struct asked *q, struct herd *h,
		     const struct block *n, unsigned k, unsigned row, uint32_t lanes, int any)
{
	struct lot *l = &h->lot;
	struct corner c0 = herd_corner(h, n->v[0], k, row), c1 = herd_corner(h, n->v[1], k, row);
	struct corner c2 = herd_corner(h, n->v[2], k, row);
	f16 w0 = f16_mul_sub(c2.x, c1.y, f16_mul(c2.y, c1.x)), w1 = f16_mul_sub(c0.x, c2.y, f16_mul(c0.y, c2.x));
	f16 w2 = f16_mul_sub(c1.x, c0.y, f16_mul(c1.y, c0.x)), least = f16_min(w0, f16_min(w1, w2));
	f16 most = f16_max(w0, f16_max(w1, w2)), zmin = f16_min(c0.z, f16_min(c1.z, c2.z)), zmax, z, sum, off, size;
	f16 low, high, back, t, error;
	float slack = n->slack[k] * h->grow;
	uint32_t maybe, sure;

	maybe = f16_le(f16_all(-slack), least) | f16_le(most, f16_all(slack));
	maybe &= f16_le(zmin, f16_load(h->zfar + row)) & lanes;
	if (!maybe)
		return;
	if (a->fast) {
		herd_meet_fast(a, s, h, n, k, row, maybe, w1, w2, f16_add(f16_add(w0, w1), w2), any);
		return;
	}
	for (uint32_t bits = maybe; bits; bits &= bits - 1) {
		unsigned i = (unsigned)__builtin_ctz(bits);

		if (!ald_sees(a->prims, &s->ray[l->index[row + i]], n->id[k]))
			maybe &= ~(1u << i);
	}
	sum = f16_add(f16_add(w0, w1), w2);
	z = f16_div(f16_mul_add(w0, c0.z, f16_mul_add(w1, c1.z, f16_mul(w2, c2.z))), sum);
	zmax = f16_max(c0.z, f16_max(c1.z, c2.z));
	error = f16_max(f16_size(zmin), f16_size(zmax));
	error = f16_mul_add(error, f16_all(DEPTH_RELATIVE), f16_load(h->zerror + row));
	off = f16_max(f16_sub(f16_size(sum), f16_all(3 * slack)), f16_all(0x1p-100f));
	off = f16_div(f16_mul(f16_all(3 * slack), f16_sub(zmax, zmin)), off);
	off = f16_add(off, error);
	size = f16_max(larger(c0), f16_max(larger(c1), larger(c2)));
	sure = f16_le(f16_all(slack), least) | f16_le(most, f16_all(-slack));
	sure &= f16_le(size, f16_all(n->slack[k] * h->grow * h->extent));
	zmin = f16_sub(zmin, error);
	zmax = f16_add(zmax, error);
	low = f16_max(f16_pick(sure, f16_sub(z, off), zmin), zmin);
	high = f16_min(f16_pick(sure, f16_add(z, off), zmax), zmax);
	maybe &= f16_le(f16_load(h->before + row), high);
	sure &= f16_le(high, f16_load(h->sure_hi + row)) & f16_le(f16_load(h->sure_lo + row), low) & maybe;
	if (maybe & ~sure & f16_le(low, f16_load(h->sure_lo + row)))
		maybe &= ~herd_behind(h, n, k, row, c0.z, sum) | sure;
	if (any) {
		h->found |= (uint64_t)sure << row;
		h->live &= ~((uint64_t)sure << row);
		maybe &= ~sure;
		if (!maybe)
			return;
	}
	back = f16_load(h->back + row);
	low = f16_mul(low, back);
	low = f16_sub_mul(low, f16_size(low), f16_all(0x1p-20f));
	if (!any) {
		f16 tfar = f16_load(l->tfar + row);

		t = f16_mul(high, f16_mul(back, f16_all(1 + 0x1p-20f)));
		tfar = f16_min(f16_pick(sure, t, tfar), tfar);
		f16_store(l->tfar + row, tfar);
		f16_store(h->zfar + row, f16_mul_add(tfar, f16_load(l->depth + row),
						     f16_add(f16_load(h->zerror + row), f16_all(DEPTH_ERROR))));
		if (a->frame.exact)
			f16_pack(h->high + h->pending, h->lane + h->pending, f16_pick(sure, t, f16_all(INFINITY)),
				 maybe, row);
	}
	f16_pack(h->low + h->pending, h->lane + h->pending, low, maybe, row);
	for (unsigned i = 0; i < 16; i++)
		h->id[h->pending + i] = n->id[k];
	h->pending += (uint32_t)__builtin_popcount(maybe);
	if (h->pending > HERD_PENDING)
		herd_settle(a, s, q, h);
}

/* A ray and the triangles of a block. */
V void herd_block(const ald_accel *a, const struct batch *s, struct asked *q, struct herd *h, const struct block *n,
		  unsigned lane, int any)
{
	struct lot *l = &h->lot;
	const uint32_t *axis = h->axis;
	const struct aim t = { .o = { l->o[axis[0]][lane], l->o[axis[1]][lane], h->oz[lane] },
			       .shear = { l->shear[0][lane], l->shear[1][lane] },
			       .side = h->side,
			       .zfar = h->zfar[lane],
			       .before = h->before[lane],
			       .sure_lo = h->sure_lo[lane],
			       .sure_hi = h->sure_hi[lane],
			       .zerror = h->zerror[lane],
			       .pad = l->pad[lane],
			       .grow = h->grow,
			       .reach = h->extent,
			       .back = h->back[lane],
			       .axis = { axis[0], axis[1], axis[2] } };
	struct meeting m;

	block_meet(a, &t, n, &s->ray[l->index[lane]], &m, 1);
	if (!m.maybe)
		return;
	if (any && m.sure) {
		h->found |= (uint64_t)1 << lane;
		h->live &= ~((uint64_t)1 << lane);
		return;
	}
	if (!any) {
		f4 high = high_t(&t, &m);
		float least = f4_least(high);

		least = least < l->tfar[lane] ? least : l->tfar[lane];
		l->tfar[lane] = least;
		h->zfar[lane] = least * l->depth[lane] + (t.zerror + DEPTH_ERROR);
		f4_pack(&h->high[h->pending], high, m.maybe);
	}
	f4_pack((float *)&h->id[h->pending], f4_load((const float *)n->id), m.maybe);
	f4_pack(&h->low[h->pending], low_t(&t, m.low), m.maybe);
	for (unsigned i = 0; i < SEATS; i++)
		h->lane[h->pending + i] = lane;
	h->pending += (uint32_t)__builtin_popcount(m.maybe);
	if (h->pending > HERD_PENDING)
		herd_settle(a, s, q, h);
}

V void herd_leaf(const ald_accel *a, const struct batch *s, struct asked *q, struct herd *h, uint32_t ref,
		 uint64_t lanes, int any)
{
	const struct block *n = &a->block[ref & REF_INDEX];
	const struct block *end = n + (ref >> REF_SHIFT & 7) + 1;

	for (; n < end; n++) {
		for (unsigned row = 0; row < h->size; row += 16) {
			uint32_t in = (uint32_t)((lanes & h->live) >> row) & 0xffff;

			if ((uint32_t)__builtin_popcount(in) < HERD_ROW && !a->fast) {
				for (; in; in &= in - 1)
					herd_block(a, s, q, h, n, row + (unsigned)__builtin_ctz(in), any);
				continue;
			}
			for (unsigned k = 0; in && k < SEATS && n->slack[k] >= 0; k++) {
				herd_triangle(a, s, q, h, n, k, row, in, any);
				in &= (uint32_t)(h->live >> row);
			}
		}
	}
}

V void herd_others(const ald_accel *a, const struct batch *s, ald_query *q, struct herd *h, uint32_t ref,
		   uint64_t lanes, int any)
{
	struct lot *l = &h->lot;

	for (; lanes; lanes &= lanes - 1) {
		unsigned lane = (unsigned)__builtin_ctzll(lanes);
		struct beam *b = &h->beam;

		beam_begin(a, b, l, lane, s, l->index[lane]);
		b->ref = ref;
		beam_others(a, q, b, any);
		l->tfar[lane] = b->tfar < l->tfar[lane] ? b->tfar : l->tfar[lane];
		h->zfar[lane] = l->tfar[lane] * l->depth[lane] + (a->fast ? 0 : h->zerror[lane] + DEPTH_ERROR);
		h->found |= (uint64_t)b->found << lane;
	}
	h->live &= ~h->found;
}

/* What is next on the stack. */
V void herd_fetch(const ald_accel *a, const struct herd *h, uint32_t top)
{
	for (uint32_t i = 1; i <= HERD_AHEAD && i <= top; i++) {
		uint32_t ref = h->ref[top - i];
		const char *p = ref < REF_LEAF	   ? (const char *)&a->node[ref] :
				ref < REF_OTHERS ? (const char *)&a->block[ref & REF_INDEX] :
						   (const char *)a->other;

		__builtin_prefetch(p);
		__builtin_prefetch(p + 64);
		__builtin_prefetch(p + 128);
		__builtin_prefetch(p + 192);
	}
}

/* The lot is filled, its live lanes, axes and planes are set. */
V void herd_walk(const ald_accel *a, const struct batch *s, struct asked *asked, ald_query *q, struct herd *h, int any)
{
	uint32_t top = 1;

	herd_begin(a, h);
	h->ref[0] = a->root;
	h->some[0] = (uint32_t)h->live;
	h->more[0] = (uint32_t)(h->live >> 32);
	h->box[0] = TESTED;
	h->enter[0] = -INFINITY;
	while (top) {
		uint32_t ref = h->ref[--top], box = h->box[top];
		uint64_t mask = (h->some[top] | (uint64_t)h->more[top] << 32) & h->live;

		if (box != TESTED)
			mask = herd_boxes(h, &a->node[box / WIDTH], box % WIDTH, mask);
		else if (!any)
			mask = herd_reach(h, h->enter[top], mask);
		if (!mask)
			continue;
		if (ref < REF_LEAF)
			herd_fetch(a, h, top = herd_node(a, h, ref, mask, top, any));
		else if (ref < REF_OTHERS)
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

/* Rays by the way they go: order[], and behind each way where it ends there. */
V void herd_sort(const ald_ray *ray, uint32_t n, uint16_t *order, uint32_t end[WAYS])
{
	uint8_t way[HERD_SORTED];
	uint32_t mixed = 0, sum = 0, one = way_of(&ray[0]);

	for (uint32_t i = 0; i < n; i++) {
		__builtin_prefetch((const char *)(ray + i) + HERD_FETCH);
		__builtin_prefetch((const char *)(ray + i) + HERD_FETCH + 64);
		way[i] = (uint8_t)way_of(&ray[i]);
		mixed |= (uint32_t)way[i] ^ one;
	}
	memset(end, 0, WAYS * sizeof(*end));
	if (!mixed) { /* mostly, where rays are coherent */
		for (uint32_t i = 0; i < n; i++)
			order[i] = (uint16_t)i;
		for (unsigned k = one; k < WAYS; k++)
			end[k] = n;
		return;
	}
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

/* n rays that go one way. */
V void herd_serve(const ald_accel *a, const struct batch *b, struct asked *asked, ald_query *q, struct herd *h,
		  const uint16_t *order, uint32_t from, uint32_t n, uint32_t way, int any)
{
	struct lot *l = &h->lot;

	for (uint32_t i = 0; i < n; i++)
		l->index[i] = from + order[i];
	lot_fill(a, l, b, n);
	lot_odd(a, q, b, l, any);
	h->live = l->live & ~l->odd;
	if (!h->live)
		return;
	h->size = n;
	h->axis[2] = way / 8;
	h->axis[0] = h->axis[2] == 2 ? 0 : h->axis[2] + 1;
	h->axis[1] = h->axis[0] == 2 ? 0 : h->axis[0] + 1;
	h->side = way >> h->axis[2] & 1 ? -1.0f : 1.0f;
	for (unsigned k = 0; k < 3; k++) {
		h->near[k] = 2 * k + (way >> k & 1);
		h->far[k] = 2 * k + 1 - (way >> k & 1);
	}
	herd_walk(a, b, asked, q, h, any);
}

#endif

#endif
