/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "race.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "settle.h"

extern const ald_accel_plugin accel_brute; /* of accel/geometry.h, whose meshes are not these */

/* ---- engines ---- */

static bool load_accel(struct engine *e)
{
	struct diag d = { 0 };
	const char *at = strchr(e->name, '@');
	char plain[sizeof(e->name)];

	e->one = at && strstr(at, "@one");
	snprintf(plain, sizeof(plain), "%.*s", at ? (int)(at - e->name) : 95, e->name);
	e->precision = at && strstr(at, "@exact") ? ALD_PRECISION_EXACT :
		       at && strstr(at, "@fast")  ? ALD_PRECISION_FAST :
						    ALD_PRECISION_DEFAULT;
	if (accel_load(&e->choice, plain, &d) == STATUS_OK && (e->choice.plugin->precisions & e->precision))
		return true;
	fprintf(stderr, "rays: no accelerator %s, or not of that precision\n", e->name);
	return false;
}

static bool build_accel(struct bench *b, struct engine *e)
{
	ald_error err = { "" };
	const char *what;
	double value, start;

	b->world.mesh.prims.precision = e->precision; /* which is looked at now, and not later */
	start = clock_seconds();
	if (e->choice.plugin->build(&b->host.host, &b->world.mesh.prims, e->choice.value, &e->it, &err)) {
		fprintf(stderr, "rays: %s: %s\n", e->name, err.text);
		return false;
	}
	e->build = clock_seconds() - start;
	for (uint32_t i = 0; i < b->threads && e->choice.plugin->scratch_size; i++)
		e->q[i].scratch = mem_zalloc(&b->host.book, "scratch", e->choice.plugin->scratch_size(e->it));
	for (uint32_t i = 0; i < b->threads; i++)
		e->q[i].thread = i;
	for (uint32_t i = 0; e->choice.plugin->stat && e->choice.plugin->stat(e->it, i, &what, &value); i++) {
		if (!strcmp(what, "memory"))
			e->bytes = value;
	}
	return true;
}

static bool build_forest(struct bench *b, struct engine *e)
{
	struct diag d = { 0 };
	double start;

	if (accel_set_precision(&e->choice, e->precision, &d) != STATUS_OK)
		return false;
	start = clock_seconds();
	e->geometry = forest_build(b->world.forest, &e->choice, b->host.pool, &b->host.book);
	e->build = clock_seconds() - start;
	e->bytes = e->geometry ? forest_bytes(e->geometry) : 0;
	return e->geometry;
}

static bool same_config(const struct peer_config *x, const struct peer_config *y)
{
	return !strcmp(x->isa ? x->isa : "", y->isa ? y->isa : "") && x->robust == y->robust && x->huge == y->huge &&
	       x->quality == y->quality && x->threads == y->threads && !(x->splits < y->splits) &&
	       !(x->splits > y->splits);
}

/* Those that differ in how they are called share a tree. */
static bool open_peer(struct bench *b, struct engine *e)
{
	for (uint32_t i = 0; i < b->engines && !e->tree; i++) {
		if (b->engine[i].tree && same_config(&b->engine[i].config, &e->config))
			e->tree = b->engine[i].tree;
	}
	e->lent = e->tree;
	if (!b->floats && b->world.forest)
		b->floats = peer_mesh_new(&b->world.mesh.prims, b->world.mesh.vertices,
					  forest_places(b->world.forest), TREES);
	else if (!b->floats)
		b->floats = peer_mesh_new(&b->world.mesh.prims, b->world.mesh.vertices, NULL, 0);
	if (!e->tree)
		e->tree = peer_open(&e->config, b->floats);
	if (!e->tree)
		return false;
	e->build = peer_seconds(e->tree);
	e->bytes = peer_bytes(e->tree);
	return true;
}

static bool engine_build(struct bench *b, struct engine *e)
{
	if (e->choice.plugin)
		return b->world.forest ? build_forest(b, e) : build_accel(b, e);
	if (peer_there() && open_peer(b, e))
		return true;
	fprintf(stderr, "rays: no %s here (Debian has Embree as libembree-dev)\n", e->name);
	return false;
}

bool engine_open(struct bench *b, const char *name)
{
	struct engine *e = &b->engine[b->engines];

	memset(e, 0, sizeof(*e));
	snprintf(e->name, sizeof(e->name), "%s", name);
	for (unsigned k = 0; k < KINDS; k++)
		e->races[k] = !b->leaves_out[k];
	e->peer = peer_parse(name, &e->config, &e->way);
	e->config.threads = b->threads;
	if (!e->peer && !load_accel(e))
		return false;
	if (!engine_build(b, e)) {
		engine_close(e);
		return false;
	}
	b->engines++;
	return true;
}

static void engine_clear(struct engine *e)
{
	forest_unbuild(e->geometry);
	if (e->it)
		e->choice.plugin->destroy(e->it);
	for (uint32_t i = 0; i < THREADS; i++)
		mem_free(e->q[i].scratch);
	if (e->tree && !e->lent)
		peer_close(e->tree);
	memset(e->q, 0, sizeof(e->q));
	e->it = NULL;
	e->geometry = NULL;
	e->tree = NULL;
}

void engine_close(struct engine *e)
{
	engine_clear(e);
	if (e->choice.plugin)
		accel_unload(&e->choice);
}

bool engine_rebuild(struct bench *b, struct engine *e)
{
	const struct peer *old = e->tree;
	bool fine, uses[ENGINES] = { false };

	if (e->lent)
		return true;
	for (uint32_t i = 0; i < b->engines && old; i++) {
		uses[i] = b->engine[i].lent && b->engine[i].tree == old;
		if (uses[i])
			b->engine[i].tree = NULL;
	}
	engine_clear(e);
	fine = engine_build(b, e);
	for (uint32_t i = 0; i < b->engines; i++) {
		if (uses[i])
			b->engine[i].tree = e->tree;
	}
	return fine;
}

/* ---- firing ---- */

struct volley {
	struct bench *b;
	const struct engine *e;
	unsigned kind;
	uint32_t step;
	ald_hit *out; /* NULL: nobody wants them */
};

/* Ray by ray. */
static void fire_one(const struct engine *e, uint32_t thread, ald_query *q, const ald_ray *ray, ald_hit *hit,
		     uint8_t *hidden, uint32_t n)
{
	const ald_accel_plugin *p = e->choice.plugin;

	for (uint32_t j = 0; j < n; j++) {
		if (e->geometry && hidden)
			forest_occluded(e->geometry, thread, &ray[j], &hidden[j], 1, 0);
		else if (e->geometry)
			forest_nearest(e->geometry, thread, &ray[j], &hit[j], 1, 0);
		else if (hidden)
			hidden[j] = (uint8_t)p->occluded(e->it, q, &ray[j]);
		else
			p->intersect(e->it, q, &ray[j], &hit[j]);
	}
}

static void fire_batch(void *arg, uint32_t i, uint32_t thread)
{
	const struct volley *v = arg;
	struct bench *b = v->b;
	const struct engine *e = v->e;
	uint32_t at = i * v->step * BATCH, n = b->shots.n[v->kind] - at, hints = kind_hints[v->kind];
	const ald_ray *ray = b->shots.ray[v->kind] + at;
	ald_query q = e->q[thread];
	ald_hit *hit = b->hit[thread];
	uint8_t *hidden = b->hidden[thread];
	ald_prims prims = b->world.mesh.prims;
	bool any = kind_any(v->kind);

	n = n < BATCH ? n : BATCH;
	for (uint32_t j = 0; j < n && !any; j++) {
		hit[j].t = ray[j].tmax;
		hit[j].prim = ALD_NONE;
	}
	if (e->peer)
		peer_fire(e->tree, e->way, ray, hit, any ? hidden : NULL, n, hints);
	else if (e->one)
		fire_one(e, thread, &q, ray, hit, any ? hidden : NULL, n);
	else if (e->geometry && any)
		forest_occluded(e->geometry, thread, ray, hidden, n, hints);
	else if (e->geometry)
		forest_nearest(e->geometry, thread, ray, hit, n, hints);
	else if (any)
		e->choice.plugin->occluded_n(e->it, &q, ray, hidden, n, hints);
	else
		e->choice.plugin->intersect_n(e->it, &q, ray, hit, n, hints);
	if (!any && !e->geometry && e->precision == ALD_PRECISION_EXACT) {
		prims.precision = e->precision; /* the last one that was built with may be another */
		settle_as_host(&prims, &b->world.mesh.frame, ray, hit, n);
	}
	for (uint32_t j = 0; j < n && v->out; j++) {
		if (any)
			v->out[at + j] = (ald_hit){ .prim = hidden[j] ? 0 : ALD_NONE };
		else
			v->out[at + j] = hit[j];
	}
}

static double thread_now(void)
{
	struct timespec t;

	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double engine_fire(struct bench *b, const struct engine *e, unsigned kind, uint32_t step)
{
	struct volley v = { .b = b, .e = e, .kind = kind, .step = step };
	uint32_t n = (b->shots.n[kind] + step * BATCH - 1) / (step * BATCH);
	double start = b->threads > 1 ? clock_seconds() : thread_now();

	if (b->threads > 1) {
		pool_run(b->host.pool, n, fire_batch, &v);
		return clock_seconds() - start;
	}
	for (uint32_t i = 0; i < n; i++)
		fire_batch(&v, i, 0);
	return thread_now() - start;
}

void engine_answers(struct bench *b, const struct engine *e, unsigned kind, ald_hit *out)
{
	struct volley v = { .b = b, .e = e, .kind = kind, .step = 1, .out = out };

	for (uint32_t i = 0; i * BATCH < b->shots.n[kind]; i++)
		fire_batch(&v, i, 0);
}

/* ---- the race ---- */

/* Brute force: none; for large meshes, which it would take as much memory for as a tree, one triangle after another. */
static bool open_judge(struct bench *b, struct engine *e, bool large)
{
	ald_error err = { "" };

	if (!large)
		return engine_open(b, "none");
	memset(e, 0, sizeof(*e));
	e->choice.plugin = &accel_brute;
	b->engines++;
	return !accel_brute.build(&b->host.host, &b->world.mesh.prims, e->choice.value, &e->it, &err);
}

/* Some rays of each kind are asked of brute force: as many as take a second or so; of large meshes a few. */
static void sample_truth(struct bench *b)
{
	bool large = b->world.mesh.prims.count > 20000000;
	uint32_t before = b->engines;
	uint32_t want = large || b->world.forest ? 3 : 100000000u / (b->world.mesh.prims.count + 1) + 50;
	uint64_t seed = 4711;
	struct engine *e = &b->engine[before];

	if (!open_judge(b, e, large))
		return;
	for (unsigned k = 0; k < KINDS; k++) {
		for (uint32_t i = 0; i < want && i < 2000 && b->shots.n[k]; i++) {
			uint32_t at = (uint32_t)(random_next(&seed) % b->shots.n[k]);
			const ald_ray *r = &b->shots.ray[k][at];
			ald_hit hit = { .t = r->tmax, .prim = ALD_NONE };
			bool same;

			if (e->geometry)
				forest_nearest(e->geometry, 0, r, &hit, 1, 0);
			else
				e->choice.plugin->intersect(e->it, &e->q[0], r, &hit);
			same = (hit.prim == ALD_NONE) == (b->truth[k][at].prim == ALD_NONE);
			if (!kind_any(k) && hit.prim != ALD_NONE)
				same = hit.prim == b->truth[k][at].prim && hit.t <= b->truth[k][at].t &&
				       hit.t >= b->truth[k][at].t;
			b->sampled++;
			b->strays += !same;
		}
	}
	engine_close(e);
	b->engines = before;
}

void race_truth(struct bench *b)
{
	for (unsigned k = 0; k < KINDS; k++)
		b->truth[k] = malloc((size_t)b->shots.n[CAMERA] * sizeof(ald_hit));
	engine_answers(b, &b->engine[0], CAMERA, b->truth[CAMERA]);
	shots_second(&b->shots, &b->world, b->engine[0].geometry, b->truth[CAMERA]);
	for (unsigned k = SHADOW; k < KINDS; k++)
		engine_answers(b, &b->engine[0], k, b->truth[k]);
	b->sampled = b->strays = 0;
	sample_truth(b);
}

void race_run(struct bench *b)
{
	for (uint32_t turn = 0; turn <= b->rounds; turn++) { /* the first warms up */
		uint32_t r = turn ? turn - 1 : 0;

		for (unsigned k = 0; k < KINDS; k++) {
			for (uint32_t i = 0; i <= b->engines; i++) {
				uint32_t at = (i + turn) % (b->engines + 1);
				struct engine *e = &b->engine[at < b->engines ? at : 0];

				if (!e->races[k] || b->leaves_out[k])
					continue;
				/* Who raced before leaves its tree in the caches; the first engine sometimes came after
				 * itself, and was some hundredths faster for that. So all do. */
				engine_fire(b, e, k, 1);
				(at < b->engines ? e->seconds[k] : b->again[k])[r] = engine_fire(b, e, k, 1);
			}
		}
	}
}

/* Floats may err by a few units of the scene's size. */
static void count_wrong(const struct bench *b, struct engine *e, unsigned k, const ald_hit *hit)
{
	double off = 1e-5 * b->world.radius;

	for (uint32_t i = 0; i < b->shots.n[k]; i++) {
		const ald_hit *right = &b->truth[k][i];

		if (right->prim != ALD_NONE && hit[i].prim == ALD_NONE)
			e->wrong[k][WRONG_MISSED]++;
		else if (right->prim == ALD_NONE && hit[i].prim != ALD_NONE)
			e->wrong[k][WRONG_GHOST]++;
		else if (right->prim != ALD_NONE && fabs(hit[i].t - right->t) > off)
			e->wrong[k][WRONG_OTHER]++;
	}
}

void race_count_wrong(struct bench *b)
{
	ald_hit *hit = malloc((size_t)b->shots.n[CAMERA] * sizeof(*hit));

	for (uint32_t i = 1; i < b->engines; i++) {
		for (unsigned k = 0; k < KINDS; k++) {
			if (!b->engine[i].races[k])
				continue;
			engine_answers(b, &b->engine[i], k, hit);
			count_wrong(b, &b->engine[i], k, hit);
		}
	}
	free(hit);
}

/* ---- which way to call Embree is its best ---- */

struct candidate {
	double seconds;
	struct peer_config config;
	struct peer_way way;
};

enum { KEPT = 2 };
typedef struct candidate podium[KINDS][2][KEPT]; /* robust: [1] */

static void consider(struct candidate *list, const struct candidate *c)
{
	uint32_t at = KEPT;

	while (at && (list[at - 1].seconds <= 0 || c->seconds < list[at - 1].seconds))
		at--;
	if (at == KEPT)
		return;
	memmove(&list[at + 1], &list[at], (KEPT - 1 - at) * sizeof(*list));
	list[at] = *c;
}

static void screen_tree(struct bench *b, const struct peer_config *config, podium best, uint32_t step[KINDS])
{
	static const struct peer_way ways[] = { { PEER_1, 0 },	{ PEER_8, 0 },	{ PEER_8, 1 },
						{ PEER_16, 0 }, { PEER_16, 1 }, { PEER_1M, 0 },
						{ PEER_1M, 1 }, { PEER_NP, 0 }, { PEER_NP, 1 } };
	struct engine e = { .peer = true, .config = *config };

	/* With AVX-512 rtcOccluded16 of Embree 3.13 does not return from a scene of instances, nor do streams. */
	if (b->world.forest && !strcmp(config->isa, "avx512"))
		return;
	if (!open_peer(b, &e))
		return;
	for (unsigned k = 0; k < KINDS; k++) {
		if (!step[k]) { /* about 8 ms a try */
			double each = engine_fire(b, &e, k, 16) * 16;

			e.way = ways[0];
			each = engine_fire(b, &e, k, 16) * 16;
			step[k] = (uint32_t)(each / 0.008) + 1;
			if (b->shots.n[k] / BATCH / step[k] < 8)
				step[k] = b->shots.n[k] / BATCH / 8 + 1;
		}
		for (unsigned w = 0; w < sizeof(ways) / sizeof(ways[0]); w++) {
			struct candidate c = { 1e9, *config, ways[w] };

			e.way = ways[w];
			for (unsigned n = 0; n < 2; n++) {
				double s = engine_fire(b, &e, k, step[k]);

				c.seconds = s < c.seconds ? s : c.seconds;
			}
			consider(best[k][config->robust], &c);
		}
	}
	if (!e.lent)
		peer_close(e.tree);
}

static void enter(struct bench *b, const struct candidate *c, unsigned kind)
{
	char name[96];

	peer_name(&c->config, c->way, name);
	for (uint32_t i = 1; i < b->engines; i++) {
		if (!strcmp(b->engine[i].name, name)) {
			b->engine[i].races[kind] = true;
			return;
		}
	}
	if (b->engines + 2 >= ENGINES || !engine_open(b, name))
		return;
	memset(b->engine[b->engines - 1].races, 0, sizeof(bool[KINDS]));
	b->engine[b->engines - 1].races[kind] = true;
}

void race_screen(struct bench *b)
{
	static const char *const isas[] = { "avx2", "avx512", "avx", "sse4.2" };
	podium best = { 0 };
	uint32_t step[KINDS] = { 0 };

	if (!peer_there())
		return;
	for (unsigned i = 0; i < (b->all ? 4u : 2u); i++) {
		for (unsigned n = 0; n < (b->all ? 8u : 2u); n++) {
			struct peer_config c = { isas[i], n & 1, n & 2, n & 4 ? PEER_HIGH : PEER_MEDIUM, b->threads,
						 0 };

			screen_tree(b, &c, best, step);
		}
	}
	engine_open(b, "embree1");
	for (unsigned k = 0; k < KINDS; k++) {
		for (unsigned n = 0; n < 2 * KEPT && !b->leaves_out[k]; n++) {
			if (best[k][n / KEPT][n % KEPT].seconds > 0)
				enter(b, &best[k][n / KEPT][n % KEPT], k);
		}
	}
}
