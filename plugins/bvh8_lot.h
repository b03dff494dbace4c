/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Rays made ready for bvh8's floats, LOT at a time: moved to where they enter the scene's box, in its
 * coordinates. See bvh8.h for these and for the error bounds.
 */
#ifndef BVH8_LOT_H
#define BVH8_LOT_H

#include "bvh8.h"
#include "bvh8_vec.h"
#include "doubles.h"

#define LOT 64u
/* Of a distance along the main axis: where it is 0, for each 1 of it, and within the scene. See bvh8_beam.h. */
#define DEPTH_LEAST 0x1p-22f
#define DEPTH_RELATIVE 0x1p-19f
#define DEPTH_ERROR 0x1p-18f
#define DEPTH_PAD 0x1p19f /* as often as the pad of rays from far away */

struct lot {
	/* plane * inverse + near_o is the entrance */
	float o[3][LOT], inverse[3][LOT], near_o[3][LOT], far_o[3][LOT];
	float shear[2][LOT]; /* by kx, ky, for distances along kz that count the way the ray goes */
	float depth[LOT]; /* such a distance is t depth */
	float tfar[LOT]; /* nothing beyond counts */
	float first[LOT], last[LOT]; /* a t between counts */
	float pad[LOT];
	double shift[LOT], tscale[LOT]; /* t of the walk = (t - shift) * tscale */
	uint64_t sign[3], main[3]; /* bits of lanes: the direction goes down; this axis is kz */
	uint64_t live, odd; /* those that meet the scene's box, and, of them, that no triangle stands */
	uint32_t index[LOT]; /* of the batch */
} __attribute__((aligned(64)));

struct lines { /* a lot's rays as the doubles want them: see struct pairs */
	double o[3][LOT], d[3][LOT], inv[3][LOT], shear[2][LOT], pad[LOT], first[LOT], last[LOT];
} __attribute__((aligned(64)));

struct batch { /* the rays of a call */
	const ald_ray *ray;
	ald_hit *hit; /* NULL: any will do, and hidden is told */
	uint8_t *hidden;
	uint32_t n;
};

V float depth_error(float pad)
{
	return DEPTH_LEAST + DEPTH_PAD * pad;
}

V dv walk_t(dv t, dv shift, dv tscale)
{
	t = dv_mul(dv_sub(t, shift), tscale);
	return dv_min(dv_max(t, dv_all(-8)), dv_all(8));
}

/* Along axes k + 1, k + 2 and k, k being each lane's main one. */
V void along_main(const dm main[3], const dv x[3], dv out[3])
{
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		const unsigned next = k == 2 ? 0 : k + 1;

		out[k] = dv_pick(main[0], x[next], dv_pick(main[1], x[next == 2 ? 0 : next + 1], x[k]));
	}
}

/* Which axis is the largest component's, as ald_ray_prep() has it; size: their sizes. */
V void main_axis(const dv size[3], dm main[3])
{
	dm x_y = dv_gt(size[0], size[1]), all = dv_gt(dv_all(1), dv_all(0));

	main[0] = dm_and(x_y, dv_gt(size[0], size[2]));
	main[1] = dm_less(dv_gt(size[1], size[2]), x_y);
	main[2] = dm_less(all, dm_or(main[0], main[1]));
}

V void lines_set(struct lines *e, unsigned i, const dv x[8], const dv inv[3], const dv shear[2], dv pad, dv last)
{
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		dv_store(e->o[k] + i, x[k]);
		dv_store(e->d[k] + i, x[3 + k]);
		dv_store(e->inv[k] + i, inv[k]);
	}
	dv_store(e->shear[0] + i, shear[0]);
	dv_store(e->shear[1] + i, shear[1]);
	dv_store(e->pad + i, pad);
	dv_store(e->first + i, x[6]);
	dv_store(e->last + i, last);
}

/* Lanes i and on, DW of them. x: origin, direction, tmin, tmax by component; last: nothing behind counts. Where all
 * of them miss the scene's box, as most of a picture's rays may, that is all there is to do. */
V void lot_doubles(const ald_accel *a, struct lot *l, struct lines *e, unsigned i, const dv x[8], dv last)
{
	const double *lo = &a->box.lo.x, *hi = &a->box.hi.x, *middle = &a->frame.centre.x;
	dv t0 = x[6], t1 = last, inv[3], size[3], turned[3], shear[2], far, pad, up, depth, tscale, side;
	dv huge = dv_all(0x1p400);
	dm main[3], fine;
	uint32_t live;

	far = dv_add(dv_add(dv_size(dv_sub(x[0], dv_all(middle[0]))), dv_size(dv_sub(x[1], dv_all(middle[1])))),
		     dv_size(dv_sub(x[2], dv_all(middle[2]))));
	far = dv_add(far, dv_all(a->frame.radius));
	pad = dv_mul(dv_all(16 * ALD_U), far);
	fine = dv_gt(huge, far);
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		dv d = x[3 + k], n, f;
		dm down = dv_sign(d);

		inv[k] = dv_div(dv_all(1), d);
		size[k] = dv_size(d);
		fine = dm_and(fine, dv_gt(huge, size[k]));
		n = dv_sub(dv_pick(down, dv_all(hi[k]), dv_all(lo[k])),
			   dv_pick(down, dv_sub(x[k], pad), dv_add(x[k], pad)));
		f = dv_sub(dv_pick(down, dv_all(lo[k]), dv_all(hi[k])),
			   dv_pick(down, dv_add(x[k], pad), dv_sub(x[k], pad)));
		t0 = dv_max(dv_mul(n, inv[k]), t0);
		t1 = dv_min(dv_mul(f, inv[k]), t1);
		l->sign[k] |= (uint64_t)dm_bits(down) << i;
	}
	live = ~dm_bits(dv_gt(t0, t1)) & ((1u << DW) - 1);
	if (!live)
		return;
	main_axis(size, main);
	UNROLL
	for (unsigned k = 0; k < 3; k++)
		l->main[k] |= (uint64_t)dm_bits(main[k]) << i;
	up = dv_pick(main[0], size[0], dv_pick(main[1], size[1], size[2]));
	fine = dm_and(fine, dv_gt(up, dv_all(0x1p-400)));
	depth = dv_half(up);
	up = dv_mul(dv_power(up), dv_all(2));
	l->live |= (uint64_t)live << i;
	l->odd |= (uint64_t)(~dm_bits(fine) & ((1u << DW) - 1)) << i;
	tscale = dv_mul(up, dv_all(a->scale));
	dv_store(l->shift + i, t0);
	dv_store(l->tscale + i, tscale);
	dv_single(l->first + i, walk_t(x[6], t0, tscale));
	dv_single(l->last + i, walk_t(last, t0, tscale));
	dv_single(l->pad + i,
		  dv_mul(dv_add(dv_mul(pad, dv_all(4)), dv_all(2 * a->prims->pad)), dv_all(a->scale)));
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		dv o = dv_add(dv_sub(x[k], dv_all(a->centre[k])), dv_mul(t0, x[3 + k]));

		dv_single(l->o[k] + i, dv_mul(o, dv_all(a->scale)));
		dv_single(l->inverse[k] + i, dv_mul(inv[k], up));
	}
	along_main(main, x + 3, turned);
	shear[0] = dv_div(turned[0], turned[2]);
	shear[1] = dv_div(turned[1], turned[2]);
	side = dv_pick(dv_sign(turned[2]), dv_all(-1), dv_all(1));
	dv_single(l->shear[0] + i, dv_mul(shear[0], side));
	dv_single(l->shear[1] + i, dv_mul(shear[1], side));
	dv_single(l->depth + i, depth);
	if (e)
		lines_set(e, i, x, inv, shear, pad, last);
}

V void lot_singles(const ald_accel *a, struct lot *l, unsigned i)
{
	f8 pad = f8_load(l->pad + i), last = f8_load(l->last + i);
	f8 error = f8_add(f8_all(BOX_ERROR), pad), most = f8_all(0x1p40f);

	error = a->fast ? f8_all(0) : error;
	f8_store(l->tfar + i, f8_mul_add(last, f8_all(1 + 0x1p-20f), f8_all(0x1p-30f)));
	UNROLL
	for (unsigned k = 0; k < 3; k++) {
		f8 o = f8_load(l->o[k] + i), v = f8_load(l->inverse[k] + i), e;

		/* Over all the way there is, 2^-40 is less than rounding. */
		v = f8_max(f8_min(v, most), f8_negate(most));
		e = f8_signed(error, v);
		f8_store(l->inverse[k] + i, v);
		/* The origin is grown by error against the direction, and along it. */
		f8_store(l->near_o[k] + i, f8_mul(f8_negate(f8_add(o, e)), v));
		f8_store(l->far_o[k] + i, f8_mul(f8_negate(f8_sub(o, e)), v));
	}
}

/* Rays from r on are fetched. */
V void lot_ahead(const struct batch *b, uint32_t r)
{
	const char *ray = (const char *)b->ray, *hit = (const char *)b->hit;

	r = r + DW < b->n ? r : b->n - (b->n < DW ? b->n : DW);
	for (size_t at = 0; at < DW * sizeof(*b->ray); at += 64)
		__builtin_prefetch(ray + r * sizeof(*b->ray) + at);
	for (size_t at = 0; hit && at < DW * sizeof(*b->hit); at += 64)
		__builtin_prefetch(hit + r * sizeof(*b->hit) + at);
}

/* Of the n rays of index[]; e, if there is one, too. */
V void lot_fill_lines(const ald_accel *a, struct lot *l, struct lines *e, const struct batch *b, uint32_t n)
{
	l->live = l->odd = 0;
	UNROLL
	for (unsigned k = 0; k < 3; k++)
		l->sign[k] = l->main[k] = 0;
	for (unsigned i = 0; i < n; i += DW) {
		const double *at[DW];
		double t[DW];
		dv x[8], last;

		if (e || !b->hit)
			lot_ahead(b, l->index[i] + LOT);

		UNROLL
		for (unsigned j = 0; j < DW; j++) {
			uint32_t r = l->index[i + j < n ? i + j : n - 1];

			at[j] = &b->ray[r].org.x;
			t[j] = b->hit ? b->hit[r].t : 0;
		}
		dv_columns(at, x);
		last = b->hit ? dv_load(t) : x[7];
		lot_doubles(a, l, e, i, x, last);
	}
	for (unsigned i = 0; i < n; i += 8) {
		if (l->live >> i & 0xff)
			lot_singles(a, l, i);
	}
	l->live &= n < LOT ? ((uint64_t)1 << n) - 1 : UINT64_MAX;
	l->odd &= l->live;
}

V void lot_fill(const ald_accel *a, struct lot *l, const struct batch *b, uint32_t n)
{
	lot_fill_lines(a, l, NULL, b, n);
}

#endif
