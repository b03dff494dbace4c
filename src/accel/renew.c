/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A geometry for an animation's next frame, with what it has of accelerators. The scene is compiled anew and nothing is
 * taken from the one before. An accelerator is kept if it was built over the same triangles, which then stay where
 * they are in memory, too; it is refitted if its level has as many of each kind.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <string.h>

#include "accel/geometry.h"
#include "accel/load.h"
#include "accel/verify.h"
#include "base/clock.h"
#include "base/process.h"

static bool equal(const void *a, const void *b, size_t n, size_t each)
{
	return a == b || (a && b && !memcmp(a, b, n * each));
}

/* Has the plugin seen the same ids, in the same groups? */
static bool alike(const struct prim_level *a, const struct prim_level *b)
{
	return a->count == b->count && a->tri_count == b->tri_count && a->prim_count == b->prim_count &&
	       a->piece_count == b->piece_count && a->instance_count == b->instance_count &&
	       a->group_count == b->group_count &&
	       equal(a->group_first, b->group_first, a->group_count + (size_t)1, sizeof(*a->group_first));
}

/* Of alike ones: has it seen the same all over? What else than triangles there is isn't looked at. */
static bool same(const struct prim_level *a, const struct prim_level *b)
{
	size_t each = a->vertex_double ? 3 * sizeof(double) : 3 * sizeof(float);

	return a->tri_count == a->count && a->vertex_count == b->vertex_count &&
	       a->vertex_double == b->vertex_double && a->pad == b->pad && equal(&a->box, &b->box, 1, sizeof(a->box)) &&
	       equal(a->index, b->index, a->tri_count, 3 * sizeof(*a->index)) &&
	       equal(a->mask, b->mask, a->count, sizeof(*a->mask)) &&
	       equal(a->vertex, b->vertex, a->vertex_count, each);
}

#define EXCHANGE(a, b)                                                                                                 \
	do {                                                                                                           \
		void *kept = (a);                                                                                      \
		(a) = (b);                                                                                             \
		(b) = kept;                                                                                            \
	} while (0)

/* A plugin may have kept where these are. */
static void keep_arrays(struct prim_level *from, struct prim_level *to)
{
	EXCHANGE(from->group_first, to->group_first);
	EXCHANGE(from->vertex, to->vertex);
	EXCHANGE(from->index, to->index);
	EXCHANGE(from->mask, to->mask);
}

static void drop(struct geometry *g, struct view *v)
{
	if (v->accel)
		g->plugin->destroy(v->accel);
	v->accel = NULL;
	v->scratch = 0;
}

enum fate { FATE_BUILD, FATE_REFIT, FATE_KEEP };

static enum fate fate_of(const struct geometry *g, const struct view *v, const struct prim_level *was,
			 const struct prim_level *is)
{
	if (!v->accel || !alike(was, is))
		return FATE_BUILD;
	if (same(was, is))
		return FATE_KEEP;
	return ACCEL_HAS(g->plugin, refit) ? FATE_REFIT : FATE_BUILD;
}

static enum status refit(struct geometry *g, struct view *v)
{
	ald_error err = { "" };
	int result = g->plugin->refit(v->accel, &err);

	process_arithmetic(); /* which a plugin should not, but may change */
	if (result) {
		drop(g, v);
		return result == ALD_CANCELLED ? STATUS_SIGINT : STATUS_OK;
	}
	g->trees.refitted++;
	if (ACCEL_HAS(g->plugin, scratch_size))
		v->scratch = g->plugin->scratch_size(v->accel);
	return STATUS_OK;
}

/* From the levels of the set before to those of the new one. */
static enum status pass_on(struct geometry *g, struct prim_set *was, enum fate *fate)
{
	double start = clock_seconds();
	enum status st = STATUS_OK;

	for (uint32_t i = 0; i < g->set.level_count; i++) {
		fate[i] = fate_of(g, &g->view[i], &was->level[i], &g->set.level[i]);
		if (fate[i] == FATE_KEEP)
			keep_arrays(&was->level[i], &g->set.level[i]);
		else if (fate[i] == FATE_BUILD)
			drop(g, &g->view[i]);
	}
	prim_set_release(was);
	geometry_show(g);
	for (uint32_t i = 0; i < g->set.level_count && !st; i++) {
		g->trees.kept += fate[i] == FATE_KEEP;
		if (fate[i] == FATE_REFIT)
			st = refit(g, &g->view[i]);
	}
	g->seconds = clock_seconds() - start;
	return st;
}

/* No level is known again. */
static enum status start_over(struct geometry *g, struct prim_set *was)
{
	for (uint32_t i = 0; i < was->level_count; i++)
		drop(g, &g->view[i]);
	prim_set_release(was);
	mem_free(g->view);
	g->view = mem_zalloc(g->book, "geometry", mem_product(g->set.level_count, sizeof(*g->view)));
	if (!g->view)
		return STATUS_MEMORY;
	geometry_show(g);
	g->seconds = 0;
	return STATUS_OK;
}

static enum status exchange(struct geometry *g, struct prim_set *was)
{
	enum fate *fate;
	enum status st;

	g->trees = (struct geometry_trees){ .built = 0 };
	if (g->set.level_count != was->level_count)
		return start_over(g, was);
	fate = mem_alloc(g->book, "geometry", mem_product(g->set.level_count, sizeof(*fate)));
	st = fate ? pass_on(g, was, fate) : STATUS_MEMORY;
	mem_free(fate);
	return st;
}

enum status geometry_renew(struct geometry *g, const struct scene *scene, const struct accel_choice *choice, bool count,
			   struct diag *diag)
{
	struct diag silent = { 0 };
	struct prim_set was = g->set;
	enum status st;

	geometry_dismiss(g);
	verify_free(g->verify);
	g->verify = NULL;
	g->hash = g->asked;
	g->asked = 0;
	g->host.host.rays = choice ? choice->rays : 0;
	st = prim_compile(&g->set, scene, g->book, &silent);
	if (st) {
		g->set = was;
		return st;
	}
	st = exchange(g, &was);
	if (!st)
		st = geometry_complete(g, choice, count, &silent);
	prim_set_release(&was);
	if (!st)
		prim_report_dropped(&g->set, diag);
	return st;
}
