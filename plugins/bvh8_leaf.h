/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A herd of bvh8's, as it begins, and its leaves: the four triangles of a block and GROUP of its rays in one step.
 * What is computed there and why is told in bvh8_beam.h.
 */
#ifndef BVH8_LEAF_H
#define BVH8_LEAF_H

#include "bvh8_beam.h"
#include "bvh8_vecg.h"

#if ISA_LEVEL >= 2
#define HERD_PENDING 512u
#define HERD_ROW 3 /* rays beside each other that are worth asking the doubles about together */
#define HERD_LATER 8u /* at most: of what comes off the stack, what is fetched before it is used */

struct herd {
	struct lot lot;
	struct lines *lines, both[2]; /* the lot's, and those of the one before */
	struct due due;
	float aim[LOT][16]; /* of each ray, once one has come to a leaf: see herd_aims() */
	f8 edge_near[3], edge_far[3], slow[3], fast[3]; /* the hull: origins, inverse directions */
	uint64_t best; /* lanes of which a triangle is known that is surely hit, AIM_ID, at no less than AIM_BEST */
	/* Lanes; live_first: before the walk; asked: the doubles were, before the end. */
	uint64_t live, live_first, found, asked;
	float reach; /* tfar of the farthest */
	float side, grow;
	uint32_t near[3], far[3]; /* which planes of a node */
	uint32_t axis[3], size, aimed;
	uint32_t steps, rays; /* nodes that were opened, by how many rays */
	uint64_t waiting[HERD_LATER]; /* lanes of what is fetched meanwhile; and what that is */
	uint32_t later[HERD_LATER];
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

	UNROLL
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

/* What triangles want to know of a ray, in fours; the last of these change as it meets some. See struct aim. */
enum { AIM_OX, AIM_OY, AIM_OZ, AIM_DEPTH, AIM_SX, AIM_SY, AIM_ZERROR, AIM_BEFORE, AIM_SURE_LO, AIM_SURE_HI, AIM_SKIP,
       AIM_BACK, AIM_TFAR, AIM_BEST, AIM_ID, AIM_ZFAR };

static __attribute__((noinline)) void herd_aims(const ald_accel *a, struct herd *h, const struct batch *s)
{
	struct lot *l = &h->lot;
	const f8 tiny = f8_all(DEPTH_LEAST), side = f8_all(h->side);
	float skip[LOT] __attribute__((aligned(64)));

	h->aimed = 1;
	for (unsigned i = 0; i < h->size; i++)
		memcpy(&skip[i], &s->ray[l->index[i]].skip, sizeof(*skip));
	for (unsigned i = 0; i < h->size; i += 8) {
		f8 depth = f8_load(l->depth + i), tfar = f8_load(l->tfar + i), near, far, zerror, zfar, t;

		zerror = a->fast ? f8_all(0) : f8_mul_add(f8_load(l->pad + i), f8_all(DEPTH_PAD), tiny);
		zfar = f8_mul_add(tfar, depth, f8_add(zerror, f8_all(a->fast ? 0 : DEPTH_ERROR)));
		f8_rows(h->aim + i, AIM_OX, f8_load(l->o[h->axis[0]] + i), f8_load(l->o[h->axis[1]] + i),
			f8_mul(f8_load(l->o[h->axis[2]] + i), side), depth);
		near = f8_mul(f8_load(l->first + i), depth);
		t = f8_mul(f8_size(near), tiny);
		f8_rows(h->aim + i, AIM_SX, f8_load(l->shear[0] + i), f8_load(l->shear[1] + i), zerror,
			f8_sub(near, t));
		far = f8_mul(f8_load(l->last + i), depth);
		f8_rows(h->aim + i, AIM_SURE_LO, f8_add(near, t), f8_sub(far, f8_mul(f8_size(far), tiny)),
			f8_load(skip + i), f8_mul(f8_load(l->inverse[h->axis[2]] + i), side));
		f8_rows(h->aim + i, AIM_TFAR, tfar, f8_all(INFINITY), tfar, zfar);
	}
}

V void herd_begin(const ald_accel *a, struct herd *h)
{
	const struct lot *l = &h->lot;
	f16 pads = f16_all(0), reach = f16_all(-INFINITY);
	float pad, far;

	h->found = h->asked = h->best = 0;
	h->pending = 0;
	for (unsigned i = 0; i < h->size; i += 16) {
		uint32_t in = (uint32_t)(h->live >> i) & 0xffff;

		pads = f16_max(f16_pick(in, f16_load(l->pad + i), pads), pads);
		reach = f16_max(f16_pick(in, f16_load(l->tfar + i), reach), reach);
	}
	h->aimed = 0;
	h->reach = f16_most(reach);
	pad = f16_most(pads);
	far = far_of(pad);
	h->grow = a->fast ? 0 : far * far;
	herd_hull(h, pad);
}

/* Nothing beyond t counts for a lane. */
V void herd_cut(const ald_accel *a, struct herd *h, unsigned lane, float t)
{
	float *aim = h->aim[lane];

	h->lot.tfar[lane] = aim[AIM_TFAR] = t;
	aim[AIM_ZFAR] = t * aim[AIM_DEPTH] + (a->fast ? 0 : aim[AIM_ZERROR] + DEPTH_ERROR);
}

/* An answer of the doubles', t being between first and what is known: nearly all are so. */
V void due_take(const ald_accel *a, const struct batch *s, const struct due *d, unsigned lane, const struct answer *r,
		unsigned j)
{
	uint32_t ray = d->ray[lane];
	double t = r->t[j];

	if (r->doubt >> j & 1 || !(t > d->lines->first[lane]) ||
	    !(t < (s->hit ? s->hit[ray].t : d->lines->last[lane])))
		answer_take(a, s, r, j, ray, d->id[lane]);
	else if (s->hit)
		s->hit[ray] = (ald_hit){ .t = t, .u = r->u[j], .v = r->v[j], .prim = d->id[lane] };
	else
		s->hidden[ray] = 1;
}

/* Ask about what is due, DW rays at once. */
static __attribute__((noinline)) void due_ask(const ald_accel *a, const struct batch *s, struct due *d)
{
	struct corners c = { 0 };

	for (unsigned at = 0; at < LOT; at += DW) {
		uint32_t row = (uint32_t)(d->some >> at) & ((1u << DW) - 1);
		struct answer r;

		if (!row)
			continue;
		due_corners(&c, a->prims, d, at, row);
		lines_answer(d->lines, at, &c, d->axis, &r);
		for (uint32_t bits = (r.hit | r.doubt) & row; bits; bits &= bits - 1) {
			unsigned j = (unsigned)__builtin_ctz(bits);

			due_take(a, s, d, at + j, &r, j);
		}
	}
	d->some = 0;
}

/* The best triangles of these lanes are due once another herd has walked: until then they are fetched. */
V void herd_due(const ald_accel *a, const struct herd *h, struct due *d, uint64_t some)
{
	const ald_prims *p = a->prims;
	size_t size = p->vertex_double ? 8 : 4;

	d->lines = h->lines;
	d->some = some;
	for (unsigned k = 0; k < 3; k++)
		d->axis[k] = h->axis[k];
	for (; some; some &= some - 1) {
		unsigned lane = (unsigned)__builtin_ctzll(some);
		uint32_t id;

		memcpy(&id, &h->aim[lane][AIM_ID], sizeof(id));
		d->id[lane] = id;
		d->ray[lane] = h->lot.index[lane];
		for (unsigned k = 0; k < 3; k++) {
			uint32_t corner = p->index[3 * (size_t)id + k];

			d->corner[k][lane] = corner;
			__builtin_prefetch((const char *)p->vertex + 3 * corner * size);
			__builtin_prefetch((const char *)p->vertex + 3 * corner * size + 2 * size);
		}
	}
}

/* Of these lanes those that have DW - 1 beside them with others: worth a row. */
V uint64_t herd_rows_of(uint64_t some)
{
	uint64_t rows = 0;

	for (unsigned at = 0; at < LOT; at += DW) {
		uint64_t row = some & (((uint64_t)1 << DW) - 1) << at;

		rows |= __builtin_popcountll(row) < HERD_ROW ? 0 : row;
	}
	return rows;
}

V void herd_queue(const ald_accel *a, const struct batch *s, struct asked *q, struct herd *h, uint32_t lane,
		  uint32_t id, int reached)
{
	if (q->n == ASKED_MAX)
		ask(a, s, q);
	q->ray[q->n] = h->lot.index[lane];
	q->id[q->n] = id;
	q->n += (uint32_t)(reached & !(h->found >> lane & 1));
	h->asked |= (uint64_t)1 << lane;
}

/* Give the doubles what is pending: the best of each ray where rays beside each other have some, and the rest with
 * what other herds leave. */
V void herd_settle(const ald_accel *a, const struct batch *s, struct asked *q, struct herd *h)
{
	const struct lot *l = &h->lot;
	uint64_t some = h->best, rows;
	uint32_t id;

	for (uint32_t i = 0; i < h->pending && !a->frame.exact; i++) {
		uint32_t lane = h->lane[i];

		if ((some | h->found) >> lane & 1 || h->low[i] > l->tfar[lane])
			continue;
		memcpy(&h->aim[lane][AIM_ID], &h->id[i], sizeof(*h->id));
		some |= (uint64_t)1 << lane;
		h->low[i] = INFINITY;
	}
	for (uint64_t bits = some; bits; bits &= bits - 1) {
		memcpy(&id, &h->aim[__builtin_ctzll(bits)][AIM_ID], sizeof(id));
		__builtin_prefetch(&a->prims->index[3 * (size_t)id]);
	}
	if (h->due.some)
		due_ask(a, s, &h->due);
	rows = herd_rows_of(some);
	if (rows)
		herd_due(a, h, &h->due, rows);
	for (uint64_t bits = some & ~rows; bits; bits &= bits - 1) {
		unsigned lane = (unsigned)__builtin_ctzll(bits);

		memcpy(&id, &h->aim[lane][AIM_ID], sizeof(id));
		herd_queue(a, s, q, h, lane, id, 1);
	}
	for (uint32_t i = 0; i < h->pending; i++)
		herd_queue(a, s, q, h, h->lane[i], h->id[i], !(h->low[i] > l->tfar[h->lane[i]]));
	h->asked |= rows;
	h->pending = 0;
	h->best = 0;
	for (; some; some &= some - 1)
		h->aim[__builtin_ctzll(some)][AIM_BEST] = INFINITY;
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

struct seats { /* a block, as the herd's axes have it, once for each ray of a group */
	/* slope: by which the slack grows with z; see block_slack(); extent: no coordinate of a hit is further away. */
	gv x[3], y[3], z[3], slack, slope, extent;
};

V void seats_set(const struct herd *h, const struct block *n, struct seats *e)
{
	gv slack;

	UNROLL
	for (unsigned i = 0; i < 3; i++) {
		e->x[i] = g_seats(n->v[i][h->axis[0]]);
		e->y[i] = g_seats(n->v[i][h->axis[1]]);
		e->z[i] = g_mul(g_seats(n->v[i][h->axis[2]]), g_all(h->side));
	}
	slack = g_mul(g_seats(n->slack), g_all(h->grow));
	e->slack = g_mul(slack, g_mul_add(g_size(g_seats(n->slack)), g_all(SLACK_SQUARE), g_all(SLACK_LEAST)));
	e->slope = g_mul(slack, g_all(SLACK_SLOPE));
	e->extent = g_mul(g_seats(n->slack), g_all(1 / (6 * EDGE_ERROR)));
}

struct encounter { /* as struct meeting; narrow: no corner is too far from the line */
	gv a, b, c, az, bz, cz;
	uint32_t maybe, sure, narrow;
};

/* As block_meet() begins. */
V void herd_weigh(const struct herd *h, const struct seats *e, const uint32_t *lane, struct encounter *m)
{
	gv o = g_rows(h->aim, AIM_OX, lane), s = g_rows(h->aim, AIM_SX, lane);
	gv ox = G_SPREAD(o, 0), oy = G_SPREAD(o, 1), oz = G_SPREAD(o, 2), sx = G_SPREAD(s, 0), sy = G_SPREAD(s, 1);
	gv az = g_sub(e->z[0], oz), bz = g_sub(e->z[1], oz), cz = g_sub(e->z[2], oz), zmin, slack;
	gv ax = g_sub_mul(g_sub(e->x[0], ox), sx, az), ay = g_sub_mul(g_sub(e->y[0], oy), sy, az);
	gv bx = g_sub_mul(g_sub(e->x[1], ox), sx, bz), by = g_sub_mul(g_sub(e->y[1], oy), sy, bz);
	gv cx = g_sub_mul(g_sub(e->x[2], ox), sx, cz), cy = g_sub_mul(g_sub(e->y[2], oy), sy, cz);

	m->az = az;
	m->bz = bz;
	m->cz = cz;
	m->a = g_mul_sub(cx, by, g_mul(cy, bx));
	m->b = g_mul_sub(ax, cy, g_mul(ay, cx));
	m->c = g_mul_sub(bx, ay, g_mul(by, ax));
	zmin = g_min(az, g_min(bz, cz));
	slack = g_mul_add(g_max(g_max(az, g_max(bz, cz)), g_negate(zmin)), e->slope, e->slack);
	m->narrow = g_le(g_largest(g_largest(g_largest(ax, ay), g_largest(bx, by)), g_largest(cx, cy)), e->extent);
	m->maybe = g_le(g_min(g_max(m->a, g_max(m->b, m->c)), g_negate(g_min(m->a, g_min(m->b, m->c)))), slack);
}

struct sights { /* of a group's rays, fours, called by their first */
	gv o, s, sure_lo, tfar;
};

/* As block_behind(); the pad is less than zerror / DEPTH_PAD. */
V uint32_t herd_behind(const struct block *n, const struct seats *v, const struct encounter *m,
		       const struct sights *r, gv sum, gv slack)
{
	gv ex = g_sub(v->x[1], v->x[0]), ey = g_sub(v->y[1], v->y[0]), ez = g_sub(v->z[1], v->z[0]);
	gv gx = g_sub(v->x[2], v->x[0]), gy = g_sub(v->y[2], v->y[0]), gz = g_sub(v->z[2], v->z[0]);
	gv nx = g_mul_sub(ey, gz, g_mul(ez, gy)), ny = g_mul_sub(ez, gx, g_mul(ex, gz));
	gv nz = g_mul_sub(ex, gy, g_mul(ey, gx)), s = g_mul(g_seats(n->slack), g_all(1 / (11 * EDGE_ERROR)));
	gv qx = g_sub(v->x[0], G_SPREAD(r->o, 0)), qy = g_sub(v->y[0], G_SPREAD(r->o, 1)), up, e, most;

	slack = g_mul(slack, g_all(3));
	most = g_max(g_max(g_size(qx), g_size(qy)), g_size(m->az));
	up = g_mul_add(nx, qx, g_mul_add(ny, qy, g_mul(nz, m->az)));
	e = g_mul_add(s, g_all(0x1p-18f), g_all(0x1p-20f));
	e = g_mul_add(most, e, g_mul(s, g_mul_add(G_SPREAD(r->s, 2), g_all(8 / DEPTH_PAD), g_all(0x1p-21f))));
	e = g_mul(e, s);
	return (g_le(e, up) & g_le(slack, sum)) | (g_le(e, g_negate(up)) & g_le(sum, g_negate(slack)));
}

/* As block_bounds(); low, and high, as t. Where the line is surely hit all weights have one sign, and D, their sum,
 * is at least 3 slack: so 6 slack S / D bounds 3 slack S / (D - 3 slack), or is more than S. */
V void herd_bounds(const struct block *n, const struct seats *e, const struct sights *r, struct encounter *m, gv *low,
		   gv *high)
{
	gv sum = g_add(g_add(m->a, m->b), m->c), one = g_div(g_all(1), sum), error, off, z, back, zsize, slack;
	gv zmin = g_min(m->az, g_min(m->bz, m->cz)), zmax = g_max(m->az, g_max(m->bz, m->cz));
	uint32_t within = g_le(zmin, G_SPREAD(r->tfar, 3));
	gv sure_lo = G_SPREAD(r->sure_lo, 0), sure_hi = G_SPREAD(r->sure_lo, 1);

	z = g_mul(g_mul_add(m->a, m->az, g_mul_add(m->b, m->bz, g_mul(m->c, m->cz))), one);
	zsize = g_max(zmax, g_negate(zmin));
	slack = g_mul_add(zsize, e->slope, e->slack);
	error = g_mul_add(zsize, g_all(DEPTH_RELATIVE), G_SPREAD(r->s, 2));
	off = g_mul(g_mul(slack, g_all(6)), g_sub(zmax, zmin));
	off = g_mul_add(off, g_size(one), error);
	m->sure = m->narrow & g_le(slack, g_max(g_min(m->a, g_min(m->b, m->c)),
						g_negate(g_max(m->a, g_max(m->b, m->c)))));
	zmin = g_sub(zmin, error);
	zmax = g_add(zmax, error);
	*low = g_max(g_pick(m->sure, g_sub(z, off), zmin), zmin);
	*high = g_min(g_pick(m->sure, g_add(z, off), zmax), zmax);
	m->maybe &= g_le(G_SPREAD(r->s, 3), *high) & within;
	m->sure &= g_le(*high, sure_hi) & g_le(sure_lo, *low) & m->maybe;
	if (m->maybe & ~m->sure & g_le(*low, sure_lo))
		m->maybe &= ~herd_behind(n, e, m, r, sum, slack) | m->sure;
	back = G_SPREAD(r->sure_lo, 3);
	*low = g_mul(*low, back);
	*low = g_sub_mul(*low, g_size(*low), g_all(0x1p-20f));
	*high = g_pick(m->sure, g_mul(*high, g_mul(back, g_all(1 + 0x1p-20f))), g_all(INFINITY));
}

/* As beam_meet_fast(). */
V void herd_meet_fast(const ald_accel *a, const struct batch *s, struct herd *h, const struct block *n,
		      const uint32_t *lane, const struct encounter *m, int any)
{
	float w[3][4 * GROUP] __attribute__((aligned(64)));
	struct lot *l = &h->lot;

	g_store(w[0], m->b);
	g_store(w[1], m->c);
	g_store(w[2], g_add(g_add(m->a, m->b), m->c));
	for (uint32_t bits = m->maybe; bits; bits &= bits - 1) {
		unsigned i = (unsigned)__builtin_ctz(bits), at = lane[i / 4];
		const ald_ray *r = &s->ray[l->index[at]];
		ald_hit own = { .t = r->tmax, .prim = ALD_NONE }, *hit = any ? &own : &s->hit[l->index[at]];
		float t;

		if (!fast_hit(a, r, n, i % 4, w[0][i], w[1][i], w[2][i], hit))
			continue;
		t = limit_of(hit->t, l->shift[at], l->tscale[at]);
		if (t < l->tfar[at])
			herd_cut(a, h, at, t);
		h->found |= (uint64_t)any << at;
	}
	h->live &= ~h->found;
}

/* Of those that may be hit, the ones that the ray sees. */
V void herd_see(const ald_accel *a, const struct batch *s, const struct herd *h, const struct block *n,
		const uint32_t *lane, const struct sights *r, struct encounter *m)
{
	m->maybe &= ~g_same(g_seats((const float *)n->id), G_SPREAD(r->sure_lo, 2));
	for (uint32_t bits = a->prims->mask ? m->maybe : 0; bits; bits &= bits - 1) {
		unsigned i = (unsigned)__builtin_ctz(bits);

		if (!ald_sees(a->prims, &s->ray[h->lot.index[lane[i / 4]]], n->id[i % 4]))
			m->maybe &= ~(1u << i);
	}
}

/* Some are hit for sure: nothing beyond counts. Where all that the ray has known of is surely behind, the nearest is
 * the best, and pending no more. No branch: nobody could guess which rays these are. */
V void herd_nearer(const ald_accel *a, struct herd *h, const struct block *n, const uint32_t *lane,
		   const struct sights *r, struct encounter *m, gv low, gv high)
{
	gv near = g_min(g_least(g_pick(m->sure, high, g_all(INFINITY))), G_SPREAD(r->tfar, 0));
	gv none = g_all(0), row, zfar, best, id;
	uint32_t first, rays;

	m->maybe &= g_le(low, near);
	first = a->frame.exact ? 0 : m->sure & g_le(high, near) & ~g_le(G_SPREAD(r->tfar, 1), high);
	/* One of each ray. */
	first &= ~((first << 1 & 0xeeeeeeee) | (first << 2 & 0xcccccccc) | (first << 3 & 0x88888888));
	m->maybe &= ~first;
	rays = rays_of(first);
	best = g_join(g_pick(first, low, none));
	id = g_join(g_pick(first, g_seats((const float *)n->id), none));
	zfar = g_mul_add(near, G_SPREAD(r->o, 3), g_add(G_SPREAD(r->s, 2), g_all(DEPTH_ERROR)));
	row = g_pick(rays << (AIM_BEST - AIM_TFAR), best, r->tfar);
	row = g_pick(rays << (AIM_ID - AIM_TFAR), id, row);
	row = g_pick(0x11111111, near, g_pick(0x88888888, zfar, row));
	g_rows_put(h->aim, AIM_TFAR, h->lot.tfar, lane, row);
	h->best |= rays_lanes(rays, lane);
}

/* A block and the first of GROUP lanes. */
V void herd_meet(const ald_accel *a, const struct batch *s, struct asked *q, struct herd *h, const struct block *n,
		 const struct seats *e, const uint32_t *lane, uint32_t count, int any)
{
	struct encounter m;
	struct sights r;
	gv low, high;

	herd_weigh(h, e, lane, &m);
	m.maybe &= count < GROUP ? (1u << 4 * count) - 1 : UINT32_MAX;
	if (!m.maybe)
		return;
	if (a->fast) {
		herd_meet_fast(a, s, h, n, lane, &m, any);
		return;
	}
	r.o = g_rows(h->aim, AIM_OX, lane);
	r.s = g_rows(h->aim, AIM_SX, lane);
	r.sure_lo = g_rows(h->aim, AIM_SURE_LO, lane);
	r.tfar = g_rows(h->aim, AIM_TFAR, lane);
	herd_see(a, s, h, n, lane, &r, &m);
	herd_bounds(n, e, &r, &m, &low, &high);
	if (any) {
		uint32_t hit = rays_of(m.sure);

		m.maybe &= ~(15 * hit);
		for (; hit; hit &= hit - 1)
			h->found |= (uint64_t)1 << lane[__builtin_ctz(hit) / 4];
		h->live &= ~h->found;
	} else if (m.sure) {
		herd_nearer(a, h, n, lane, &r, &m, low, high);
	}
	if (!m.maybe)
		return;
	if (!any && a->frame.exact)
		g_pack(&h->high[h->pending], high, m.maybe);
	g_pack(&h->low[h->pending], low, m.maybe);
	g_pack((float *)&h->id[h->pending], g_seats((const float *)n->id), m.maybe);
	g_pack((float *)&h->lane[h->pending], g_each(lane), m.maybe);
	h->pending += (uint32_t)__builtin_popcount(m.maybe);
	if (h->pending > HERD_PENDING)
		herd_settle(a, s, q, h);
}

V void herd_leaf(const ald_accel *a, const struct batch *s, struct asked *q, struct herd *h, uint32_t ref,
		 uint64_t lanes, int any)
{
	const struct block *n = &a->block[ref & REF_INDEX];
	const struct block *end = n + (ref >> REF_SHIFT & 7) + 1;
	uint32_t lane[LOT + 16], m = lanes_of(lanes, lane);

	for (; n < end; n++) {
		struct seats e;

		seats_set(h, n, &e);
		for (uint32_t i = 0; i < m; i += GROUP)
			herd_meet(a, s, q, h, n, &e, lane + i, m - i, any);
		if (any && lanes & ~h->live) {
			lanes &= h->live;
			m = lanes_of(lanes, lane);
		}
	}
}
#endif

#endif
