/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Analytic primitives: bounds, accuracy far away, solidity, and secondary rays at every scale.
 */
#include "prim/prim.h"

#include "world_fixture.h"

static const enum shape_kind solids[] = { SHAPE_SPHERE, SHAPE_BOX, SHAPE_CONE, SHAPE_SUPERELLIPSOID,
					  SHAPE_TORUS };
enum { SOLIDS = 5 };

/* A shape of about the given size; which: the variants of a kind. */
static void shape_of(struct object *o, enum shape_kind kind, double size, unsigned which)
{
	memset(o, 0, sizeof(*o));
	o->kind = kind;
	o->place = xform_identity;
	switch (kind) {
	case SHAPE_SPHERE:
		o->shape.sphere.radius = size;
		o->shape.sphere.centre = vec_make(0, size / 3, 0);
		break;
	case SHAPE_BOX:
		o->shape.box.lo = vec_make(-size, -size / 2, -size / 3);
		o->shape.box.hi = vec_make(size, size / 2, size / 7);
		break;
	case SHAPE_CONE:
		o->shape.cone.base = vec_make(size / 10, -size, size / 5);
		o->shape.cone.apex = vec_make(0, size, 0);
		o->shape.cone.base_radius = size / 2;
		o->shape.cone.apex_radius = which == 0 ? size / 2 : which == 1 ? 0 : size;
		break;
	case SHAPE_TORUS:
		o->shape.torus.major = size;
		o->shape.torus.minor = which == 0 ? size / 4 : which == 1 ? size / 100 : size * 1.5;
		break;
	case SHAPE_SUPERELLIPSOID:
		o->shape.superellipsoid.a = which == 0 ? 0.2 : which == 1 ? 1.7 : 1;
		o->shape.superellipsoid.b = which == 0 ? 0.3 : which == 1 ? 0.6 : 2;
		o->place = xform_scale(vec_make(size, size, size));
		break;
	case SHAPE_DISC:
		o->shape.disc.normal = vec_unit(vec_make(1, 2, 3));
		o->shape.disc.radius = size;
		o->shape.disc.hole = which ? size / 3 : 0;
		break;
	default:
		break;
	}
}

static struct xform some_place(uint64_t *seed, bool stretched)
{
	struct xform x = xform_rotate(vec_scale(random_vec(seed), 180)), y;

	if (stretched) {
		y = xform_scale(vec_make(1 + uniform(seed), -0.5 - uniform(seed), 1));
		x = xform_mul(&x, &y);
		y = xform_rotate(vec_scale(random_vec(seed), 180));
		x = xform_mul(&x, &y);
	}
	y = xform_translate(random_vec(seed));
	return xform_mul(&x, &y);
}

static ald_hit cast(const struct prim *p, const ald_ray *r)
{
	ald_hit h = { .t = r->tmax, .prim = ALD_NONE };

	prim_intersect(p, 0, r, &h);
	return h;
}

/* Every point of the surface that rays find lies in the box, and some come close to each side of it. */
static void boxes_hold_and_fit(void **state)
{
	uint64_t seed = 1;

	(void)state;
	for (unsigned n = 0; n < 6 * 3 * 4; n++) {
		enum shape_kind kind = n % 6 == 5 ? SHAPE_DISC : solids[n % 6];
		struct xform place = some_place(&seed, n & 1);
		ald_box seen = ald_box_empty();
		struct object o;
		struct prim p;
		vec size;

		shape_of(&o, kind, 1, n / 6 % 3);
		assert_true(prim_make(&p, &o, &place, vec_make(0, 0, 0), 1, 4, 1e-15));
		size = vec_sub(p.box.hi, p.box.lo);
		for (unsigned i = 0; i < 60000; i++) {
			vec to = vec_add(p.box.lo, vec_make(size.x * uniform(&seed), size.y * uniform(&seed),
							    size.z * uniform(&seed)));
			ald_ray r = ray(vec_mad(to, random_unit(&seed), 10), vec_make(0, 0, 0));
			double error;
			ald_hit h;
			vec at, m;

			r.dir = vec_sub(to, r.org);
			h = cast(&p, &r);
			if (h.prim == ALD_NONE)
				continue;
			prim_surface(&p, &r, &h, &at, &m, &error);
			assert_true(fabs(vec_length(m) - 1) < 1e-12);
			ald_box_join(&seen, &(ald_box){ at, at });
		}
		for (unsigned k = 0; k < 3; k++) {
			double slack = 0.15 * (&size.x)[k];

			assert_true((&seen.lo.x)[k] >= (&p.box.lo.x)[k]);
			assert_true((&seen.hi.x)[k] <= (&p.box.hi.x)[k]);
			assert_true((&seen.lo.x)[k] <= (&p.box.lo.x)[k] + slack);
			assert_true((&seen.hi.x)[k] >= (&p.box.hi.x)[k] - slack);
		}
	}
}

/* What the point o + t d misses the canonical surface by, as a share of its size; in long double. */
static double miss(const struct object *o, const ald_ray *r, double t)
{
	long double x = (long double)r->org.x + (long double)t * (long double)r->dir.x;
	long double y = (long double)r->org.y + (long double)t * (long double)r->dir.y;
	long double z = (long double)r->org.z + (long double)t * (long double)r->dir.z;
	long double rho, size;

	switch (o->kind) {
	case SHAPE_SPHERE:
		y -= (long double)o->shape.sphere.centre.y;
		size = (long double)o->shape.sphere.radius;
		return fabs((double)(sqrtl(x * x + y * y + z * z) / size - 1));
	case SHAPE_TORUS:
		size = (long double)o->shape.torus.major;
		rho = sqrtl(x * x + z * z) - size;
		return fabs((double)((sqrtl(rho * rho + y * y) - (long double)o->shape.torus.minor) / size));
	default:
		return 0;
	}
}

static void far_shapes_are_found(void **state)
{
	const double limit[2][9] = {
		{ 1e-14, 1e-13, 2e-13, 3e-12, 3e-11, 4e-10, 7e-9, 1e-7, 3e-7 },
		{ 1e-14, 1e-13, 2e-13, 1e-12, 1e-11, 1e-10, 5e-10, 0, 0 },
	};
	uint64_t seed = 2;

	(void)state;
	for (unsigned torus = 0; torus < 2; torus++) {
		for (int e = 0; e < (torus ? 7 : 9); e++) {
			double distance = pow(10, e), worst = 0;
			struct object o;
			struct prim p;

			shape_of(&o, torus ? SHAPE_TORUS : SHAPE_SPHERE, 1, 0);
			assert_true(prim_make(&p, &o, &o.place, vec_make(0, 0, 0), 1, 2, 1e-15));
			for (unsigned i = 0; i < 4000; i++) {
				vec c = torus ? vec_unit(vec_make(signed_uniform(&seed), 0,
								  signed_uniform(&seed))) :
						o.shape.sphere.centre;
				vec to = vec_mad(c, random_unit(&seed), 0.9 * (torus ? 0.25 : 1) *
									       uniform(&seed));
				ald_ray r = ray(vec_mad(to, random_unit(&seed), distance + 3), to);
				ald_hit h;

				r.dir = vec_sub(to, r.org);
				h = cast(&p, &r);
				assert_int_equal(h.prim, 0);
				worst = fmax(worst, miss(&o, &r, h.t));
			}
			if (worst > limit[torus][e])
				print_message("%s at 1e%d: %g\n", torus ? "torus" : "sphere", e, worst);
			assert_true(worst <= limit[torus][e]);
		}
	}
}

/* From a point within, every ray leaves: no way through where faces meet; and the crossings ahead and
 * behind make up an even number. */
static void solids_are_tight(void **state)
{
	uint64_t seed = 3;

	(void)state;
	for (unsigned n = 0; n < SOLIDS * 2; n++) {
		struct object o;
		struct prim p;

		shape_of(&o, solids[n % SOLIDS], 1, n / SOLIDS);
		assert_true(prim_make(&p, &o, &o.place, vec_make(0, 0, 0), 1, 2, 1e-15));
		for (unsigned i = 0; i < 40000; i++) {
			vec from = random_vec(&seed), to = random_vec(&seed);
			unsigned crossings = 0;
			ald_ray r;
			ald_hit h;

			if (o.kind == SHAPE_CONE && i % 3) { /* at the rims */
				double a = 7 * uniform(&seed), rad = i % 3 == 1 ? o.shape.cone.base_radius :
										  o.shape.cone.apex_radius;
				vec own = vec_make(cos(a) * rad / fmax(o.shape.cone.base_radius,
								       o.shape.cone.apex_radius),
						   0, i % 3 == 1 ? -1 : 1);

				own.y = sin(a) * fabs(own.x / (cos(a) != 0 ? cos(a) : 1));
				to = vec_add(p.centre, mat_dir(&p.from, own));
			}
			if (o.kind == SHAPE_BOX && i & 1)
				to = vec_make(i & 2 ? 1 : -1, i & 4 ? 0.5 : -0.5, to.z);
			r = ray(from, vec_sub(to, from));
			if (!prim_inside(&p, from))
				continue;
			h = cast(&p, &r);
			assert_int_equal(h.prim, 0);
			while (h.prim != ALD_NONE) {
				crossings++;
				r.tmin = h.t;
				r.after = 0;
				h = cast(&p, &r);
			}
			assert_int_equal(crossings & 1, 1);
		}
	}
}

/* Where a surface is hit, a ray that starts there moved off it by the error bound and leaves never meets
 * a convex surface again, whatever the scale, the distance from the origin, or the map. */
static void leave(struct world *w, bool convex, uint64_t *seed, unsigned *left)
{
	for (unsigned i = 0; i < 3000; i++) {
		ald_box b;
		struct geometry_counts c;
		struct surface s;
		ald_ray r;
		ald_hit h;
		vec to;

		geometry_get_counts(w->g, &c);
		b = c.box;
		for (unsigned k = 0; k < 3; k++)
			(&to.x)[k] = (&b.lo.x)[k] + uniform(seed) * ((&b.hi.x)[k] - (&b.lo.x)[k]);
		r = ray(vec_mad(to, random_unit(seed), 3 * vec_length(vec_sub(b.hi, b.lo))), to);
		r.dir = vec_sub(to, r.org);
		h = nearest(w, &r);
		if (h.prim == ALD_NONE)
			continue;
		surface_at(w->g, &r, &h, &s);
		assert_true(s.error > 0 && s.error < 1e-9 * (vec_length(s.p) +
							     vec_length(vec_sub(b.hi, b.lo))));
		if (vec_dot(s.n, r.dir) > 0)
			s.n = vec_neg(s.n);
		r = ray(vec_mad(s.p, s.n, surface_error(w->g, &r, &h, &s)), random_unit(seed));
		if (i & 1) /* grazing */
			r.dir = vec_mad(vec_sub(r.dir, vec_scale(s.n, vec_dot(r.dir, s.n))), s.n,
					pow(10, -12 * uniform(seed)));
		if (vec_dot(r.dir, s.n) < 0)
			r.dir = vec_neg(r.dir);
		if (s.planar)
			r.skip = h.prim;
		h = nearest(w, &r);
		(*left)++;
		if (convex)
			assert_int_equal(h.prim, ALD_NONE);
		else if (h.prim != ALD_NONE)
			assert_true(h.t * vec_length(r.dir) > 1e-9 * vec_length(vec_sub(b.hi, b.lo)) ||
				    i & 1);
	}
}

static void secondary_rays_leave(void **state)
{
	uint64_t seed = 4;

	(void)state;
	for (int e = -6; e <= 6; e += 3) {
		for (unsigned n = 0; n < SOLIDS * 3 * 4; n++) {
			double size = pow(10, e), far = n / 12 & 1 ? 1e5 : 0;
			struct xform place = some_place(&seed, n / 24 & 1), move;
			unsigned left = 0;
			struct world w;
			struct object *o;

			begin(&w);
			o = add(&w, SHAPE_SPHERE);
			{
				uint32_t next = o->next_sibling;

				shape_of(o, solids[n % SOLIDS], size, n / SOLIDS % 3);
				o->texture = o->interior_texture = o->interior = SCENE_NONE;
				o->first_child = o->first_clip = SCENE_NONE;
				o->next_sibling = next;
			}
			move = xform_translate(vec_scale(vec_make(0.6, -0.64, 0.48), far * size));
			o->place = xform_mul(&o->place, &place);
			o->place = xform_mul(&o->place, &move);
			build(&w);
			leave(&w, o->kind != SHAPE_TORUS, &seed, &left);
			assert_true(left > 20); /* thin rings are hard to hit */
			end(&w);
		}
	}
}

/* As measured in POV-Ray's pictures. */
static void surface_coordinates(void **state)
{
	static const struct {
		enum shape_kind kind;
		vec p;
		uint32_t part;
		double u, v;
	} want[] = {
		{ SHAPE_SPHERE, { 1, 0, 0 }, 0, 0, 0.5 },
		{ SHAPE_SPHERE, { 0, 0, 1 }, 0, 0.25, 0.5 },
		{ SHAPE_SPHERE, { 0, 0, -1 }, 0, 0.75, 0.5 },
		{ SHAPE_SPHERE, { 0, 1, 0 }, 0, 0, 1 },
		{ SHAPE_TORUS, { 1.25, 0, 0 }, 0, 0.5, 0.5 },
		{ SHAPE_TORUS, { 0, 0.25, 1 }, 0, 0.25, 0.75 },
		{ SHAPE_BOX, { -1, 0.5, 0.142857142857142857 }, 0, 0.25, 2 / 3.0 },
		{ SHAPE_BOX, { 1, -0.5, 0.142857142857142857 }, 1, 0.5, 1 / 3.0 },
		{ SHAPE_BOX, { -1, -0.5, -1 / 3.0 }, 4, 1, 1 / 3.0 },
		{ SHAPE_BOX, { 1, 0.5, -1 / 3.0 }, 3, 0.5, 1 },
		{ SHAPE_BOX, { 0, -0.5, -1 / 3.0 }, 2, 0.375, 0 },
		{ SHAPE_BOX, { -1, -0.5, 0.142857142857142857 }, 5, 0.25, 1 / 3.0 },
		{ SHAPE_CONE, { 0.5, 7, 0 }, 0, 1, 9 },
	};
	struct xform turn = xform_rotate(vec_make(0, 0, 90)), move = xform_translate(vec_make(1, 2, 3));

	(void)state;
	turn = xform_mul(&turn, &move);
	for (unsigned i = 0; i < sizeof(want) / sizeof(want[0]); i++) {
		bool own = want[i].kind != SHAPE_CONE;
		vec p = own ? mat_point(&turn.fwd, want[i].p) : vec_make(1, 9, 0);
		struct object o;
		double u, v;

		shape_of(&o, want[i].kind, 1, 0);
		if (o.kind == SHAPE_SPHERE)
			o.shape.sphere.centre = vec_make(0, 0, 0);
		prim_uv(&o, &turn, p, want[i].part, &u, &v);
		assert_true(fabs(u - want[i].u) < 1e-12);
		assert_true(fabs(v - want[i].v) < 1e-12);
	}
}

/* Rays in the plane of an end or a disc, but for rounding, meet it within its radius or not at all. */
static void ends_are_met_within_their_radius(void **state)
{
	uint64_t seed = 5;
	unsigned met = 0;

	(void)state;
	for (unsigned n = 0; n < 4000; n++) {
		double a = 7 * uniform(&seed), b = 7 * uniform(&seed), at;
		struct object o;
		struct prim p;
		vec from, to, own;
		ald_ray r;
		ald_hit h;

		shape_of(&o, n & 1 ? SHAPE_CONE : SHAPE_DISC, 1, 0);
		o.place = some_place(&seed, n & 2);
		assert_true(prim_make(&p, &o, &o.place, vec_make(0, 0, 0), 1, 8, 1e-15));
		at = o.kind == SHAPE_DISC ? 0 : n & 4 ? -1 : 1;
		from = vec_add(p.centre, mat_dir(&p.from, vec_make(1.5 * cos(a), 1.5 * sin(a), at)));
		to = vec_add(p.centre, mat_dir(&p.from, vec_make(cos(b), sin(b), at)));
		r = ray(from, vec_sub(to, from));
		h = cast(&p, &r);
		if (h.prim == ALD_NONE)
			continue;
		own = mat_dir(&p.to, vec_sub(vec_mad(r.org, r.dir, h.t), p.centre));
		assert_true(own.x * own.x + own.y * own.y < 1 + 1e-6);
		met++;
	}
	assert_true(met > 400);
}

/* The tip of a cone without ends is part of it. */
static void open_cones_have_their_apex(void **state)
{
	uint64_t seed = 6;

	(void)state;
	for (unsigned n = 0; n < 4000; n++) {
		struct object o;
		struct prim p;
		vec from = random_vec(&seed), apex, axis;
		ald_ray r;

		shape_of(&o, SHAPE_CONE, 1, 1);
		o.shape.cone.open = true;
		o.place = some_place(&seed, n & 1);
		assert_true(prim_make(&p, &o, &o.place, vec_make(0, 0, 0), 1, 8, 1e-15));
		apex = mat_point(&o.place.fwd, o.shape.cone.apex);
		axis = vec_sub(apex, mat_point(&o.place.fwd, o.shape.cone.base));
		/* From behind the tip, into the cone. */
		r = ray(vec_mad(vec_mad(apex, axis, 2), from, 1e-3), (vec){ 0, 0, 0 });
		r.dir = vec_sub(apex, r.org);
		assert_int_equal(cast(&p, &r).prim, 0);
	}
}

/* A matrix of whole numbers times k, nearly flat, and its inverse, each number of it rounded once. */
static void flat_matrix(uint64_t *seed, double k, struct mat *a, struct mat *inverse)
{
	double l[3], u[3];

	for (unsigned i = 0; i < 3; i++) {
		l[i] = rint(15 * (2 * uniform(seed) - 1));
		u[i] = rint(15 * (2 * uniform(seed) - 1));
	}
	/* 1 and l below times 1 and u above */
	*a = (struct mat){ { { 1, u[0], u[1] },
			     { l[0], l[0] * u[0] + 1, l[0] * u[1] + u[2] },
			     { l[1], l[1] * u[0] + l[2], l[1] * u[1] + l[2] * u[2] + 1 } } };
	l[1] = l[0] * l[2] - l[1]; /* the inverses of both, then their product */
	u[1] = u[0] * u[2] - u[1];
	*inverse = (struct mat){ { { 1 + u[0] * l[0] + u[1] * l[1], -u[0] - u[1] * l[2], u[1] },
				   { -l[0] - u[2] * l[1], 1 + u[2] * l[2], -u[2] },
				   { l[1], -l[2], 1 } } };
	for (unsigned i = 0; i < 9; i++) {
		a->m[i / 3][i % 3] *= k;
		inverse->m[i / 3][i % 3] /= k;
	}
}

/* As good as numbers can be, however flat the shape: by cofactors alone the inverse is off by 78,000 roundoffs. */
static void maps_are_inverse(void **state)
{
	const struct xform nowhere = xform_identity;
	uint64_t seed = 7;

	(void)state;
	for (unsigned n = 0; n < 1000; n++) {
		struct mat a, inverse;
		double largest = 0, off = 0;
		struct prim p = { .kind = SHAPE_SPHERE };

		flat_matrix(&seed, rint(uniform(&seed) * 0x1p40) * 2 + 1, &a, &inverse);
		assert_true(prim_frame(&p, &a, &nowhere, vec_make(0, 0, 0), 1));
		for (unsigned i = 0; i < 9; i++) {
			largest = fmax(largest, fabs(inverse.m[i / 3][i % 3]));
			off = fmax(off, fabs(p.to.m[i / 3][i % 3] - inverse.m[i / 3][i % 3]));
		}
		assert_true(off <= 2 * ALD_U * largest);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(boxes_hold_and_fit),
		cmocka_unit_test(ends_are_met_within_their_radius),
		cmocka_unit_test(far_shapes_are_found),
		cmocka_unit_test(maps_are_inverse),
		cmocka_unit_test(open_cones_have_their_apex),
		cmocka_unit_test(solids_are_tight),
		cmocka_unit_test(secondary_rays_leave),
		cmocka_unit_test(surface_coordinates),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
