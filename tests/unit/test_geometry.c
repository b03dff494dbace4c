/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A crowded scene of every kind of primitive, instances and planes among them: all accelerators answer as
 * brute force does, to the bit, on rays that are mostly hostile; in batches, one by one, and on walks.
 */
#include <stdio.h>
#include <stdlib.h>

#include "accel/load.h"
#include "mesh_fixture.h"
#include "scene/function.h"

#define RAYS 2048u

static const char *const spec[] = { "none", "box", "sphere", "octree", "octree:leaf=1,depth=6,price=0", "bvh8" };
enum { SPECS = sizeof(spec) / sizeof(spec[0]) };

static struct shell shell;

static uint32_t shell_mesh(struct world *w)
{
	uint32_t i = scene_add_mesh(&w->scene);
	struct mesh *m = &w->scene.mesh[i];

	m->vertex_count = shell.vertices;
	m->triangle_count = shell.triangles;
	m->vertex = mem_alloc(&w->book, "mesh", shell.vertices * 3 * sizeof(double));
	m->index = mem_alloc(&w->book, "mesh", shell.triangles * 3 * sizeof(uint32_t));
	for (uint32_t k = 0; k < shell.vertices; k++) {
		m->vertex[3 * k] = shell.v[k].x / 1000;
		m->vertex[3 * k + 1] = shell.v[k].y / 1000;
		m->vertex[3 * k + 2] = shell.v[k].z / 1000;
	}
	memcpy(m->index, shell.t, shell.triangles * sizeof(shell.t[0]));
	return i;
}

static struct xform some_place(uint64_t *seed, unsigned kind, double size)
{
	struct xform x = xform_rotate(vec_scale(random_vec(seed), kind & 1 ? 180 : 0));
	struct xform y = xform_scale(kind & 2 ? vec_make(1, -0.3, 2) : vec_make(1, 1, 1));

	x = xform_mul(&x, &y);
	y = xform_scale(vec_make(size, size, size));
	x = xform_mul(&x, &y);
	y = xform_translate(vec_scale(random_vec(seed), 3 * size));
	return xform_mul(&x, &y);
}

static uint32_t some_sweep(struct world *w, enum sweep_kind kind, uint64_t *seed)
{
	uint32_t i = scene_add_sweep(&w->scene, 6);

	w->scene.sweep[i].kind = kind;
	for (unsigned n = 0; n < 6; n++) {
		for (unsigned k = 0; k < 3; k++)
			w->scene.sweep[i].point[n][k] = signed_uniform(seed);
		w->scene.sweep[i].point[n][3] = 0.3 * uniform(seed);
	}
	return i;
}

static uint32_t some_lathe(struct world *w, enum lathe_kind kind, uint64_t *seed)
{
	uint32_t i = scene_add_lathe(&w->scene, 6);

	w->scene.lathe[i].kind = kind;
	for (unsigned n = 0; n < 6; n++) {
		w->scene.lathe[i].point[n][0] = uniform(seed);
		w->scene.lathe[i].point[n][1] = signed_uniform(seed);
	}
	return i;
}

/* Not quite a curve: pieces that end where others begin, or do not. */
static uint32_t some_prism(struct world *w, enum lathe_kind kind, uint64_t *seed)
{
	uint32_t i = scene_add_prism(&w->scene, 16);
	struct prism *p = &w->scene.prism[i];

	p->kind = kind;
	p->conic = kind == LATHE_CUBIC;
	p->lo = -0.5;
	p->hi = 0.7;
	for (unsigned n = 0; n < 16; n++) {
		p->point[n][0] = signed_uniform(seed);
		p->point[n][1] = signed_uniform(seed);
	}
	return i;
}

/* x^2 + y^2 + z. */
static uint32_t some_isosurface(struct world *w)
{
	static struct function_op op[] = {
		{ OP_MUL, 3, 0, 0 }, { OP_MUL, 4, 1, 1 }, { OP_ADD, 3, 3, 4 }, { OP_ADD, 3, 3, 2 },
	};
	static const struct function paraboloid = {
		.params = 3, .results = 1, .registers = 5, .total = 5,
		.is.program = { .op_count = 4, .op = op, .result = 3 },
	};
	struct isosurface iso = { .function = &paraboloid, .threshold = 0.3, .accuracy = 1e-4,
				  .max_gradient = 4, .lo = { -1, -1, -1 }, .hi = { 1, 1, 1 } };

	return scene_add_isosurface(&w->scene, &iso);
}

/* x^2 - y^2 z + z = 0.2. */
static uint32_t some_algebraic(struct world *w)
{
	uint32_t i = scene_add_algebraic(&w->scene, 3);
	double *term = w->scene.algebraic[i].term;

	term[3 + 1 + 2] = 1; /* x^3 and its like come first: x^2 y, x^2 z, x^2 */
	term[11] = -1;
	term[18] = 1;
	term[19] = -0.2;
	return i;
}

static uint32_t some_blob(struct world *w, uint64_t *seed)
{
	uint32_t i = scene_add_blob(&w->scene, 5);

	w->scene.blob[i].threshold = 0.5;
	for (unsigned n = 0; n < 5; n++) {
		struct blob_part *p = &w->scene.blob[i].part[n];

		p->cylinder = n & 1;
		p->base = random_vec(seed);
		p->apex = random_vec(seed);
		p->radius = 0.3 + uniform(seed);
		p->strength = n == 3 ? -1 : 1 + uniform(seed);
	}
	return i;
}

static void crowd(struct world *w, double size)
{
	uint64_t seed = 11;
	uint32_t shared, once;

	begin(w);
	shell_sphere(&shell, 6, 1000, 0.2, &seed);
	shared = shell_mesh(w);
	once = shell_mesh(w);
	for (unsigned i = 0; i < 7 * SHAPE_UNION; i++) {
		enum shape_kind kind = (enum shape_kind)(i % SHAPE_UNION);
		struct object *o = add(w, kind);

		/* Every other one lies where the one before it does. */
		o->place = i & 8 ? o[-8].place : some_place(&seed, i, size);
		o->flags = i % 7 == 3 ? OBJECT_NO_IMAGE : i % 7 == 5 ? OBJECT_NO_SHADOW : 0;
		if (kind == SHAPE_MESH)
			o->shape.mesh = i == 4 * SHAPE_UNION ? once : shared;
		else if (kind == SHAPE_SPHERE)
			o->shape.sphere.radius = 1;
		else if (kind == SHAPE_BOX)
			o->shape.box.hi = vec_make(1, 0.5, i & 16 ? 0 : 1);
		else if (kind == SHAPE_PLANE)
			o->shape.plane.normal = vec_make(0, 1, 0);
		else if (kind == SHAPE_TORUS)
			o->shape.torus.major = 1;
		if (kind == SHAPE_TORUS)
			o->shape.torus.minor = 0.3;
		if (kind == SHAPE_CONE) {
			o->shape.cone.apex = vec_make(0, 1, 0);
			o->shape.cone.base_radius = 1;
			o->shape.cone.open = i & 16;
		}
		if (kind == SHAPE_SUPERELLIPSOID)
			o->shape.superellipsoid.a = 0.5 + i / 100.0, o->shape.superellipsoid.b = 1.5;
		if (kind == SHAPE_LATHE)
			o->shape.lathe.index = some_lathe(w, i & 16 ? LATHE_CUBIC : LATHE_LINEAR, &seed);
		if (kind == SHAPE_PRISM)
			o->shape.prism.index = some_prism(w, i & 16 ? LATHE_CUBIC : LATHE_LINEAR, &seed);
		if (kind == SHAPE_ISOSURFACE)
			o->shape.isosurface = some_isosurface(w);
		if (kind == SHAPE_ALGEBRAIC)
			o->shape.algebraic = some_algebraic(w);
		if (kind == SHAPE_BLOB)
			o->shape.blob = some_blob(w, &seed);
		if (kind == SHAPE_SWEEP)
			o->shape.sweep = some_sweep(w, i & 16 ? SWEEP_CUBIC : SWEEP_LINEAR, &seed);
		if (kind == SHAPE_DISC) {
			o->shape.disc.normal = vec_make(0, 1, 0);
			o->shape.disc.radius = 1;
		}
	}
}

static ald_ray hostile(uint64_t *seed, unsigned i, double size)
{
	ald_ray r = ray(vec_scale(random_vec(seed), size * (i % 16 == 9 ? 1e4 : 5)), random_unit(seed));
	vec to = vec_scale(random_vec(seed), 3 * size);

	if (i % 3 == 0)
		r.dir = vec_sub(to, r.org);
	if (i % 5 == 1) /* along an axis, in a lattice plane */
		(&r.dir.x)[i % 3] = (&r.dir.x)[(i + 1) % 3] = i & 1 ? 0.0 : -0.0;
	if (i % 5 == 2)
		r.org.y = 0;
	if (i % 7 == 3)
		(&r.dir.x)[i % 3] = 0;
	if (i % 11 == 5)
		r.dir = vec_scale(r.dir, 1e-9);
	r.mask = i % 4 == 3 ? TRACE_CAMERA : i % 4 == 2 ? TRACE_SHADOW_OPAQUE : ~0u;
	r.tmin = i % 13 == 0 ? -ALD_INF : 0;
	r.tmax = i % 6 == 0 ? size : ALD_INF;
	return r;
}

static void same_hits(double size)
{
	static ald_ray rays[RAYS];
	static ald_hit want[RAYS], got[RAYS];
	static uint8_t hidden[RAYS], also[RAYS];
	struct world w[SPECS + 1];
	struct accel_choice *choice = malloc(SPECS * sizeof(*choice));
	uint64_t seed = 5, hits = 0;

	assert_non_null(choice);
	for (unsigned k = 0; k <= SPECS; k++) {
		struct accel_choice *c = k ? &choice[k - 1] : NULL;

		crowd(&w[k], size);
		if (c)
			assert_int_equal(accel_load(c, spec[k - 1], &w[k].diag), STATUS_OK);
		assert_int_equal(geometry_build(&w[k].g, &w[k].scene, c, w[k].pool, &w[k].book, k & 1,
						&w[k].diag), STATUS_OK);
	}
	for (unsigned i = 0; i < RAYS; i++)
		rays[i] = hostile(&seed, i, size);
	for (unsigned step = 0; step < 12; step++) {
		trace_nearest(w[0].g, 0, rays, want, RAYS, 0);
		trace_occluded(w[0].g, 0, rays, hidden, RAYS, 0);
		for (unsigned k = 1; k <= SPECS; k++) {
			trace_nearest(w[k].g, 0, rays, got, RAYS, 0);
			trace_occluded(w[k].g, 0, rays, also, RAYS, 0);
			for (unsigned i = 0; i < RAYS; i++) {
				if (want[i].prim == ALD_NONE ? got[i].prim != ALD_NONE :
							       memcmp(&want[i], &got[i], sizeof(got[i])) != 0)
					fail_msg("%s, ray %u, step %u: %u at %a, brute force %u at %a",
						 spec[k - 1], i, step, got[i].prim, got[i].t,
						 want[i].prim, want[i].t);
				assert_int_equal(hidden[i], also[i]);
			}
			for (unsigned i = step; i < RAYS; i += 17) {
				trace_nearest(w[k].g, 0, &rays[i], got, 1, 0);
				assert_int_equal(got[0].prim, want[i].prim);
				assert_true(got[0].prim == ALD_NONE || got[0].t == want[i].t);
			}
		}
		for (unsigned i = 0; i < RAYS; i++) {
			assert_int_equal(hidden[i], want[i].prim != ALD_NONE);
			hits += hidden[i];
			if (hidden[i])
				trace_after(&rays[i], &want[i]);
			else
				rays[i].tmax = rays[i].tmin;
		}
	}
	assert_true(hits > 3 * RAYS);
	for (unsigned k = 0; k <= SPECS; k++) {
		end(&w[k]);
		if (k)
			accel_unload(&choice[k - 1]);
	}
	free(choice);
}

static void every_accelerator_agrees(void **state)
{
	(void)state;
	same_hits(1);
	same_hits(1e-5);
	same_hits(1e7);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_accelerator_agrees),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
