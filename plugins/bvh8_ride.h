/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A crew of bvh8's whose rays meet blocks GROUP at a time, each with a block of its own, and what a ray is to the
 * tree, in two rows of sixteen numbers. Nothing there is a branch on what is met: rays' hits are bounded in the list
 * they stand in, and what the doubles are to be asked about goes on one list for all. See bvh8_crew.h for turns, and
 * bvh8_beam.h for what is computed and why.
 */
#ifndef BVH8_RIDE_H
#define BVH8_RIDE_H

#include "bvh8_crew.h"
#include "bvh8_vecg.h"

#if ISA_LEVEL >= 2
#define RIDE_RUN 1024u /* rays that share a list of what to ask */
#define RIDE_PENDING 1024u

/* Of a ray: see struct aim and struct beam. Offsets are bytes of a node or block; by: of the order of children. */
enum { AT_O, AT_SIDE = AT_O + 3, AT_SHEAR, AT_ZERROR = AT_SHEAR + 2, AT_BEFORE, AT_SURE, AT_PAD = AT_SURE + 2,
       AT_BACK, AT_SKIP, AT_DEPTH, AT_GROW, AT_LANE, AT_REACH = 15 };
enum { AT_INVERSE, AT_NEAR_O = 3, AT_FAR_O = 6, AT_PLANE = 9, AT_AXIS = 12, AT_BY = 15 };

struct rider {
	float aim[16], box[16];
	double shift, tscale;
	uint32_t index; /* of the batch */
	float enter[STACK_MAX + WIDTH];
	uint32_t below[STACK_MAX + WIDTH];
} __attribute__((aligned(64)));

struct ride {
	struct source source;
	float aim[LOT][16], box[LOT][16]; /* of the lot */
	struct turns turns;
	struct rider rider[INTERLEAVE_MAX];
	uint32_t lanes; /* of the run, that have begun */
	uint32_t pending;
	float low[RIDE_PENDING + 16];
	uint32_t id[RIDE_PENDING + 16], lane[RIDE_PENDING + 16];
	float reach[RIDE_RUN]; /* of the run's rays that have ended: nothing beyond counts */
	uint32_t index[RIDE_RUN];
} __attribute__((aligned(64)));

V f8 f8_word(uint32_t x)
{
	return _mm256_castsi256_ps(_mm256_set1_epi32((int)x));
}

V f8 f8_choose(uint32_t bits, f8 a, f8 b)
{
#if ISA_LEVEL >= 3
	return _mm256_mask_blend_ps((__mmask8)bits, b, a);
#else
	return f8_pick(bits, a, b);
#endif
}

struct mains { /* of eight lanes: whose main axis is y, and z */
	uint32_t y, z;
};

/* What stands at the lanes' main axis, k = 0, or at the ones that follow it. */
V f8 along(const struct mains *m, unsigned k, f8 x, f8 y, f8 z)
{
	const f8 v[3] = { x, y, z };

	return f8_choose(m->z, v[(2 + k) % 3], f8_choose(m->y, v[(1 + k) % 3], v[k]));
}

/* Of the lot's lanes i to i + 7; as the last of each row stand what a ride or a flood has there. */
V void ride_rows(const struct lot *l, const struct batch *b, float (*aims)[16], float (*boxes)[16], unsigned i,
		 int flood)
{
	const struct mains m = { (uint32_t)(l->main[1] >> i) & 255, (uint32_t)(l->main[2] >> i) & 255 };
	const uint32_t down[3] = { (uint32_t)(l->sign[0] >> i) & 255, (uint32_t)(l->sign[1] >> i) & 255,
				   (uint32_t)(l->sign[2] >> i) & 255 };
	const uint32_t back = (m.z & down[2]) | (m.y & down[1]) | (~(m.y | m.z) & down[0]);
	const f8 side = f8_choose(back, f8_all(-1), f8_all(1)), tiny = f8_all(DEPTH_LEAST);
	const f8 depth = f8_load(l->depth + i), tfar = f8_load(l->tfar + i);
	f8 o[3], v[3], n[3], f[3], plane[3], by = f8_word(4 * ORDER_TURNED), axis[3], t0, t1, e0, e1, grow, pad;
	float skip[8] __attribute__((aligned(32)));

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		o[k] = f8_load(l->o[k] + i);
		v[k] = f8_load(l->inverse[k] + i);
		n[k] = f8_load(l->near_o[k] + i);
		f[k] = f8_load(l->far_o[k] + i);
		plane[k] = f8_choose(down[k], f8_word(64 * k + 32), f8_word(64 * k));
		by = _mm256_xor_ps(by, f8_choose(down[k], f8_word(4u << k), f8_word(0)));
		axis[k] = along(&m, (k + 1) % 3, f8_word(0), f8_word(16), f8_word(32));
	}
	for (unsigned j = 0; j < 8; j++)
		memcpy(&skip[j], &b->ray[l->index[i + j]].skip, sizeof(*skip));
	pad = f8_load(l->pad + i);
	grow = f8_mul_add(pad, f8_all(20 / EDGE_ERROR), f8_all(1)); /* far_of() */
	f8_rows(aims + i, AT_O, along(&m, 1, o[0], o[1], o[2]), along(&m, 2, o[0], o[1], o[2]),
		f8_mul(along(&m, 0, o[0], o[1], o[2]), side), side);
	t0 = f8_mul(f8_load(l->first + i), depth);
	t1 = f8_mul(f8_load(l->last + i), depth);
	e0 = f8_mul(f8_size(t0), tiny);
	e1 = f8_mul(f8_size(t1), tiny);
	f8_rows(aims + i, AT_SHEAR, f8_load(l->shear[0] + i), f8_load(l->shear[1] + i),
		f8_mul_add(pad, f8_all(DEPTH_PAD), tiny), f8_sub(t0, e0));
	f8_rows(aims + i, AT_SURE, f8_add(t0, e0), f8_sub(t1, e1), pad,
		f8_mul(along(&m, 0, v[0], v[1], v[2]), side));
	f8_rows(aims + i, AT_SKIP, f8_load(skip), depth, f8_mul(grow, grow), tfar);
	f8_rows(boxes + i, AT_INVERSE, v[0], v[1], v[2], n[0]);
	f8_rows(boxes + i, AT_NEAR_O + 1, n[1], n[2], f[0], f[1]);
	f8_rows(boxes + i, AT_FAR_O + 2, f[2], plane[0], plane[1], plane[2]);
	f8_rows(boxes + i, AT_AXIS, axis[0], axis[1], axis[2], flood ? tfar : by);
}

/* The next ray takes a place; 0: there is none. */
V int ride_next(const ald_accel *a, struct ride *c, struct rider *r, float *tfar, int any)
{
	struct source *s = &c->source;
	const struct lot *l = &s->lot;
	unsigned i;

	while (!s->left) {
		if (!source_fill(a, s, any))
			return 0;
		for (i = 0; i < LOT; i += 8) {
			if (s->left >> i & 255)
				ride_rows(&s->lot, &s->batch, c->aim, c->box, i, 0);
		}
	}
	i = (unsigned)__builtin_ctzll(s->left);
	s->left &= s->left - 1;
	UNROLL
	for (unsigned k = 0; k < 16; k += 8) {
		f8_store(r->aim + k, f8_load(c->aim[i] + k));
		f8_store(r->box + k, f8_load(c->box[i] + k));
	}
	memcpy(&r->aim[AT_LANE], &c->lanes, sizeof(c->lanes));
	c->reach[c->lanes] = INFINITY;
	c->index[c->lanes++] = r->index = l->index[i];
	r->shift = l->shift[i];
	r->tscale = l->tscale[i];
	r->enter[1] = -INFINITY;
	r->below[1] = a->root;
	*tfar = l->tfar[i];
	return 1;
}

/* Ask the doubles about what is pending and still in reach. */
V void ride_settle(const ald_accel *a, struct ride *c)
{
	struct asked *q = &c->source.asked;

	for (uint32_t i = 0; i < c->pending; i++) {
		uint32_t lane = c->lane[i];

		q->ray[q->n] = c->index[lane];
		q->id[q->n] = c->id[i];
		q->n += !(c->low[i] > c->reach[lane]);
		if (q->n == ASKED_MAX)
			ask(a, &c->source.batch, q);
	}
	c->pending = 0;
}

V uint32_t word_of(const float *p)
{
	uint32_t x;

	memcpy(&x, p, sizeof(x));
	return x;
}

V void ride_node(const ald_accel *a, struct rider *r, struct turn *w, uint32_t i)
{
	const char *n = (const char *)&a->node[w->ref[i]];
	f8 t0 = f8_all(0), t1 = f8_all(w->tfar[i]);
	uint32_t top = w->top[i], order;

	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		uint32_t at = word_of(&r->box[AT_PLANE + k]);
		f8 v = f8_all(r->box[AT_INVERSE + k]);

		t0 = f8_max(f8_mul_add(f8_load((const float *)(n + at)), v, f8_all(r->box[AT_NEAR_O + k])), t0);
		t1 = f8_min(f8_mul_add(f8_load((const float *)(n + (at ^ 32))), v, f8_all(r->box[AT_FAR_O + k])), t1);
	}
	memcpy(&order, n + offsetof(struct node, order) + word_of(&r->box[AT_BY]), sizeof(order));
	w->top[i] = top + f8_ordered(t0, t1, order, ((const struct node *)n)->child, r->enter + top, r->below + top);
}

/* What stands at each of GROUP places. */
V gv g_four(const float *const p[GROUP])
{
#if ISA_LEVEL >= 3
	gv x = _mm512_castps128_ps512(_mm_load_ps(p[0]));

	x = _mm512_mask_broadcast_f32x4(x, 0x00f0, _mm_load_ps(p[1]));
	x = _mm512_mask_broadcast_f32x4(x, 0x0f00, _mm_load_ps(p[2]));
	return _mm512_mask_broadcast_f32x4(x, 0xf000, _mm_load_ps(p[3]));
#else
	return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(p[0])), _mm_load_ps(p[1]), 1);
#endif
}

V gv g_places(const char *const p[GROUP], size_t at)
{
	const float *to[GROUP];

	UNROLL
	for (unsigned j = 0; j < GROUP; j++)
		to[j] = (const float *)(p[j] + at);
	return g_four(to);
}

/* The first of each four, GROUP of them. */
V void g_put_firsts(float *p, gv x)
{
#if ISA_LEVEL >= 3
	_mm_storeu_ps(p, _mm512_castps512_ps128(_mm512_maskz_compress_ps(0x1111, x)));
#else
	__m128 y = _mm_unpacklo_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1));

	_mm_storel_pi((__m64 *)p, y);
#endif
}

struct clash { /* of rays with a block each; as struct seats and struct encounter */
	gv aim[4], x[3], y[3], z[3], own, slack, ids; /* own: a block's own slack */
	gv qx, qy, ax, ay, az, bx, by, bz, cx, cy, cz, a, b, c, zmin, zmax, zsize, sum, low, high;
	gv tfar;
	uint32_t maybe, sure;
};

/* GROUP rays by the one row of each, and each's other row; ref: their leaves. */
V void clash_load(const ald_accel *a, const char *const ray[GROUP], const float *const box[GROUP],
		  const uint32_t *ref, struct clash *m)
{
	const char *block[GROUP], *p[3][GROUP];
	gv side;

	UNROLL
	for (unsigned j = 0; j < GROUP; j++) {
		block[j] = (const char *)&a->block[ref[j] & REF_INDEX];
		UNROLL
		for (unsigned k = 0; k < 3; k++)
			p[k][j] = block[j] + word_of(&box[j][AT_AXIS + k]);
	}
	UNROLL
	for (unsigned k = 0; k < 4; k++)
		m->aim[k] = g_places(ray, sizeof(float[4]) * k);
	side = G_SPREAD(m->aim[0], 3);
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		const size_t at = offsetof(struct block, v) + sizeof(float[3][SEATS]) * k;

		m->x[k] = g_places(p[0], at);
		m->y[k] = g_places(p[1], at);
		m->z[k] = g_mul(g_places(p[2], at), side);
	}
	m->own = g_places(block, offsetof(struct block, slack));
	m->ids = g_places(block, offsetof(struct block, id));
}

/* As block_meet(). */
V void clash_weigh(struct clash *m)
{
	gv ox = G_SPREAD(m->aim[0], 0), oy = G_SPREAD(m->aim[0], 1), oz = G_SPREAD(m->aim[0], 2);
	gv sx = G_SPREAD(m->aim[1], 0), sy = G_SPREAD(m->aim[1], 1), zerror = G_SPREAD(m->aim[1], 2);
	gv zfar = g_mul_add(m->tfar, G_SPREAD(m->aim[3], 1), g_add(zerror, g_all(DEPTH_ERROR))), least, most, wide;

	m->az = g_sub(m->z[0], oz);
	m->bz = g_sub(m->z[1], oz);
	m->cz = g_sub(m->z[2], oz);
	m->qx = g_sub(m->x[0], ox);
	m->qy = g_sub(m->y[0], oy);
	m->ax = g_sub_mul(m->qx, sx, m->az);
	m->ay = g_sub_mul(m->qy, sy, m->az);
	m->bx = g_sub_mul(g_sub(m->x[1], ox), sx, m->bz);
	m->by = g_sub_mul(g_sub(m->y[1], oy), sy, m->bz);
	m->cx = g_sub_mul(g_sub(m->x[2], ox), sx, m->cz);
	m->cy = g_sub_mul(g_sub(m->y[2], oy), sy, m->cz);
	m->a = g_mul_sub(m->cx, m->by, g_mul(m->cy, m->bx));
	m->b = g_mul_sub(m->ax, m->cy, g_mul(m->ay, m->cx));
	m->c = g_mul_sub(m->bx, m->ay, g_mul(m->by, m->ax));
	m->sum = g_add(g_add(m->a, m->b), m->c);
	m->zsize = g_max(g_size(m->az), g_max(g_size(m->bz), g_size(m->cz)));
	m->slack = g_mul_add(g_size(m->own), g_all(SLACK_SQUARE), g_all(SLACK_LEAST));
	m->slack = g_mul_add(m->zsize, g_all(SLACK_SLOPE), m->slack); /* block_slack() */
	m->slack = g_mul(m->slack, g_mul(m->own, G_SPREAD(m->aim[3], 2)));
	m->zmin = g_min(m->az, g_min(m->bz, m->cz));
	m->zmax = g_max(m->az, g_max(m->bz, m->cz));
	least = g_min(m->a, g_min(m->b, m->c));
	most = g_max(m->a, g_max(m->b, m->c));
	wide = g_max(g_max(g_max(g_size(m->ax), g_size(m->ay)), g_max(g_size(m->bx), g_size(m->by))),
		     g_max(g_size(m->cx), g_size(m->cy)));
	m->maybe = (g_le(g_negate(m->slack), least) | g_le(most, m->slack)) & g_le(m->zmin, zfar);
	m->maybe &= ~g_same(m->ids, G_SPREAD(m->aim[3], 0));
	m->sure = g_le(m->slack, least) | g_le(most, g_negate(m->slack));
	m->sure &= g_le(wide, g_mul(m->own, g_all(1 / (6 * EDGE_ERROR))));
}

/* As herd_bounds(), but for t. */
V void clash_bounds(struct clash *m)
{
	gv one = g_div(g_all(1), m->sum), z, error, off, zmin, zmax;

	z = g_mul(g_mul_add(m->a, m->az, g_mul_add(m->b, m->bz, g_mul(m->c, m->cz))), one);
	error = g_mul_add(m->zsize, g_all(DEPTH_RELATIVE), G_SPREAD(m->aim[1], 2));
	off = g_mul(g_mul(m->slack, g_all(6)), g_sub(m->zmax, m->zmin));
	off = g_mul_add(off, g_size(one), error);
	zmin = g_sub(m->zmin, error);
	zmax = g_add(m->zmax, error);
	m->low = g_max(g_pick(m->sure, g_sub(z, off), zmin), zmin);
	m->high = g_min(g_pick(m->sure, g_add(z, off), zmax), zmax);
	m->maybe &= g_le(G_SPREAD(m->aim[1], 3), m->high);
	m->sure &= g_le(m->high, G_SPREAD(m->aim[2], 1)) & g_le(G_SPREAD(m->aim[2], 0), m->low) & m->maybe;
}

/* As block_behind(). */
V uint32_t clash_behind(const struct clash *m)
{
	gv ex = g_sub(m->x[1], m->x[0]), ey = g_sub(m->y[1], m->y[0]), ez = g_sub(m->z[1], m->z[0]);
	gv gx = g_sub(m->x[2], m->x[0]), gy = g_sub(m->y[2], m->y[0]), gz = g_sub(m->z[2], m->z[0]);
	gv nx = g_mul_sub(ey, gz, g_mul(ez, gy)), ny = g_mul_sub(ez, gx, g_mul(ex, gz));
	gv nz = g_mul_sub(ex, gy, g_mul(ey, gx)), s = g_mul(m->own, g_all(1 / (11 * EDGE_ERROR)));
	gv slack = g_mul(m->slack, g_all(3)), most = g_max(g_max(g_size(m->qx), g_size(m->qy)), g_size(m->az));
	gv up = g_mul_add(nx, m->qx, g_mul_add(ny, m->qy, g_mul(nz, m->az))), e;

	e = g_mul_add(s, g_all(0x1p-18f), g_all(0x1p-20f));
	e = g_mul_add(most, e, g_mul(s, g_mul_add(G_SPREAD(m->aim[2], 2), g_all(8), g_all(0x1p-21f))));
	e = g_mul(e, s);
	return (g_le(e, up) & g_le(slack, m->sum)) | (g_le(e, g_negate(up)) & g_le(m->sum, g_negate(slack)));
}

/* GROUP rays of a list from i on, count of them to be counted, and a block of each's leaf. Nothing beyond a triangle
 * that is surely hit is in reach, and where any will do, nothing at all. */
V void ride_meet(const ald_accel *a, struct ride *c, struct turn *w, uint32_t i, uint32_t count, int any)
{
	const char *ray[GROUP];
	const float *box[GROUP];
	struct clash m;
	gv back, high;

	UNROLL
	for (unsigned j = 0; j < GROUP; j++) {
		const struct rider *r = &c->rider[w->ray[i + j]];

		ray[j] = (const char *)r->aim;
		box[j] = r->box;
	}
	clash_load(a, ray, box, w->ref + i, &m);
	m.tfar = g_each((const uint32_t *)(const void *)(w->tfar + i));
	clash_weigh(&m);
	m.maybe &= count < GROUP ? (1u << 4 * count) - 1 : UINT32_MAX;
	clash_bounds(&m);
	m.maybe &= ~clash_behind(&m) | m.sure;
	back = G_SPREAD(m.aim[2], 3);
	high = any ? g_all(-INFINITY) : g_mul(m.high, g_mul(back, g_all(1 + 0x1p-20f)));
	high = g_pick(m.sure, high, g_all(INFINITY));
	high = g_min(high, G_TURN(high, 0xb1));
	high = g_min(g_min(high, G_TURN(high, 0x4e)), m.tfar);
	g_put_firsts(w->tfar + i, high);
	m.low = g_mul(m.low, back);
	m.low = g_sub_mul(m.low, g_size(m.low), g_all(0x1p-20f));
	m.maybe &= g_le(m.low, high);
	g_pack(&c->low[c->pending], m.low, m.maybe);
	g_pack((float *)&c->id[c->pending], m.ids, m.maybe);
	g_pack((float *)&c->lane[c->pending], G_SPREAD(m.aim[3], 3), m.maybe);
	c->pending += (uint32_t)__builtin_popcount(m.maybe);
	if (c->pending > RIDE_PENDING)
		ride_settle(a, c);
}

V void ride_leaves(const ald_accel *a, struct ride *c, struct turn *w, int any)
{
	for (uint32_t j = 0; j < GROUP; j++) {
		w->ray[w->n + j] = w->ray[0];
		w->ref[w->n + j] = w->ref[0];
	}
	for (uint32_t i = 0; i < w->n; i += GROUP)
		ride_meet(a, c, w, i, w->n - i, any);
	for (uint32_t i = 0; any && i < w->n; i++) {
		int found = !(w->tfar[i] > -INFINITY);

		w->ref[i] = found ? REF_LEAF : w->ref[i];
		w->top[i] = found ? 1 : w->top[i];
	}
}

V void ride_others(const ald_accel *a, struct ride *c, struct turn *w, int any)
{
	const struct batch *b = &c->source.batch;

	for (uint32_t i = 0; i < w->n; i++) {
		const struct rider *r = &c->rider[w->ray[i]];
		const uint32_t *list = &a->other[w->ref[i] & REF_INDEX];
		const ald_ray *ray = &b->ray[r->index];
		ald_hit own = { .t = ray->tmax, .prim = ALD_NONE }, *hit = any ? &own : &b->hit[r->index];

		for (uint32_t k = 1; k <= list[0]; k++) {
			float t;

			if (!ald_sees(a->prims, ray, list[k]) ||
			    !a->prims->intersect(a->prims, list[k], c->source.q, ray, hit))
				continue;
			t = any ? -INFINITY : limit_of(hit->t, r->shift, r->tscale);
			w->tfar[i] = t < w->tfar[i] ? t : w->tfar[i];
			w->top[i] = any ? 1 : w->top[i];
			if (any)
				break;
		}
	}
}

/* Walks that have ended, and those that begin in their place. */
V void ride_change(const ald_accel *a, struct ride *c, struct turn *w, int any)
{
	uint32_t n = 0;

	for (uint32_t i = 0; i < w->n; i++) {
		struct rider *r = &c->rider[w->ray[i]];

		c->reach[word_of(&r->aim[AT_LANE])] = w->tfar[i];
		if (any)
			c->source.batch.hidden[r->index] |= !(w->tfar[i] > -INFINITY);
		if (!ride_next(a, c, r, &w->tfar[n], any))
			continue;
		w->ray[n] = w->ray[i];
		w->top[n++] = 2;
	}
	w->n = n;
}

V void ride_step(const ald_accel *a, struct ride *c, struct turn *w, uint32_t place, int any)
{
	struct turns *t = &c->turns;

	if (place == AT_NODE) {
		for (uint32_t i = 0; i < w->n; i++)
			ride_node(a, &c->rider[w->ray[i]], w, i);
		turns_deal(t, w, c->rider->enter, c->rider->below, sizeof(*c->rider), 0);
		return;
	}
	if (place == AT_LEAF) {
		ride_leaves(a, c, w, any);
		turns_deal(t, w, c->rider->enter, c->rider->below, sizeof(*c->rider), 1);
		return;
	}
	if (place == AT_END)
		ride_change(a, c, w, any);
	else
		ride_others(a, c, w, any);
	turns_deal(t, w, c->rider->enter, c->rider->below, sizeof(*c->rider), 0);
}

static __attribute__((noinline)) void serve_ride(const ald_accel *a, ald_query *q, const struct batch *b,
						 const uint16_t *order, uint32_t first, uint32_t from, uint32_t end,
						 int any)
{
	struct ride c;
	struct turn *w = turns_begin(&c.turns);

	source_open(&c.source, q, b, order, first, from, end);
	c.lanes = c.pending = 0;
	for (uint32_t i = 0; i < a->interleave; i++) {
		struct rider *r = &c.rider[i];
		float tfar;

		r->enter[0] = -INFINITY;
		r->below[0] = DONE;
		if (ride_next(a, &c, r, &tfar, any))
			turn_add(w, i, 0, 2, tfar);
	}
	turns_deal(&c.turns, w, c.rider->enter, c.rider->below, sizeof(*c.rider), 0);
	for (uint32_t place; (w = turns_next(&c.turns, &place)) != NULL;) {
		if (a->far && (place == AT_NODE || place == AT_LEAF))
			turn_fetch(a, w);
		ride_step(a, &c, w, place, any);
	}
	ride_settle(a, &c);
	ask(a, b, &c.source.asked);
}
#endif

#endif
