/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8: a tree of boxes, eight to a node, in floats that are rounded outward; what they can't rule out is
 * decided by alidade/kernel.h. The walk is compiled for several instruction sets and the widest that the
 * processor has is taken.
 */
#include "bvh8.h"
#include "isa.h"
#include "seen.h"

#define CACHE ((uint64_t)2 << 20) /* bytes of a tree that a processor's second cache holds */
#define FAR 8 /* times as large, and most of what a ray meets has to be fetched */

static const char *const build_label[] = { "auto", "sah", "fast", NULL };
static const ald_param params[] = {
	{ "split", "references at most, in primitives: long thin triangles in parts; 1: none", ALD_REAL, 16, 1,
	  100, NULL },
	{ "leaf", "triangles of a leaf at most", ALD_INT, 8, 1, SEATS * BLOCKS_MAX, NULL },
	ISA_PARAM,
	{ "interleave",
	  "rays a thread walks with in turns; 0: 48, and herds of rays that go together; 1: each alone",
	  ALD_INT, 0, 0, INTERLEAVE_MAX, NULL },
	{ "build", "sah: made for rays; fast: made in half the time, and nothing is split; auto: what few rays pay for",
	  ALD_CHOICE, BUILD_AUTO, 0, 2, build_label },
	{ NULL, NULL, 0, 0, 0, 0, NULL },
};

/* Of its own choice AVX2 before AVX-512, whose masks cost rays more than its width gains. */
static const struct isa *isa_of(unsigned want, ald_error *err)
{
	switch (isa_choose(want, err)) {
#if defined __x86_64__
	case ISA_AVX512:
		return &bvh8_avx512;
	case ISA_AVX2:
		return &bvh8_avx2;
	case ISA_SSE:
		return &bvh8_sse;
#endif
	case ISA_PLAIN:
		return &bvh8_plain;
	default:
		return NULL;
	}
}

/* From ref[] or key[] to what rays walk through. */
static int make_tree(struct builder *b)
{
	const ald_host *h = b->host;
	int status;
#if defined __x86_64__
	int avx2 = b->a->isa == &bvh8_avx2 || b->a->isa == &bvh8_avx512;
	int (*sah)(struct builder *) = avx2 ? bvh8_sah_avx2 : bvh8_sah_base;
	const struct bvh8_crop *crop = avx2 ? &bvh8_crop_avx2 : &bvh8_crop_base;
#else
	int (*sah)(struct builder *) = bvh8_sah_base;
	const struct bvh8_crop *crop = &bvh8_crop_base;
#endif

	if (b->fast)
		return h->progress(h->ctx, 0.05) ? ALD_CANCELLED : bvh8_fast(b, crop);
	status = h->progress(h->ctx, 0.05) ? ALD_CANCELLED : bvh8_split(b);
	if (!status)
		status = h->progress(h->ctx, 0.1) ? ALD_CANCELLED : bvh8_tree(b, sah);
	if (!status)
		status = h->progress(h->ctx, 0.8) ? ALD_CANCELLED : bvh8_widen(b);
	return status;
}

#define ORDERED 4096u /* nodes of a job */

static void order_job(void *arg, uint32_t i)
{
	ald_accel *a = arg;
	uint32_t from = i * ORDERED, n = a->nodes - from < ORDERED ? a->nodes - from : ORDERED;

	a->isa->order(a->node + from, n);
}

void bvh8_destroy(ald_accel *a)
{
	const ald_host *h = a->host;

	h->free(h->ctx, a->node);
	h->free(h->ctx, a->block);
	h->free(h->ctx, a->other);
	h->free(h->ctx, a);
}

void bvh8_note_masks(ald_accel *a)
{
	const uint32_t *mask = a->prims->mask;
	uint32_t n = 0, k;

	a->masks = 0;
	for (uint32_t i = 0; mask && i < a->prims->count; i++) {
		if (i && mask[i] == mask[i - 1])
			continue;
		for (k = 0; k < n && a->mask[k] != mask[i]; k++)
			;
		if (k == MASKS)
			return;
		a->mask[k] = mask[i];
		n = k < n ? n : k + 1;
	}
	a->masks = n;
}

static int bvh8_build(const ald_host *host, const ald_prims *prims, const double *value, ald_accel **out,
		      ald_error *err)
{
	struct builder b = { .host = host, .prims = prims, .value = value };
	const struct isa *isa = isa_of((unsigned)value[P_ISA], err);
	int status;

	if (!isa)
		return ALD_BAD_PARAM;
	b.a = bvh8_take(host, 1, sizeof(*b.a), "bvh8: nodes");
	if (!b.a)
		return ALD_NO_MEMORY;
	*b.a = (ald_accel){ .host = host,
			    .prims = prims,
			    .isa = isa,
			    .interleave = (uint32_t)value[P_INTERLEAVE],
			    .fast = prims->precision == ALD_PRECISION_FAST,
			    .bytes = sizeof(*b.a) };
	bvh8_note_masks(b.a);
	status = host->progress(host->ctx, 0) ? ALD_CANCELLED : bvh8_refs(&b);
	if (!status)
		status = make_tree(&b);
	b.a->far = (b.a->bytes > CACHE) + (b.a->bytes > FAR * CACHE);
	if (!status && isa->order)
		host->parallel(host->ctx, (b.a->nodes + ORDERED - 1) / ORDERED, order_job, b.a);
	b.a->lone = isa->nearest_one && !b.a->fast && b.a->root != EMPTY;
	b.a->herds = !b.a->interleave;
	if (!b.a->interleave)
		b.a->interleave = INTERLEAVE_MAX;
	host->free(host->ctx, b.ref);
	host->free(host->ctx, b.id);
	host->free(host->ctx, b.key);
	host->free(host->ctx, b.twig);
	host->free(host->ctx, b.task);
	host->free(host->ctx, b.corner);
	host->free(host->ctx, b.part);
	host->free(host->ctx, b.seat);
	if (status)
		bvh8_destroy(b.a);
	else
		*out = b.a;
	return status;
}

static size_t bvh8_scratch_size(const ald_accel *a)
{
	return a->parts ? seen_size(a->prims->count) : 0;
}

static void bvh8_intersect_n(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, uint32_t n,
			     uint32_t hints)
{
	a->isa->nearest(a, q, ray, hit, n, hints);
}

static void bvh8_occluded_n(const ald_accel *a, ald_query *q, const ald_ray *ray, uint8_t *hidden, uint32_t n,
			    uint32_t hints)
{
	a->isa->occluded(a, q, ray, hidden, n, hints);
}

static int bvh8_intersect(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	double t = hit->t;
	uint32_t prim = hit->prim;

	if (a->lone && !q->count)
		a->isa->nearest_one(a, q, ray, hit);
	else
		a->isa->nearest(a, q, ray, hit, 1, 0);
	return hit->t != t || hit->prim != prim;
}

static int bvh8_occluded(const ald_accel *a, ald_query *q, const ald_ray *ray)
{
	uint8_t hidden;

	if (a->lone && !q->count)
		return a->isa->occluded_one(a, q, ray) != 0;
	a->isa->occluded(a, q, ray, &hidden, 1, 0);
	return hidden;
}

/* ---- what it looks like ---- */

static int bvh8_stat(const ald_accel *a, uint32_t i, const char **name, double *value)
{
	const struct {
		const char *name;
		double value;
	} list[] = {
		{ "nodes", (double)a->nodes + a->leaves },
		{ "leaves", a->leaves },
		{ "depth", a->depth },
		{ "references", (double)a->refs },
		{ "expected cost", a->cost },
		{ "built fast", a->hasty },
		{ "memory", (double)a->bytes },
	};

	if (i >= sizeof(list) / sizeof(list[0]))
		return 0;
	*name = list[i].name;
	*value = list[i].value;
	return 1;
}

static uint32_t prims_of(const ald_accel *a, uint32_t ref)
{
	uint32_t n = 0;

	if (ref >= REF_OTHERS)
		return a->other[ref & REF_INDEX];
	for (uint32_t i = 0; i < SEATS * ((ref >> REF_SHIFT & 7) + 1); i++)
		n += a->block[(ref & REF_INDEX) + i / SEATS].id[i % SEATS] != ALD_NONE;
	return n;
}

struct tour {
	const ald_accel *a;
	const ald_ray *only;
	ald_visit *visit;
	void *arg;
	ald_prep p;
};

static int tour_node(const struct tour *t, uint32_t ref, const ald_box *box, uint32_t depth)
{
	const ald_accel *a = t->a;
	ald_volume v = { .kind = ALD_VOLUME_BOX, .depth = depth, .box = *box };
	double enter;
	int more;

	if (t->only && !ald_box_ray(&t->p, box, t->only->tmin, t->only->tmax, &enter))
		return 0;
	if (ref >= REF_LEAF)
		v.prims = prims_of(a, ref);
	more = t->visit(t->arg, &v);
	if (more < 0 || !more || ref >= REF_LEAF)
		return more < 0 ? -1 : 0;
	for (unsigned k = 0; k < WIDTH && a->node[ref].child[k] != EMPTY; k++) {
		const struct node *n = &a->node[ref];
		ald_box kid;

		for (unsigned i = 0; i < 3; i++) {
			(&kid.lo.x)[i] = (double)n->plane[2 * i][k] / a->scale + a->centre[i] - a->prims->pad;
			(&kid.hi.x)[i] =
				(double)n->plane[2 * i + 1][k] / a->scale + a->centre[i] + a->prims->pad;
		}
		if (tour_node(t, n->child[k], &kid, depth + 1) < 0)
			return -1;
	}
	return 0;
}

static int bvh8_walk(const ald_accel *a, const ald_ray *only, ald_visit *visit, void *arg)
{
	struct tour t = { .a = a, .only = only, .visit = visit, .arg = arg };

	if (a->root == EMPTY)
		return 0;
	if (only)
		ald_ray_prep(&a->frame, only, &t.p);
	return tour_node(&t, a->root, &a->box, 0);
}

const ald_accel_plugin ald_accel_entry = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "bvh8",
	.version = "1",
	.license = "Apache-2.0",
	.summary = "tree of boxes, eight to a node",
	.params = params,
	.precisions = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT | ALD_PRECISION_FAST,
	.build = bvh8_build,
	.intersect = bvh8_intersect,
	.destroy = bvh8_destroy,
	.scratch_size = bvh8_scratch_size,
	.occluded = bvh8_occluded,
	.intersect_n = bvh8_intersect_n,
	.occluded_n = bvh8_occluded_n,
	.refit = bvh8_refit,
	.stat = bvh8_stat,
	.walk = bvh8_walk,
	.predict = bvh8_predict,
};
