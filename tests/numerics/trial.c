/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "trial.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "accel/geometry.h"

static void say(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	(void)arg;
	(void)pos;
	if (level != DIAG_WARNING) /* dropped primitives are counted elsewhere */
		printf("# %s\n", text);
}

bool trial_tools_init(struct trial_tools *t, const char *const *accel, uint32_t precision)
{
	struct diag d = { .sink = say };

	memset(t, 0, sizeof(*t));
	mem_book_init(&t->book, 0);
	t->pool = pool_new(1);
	t->precision = precision;
	for (; *accel; accel++) {
		struct accel_choice *c = &t->choice[t->accels];

		if (t->accels == TRIAL_ACCELS || accel_load(c, *accel, &d))
			return false;
		if (accel_set_precision(c, precision, &d)) /* said so */
			accel_unload(c);
		else
			t->name[t->accels++] = *accel;
	}
	return t->pool && t->accels;
}

void trial_tools_release(struct trial_tools *t)
{
	for (uint32_t i = 0; i < t->accels; i++)
		accel_unload(&t->choice[i]);
	pool_free(t->pool);
}

static void make_scene(struct trial *t)
{
	struct mem_book *book = &t->tools->book;
	uint32_t i, o;
	struct mesh *m;

	scene_init(&t->scene, book);
	i = scene_add_mesh(&t->scene);
	m = &t->scene.mesh[i];
	m->vertex_count = t->soup->vertices;
	m->triangle_count = t->soup->triangles;
	m->vertex = mem_alloc(book, "mesh", m->vertex_count * sizeof(vec));
	m->index = mem_alloc(book, "mesh", m->triangle_count * sizeof(t->soup->triangle[0]));
	memcpy(m->vertex, t->soup->vertex, m->vertex_count * sizeof(vec));
	memcpy(m->index, t->soup->triangle, m->triangle_count * sizeof(t->soup->triangle[0]));
	o = scene_add_object(&t->scene);
	t->scene.object[o].kind = SHAPE_MESH;
	t->scene.object[o].shape.mesh = i;
	scene_add_root(&t->scene, o);
}

bool trial_begin(struct trial *t, struct trial_tools *tools, const struct soup *soup)
{
	struct diag d = { .sink = say };

	memset(t, 0, sizeof(*t));
	t->tools = tools;
	t->soup = soup;
	t->diameter = soup_diameter(soup);
	t->delta = fmax(1e-5 * t->diameter, 8 * DBL_EPSILON * soup_largest(soup));
	t->oracle = oracle_new(soup);
	make_scene(t);
	for (uint32_t i = 0; i < tools->accels; i++) {
		if (geometry_build(&t->geometry[i], &t->scene, &tools->choice[i], tools->pool, &tools->book,
				   false, &d))
			return false;
	}
	return true;
}

void trial_end(struct trial *t)
{
	for (uint32_t i = 0; i < t->tools->accels; i++)
		geometry_free(t->geometry[i]);
	scene_release(&t->scene);
	oracle_free(t->oracle);
}

uint32_t trial_triangle(const struct trial *t, const ald_hit *hit)
{
	uint32_t face;

	view_leaf(&t->geometry[0]->set.level[0], hit->prim, &face);
	return face;
}

/* What the eight rays about r find: how many hit, and how many of those near depth (in units of length). */
static void ask_around(struct trial *t, const ald_ray *r, double depth, unsigned *hits, unsigned *near)
{
	double length = vec_length(r->dir), step = t->delta / sqrt(3);

	*hits = *near = 0;
	for (unsigned i = 0; i < 8; i++) {
		ald_ray q = *r;
		struct truth truth;

		q.org = vec_add(q.org, vec_make(i & 1 ? step : -step, i & 2 ? step : -step,
						i & 4 ? step : -step));
		oracle_ask(t->oracle, &q, &truth);
		*hits += truth.hit;
		*near += truth.hit && fabs(truth.t * length - depth) <= 1e-3 * t->diameter;
	}
}

static void judge(struct trial *t, const ald_ray *r, const ald_hit *hit, struct tally *n)
{
	double length = vec_length(r->dir);
	bool found = hit->prim != ALD_NONE;
	unsigned hits, near;
	struct truth truth, plain;

	if (n->rays % PLAIN_SHARE == 0) {
		oracle_ask_all(t->oracle, r, &plain);
		oracle_ask(t->oracle, r, &truth);
		n->plain++;
		n->unlike_plain += !truth_same(&plain, &truth);
	} else {
		oracle_ask(t->oracle, r, &truth);
	}
	n->rays++;
	n->hits += truth.hit;
	if (!found && !truth.hit)
		return;
	if (found && truth.hit && t->sheet)
		n->wrong_sheet += (trial_triangle(t, hit) < t->sheet) != (truth.tie[0] < t->sheet);
	if (found && truth.hit && fabs(hit->t - truth.t) * length <= 1e-3 * t->diameter) {
		n->neighbours += !truth_has(&truth, trial_triangle(t, hit));
		n->wrong_ids += trial_triangle(t, hit) != truth.tie[0];
		n->t_error = fmax(n->t_error, oracle_error(t->oracle, hit->t));
		return;
	}
	ask_around(t, r, truth.t * length, &hits, &near);
	if (!found && hits == 8)
		n->leaks++;
	else if (found && truth.hit && near == 8)
		n->through++;
	else if (found && !truth.hit && hits == 0)
		n->ghosts++;
	else
		n->silhouettes++;
}

/* However many rays a call has, the answers are the same: the first of them again, in small calls. */
static uint64_t unlike_in_pieces(const struct geometry *g, const ald_ray *ray, const ald_hit *want, uint32_t n)
{
	static const uint32_t size[] = { 1, 1, 12, 1, 5, 13, 1, 2, 30 };
	uint64_t unlike = 0;
	ald_hit hit[30];

	for (uint32_t i = 0, k = 0; i + size[k] <= n; k = (k + 1) % (sizeof(size) / sizeof(size[0]))) {
		trace_nearest(g, 0, ray + i, hit, size[k], 0);
		for (uint32_t j = 0; j < size[k]; j++)
			unlike += memcmp(&hit[j], &want[i + j], sizeof(*hit)) != 0;
		i += size[k];
	}
	return unlike;
}

void trial_run(struct trial *t, uint32_t n, trial_ray *make, void *arg, struct tally *tally)
{
	static ald_ray ray[TRIAL_BATCH];
	static ald_hit first[TRIAL_BATCH], hit[TRIAL_BATCH];

	for (uint32_t done = 0; done < n; done += TRIAL_BATCH) {
		uint32_t m = n - done < TRIAL_BATCH ? n - done : TRIAL_BATCH;

		for (uint32_t i = 0; i < m; i++)
			make(arg, done + i, &ray[i]);
		trace_nearest(t->geometry[0], 0, ray, first, m, 0);
		for (uint32_t a = 1; a < t->tools->accels; a++) {
			trace_nearest(t->geometry[a], 0, ray, hit, m, 0);
			for (uint32_t i = 0; i < m; i++)
				tally->unlike += memcmp(&hit[i], &first[i], sizeof(hit[i])) != 0;
		}
		for (uint32_t a = 0; a < t->tools->accels; a++)
			tally->unlike += unlike_in_pieces(t->geometry[a], ray, first, m / 4);
		for (uint32_t i = 0; i < m; i++)
			judge(t, &ray[i], &first[i], tally);
	}
}
