/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * From a scene to something that can be asked: compile, build an accelerator per level, set up threads.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "accel/geometry.h"

#include <string.h>

#include "accel/load.h"
#include "accel/verify.h"
#include "base/clock.h"
#include "base/interrupt.h"
#include "base/process.h"

static void show_level(struct view *v, const struct geometry *g, const struct prim_level *l)
{
	v->geometry = g;
	v->level = l;
	v->prims = (ald_prims){
		.size = sizeof(ald_prims),
		.count = l->count,
		.precision = g->precision,
		.pad = l->pad,
		.bounds = view_bounds,
		.intersect = view_intersect,
		.intersect_n = view_intersect_n,
		.mask = l->mask,
		.group_count = l->group_count,
		.group_first = l->group_first,
		.tri_count = l->tri_count,
		.vertex_double = l->vertex_double,
		.index = l->index,
		.vertex = l->vertex,
		.box = l->box,
	};
	v->frame = ald_frame_for(&v->prims, &l->box);
}

static enum status refuse(const struct geometry *g, int result, const ald_error *err, struct diag *diag)
{
	static const char *const why[] = { "", "ran out of memory", "refused a parameter", "was cancelled",
					   "does not support this scene", "failed" };
	const char *text = result > 0 && result <= ALD_FAILED ? why[result] : "failed";

	if (result == ALD_CANCELLED && interrupt_asked())
		return STATUS_SIGINT;
	return diag_fail(diag, result == ALD_NO_MEMORY ? STATUS_MEMORY : STATUS_ACCEL, NULL,
			 "accelerator %s: its building %s%s%.255s; try another one (-a)", g->plugin->name,
			 text, err->text[0] ? ": " : "", err->text);
}

static enum status build_levels(struct geometry *g, const double *value, struct diag *diag)
{
	static const double none[1] = { 0 };
	double start = clock_seconds();

	for (uint32_t i = 0; i < g->set.level_count; i++) {
		struct view *v = &g->view[i];
		ald_error err = { "" };
		int result;

		if (!v->prims.count || v->accel)
			continue;
		result = g->plugin->build(&g->host.host, &v->prims, value ? value : none, &v->accel,
					  &err);
		process_arithmetic(); /* which a plugin should not, but may change */
		if (result || !v->accel) {
			err.text[sizeof(err.text) - 1] = 0;
			v->accel = NULL;
			return refuse(g, result ? result : ALD_FAILED, &err, diag);
		}
		if (ACCEL_HAS(g->plugin, scratch_size))
			v->scratch = g->plugin->scratch_size(v->accel);
		g->trees.built++;
	}
	g->seconds += clock_seconds() - start;
	g->memory.most = atomic_load(&g->book->recent);
	return STATUS_OK;
}

static enum status hire_workers(struct geometry *g, bool count, struct diag *diag)
{
	uint32_t levels = g->set.level_count;

	g->worker = mem_zalloc(g->book, "threads", mem_product(g->threads, sizeof(*g->worker)));
	for (uint32_t t = 0; g->worker && t < g->threads; t++) {
		struct worker *w = mem_alloc(g->book, "threads", sizeof(*w));

		g->worker[t] = w;
		if (w) {
			memset(w, 0, offsetof(struct worker, ray)); /* batches fill the rest */
			w->query = mem_zalloc(g->book, "threads", mem_product(levels, sizeof(*w->query)));
		}
		if (!w || !w->query)
			return diag_no_memory(diag, "a render thread", sizeof(*w));
		for (uint32_t i = 0; i < levels; i++) {
			struct query *q = &w->query[i];

			*q = (struct query){ { NULL, count ? w->count : NULL, t }, w };
			if (g->view[i].scratch)
				q->q.scratch = mem_zalloc(g->book, "accel: scratch", g->view[i].scratch);
			if (g->view[i].scratch && !q->q.scratch)
				return diag_no_memory(diag, "the accelerator's scratch memory",
						      g->view[i].scratch);
		}
	}
	return g->worker ? STATUS_OK : diag_no_memory(diag, "the render threads", g->threads * 8);
}

void geometry_dismiss(struct geometry *g)
{
	for (uint32_t t = 0; g->worker && t < g->threads; t++) {
		struct worker *w = g->worker[t];

		for (uint32_t i = 0; w && w->query && i < g->set.level_count; i++)
			mem_free(w->query[i].q.scratch);
		if (w)
			mem_free(w->query);
		mem_free(w);
	}
	mem_free(g->worker);
	g->worker = NULL;
}

void geometry_show(struct geometry *g)
{
	for (uint32_t i = 0; i < g->set.level_count; i++)
		show_level(&g->view[i], g, &g->set.level[i]);
}

enum status geometry_complete(struct geometry *g, const struct accel_choice *choice, bool count, struct diag *diag)
{
	enum status st;

	mem_book_mark(g->book);
	st = forecast_check(g, choice, diag);
	if (!st)
		st = build_levels(g, choice ? choice->value : NULL, diag);
	if (!st)
		st = hire_workers(g, count, diag);
	g->memory.kept = atomic_load(&g->book->now);
	return st;
}

enum status geometry_build(struct geometry **out, const struct scene *scene,
			   const struct accel_choice *choice, struct pool *pool, struct mem_book *book,
			   bool count, struct diag *diag)
{
	struct geometry *g = mem_zalloc(book, "geometry", sizeof(*g));
	enum status st;

	*out = NULL;
	if (!g)
		return diag_no_memory(diag, "the geometry", sizeof(*g));
	g->book = book;
	g->threads = pool_threads(pool);
	g->plugin = choice && choice->plugin ? choice->plugin : &accel_brute;
	g->precision = choice && choice->precision ? choice->precision : ALD_PRECISION_DEFAULT;
	accel_host_init(&g->host, book, pool, diag, g->plugin->name);
	g->host.host.rays = choice ? choice->rays : 0;
	st = prim_compile(&g->set, scene, book, diag);
	if (!st) {
		g->view = mem_zalloc(book, "geometry",
				     mem_product(g->set.level_count, sizeof(*g->view)));
		if (!g->view)
			st = diag_no_memory(diag, "the geometry", sizeof(*g->view));
	}
	if (!st) {
		geometry_show(g);
		st = geometry_complete(g, choice, count, diag);
	}
	if (st)
		geometry_free(g);
	else
		*out = g;
	return st;
}

enum status geometry_judge(struct geometry **out, const struct geometry *of, uint32_t precision, struct pool *pool,
			   struct diag *diag)
{
	struct geometry *g = mem_zalloc(of->book, "verification", sizeof(*g));
	enum status st = STATUS_OK;

	*out = NULL;
	if (!g)
		return diag_no_memory(diag, "verification", sizeof(*g));
	g->book = of->book;
	g->threads = of->threads;
	g->plugin = &accel_brute;
	g->set = of->set;
	g->borrowed = true;
	g->precision = precision;
	accel_host_init(&g->host, g->book, pool, diag, g->plugin->name);
	g->view = mem_zalloc(g->book, "verification", mem_product(g->set.level_count, sizeof(*g->view)));
	if (!g->view)
		st = diag_no_memory(diag, "verification", sizeof(*g->view));
	if (!st) {
		geometry_show(g);
		st = geometry_complete(g, NULL, false, diag);
	}
	if (st)
		geometry_free(g);
	else
		*out = g;
	return st;
}

bool geometry_reuse(struct geometry *g, const struct scene *scene)
{
	if (!g->hash)
		g->hash = scene_hash_shapes(g->set.scene);
	g->asked = scene_hash_shapes(scene);
	if (g->asked != g->hash || !prim_same_frame(&g->set, scene))
		return false;
	for (uint32_t t = 0; t < g->threads; t++)
		memset(g->worker[t]->count, 0, sizeof(g->worker[t]->count));
	g->seconds = 0;
	g->trees = (struct geometry_trees){ .kept = g->trees.kept + g->trees.refitted + g->trees.built };
	if (g->verify)
		verify_reset(g->verify);
	return true;
}

void geometry_free(struct geometry *g)
{
	if (!g)
		return;
	geometry_dismiss(g);
	for (uint32_t i = 0; g->view && i < g->set.level_count; i++) {
		if (g->view[i].accel)
			g->plugin->destroy(g->view[i].accel);
	}
	mem_free(g->view);
	verify_free(g->verify);
	if (!g->borrowed)
		prim_set_release(&g->set);
	accel_host_release(&g->host);
	mem_free(g);
}

void geometry_get_counts(const struct geometry *g, struct geometry_counts *c)
{
	const struct prim_level *w = &g->set.level[0];

	*c = (struct geometry_counts){ .triangles = w->tri_count,
				       .primitives = w->prim_count + w->piece_count,
				       .instances = w->instance_count,
				       .unbounded = g->set.unbounded_count,
				       .dropped = g->set.dropped,
				       .effective_triangles = w->tri_count,
				       .box = g->set.world,
				       .scale = w->scale,
				       .vertex_double = w->vertex_double };
	for (uint32_t i = 1; i < g->set.level_count; i++)
		c->triangles += g->set.level[i].tri_count;
	for (uint32_t i = 0; i < w->instance_count; i++)
		c->effective_triangles += g->set.level[w->instance[i].level].tri_count;
}

void geometry_get_counters(const struct geometry *g, uint64_t count[ALD_COUNT_MAX])
{
	for (unsigned i = 0; i < ALD_COUNT_MAX; i++) {
		count[i] = 0;
		for (uint32_t t = 0; t < g->threads; t++)
			count[i] += g->worker[t]->count[i];
	}
}

int geometry_stat(const struct geometry *g, uint32_t i, const char **name, double *value)
{
	if (!g->view[0].accel || !ACCEL_HAS(g->plugin, stat))
		return 0;
	return g->plugin->stat(g->view[0].accel, i, name, value);
}

void geometry_get_trees(const struct geometry *g, struct geometry_trees *out)
{
	*out = g->trees;
}

double geometry_build_seconds(const struct geometry *g)
{
	return g->seconds;
}

void geometry_get_memory(const struct geometry *g, struct geometry_memory *m)
{
	*m = g->memory;
}
