/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Making what flat_walk.h goes through: triangles in groups of sixteen, and volumes around ranges.
 */
#include "flat.h"

#define GROUPS_A_JOB 1024u

static void *take(struct flat *f, uint64_t n, size_t each, const char *what)
{
	void *p = n < SIZE_MAX / each ? f->host->alloc(f->host->ctx, (size_t)(n + 1) * each, what) : NULL;

	f->bytes += n * each;
	return p;
}

void flat_release(struct flat *f)
{
	f->host->free(f->host->ctx, f->group);
	f->host->free(f->host->ctx, f->fast);
	f->host->free(f->host->ctx, f->range);
	f->host->free(f->host->ctx, f->ball);
	f->host->free(f->host->ctx, f->volume);
	f->host->free(f->host->ctx, f->tight);
}

/* ---- volumes ---- */

static void box_around(const ald_prims *p, uint32_t first, uint32_t end, ald_box *out)
{
	ald_box box;

	*out = ald_box_empty();
	for (uint32_t i = first; i < end; i++) {
		p->bounds(p, i, &box);
		ald_box_join(out, &box);
	}
}

/* Grow the ball so that it holds the point, and what rounding may move it by. */
static void ball_hold(struct ball *b, const ald_vec *p, double pad)
{
	double x = p->x - b->centre.x, y = p->y - b->centre.y, z = p->z - b->centre.z;

	b->radius = ald_max(sqrt(x * x + y * y + z * z) * (1 + 8 * ALD_U) + pad, b->radius);
}

static void ball_around(const struct flat *f, uint32_t g, struct ball *b)
{
	const ald_prims *p = f->prims;
	const struct range *r = &f->range[g];
	ald_vec v[8];
	ald_box box;

	box_around(p, r->first, r->end, &box);
	b->centre.x = box.lo.x + (box.hi.x - box.lo.x) / 2;
	b->centre.y = box.lo.y + (box.hi.y - box.lo.y) / 2;
	b->centre.z = box.lo.z + (box.hi.z - box.lo.z) / 2;
	b->radius = 0;
	for (uint32_t i = r->first; i < r->tris; i++) {
		ald_corners(p, i, g, v);
		for (unsigned k = 0; k < 3; k++)
			ball_hold(b, &v[k], 2 * p->pad);
	}
	for (uint32_t i = r->tris; i < r->end; i++) {
		p->bounds(p, i, &box);
		for (unsigned k = 0; k < 8; k++) {
			v[k].x = k & 1 ? box.hi.x : box.lo.x;
			v[k].y = k & 2 ? box.hi.y : box.lo.y;
			v[k].z = k & 4 ? box.hi.z : box.lo.z;
			ball_hold(b, &v[k], 0);
		}
	}
}

/* In floats: the centre is off by 2^-25, which the half sizes and then LINE_ERROR, for its m, hold. */
static void tighten(struct flat *f, uint32_t g)
{
	const ald_box *box = &f->volume[g];

	for (unsigned k = 0; k < 3; k++) {
		double lo = f->kind == FLAT_BALL ? 0 : (&box->lo.x)[k], hi = f->kind == FLAT_BALL ? 0 : (&box->hi.x)[k];
		double half = f->kind == FLAT_BALL ? f->ball[g].radius : (hi - lo) / 2;
		double at = f->kind == FLAT_BALL ? ald_get(&f->ball[g].centre, k) : lo + (hi - lo) / 2;

		f->tight[g][k] = (float)((at - f->space.centre[k]) * f->space.scale);
		f->tight[g][3 + k] = ald_float_up(half * f->space.scale * (1 + 0x1p-20));
	}
}

static int add_volumes(struct flat *f)
{
	if (f->kind == FLAT_BALL)
		f->ball = take(f, f->ranges, sizeof(*f->ball), "volumes");
	else
		f->volume = take(f, f->ranges, sizeof(*f->volume), "volumes");
	f->tight = take(f, f->ranges, sizeof(*f->tight), "volumes");
	if ((!f->ball && !f->volume) || !f->tight)
		return ALD_NO_MEMORY;
	for (uint32_t g = 0; g < f->ranges; g++) {
		if (f->kind == FLAT_BALL)
			ball_around(f, g, &f->ball[g]);
		else
			box_around(f->prims, f->range[g].first, f->range[g].end, &f->volume[g]);
		tighten(f, g);
	}
	return ALD_OK;
}

/* ---- triangles ---- */

static uint32_t groups_in(const struct range *r)
{
	return (r->tris - r->first + GROUP - 1) / GROUP;
}

/* Group at, of a range; owner: its number among the contract's, or ALD_NONE. */
static void fill_group(struct flat *f, const struct range *r, uint32_t at, uint32_t owner)
{
	struct group *g = &f->group[r->group + at];

	for (unsigned k = 0; k < GROUP; k++) {
		uint32_t id = r->first + at * GROUP + k, last = r->tris - 1;
		ald_vec v[3];

		id = id < last ? id : last;
		if (f->prims->origin && owner == ALD_NONE)
			ald_corners(f->prims, id, ald_group_of(f->prims, id), v);
		else
			ald_corners(f->prims, id, owner, v);
		group_set(&f->space, g, k, v);
		if (f->fast)
			ald_fast_triangles_set(&f->fast[2 * (r->group + at) + k / ALD_LANES], k % ALD_LANES, v);
	}
}

static void fill_job(void *arg, uint32_t job)
{
	struct flat *f = arg;
	uint32_t from = job * GROUPS_A_JOB, to = from + GROUPS_A_JOB;

	for (uint32_t i = 0; i < f->ranges; i++) {
		const struct range *r = &f->range[i];
		uint32_t n = groups_in(r);
		uint32_t at = r->group < from ? from - r->group : 0;

		for (; at < n && r->group + at < to; at++)
			fill_group(f, r, at, f->kind == FLAT_NONE ? ALD_NONE : i);
	}
}

static uint32_t ranges_of(const ald_prims *p, enum flat_kind kind)
{
	return kind == FLAT_NONE ? 1 : p->group_count;
}

/* Range i, which begins with this group. */
static struct range range_at(const ald_prims *p, enum flat_kind kind, uint32_t i, uint32_t group)
{
	uint32_t first = kind == FLAT_NONE ? 0 : p->group_first[i];
	uint32_t end = kind == FLAT_NONE ? p->count : p->group_first[i + 1];
	uint32_t tris = end < p->tri_count ? end : p->tri_count;

	return (struct range){ first, tris < first ? first : tris, end, group };
}

static uint32_t cut_ranges(struct flat *f)
{
	uint32_t groups = 0;

	for (uint32_t i = 0; i < f->ranges; i++) {
		f->range[i] = range_at(f->prims, f->kind, i, groups);
		groups += groups_in(&f->range[i]);
	}
	return groups;
}

void flat_predict(const ald_prims *p, enum flat_kind kind, size_t accel, ald_memory *out)
{
	uint64_t groups = 0, ranges = ranges_of(p, kind), volumes = 0, fast = 0;

	for (uint32_t i = 0; i < ranges; i++) {
		struct range r = range_at(p, kind, i, 0);

		groups += groups_in(&r);
	}
	if (kind != FLAT_NONE)
		volumes = (ranges + 1) *
			  (sizeof(float[8]) + (kind == FLAT_BALL ? sizeof(struct ball) : sizeof(ald_box)));
	if (p->precision == ALD_PRECISION_FAST)
		fast = (2 * groups + 1) * sizeof(ald_fast_triangles);
	out->kept = accel + (ranges + 1) * sizeof(struct range) + volumes + (groups + 1) * sizeof(struct group) + fast;
	out->peak = out->kept;
	out->scratch = 0;
}

static const struct flat_isa *isa_of(unsigned isa)
{
#if defined __x86_64__
	if (isa == ISA_AVX512)
		return &flat_avx512;
	if (isa == ISA_AVX2)
		return &flat_avx2;
	if (isa == ISA_SSE)
		return &flat_sse;
#endif
	(void)isa;
	return &flat_plain;
}

int flat_init(struct flat *f, const ald_host *host, const ald_prims *prims, enum flat_kind kind, unsigned isa,
	      ald_error *err)
{
	uint32_t groups;

	*f = (struct flat){ .host = host, .prims = prims, .kind = kind };
	f->ranges = ranges_of(prims, kind);
	isa = isa_choose(isa, err);
	if (isa == ISA_AUTO)
		return ALD_BAD_PARAM;
	f->isa = isa_of(isa);
	box_around(prims, 0, prims->count, &f->box);
	if (!prims->count)
		f->box = (ald_box){ { 0, 0, 0 }, { 0, 0, 0 } };
	f->frame = ald_frame_for(prims, &f->box);
	space_of(&f->box, prims->pad, &f->space);
	f->range = take(f, f->ranges, sizeof(*f->range), "volumes");
	if (!f->range)
		return ALD_NO_MEMORY;
	groups = cut_ranges(f);
	if (kind != FLAT_NONE && add_volumes(f))
		return ALD_NO_MEMORY;
	f->group = take(f, groups, sizeof(*f->group), "triangles");
	if (prims->precision == ALD_PRECISION_FAST)
		f->fast = take(f, 2 * (uint64_t)groups, sizeof(*f->fast), "triangles");
	if (!f->group || (prims->precision == ALD_PRECISION_FAST && !f->fast))
		return ALD_NO_MEMORY;
	host->parallel(host->ctx, (groups + GROUPS_A_JOB - 1) / GROUPS_A_JOB, fill_job, f);
	return ALD_OK;
}

/* ---- what the plugins' calls come down to ---- */

int flat_intersect(const struct flat *f, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	double t = hit->t;
	uint32_t prim = hit->prim;

	f->isa->nearest(f, q, ray, hit, 1);
	return hit->t != t || hit->prim != prim;
}

int flat_occluded(const struct flat *f, ald_query *q, const ald_ray *ray)
{
	uint8_t hidden;

	f->isa->occluded(f, q, ray, &hidden, 1);
	return hidden;
}

int flat_stat(const struct flat *f, uint32_t i, const char **name, double *value)
{
	if (i > (f->kind != FLAT_NONE))
		return 0;
	*name = f->kind == FLAT_NONE || i ? "memory" : "volumes";
	*value = f->kind == FLAT_NONE || i ? (double)f->bytes : f->ranges;
	return 1;
}

int flat_tour(const struct flat *f, const ald_ray *only, ald_visit *visit, void *arg)
{
	ald_prep prep;

	if (only)
		ald_ray_prep(&f->frame, only, &prep);
	for (uint32_t g = 0; g < f->ranges; g++) {
		ald_volume v = { .kind = f->ball ? ALD_VOLUME_SPHERE : ALD_VOLUME_BOX, .depth = 0 };
		double t;

		v.prims = f->range[g].end - f->range[g].first;
		if (f->ball)
			v.box = (ald_box){ f->ball[g].centre, { f->ball[g].radius, 0, 0 } };
		else
			v.box = f->volume[g];
		if (only && !flat_enter(f, g, &prep, only->tmin, only->tmax, &t))
			continue;
		if (visit(arg, &v) < 0)
			return -1;
	}
	return 0;
}
