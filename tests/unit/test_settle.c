/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Exact order's last step in lanes gives the bits of ald_exact_settle(), whatever is hit and wherever in a batch it
 * stands.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "accel/geometry.h"

enum { TRIANGLES = 1024, BATCH = 61 };

static uint64_t state = 20261123;

static double unit(void)
{
	state ^= state << 13;
	state ^= state >> 7;
	state ^= state << 17;
	return (double)(state >> 11) * 0x1p-53;
}

static double coordinate(double size, double away)
{
	return away + size * (2 * unit() - 1);
}

struct soup {
	double vertex[3 * TRIANGLES][3];
	uint32_t index[3 * TRIANGLES];
	struct prim_level level;
	struct view view;
};

/* Each triangle of another size, place and thinness; many lie in planes across an axis or are of few bits. */
static void fill(struct soup *s)
{
	ald_box all = ald_box_empty();

	memset(s, 0, sizeof(*s));
	for (uint32_t i = 0; i < TRIANGLES; i++) {
		double size = ldexp(1, (int)(unit() * 40) - 20), away = i % 3 ? 0 : ldexp(unit(), (int)(i % 40));

		for (uint32_t c = 0; c < 3; c++) {
			double *v = s->vertex[3 * i + c];

			for (unsigned k = 0; k < 3; k++) {
				v[k] = coordinate(size, away);
				if (i % 5 == 0)
					v[k] = rint(v[k] * 16) / 16;
				if (i % 7 == 0 && k == i % 3)
					v[k] = away;
			}
			for (unsigned k = 0; i % 11 == 0 && c == 2 && k < 3; k++) { /* a needle */
				const double *a = s->vertex[3 * i], *b = s->vertex[3 * i + 1];

				v[k] = b[k] + (b[k] - a[k]) * 0.3 + size * 1e-9 * unit();
			}
			s->index[3 * i + c] = 3 * i + c;
			ald_box_join(&all, &(ald_box){ { v[0], v[1], v[2] }, { v[0], v[1], v[2] } });
		}
	}
	s->level.vertex = s->vertex;
	s->level.vertex_double = true;
	s->level.index = s->index;
	s->level.tri_count = TRIANGLES;
	s->view.level = &s->level;
	s->view.frame = ald_frame_of(&all);
	s->view.prims.precision = ALD_PRECISION_EXACT;
	s->view.prims.tri_count = TRIANGLES;
}

/* Towards a corner, an edge or the inside, from near or far off. */
static ald_ray aim(const struct soup *s, uint32_t id, unsigned how)
{
	const double(*v)[3] = &s->vertex[3 * id];
	double a = how % 4 ? unit() : 1, b = how % 4 > 1 ? unit() * (1 - a) : 1 - a, c = 1 - a - b;
	double off = ldexp(1, (int)(unit() * 40) - 20), o[3], d[3];

	for (unsigned k = 0; k < 3; k++) {
		double at = how % 4 ? a * v[0][k] + b * v[1][k] + c * v[2][k] : v[0][k];

		o[k] = how % 5 == 0 && k == how % 3 ? at : coordinate(off, at);
		d[k] = (at - o[k]) * (how % 2 ? 1 : 1 + unit());
	}
	return (ald_ray){ .org = { o[0], o[1], o[2] }, .dir = { d[0], d[1], d[2] }, .tmax = ALD_INF,
			  .mask = ~0u, .skip = ALD_NONE, .after = ALD_NONE };
}

static void lanes_give_the_bits_of_one(void **unused)
{
	static struct soup s;
	ald_ray r[BATCH];
	ald_hit want[BATCH], got[BATCH], one;
	unsigned met = 0;

	(void)unused;
	fill(&s);
	for (unsigned turn = 0; turn < 2000; turn++) {
		uint32_t n = 1 + turn % BATCH;

		for (uint32_t i = 0; i < n; i++) {
			uint32_t id = (uint32_t)(unit() * TRIANGLES);
			ald_vec v[3];
			ald_prep p;

			r[i] = aim(&s, id, turn + i);
			want[i] = (ald_hit){ .t = 1, .u = 2, .v = 3, .prim = unit() < 0.2 ? ALD_NONE : id };
			got[i] = one = want[i];
			if (want[i].prim == ALD_NONE)
				continue;
			prim_triangle(&s.level, id, v);
			ald_ray_prep(&s.view.frame, &r[i], &p);
			ald_exact_settle(&p, v, &want[i], 0);
			met += want[i].u != 2;
			view_settle(&s.view, &r[i], &one);
			assert_memory_equal(&one, &want[i], sizeof(one));
		}
		view_settle_n(&s.view, r, got, n);
		assert_memory_equal(got, want, n * sizeof(*got));
	}
	assert_true(met > 20000);
}

static void only_triangles_in_exact_order(void **unused)
{
	static struct soup s;
	ald_hit h = { .t = 1, .u = 2, .v = 3 }, was = h;
	ald_ray r;

	(void)unused;
	fill(&s);
	r = aim(&s, 0, 3);
	s.view.prims.precision = ALD_PRECISION_DEFAULT;
	view_settle_n(&s.view, &r, &h, 1);
	assert_memory_equal(&h, &was, sizeof(h));
	s.view.prims.precision = ALD_PRECISION_EXACT;
	h.prim = was.prim = TRIANGLES; /* a shape */
	view_settle_n(&s.view, &r, &h, 1);
	assert_memory_equal(&h, &was, sizeof(h));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(lanes_give_the_bits_of_one),
		cmocka_unit_test(only_triangles_in_exact_order),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
