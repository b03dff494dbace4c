/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * alidade/fast.h - the kernels of ALD_PRECISION_FAST: floats, no bounds, no pads.
 *
 * For plugins that trade accuracy for time when they are asked to. The tests are those of alidade/kernel.h with what
 * makes them right left out, so that the two may be compared: a ray near an edge may miss both triangles of it, and
 * what is closer to each other than floats can tell comes in any order. A hit has finite t, u and v all the same.
 * Directions are scaled by a power of two into the reach of floats; t_ is in units of the scaled one.
 */
#ifndef ALIDADE_FAST_H
#define ALIDADE_FAST_H

#include "kernel.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
	float o[3], d[3]; /* d of the size 1 */
	float inv[3]; /* 1/d, infinite where d is 0 */
	float shear[2], depth;
	float dd; /* d.d */
	double per, unit; /* t_ = t per, t = t_ unit: powers of two */
	uint32_t kx, ky, kz, sign[3]; /* as in ald_prep */
} ald_fast_prep;

ALD_INLINE void ald_fast_ray(const ald_ray *r, ald_fast_prep *p)
{
	const double d[3] = { r->dir.x, r->dir.y, r->dir.z };
	double fx = fabs(d[0]), fy = fabs(d[1]), fz = fabs(d[2]);
	uint64_t bits;

	p->kz = fx > fy ? (fx > fz ? 0 : 2) : (fy > fz ? 1 : 2);
	p->kx = p->kz == 2 ? 0 : p->kz + 1;
	p->ky = p->kx == 2 ? 0 : p->kx + 1;
	p->per = fabs(d[p->kz]);
	memcpy(&bits, &p->per, sizeof(bits));
	bits &= 0x7ff0000000000000u; /* the power of two below */
	memcpy(&p->per, &bits, sizeof(bits));
	p->unit = 1 / p->per;
	p->o[0] = (float)r->org.x, p->o[1] = (float)r->org.y, p->o[2] = (float)r->org.z;
	for (unsigned k = 0; k < 3; k++) {
		p->d[k] = (float)(d[k] * p->unit);
		p->inv[k] = 1 / p->d[k];
		p->sign[k] = !!signbit(p->d[k]);
	}
	p->depth = p->inv[p->kz];
	p->shear[0] = p->d[p->kx] * p->depth;
	p->shear[1] = p->d[p->ky] * p->depth;
	p->dd = p->d[0] * p->d[0] + p->d[1] * p->d[1] + p->d[2] * p->d[2];
}

ALD_INLINE float ald_fast_max(float a, float b)
{
	return a > b ? a : b;
}

ALD_INLINE float ald_fast_min(float a, float b)
{
	return a < b ? a : b;
}

/* Does the line enter the box within [tmin, tmax]? If so, *enter is where. All t of the ray. */
ALD_INLINE int ald_fast_box_ray(const ald_fast_prep *p, const ald_box *b, double tmin, double tmax, double *enter)
{
	const double *lo = &b->lo.x, *hi = &b->hi.x;
	float t0 = (float)(tmin * p->per), t1 = (float)(tmax * p->per);

	for (unsigned k = 0; k < 3; k++) {
		float n = (float)(p->sign[k] ? hi[k] : lo[k]) - p->o[k];
		float f = (float)(p->sign[k] ? lo[k] : hi[k]) - p->o[k];

		t0 = ald_fast_max(n * p->inv[k], t0);
		t1 = ald_fast_min(f * p->inv[k], t1);
	}
	*enter = (double)t0 * p->unit;
	return !(t0 > t1);
}

ALD_INLINE int ald_fast_sphere_ray(const ald_fast_prep *p, const ald_vec *centre, double radius, double tmin,
				   double tmax, double *enter)
{
	float fx = p->o[0] - (float)centre->x, fy = p->o[1] - (float)centre->y, fz = p->o[2] - (float)centre->z;
	float tc = -(fx * p->d[0] + fy * p->d[1] + fz * p->d[2]) / p->dd, r = (float)radius;
	float lx = fx + tc * p->d[0], ly = fy + tc * p->d[1], lz = fz + tc * p->d[2];
	float gap = r * r - (lx * lx + ly * ly + lz * lz), half, t0;

	*enter = tmin;
	if (gap < 0)
		return 0;
	half = sqrtf(gap / p->dd);
	t0 = ald_fast_max(tc - half, (float)(tmin * p->per));
	*enter = (double)t0 * p->unit;
	return !(t0 > ald_fast_min(tc + half, (float)(tmax * p->per)));
}

/* Corners of ALD_LANES triangles: [corner][axis][lane]. Fill unused lanes with NaN. */
typedef struct {
	float v[3][3][ALD_LANES];
} ald_fast_triangles;

ALD_INLINE void ald_fast_triangles_set(ald_fast_triangles *s, unsigned lane, const ald_vec v[3])
{
	for (unsigned k = 0; k < 3; k++) {
		s->v[k][0][lane] = (float)v[k].x;
		s->v[k][1][lane] = (float)v[k].y;
		s->v[k][2][lane] = (float)v[k].z;
	}
}

/* One bit a lane: those that the line meets. Give them to ald_fast_triangle(). */
ALD_INLINE uint32_t ald_fast_triangle_n(const ald_fast_prep *p, const ald_fast_triangles *s)
{
	const float *a[3] = { s->v[0][p->kx], s->v[0][p->ky], s->v[0][p->kz] };
	const float *b[3] = { s->v[1][p->kx], s->v[1][p->ky], s->v[1][p->kz] };
	const float *c[3] = { s->v[2][p->kx], s->v[2][p->ky], s->v[2][p->kz] };
	float ox = p->o[p->kx], oy = p->o[p->ky], oz = p->o[p->kz];
	float sx = p->shear[0], sy = p->shear[1];
	int32_t in[ALD_LANES];

	for (unsigned i = 0; i < ALD_LANES; i++) {
		float az = a[2][i] - oz, bz = b[2][i] - oz, cz = c[2][i] - oz;
		float ax = (a[0][i] - ox) - sx * az, ay = (a[1][i] - oy) - sy * az;
		float bx = (b[0][i] - ox) - sx * bz, by = (b[1][i] - oy) - sy * bz;
		float cx = (c[0][i] - ox) - sx * cz, cy = (c[1][i] - oy) - sy * cz;
		float wa = cx * by - cy * bx, wb = ax * cy - ay * cx, wc = bx * ay - by * ax;
		int32_t front = (wa >= 0) & (wb >= 0) & (wc >= 0);
		int32_t back = (wa <= 0) & (wb <= 0) & (wc <= 0);

		in[i] = front | back;
	}
	return ald_lane_bits_single(in);
}

/* Lane i, as ald_triangle(). */
ALD_INLINE int ald_fast_triangle(const ald_fast_prep *p, const ald_ray *r, const ald_fast_triangles *s, unsigned i,
				 uint32_t id, ald_hit *hit)
{
	float x[3], y[3], z[3], wa, wb, wc, det, t_;
	double t;

	for (unsigned k = 0; k < 3; k++) {
		z[k] = s->v[k][p->kz][i] - p->o[p->kz];
		x[k] = (s->v[k][p->kx][i] - p->o[p->kx]) - p->shear[0] * z[k];
		y[k] = (s->v[k][p->ky][i] - p->o[p->ky]) - p->shear[1] * z[k];
	}
	wa = x[2] * y[1] - y[2] * x[1];
	wb = x[0] * y[2] - y[0] * x[2];
	wc = x[1] * y[0] - y[1] * x[0];
	det = (wa + wb) + wc;
	t_ = ((wa * z[0] + wb * z[1]) + wc * z[2]) / det * p->depth;
	t = (double)t_ * p->unit;
	if (!(fabsf(det) > FLT_MIN && fabsf(det) <= FLT_MAX && fabsf(t_) <= FLT_MAX) || !ald_counts(r, t, id, hit))
		return 0;
	hit->t = t;
	hit->u = (double)(wb / det);
	hit->v = (double)(wc / det);
	hit->prim = id;
	hit->part = 0;
	hit->sub[0] = hit->sub[1] = 0;
	return 1;
}

#ifdef __cplusplus
}
#endif
#endif
