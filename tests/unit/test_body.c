/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Bodies (sphere sweeps, blobs): one closed surface, whatever pieces it is made of, at every scale.
 */
#include "prim/body.h"

#include "world_fixture.h"

struct kind {
	const char *name;
	enum sweep_kind sweep;
	uint32_t points;
	double radius;
	bool straight; /* all points on one line, as hairs often are */
};

static const struct kind kinds[] = {
	{ "linear", SWEEP_LINEAR, 6, 0.2, false },    { "b", SWEEP_B, 8, 0.3, false },
	{ "cubic", SWEEP_CUBIC, 7, 0.25, false },     { "thin linear", SWEEP_LINEAR, 9, 1e-3, false },
	{ "thin cubic", SWEEP_CUBIC, 6, 1e-3, false }, { "thin b", SWEEP_B, 6, 1e-5, false },
	{ "hair", SWEEP_LINEAR, 4, 2e-3, true },      { "straight cubic", SWEEP_CUBIC, 5, 0.1, true },
};
#define KINDS (sizeof(kinds) / sizeof(kinds[0]))

static void add_sweep(struct world *w, const struct kind *k, double size, vec shift, uint64_t *seed)
{
	struct object *o = add(w, SHAPE_SWEEP);
	uint32_t i = scene_add_sweep(&w->scene, k->points);
	struct sweep *s = &w->scene.sweep[i];

	s->kind = k->sweep;
	o->shape.sweep = i;
	for (uint32_t n = 0; n < k->points; n++) {
		vec c = k->straight ? vec_make(0.3, 0.25 * n, -0.1) : random_vec(seed);

		c = vec_add(vec_scale(c, size), shift);
		s->point[n][0] = c.x;
		s->point[n][1] = c.y;
		s->point[n][2] = c.z;
		s->point[n][3] = size * k->radius * (k->straight ? 1 : 0.5 + uniform(seed));
	}
}

/* A point that the sweep surely covers: somewhere in a ball on its polygon's or spline's way. */
static vec target(const struct sweep *w, uint64_t *seed)
{
	uint32_t less = w->kind == SWEEP_LINEAR ? 1 : 3;
	uint32_t i = (uint32_t)(uniform(seed) * (w->count - less));
	double u = uniform(seed), f[4] = { 1 - u, u, 0, 0 }, c[4] = { 0, 0, 0, 0 };

	if (uniform(seed) < 0.2)
		u = 0; /* where pieces meet */
	if (w->kind == SWEEP_CUBIC) {
		f[0] = ((2 - u) * u - 1) * u / 2;
		f[1] = ((3 * u - 5) * u * u + 2) / 2;
		f[2] = ((4 - 3 * u) * u + 1) * u / 2;
		f[3] = (u - 1) * u * u / 2;
	} else if (w->kind == SWEEP_B) {
		f[0] = (1 - u) * (1 - u) * (1 - u) / 6;
		f[1] = (3 * u * u * u - 6 * u * u + 4) / 6;
		f[2] = (((3 - 3 * u) * u + 3) * u + 1) / 6;
		f[3] = u * u * u / 6;
	} else if (u == 0) {
		f[0] = 1, f[1] = 0;
	}
	for (unsigned k = 0; k < 4; k++) {
		for (unsigned j = 0; j < (less == 1 ? 2 : 4); j++)
			c[k] += f[j] * w->point[i + j][k];
	}
	return vec_mad(vec_make(c[0], c[1], c[2]), random_unit(seed), 0.99 * fabs(c[3]) * uniform(seed));
}

static bool within(struct world *w, vec p)
{
	struct solid s[4];

	return geometry_inside(w->g, p, s, 4) > 0;
}

/* Along a line, hits part what is inside from what is not: never two ways in in a row, and none is lost. */
static void lines_go_in_and_out(struct world *w, vec to, double size, uint64_t *seed)
{
	vec d = uniform(seed) < 0.2 ? vec_make(0, 0, 1) : random_unit(seed); /* across straight ones */
	ald_ray r = ray(vec_mad(to, d, -8 * size), d);
	double last = 0;
	bool in = false, seen = false;
	ald_hit h;

	for (unsigned n = 0; n < 40; n++) {
		struct surface s;
		double mid;

		h = nearest(w, &r);
		if (h.prim == ALD_NONE)
			break;
		mid = last + (h.t - last) / 2;
		if (h.t - last > 1e-7 * size)
			assert_int_equal(within(w, vec_mad(r.org, d, mid)), in);
		surface_at(w->g, &r, &h, &s);
		assert_true(fabs(vec_length(s.n) - 1) < 1e-12);
		/* The normal says the same; but for rounding where the line only touches. */
		if (fabs(vec_dot(s.n, d)) > 1e-5)
			assert_int_equal(vec_dot(s.n, d) > 0, in);
		if (last < 8 * size && h.t > 8 * size)
			seen = in;
		last = h.t;
		in = !in;
		trace_after(&r, &h);
	}
	assert_false(in);
	assert_true(seen);
}

static void sweeps_are_closed(void **state)
{
	uint64_t seed = 5;

	(void)state;
	for (unsigned n = 0; n < KINDS * 4; n++) {
		double size = pow(10, 4.0 * (n / KINDS) - 6);
		struct world w;

		begin(&w);
		add_sweep(&w, &kinds[n % KINDS], size, vec_make(0, 0, 0), &seed);
		build(&w);
		for (unsigned i = 0; i < 1500; i++)
			lines_go_in_and_out(&w, target(&w.scene.sweep[0], &seed), size, &seed);
		end(&w);
	}
}

/* How far p is from the union of all balls, by brute force. */
static double outside(const struct sweep *w, vec p)
{
	double least = ALD_INF;

	for (uint32_t i = 0; i + 1 < w->count; i++) {
		const double *a = w->point[i], *b = w->point[i + 1];
		vec q = vec_sub(p, vec_make(a[0], a[1], a[2]));
		vec e = vec_sub(vec_make(b[0], b[1], b[2]), vec_make(a[0], a[1], a[2]));

		for (unsigned k = 0; k <= 20000; k++) {
			double u = k / 20000.0;

			least = fmin(least, vec_length(vec_mad(q, e, -u)) - (a[3] + u * (b[3] - a[3])));
		}
	}
	return least;
}

static void hits_lie_on_the_surface(void **state)
{
	uint64_t seed = 6;
	struct world w;

	(void)state;
	begin(&w);
	add_sweep(&w, &kinds[0], 1, vec_make(0, 0, 0), &seed);
	build(&w);
	for (unsigned i = 0; i < 300; i++) {
		vec to = target(&w.scene.sweep[0], &seed);
		ald_ray r = ray(vec_mad(to, random_unit(&seed), 5), to);
		struct surface s;
		ald_hit h;

		r.dir = vec_sub(to, r.org);
		h = nearest(&w, &r);
		assert_true(h.prim != ALD_NONE);
		surface_at(w.g, &r, &h, &s);
		assert_true(fabs(outside(&w.scene.sweep[0], s.p)) < 1e-8);
		assert_true(fabs(outside(&w.scene.sweep[0], vec_mad(r.org, r.dir, h.t))) < 1e-8);
	}
	end(&w);
}

/* A ray that starts on the surface, moved off it by the error bound, does not meet it there again. */
static void secondary_rays_leave(void **state)
{
	uint64_t seed = 7;

	(void)state;
	for (unsigned n = 0; n < KINDS * 5; n++) {
		double size = pow(10, 3.0 * (n / KINDS) - 6), far = n % 3 == 2 ? 100 * size : 0;
		const struct kind *k = &kinds[n % KINDS];
		struct world w;

		begin(&w);
		add_sweep(&w, k, size, vec_make(far, -far, far / 2), &seed);
		build(&w);
		for (unsigned i = 0; i < 2000; i++) {
			vec to = target(&w.scene.sweep[0], &seed);
			ald_ray r = ray(vec_mad(to, random_unit(&seed), 4 * size), to);
			struct surface s;
			ald_hit h;

			r.dir = vec_sub(to, r.org);
			h = nearest(&w, &r);
			if (h.prim == ALD_NONE)
				continue;
			surface_at(w.g, &r, &h, &s);
			r = ray(vec_mad(s.p, s.n, surface_error(w.g, &r, &h, &s)), random_unit(&seed));
			if (vec_dot(r.dir, s.n) < 0)
				r.dir = vec_neg(r.dir);
			h = nearest(&w, &r);
			assert_true(h.prim == ALD_NONE || h.t > 1e-6 * size * k->radius);
		}
		end(&w);
	}
}

/* Balls and capsules, some of them negative, some in odd spaces. */
static void add_blob(struct world *w, uint32_t parts, double size, double radius, vec shift, uint64_t *seed)
{
	struct object *o = add(w, SHAPE_BLOB);
	uint32_t i = scene_add_blob(&w->scene, parts);

	o->shape.blob = i;
	w->scene.blob[i].threshold = 0.3;
	for (uint32_t n = 0; n < parts; n++) {
		struct blob_part *p = &w->scene.blob[i].part[n];

		p->cylinder = n % 3 == 1;
		p->base = vec_add(vec_scale(random_vec(seed), size), shift);
		p->apex = p->cylinder ? vec_add(vec_scale(random_vec(seed), size), shift) : p->base;
		p->radius = radius * size * (0.5 + uniform(seed));
		p->strength = n % 5 == 4 ? -1 : 0.5 + uniform(seed);
		if (n % 4 == 2) {
			struct xform x = xform_translate(vec_neg(shift));
			struct xform y = xform_scale(vec_make(1, 0.5 + uniform(seed), 0.7));

			p->place = arena_alloc(&w->scene.arena, sizeof(*p->place));
			x = xform_mul(&x, &y);
			y = xform_translate(shift);
			*p->place = xform_mul(&x, &y);
		}
	}
}

/* Some place in the blob's skin or in it. */
static vec blob_target(struct world *w, uint64_t *seed)
{
	const struct blob *b = &w->scene.blob[0];

	for (;;) {
		const struct blob_part *p = &b->part[(uint32_t)(uniform(seed) * b->count)];
		vec at = vec_mad(p->base, vec_sub(p->apex, p->base), uniform(seed));

		at = vec_mad(at, random_unit(seed), p->radius * uniform(seed));
		if (p->place)
			at = mat_point(&p->place->fwd, at);
		if (within(w, at))
			return at;
	}
}

static void blobs_are_closed(void **state)
{
	static const struct {
		uint32_t parts;
		double radius;
	} variant[] = { { 7, 0.6 }, { 30, 0.3 }, { 60, 1 } }; /* the last: all reach each other */
	uint64_t seed = 8;

	(void)state;
	for (unsigned n = 0; n < 12; n++) {
		double size = pow(10, 4.0 * (n / 3) - 6);
		struct world w;

		begin(&w);
		add_blob(&w, variant[n % 3].parts, size, variant[n % 3].radius, vec_make(0, 0, 0), &seed);
		build(&w);
		for (unsigned i = 0; i < (n % 3 == 2 ? 100 : 800); i++)
			lines_go_in_and_out(&w, blob_target(&w, &seed), size, &seed);
		end(&w);
	}
}

static void blob_rays_leave(void **state)
{
	uint64_t seed = 9;

	(void)state;
	for (unsigned n = 0; n < 10; n++) {
		double size = pow(10, 3.0 * (n / 2) - 6);
		vec far = vec_make(n & 1 ? 100 * size : 0, 0, 0);
		struct world w;

		begin(&w);
		add_blob(&w, 9, size, 0.6, far, &seed);
		build(&w);
		for (unsigned i = 0; i < 2000; i++) {
			vec to = blob_target(&w, &seed);
			ald_ray r = ray(vec_mad(to, random_unit(&seed), 4 * size), to);
			struct surface s;
			ald_hit h;

			r.dir = vec_sub(to, r.org);
			h = nearest(&w, &r);
			assert_true(h.prim != ALD_NONE);
			surface_at(w.g, &r, &h, &s);
			r = ray(vec_mad(s.p, s.n, s.error), random_unit(&seed));
			if (vec_dot(r.dir, s.n) < 0)
				r.dir = vec_neg(r.dir);
			h = nearest(&w, &r);
			assert_true(h.prim == ALD_NONE || h.t > 1e-6 * size);
		}
		end(&w);
	}
}

/* A closed profile, the axis left out or touched. */
static void add_lathe(struct world *w, enum lathe_kind kind, double size, bool hollow, uint64_t *seed)
{
	struct object *o = add(w, SHAPE_LATHE);
	uint32_t n = 8, i = scene_add_lathe(&w->scene, kind == LATHE_LINEAR ? n + 1 : n + 3);
	struct lathe *l = &w->scene.lathe[i];

	l->kind = kind;
	o->shape.lathe.index = i;
	for (uint32_t k = 0; k < l->count; k++) {
		double a = 6.283185307179586 * (k % n) / n;

		l->point[k][0] = k < n ? size * (hollow ? 1.2 + cos(a) * (0.5 + 0.5 * uniform(seed)) :
							  0.5 * fabs(1 + cos(a)) * (0.5 + uniform(seed))) :
					 l->point[k - n][0];
		l->point[k][1] = k < n ? size * sin(a) * (0.5 + 0.5 * uniform(seed)) : l->point[k - n][1];
	}
}

/* A ring of pieces, with a hole of others. */
static void add_prism(struct world *w, enum lathe_kind kind, double size, bool conic, uint64_t *seed)
{
	struct object *o = add(w, SHAPE_PRISM);
	uint32_t n = 6, i = scene_add_prism(&w->scene, 2 * 4 * n);
	double ring[9][2];
	struct prism *p = &w->scene.prism[i];

	o->shape.prism.index = i;
	p->kind = kind;
	p->conic = conic;
	p->lo = conic ? 0.4 * size : -0.3 * size;
	p->hi = size;
	for (uint32_t curve = 0; curve < 2; curve++) {
		for (uint32_t k = 0; k < 9; k++) {
			double a = 6.283185307179586 * (k % n) / n;
			double r = (curve ? 0.3 : 1.2) * (0.7 + 0.3 * uniform(seed));

			ring[k][0] = k < n ? (conic ? 1 : size) * r * cos(a) : ring[k - n][0];
			ring[k][1] = k < n ? (conic ? 1 : size) * r * sin(a) : ring[k - n][1];
		}
		for (uint32_t k = 0; k < 4 * n; k++) {
			p->point[curve * 4 * n + k][0] = ring[k / 4 + k % 4][0];
			p->point[curve * 4 * n + k][1] = ring[k / 4 + k % 4][1];
		}
	}
}

/* Rays of all kinds; level, upright, and through the axis too. */
static void are_closed(void (*make)(struct world *, enum lathe_kind, double size, bool, uint64_t *seed),
		       bool both)
{
	uint64_t seed = 10;

	for (unsigned n = 0; n < 16; n++) {
		double size = pow(10, 4.0 * (n / 4) - 6);
		struct world w;

		begin(&w);
		make(&w, n & 1 ? LATHE_CUBIC : LATHE_LINEAR, size, !both || n & 2, &seed);
		build(&w);
		for (unsigned i = 0; i < 1500; i++) {
			vec p = vec_scale(random_vec(&seed), 1.5 * size), d = random_unit(&seed);
			unsigned count = 0;
			ald_ray r;
			ald_hit h;

			if (i % 4 == 1)
				d.y *= pow(10, -16 * uniform(&seed));
			if (i % 4 == 2)
				d = vec_make(d.x * pow(10, -16 * uniform(&seed)), d.y, 0);
			if (i % 8 == 3)
				d = i % 16 == 3 ? vec_make(0, 1, 0) : vec_make(1, 0, 0);
			if (vec_length(d) < 0.1)
				continue;
			r = ray(p, vec_scale(d, size));
			for (h = nearest(&w, &r); h.prim != ALD_NONE; h = nearest(&w, &r), count++)
				trace_after(&r, &h);
			assert_int_equal(count & 1, within(&w, p));
		}
		end(&w);
	}
}

static void lathes_are_closed(void **state)
{
	(void)state;
	are_closed(add_lathe, false);
}

static void prisms_are_closed(void **state)
{
	(void)state;
	are_closed(add_prism, true);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(sweeps_are_closed),
		cmocka_unit_test(hits_lie_on_the_surface),
		cmocka_unit_test(secondary_rays_leave),
		cmocka_unit_test(blobs_are_closed),
		cmocka_unit_test(blob_rays_leave),
		cmocka_unit_test(lathes_are_closed),
		cmocka_unit_test(prisms_are_closed),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
