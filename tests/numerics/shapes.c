/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Class h: round shapes from far away, against roots found with 1,024 bits: run by judge.sh.
 *
 *	shapes [-n RAYS] [-s SEED]
 *
 * RAYS a cell (200), of spheres; a tenth of them of other shapes. A ray is answered wrongly if it should hit
 * and misses, or the reverse, or hits elsewhere by more than 1e-3 of the shape's size. What a point is off is told
 * along the ray, where it grows without bound the more the surface is grazed, and across the surface, which is what
 * rounding moves and has a bound.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <gmp.h>

#include "accel/trace.h"
#include "alidade/kernel.h"
#include "soups.h"

enum { BITS = 1024, DEGREE = 4, STEPS = 160, ROOTS = 16 };

struct line { /* o + t d, in the shape's own coordinates */
	mpf_t o[3], d[3];
};

struct poly {
	mpf_t c[DEGREE + 1]; /* c[0] + c[1] t + ... */
	unsigned degree;
};

struct found { /* roots that count */
	unsigned n;
	double t[ROOTS]; /* rounded */
};

static mpf_t tmp[4];

/* ---- polynomials ---- */

static void poly_init(struct poly *p, unsigned degree)
{
	p->degree = degree;
	for (unsigned i = 0; i <= DEGREE; i++)
		mpf_init2(p->c[i], BITS);
}

static void poly_clear(struct poly *p)
{
	for (unsigned i = 0; i <= DEGREE; i++)
		mpf_clear(p->c[i]);
}

static int poly_sign(const struct poly *p, const mpf_t t)
{
	mpf_set(tmp[0], p->c[p->degree]);
	for (unsigned i = p->degree; i--;) {
		mpf_mul(tmp[0], tmp[0], t);
		mpf_add(tmp[0], tmp[0], p->c[i]);
	}
	return mpf_sgn(tmp[0]);
}

/* Between lo and hi, where the signs differ, into root. */
static void bisect(const struct poly *p, const mpf_t lo, const mpf_t hi, mpf_t root)
{
	mpf_t a, b;
	int left = poly_sign(p, lo);

	mpf_init2(a, BITS);
	mpf_init2(b, BITS);
	mpf_set(a, lo);
	mpf_set(b, hi);
	for (unsigned i = 0; i < STEPS; i++) {
		mpf_add(root, a, b);
		mpf_div_2exp(root, root, 1);
		mpf_set(poly_sign(p, root) == left ? a : b, root);
	}
	mpf_clear(a);
	mpf_clear(b);
}

/* The roots in (lo, hi), rising, at most DEGREE: one between any two neighbours of the derivative's roots. */
static unsigned poly_roots(const struct poly *p, const mpf_t lo, const mpf_t hi, mpf_t *root)
{
	struct poly slope;
	mpf_t at[DEGREE + 1];
	unsigned n = 0, turns;

	if (p->degree == 0)
		return 0;
	poly_init(&slope, p->degree - 1);
	for (unsigned i = 0; i <= DEGREE; i++)
		mpf_init2(at[i], BITS);
	for (unsigned i = 0; i < p->degree; i++)
		mpf_mul_ui(slope.c[i], p->c[i + 1], i + 1);
	turns = poly_roots(&slope, lo, hi, &at[1]);
	mpf_set(at[0], lo);
	mpf_set(at[turns + 1], hi);
	for (unsigned i = 0; i <= turns; i++) {
		if (poly_sign(p, at[i]) * poly_sign(p, at[i + 1]) < 0)
			bisect(p, at[i], at[i + 1], root[n++]);
	}
	for (unsigned i = 0; i <= DEGREE; i++)
		mpf_clear(at[i]);
	poly_clear(&slope);
	return n;
}

/* Add f times the squares of the components in mask, as polynomials in t. */
static void add_square(struct poly *p, const struct line *l, unsigned mask, double f)
{
	for (unsigned k = 0; k < 3; k++) {
		if (!(mask >> k & 1))
			continue;
		for (unsigned i = 0; i < 3; i++) {
			mpf_mul(tmp[1], i < 2 ? l->o[k] : l->d[k], i < 1 ? l->o[k] : l->d[k]);
			mpf_set_d(tmp[2], i == 1 ? 2 * f : f);
			mpf_mul(tmp[1], tmp[1], tmp[2]);
			mpf_add(p->c[i], p->c[i], tmp[1]);
		}
	}
}

static void add_product(mpf_t out, const mpf_t a, const mpf_t b, double f)
{
	mpf_set_d(tmp[1], f);
	mpf_mul(tmp[1], tmp[1], a);
	mpf_mul(tmp[1], tmp[1], b);
	mpf_add(out, out, tmp[1]);
}

static void add_number(mpf_t out, double a, double b)
{
	mpf_set_d(tmp[1], a);
	mpf_set_d(tmp[2], b);
	mpf_mul(tmp[1], tmp[1], tmp[2]);
	mpf_add(out, out, tmp[1]);
}

/* ---- shapes of size 1 ---- */

enum shape { SPHERE, TORUS, CYLINDER, CONE };

static const double major = 0.75, minor = 0.25, low = 1, high = 0.25, half = 0.75; /* radii, half a height */

static double at(const struct line *l, unsigned axis, const mpf_t t)
{
	mpf_mul(tmp[1], l->d[axis], t);
	mpf_add(tmp[1], tmp[1], l->o[axis]);
	return mpf_get_d(tmp[1]);
}

static void keep(struct found *f, const mpf_t t)
{
	if (f->n < ROOTS)
		f->t[f->n++] = mpf_get_d(t);
}

/* Where the round side is met: x^2 + z^2 = (a + b y)^2 for |y| <= half; spheres and tori have no ends. */
static void side(enum shape s, const struct line *l, const mpf_t lo, const mpf_t hi, struct found *f)
{
	double b = s == CONE ? (high - low) / (2 * half) : 0, a = s == CONE ? (high + low) / 2 : 1;
	struct poly p, q;
	mpf_t root[DEGREE];
	unsigned n;

	poly_init(&p, 2);
	poly_init(&q, DEGREE);
	for (unsigned i = 0; i < DEGREE; i++)
		mpf_init2(root[i], BITS);
	add_square(&p, l, s == CYLINDER || s == CONE ? 5 : 7, 1);
	if (s == CONE) {
		add_square(&p, l, 2, -b * b);
		mpf_set_d(tmp[3], -2 * a * b);
		add_product(p.c[0], l->o[1], tmp[3], 1);
		add_product(p.c[1], l->d[1], tmp[3], 1);
	}
	add_number(p.c[0], s == TORUS ? major : a, s == TORUS ? major : -a);
	if (s == TORUS) { /* (p^2 + R^2 - r^2)^2 - 4 R^2 (x^2 + z^2) */
		add_number(p.c[0], minor, -minor);
		for (unsigned i = 0; i < 3; i++) {
			for (unsigned k = 0; k < 3; k++)
				add_product(q.c[i + k], p.c[i], p.c[k], 1);
		}
		add_square(&q, l, 5, -4 * major * major);
	}
	n = poly_roots(s == TORUS ? &q : &p, lo, hi, root);
	for (unsigned i = 0; i < n; i++) {
		if (s == SPHERE || s == TORUS || fabs(at(l, 1, root[i])) <= half)
			keep(f, root[i]);
	}
	for (unsigned i = 0; i < DEGREE; i++)
		mpf_clear(root[i]);
	poly_clear(&p);
	poly_clear(&q);
}

static void end(enum shape s, const struct line *l, int up, struct found *f)
{
	double radius = s == CONE ? up > 0 ? high : low : 1, x, z;
	mpf_t t;

	if (!mpf_sgn(l->d[1]))
		return;
	mpf_init2(t, BITS);
	mpf_set_d(t, up * half);
	mpf_sub(t, t, l->o[1]);
	mpf_div(t, t, l->d[1]);
	x = at(l, 0, t);
	z = at(l, 2, t);
	if (mpf_sgn(t) > 0 && x * x + z * z <= radius * radius)
		keep(f, t);
	mpf_clear(t);
}

/* The nearest t > 0, or 0. */
static double truth(enum shape s, const struct line *l, double reach)
{
	struct found f = { 0 };
	double best = 0;
	mpf_t lo, hi;

	mpf_init2(lo, BITS);
	mpf_init2(hi, BITS);
	mpf_set_d(hi, reach);
	side(s, l, lo, hi, &f);
	if (s == CYLINDER || s == CONE) {
		end(s, l, 1, &f);
		end(s, l, -1, &f);
	}
	for (unsigned i = 0; i < f.n; i++)
		best = best > 0 && best < f.t[i] ? best : f.t[i];
	mpf_clear(lo);
	mpf_clear(hi);
	return best;
}

/* ---- the program's answer ---- */

struct world {
	struct mem_book book;
	struct scene scene;
	struct geometry *geometry;
	struct pool *pool;
};

static bool begin(struct world *w, enum shape s)
{
	struct object *o;
	struct diag d = { .sink = NULL };
	uint32_t i;

	memset(w, 0, sizeof(*w));
	mem_book_init(&w->book, 0);
	w->pool = pool_new(1);
	scene_init(&w->scene, &w->book);
	i = scene_add_object(&w->scene);
	scene_add_root(&w->scene, i);
	o = &w->scene.object[i];
	if (s == SPHERE) {
		o->kind = SHAPE_SPHERE;
		o->shape.sphere.radius = 1;
	} else if (s == TORUS) {
		o->kind = SHAPE_TORUS;
		o->shape.torus.major = major;
		o->shape.torus.minor = minor;
	} else {
		o->kind = SHAPE_CONE;
		o->shape.cone.base = vec_make(0, -half, 0);
		o->shape.cone.apex = vec_make(0, half, 0);
		o->shape.cone.base_radius = s == CONE ? low : 1;
		o->shape.cone.apex_radius = s == CONE ? high : 1;
	}
	return geometry_build(&w->geometry, &w->scene, NULL, w->pool, &w->book, false, &d) == STATUS_OK;
}

static void finish(struct world *w)
{
	geometry_free(w->geometry);
	scene_release(&w->scene);
	pool_free(w->pool);
}

static void set_line(struct line *l, const ald_ray *r)
{
	for (unsigned k = 0; k < 3; k++) {
		mpf_set_d(l->o[k], ald_get(&r->org, k));
		mpf_set_d(l->d[k], ald_get(&r->dir, k));
	}
}

/* Of the angle between the ray and the surface's normal where the ray meets it; at a rim the less of the two. */
static double cosine(enum shape s, vec p, vec d)
{
	double slope = s == CONE ? (high - low) / (2 * half) : 0, round = hypot(p.x, p.z);
	vec n = p;
	double end = fabs(d.y), side;

	if (s == TORUS)
		n = vec_make(p.x - major * p.x / round, p.y, p.z - major * p.z / round);
	if (s == CYLINDER || s == CONE)
		n = vec_make(p.x / round, -slope, p.z / round);
	side = fabs(vec_dot(vec_unit(n), d));
	if (s == SPHERE || s == TORUS || half - fabs(p.y) > 1e-6)
		return side;
	return round < (s == CONE ? (p.y > 0 ? high : low) : 1) - 1e-6 ? end : fmin(end, side);
}

static bool cell(enum shape s, double away, uint32_t rays, uint64_t seed, double allowed)
{
	static const char *const name[] = { "sphere", "torus", "cylinder", "cone" };
	static unsigned tests;
	uint32_t hits = 0, wrong = 0;
	double worst = 0, across = 0;
	struct line l;
	struct world w;
	bool good = begin(&w, s);

	for (unsigned k = 0; k < 3; k++) {
		mpf_init2(l.o[k], BITS);
		mpf_init2(l.d[k], BITS);
	}
	for (uint32_t i = 0; good && i < rays; i++) {
		vec d = random_direction(&seed), to = vec_scale(random_direction(&seed), 1.2 * random_unit(&seed));
		ald_ray r = { .tmax = ALD_INF, .mask = ~0u, .skip = ALD_NONE, .after = ALD_NONE,
			      .after_sub = { ALD_NONE, ALD_NONE } };
		double t, length;
		ald_hit hit;

		r.org = vec_scale(d, away);
		r.dir = vec_sub(to, r.org);
		if (i & 1)
			r.dir = vec_unit(r.dir);
		length = vec_length(r.dir);
		set_line(&l, &r);
		t = truth(s, &l, 2 * (away + 2) / length);
		trace_nearest(w.geometry, 0, &r, &hit, 1, 0);
		hits += t > 0;
		if ((t > 0) != (hit.prim != ALD_NONE) || (t > 0 && fabs(hit.t - t) * length > 1e-3))
			wrong++;
		else if (t > 0) {
			double off = fabs(hit.t - t) * length;

			worst = fmax(worst, off);
			across = fmax(across, off * cosine(s, vec_mad(r.org, r.dir, t), vec_unit(r.dir)));
		}
	}
	good = good && hits > rays / 4 && !wrong && across <= allowed;
	printf("%sok %u - h: %s from %g radii\n", good ? "" : "not ", ++tests, name[s], away);
	printf("# %u rays, %u hit, %u wrong; point off by %.1e radii along the ray, %.1e across the surface, at most "
	       "%.1e is wanted\n", rays, hits, wrong, worst, across, allowed);
	fflush(stdout);
	for (unsigned k = 0; k < 3; k++) {
		mpf_clear(l.o[k]);
		mpf_clear(l.d[k]);
	}
	finish(&w);
	return good;
}

int main(int argc, char **argv)
{
	uint32_t rays = 200;
	uint64_t seed = 1;
	unsigned failures = 0, tests = 0;
	int c;

	while ((c = getopt(argc, argv, "n:s:")) != -1) {
		if (c == 'n')
			rays = (uint32_t)strtoul(optarg, NULL, 10);
		else if (c == 's')
			seed = strtoull(optarg, NULL, 10);
		else
			return 2;
	}
	for (unsigned i = 0; i < 4; i++)
		mpf_init2(tmp[i], BITS);
	for (enum shape s = SPHERE; s <= CONE; s++) {
		for (int e = 1; e <= (s == SPHERE ? 8 : 6); e++, tests++) {
			double away = pow(10, e);

			/* To some nine roundoffs of the way there. */
			failures += !cell(s, away, s == SPHERE ? rays : rays / 10, seed + tests, 1e-15 * away);
		}
	}
	printf("1..%u\n", tests);
	return failures > 0;
}
