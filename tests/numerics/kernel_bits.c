/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Prints a hash of what alidade/kernel.h computes for ordinary and hostile input (rule R5): any compiler at
 * any level of optimisation must print the same. Uses nothing else of ours, and no libm.
 */
#include <inttypes.h>
#include <stdio.h>

#include "alidade/kernel.h"

static uint64_t seed = 88172645463325252u, hash = 14695981039346656037u;

static uint64_t bits(void)
{
	seed ^= seed >> 12;
	seed ^= seed << 25;
	seed ^= seed >> 27;
	return seed * 2685821657736338717u;
}

static double from_bits(uint64_t b)
{
	double x;

	memcpy(&x, &b, sizeof(x));
	return x;
}

/* Mostly ordinary; sometimes whole, zero, tiny, huge, infinite or not a number. */
static double number(unsigned hostile)
{
	static const uint64_t odd[] = { 0, 0x8000000000000000u, 1, 0x7ff0000000000000u,
					0xfff0000000000000u, 0x7ff8000000000000u, 0x3ff0000000000000u,
					0xbff0000000000000u };
	uint64_t b = bits();

	if (hostile && b % 8 < hostile) {
		b = bits();
		return b % 4 ? odd[b / 4 % 8] : from_bits(bits());
	}
	if (b % 16 == 9)
		return (double)(int)(bits() % 5) - 2;
	return (double)(int64_t)(bits() >> 10) * 0x1p-53 - 1;
}

static ald_vec point(unsigned hostile)
{
	ald_vec v;

	v.x = number(hostile);
	v.y = number(hostile);
	v.z = number(hostile);
	return v;
}

static void add(double x)
{
	uint64_t b;

	if (x != x)
		x = 0; /* which NaN it is, is nobody's business */
	memcpy(&b, &x, sizeof(b));
	hash = (hash ^ b) * 1099511628211u;
	hash ^= hash >> 29;
}

static void add_exact(const ald_ray *r, const ald_vec v[3], const ald_vec w[3])
{
	const double o[3] = { r->org.x, r->org.y, r->org.z }, d[3] = { r->dir.x, r->dir.y, r->dir.z };
	ald_ratio x, y;

	for (unsigned k = 0; k < 3; k++) {
		if (!(fabs(o[k]) < 8 && fabs(d[k]) < 8))
			return;
		for (unsigned j = 0; j < 3; j++) {
			if (!(fabs(ald_get(&v[j], k)) < 8 && fabs(ald_get(&w[j], k)) < 8))
				return;
		}
	}
	ald_ratio_of(o, d, v, &x);
	ald_ratio_of(o, d, w, &y);
	if (!x.dens || !y.dens)
		return;
	add(ald_ratio_compare(&x, &y));
	add(ald_exact_t(o, d, v, 0));
}

static void round_once(unsigned hostile)
{
	ald_frame f = { { 0.125, -0.25, 0.5 }, 3, NULL };
	ald_triangles many;
	ald_vec v[ALD_LANES][3];
	ald_ray r[ALD_LANES];
	ald_prep p[ALD_LANES];
	ald_rays rays;
	ald_hit h = { .t = ALD_INF, .prim = ALD_NONE };

	for (unsigned i = 0; i < ALD_LANES; i++) {
		r[i] = (ald_ray){ .org = point(hostile), .dir = point(hostile), .tmin = 0,
				  .tmax = ALD_INF, .mask = 1, .skip = ALD_NONE, .after = ALD_NONE };
		for (unsigned k = 0; k < 3; k++)
			v[i][k] = point(hostile);
		if (bits() % 4 == 0)
			r[i].dir = v[i][0];
		ald_ray_prep(&f, &r[i], &p[i]);
		ald_triangles_set(&many, i, v[i]);
		add(p[i].shear[0]);
		add(p[i].inv[1]);
		add(p[i].near_o[2]);
	}
	add(ald_triangle_n(&p[0], &many));
	for (unsigned i = 1; i < ALD_LANES; i++)
		add_exact(&r[0], v[i - 1], v[i]);
	ald_rays_clear(&rays, p[0].kz);
	for (unsigned i = 0; i < ALD_LANES; i++) {
		if (p[i].kz == p[0].kz)
			ald_rays_set(&rays, i, &p[i]);
	}
	add(ald_rays_triangle(&rays, v[0]));
	for (unsigned i = 0; i < ALD_LANES; i++) {
		ald_box b = { v[i][0], v[i][1] };
		double enter = 0;

		add(ald_triangle(&p[0], &r[0], v[i], i, &h));
		add(h.t);
		add(h.u);
		add(h.v);
		h.t = ALD_INF;
		h.prim = ALD_NONE;
		add(ald_box_ray(&p[0], &b, -1, 4, &enter));
		add(enter);
		add(ald_sphere_ray(&p[0], &b.lo, fabs(b.hi.x), -1, 4, &enter));
		add(enter);
		add(ald_triangle_box(v[i], &b));
		add(ald_up(b.lo.x));
		add(ald_down(b.lo.y));
		add((double)ald_float_up(b.lo.z));
		add((double)ald_float_down(b.hi.z));
	}
}

int main(void)
{
	for (unsigned i = 0; i < 40000; i++)
		round_once(i % 4);
	printf("%016" PRIx64 "\n", hash);
	return 0;
}
