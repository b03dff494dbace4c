/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Scenes through geometry_build() and the three questions, by brute force.
 */
#include "mesh_fixture.h"

/* n x n squares in the plane z = 0 over [0, 1]^2, two triangles each. */
static uint32_t grid_mesh(struct world *w, uint32_t n)
{
	uint32_t i = scene_add_mesh(&w->scene);
	struct mesh *m = &w->scene.mesh[i];
	uint32_t k = 0;

	m->vertex_count = (n + 1) * (n + 1);
	m->triangle_count = 2 * n * n;
	m->vertex = mem_alloc(&w->book, "mesh", m->vertex_count * 3 * sizeof(double));
	m->index = mem_alloc(&w->book, "mesh", m->triangle_count * 3 * sizeof(uint32_t));
	for (uint32_t y = 0; y <= n; y++) {
		for (uint32_t x = 0; x <= n; x++) {
			double *v = m->vertex + 3 * (y * (n + 1) + x);

			v[0] = (double)x / n;
			v[1] = (double)y / n;
			v[2] = 0;
		}
	}
	for (uint32_t y = 0; y < n; y++) {
		for (uint32_t x = 0; x < n; x++) {
			uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
			const uint32_t t[6] = { a, b, d, a, d, c };

			memcpy(m->index + k, t, sizeof(t));
			k += 6;
		}
	}
	return i;
}

static void spheres_planes_and_order(void **state)
{
	struct surface s;
	struct world w;
	struct object *o;
	ald_ray r;
	ald_hit h;

	(void)state;
	begin(&w);
	add_sphere(&w, vec_make(0, 0, 5), 1);
	o = add(&w, SHAPE_PLANE);
	o->shape.plane.normal = vec_make(0, 1, 0);
	o->shape.plane.distance = -1;
	add_sphere(&w, vec_make(0, 0, 5), 1); /* the same once more */
	build(&w);
	r = ray(vec_make(0, 0, 0), vec_make(0, 0, 2));
	h = nearest(&w, &r);
	assert_int_equal(h.prim, 0);
	assert_true(fabs(h.t - 2) < 1e-15);
	surface_at(w.g, &r, &h, &s);
	assert_true(fabs(s.p.z - 4) < 1e-14 && fabs(s.n.z + 1) < 1e-14);
	/* Front, front, back, back, nothing. */
	for (unsigned i = 0; i < 4; i++) {
		assert_int_equal(h.prim, i & 1);
		assert_true(fabs(h.t - (i < 2 ? 2 : 3)) < 1e-14);
		trace_after(&r, &h);
		h = nearest(&w, &r);
	}
	assert_int_equal(h.prim, ALD_NONE);
	r = ray(vec_make(3, 0, 0), vec_make(0, -1, 0));
	h = nearest(&w, &r);
	assert_int_equal(h.prim, 2);
	assert_true(h.t == 1);
	surface_at(w.g, &r, &h, &s);
	assert_int_equal(s.object, 1);
	assert_true(s.p.y == -1 && s.n.y == 1 && s.planar);
	r.skip = h.prim;
	h = nearest(&w, &r);
	assert_int_equal(h.prim, ALD_NONE);
	end(&w);
}

static void instances_equal_baked(void **state)
{
	struct world w[2];
	uint8_t hid[2];

	(void)state;
	for (unsigned i = 0; i < 2; i++) {
		begin(&w[i]);
		uint32_t a = grid_mesh(&w[i], 7);

		for (unsigned k = 0; k < 3; k++) {
			uint32_t m = i && k ? grid_mesh(&w[i], 7) : a;
			struct object *o = add(&w[i], SHAPE_MESH);
			struct xform x = xform_rotate(vec_make(10.0 * k, 20, 5)), y;

			o->shape.mesh = m;
			y = xform_scale(vec_make(1, 1.5, k == 2 ? -1 : 1));
			x = xform_mul(&y, &x);
			y = xform_translate(vec_make(0.1, 0.2, 3 + k));
			o->place = xform_mul(&x, &y);
		}
		build(&w[i]);
	}
	struct geometry_counts c;

	geometry_get_counts(w[0].g, &c);
	assert_int_equal(c.instances, 3);
	assert_int_equal(c.effective_triangles, 3 * 98);
	geometry_get_counts(w[1].g, &c);
	assert_int_equal(c.instances, 0);
	for (unsigned k = 0; k < 5000; k++) {
		double a = (k % 71) / 35.0 - 0.5, b = (k % 83) / 41.0 - 0.5;
		ald_ray r[2];
		ald_hit h[2];
		struct surface s[2];

		for (unsigned i = 0; i < 2; i++) {
			r[i] = ray(vec_make(a, b, -1), vec_make(0.1 * b, -0.2 * a, 1));
			trace_occluded(w[i].g, 0, &r[i], &hid[i], 1, 0);
		}
		assert_int_equal(hid[0], hid[1]);
		for (unsigned step = 0; step < 4; step++) {
			for (unsigned i = 0; i < 2; i++) {
				h[i] = nearest(&w[i], &r[i]);
				if (h[i].prim != ALD_NONE)
					surface_at(w[i].g, &r[i], &h[i], &s[i]);
				trace_after(&r[i], &h[i]);
			}
			assert_int_equal(h[0].prim == ALD_NONE, h[1].prim == ALD_NONE);
			if (h[0].prim == ALD_NONE)
				break;
			assert_int_equal(s[0].object, s[1].object);
			assert_true(fabs(h[0].t - h[1].t) < 1e-13);
			assert_true(vec_length(vec_sub(s[0].p, s[1].p)) < 1e-13);
			assert_true(vec_dot(s[0].n, s[1].n) > 1 - 1e-13);
		}
	}
	end(&w[0]);
	end(&w[1]);
}

static void bad_rays_miss(void **state)
{
	const double bad[] = { ALD_NAN, ALD_INF, -ALD_INF };
	struct world w;
	uint8_t hidden;

	(void)state;
	begin(&w);
	add_sphere(&w, vec_make(0, 0, 5), 1);
	add(&w, SHAPE_MESH)->shape.mesh = grid_mesh(&w, 2);
	add(&w, SHAPE_PLANE)->shape.plane.normal = vec_make(0, 0, 1);
	build(&w);
	for (unsigned i = 0; i < 3; i++) {
		for (unsigned k = 0; k < 6; k++) {
			ald_ray r = ray(vec_make(0.2, 0.3, -1), vec_make(0, 0, 1));

			(&(k < 3 ? &r.org : &r.dir)->x)[k % 3] = bad[i];
			assert_int_equal(nearest(&w, &r).prim, ALD_NONE);
			trace_occluded(w.g, 0, &r, &hidden, 1, 0);
			assert_int_equal(hidden, 0);
		}
	}
	end(&w);
}

static void inside_tests(void **state)
{
	struct world w;
	struct object *o;
	struct solid in[8];

	(void)state;
	begin(&w);
	add_sphere(&w, vec_make(0, 0, 0), 2);
	o = add(&w, SHAPE_BOX);
	o->shape.box.lo = vec_make(-1, -1, -1);
	o->shape.box.hi = vec_make(1, 1, 1);
	o->flags = OBJECT_INVERSE;
	o = add(&w, SHAPE_CONE);
	o->shape.cone.base = vec_make(0, -3, 0);
	o->shape.cone.apex = vec_make(0, 3, 0);
	o->shape.cone.base_radius = 1;
	o = add(&w, SHAPE_TORUS);
	o->shape.torus.major = 1;
	o->shape.torus.minor = 0.25;
	o = add(&w, SHAPE_PLANE);
	o->shape.plane.normal = vec_make(0, 1, 0);
	build(&w);
	assert_int_equal(geometry_inside(w.g, vec_make(0, 0, 0), in, 8), 3);
	assert_int_equal(in[0].leaf, 0);
	assert_int_equal(in[1].leaf, 2);
	assert_int_equal(in[2].leaf, 4);
	assert_int_equal(geometry_inside(w.g, vec_make(1.2, 0.1, 0), in, 8), 3);
	assert_int_equal(in[0].leaf, 0);
	assert_int_equal(in[1].leaf, 1);
	assert_int_equal(in[2].leaf, 3);
	end(&w);
}

static struct shell shell;

static uint32_t shell_mesh(struct world *w, double scale)
{
	uint32_t i = scene_add_mesh(&w->scene);
	struct mesh *m = &w->scene.mesh[i];

	m->vertex_count = shell.vertices;
	m->triangle_count = shell.triangles;
	m->vertex = mem_alloc(&w->book, "mesh", shell.vertices * 3 * sizeof(double));
	m->index = mem_alloc(&w->book, "mesh", shell.triangles * 3 * sizeof(uint32_t));
	for (uint32_t k = 0; k < shell.vertices; k++) {
		m->vertex[3 * k] = shell.v[k].x * scale;
		m->vertex[3 * k + 1] = shell.v[k].y * scale;
		m->vertex[3 * k + 2] = shell.v[k].z * scale;
	}
	memcpy(m->index, shell.t, shell.triangles * sizeof(shell.t[0]));
	return i;
}

/* Two round shells with a thin gap between them, of radius size, far from the origin: rays that leave the
 * inner one meet the outer one and nothing else. */
static void leave_shells(double size, double far, double gap, unsigned instanced)
{
	const struct xform place = xform_translate(vec_scale(vec_make(0.6, -0.64, 0.48), far * size));
	uint64_t seed = 17;
	struct world w;
	uint32_t inner;

	begin(&w);
	shell_sphere(&shell, 12, 0x1p30, 0, &seed);
	inner = shell_mesh(&w, size * 0x1p-30);
	for (unsigned k = 0; k < 2; k++) {
		struct xform x = xform_scale(k ? vec_make(1 + gap, 1 + gap, 1 + gap) : vec_make(1, 1, 1));
		struct object *o = add(&w, SHAPE_MESH);
		uint32_t mesh = k && !instanced ? shell_mesh(&w, size * 0x1p-30) : inner;

		o = &w.scene.object[k];
		o->shape.mesh = mesh;
		o->place = xform_mul(&x, &place);
	}
	build(&w);
	for (unsigned i = 0; i < 1000; i++) {
		vec centre = vec_make(place.fwd.m[3][0], place.fwd.m[3][1], place.fwd.m[3][2]);
		ald_ray r = ray(vec_mad(centre, random_vec(&seed), 0.1 * size), random_unit(&seed));
		ald_hit h = nearest(&w, &r);
		struct surface s;

		assert_true(h.prim != ALD_NONE);
		surface_at(w.g, &r, &h, &s);
		assert_int_equal(s.object, 0);
		/* The gap is along the normal: less for flat faces, but far more than the error. */
		assert_true(s.error < 0.1 * gap * size);
		if (vec_dot(s.n, r.dir) < 0)
			s.n = vec_neg(s.n);
		r = ray(vec_mad(s.p, s.n, s.error), random_unit(&seed));
		if (vec_dot(r.dir, s.n) < 0)
			r.dir = vec_neg(r.dir);
		if (s.planar)
			r.skip = h.prim;
		h = nearest(&w, &r);
		assert_true(h.prim != ALD_NONE);
		surface_at(w.g, &r, &h, &s);
		assert_int_equal(s.object, 1);
		r = ray(vec_mad(s.p, s.n, (vec_dot(s.n, r.dir) < 0 ? -1 : 1) * s.error), r.dir);
		r.skip = s.planar ? h.prim : ALD_NONE;
		assert_int_equal(nearest(&w, &r).prim, ALD_NONE);
	}
	end(&w);
}

static void secondary_rays_leave_meshes(void **state)
{
	(void)state;
	for (unsigned instanced = 0; instanced < 2; instanced++) {
		for (int e = -6; e <= 6; e += 3) {
			leave_shells(pow(10, e), 0, 1e-6, instanced);
			leave_shells(pow(10, e), 1e3, 1e-6, instanced);
			leave_shells(pow(10, e), 1e6, 1e-4, instanced);
		}
		leave_shells(1e-30, 0, 1e-6, instanced);
		leave_shells(1e30, 0, 1e-6, instanced);
	}
}

/* Coincident surfaces: each is seen once, in the order of ids, whatever they are. */
static void walks_lose_nothing(void **state)
{
	uint64_t seed = 23;
	struct world w;

	(void)state;
	begin(&w);
	shell_sphere(&shell, 6, 0x1p30, 0, &seed);
	uint32_t mesh = shell_mesh(&w, 0x1p-30), copy = shell_mesh(&w, 0x1p-30);

	for (unsigned k = 0; k < 5; k++) {
		struct object *o = add(&w, SHAPE_MESH);

		o->shape.mesh = k < 3 ? mesh : copy; /* three instances, then two more */
	}
	for (unsigned k = 0; k < 3; k++)
		add_sphere(&w, vec_make(0, 0, 0), 0.5);
	build(&w);
	for (unsigned i = 0; i < 3000; i++) {
		ald_ray r = ray(vec_scale(random_unit(&seed), 3), vec_make(0, 0, 0));
		unsigned hits[8] = { 0 };
		double last = -1;

		/* Every fourth through a vertex: then each mesh is met several times at one t. */
		r.dir = vec_sub(i % 4 ? vec_scale(random_vec(&seed), 0.4) :
					vec_scale(shell.v[i % shell.vertices], 0x1p-30), r.org);
		for (unsigned n = 0;; n++) {
			ald_hit h = nearest(&w, &r);
			struct surface s;

			assert_true(n < 200);
			if (h.prim == ALD_NONE)
				break;
			surface_at(w.g, &r, &h, &s);
			assert_true(h.t >= last);
			last = h.t;
			hits[s.object]++;
			trace_after(&r, &h);
		}
		for (unsigned k = 1; k < 5; k++)
			assert_int_equal(hits[k], hits[0]);
		assert_true(hits[0] >= 2 || i % 4 == 0);
		assert_int_equal(hits[5], hits[6]);
		assert_int_equal(hits[5], hits[7]);
		assert_int_equal(hits[5] & 1, 0);
	}
	end(&w);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(spheres_planes_and_order),
		cmocka_unit_test(instances_equal_baked),
		cmocka_unit_test(bad_rays_miss),
		cmocka_unit_test(inside_tests),
		cmocka_unit_test(secondary_rays_leave_meshes),
		cmocka_unit_test(walks_lose_nothing),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
