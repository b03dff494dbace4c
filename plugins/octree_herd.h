/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * octree's herds: up to 64 rays of one octant and main axis together through the tree, with a bit for each of them
 * (Barringer, Akenine-Moeller: Dynamic Ray Stream Traversal, 2014). It suits an octree: in an octant's order counting
 * children upwards is front to back for all rays of it, so that nothing is sorted, and three planes a node, which no
 * ray meets in another order, tell for DW rays at once which of the eight children each of them enters. A ray's own
 * arithmetic is that of octree_walk.h, with the pads of rule R4.
 */
#ifndef OCTREE_HERD_H
#define OCTREE_HERD_H

#include "lane_triangle.h"
#include "octree.h"

#define HERD 64u
#define WAYS 24u
#define HERD_TRY 12u /* cells; if less than HERD_TOGETHER rays open one together, on average, herds do not pay */
#define HERD_TOGETHER 5u

struct batch { /* the rays of a call */
	const ald_ray *ray;
	ald_hit *hit; /* NULL: any will do, and hidden is told */
	uint8_t *hidden;
};

struct cell { /* an inner one on the way down; planes in the order that rays meet them in */
	double near[3], middle[3], far[3];
	uint64_t mask[8]; /* of the rays that enter a child */
	uint32_t node, todo; /* children still to visit, in the order of the rays */
};

struct herd {
	double o[3][HERD], d[3][HERD], inv[3][HERD], near_o[3][HERD], far_o[3][HERD]; /* as in ald_prep */
	double shear[2][HERD], pad[HERD], slack[HERD];
	double t0[HERD], t1[HERD]; /* the part of the ray that is inside of everything's box, up to its hit */
	double first[HERD], last[HERD]; /* a t beyond does not count */
	uint32_t index[HERD]; /* of the batch */
	uint32_t size, kx, ky, kz, flip;
	uint64_t live; /* those that are still under way */
	uint64_t odd; /* those that no triangle stands: by themselves */
	uint64_t picky; /* those that do not see everything */
	uint64_t ready; /* those whose prep is made */
	struct cell cell[DEPTH_MAX];
	ald_prep prep[HERD]; /* for the few triangles that the lanes leave to the kernel */
} __attribute__((aligned(64)));

#define ALL_LANES ((1u << DW) - 1)

/* ---- making ready ---- */

/* The way that each lane goes: its octant, and 8 times its main axis. */
V void ways_of(const dv d[3], uint8_t way[DW])
{
	dv size[3] = { dv_size(d[0]), dv_size(d[1]), dv_size(d[2]) };
	dm x_y = dv_gt(size[0], size[1]);
	uint32_t x = dm_bits(dm_and(x_y, dv_gt(size[0], size[2]))), y = dm_bits(dm_less(dv_gt(size[1], size[2]), x_y));
	uint32_t down[3] = { dm_bits(dv_sign(d[0])), dm_bits(dv_sign(d[1])), dm_bits(dv_sign(d[2])) };

	for (unsigned i = 0; i < DW; i++)
		way[i] = (uint8_t)((2 - 2 * (x >> i & 1) - (y >> i & 1)) * 8 + (down[0] >> i & 1) +
				   (down[1] >> i & 1) * 2 + (down[2] >> i & 1) * 4);
}

/* Lanes i and on, DW of them. x: origin, direction, tmin, tmax by component; last: nothing behind counts. */
V void herd_lanes(const ald_accel *a, struct herd *h, unsigned i, const dv x[8], dv last)
{
	const double *lo = &a->box.lo.x, *hi = &a->box.hi.x, *middle = &a->frame.centre.x;
	dv t0 = x[6], t1 = last, pad, size, huge = dv_all(0x1p400), up;
	dm fine;

	size = dv_add(dv_add(dv_size(dv_sub(x[0], dv_all(middle[0]))), dv_size(dv_sub(x[1], dv_all(middle[1])))),
		      dv_size(dv_sub(x[2], dv_all(middle[2]))));
	size = dv_add(size, dv_all(a->frame.radius));
	pad = dv_mul(dv_all(16 * ALD_U), size);
	up = dv_size(x[3 + h->kz]);
	fine = dm_and(dm_and(dv_gt(huge, size), dv_gt(huge, up)), dv_gt(up, dv_all(0x1p-400)));
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		const unsigned down = h->flip >> k & 1;
		dv o = x[k], d = x[3 + k], inv = dv_div(dv_all(1), d);
		dv less = dv_sub(o, pad), more = dv_add(o, pad), near = down ? less : more, far = down ? more : less;

		t0 = dv_max(dv_mul(dv_sub(dv_all(down ? hi[k] : lo[k]), near), inv), t0);
		t1 = dv_min(dv_mul(dv_sub(dv_all(down ? lo[k] : hi[k]), far), inv), t1);
		dv_store(h->o[k] + i, o);
		dv_store(h->d[k] + i, d);
		dv_store(h->inv[k] + i, inv);
		dv_store(h->near_o[k] + i, near);
		dv_store(h->far_o[k] + i, far);
	}
	dv_store(h->shear[0] + i, dv_div(x[3 + h->kx], x[3 + h->kz]));
	dv_store(h->shear[1] + i, dv_div(x[3 + h->ky], x[3 + h->kz]));
	dv_store(h->pad + i, pad);
	dv_store(h->slack + i, dv_mul(dv_mul(pad, pad), dv_all(0.75 / ALD_U)));
	dv_store(h->t0 + i, t0);
	dv_store(h->t1 + i, t1);
	dv_store(h->first + i, x[6]);
	dv_store(h->last + i, last);
	h->live |= (uint64_t)(~dm_bits(dv_gt(t0, t1)) & ALL_LANES) << i;
	h->odd |= (uint64_t)(~dm_bits(fine) & ALL_LANES) << i;
}

/* Of the rays of index[], that go this way. */
V void herd_fill(const ald_accel *a, struct herd *h, const struct batch *b, uint32_t n, uint32_t way)
{
	h->size = n;
	h->flip = way % 8;
	h->kz = way / 8;
	h->kx = h->kz == 2 ? 0 : h->kz + 1;
	h->ky = h->kx == 2 ? 0 : h->kx + 1;
	h->live = h->odd = h->picky = h->ready = 0;
	for (unsigned i = 0; i < n; i += DW) {
		const double *at[DW];
		double t[DW];
		dv x[8];

		for (unsigned j = 0; j < DW; j++) {
			uint32_t r = h->index[i + j < n ? i + j : n - 1];

			at[j] = &b->ray[r].org.x;
			t[j] = b->hit ? b->hit[r].t : b->ray[r].tmax;
			h->picky |= (uint64_t)(b->ray[r].skip != ALD_NONE || a->prims->mask) << (i + j) % HERD;
		}
		dv_columns(at, x);
		herd_lanes(a, h, i, x, dv_load(t));
	}
	h->live &= n < HERD ? ((uint64_t)1 << n) - 1 : UINT64_MAX;
	h->odd &= h->live;
	h->live &= ~h->odd;
}

/* ---- triangles ---- */

V const ald_prep *herd_prep(const ald_accel *a, struct herd *h, const struct batch *b, unsigned lane)
{
	if (!(h->ready >> lane & 1))
		ald_ray_prep(&a->frame, &b->ray[h->index[lane]], &h->prep[lane]);
	h->ready |= (uint64_t)1 << lane;
	return &h->prep[lane];
}

/* The hit of a lane is nearer now, or any will do. */
V void herd_nearer(struct herd *h, const struct batch *b, unsigned lane)
{
	if (b->hit) {
		double t = b->hit[h->index[lane]].t;

		h->last[lane] = t;
		h->t1[lane] = t < h->t1[lane] ? t : h->t1[lane];
	} else {
		b->hidden[h->index[lane]] = 1;
		h->live &= ~((uint64_t)1 << lane);
	}
}

/* A triangle and a lane, by the kernel. */
static __attribute__((noinline, unused)) void herd_kernel(const ald_accel *a, struct herd *h, const struct batch *b,
							  const ald_vec v[3], uint32_t id, unsigned lane)
{
	const ald_ray *r = &b->ray[h->index[lane]];
	ald_hit own = { .t = r->tmax, .prim = ALD_NONE };

	if (ald_triangle(herd_prep(a, h, b, lane), r, v, id, b->hit ? &b->hit[h->index[lane]] : &own))
		herd_nearer(h, b, lane);
}

/* A triangle and a row of lanes. */
V void herd_answer(const struct herd *h, const ald_vec v[3], unsigned row, struct answer *r)
{
	dv sx = dv_load(h->shear[0] + row), sy = dv_load(h->shear[1] + row);
	struct pairs p;

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		p.o[k] = dv_load(h->o[k] + row);
		p.d[k] = dv_load(h->d[k] + row);
		p.inv[k] = dv_load(h->inv[k] + row);
		UNROLL
		for (unsigned j = 0; j < 3; j++)
			p.v[j][k] = dv_all(ald_get(&v[j], k));
	}
	UNROLL
	for (unsigned j = 0; j < 3; j++) {
		dv z = dv_sub(dv_all(ald_get(&v[j], h->kz)), dv_load(h->o[h->kz] + row));

		p.x[j] = dv_sub(dv_sub(dv_all(ald_get(&v[j], h->kx)), dv_load(h->o[h->kx] + row)), dv_mul(sx, z));
		p.y[j] = dv_sub(dv_sub(dv_all(ald_get(&v[j], h->ky)), dv_load(h->o[h->ky] + row)), dv_mul(sy, z));
	}
	p.pad = dv_load(h->pad + row);
	p.first = dv_load(h->first + row);
	p.last = dv_load(h->last + row);
	pairs_answer(&p, r);
}

/* A triangle that these lanes of a row may hit. */
static __attribute__((noinline, unused)) void herd_settle(const ald_accel *a, struct herd *h, const struct batch *b,
							  const ald_triangles *s, unsigned j, uint32_t id, unsigned row,
							  uint32_t in)
{
	struct answer r;
	ald_vec v[3];

	for (uint32_t m = in & (uint32_t)(h->picky >> row); m; m &= m - 1) {
		unsigned i = (unsigned)__builtin_ctz(m);

		if (!ald_sees(a->prims, &b->ray[h->index[row + i]], id))
			in &= ~(1u << i);
	}
	if (!in)
		return;
	for (unsigned k = 0; k < 3; k++)
		v[k] = (ald_vec){ s->v[k][0][j], s->v[k][1][j], s->v[k][2][j] };
	if (a->frame.exact) {
		for (; in; in &= in - 1)
			herd_kernel(a, h, b, v, id, row + (unsigned)__builtin_ctz(in));
		return;
	}
	herd_answer(h, v, row, &r);
	for (uint32_t m = in & r.hit; m; m &= m - 1) {
		unsigned i = (unsigned)__builtin_ctz(m), lane = row + i;
		const ald_ray *ray = &b->ray[h->index[lane]];
		ald_hit own = { .t = ray->tmax, .prim = ALD_NONE }, *hit = b->hit ? &b->hit[h->index[lane]] : &own;

		if (!ald_counts(ray, r.t[i], id, hit))
			continue;
		*hit = (ald_hit){ .t = r.t[i], .u = r.u[i], .v = r.v[i], .prim = id };
		herd_nearer(h, b, lane);
	}
	for (uint32_t m = in & r.doubt; m; m &= m - 1)
		herd_kernel(a, h, b, v, id, row + (unsigned)__builtin_ctz(m));
}

struct lines { /* a row of lanes, as ald_rays has them */
	dv o[3], shear[2], slack, minus;
};

/* The lanes that may hit triangle j: as ald_rays_triangle(), and rounded more seldom. x, y, z: its corners, a block's
 * length apart. */
V uint32_t herd_meets(const struct lines *l, const double *x, const double *y, const double *z)
{
	dv p[3], q[3], w[3], least, most;

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		dv up = dv_sub(dv_all(z[3 * ALD_LANES * k]), l->o[2]);

		p[k] = dv_sub_mul(dv_sub(dv_all(x[3 * ALD_LANES * k]), l->o[0]), l->shear[0], up);
		q[k] = dv_sub_mul(dv_sub(dv_all(y[3 * ALD_LANES * k]), l->o[1]), l->shear[1], up);
	}
	w[0] = dv_mul_sub(p[2], q[1], dv_mul(q[2], p[1]));
	w[1] = dv_mul_sub(p[0], q[2], dv_mul(q[0], p[2]));
	w[2] = dv_mul_sub(p[1], q[0], dv_mul(q[1], p[0]));
	least = dv_min(dv_min(w[0], w[1]), w[2]);
	most = dv_max(dv_max(w[0], w[1]), w[2]);
	return dm_bits(dm_or(dv_gt(least, l->minus), dv_gt(l->slack, most)));
}

/* The triangles of a leaf and a row of lanes. */
V void herd_row(const ald_accel *a, struct herd *h, const struct batch *b, const struct leaf *leaf, unsigned row,
		uint32_t in, int any)
{
	struct lines l = { .o = { dv_load(h->o[h->kx] + row), dv_load(h->o[h->ky] + row), dv_load(h->o[h->kz] + row) },
			   .shear = { dv_load(h->shear[0] + row), dv_load(h->shear[1] + row) },
			   .slack = dv_load(h->slack + row) };

	l.minus = dv_sub(dv_all(0), l.slack);
	for (uint32_t i = 0; i < leaf->tris; i += ALD_LANES) {
		const uint32_t at = leaf->block + i / ALD_LANES;
		const uint32_t n = leaf->tris - i < ALD_LANES ? leaf->tris - i : ALD_LANES;
		const ald_triangles *s = &a->block[at];
		const double *x = s->v[0][h->kx], *y = s->v[0][h->ky], *z = s->v[0][h->kz];
		uint64_t met = 0; /* DW lanes a triangle */

		for (uint32_t j = 0; j < n; j++)
			met |= (uint64_t)(herd_meets(&l, x + j, y + j, z + j) & in) << j * DW;
		while (met) {
			unsigned j = (unsigned)__builtin_ctzll(met) / DW;
			uint32_t maybe = (uint32_t)(met >> j * DW) & ALL_LANES;

			met &= ~((uint64_t)ALL_LANES << j * DW);
			if (any)
				maybe &= (uint32_t)(h->live >> row);
			if (maybe)
				herd_settle(a, h, b, s, j, a->id[at][j], row, maybe);
		}
		if (any) {
			in &= (uint32_t)(h->live >> row);
			if (!in)
				return;
		}
	}
}

static __attribute__((noinline, unused)) void herd_others(const ald_accel *a, ald_query *q, struct herd *h,
							  const struct batch *b, const struct leaf *leaf, uint64_t mask)
{
	for (; mask; mask &= mask - 1) {
		unsigned lane = (unsigned)__builtin_ctzll(mask);
		const ald_ray *r = &b->ray[h->index[lane]];

		for (uint32_t i = 0; i < leaf->others && h->live >> lane & 1; i++) {
			uint32_t id = a->other[leaf->other + i];
			ald_hit own = { .t = r->tmax, .prim = ALD_NONE };

			if (ald_sees(a->prims, r, id) &&
			    a->prims->intersect(a->prims, id, q, r, b->hit ? &b->hit[h->index[lane]] : &own))
				herd_nearer(h, b, lane);
		}
	}
}

V void herd_leaf(const ald_accel *a, ald_query *q, struct herd *h, const struct batch *b, const struct leaf *leaf,
		 uint64_t mask, int any)
{
	for (unsigned row = 0; row < h->size; row += DW) {
		uint32_t in = (uint32_t)(mask >> row) & ALL_LANES;

		if (in)
			herd_row(a, h, b, leaf, row, in, any);
	}
	if (leaf->others)
		herd_others(a, q, h, b, leaf, mask);
}

/* ---- cells ---- */

V dv plane_t(const double o[3][HERD], const struct herd *h, unsigned k, double plane, unsigned row)
{
	return dv_mul(dv_sub(dv_all(plane), dv_load(o[k] + row)), dv_load(h->inv[k] + row));
}

/* Which children do the rays of mask enter? c has its planes. */
V void herd_open(const ald_accel *a, const struct herd *h, struct cell *c, uint32_t node, uint64_t mask)
{
	uint32_t kids = a->kids[node];
	uint64_t in[8] = { 0 };

	for (unsigned row = 0; row < h->size; row += DW) {
		uint32_t some = (uint32_t)(mask >> row) & ALL_LANES;
		dv en[8], ex[8]; /* of children; the nearest is nearer than all planes in the middle, and so on */

		if (!some)
			continue;
		en[0] = dv_load(h->t0 + row);
		ex[7] = dv_load(h->t1 + row);
		UNROLL
		for (unsigned k = 0; k < 3; k++) {
			en[0] = dv_max(plane_t(h->near_o, h, k, c->near[k], row), en[0]);
			ex[7] = dv_min(plane_t(h->far_o, h, k, c->far[k], row), ex[7]);
		}
		UNROLL
		for (unsigned k = 0; k < 3; k++) {
			dv far = plane_t(h->near_o, h, k, c->middle[k], row);
			dv near = plane_t(h->far_o, h, k, c->middle[k], row);

			UNROLL
			for (unsigned i = 0; i < 4; i++) { /* a length that is known, for -O1's sake */
				if (i >= 1u << k)
					continue;
				en[i + (1u << k)] = dv_max(far, en[i]);
				ex[7 - i - (1u << k)] = dv_min(near, ex[7 - i]);
			}
		}
		UNROLL
		for (unsigned i = 0; i < 8; i++)
			in[i] |= (uint64_t)(~dm_bits(dv_gt(en[i], ex[i])) & some) << row;
	}
	if (h->flip & 1)
		kids = (kids >> 1 & 0x55) | (kids & 0x55) << 1;
	if (h->flip & 2)
		kids = (kids >> 2 & 0x33) | (kids & 0x33) << 2;
	if (h->flip & 4)
		kids = (kids >> 4 & 0x0f) | (kids & 0x0f) << 4;
	c->node = node;
	c->todo = 0;
	for (unsigned i = 0; i < 8; i++) {
		c->mask[i] = in[i];
		c->todo |= (uint32_t)!!in[i] << i;
	}
	c->todo &= kids;
}

/* half: of the child's size. */
V void herd_descend(const struct herd *h, const struct cell *c, struct cell *down, unsigned kid, const double half[3])
{
	for (unsigned k = 0; k < 3; k++) {
		unsigned far = kid >> k & 1;

		down->near[k] = far ? c->middle[k] : c->near[k];
		down->far[k] = far ? c->far[k] : c->middle[k];
		down->middle[k] = (far ^ (h->flip >> k)) & 1 ? c->middle[k] + half[k] : c->middle[k] - half[k];
	}
}

/* The lanes that enter a child before all that they have hit. */
V uint64_t herd_reach(const struct herd *h, const struct cell *c, unsigned kid, uint64_t mask)
{
	uint64_t in = 0;

	for (unsigned row = 0; row < h->size; row += DW) {
		uint32_t some = (uint32_t)(mask >> row) & ALL_LANES;
		dv t = dv_load(h->t0 + row);

		if (!some)
			continue;
		UNROLL
		for (unsigned k = 0; k < 3; k++)
			t = dv_max(plane_t(h->near_o, h, k, kid >> k & 1 ? c->middle[k] : c->near[k], row), t);
		in |= (uint64_t)(~dm_bits(dv_gt(t, dv_load(h->t1 + row))) & some) << row;
	}
	return in;
}

V uint32_t herd_kid(const ald_accel *a, const struct herd *h, const struct cell *c, unsigned kid)
{
	size_t at = 8 * (size_t)c->node + (kid ^ h->flip);

	return a->wide ? a->wide[at] : a->narrow[at];
}

V void herd_root(const ald_accel *a, const struct herd *h, struct cell *c)
{
	for (unsigned k = 0; k < 3; k++) {
		double half = h->flip >> k & 1 ? -a->half[k] : a->half[k];

		c->near[k] = a->centre[k] - half;
		c->middle[k] = a->centre[k];
		c->far[k] = a->centre[k] + half;
	}
}

/* Rays that would open cells alone, mostly, are left in live: 0, and 1 if there are none. */
V int herd_walk(const ald_accel *a, ald_query *q, struct herd *h, const struct batch *b, int any)
{
	struct cell *c = h->cell;
	uint32_t steps = 1, rays = (uint32_t)__builtin_popcountll(h->live);
	double half[DEPTH_MAX + 1][3]; /* of the cells one below */
	int depth = 0;

	if (a->root_is_leaf) {
		herd_leaf(a, q, h, b, &a->leaf[0], h->live, any);
		return 1;
	}
	herd_root(a, h, c);
	for (unsigned k = 0; k < 3; k++)
		half[0][k] = a->half[k] * 0.5;
	herd_open(a, h, c, 0, h->live);
	for (;;) {
		uint32_t next;
		uint64_t mask;
		unsigned kid;

		if (!c->todo) {
			if (!depth--)
				return 1;
			c--;
			continue;
		}
		kid = (unsigned)__builtin_ctz(c->todo);
		c->todo &= c->todo - 1;
		mask = c->mask[kid] & h->live;
		next = herd_kid(a, h, c, kid);
		if (next >= a->inner) {
			if (!any)
				mask = herd_reach(h, c, kid, mask);
			if (mask)
				herd_leaf(a, q, h, b, &a->leaf[next - a->inner], mask, any);
			if (!h->live)
				return 1;
			continue;
		}
		if (!mask)
			continue;
		steps++;
		rays += (uint32_t)__builtin_popcountll(mask);
		if (steps == HERD_TRY && rays < HERD_TRY * HERD_TOGETHER)
			return 0;
		herd_descend(h, c, c + 1, kid, half[depth]);
		depth++;
		for (unsigned k = 0; k < 3; k++)
			half[depth][k] = half[depth - 1][k] * 0.5;
		herd_open(a, h, ++c, next, mask);
	}
}

#endif
