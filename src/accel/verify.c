/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "accel/verify.h"

#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "accel/geometry.h"
#include "base/rng.h"

struct verify {
	struct mem_book *book;
	struct geometry *judge, *exact; /* NULL: not asked */
	struct verify_counts *thread; /* a worker's own; the lists are not used */
	uint32_t threads;
	pthread_mutex_t lock; /* of what follows */
	struct verify_counts all; /* the lists only */
};

static uint64_t mix(uint64_t key, double x)
{
	uint64_t bits;

	memcpy(&bits, &x, sizeof(bits));
	return rng_mix(key + bits);
}

/* All numbers of a ray and its pixel, as one. */
static uint64_t ray_key(const ald_ray *r)
{
	uint64_t key = rng_mix((uint64_t)r->reserved[0] << 32 | r->reserved[1]);

	for (unsigned k = 0; k < 3; k++) {
		key = mix(key, ald_get(&r->org, k));
		key = mix(key, ald_get(&r->dir, k));
	}
	key = mix(mix(key, r->tmin), r->tmax);
	key = rng_mix(key + ((uint64_t)r->after << 32 | r->after_sub[0]));
	return rng_mix(key + ((uint64_t)r->mask << 32 | r->skip));
}

static bool is_chosen(const struct verify *v, const ald_ray *r)
{
	return v->all.every == 1 || ray_key(r) % v->all.every == 0;
}

static bool comes_before(const struct verify_difference *a, const struct verify_difference *b)
{
	if (a->y != b->y)
		return a->y < b->y;
	if (a->x != b->x)
		return a->x < b->x;
	return ray_key(&a->ray) < ray_key(&b->ray);
}

/* Kept in order, so that all numbers of threads keep the same ones. */
static void keep(struct verify *v, const struct verify_difference *d)
{
	struct verify_list *l = d->inexact ? &v->all.first_inexact : &v->all.first;
	uint32_t i;

	pthread_mutex_lock(&v->lock);
	if (l->count < VERIFY_SHOWN)
		i = l->count++;
	else if (comes_before(d, &l->one[VERIFY_SHOWN - 1]))
		i = VERIFY_SHOWN - 1;
	else
		i = VERIFY_SHOWN;
	for (; i < VERIFY_SHOWN && i && comes_before(d, &l->one[i - 1]); i--)
		l->one[i] = l->one[i - 1];
	if (i < VERIFY_SHOWN)
		l->one[i] = *d;
	pthread_mutex_unlock(&v->lock);
}

/* To the bit: what a miss left in u and v means nothing. */
static bool is_same(const ald_hit *a, const ald_hit *b)
{
	if (a->prim != b->prim || a->prim == ALD_NONE)
		return a->prim == b->prim;
	return !memcmp(&a->t, &b->t, sizeof(a->t)) && !memcmp(&a->u, &b->u, sizeof(a->u)) &&
	       !memcmp(&a->v, &b->v, sizeof(a->v)) && a->part == b->part && a->sub[0] == b->sub[0] &&
	       a->sub[1] == b->sub[1];
}

/* The same triangle of the same copy. Another piece or side of another surface would have another t, which is
 * what rounding makes of it. */
static bool is_same_thing(const ald_hit *a, const ald_hit *b)
{
	return a->prim == b->prim && (a->prim == ALD_NONE || a->sub[0] == b->sub[0]);
}

static bool is_alike(enum verify_question q, bool inexact, const ald_hit *got, const ald_hit *want)
{
	if (q == VERIFY_OCCLUDED)
		return (got->prim == ALD_NONE) == (want->prim == ALD_NONE);
	return inexact ? is_same_thing(got, want) : is_same(got, want);
}

/* What one judge says of an answer. */
static void hold(struct verify *v, uint32_t thread, enum verify_question q, bool inexact, const ald_ray *r,
		 const ald_hit *got)
{
	struct verify_difference d = { .question = q, .purpose = (enum trace_purpose)r->reserved[2],
				       .x = r->reserved[0], .y = r->reserved[1], .inexact = inexact, .ray = *r,
				       .got = *got };

	trace_nearest(inexact ? v->exact : v->judge, thread, r, &d.want, 1, 0);
	if (is_alike(q, inexact, got, &d.want))
		return;
	(inexact ? v->thread[thread].inexact : v->thread[thread].different)[q]++;
	keep(v, &d);
}

static void check(struct verify *v, uint32_t thread, enum verify_question q, const ald_ray *r, const ald_hit *got)
{
	v->thread[thread].checked[q]++;
	if (v->judge)
		hold(v, thread, q, false, r, got);
	if (v->exact)
		hold(v, thread, q, true, r, got);
}

void verify_nearest(struct verify *v, uint32_t thread, const ald_ray *r, const ald_hit *got, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++) {
		if (is_chosen(v, &r[i]))
			check(v, thread, r[i].after == ALD_NONE ? VERIFY_NEAREST : VERIFY_NEXT, &r[i], &got[i]);
	}
}

void verify_occluded(struct verify *v, uint32_t thread, const ald_ray *r, const uint8_t *hidden, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++) {
		ald_hit got = { .prim = hidden[i] ? 0 : ALD_NONE };

		if (is_chosen(v, &r[i]))
			check(v, thread, VERIFY_OCCLUDED, &r[i], &got);
	}
}

enum status verify_begin(struct geometry *g, uint32_t every, struct pool *pool, struct diag *diag)
{
	struct verify *v = mem_zalloc(g->book, "verification", sizeof(*v));
	enum status st = STATUS_OK;

	if (!v)
		return diag_no_memory(diag, "verification", sizeof(*v));
	v->book = g->book;
	v->threads = g->threads;
	v->all.every = every;
	pthread_mutex_init(&v->lock, NULL);
	g->verify = v;
	v->thread = mem_zalloc(g->book, "verification", mem_product(g->threads, sizeof(*v->thread)));
	if (!v->thread)
		return diag_no_memory(diag, "verification", g->threads * sizeof(*v->thread));
	if (g->precision != ALD_PRECISION_FAST)
		st = geometry_judge(&v->judge, g, g->precision, pool, diag);
	if (!st && g->precision != ALD_PRECISION_EXACT)
		st = geometry_judge(&v->exact, g, ALD_PRECISION_EXACT, pool, diag);
	return st;
}

void verify_reset(struct verify *v)
{
	uint32_t every = v->all.every;

	memset(v->thread, 0, v->threads * sizeof(*v->thread));
	v->all = (struct verify_counts){ .every = every };
}

void verify_free(struct verify *v)
{
	if (!v)
		return;
	geometry_free(v->judge);
	geometry_free(v->exact);
	mem_free(v->thread);
	pthread_mutex_destroy(&v->lock);
	mem_free(v);
}

void verify_get(const struct geometry *g, struct verify_counts *c)
{
	const struct verify *v = g->verify;

	*c = (struct verify_counts){ .every = 0 };
	if (!v)
		return;
	*c = v->all;
	for (uint32_t t = 0; t < v->threads; t++) {
		for (int q = 0; q < VERIFY_QUESTIONS; q++) {
			c->checked[q] += v->thread[t].checked[q];
			c->different[q] += v->thread[t].different[q];
			c->inexact[q] += v->thread[t].inexact[q];
		}
	}
}

/* "nothing", or which primitive of which object, and where. */
static void describe_hit(const struct geometry *g, const ald_hit *h, char *out, size_t size)
{
	const struct prim_level *l = &g->set.level[0];
	uint32_t leaf, face, inner = 0, id = h->prim;
	const struct object *o;
	enum prim_id kind = PRIM_SHAPE;
	int n;

	if (id == ALD_NONE) {
		snprintf(out, size, "nothing");
		return;
	}
	if (id >= l->count && id - l->count >= g->set.unbounded_count) {
		snprintf(out, size, "primitive %" PRIu32 ", which there is not,", id);
		return;
	}
	if (id >= l->count) {
		leaf = g->set.unbounded[id - l->count].leaf;
		face = 0;
	} else {
		leaf = view_leaf(l, id, &face);
		kind = prim_level_id(l, &id);
	}
	if (kind == PRIM_INSTANCE && h->sub[0] < g->set.level[l->instance[id].level].count)
		view_leaf(&g->set.level[l->instance[id].level], h->sub[0], &inner);
	o = &g->set.scene->object[g->set.leaf[leaf].object];
	n = snprintf(out, size, "primitive %" PRIu32, h->prim);
	if (n > 0 && (size_t)n < size && (kind == PRIM_TRIANGLE || kind == PRIM_INSTANCE))
		n += snprintf(out + n, size - (size_t)n, ", face %" PRIu32 ",",
			      kind == PRIM_INSTANCE ? inner : face);
	if (n > 0 && (size_t)n < size)
		n += snprintf(out + n, size - (size_t)n, " of object %" PRIu32, g->set.leaf[leaf].object);
	if (n > 0 && (size_t)n < size && o->pos.file)
		n += snprintf(out + n, size - (size_t)n, " (%s:%" PRIu32 ")", o->pos.file, o->pos.line);
	if (n > 0 && (size_t)n < size)
		snprintf(out + n, size - (size_t)n, " at t = %.17g, u = %.17g, v = %.17g", h->t, h->u, h->v);
}

int verify_describe(const struct geometry *g, const struct verify_difference *d, char *out, size_t size)
{
	static const char *const purpose[] = { "camera", "shadow", "reflected", "refracted", "gathered",
					       "subsurface" };
	static const char *const question[] = { "the nearest hit", "whether anything is hit", "the next hit" };
	const ald_ray *r = &d->ray;
	char got[512], want[512];

	if (d->question == VERIFY_OCCLUDED)
		snprintf(got, sizeof(got), "%s", d->got.prim == ALD_NONE ? "nothing" : "a hit");
	else
		describe_hit(g, &d->got, got, sizeof(got));
	describe_hit(g, &d->want, want, sizeof(want));
	return snprintf(out, size,
			"pixel %" PRIu32 ",%" PRIu32 ": %s ray, %s: %s found %s, %s %s; ray from <%.17g, "
			"%.17g, %.17g> along <%.17g, %.17g, %.17g>, t from %.17g to %.17g, mask %" PRIu32
			", skip %" PRIu32 ", after %" PRIu32,
			d->x, d->y, purpose[d->purpose < TRACE_PURPOSES ? d->purpose : 0], question[d->question],
			g->plugin->name, got,
			d->inexact ? "in exact order it is" : "the judge", want,
			r->org.x, r->org.y, r->org.z, r->dir.x, r->dir.y, r->dir.z,
			r->tmin, r->tmax, r->mask, r->skip, r->after);
}
