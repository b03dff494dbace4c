/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The shared kernel against an oracle in whole numbers.
 */
#include "mesh_fixture.h"

static struct shell shell;

static ald_frame frame_of(const struct shell *s)
{
	ald_box b = ald_box_empty();

	for (uint32_t i = 0; i < s->vertices; i++)
		ald_box_join(&b, &(ald_box){ s->v[i], s->v[i] });
	return ald_frame_of(&b);
}

static int kernel(const ald_prep *p, const vec v[3], double *t)
{
	double a, b;

	return ald_triangle_line(p, &v[0], &v[1], &v[2], t, &a, &b);
}

static vec rounded(vec v)
{
	return vec_make(rint(v.x), rint(v.y), rint(v.z));
}

/* A vertex, a point on an edge, or the middle of an edge. */
static vec aim(const struct shell *s, uint64_t *seed, unsigned kind)
{
	const uint32_t *t = s->t[(uint32_t)(uniform(seed) * s->triangles)];
	vec a = s->v[t[0]], b = s->v[t[1]];

	if (kind == 0)
		return a;
	return vec_mad(a, vec_sub(b, a), kind == 1 ? uniform(seed) : 0.5);
}

/* From within, aimed where triangles meet: something ahead is always hit. size 2^30 so that what the
 * kernel sees is far from fitting its products. */
static void closed_meshes_do_not_leak(void **state)
{
	uint64_t seed = 12345;

	(void)state;
	for (unsigned bumpy = 0; bumpy < 2; bumpy++) {
		shell_sphere(&shell, 24, 0x1p30, bumpy ? 0.1 : 0, &seed);
		ald_frame f = frame_of(&shell);

		for (unsigned n = 0; n < 3000; n++) {
			vec to = aim(&shell, &seed, n % 3);
			vec o = vec_scale(random_vec(&seed), n & 1 ? 0x1p28 : 1);
			ald_ray r = ray(o, vec_sub(to, o));
			unsigned ahead = 0, behind = 0;
			ald_prep p;

			ald_ray_prep(&f, &r, &p);
			for (uint32_t i = 0; i < shell.triangles; i++) {
				vec v[3];
				double t;

				shell_corners(&shell, i, v);
				if (!kernel(&p, v, &t))
					continue;
				ahead += t > 0;
				behind += t < 0;
			}
			assert_true(ahead && behind);
		}
	}
}

/* Whatever the oracle finds by a margin, and whatever it rejects by one. */
static void decides_as_the_oracle(void **state)
{
	uint64_t seed = 99;
	unsigned hits = 0, wrong = 0, undecided = 0;

	(void)state;
	for (unsigned n = 0; n < 300000; n++) {
		double size = n & 1 ? 0x1p30 : 64;
		vec o = rounded(vec_scale(random_vec(&seed), size));
		vec d = rounded(vec_scale(random_vec(&seed), size)), v[3];
		ald_ray r = ray(o, d);
		ald_frame f = { o, size, NULL };
		double t, want;
		ald_prep p;
		int got;

		for (unsigned k = 0; k < 3; k++)
			v[k] = rounded(vec_scale(random_vec(&seed), size));
		ald_ray_prep(&f, &r, &p);
		got = kernel(&p, v, &t);
		if (got == oracle(o, d, v, &want)) {
			hits += (unsigned)got;
			continue;
		}
		/* Only where it grazes: the same rays, moved a little, differ. */
		undecided++;
		for (unsigned k = 0; k < 8; k++) {
			vec near = vec_make(o.x + (k & 1 ? 1 : -1), o.y + (k & 2 ? 1 : -1),
					    o.z + (k & 4 ? 1 : -1));

			if (oracle(near, d, v, &want) == got)
				break;
			wrong += k == 7;
		}
	}
	assert_true(hits > 10000);
	assert_true(undecided < 20);
	assert_int_equal(wrong, 0);
}

static void distances_are_right(void **state)
{
	uint64_t seed = 7;
	double worst = 0;

	(void)state;
	shell_sphere(&shell, 16, 0x1p30, 0.02, &seed); /* faces seen from the front */
	ald_frame f = frame_of(&shell);

	for (unsigned n = 0; n < 20000; n++) {
		uint32_t i = (uint32_t)(uniform(&seed) * shell.triangles);
		vec o = rounded(vec_scale(random_vec(&seed), 0x1p28)), v[3], to;
		double a = uniform(&seed), b = uniform(&seed), t, want;
		ald_ray r;
		ald_prep p;

		if (a + b > 1) {
			a = 1 - a;
			b = 1 - b;
		}
		shell_corners(&shell, i, v);
		to = vec_mad(vec_mad(vec_scale(v[0], 1 - a - b), v[1], a), v[2], b);
		r = ray(o, rounded(vec_sub(to, o)));
		ald_ray_prep(&f, &r, &p);
		if (!kernel(&p, v, &t) || !oracle(o, r.dir, v, &want))
			continue;
		worst = fmax(worst, fabs(t - want) / fabs(want));
	}
	assert_true(worst > 0 && worst <= 6e-16);
}

/* Every lane the same decision, and R3: t never before a box that holds the triangle. */
static void lanes_and_boxes_agree(void **state)
{
	uint64_t seed = 5;

	(void)state;
	for (unsigned n = 0; n < 20000; n++) {
		ald_frame f = { { 0, 0, 0 }, 4, NULL };
		ald_triangles many;
		ald_rays rays;
		vec v[ALD_LANES][3];
		ald_prep p[ALD_LANES];
		ald_ray r[ALD_LANES];
		uint32_t lanes, back;

		for (unsigned i = 0; i < ALD_LANES; i++) {
			for (unsigned k = 0; k < 3; k++)
				v[i][k] = random_vec(&seed);
			if (n % 4 == 1) /* flat, along an axis */
				v[i][0].y = v[i][1].y = v[i][2].y = 0.25;
			if (n % 4 == 2) /* a sliver */
				v[i][2] = vec_mad(v[i][0], vec_sub(v[i][1], v[i][0]), 1 + 1e-15);
			ald_triangles_set(&many, i, v[i]);
			r[i] = ray(random_vec(&seed), random_vec(&seed));
			if (n % 8 >= 4) { /* through a corner */
				r[i].dir = vec_sub(v[0][0], r[i].org);
			}
			ald_ray_prep(&f, &r[i], &p[i]);
		}
		lanes = ald_triangle_n(&p[0], &many);
		ald_rays_clear(&rays, p[0].kz);
		for (unsigned i = 0; i < ALD_LANES; i++) {
			if (p[i].kz == p[0].kz)
				ald_rays_set(&rays, i, &p[i]);
		}
		back = ald_rays_triangle(&rays, v[0]);
		for (unsigned i = 0; i < ALD_LANES; i++) {
			ald_box box = { v[i][0], v[i][0] };
			double t, enter;

			ald_box_join(&box, &(ald_box){ v[i][1], v[i][1] });
			ald_box_join(&box, &(ald_box){ v[i][2], v[i][2] });
			if (kernel(&p[0], v[i], &t)) {
				assert_true(lanes >> i & 1);
				assert_true(ald_box_ray(&p[0], &box, -ALD_INF, ALD_INF, &enter));
				assert_true(enter <= t);
				vec c = vec_scale(vec_add(box.lo, box.hi), 0.5);
				assert_true(ald_sphere_ray(&p[0], &c, vec_length(vec_sub(box.hi, c)) *
							   (1 + 4 * ALD_U), -ALD_INF, ALD_INF, &enter));
				assert_true(enter <= t);
			} else if (n % 4 != 2) {
				assert_false(lanes >> i & 1);
			}
			if (p[i].kz == p[0].kz && n % 4 != 2)
				assert_int_equal(back >> i & 1, kernel(&p[i], v[0], &t));
			if (p[i].kz != p[0].kz)
				assert_false(back >> i & 1);
		}
	}
}

static void nan_never_hits_and_never_culls(void **state)
{
	const vec good[3] = { { -1, -1, 1 }, { 3, -1, 1 }, { -1, 3, 1 } };
	const double bad[] = { ALD_NAN, ALD_INF, -ALD_INF };
	ald_frame f = { { 0, 0, 0 }, 2, NULL };
	double t, enter;
	ald_prep p;

	(void)state;
	for (unsigned i = 0; i < 3 * 6; i++) {
		ald_ray r = ray(vec_make(0, 0, 0), vec_make(0, 0, 1));

		ald_ray_prep(&f, &r, &p);
		assert_true(kernel(&p, good, &t) && t == 1);
		(&(i % 6 < 3 ? &r.org : &r.dir)->x)[i % 3] = bad[i / 6];
		ald_ray_prep(&f, &r, &p);
		assert_false(kernel(&p, good, &t));
	}
	for (unsigned i = 0; i < 3 * 9; i++) {
		ald_ray r = ray(vec_make(0, 0, 0), vec_make(0.1, 0.2, 1));
		vec v[3];

		memcpy(v, good, sizeof(v));
		(&v[i % 9 / 3].x)[i % 3] = bad[i / 9];
		ald_ray_prep(&f, &r, &p);
		assert_false(kernel(&p, v, &t));
	}
	/* On the border of a flat box, along its sides: 0 * inf. */
	for (unsigned axis = 0; axis < 3; axis++) {
		for (unsigned side = 0; side < 8; side++) {
			ald_box b = { { -1, -1, -1 }, { 1, 1, 1 } };
			ald_ray r = ray(vec_make(side & 1 ? 1 : -1, side & 2 ? 1 : -1, side & 4 ? 1 : -1),
					vec_make(0, 0, 0));

			if (side & 1)
				(&b.lo.x)[axis] = (&b.hi.x)[axis];
			(&r.dir.x)[axis] = side & 2 ? 1 : -1;
			(&r.dir.x)[(axis + 1) % 3] = side & 4 ? 0.0 : -0.0;
			ald_ray_prep(&f, &r, &p);
			if ((&r.org.x)[axis] == (&b.hi.x)[axis])
				assert_true(ald_box_ray(&p, &b, -5, 5, &enter));
		}
	}
}

/* A common point means overlap; a gap by an axis of the box means none. */
static void overlap_is_exact(void **state)
{
	uint64_t seed = 31;
	unsigned apart = 0, touching = 0;

	(void)state;
	for (unsigned n = 0; n < 200000; n++) {
		ald_box b;
		vec v[3], q;
		double a = uniform(&seed), c = uniform(&seed) * (1 - a);

		for (unsigned k = 0; k < 3; k++)
			v[k] = random_vec(&seed);
		q = vec_mad(vec_mad(vec_scale(v[0], 1 - a - c), v[1], a), v[2], c);
		b.lo = b.hi = n & 1 ? random_vec(&seed) : q;
		/* A box with q at its corner: rounding of q is all that can part them. */
		for (unsigned k = 0; k < 3; k++)
			(&b.hi.x)[k] += 0.2 * uniform(&seed);
		if (n & 1)
			touching += ald_triangle_box(v, &b) != 0;
		else
			assert_true(ald_triangle_box(v, &b));
		apart += n & 1;
	}
	assert_true(touching > apart / 100 && touching < apart / 2);
	/* Clear of the box, though every coordinate's range overlaps: only the normal tells. */
	vec v[3] = { { 3.1, 0, 0 }, { 0, 3.1, 0 }, { 0, 0, 3.1 } };
	ald_box unit = { { 0, 0, 0 }, { 1, 1, 1 } };
	assert_false(ald_triangle_box(v, &unit));
	v[0].x = v[1].y = v[2].z = 3;
	assert_true(ald_triangle_box(v, &unit)); /* touches the corner */
	/* Only an edge-edge axis tells. */
	vec e[3] = { { 2.1, 0.5, -1 }, { 0.5, 2.1, -1 }, { 2.2, 2.2, 3 } };
	assert_false(ald_triangle_box(e, &unit));
}

static void rounding_goes_outwards(void **state)
{
	uint64_t seed = 3;

	(void)state;
	assert_true(ald_up(0) == 0x1p-1074 && ald_down(0) == -0x1p-1074);
	assert_true(ald_up(1) == 1 + DBL_EPSILON && ald_down(1) == 1 - DBL_EPSILON / 2);
	assert_true(ald_up(-0.0) > 0 && ald_up(DBL_MAX) > DBL_MAX);
	for (unsigned i = 0; i < 100000; i++) {
		double x = ldexp(signed_uniform(&seed), (int)(seed % 300) - 150);

		assert_true(ald_up(x) > x && ald_down(x) < x && ald_down(ald_up(x)) == x);
		assert_true((double)ald_float_up(x) >= x && (double)ald_float_down(x) <= x);
		assert_true((double)nextafterf(ald_float_up(x), (float)-ALD_INF) < x);
		assert_true((double)nextafterf(ald_float_down(x), (float)ALD_INF) > x);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(closed_meshes_do_not_leak),
		cmocka_unit_test(decides_as_the_oracle),
		cmocka_unit_test(distances_are_right),
		cmocka_unit_test(lanes_and_boxes_agree),
		cmocka_unit_test(nan_never_hits_and_never_culls),
		cmocka_unit_test(overlap_is_exact),
		cmocka_unit_test(rounding_goes_outwards),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
