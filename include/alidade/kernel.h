/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * alidade/kernel.h - the arithmetic that plugins and host share, so that all accelerators answer alike.
 *
 * Rules R1, R3, R4 and R5 of alidade-accel(3) live here. Compile with -ffp-contract=off and without
 * -ffast-math; then every function gives the same bits in every lane, at every optimisation level, with
 * every compiler. A NaN or an infinity among the inputs is a miss of a primitive, but never makes a
 * volume test reject (R4b).
 *
 * Triangle: Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, JCGT 2(1), 2013, in double, and where
 * that is in doubt Shewchuk: Adaptive Precision Floating-Point Arithmetic, Discrete Comput. Geom. 18, 1997.
 * Slabs: Ize: Robust BVH Ray Traversal, JCGT 2(2), 2013. Sphere: Haines, Guenther, Akenine-Moeller:
 * Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, 2019.
 */
#ifndef ALIDADE_KERNEL_H
#define ALIDADE_KERNEL_H

#include <float.h>
#include <math.h>
#include <string.h>

#include "exact.h"
#include "lanes.h"

#ifdef __cplusplus
extern "C" {
#endif

#define ALD_INF ((double)INFINITY)
#define ALD_NAN ((double)NAN)

/* ---- outward rounding ---- */

/* The next double above or below a finite x. */
ALD_INLINE double ald_up(double x)
{
	uint64_t b;

	if (!(x < ALD_INF)) /* NaN, +Inf */
		return x;
	x += 0.0; /* -0 to 0 */
	memcpy(&b, &x, sizeof(b));
	b = x >= 0 ? b + 1 : b - 1;
	memcpy(&x, &b, sizeof(x));
	return x;
}

ALD_INLINE double ald_down(double x)
{
	return -ald_up(-x);
}

/* The least float >= x, and the greatest <= x; beyond the floats: an infinity or FLT_MAX. */
ALD_INLINE float ald_float_up(double x)
{
	float f = (float)x;
	uint32_t b;

	if (!((double)f < x))
		return f;
	f += 0.0f;
	memcpy(&b, &f, sizeof(b));
	b = f >= 0 ? b + 1 : b - 1;
	memcpy(&f, &b, sizeof(f));
	return f;
}

ALD_INLINE float ald_float_down(double x)
{
	return -ald_float_up(-x);
}

/* ---- small things ---- */

ALD_INLINE double ald_get(const ald_vec *v, unsigned axis)
{
	return axis == 0 ? v->x : axis == 1 ? v->y : v->z;
}

/* Written so that a NaN in a leaves b. */
ALD_INLINE double ald_max(double a, double b)
{
	return a > b ? a : b;
}

ALD_INLINE double ald_min(double a, double b)
{
	return a < b ? a : b;
}

ALD_INLINE void ald_box_join(ald_box *a, const ald_box *b)
{
	a->lo.x = ald_min(b->lo.x, a->lo.x);
	a->lo.y = ald_min(b->lo.y, a->lo.y);
	a->lo.z = ald_min(b->lo.z, a->lo.z);
	a->hi.x = ald_max(b->hi.x, a->hi.x);
	a->hi.y = ald_max(b->hi.y, a->hi.y);
	a->hi.z = ald_max(b->hi.z, a->hi.z);
}

ALD_INLINE ald_box ald_box_empty(void)
{
	ald_box b = { { ALD_INF, ALD_INF, ALD_INF }, { -ALD_INF, -ALD_INF, -ALD_INF } };

	return b;
}

/* Does the ray see primitive id at all? */
ALD_INLINE int ald_sees(const ald_prims *prims, const ald_ray *ray, uint32_t id)
{
	return id != ray->skip && (!prims->mask || (prims->mask[id] & ray->mask));
}

/* The group that id belongs to. */
ALD_INLINE uint32_t ald_group_of(const ald_prims *prims, uint32_t id)
{
	uint32_t lo = 0, hi = prims->group_count;

	while (hi - lo > 1) {
		uint32_t mid = lo + (hi - lo) / 2;

		if (prims->group_first[mid] <= id)
			lo = mid;
		else
			hi = mid;
	}
	return lo;
}

/* The corners of triangle id < tri_count. group: ald_group_of(); looked at only if origin is set. */
ALD_INLINE void ald_corners(const ald_prims *prims, uint32_t id, uint32_t group, ald_vec v[3])
{
	for (unsigned k = 0; k < 3; k++) {
		size_t i = 3 * (size_t)prims->index[3 * (size_t)id + k];

		if (prims->vertex_double) {
			const double *p = (const double *)prims->vertex + i;

			v[k].x = p[0], v[k].y = p[1], v[k].z = p[2];
		} else {
			const float *p = (const float *)prims->vertex + i;

			v[k].x = (double)p[0], v[k].y = (double)p[1], v[k].z = (double)p[2];
		}
		if (prims->origin) {
			v[k].x += prims->origin[group].x;
			v[k].y += prims->origin[group].y;
			v[k].z += prims->origin[group].z;
		}
	}
}

/* ---- a ray made ready, once ---- */

typedef struct { /* a ball around everything: for the pads of far rays */
	ald_vec centre;
	double radius;
	const ald_prims *exact; /* whose order is to be exact, or NULL */
} ald_frame;

ALD_INLINE ald_frame ald_frame_of(const ald_box *all)
{
	ald_frame f;
	double x = all->hi.x - all->lo.x, y = all->hi.y - all->lo.y, z = all->hi.z - all->lo.z;

	f.centre.x = all->lo.x + x / 2;
	f.centre.y = all->lo.y + y / 2;
	f.centre.z = all->lo.z + z / 2;
	f.radius = x + y + z; /* generous: the pad wants an upper bound */
	f.exact = NULL;
	return f;
}

/* The frame for a plugin's rays: with it ald_triangle() serves the precision that the host asked for. */
ALD_INLINE ald_frame ald_frame_for(const ald_prims *prims, const ald_box *all)
{
	ald_frame f = ald_frame_of(all);

	if (prims->precision == ALD_PRECISION_EXACT)
		f.exact = prims;
	return f;
}

typedef struct {
	double o[3], d[3]; /* of the ray */
	double inv[3]; /* 1/d, infinite where d is 0 */
	double near_o[3], far_o[3]; /* origin for near and far planes: pads folded in */
	double shear[2], depth; /* d[kx]/d[kz], d[ky]/d[kz], 1/d[kz] */
	double pad; /* e of R4, in the scene's units */
	double dd; /* d.d */
	uint32_t kx, ky, kz; /* kz: axis of the largest component; the others follow in turn */
	uint32_t sign[3]; /* 1: d goes down, so the near plane is hi */
	const ald_prims *exact; /* the frame's */
} ald_prep;

/* Rays with a NaN or an infinity, a zero direction, or a magnitude beyond 2^+-400 hit no triangle. */
ALD_INLINE void ald_ray_prep(const ald_frame *f, const ald_ray *r, ald_prep *p)
{
	double size, fx, fy, fz, big;

	p->exact = f->exact;
	p->o[0] = r->org.x, p->o[1] = r->org.y, p->o[2] = r->org.z;
	p->d[0] = r->dir.x, p->d[1] = r->dir.y, p->d[2] = r->dir.z;
	fx = fabs(p->d[0]), fy = fabs(p->d[1]), fz = fabs(p->d[2]);
	p->kz = fx > fy ? (fx > fz ? 0 : 2) : (fy > fz ? 1 : 2);
	p->kx = p->kz == 2 ? 0 : p->kz + 1;
	p->ky = p->kx == 2 ? 0 : p->kx + 1;
	size = fabs(p->o[0] - f->centre.x) + fabs(p->o[1] - f->centre.y) +
	       fabs(p->o[2] - f->centre.z) + f->radius;
	p->pad = 16 * ALD_U * size;
	for (unsigned k = 0; k < 3; k++) {
		p->inv[k] = 1 / p->d[k];
		p->sign[k] = !!signbit(p->d[k]);
		p->near_o[k] = p->sign[k] ? p->o[k] - p->pad : p->o[k] + p->pad;
		p->far_o[k] = p->sign[k] ? p->o[k] + p->pad : p->o[k] - p->pad;
	}
	p->depth = p->inv[p->kz];
	p->shear[0] = p->d[p->kx] / p->d[p->kz];
	p->shear[1] = p->d[p->ky] / p->d[p->kz];
	p->dd = p->d[0] * p->d[0] + p->d[1] * p->d[1] + p->d[2] * p->d[2];
	big = fabs(p->d[p->kz]);
	if (!(big > 0x1p-400 && big < 0x1p400 && fx < 0x1p400 && fy < 0x1p400 && fz < 0x1p400 &&
	      size < 0x1p400))
		p->shear[0] = p->shear[1] = ALD_NAN;
}

/* ---- volumes: closed, padded, never rejected by a NaN ---- */

/* Does the line enter the box within [tmin, tmax]? If so, *enter is where (tmin when inside). Cull
 * only if *enter is > the hit's t (R3). */
ALD_INLINE int ald_box_ray(const ald_prep *p, const ald_box *b, double tmin, double tmax,
			   double *enter)
{
	const double *lo = &b->lo.x, *hi = &b->hi.x;
	double t0 = tmin, t1 = tmax;

	for (unsigned k = 0; k < 3; k++) {
		double n = (p->sign[k] ? hi[k] : lo[k]) - p->near_o[k];
		double f = (p->sign[k] ? lo[k] : hi[k]) - p->far_o[k];

		t0 = ald_max(n * p->inv[k], t0);
		t1 = ald_min(f * p->inv[k], t1);
	}
	*enter = t0;
	return !(t0 > t1);
}

/* The same for a ball of this centre and radius (which must hold the padded boxes of its contents). */
ALD_INLINE int ald_sphere_ray(const ald_prep *p, const ald_vec *centre, double radius, double tmin,
			      double tmax, double *enter)
{
	double fx = p->o[0] - centre->x, fy = p->o[1] - centre->y, fz = p->o[2] - centre->z;
	double tc = -(fx * p->d[0] + fy * p->d[1] + fz * p->d[2]) / p->dd;
	double lx = fx + tc * p->d[0], ly = fy + tc * p->d[1], lz = fz + tc * p->d[2];
	double r = (radius + 2 * p->pad) * (1 + 8 * ALD_U);
	double gap = r * r - (lx * lx + ly * ly + lz * lz);
	double half;

	*enter = tmin;
	if (gap < 0)
		return 0;
	half = sqrt(gap / p->dd) * (1 + 8 * ALD_U) + p->pad * sqrt(1 / p->dd);
	*enter = ald_max(tc - half, tmin);
	return !(*enter > ald_min(tc + half, tmax));
}

/* ---- triangles ---- */

/* Where the line meets the plane of a triangle that it is known to meet. From the edges, not from the
 * volume with the origin: numerically far better for secondary rays. Then held within the triangle's
 * own box: slivers have no sound plane, and as all steps are monotone, no box that holds the triangle
 * is ever entered behind t (R3). */
ALD_INLINE double ald_triangle_t(const ald_prep *p, const ald_vec *a, const ald_vec *b,
				 const ald_vec *c)
{
	double ex = b->x - a->x, ey = b->y - a->y, ez = b->z - a->z;
	double gx = c->x - a->x, gy = c->y - a->y, gz = c->z - a->z;
	double nx = ey * gz - ez * gy, ny = ez * gx - ex * gz, nz = ex * gy - ey * gx;
	double up = nx * (a->x - p->o[0]) + ny * (a->y - p->o[1]) + nz * (a->z - p->o[2]);
	double t = up / (nx * p->d[0] + ny * p->d[1] + nz * p->d[2]);
	double t0 = -ALD_INF, t1 = ALD_INF;
	const double *v[3] = { &a->x, &b->x, &c->x };

	for (unsigned k = 0; k < 3; k++) {
		double lo = ald_min(ald_min(v[0][k], v[1][k]), v[2][k]);
		double hi = ald_max(ald_max(v[0][k], v[1][k]), v[2][k]);

		t0 = ald_max(((p->sign[k] ? hi : lo) - p->o[k]) * p->inv[k], t0);
		t1 = ald_min(((p->sign[k] ? lo : hi) - p->o[k]) * p->inv[k], t1);
	}
	t = t < t1 ? t : t1; /* NaN: the plane is no plane */
	return t > t0 ? t : t0;
}

/* ---- signs without rounding, for the few rays that pass an edge closer than rounding can tell ---- */

/* d . ((b - o) x (c - o)), of the exact sign and rounded but for the last bits. d is scaled to 1 first. */
ALD_RARE double ald_exact_volume(const ald_prep *p, const ald_vec *b, const ald_vec *c)
{
	double e[ALD_TERMS], d[3], q[2][3][2], sum = 0;
	uint32_t n = 0;
	int power;

	frexp(p->d[p->kz], &power);
	for (unsigned k = 0; k < 3; k++) {
		d[k] = ldexp(p->d[k], -power);
		for (unsigned j = 0; j < 2; j++) {
			double x = ald_get(j ? c : b, k), y = p->o[k], s = x - y, v = x - s;

			q[j][k][0] = s;
			q[j][k][1] = (x - (s + v)) + (v - y);
		}
	}
	for (unsigned k = 0; k < 3; k++) {
		unsigned i = (k + 1) % 3, j = (k + 2) % 3;

		for (unsigned m = 0; m < 4; m++) {
			ald_expansion_product(e, &n, q[0][i][m & 1], q[1][j][m >> 1], d[k]);
			ald_expansion_product(e, &n, -q[0][j][m & 1], q[1][i][m >> 1], d[k]);
		}
	}
	for (uint32_t i = 0; i < n; i++)
		sum += e[i];
	return sum;
}

/* Does the line surely miss the triangle? Edge by edge with m, the moment of the line about a, which is computed
 * from the exact o - a with products in two parts: with u the roundoff and S_k the size of the products of m_k,
 * m_k is off by less than 2 u |m_k| + 16 u^2 S_k, so each weight by less than 12 u times the sum of its products'
 * sizes and what is left of m's; 0x1p-600 is more than all that underflows. Where sizes in a scene differ much,
 * what its size leaves in doubt is mostly decided here, far more cheaply than without any rounding. */
#ifdef __GNUC__
__attribute__((noinline, cold, unused))
#endif
static int ald_surely_missed(const ald_prep *p, const ald_vec *a, const ald_vec *b, const ald_vec *c)
{
	double hi[3], lo[3], w[3] = { 0, 0, 0 }, off[3] = { 0x1p-600, 0x1p-600, 0x1p-600 };

	for (unsigned k = 0; k < 3; k++) {
		double x = p->o[k], y = ald_get(a, k), s = x - y, v = x - s;

		hi[k] = s;
		lo[k] = (x - (s + v)) + (v - y);
	}
	for (unsigned k = 0; k < 3; k++) {
		unsigned i = k == 2 ? 0 : k + 1, j = i == 2 ? 0 : i + 1;
		double ax = ald_get(a, i), ay = ald_get(a, j), az = ald_get(a, k);
		double ex = ald_get(b, i) - ax, ey = ald_get(b, j) - ay, ez = ald_get(b, k) - az;
		double gx = ald_get(c, i) - ax, gy = ald_get(c, j) - ay, gz = ald_get(c, k) - az;
		double p0, p1, q0 = ald_product(hi[i], p->d[j], &p0), q1 = ald_product(hi[j], p->d[i], &p1);
		double m = (q0 - q1) + ((p0 - p1) + (lo[i] * p->d[j] - lo[j] * p->d[i]));
		double s = q0 - q1, v = q0 - s, fine = 32 * ALD_U * ALD_U * (fabs(q0) + fabs(q1));
		double across = ald_get(c, k) - ald_get(b, k);

		m += (q0 - (s + v)) + (v - q1);
		w[0] += p->d[k] * (ex * gy - ey * gx) + m * across;
		w[1] -= m * gz;
		w[2] += m * ez;
		off[0] += 16 * ALD_U * (fabs(p->d[k]) * (fabs(ex * gy) + fabs(ey * gx)) + fabs(m * across)) +
			  fine * fabs(across);
		off[1] += 16 * ALD_U * fabs(m * gz) + fine * fabs(gz);
		off[2] += 16 * ALD_U * fabs(m * ez) + fine * fabs(ez);
	}
	return (w[0] > off[0] || w[1] > off[1] || w[2] > off[2]) &&
	       (w[0] < -off[0] || w[1] < -off[1] || w[2] < -off[2]);
}

/* The weights of a, b and c by their exact signs; 0: the line misses. */
ALD_INLINE int ald_exact_weights(const ald_prep *p, const ald_vec *a, const ald_vec *b, const ald_vec *c,
				 double w[3])
{
	if (ald_surely_missed(p, a, b, c))
		return 0;
	w[0] = ald_exact_volume(p, b, c);
	w[1] = ald_exact_volume(p, c, a);
	w[2] = ald_exact_volume(p, a, b);
	if (!(w[0] >= 0 && w[1] >= 0 && w[2] >= 0) && !(w[0] <= 0 && w[1] <= 0 && w[2] <= 0))
		return 0;
	return w[0] != 0 || w[1] != 0 || w[2] != 0;
}

/* R1: does the line of the ray meet the closed triangle? The weights of its corners and their sum if so.
 * Exact: what rounding leaves open is decided without it, so that lines through edges and corners meet all
 * triangles there, and a line in the plane of a triangle misses it.
 *
 * The bound: with u the roundoff and M = p->pad / 16 u, which is more than any coordinate relative to the
 * origin, the sheared ones (of slopes up to 1) are off by at most 6 u M, and so a weight, a sum of two
 * products of two of them, by less than 16 u M times the sum of the six. */
ALD_INLINE int ald_triangle_weights(const ald_prep *p, const ald_vec *a, const ald_vec *b, const ald_vec *c,
				    double w[3], double *sum)
{
	double az = ald_get(a, p->kz) - p->o[p->kz];
	double bz = ald_get(b, p->kz) - p->o[p->kz];
	double cz = ald_get(c, p->kz) - p->o[p->kz];
	double ax = (ald_get(a, p->kx) - p->o[p->kx]) - p->shear[0] * az;
	double ay = (ald_get(a, p->ky) - p->o[p->ky]) - p->shear[1] * az;
	double bx = (ald_get(b, p->kx) - p->o[p->kx]) - p->shear[0] * bz;
	double by = (ald_get(b, p->ky) - p->o[p->ky]) - p->shear[1] * bz;
	double cx = (ald_get(c, p->kx) - p->o[p->kx]) - p->shear[0] * cz;
	double cy = (ald_get(c, p->ky) - p->o[p->ky]) - p->shear[1] * cz;
	double e = p->pad * (((fabs(ax) + fabs(ay)) + (fabs(bx) + fabs(by))) + (fabs(cx) + fabs(cy)));

	w[0] = cx * by - cy * bx;
	w[1] = ax * cy - ay * cx;
	w[2] = bx * ay - by * ax;
	if (!(w[0] >= -e && w[1] >= -e && w[2] >= -e) && !(w[0] <= e && w[1] <= e && w[2] <= e))
		return 0;
	if (!(w[0] > e && w[1] > e && w[2] > e) && !(w[0] < -e && w[1] < -e && w[2] < -e) &&
	    !(e <= DBL_MAX && ald_exact_weights(p, a, b, c, w)))
		return 0;
	*sum = w[0] + w[1] + w[2];
	return *sum != 0 && fabs(*sum) <= DBL_MAX;
}

/* The same, and where: *t, *u, *v (weights of b and c). */
ALD_INLINE int ald_triangle_line(const ald_prep *p, const ald_vec *a, const ald_vec *b,
				 const ald_vec *c, double *t, double *u, double *v)
{
	double w[3], det;

	if (!ald_triangle_weights(p, a, b, c, w, &det))
		return 0;
	*t = ald_triangle_t(p, a, b, c);
	*u = w[1] / det;
	*v = w[2] / det;
	return 1;
}

/* Does (t, id) count for this ray: behind (tmin, after), and a better hit than *hit? Masks and skip are
 * ald_sees()'s. */
ALD_INLINE int ald_counts(const ald_ray *r, double t, uint32_t id, const ald_hit *hit)
{
	if (!(t > r->tmin || (t == r->tmin && id > r->after && r->after != ALD_NONE)))
		return 0;
	return ald_wins(t, id, hit);
}

/* ---- the exact order (ALD_PRECISION_EXACT): t is a fraction, and compared as one ---- */

/* While a ray is under way, *hit of a triangle holds bounds on its t: u <= t, and hit->t >= it, so that volumes
 * are culled late (R3). The host rounds t and computes u and v of the winner. */

/* The bounds, from the triangle's plane: with u the roundoff, the normal's components, differences of two
 * products of two differences, are off by less than 5 u N, N the sum of the products' sizes; so n . (a - o) by
 * less than 9 u U and n . d by less than 8 u W, where U and W are the sums of N |a - o| and N |d|. And from its
 * box, whose distances take three roundings. */
ALD_INLINE void ald_triangle_span(const ald_prep *p, const ald_vec v[3], double *lo, double *hi)
{
	const double *a = &v[0].x, *b = &v[1].x, *c = &v[2].x;
	double up = 0, across = 0, of_up = 0, of_across = 0, t0 = -ALD_INF, t1 = ALD_INF, t, off;

	for (unsigned k = 0; k < 3; k++) {
		unsigned i = k == 2 ? 0 : k + 1, j = i == 2 ? 0 : i + 1;
		double x = (b[i] - a[i]) * (c[j] - a[j]), y = (b[j] - a[j]) * (c[i] - a[i]);
		double n = x - y, size = fabs(x) + fabs(y), q = a[k] - p->o[k];
		double low = ald_min(ald_min(a[k], b[k]), c[k]), high = ald_max(ald_max(a[k], b[k]), c[k]);

		up += n * q;
		across += n * p->d[k];
		of_up += size * fabs(q);
		of_across += size * fabs(p->d[k]);
		t0 = ald_max(((p->sign[k] ? high : low) - p->o[k]) * p->inv[k], t0);
		t1 = ald_min(((p->sign[k] ? low : high) - p->o[k]) * p->inv[k], t1);
	}
	*lo = t0 - (8 * ALD_U * fabs(t0) + DBL_MIN);
	*hi = t1 + (8 * ALD_U * fabs(t1) + DBL_MIN);
	if (!(fabs(across) > 32 * ALD_U * of_across && of_across > 0x1p-900 && of_up > 0x1p-900))
		return;
	t = up / across;
	off = 16 * ALD_U * (of_up + of_across * fabs(t)) / (fabs(across) - 16 * ALD_U * of_across);
	off += 4 * ALD_U * fabs(t) + DBL_MIN;
	*lo = ald_max(t - off, *lo);
	*hi = ald_min(t + off, *hi);
}

/* The sign of the t of v less that of triangle id. */
ALD_RARE int ald_exact_order(const ald_prep *p, const ald_vec v[3], uint32_t id)
{
	ald_ratio x, y;
	ald_vec w[3];

	ald_corners(p->exact, id, p->exact->origin ? ald_group_of(p->exact, id) : 0, w);
	if (ald_same_plane(v, w))
		return 0;
	ald_ratio_of(p->o, p->d, v, &x);
	ald_ratio_of(p->o, p->d, w, &y);
	return ald_ratio_compare(&x, &y);
}

/* The sign of the t of v less a number. */
ALD_RARE int ald_exact_against(const ald_prep *p, const ald_vec v[3], double t)
{
	ald_ratio x;

	ald_ratio_of(p->o, p->d, v, &x);
	return ald_ratio_against(&x, t, t);
}

/* ald_triangle() of a triangle that the line meets. */
ALD_APART int ald_exact_triangle(const ald_prep *p, const ald_ray *r, const ald_vec v[3], uint32_t id,
				 ald_hit *hit)
{
	uint32_t tris = p->exact->tri_count;
	double lo, hi;
	int sign;

	if (id == hit->prim || id == r->after)
		return 0;
	ald_triangle_span(p, v, &lo, &hi);
	if (lo > hit->t || hi < r->tmin)
		return 0;
	if (!(lo > (r->after == ALD_NONE ? r->tmin : ald_up(r->tmin)))) {
		sign = r->after < tris ? ald_exact_order(p, v, r->after) : ald_exact_against(p, v, r->tmin);
		if (sign < 0 || (sign == 0 && (r->after == ALD_NONE || id < r->after)))
			return 0;
	}
	if (!(hi < (hit->prim < tris ? hit->u : hit->t))) {
		sign = hit->prim < tris ? ald_exact_order(p, v, hit->prim) : ald_exact_against(p, v, hit->t);
		if (sign > 0 || (sign == 0 && id > hit->prim))
			return 0;
	}
	hit->t = hi;
	hit->u = lo;
	hit->v = 0;
	hit->prim = id;
	hit->part = 0;
	hit->sub[0] = hit->sub[1] = 0;
	return 1;
}

/* The whole of prims->intersect() for a triangle with these corners, ald_sees() apart. */
ALD_INLINE int ald_triangle(const ald_prep *p, const ald_ray *r, const ald_vec v[3], uint32_t id,
			    ald_hit *hit)
{
	double w[3], det, t;

	if (!ald_triangle_weights(p, &v[0], &v[1], &v[2], w, &det))
		return 0;
	if (p->exact)
		return ald_exact_triangle(p, r, v, id, hit);
	t = ald_triangle_t(p, &v[0], &v[1], &v[2]);
	if (!ald_counts(r, t, id, hit))
		return 0;
	hit->t = t;
	hit->u = w[1] / det;
	hit->v = w[2] / det;
	hit->prim = id;
	hit->part = 0;
	hit->sub[0] = hit->sub[1] = 0;
	return 1;
}

/* For the host: t, u and v of the triangle that has won, whose corners are v. fused: see ald_product_by(). */
ALD_INLINE void ald_exact_settle(const ald_prep *p, const ald_vec v[3], ald_hit *hit, int fused)
{
	double w[3], det;

	if (!ald_triangle_weights(p, &v[0], &v[1], &v[2], w, &det))
		return;
	hit->t = ald_exact_t(p->o, p->d, v, fused);
	hit->u = w[1] / det;
	hit->v = w[2] / det;
}

/* Corners of ALD_LANES triangles, by axis: [corner][axis][lane]. Fill unused lanes with NaN. */
typedef struct {
	double v[3][3][ALD_LANES];
} ald_triangles;

ALD_INLINE void ald_triangles_set(ald_triangles *s, unsigned lane, const ald_vec v[3])
{
	for (unsigned k = 0; k < 3; k++) {
		s->v[k][0][lane] = v[k].x;
		s->v[k][1][lane] = v[k].y;
		s->v[k][2][lane] = v[k].z;
	}
}

/* The bound of ald_triangle_line() for any triangle: none of the six is more than 2 M. */
ALD_INLINE double ald_slack(const ald_prep *p)
{
	return p->pad * p->pad * (0.75 / ALD_U);
}

/* One bit a lane: the lanes that ald_triangle_line() would not reject, and a few more. Give them to
 * ald_triangle(). Plain loops over lanes: compile the caller with -O3 and, by target_clones, for wider
 * instruction sets, and they become that wide. */
ALD_INLINE uint32_t ald_triangle_n(const ald_prep *p, const ald_triangles *s)
{
	const double *a[3] = { s->v[0][p->kx], s->v[0][p->ky], s->v[0][p->kz] };
	const double *b[3] = { s->v[1][p->kx], s->v[1][p->ky], s->v[1][p->kz] };
	const double *c[3] = { s->v[2][p->kx], s->v[2][p->ky], s->v[2][p->kz] };
	double ox = p->o[p->kx], oy = p->o[p->ky], oz = p->o[p->kz];
	double sx = p->shear[0], sy = p->shear[1], e = ald_slack(p);
	int64_t in[ALD_LANES];

	for (unsigned i = 0; i < ALD_LANES; i++) {
		double az = a[2][i] - oz, bz = b[2][i] - oz, cz = c[2][i] - oz;
		double ax = (a[0][i] - ox) - sx * az, ay = (a[1][i] - oy) - sy * az;
		double bx = (b[0][i] - ox) - sx * bz, by = (b[1][i] - oy) - sy * bz;
		double cx = (c[0][i] - ox) - sx * cz, cy = (c[1][i] - oy) - sy * cz;
		double wa = cx * by - cy * bx, wb = ax * cy - ay * cx, wc = bx * ay - by * ax;
		int64_t front = (wa >= -e) & (wb >= -e) & (wc >= -e);
		int64_t back = (wa <= e) & (wb <= e) & (wc <= e);

		in[i] = front | back;
	}
	return ald_lane_bits(in);
}

/* ALD_LANES rays of one kz. Lanes not set are NaN and miss. */
typedef struct {
	double o[3][ALD_LANES]; /* along kx, ky, kz */
	double shear[2][ALD_LANES];
	double slack[ALD_LANES];
	uint32_t kx, ky, kz;
} ald_rays;

ALD_INLINE void ald_rays_clear(ald_rays *s, uint32_t kz)
{
	s->kz = kz;
	s->kx = kz == 2 ? 0 : kz + 1;
	s->ky = s->kx == 2 ? 0 : s->kx + 1;
	for (unsigned i = 0; i < ALD_LANES; i++) {
		s->o[0][i] = s->o[1][i] = s->o[2][i] = 0;
		s->shear[0][i] = s->shear[1][i] = ALD_NAN;
		s->slack[i] = 0;
	}
}

/* p->kz must be s->kz. */
ALD_INLINE void ald_rays_set(ald_rays *s, unsigned lane, const ald_prep *p)
{
	s->o[0][lane] = p->o[p->kx];
	s->o[1][lane] = p->o[p->ky];
	s->o[2][lane] = p->o[p->kz];
	s->shear[0][lane] = p->shear[0];
	s->shear[1][lane] = p->shear[1];
	s->slack[lane] = ald_slack(p);
}

/* The mirror image of ald_triangle_n(): many rays, one triangle. */
ALD_INLINE uint32_t ald_rays_triangle(const ald_rays *s, const ald_vec v[3])
{
	double a0 = ald_get(&v[0], s->kx), a1 = ald_get(&v[0], s->ky), a2 = ald_get(&v[0], s->kz);
	double b0 = ald_get(&v[1], s->kx), b1 = ald_get(&v[1], s->ky), b2 = ald_get(&v[1], s->kz);
	double c0 = ald_get(&v[2], s->kx), c1 = ald_get(&v[2], s->ky), c2 = ald_get(&v[2], s->kz);
	int64_t in[ALD_LANES];

	for (unsigned i = 0; i < ALD_LANES; i++) {
		double ox = s->o[0][i], oy = s->o[1][i], oz = s->o[2][i];
		double sx = s->shear[0][i], sy = s->shear[1][i];
		double az = a2 - oz, bz = b2 - oz, cz = c2 - oz;
		double ax = (a0 - ox) - sx * az, ay = (a1 - oy) - sy * az;
		double bx = (b0 - ox) - sx * bz, by = (b1 - oy) - sy * bz;
		double cx = (c0 - ox) - sx * cz, cy = (c1 - oy) - sy * cz;
		double wa = cx * by - cy * bx, wb = ax * cy - ay * cx, wc = bx * ay - by * ax;
		double e = s->slack[i];
		int64_t front = (wa >= -e) & (wb >= -e) & (wc >= -e);
		int64_t back = (wa <= e) & (wb <= e) & (wc <= e);

		in[i] = front | back;
	}
	return ald_lane_bits(in);
}

#ifdef __cplusplus
}
#endif

#include "overlap.h"

#endif
