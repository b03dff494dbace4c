/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Exact order's last step: of each ray that has hit a triangle, t rounded correctly, u and v. Eight rays at a time,
 * in pairs of doubles; the few that this leaves open are settled one by one (exact.h). The bits
 * are those of ald_exact_settle(), which a test compares.
 */
#include <string.h>

#include "accel/geometry.h"
#include "base/wide.h"

struct lanes { /* axes: kx, ky, kz of each ray */
	double o[3][LANES], d[3][LANES], v[3][3][LANES]; /* v: corner, axis */
	double pad[LANES];
	double t[LANES], u[LANES], w[LANES]; /* w: the weight v */
	int64_t sure[LANES];
	uint32_t at[LANES]; /* the hit's index */
};

/* ald_triangle_weights() and ald_try_t(); 0: left open. */
LANED int settle_lane(const double o[3], const double d[3], const double a[3], const double b[3], const double c[3],
		      double pad, double out[3], int fused)
{
	double sx = d[0] / d[2], sy = d[1] / d[2];
	double az = a[2] - o[2], bz = b[2] - o[2], cz = c[2] - o[2];
	double ax = (a[0] - o[0]) - sx * az, ay = (a[1] - o[1]) - sy * az;
	double bx = (b[0] - o[0]) - sx * bz, by = (b[1] - o[1]) - sy * bz;
	double cx = (c[0] - o[0]) - sx * cz, cy = (c[1] - o[1]) - sy * cz;
	double e = pad * (((fabs(ax) + fabs(ay)) + (fabs(bx) + fabs(by))) + (fabs(cx) + fabs(cy)));
	double wa = cx * by - cy * bx, wb = ax * cy - ay * cx, wc = bx * ay - by * ax, sum = wa + wb + wc;
	int front = (wa > e) & (wb > e) & (wc > e), back = (wa < -e) & (wb < -e) & (wc < -e);

	out[1] = wb / sum;
	out[2] = wc / sum;
	return ald_try_t(o, d, a, b, c, fused, &out[0]) & (front | back) & (fabs(sum) <= DBL_MAX);
}

LANED int settle_at(struct lanes *s, unsigned i, int fused)
{
	double o[3] = { s->o[0][i], s->o[1][i], s->o[2][i] };
	double d[3] = { s->d[0][i], s->d[1][i], s->d[2][i] };
	double a[3] = { s->v[0][0][i], s->v[0][1][i], s->v[0][2][i] };
	double b[3] = { s->v[1][0][i], s->v[1][1][i], s->v[1][2][i] };
	double c[3] = { s->v[2][0][i], s->v[2][1][i], s->v[2][2][i] };
	double out[3];
	int sure = settle_lane(o, d, a, b, c, s->pad[i], out, fused);

	s->t[i] = out[0];
	s->u[i] = out[1];
	s->w[i] = out[2];
	return sure;
}

LANED void settle_lanes(struct lanes *s, int fused)
{
	for (unsigned i = 0; i < LANES; i++)
		s->sure[i] = settle_at(s, i, fused);
}

static void all_plain(struct lanes *s)
{
	settle_lanes(s, 0);
}

static void one_plain(struct lanes *s)
{
	s->sure[0] = settle_at(s, 0, 0);
}

/* Products without rounding take one instruction more than others where there is an fma, else seventeen. */
#if defined __x86_64__ && defined __GNUC__
__attribute__((target("avx512f,avx512dq,avx512vl,fma"))) static void all_avx512(struct lanes *s)
{
	settle_lanes(s, 1);
}

__attribute__((target("avx2,fma"))) static void all_avx2(struct lanes *s)
{
	settle_lanes(s, 1);
}

__attribute__((target("avx2,fma"))) static void one_avx2(struct lanes *s)
{
	s->sure[0] = settle_at(s, 0, 1);
}
#endif

static void settle_one(struct lanes *s)
{
#if defined __x86_64__ && defined __GNUC__
	if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
		one_avx2(s);
		return;
	}
#endif
	one_plain(s);
}

static void settle_all(struct lanes *s)
{
#if defined __x86_64__ && defined __GNUC__
	if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
		all_avx512(s);
		return;
	}
	if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
		all_avx2(s);
		return;
	}
#endif
	all_plain(s);
}

/* kx, ky, kz and the pad as ald_ray_prep() has them, to the bit. */
static void lanes_set(struct lanes *s, unsigned i, const struct view *v, const ald_ray *r, uint32_t id)
{
	const ald_frame *f = &v->frame;
	double x = fabs(r->dir.x), y = fabs(r->dir.y), z = fabs(r->dir.z);
	unsigned kz = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2), k = kz;
	vec c[3];

	prim_triangle(v->level, id, c);
	s->pad[i] = 16 * ALD_U * (fabs(r->org.x - f->centre.x) + fabs(r->org.y - f->centre.y) +
				  fabs(r->org.z - f->centre.z) + f->radius);
	for (unsigned n = 0; n < 3; n++) {
		k = k == 2 ? 0 : k + 1;
		s->o[n][i] = (&r->org.x)[k];
		s->d[n][i] = (&r->dir.x)[k];
		for (unsigned corner = 0; corner < 3; corner++)
			s->v[corner][n][i] = (&c[corner].x)[k];
	}
}

static void lanes_get(const struct lanes *s, unsigned i, const struct view *v, const ald_ray *r,
		      ald_hit *hit)
{
	ald_prep prep;
	vec c[3];

	if (s->sure[i]) {
		hit->t = s->t[i];
		hit->u = s->u[i];
		hit->v = s->w[i];
		return;
	}
	ald_ray_prep(&v->frame, r, &prep);
	prim_triangle(v->level, hit->prim, c);
	ald_exact_settle(&prep, c, hit, 0);
}

void view_settle(const struct view *v, const ald_ray *r, ald_hit *hit)
{
	struct lanes s;

	if (v->prims.precision != ALD_PRECISION_EXACT || hit->prim >= v->prims.tri_count)
		return;
	lanes_set(&s, 0, v, r, hit->prim);
	settle_one(&s);
	lanes_get(&s, 0, v, r, hit);
}

void view_settle_n(const struct view *v, const ald_ray *r, ald_hit *hit, uint32_t n)
{
	struct lanes s;
	unsigned taken = 0;

	if (v->prims.precision != ALD_PRECISION_EXACT)
		return;
	memset(&s, 0, sizeof(s)); /* lanes that nobody takes */
	for (uint32_t i = 0; i < n || taken; i++) {
		if (i < n && hit[i].prim < v->prims.tri_count) {
			lanes_set(&s, taken, v, &r[i], hit[i].prim);
			s.at[taken++] = i;
		}
		if (!taken || (taken < LANES && i + 1 < n))
			continue;
		settle_all(&s);
		for (unsigned k = 0; k < taken; k++)
			lanes_get(&s, k, v, &r[s.at[k]], &hit[s.at[k]]);
		taken = 0;
	}
}
