/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A ray on its way through bvh8, and what it does with nodes and blocks. See bvh8.h for coordinates and
 * error bounds.
 *
 * Boxes: Ize: Robust BVH Ray Traversal, JCGT 2(2), 2013, but with absolute bounds. Blocks: the sheared edge
 * functions of Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, JCGT 2(1), 2013.
 *
 * Most triangles that are hit are so beyond the doubt of floats. Then the upper bound of the distance culls
 * what lies behind at once, and the doubles are asked after the walk, for the nearest only; where any hit will
 * do they are not asked at all.
 */
#ifndef BVH8_BEAM_H
#define BVH8_BEAM_H

#include "bvh8_ask.h"

#define PENDING 8u
/* Of a block's slack, what counts at no distance, for a triangle of any extent and of extent 1, and for each 1 of z. */
#define SLACK_LEAST (1 / 11.9f)
#define SLACK_SQUARE (3.6f / 12 / (12 * EDGE_ERROR))
#define SLACK_SLOPE (1.76f / 11.9f)
#define DONE EMPTY /* the next step of a walk that has ended */

struct aim { /* a ray, as triangles see it */
	/* By kx, ky, kz; distances along kz, those called z, count the way the ray goes. */
	float o[3], shear[2], side;
	float zfar; /* nothing beyond counts */
	float before, sure_lo, sure_hi; /* nothing before counts; a z between is of a t that counts */
	float zerror, pad; /* how far a z may be off, where the ray begins */
	float grow; /* of slacks, for rays from far away */
	float back; /* t = z back */
	uint32_t axis[3];
};

struct beam {
	float inverse[3], near_o[3], far_o[3]; /* plane * inverse + near_o is the entrance */
	uint32_t near[3], far[3]; /* which planes of a node */
	float tfar; /* nothing beyond counts */
	struct aim aim;
	float depth; /* z = t depth */
	uint32_t pending; /* triangles that may be hit, to be asked about */
	uint32_t id[PENDING + SEATS];
	float low[PENDING + SEATS]; /* no t of theirs is less */
	float high[PENDING + SEATS]; /* of those that are hit for sure, none is more; else infinite */
	uint32_t found, asked; /* surely hit, where any will do; some are asked about already */
	uint32_t ref, top, index; /* where it is; how high the stack; which ray of the batch */
	uint32_t way; /* of a node's orders */
	double shift, tscale; /* t of the walk = (t - shift) * tscale */
	const ald_ray *ray;
	ald_hit *hit, own; /* own: where any will do */
	/* The stack: below what is on it stands DONE, with an entrance before all. */
	float enter[STACK_MAX + WIDTH]; /* where it is entered */
	uint32_t below[STACK_MAX + WIDTH]; /* what is still to be seen */
};

/* Slacks grow by its square for a ray of this pad: that is off by pad more, h by 2 pad. */
V float far_of(float pad)
{
	return 1 + 20 * pad / EDGE_ERROR;
}

V void beam_cut(struct beam *b, float t)
{
	b->tfar = t;
	b->aim.zfar = t * b->depth + b->aim.zerror * (1 + DEPTH_ERROR / DEPTH_LEAST);
}

/* Nothing beyond a t counts. */
V float limit_of(double t, double shift, double tscale)
{
	double x = (t - shift) * tscale;

	return (float)(x < 8 ? (x > -8 ? x : -8) : 8) * (1 + 0x1p-20f) + 0x1p-30f;
}

/* hit->t is new. */
V void beam_limit(struct beam *b)
{
	float t = limit_of(b->hit->t, b->shift, b->tscale);

	if (t < b->tfar)
		beam_cut(b, t);
}

/* From lane i of a lot, ray index of the batch. The root is on the stack. */
V void beam_begin(const ald_accel *a, struct beam *b, const struct lot *l, unsigned i, const struct batch *s,
		  uint32_t index)
{
	uint32_t kz = (uint32_t)(l->main[1] >> i & 1) + 2 * (uint32_t)(l->main[2] >> i & 1), kx = kz == 2 ? 0 : kz + 1;
	uint32_t ky = kx == 2 ? 0 : kx + 1;
	float far = far_of(l->pad[i]), first, last;
	struct aim *aim = &b->aim;

	b->way = ORDER_TURNED;
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		uint32_t down = (uint32_t)(l->sign[k] >> i & 1);

		b->way ^= down << k;

		b->inverse[k] = l->inverse[k][i];
		b->near_o[k] = l->near_o[k][i];
		b->far_o[k] = l->far_o[k][i];
		b->near[k] = 2 * k + down;
		b->far[k] = 2 * k + 1 - down;
	}
	aim->side = l->sign[kz] >> i & 1 ? -1.0f : 1.0f;
	aim->axis[0] = kx;
	aim->axis[1] = ky;
	aim->axis[2] = kz;
	aim->o[0] = l->o[kx][i];
	aim->o[1] = l->o[ky][i];
	aim->o[2] = l->o[kz][i] * aim->side;
	aim->shear[0] = l->shear[0][i];
	aim->shear[1] = l->shear[1][i];
	b->depth = l->depth[i];
	aim->back = b->inverse[kz] * aim->side;
	aim->pad = l->pad[i];
	aim->zerror = a->fast ? 0 : depth_error(l->pad[i]);
	aim->grow = a->fast ? 0 : far * far;
	first = l->first[i] * b->depth;
	last = l->last[i] * b->depth;
	aim->before = first - fabsf(first) * DEPTH_LEAST;
	aim->sure_lo = first + fabsf(first) * DEPTH_LEAST;
	aim->sure_hi = last - fabsf(last) * DEPTH_LEAST;
	beam_cut(b, l->tfar[i]);
	b->pending = b->found = b->asked = 0;
	b->index = index;
	b->shift = l->shift[i];
	b->tscale = l->tscale[i];
	b->ray = &s->ray[index];
	b->hit = s->hit ? &s->hit[index] : &b->own;
	if (!s->hit)
		b->own = (ald_hit){ .t = b->ray->tmax, .prim = ALD_NONE };
	b->enter[0] = b->enter[1] = -INFINITY;
	b->below[0] = DONE;
	b->below[1] = a->root;
	b->top = 2;
}

V void beam_pop(struct beam *b)
{
	uint32_t top = b->top;

	do
		top--;
	while (b->enter[top] > b->tfar);
	b->top = top;
	b->ref = b->below[top];
}

/* Through a node: what the ray enters goes on the stack, the nearest last. */
V void beam_node(const ald_accel *a, struct beam *b)
{
	const struct node *n = &a->node[b->ref];
	f8 t0 = f8_mul_add(f8_load(n->plane[b->near[0]]), f8_all(b->inverse[0]), f8_all(b->near_o[0]));
	f8 t1 = f8_mul_add(f8_load(n->plane[b->far[0]]), f8_all(b->inverse[0]), f8_all(b->far_o[0]));
	f8 y0 = f8_mul_add(f8_load(n->plane[b->near[1]]), f8_all(b->inverse[1]), f8_all(b->near_o[1]));
	f8 y1 = f8_mul_add(f8_load(n->plane[b->far[1]]), f8_all(b->inverse[1]), f8_all(b->far_o[1]));
	f8 z0 = f8_mul_add(f8_load(n->plane[b->near[2]]), f8_all(b->inverse[2]), f8_all(b->near_o[2]));
	f8 z1 = f8_mul_add(f8_load(n->plane[b->far[2]]), f8_all(b->inverse[2]), f8_all(b->far_o[2]));

	t0 = f8_max(f8_max(t0, y0), f8_max(z0, f8_all(0)));
	t1 = f8_min(f8_min(t1, y1), f8_min(z1, f8_all(b->tfar)));
#if ISA_LEVEL >= 2
	b->top += f8_ordered(t0, t1, n->order[b->way], n->child, b->enter + b->top, b->below + b->top);
#else
	b->top += f8_order(t0, t1, n->child, b->enter + b->top, b->below + b->top);
#endif
}

struct meeting { /* of a ray with the triangles of a block */
	f4 a, b, c, az, bz, cz; /* weights of the corners; z of the corners */
	f4 low, high; /* bounds on the z of a hit */
	uint32_t maybe, sure; /* the lanes that may be hit before zfar; that are, at a t that counts */
};

/* Lanes where the triangle is surely behind where the ray begins, if its line meets it: mostly the one that the ray
 * starts on, of which weights don't tell. to: from there to the first corners; sum: of the weights.
 *
 * N = (e x g) . q, of two edges and the way to a corner, is z times the sum of the weights, with the other sign.
 * Edges are off by 2^-24 and 2^-24 of what they are, so is q, and by the ray's pad. With s the largest component of
 * an edge, Q that of q, the normal's are off by less than 4 s 2^-24 (1 + s) + 6 s s 2^-24, and N, with its own
 * roundings, by less than 2^-24 (12 s Q + 6 s s + 54 s s Q) + 6 s s pad. A slack of more than 12 EDGE_ERROR s bounds
 * s. Where the line meets the triangle, the sum of the weights has its sign if it is more than 3 slack. */
V uint32_t block_behind(const struct aim *t, const struct block *n, const f4 to[3], f4 sum, f4 slack)
{
	uint32_t x = t->axis[0], y = t->axis[1], z = t->axis[2];
	f4 side = f4_all(t->side), ax = f4_load(n->v[0][x]), ay = f4_load(n->v[0][y]), az = f4_load(n->v[0][z]);
	f4 ex = f4_sub(f4_load(n->v[1][x]), ax), ey = f4_sub(f4_load(n->v[1][y]), ay);
	f4 ez = f4_mul(f4_sub(f4_load(n->v[1][z]), az), side), gx = f4_sub(f4_load(n->v[2][x]), ax);
	f4 gy = f4_sub(f4_load(n->v[2][y]), ay), gz = f4_mul(f4_sub(f4_load(n->v[2][z]), az), side);
	f4 nx = f4_mul_sub(ey, gz, f4_mul(ez, gy)), ny = f4_mul_sub(ez, gx, f4_mul(ex, gz));
	f4 nz = f4_mul_sub(ex, gy, f4_mul(ey, gx));
	f4 s = f4_mul(f4_load(n->slack), f4_all(1 / (11 * EDGE_ERROR))), up, e, most;

	slack = f4_mul(slack, f4_all(3));
	most = f4_max(f4_max(f4_size(to[0]), f4_size(to[1])), f4_size(to[2]));
	up = f4_mul_add(nx, to[0], f4_mul_add(ny, to[1], f4_mul(nz, to[2])));
	e = f4_mul_add(s, f4_all(0x1p-18f), f4_all(0x1p-20f));
	e = f4_mul(f4_mul_add(most, e, f4_mul(s, f4_all(0x1p-21f + 8 * t->pad))), s);
	return (f4_le(e, up) & f4_le(slack, sum)) | (f4_le(e, f4_negate(up)) & f4_le(sum, f4_negate(slack)));
}

/* How to meet a block: where most often nothing may be hit, so that it ends there; and fetching for the doubles
 * which corners the first has that may be hit. */
enum meet { MEET_ALL, MEET_EARLY, MEET_FETCHED };

/* Bounds on the z of hits, and which lanes are hit for sure.
 *
 * Where a coordinate is wider than a hit's can be, slack is no bound.
 * z is the mean of the corners' by weights that are off by slack each; with S the spread of the corners, D the
 * sum of the weights, it is off by at most the lesser of 3 slack S / (D - 3 slack) and S, and by error: corners and
 * origin are off by 2^-25 each, and the ray's pad, and their difference by 2^-24 of itself, which counts twice, once
 * in S; the mean takes six roundings, 3 slack S / (D - 3 slack) where it is less than S less than 2^-21 S: with the
 * corners' z of at most Z, in all 2^-23 + 2 pad + 2^-19 Z. The kernel's own t is off by less than 9 u of n . q over
 * n . d, u = 2^-53, so its z, with D > 3 slack > 3 EDGE_ERROR s, by less than 2^23 u s Q, Q how far away the ray's own
 * origin is: 2^18 pad at most, as pad holds 64 u Q. DEPTH_LEAST and DEPTH_PAD cover both. */
V void block_bounds(const struct aim *t, const struct block *n, struct meeting *m, const f4 to[3], f4 zmin, f4 zmax,
		    f4 zsize, f4 wide, f4 slack, f4 least, f4 most, enum meet early)
{
	f4 sum = f4_add(f4_add(m->a, m->b), m->c), three = f4_mul(slack, f4_all(3));
	f4 z = f4_mul_add(m->a, m->az, f4_mul_add(m->b, m->bz, f4_mul(m->c, m->cz))), off, error;

	error = f4_mul_add(zsize, f4_all(DEPTH_RELATIVE), f4_all(t->zerror));
	off = f4_mul(three, f4_sub(zmax, zmin));
	off = f4_div(off, f4_max(f4_sub(f4_size(sum), three), f4_all(0x1p-100f)));
	off = f4_add(off, error);
	z = f4_div(z, sum);
	m->sure = f4_le(slack, least) | f4_le(most, f4_negate(slack));
	m->sure &= f4_le(wide, f4_mul(f4_load(n->slack), f4_all(1 / (6 * EDGE_ERROR))));
	zmin = f4_sub(zmin, error);
	zmax = f4_add(zmax, error);
	m->low = f4_max(f4_pick(m->sure, f4_sub(z, off), zmin), zmin);
	m->high = f4_min(f4_pick(m->sure, f4_add(z, off), zmax), zmax);
	m->maybe &= f4_le(f4_all(t->before), m->high);
	m->sure &= f4_le(m->high, f4_all(t->sure_hi)) & f4_le(f4_all(t->sure_lo), m->low) & m->maybe;
	if (!early || (m->maybe & ~m->sure & f4_le(m->low, f4_all(t->sure_lo))))
		m->maybe &= ~block_behind(t, n, to, sum, slack) | m->sure;
}

/* What a weight may be off by, given how far along kz the corners are at most; a block's own slack is for any.
 *
 * Let z be that, x the triangle's extent. Corners and origin are off by 2^-25 each, the origin's z counting as much as
 * its x, for slopes are at most 1. Differences of them are off by 2^-24 of z and of z + 2 x, the slope by 2^-25, its
 * product and the last difference by 2^-24 of z and of 2 x. So a sheared coordinate is off by h <= 2^-24 (2 + 3.5 z +
 * 4 x), and a weight by 8 x h + 2 h h + 16 * 2^-24 x x <= EDGE_ERROR x (1 + 1.75 z + 3 x) + 2 h h; for the last term
 * what a slack holds of 4 EDGE_ERROR instead of x is enough. Triangles that are small and near, as they are where a
 * ray starts, would be asked about ten times as often by their block's slack. */
V f4 block_slack(const struct aim *t, const struct block *n, f4 zsize)
{
	f4 slack = f4_load(n->slack), part = f4_mul_add(f4_size(slack), f4_all(SLACK_SQUARE), f4_all(SLACK_LEAST));

	return f4_mul(f4_mul(slack, f4_all(t->grow)), f4_mul_add(zsize, f4_all(SLACK_SLOPE), part));
}

V void block_meet(const ald_accel *a, const struct aim *t, const struct block *n, const ald_ray *ray,
		  struct meeting *m, enum meet early)
{
	const float(*v0)[SEATS] = n->v[0], (*v1)[SEATS] = n->v[1], (*v2)[SEATS] = n->v[2];
	uint32_t x = t->axis[0], y = t->axis[1], z = t->axis[2];
	f4 ox = f4_all(t->o[0]), oy = f4_all(t->o[1]), oz = f4_all(t->o[2]), side = f4_all(t->side);
	f4 sx = f4_all(t->shear[0]), sy = f4_all(t->shear[1]), to[3], ax, ay, bx, by, cx, cy;
	f4 least, most, wide, slack, zmin, zmax, zsize;

	m->az = f4_mul_sub(f4_load(v0[z]), side, oz);
	m->bz = f4_mul_sub(f4_load(v1[z]), side, oz);
	m->cz = f4_mul_sub(f4_load(v2[z]), side, oz);
	to[0] = f4_sub(f4_load(v0[x]), ox);
	to[1] = f4_sub(f4_load(v0[y]), oy);
	to[2] = m->az;
	ax = f4_sub_mul(to[0], sx, m->az);
	ay = f4_sub_mul(to[1], sy, m->az);
	bx = f4_sub_mul(f4_sub(f4_load(v1[x]), ox), sx, m->bz);
	by = f4_sub_mul(f4_sub(f4_load(v1[y]), oy), sy, m->bz);
	cx = f4_sub_mul(f4_sub(f4_load(v2[x]), ox), sx, m->cz);
	cy = f4_sub_mul(f4_sub(f4_load(v2[y]), oy), sy, m->cz);
	m->a = f4_mul_sub(cx, by, f4_mul(cy, bx));
	m->b = f4_mul_sub(ax, cy, f4_mul(ay, cx));
	m->c = f4_mul_sub(bx, ay, f4_mul(by, ax));
	least = f4_min(m->a, f4_min(m->b, m->c));
	most = f4_max(m->a, f4_max(m->b, m->c));
	zsize = f4_max(f4_size(m->az), f4_max(f4_size(m->bz), f4_size(m->cz)));
	slack = block_slack(t, n, zsize);
	zmin = f4_min(m->az, f4_min(m->bz, m->cz));
	zmax = f4_max(m->az, f4_max(m->bz, m->cz));
	m->maybe = f4_le(f4_negate(slack), least) | f4_le(most, slack);
	m->maybe &= f4_le(zmin, f4_all(t->zfar));
	m->sure = 0;
	m->low = m->high = zmin;
	if (early && !m->maybe)
		return;
	if (early == MEET_FETCHED && a->far)
		__builtin_prefetch(&a->prims->index[3 * (size_t)n->id[__builtin_ctz(m->maybe)]]);
	m->maybe &= ~f4_same(n->id, ray->skip);
	if (a->prims->mask) {
		UNROLL
		for (unsigned k = 0; k < SEATS; k++)
			m->maybe &= ~((uint32_t)(!ald_sees(a->prims, ray, n->id[n->slack[k] < 0 ? 0 : k])) << k);
	}
	if (a->fast)
		return;
	wide = f4_max(f4_max(f4_max(f4_size(ax), f4_size(ay)), f4_max(f4_size(bx), f4_size(by))),
		      f4_max(f4_size(cx), f4_size(cy)));
	block_bounds(t, n, m, to, zmin, zmax, zsize, wide, slack, least, most, early);
}

/* Bounds as t, rounded outward. */
V f4 low_t(const struct aim *t, f4 low)
{
	low = f4_mul(low, f4_all(t->back));
	return f4_sub_mul(low, f4_size(low), f4_all(0x1p-20f));
}

/* Infinite where it is not sure; where it is, z > 0. */
V f4 high_t(const struct aim *t, const struct meeting *m)
{
	return f4_pick(m->sure, f4_mul(m->high, f4_all(t->back * (1 + 0x1p-20f))), f4_all(INFINITY));
}

/* In exact order the host rounds the winner's t. So where floats alone tell that a triangle is hit, at a t that
 * counts and before all else, it need not be asked about: their bounds on t do, rounded outward. */
V ald_hit certain_hit(float least, float most, double tscale, double shift, uint32_t id)
{
	double back = 1 / tscale, low = (double)least * back + shift, high = (double)most * back + shift;

	return (ald_hit){ .t = high + 4 * ALD_U * fabs(high), .u = low - 4 * ALD_U * fabs(low), .prim = id };
}

V int beam_certain(struct beam *b)
{
	uint32_t best = 0;

	if (b->hit->prim != ALD_NONE || b->asked || !b->pending)
		return 0;
	for (uint32_t i = 1; i < b->pending; i++)
		best = b->low[i] < b->low[best] ? i : best;
	if (!(b->high[best] < INFINITY))
		return 0;
	for (uint32_t i = 0; i < b->pending; i++) {
		if (b->id[i] != b->id[best] && !(b->low[i] > b->high[best]))
			return 0;
	}
	*b->hit = certain_hit(b->low[best], b->high[best], b->tscale, b->shift, b->id[best]);
	return 1;
}

/* Ask the doubles about what is pending and still in reach. The first few without a branch: how many there are
 * is not to be guessed. */
V void beam_settle(const ald_accel *a, const struct batch *s, struct asked *q, struct beam *b)
{
	uint32_t n = b->found ? 0 : b->pending;

	if (q->n > ASKED_MAX - PENDING - SEATS)
		ask(a, s, q);
	for (uint32_t i = 0; i < SEATS; i++) {
		q->ray[q->n] = b->index;
		q->id[q->n] = b->id[i];
		q->n += (i < n) & !(b->low[i] > b->tfar);
	}
	for (uint32_t i = SEATS; i < n; i++) {
		q->ray[q->n] = b->index;
		q->id[q->n] = b->id[i];
		q->n += !(b->low[i] > b->tfar);
	}
	b->pending = 0;
}

/* Nothing more comes. */
V void beam_end(const ald_accel *a, const struct batch *s, struct asked *q, struct beam *b, int any)
{
	if (any)
		s->hidden[b->index] |= (uint8_t)b->found;
	if (any || !a->frame.exact || !beam_certain(b))
		beam_settle(a, s, q, b);
}

/* Whatever the block may hold, in the same steps. */
V void beam_meet(const ald_accel *a, const struct batch *s, struct asked *q, struct beam *b, const struct block *n,
		 const struct meeting *m, int any)
{
	f4 high = high_t(&b->aim, m);
	float least;

	f4_pack((float *)&b->id[b->pending], f4_load((const float *)n->id), m->maybe);
	f4_pack(&b->low[b->pending], low_t(&b->aim, m->low), m->maybe);
	f4_pack(&b->high[b->pending], high, m->maybe);
	b->pending += (uint32_t)__builtin_popcount(m->maybe);
	if (any) {
		b->found |= m->sure != 0;
		b->top = m->sure ? 1 : b->top;
	} else {
		least = f4_least(high);
		beam_cut(b, least < b->tfar ? least : b->tfar);
	}
	if (b->pending > PENDING) {
		beam_settle(a, s, q, b);
		b->asked = 1;
	}
}

/* Where the line meets a triangle's plane, as the ray has it: the beam's own z goes with where the ray is
 * entered from, and one that goes on behind a hit would meet that again. */
V double plane_t(const ald_accel *a, const ald_ray *r, const struct block *n, unsigned k)
{
	double e[3], g[3], up = 0, across = 0;

	UNROLL
	for (unsigned i = 0; i < 3; i++) {
		e[i] = (double)n->v[1][i][k] - (double)n->v[0][i][k];
		g[i] = (double)n->v[2][i][k] - (double)n->v[0][i][k];
	}
	UNROLL
	for (unsigned i = 0; i < 3; i++) {
		unsigned x = i == 2 ? 0 : i + 1, y = x == 2 ? 0 : x + 1;
		double normal = e[x] * g[y] - e[y] * g[x];

		up += normal * ((double)n->v[0][i][k] - (ald_get(&r->org, i) - a->centre[i]) * a->scale);
		across += normal * ald_get(&r->dir, i);
	}
	return up / (across * a->scale);
}

/* For --precision=fast: triangle k of a block, by the weights of its second and third corner and all three. */
V int fast_hit(const ald_accel *a, const ald_ray *r, const struct block *n, unsigned k, float u, float v, float sum,
	       ald_hit *h)
{
	double t = plane_t(a, r, n, k);

	if (n->id[k] == ALD_NONE || !(fabsf(sum) > FLT_MIN) || !(fabs(t) <= DBL_MAX) ||
	    !ald_counts(r, t, n->id[k], h) || !ald_sees(a->prims, r, n->id[k]))
		return 0;
	*h = (ald_hit){ .t = t, .u = (double)(u / sum), .v = (double)(v / sum), .prim = n->id[k] };
	return 1;
}

/* What the floats say. With their bounds at 0, a lane that may be hit is. */
V void beam_meet_fast(const ald_accel *a, struct beam *b, const struct block *n, struct meeting *m, int any)
{
	float w[3][SEATS] __attribute__((aligned(16)));

	f4_store(w[0], m->b);
	f4_store(w[1], m->c);
	f4_store(w[2], f4_add(f4_add(m->a, m->b), m->c));
	for (; m->maybe; m->maybe &= m->maybe - 1) {
		unsigned k = (unsigned)__builtin_ctz(m->maybe);

		if (!fast_hit(a, b->ray, n, k, w[0][k], w[1][k], w[2][k], b->hit))
			continue;
		beam_limit(b);
		b->found = 1;
		b->top = any ? 1 : b->top;
	}
}

V void beam_others(const ald_accel *a, ald_query *q, struct beam *b, int any)
{
	const uint32_t *list = &a->other[b->ref & REF_INDEX];

	for (uint32_t i = 1; i <= list[0]; i++) {
		if (!ald_sees(a->prims, b->ray, list[i]) ||
		    !a->prims->intersect(a->prims, list[i], q, b->ray, b->hit))
			continue;
		if (any) {
			b->found = 1;
			b->top = 1;
			return;
		}
		beam_limit(b);
	}
}

/* The first block of a leaf; the rest of it goes on the stack. Where any will do and it is hit, all else leaves
 * the stack. */
V void beam_leaf(const ald_accel *a, const struct batch *s, struct asked *q, struct beam *b, int any)
{
	const struct block *n = &a->block[b->ref & REF_INDEX];
	struct meeting m;

	b->enter[b->top] = -INFINITY;
	b->below[b->top] = b->ref + 1 - (1u << REF_SHIFT);
	b->top += (b->ref & 7u << REF_SHIFT) != 0;
	block_meet(a, &b->aim, n, b->ray, &m, MEET_ALL);
	if (a->fast)
		beam_meet_fast(a, b, n, &m, any);
	else
		beam_meet(a, s, q, b, n, &m, any);
}

V void beam_step(const ald_accel *a, const struct batch *s, struct asked *asked, ald_query *q, struct beam *b, int any)
{
	if (b->ref < REF_LEAF)
		beam_node(a, b);
	else if (b->ref >= REF_OTHERS)
		beam_others(a, q, b, any);
	else
		beam_leaf(a, s, asked, b, any);
}

/* A ray whose numbers no triangle stands. */
static __attribute__((noinline)) int beam_odd(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit,
					      int any)
{
	int found = 0;

	for (uint32_t id = a->prims->tri_count; id < a->prims->count && !(found && any); id++) {
		if (ald_sees(a->prims, ray, id))
			found |= a->prims->intersect(a->prims, id, q, ray, hit);
	}
	return found;
}

V void lot_odd(const ald_accel *a, ald_query *q, const struct batch *b, const struct lot *l, int any)
{
	for (uint64_t odd = l->odd; odd; odd &= odd - 1) {
		uint32_t i = l->index[__builtin_ctzll(odd)];
		const ald_ray *r = &b->ray[i];
		ald_hit own = { .t = r->tmax, .prim = ALD_NONE };

		if (any)
			b->hidden[i] = (uint8_t)beam_odd(a, q, r, &own, 1);
		else
			beam_odd(a, q, r, &b->hit[i], 0);
	}
}

#endif
