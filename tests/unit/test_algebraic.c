/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Surfaces of polynomials: against shapes that have tests of their own, at every scale; where lines begin; infinite
 * ones as planes and in solids.
 */
#include "prim/prim.h"

#include "world_fixture.h"

static uint32_t index_of(uint32_t degree, uint32_t x, uint32_t y, uint32_t z)
{
	uint32_t n = 0;

	for (uint32_t i = degree + 1; i--;) {
		for (uint32_t j = degree - i + 1; j--;) {
			for (uint32_t k = degree - i - j + 1; k--;) {
				if (i == x && j == y && k == z)
					return n;
				n++;
			}
		}
	}
	return SCENE_NONE;
}

static void put(struct algebraic *f, uint32_t x, uint32_t y, uint32_t z, double c)
{
	f->term[index_of(f->degree, x, y, z)] = c;
}

/* x^n + y^n + z^n = 1. */
static void ball_of(struct algebraic *f, uint32_t degree, double *term)
{
	*f = (struct algebraic){ degree, 1, term };
	memset(term, 0, algebraic_terms(degree) * sizeof(*term));
	put(f, degree, 0, 0, 1);
	put(f, 0, degree, 0, 1);
	put(f, 0, 0, degree, 1);
	put(f, 0, 0, 0, -1);
}

/* (x^2 + y^2 + z^2 + 1 - a^2)^2 = 4 (x^2 + z^2). */
static void torus_of(struct algebraic *f, double a, double *term)
{
	double b = 1 - a * a;

	*f = (struct algebraic){ 4, 1, term };
	memset(term, 0, algebraic_terms(4) * sizeof(*term));
	put(f, 4, 0, 0, 1);
	put(f, 0, 4, 0, 1);
	put(f, 0, 0, 4, 1);
	put(f, 2, 2, 0, 2);
	put(f, 2, 0, 2, 2);
	put(f, 0, 2, 2, 2);
	put(f, 2, 0, 0, 2 * b - 4);
	put(f, 0, 2, 0, 2 * b);
	put(f, 0, 0, 2, 2 * b - 4);
	put(f, 0, 0, 0, b * b);
}

static void as_a_torus(void **state)
{
	double term[35];
	struct algebraic f;
	uint64_t seed = 1;

	(void)state;
	torus_of(&f, 0.25, term);
	for (int e = -6; e <= 9; e += 3) {
		double size = pow(10, e);
		struct object o = { .kind = SHAPE_TORUS, .place = xform_scale(vec_make(size, size, size)) };
		unsigned same = 0, other = 0, hits = 0;
		struct prim torus, p;

		o.shape.torus.major = 1;
		o.shape.torus.minor = 0.25;
		assert_true(prim_make(&torus, &o, &o.place, vec_make(0, 0, 0), 1, 4 * size, 1e-15 * size));
		assert_true(prim_make_algebraic(&p, &f, &o.place, vec_make(0, 0, 0), 1));
		for (unsigned i = 0; i < 20000; i++) {
			vec to = vec_scale(random_vec(&seed), 1.2 * size);
			ald_ray r = ray(vec_scale(random_unit(&seed), size * (i & 1 ? 1e3 : 4)), to);
			struct prim_roots a, b;

			r.dir = vec_scale(vec_sub(to, r.org), i & 2 ? 1e-7 : 1);
			prim_crossings(&torus, &r, &a);
			prim_crossings(&p, &r, &b);
			assert_false(b.begins);
			if (a.count != b.count) { /* grazed */
				other++;
				continue;
			}
			same++;
			for (unsigned k = 0; k < a.count; k++) {
				ald_hit hit = { .t = b.t[k], .prim = 0 };
				double error;
				vec at, n;

				prim_surface(&p, &r, &hit, &at, &n, &error);
				assert_true(error < 1e-12 * size);
				at = vec_scale(at, 1 / size);
				assert_true(fabs(hypot(hypot(at.x, at.z) - 1, at.y) - 0.25) < 1e-14);
				hits++;
				assert_true(fabs(a.t[k] - b.t[k]) * vec_length(r.dir) < 1e-6 * size);
			}
		}
		assert_true(other < 3 && same > 19990 && hits > 10000);
	}
}

/* A line through a convex body has two crossings or none, whatever the degree, and begins outside. */
static void any_degree(void **state)
{
	static double term[8436];
	uint64_t seed = 2;

	(void)state;
	for (uint32_t degree = 2; degree <= 34; degree += 8) {
		struct algebraic f;
		struct prim p;
		unsigned met = 0;

		ball_of(&f, degree, term);
		assert_true(prim_make_algebraic(&p, &f, &xform_identity, vec_make(0, 0, 0), 1));
		for (unsigned i = 0; i < 500; i++) {
			vec to = random_vec(&seed);
			ald_ray r = ray(vec_scale(random_unit(&seed), 5), to);
			struct prim_roots roots;

			r.dir = vec_sub(to, r.org);
			prim_crossings(&p, &r, &roots);
			assert_true(roots.count == 0 || roots.count == 2);
			assert_false(roots.begins);
			met += roots.count == 2;
			if (prim_inside(&p, to))
				assert_true(roots.count == 2 && roots.t[0] <= 1 && roots.t[1] >= 1);
		}
		assert_true(met > 250);
	}
}

/* Between crossings the side changes, from the one that the line comes from. */
static void sides_alternate(void **state)
{
	double term[20];
	struct algebraic f = { 3, 1, term };
	uint64_t seed = 3;
	struct prim p;

	(void)state;
	for (unsigned i = 0; i < 20000; i++) {
		ald_ray r = ray(random_vec(&seed), random_unit(&seed));
		struct prim_roots roots;
		bool in;

		for (unsigned k = 0; k < 20; k++)
			term[k] = signed_uniform(&seed);
		assert_true(prim_make_algebraic(&p, &f, &xform_identity, vec_make(0, 0, 0), 1));
		prim_crossings(&p, &r, &roots);
		in = roots.begins;
		assert_true((roots.count & 1) == 1 || i % 50);
		for (unsigned k = 0; k <= roots.count; k++, in = !in) {
			double a = k ? roots.t[k - 1] : roots.t[0] - 1;
			double b = k < roots.count ? roots.t[k] : a + 1, t = (a + b) / 2;

			if (roots.count && b - a > 1e-6 && fabs(t) < 1e3)
				assert_int_equal(prim_inside(&p, vec_mad(r.org, r.dir, t)), in);
		}
	}
}

/* y = x^2 + z^2 as it is, as what bounds a box and what is taken out of one; far off too. */
static void infinite(void **state)
{
	(void)state;
	for (unsigned n = 0; n < 3; n++) {
		struct world w;
		struct object *o;
		uint32_t f, i;
		ald_ray r;
		ald_hit h;

		begin(&w);
		f = scene_add_algebraic(&w.scene, 2);
		put(&w.scene.algebraic[f], 2, 0, 0, 1);
		put(&w.scene.algebraic[f], 0, 0, 2, 1);
		put(&w.scene.algebraic[f], 0, 1, 0, -1);
		o = add(&w, n ? SHAPE_INTERSECTION : SHAPE_ALGEBRAIC);
		o->shape.algebraic = f;
		if (n) {
			uint32_t parent = w.scene.last_root;

			i = scene_add_object(&w.scene);
			w.scene.object[parent].first_child = i;
			w.scene.object[i].kind = SHAPE_ALGEBRAIC;
			w.scene.object[i].flags = n == 2 ? OBJECT_INVERSE : 0;
			w.scene.object[i].shape.algebraic = f;
			i = scene_add_object(&w.scene);
			w.scene.object[i - 1].next_sibling = i;
			w.scene.object[i].kind = SHAPE_BOX;
			w.scene.object[i].shape.box.lo = vec_make(-1, -1, -1);
			w.scene.object[i].shape.box.hi = vec_make(1, 0.5, 1);
		}
		build(&w);
		r = ray(vec_make(0.1, -9, 0), vec_make(0, 1, 0));
		h = nearest(&w, &r);
		assert_true(h.prim != ALD_NONE && fabs(h.t - (n == 2 ? 8 : 9.01)) < 1e-12);
		r = ray(vec_make(0.5, 9, 0), vec_make(0, -1, 0));
		h = nearest(&w, &r);
		assert_true(h.prim != ALD_NONE && fabs(h.t - (n == 0 ? 8.75 : n == 1 ? 8.5 : 8.75)) < 1e-12);
		r = ray(vec_make(1e6, 1e3, 0), vec_make(0, 1, 0));
		h = nearest(&w, &r);
		assert_int_equal(h.prim != ALD_NONE, n == 0);
		if (n == 0)
			assert_true(fabs(h.t - (1e12 - 1e3)) < 1);
		end(&w);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(as_a_torus),
		cmocka_unit_test(any_degree),
		cmocka_unit_test(sides_alternate),
		cmocka_unit_test(infinite),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
