/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Going through the ranges of a flat structure with a pack of rays. To be included by one file for each
 * instruction set, which defines ISA_LEVEL and ISA_NAME. See lines.h for the arithmetic and its bounds.
 */
#ifndef FLAT_WALK_H
#define FLAT_WALK_H

#include "flat.h"
#include "simd.h"

#define PACK 128u /* rays */
#define FEW 4u /* for less it does not pay to find out if they pass through one point */
#define POINT_NEAR 0x1p-20 /* how near to it they have to pass, in X */
#define NO_AXIS 3u /* of a ray that no triangle stands */

struct pack {
	float dir[3][PACK], m[3][PACK], error[PACK]; /* of lines, by x, y, z */
	float point[3], point_error; /* that all of them pass through; no bound: there is none */
	const struct flat *flat;
	ald_query *q;
	const ald_ray *ray;
	ald_hit *hit;
	uint32_t n;
	uint32_t first[5]; /* of line[]: by main axis, those of 0, 1, 2 and of none, that are live */
	struct line line[PACK];
	union {
		ald_prep right;
		ald_fast_prep fast; /* ALD_PRECISION_FAST */
	} prep[PACK];
	uint8_t ready[PACK]; /* prep is */
	uint8_t axis[PACK];
	uint8_t live[PACK]; /* to be tested with the range at hand */
	uint8_t found[PACK]; /* a better hit was found in it */
} __attribute__((aligned(64)));

struct find {
	uint32_t line, bits; /* the seats that may be hit */
};

/* ---- rays to lines ---- */

static __attribute__((noinline)) void pack_prepare(struct pack *p, uint32_t i)
{
	if (p->flat->fast)
		ald_fast_ray(&p->ray[i], &p->prep[i].fast);
	else
		ald_ray_prep(&p->flat->frame, &p->ray[i], &p->prep[i].right);
	p->ready[i] = 1;
}

/* Floats can't serve this ray. */
static __attribute__((noinline)) void line_odd(struct pack *p, uint32_t i)
{
	ald_prep prep;

	for (unsigned k = 0; k < 3; k++)
		p->dir[k][i] = p->m[k][i] = 0;
	p->error[i] = INFINITY;
	ald_ray_prep(&p->flat->frame, &p->ray[i], &prep);
	if (!(prep.shear[0] == prep.shear[0]))
		p->axis[i] = NO_AXIS;
}

V double largest(const double x[3])
{
	return ald_max(fabs(x[0]), ald_max(fabs(x[1]), fabs(x[2])));
}

V void line_make(struct pack *p, uint32_t i)
{
	const struct space *s = &p->flat->space;
	const ald_ray *r = &p->ray[i];
	const double *dir = &r->dir.x;
	double fx = fabs(dir[0]), fy = fabs(dir[1]), fz = fabs(dir[2]), d[3], o[3], m[3], e, per;
	uint32_t kz = fx > fy ? (fx > fz ? 0 : 2) : (fy > fz ? 1 : 2);

	per = 1 / dir[kz];
	for (unsigned k = 0; k < 3; k++) {
		d[k] = k == kz ? 1 : dir[k] * per;
		o[k] = (ald_get(&r->org, k) - s->centre[k]) * s->scale;
	}
	m[0] = o[1] * d[2] - o[2] * d[1];
	m[1] = o[2] * d[0] - o[0] * d[2];
	m[2] = o[0] * d[1] - o[1] * d[0];
	e = LINE_ERROR(largest(m)) + 0x1p-44 * (fabs(o[0]) + fabs(o[1]) + fabs(o[2]));
	p->axis[i] = (uint8_t)kz;
	p->ready[i] = p->found[i] = 0;
	if (!(e < 0x1p20) || !s->usable || !(fabs(dir[kz]) > 0x1p-400)) {
		line_odd(p, i);
		return;
	}
	for (unsigned k = 0; k < 3; k++) {
		p->dir[k][i] = (float)d[k];
		p->m[k][i] = (float)m[k];
	}
	p->error[i] = ald_float_up(e);
}

/* Do all pass near to where the first one is at t? */
V int through(struct pack *p, int t)
{
	const struct space *s = &p->flat->space;
	double point[3], off = 0, e;

	for (uint32_t i = 0; i < p->n; i++) {
		const ald_ray *r = &p->ray[i];

		for (unsigned k = 0; k < 3; k++) {
			double o = ald_get(&r->org, k) - s->centre[k], x = (t ? o + ald_get(&r->dir, k) : o) * s->scale;

			point[k] = i ? point[k] : x;
			off = ald_max(fabs(x - point[k]), off);
			e = 0x1p-48 * (fabs(o) * s->scale + fabs(x));
			off = ald_max(t ? e : 0, off); /* the sum's rounding */
		}
		if (!(off < POINT_NEAR) || !(p->error[i] < 1))
			return 0;
	}
	e = largest(point);
	for (unsigned k = 0; k < 3; k++)
		p->point[k] = (float)point[k];
	p->point_error = ald_float_up(POINT_ERROR(e) + 16 * off + 0x1p-44 * e);
	return e < POINT_FAR;
}

V void pack_begin(struct pack *p, const struct flat *f, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n)
{
	p->flat = f;
	p->q = q;
	p->ray = ray;
	p->hit = hit;
	p->n = n;
	p->point_error = INFINITY;
	for (uint32_t i = 0; i < n; i++)
		line_make(p, i);
	if (n >= FEW && !through(p, 0) && !through(p, 1))
		p->point_error = INFINITY;
	for (uint32_t i = n; i % LANES && f->kind != FLAT_NONE; i++) {
		for (unsigned k = 0; k < 3; k++)
			p->dir[k][i] = p->m[k][i] = 0;
		p->error[i] = 0;
	}
}

/* ---- volumes ---- */

/* Which lines from at on may meet the volume around a range. q is the moment about its centre c, off by less
 * than error. A ball of radius r is missed if |q| > r |d|, a box if q is beyond its shadow along some axis
 * across d and an axis of the box. */
V uint32_t near_volume(const struct pack *p, uint32_t range, uint32_t at)
{
	const float *v = p->flat->tight[range];
	wide dx = wide_load(p->dir[0] + at), dy = wide_load(p->dir[1] + at), dz = wide_load(p->dir[2] + at);
	wide cx = wide_all(v[0]), cy = wide_all(v[1]), cz = wide_all(v[2]), e = wide_load(p->error + at);
	wide qx = wide_sub_mul(wide_mul_add(cz, dy, wide_load(p->m[0] + at)), cy, dz);
	wide qy = wide_sub_mul(wide_mul_add(cx, dz, wide_load(p->m[1] + at)), cz, dx);
	wide qz = wide_sub_mul(wide_mul_add(cy, dx, wide_load(p->m[2] + at)), cx, dy);
	wide hx = wide_all(v[3]), hy = wide_all(v[4]), hz = wide_all(v[5]);

	if (p->flat->kind == FLAT_BALL) {
		wide reach = (hx + e) * (hx + e) * wide_all(1 + 0x1p-18f);
		wide dd = wide_mul_add(dx, dx, wide_mul_add(dy, dy, dz * dz));

		return ~wide_more(wide_mul_add(qx, qx, wide_mul_add(qy, qy, qz * qz)), reach * dd) & ALL_LANES;
	}
	dx = wide_size(dx);
	dy = wide_size(dy);
	dz = wide_size(dz);
	return ~(wide_more(wide_size(qx), wide_mul_add(hy, dz, wide_mul_add(hz, dy, e))) |
		 wide_more(wide_size(qy), wide_mul_add(hz, dx, wide_mul_add(hx, dz, e))) |
		 wide_more(wide_size(qz), wide_mul_add(hx, dy, wide_mul_add(hy, dx, e)))) & ALL_LANES;
}

static int enters(struct pack *p, uint32_t range, uint32_t i)
{
	const struct flat *f = p->flat;
	double t, far = p->hit[i].t, tmin = p->ray[i].tmin;

	if (!p->ready[i])
		pack_prepare(p, i);
	if (f->fast)
		return flat_enter_fast(f, range, &p->prep[i].fast, tmin, far, &t) && !(t > far);
	return flat_enter(f, range, &p->prep[i].right, tmin, far, &t) && !(t > far);
}

/* Which rays have to be tested with a range: those that meet its volume before what they have hit (R3).
 * Returns how many. */
V uint32_t pack_meet(struct pack *p, uint32_t range, int any)
{
	uint32_t tests = 0, hits = 0;

	for (uint32_t i = 0; i < p->n; i++) {
		p->live[i] = !(any && p->found[i]);
		tests += p->live[i];
	}
	if (p->flat->kind == FLAT_NONE)
		return tests;
	for (uint32_t at = 0; at < p->n; at += LANES) {
		uint32_t maybe = near_volume(p, range, at);

		for (uint32_t i = at; i < at + LANES && i < p->n; i++) {
			p->live[i] = p->live[i] && maybe >> (i - at) & 1 && enters(p, range, i);
			hits += p->live[i];
		}
	}
	if (p->q->count) {
		p->q->count[ALD_COUNT_VOLUME_TESTS] += tests;
		p->q->count[ALD_COUNT_VOLUME_HITS] += hits;
	}
	return hits;
}

/* ---- triangles ---- */

/* The live rays' lines, by main axis. */
V void gather(struct pack *p)
{
	int one = p->point_error < INFINITY;
	uint32_t at[4] = { 0, 0, 0, 0 };

	for (uint32_t i = 0; i < p->n; i++)
		at[p->axis[i]] += p->live[i];
	p->first[0] = 0;
	for (unsigned k = 0; k < 4; k++) {
		p->first[k + 1] = p->first[k] + at[k];
		at[k] = p->first[k];
	}
	for (uint32_t i = 0; i < p->n; i++) {
		uint32_t kz = p->axis[i], kx = kz == 2 ? 0 : kz + 1, ky = kx == 2 ? 0 : kx + 1;
		float e = one ? p->point_error : p->error[i];

		if (!p->live[i] || kz == NO_AXIS)
			continue;
		p->line[at[kz]++] = (struct line){ { p->dir[kx][i], p->dir[ky][i] },
						   { p->m[kx][i], p->m[ky][i], p->m[kz][i] },
						   -e,
						   e,
						   i };
	}
}

V uint32_t note(struct find *out, uint32_t found, uint32_t line, uint32_t missed, uint32_t part)
{
	if (__builtin_expect(missed == ALL_LANES, 1))
		return found;
	out[found] = (struct find){ line, (~missed & ALL_LANES) << part };
	return found + 1;
}

/* n lines of one main axis against a part of a group. Returns how many may hit something. */
V uint32_t sweep(const struct group *g, uint32_t part, uint32_t kz, const struct line *line, uint32_t n,
		 struct find *out)
{
	uint32_t kx = kz == 2 ? 0 : kz + 1, ky = kx == 2 ? 0 : kx + 1, found = 0;
	const float(*row)[GROUP] = g->row;
	wide nx = wide_load(row[ROW_N + kx] + part), ny = wide_load(row[ROW_N + ky] + part);
	wide nz = wide_load(row[ROW_N + kz] + part), bx = wide_load(row[ROW_B + kx] + part);
	wide by = wide_load(row[ROW_B + ky] + part), bz = wide_load(row[ROW_B + kz] + part);
	wide cx = wide_load(row[ROW_C + kx] + part), cy = wide_load(row[ROW_C + ky] + part);
	wide cz = wide_load(row[ROW_C + kz] + part), fx = wide_load(row[ROW_DB + kx] + part);
	wide fy = wide_load(row[ROW_DB + ky] + part), fz = wide_load(row[ROW_DB + kz] + part);
	wide gx = wide_load(row[ROW_DC + kx] + part), gy = wide_load(row[ROW_DC + ky] + part);
	wide gz = wide_load(row[ROW_DC + kz] + part);

	for (uint32_t i = 0; i < n; i++) {
		const struct line *l = &line[i];
		wide sx = wide_all(l->shear[0]), sy = wide_all(l->shear[1]);
		wide mx = wide_all(l->m[0]), my = wide_all(l->m[1]), mz = wide_all(l->m[2]);
		wide b = wide_mul_add(mz, fz, wide_mul_add(my, fy, wide_mul_add(mx, fx, bz)));
		wide c = wide_mul_add(mz, gz, wide_mul_add(my, gy, wide_mul_add(mx, gx, cz)));
		wide a = wide_mul_add(sy, ny, wide_mul_add(sx, nx, nz));

		b = wide_mul_add(sy, by, wide_mul_add(sx, bx, b));
		c = wide_mul_add(sy, cy, wide_mul_add(sx, cx, c));
		a = a - (b + c);
		found = note(out, found, i,
			     wide_outside(wide_min(a, wide_min(b, c)), wide_all(l->least),
					  wide_max(a, wide_max(b, c)), wide_all(l->most)),
			     part);
	}
	return found;
}

/* The same for lines through p. */
V uint32_t sweep_point(const struct group *g, uint32_t part, uint32_t kz, const struct line *line, uint32_t n,
		       struct find *out, const float p[3])
{
	uint32_t kx = kz == 2 ? 0 : kz + 1, ky = kx == 2 ? 0 : kx + 1, found = 0;
	const float(*row)[GROUP] = g->row;
	wide px = wide_all(p[kx]), py = wide_all(p[ky]), pz = wide_all(p[kz]);
	wide fx = wide_load(row[ROW_DB + kx] + part), fy = wide_load(row[ROW_DB + ky] + part);
	wide fz = wide_load(row[ROW_DB + kz] + part), gx = wide_load(row[ROW_DC + kx] + part);
	wide gy = wide_load(row[ROW_DC + ky] + part), gz = wide_load(row[ROW_DC + kz] + part);
	wide bx = wide_sub_mul(fy * pz, fz, py) + wide_load(row[ROW_B + kx] + part);
	wide by = wide_sub_mul(fz * px, fx, pz) + wide_load(row[ROW_B + ky] + part);
	wide bz = wide_sub_mul(fx * py, fy, px) + wide_load(row[ROW_B + kz] + part);
	wide cx = wide_sub_mul(gy * pz, gz, py) + wide_load(row[ROW_C + kx] + part);
	wide cy = wide_sub_mul(gz * px, gx, pz) + wide_load(row[ROW_C + ky] + part);
	wide cz = wide_sub_mul(gx * py, gy, px) + wide_load(row[ROW_C + kz] + part);
	wide ax = wide_load(row[ROW_N + kx] + part) - (bx + cx);
	wide ay = wide_load(row[ROW_N + ky] + part) - (by + cy);
	wide az = wide_load(row[ROW_N + kz] + part) - (bz + cz);
	wide least = wide_all(line->least), most = wide_all(line->most);

	for (uint32_t i = 0; i < n; i++) {
		wide sx = wide_all(line[i].shear[0]), sy = wide_all(line[i].shear[1]);
		wide a = wide_mul_add(sy, ay, wide_mul_add(sx, ax, az));
		wide b = wide_mul_add(sy, by, wide_mul_add(sx, bx, bz));
		wide c = wide_mul_add(sy, cy, wide_mul_add(sx, cx, cz));

		found = note(out, found, i,
			     wide_outside(wide_min(a, wide_min(b, c)), least, wide_max(a, wide_max(b, c)), most),
			     part);
	}
	return found;
}

static __attribute__((noinline)) int confirm(struct pack *p, uint32_t i, uint32_t range, uint32_t at, uint32_t bits)
{
	const struct flat *f = p->flat;
	const ald_prims *prims = f->prims;
	const struct range *r = &f->range[range];
	const ald_fast_triangles *fast = f->fast ? &f->fast[2 * (r->group + at)] : NULL;
	int found = 0;

	if (!p->ready[i])
		pack_prepare(p, i);
	if (fast)
		bits &= ald_fast_triangle_n(&p->prep[i].fast, &fast[0]) |
			ald_fast_triangle_n(&p->prep[i].fast, &fast[1]) << ALD_LANES;
	for (; bits; bits &= bits - 1) {
		unsigned k = (unsigned)__builtin_ctz(bits);
		uint32_t id = r->first + at * GROUP + k, owner = range;
		ald_vec v[3];

		if (id >= r->tris)
			break;
		if (!ald_sees(prims, &p->ray[i], id))
			continue;
		if (fast) {
			found |= ald_fast_triangle(&p->prep[i].fast, &p->ray[i], &fast[k / ALD_LANES], k % ALD_LANES,
						   id, &p->hit[i]);
			continue;
		}
		if (f->kind == FLAT_NONE && prims->origin)
			owner = ald_group_of(prims, id);
		ald_corners(prims, id, owner, v);
		found |= ald_triangle(&p->prep[i].right, &p->ray[i], v, id, &p->hit[i]);
	}
	return found;
}

/* Those that have found something go. */
V void forget_found(struct pack *p)
{
	uint32_t to = 0, from = 0;

	for (unsigned k = 0; k < 3; k++) {
		uint32_t end = p->first[k + 1];

		p->first[k] = to;
		for (; from < end; from++) {
			if (!p->found[p->line[from].ray])
				p->line[to++] = p->line[from];
		}
	}
	p->first[4] = to + (p->first[4] - p->first[3]);
	p->first[3] = to;
}

V void pack_triangles(struct pack *p, uint32_t range, int any)
{
	const struct range *r = &p->flat->range[range];
	struct find find[PACK * GROUP / LANES];
	uint32_t n = r->tris - r->first;
	uint64_t tests = 0;

	gather(p);
	for (uint32_t at = 0; at * GROUP < n && p->first[4]; at++) {
		const struct group *g = &p->flat->group[r->group + at];
		int found = 0;

		tests += (uint64_t)p->first[4] * (n - at * GROUP < GROUP ? n - at * GROUP : GROUP);
		for (uint32_t kz = 0; kz < 3; kz++) {
			const struct line *line = &p->line[p->first[kz]];
			uint32_t lines = p->first[kz + 1] - p->first[kz], finds = 0;

			for (uint32_t part = 0; part < GROUP && lines; part += LANES)
				finds += p->point_error < INFINITY ?
						 sweep_point(g, part, kz, line, lines, find + finds, p->point) :
						 sweep(g, part, kz, line, lines, find + finds);
			for (uint32_t i = 0; i < finds; i++) {
				uint32_t ray = line[find[i].line].ray;

				if ((any && p->found[ray]) || !confirm(p, ray, range, at, find[i].bits))
					continue;
				found = p->found[ray] = 1;
			}
		}
		if (any && found)
			forget_found(p);
	}
	if (p->q->count)
		p->q->count[ALD_COUNT_PRIMS] += tests;
}

/* ---- other primitives, and all of it ---- */

V void pack_others(struct pack *p, uint32_t range, int any)
{
	const struct range *r = &p->flat->range[range];
	const ald_prims *prims = p->flat->prims;
	struct {
		double t;
		uint32_t prim;
	} old[PACK];
	uint8_t live[PACK];

	for (uint32_t id = r->tris; id < r->end; id++) {
		uint32_t seen = 0, tests = 0;

		for (uint32_t i = 0; i < p->n; i++) {
			int test = p->live[i] && !(any && p->found[i]);

			live[i] = test && ald_sees(prims, &p->ray[i], id);
			tests += (uint32_t)test;
			seen += live[i];
			old[i].t = p->hit[i].t;
			old[i].prim = p->hit[i].prim;
		}
		if (p->q->count)
			p->q->count[ALD_COUNT_PRIMS] += tests;
		if (!seen)
			continue;
		prims->intersect_n(prims, id, p->q, p->ray, p->hit, live, p->n);
		for (uint32_t i = 0; i < p->n; i++)
			p->found[i] |= live[i] && (p->hit[i].t != old[i].t || p->hit[i].prim != old[i].prim);
	}
}

V void pack_walk(struct pack *p, int any)
{
	const struct flat *f = p->flat;

	for (uint32_t r = 0; r < f->ranges; r++) {
		uint32_t useful = 0, before = 0;

		if (!pack_meet(p, r, any))
			continue;
		for (uint32_t i = 0; i < p->n; i++) {
			p->found[i] = any && p->found[i];
			before += p->found[i];
		}
		if (f->range[r].first < f->range[r].tris)
			pack_triangles(p, r, any);
		if (f->range[r].tris < f->range[r].end)
			pack_others(p, r, any);
		for (uint32_t i = 0; i < p->n; i++)
			useful += p->found[i];
		if (f->kind != FLAT_NONE && p->q->count)
			p->q->count[ALD_COUNT_VOLUME_USEFUL] += useful - before;
	}
}

static void nearest(const struct flat *f, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n)
{
	struct pack p;

	for (uint32_t at = 0; at < n; at += PACK) {
		pack_begin(&p, f, q, ray + at, hit + at, n - at < PACK ? n - at : PACK);
		pack_walk(&p, 0);
	}
}

static void occluded(const struct flat *f, ald_query *q, const ald_ray *ray, uint8_t *hidden, uint32_t n)
{
	ald_hit hit[PACK];
	struct pack p;

	for (uint32_t at = 0; at < n; at += PACK) {
		uint32_t m = n - at < PACK ? n - at : PACK;

		for (uint32_t i = 0; i < m; i++)
			hit[i] = (ald_hit){ .t = ray[at + i].tmax, .prim = ALD_NONE };
		pack_begin(&p, f, q, ray + at, hit, m);
		pack_walk(&p, 1);
		memcpy(hidden + at, p.found, m);
	}
}

const struct flat_isa ISA_NAME = { nearest, occluded };

#endif
