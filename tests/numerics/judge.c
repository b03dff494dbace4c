/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Every accelerator against exact arithmetic, on rays made to be hard: run by judge.sh.
 *
 *	judge [-n RAYS] [-s SEED] [-p PRECISION] [-j PROCESSES] [-c CELL] [-a ACCEL]... [CLASSES]
 *
 * RAYS a cell (3000); PROCESSES share the cells (as many as there are cores), from CELL on (1), with the seeds and
 * numbers that these have among all: a run that was stopped goes on so. Classes (all): a aimed at vertices
 * and edges; b grazing and in the plane of faces; c along axes; d needles and faces without area; e rays that
 * leave surfaces; f extremes of size, and numbers that are none; g sheets very close to each other; r ordinary
 * ones.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "course.h"
#include "crew.h"

static struct trial_tools tools;
static uint32_t rays = 3000;
static uint64_t first_seed = 1;
static uint32_t precision = ALD_PRECISION_DEFAULT;
static const char *want = "abcdefgr"; /* classes */

enum { ANY = UINT32_MAX }; /* a count that is told but not bounded */

struct limits { /* per million; ANY */
	uint32_t leaks, hard, strict, sheets;
};

/* ---- reporting ---- */

static bool within(uint64_t count, uint64_t n, uint32_t limit)
{
	return limit == ANY || (double)count * 1e6 <= (double)limit * (double)n;
}

/* Exact: nothing is wrong, the id neither, and t is the nearest double. (A mesh far off is moved to the origin, which
 * may round that of a ray once.) */
static bool good_enough(char class, const struct tally *t, const struct limits *l)
{
	uint64_t strict = tally_hard(t) + t->silhouettes;

	if (!t->rays || (t->unlike && precision != ALD_PRECISION_FAST) || !t->plain || t->unlike_plain)
		return false;
	if (precision == ALD_PRECISION_FAST) /* told, and held to be sane; f is beyond what floats can hold */
		return within(tally_hard(t), t->rays, class == 'r' ? 0 : 250000) &&
		       within(strict + t->unlike, t->rays, class == 'r' ? 2000 : ANY) &&
		       (class == 'f' || t->t_error <= 0.1);
	if (precision == ALD_PRECISION_EXACT)
		return !strict && !t->neighbours && !t->wrong_ids && !t->wrong_sheet && t->t_error <= 2.3e-16;
	return within(t->leaks, t->rays, l->leaks) && within(tally_hard(t), t->rays, l->hard) &&
	       within(strict, t->rays, l->strict) && within(t->wrong_sheet, t->rays, l->sheets);
}

static void report(const char *name, const struct tally *t, const struct limits *l)
{
	char line[400];

	snprintf(line, sizeof(line),
		 "%llu rays, %llu hit; leak %llu, through %llu, ghost %llu, silhouette %llu, neighbour %llu, "
		 "id %llu, sheet %llu, unlike %llu; t off by %.1e at most",
		 (unsigned long long)t->rays, (unsigned long long)t->hits, (unsigned long long)t->leaks,
		 (unsigned long long)t->through, (unsigned long long)t->ghosts,
		 (unsigned long long)t->silhouettes, (unsigned long long)t->neighbours,
		 (unsigned long long)t->wrong_ids, (unsigned long long)t->wrong_sheet,
		 (unsigned long long)t->unlike, t->t_error);
	crew_tell(name, t, good_enough(*name, t, l), line);
}

/* ---- cells ---- */

/* Adds n rays over the soup, which is then released, to the tally. */
static void run_soup(struct soup *s, struct course *c, trial_ray *make, uint32_t n, uint32_t sheet,
		     struct tally *tally)
{
	struct trial t;

	c->soup = s;
	if (trial_begin(&t, &tools, s)) {
		t.sheet = sheet;
		trial_run(&t, n, make, c, tally);
	} else {
		tally->unlike++;
	}
	trial_end(&t);
	soup_release(s);
}

static vec offset_of(double radius, double k)
{
	return vec_scale(vec_make(0.6, -0.64, 0.48), k * radius);
}

enum { BUMPY, UV, BOX };

static void make_soup(struct soup *s, unsigned kind, uint64_t *seed)
{
	*s = (struct soup){ 0 };
	if (kind == BUMPY)
		soup_bumpy(s, 0.15, seed);
	else if (kind == UV)
		soup_uv(s);
	else
		soup_box(s);
}

static struct course course_of(double scale, double k, bool floats, uint64_t seed)
{
	return (struct course){ .centre = offset_of(scale, k), .radius = scale, .floats = floats, .seed = seed };
}

static uint64_t next_seed(void)
{
	return first_seed * 0x9e3779b97f4a7c15u + crew_cell();
}

/* One cell over three meshes. */
static void cell_meshes(const char *name, double scale, double k, bool floats, bool inside,
			trial_ray *make, const struct limits *l)
{
	struct course c = course_of(scale, k, floats, next_seed());
	struct tally tally = { 0 };
	struct soup s;

	if (!crew_claims())
		return;
	c.inside = inside;
	for (unsigned kind = BUMPY; kind <= BOX; kind++) {
		make_soup(&s, kind, &c.seed);
		soup_place(&s, scale, c.centre, floats);
		run_soup(&s, &c, make, rays / 3, 0, &tally);
	}
	report(name, &tally, l);
}

static void class_a(void)
{
	static const struct {
		double scale, away; /* of how many radii */
	} at[] = {
		{ 1e-6, 0 }, { 1e-4, 0 }, { 1e-2, 0 }, { 1, 0 }, { 1e2, 0 }, { 1e4, 0 }, { 1e6, 0 }, { 1, 1e3 },
		{ 1e-6, 1e6 }, { 1, 1e6 }, { 1e6, 1e6 }, { 1e-6, 1e8 }, { 1, 1e8 }, { 1e6, 1e8 },
	};
	const struct limits l = { 0, 70, ANY, ANY };
	char name[200];

	for (unsigned d = 0; d < 2; d++) {
		for (unsigned i = 0; i < 2 * sizeof(at) / sizeof(at[0]); i++) {
			double s = at[i / 2].scale, k = at[i / 2].away;

			if (!d && k > 1e6) /* as floats the meshes collapse there */
				continue;
			snprintf(name, sizeof(name), "a: aimed, %s, from %s, scale %g, %g radii off",
				 d ? "doubles" : "floats", i & 1 ? "inside" : "outside", s, k);
			cell_meshes(name, s, k, !d, i & 1, ray_aimed, &l);
		}
	}
}

static void class_r(void)
{
	const struct limits l = { 0, 0, 0, ANY };

	cell_meshes("r: ordinary, floats", 1, 0, true, false, ray_ordinary, &l);
	cell_meshes("r: ordinary, doubles, 1e6 radii off", 1, 1e6, false, false, ray_ordinary, &l);
}

static void cell_kind(const char *name, unsigned kind, int ulps, bool floats, trial_ray *make,
		      const struct limits *l)
{
	struct course c = course_of(1, 0, floats, next_seed());
	struct tally tally = { 0 };
	struct soup s;

	if (!crew_claims())
		return;
	c.ulps = ulps;
	make_soup(&s, kind, &c.seed);
	soup_place(&s, 1, c.centre, floats);
	run_soup(&s, &c, make, rays, 0, &tally);
	report(name, &tally, l);
}

static void class_b(void)
{
	const struct limits few = { 0, ANY, 880, ANY }, none = { 0, 0, 0, ANY }, told = { 0, ANY, ANY, ANY };

	cell_kind("b: in the plane of a face, floats", BOX, 0, true, ray_in_plane, &few);
	cell_kind("b: an ulp outside of a face, floats", BOX, 1, true, ray_in_plane, &none);
	cell_kind("b: an ulp inside of a face, floats", BOX, -1, true, ray_in_plane, &few);
	cell_kind("b: grazing, floats", BUMPY, 0, true, ray_grazing, &few);
	cell_kind("b: in the plane of a face, doubles", BOX, 0, false, ray_in_plane, &told);
	cell_kind("b: an ulp outside of a face, doubles", BOX, 1, false, ray_in_plane, &none);
	cell_kind("b: an ulp inside of a face, doubles", BOX, -1, false, ray_in_plane, &told);
	cell_kind("b: grazing, doubles", BUMPY, 0, false, ray_grazing, &told);
}

static void class_c(void)
{
	const struct limits none = { 0, 0, 0, ANY };

	cell_kind("c: along axes in the lattice of a box, floats", BOX, 0, true, ray_axis, &none);
	cell_kind("c: along axes through vertices, floats", BUMPY, 0, true, ray_axis, &none);
	cell_kind("c: along axes through vertices, doubles", BUMPY, 0, false, ray_axis, &none);
}

static void cell_d(const char *name, vec stretch, bool needles, bool degenerates, bool floats,
		   const struct limits *l)
{
	struct course c = course_of(1, 0, floats, next_seed());
	struct tally tally = { 0 };
	struct soup s;

	if (!crew_claims())
		return;
	for (unsigned kind = BUMPY; kind <= BOX; kind++) {
		s = (struct soup){ 0 };
		if (needles)
			soup_needles(&s, 1024, 1e6, &c.seed);
		else
			make_soup(&s, kind, &c.seed);
		if (degenerates)
			soup_degenerates(&s);
		soup_stretch(&s, stretch);
		soup_place(&s, 1, c.centre, floats);
		c.radius = soup_diameter(&s) / 2;
		run_soup(&s, &c, ray_mixed, rays / 3, 0, &tally);
	}
	report(name, &tally, l);
}

static void class_d(void)
{
	static const struct {
		const char *name;
		vec stretch;
		bool needles, degenerates;
	} cell[] = {
		{ "1 x 1 x 1e-6", { 1, 1, 1e-6 }, false, false }, { "1e6 x 1 x 1", { 1e6, 1, 1 }, false, false },
		{ "1 x 1 x 1e-3", { 1, 1, 1e-3 }, false, false },
		{ "1e3 x 1 x 1e-3", { 1e3, 1, 1e-3 }, false, false },
		{ "needles of 1e6 to 1", { 1, 1, 1 }, true, false },
		{ "with faces without area", { 1, 1, 1 }, false, true },
	};
	const struct limits none = { 0, 0, 0, ANY }, told = { 0, ANY, ANY, ANY };
	char name[200];

	for (unsigned d = 0; d < 2; d++) {
		for (unsigned i = 0; i < sizeof(cell) / sizeof(cell[0]); i++) {
			snprintf(name, sizeof(name), "d: %s, %s", cell[i].name, d ? "doubles" : "floats");
			cell_d(name, cell[i].stretch, cell[i].needles, cell[i].degenerates, !d, d ? &told : &none);
		}
	}
}

static void cell_f(const char *name, double scale, double bad, unsigned shells, const struct limits *l)
{
	struct course c = course_of(scale, 0, true, next_seed());
	struct tally tally = { 0 };
	struct soup s = { 0 };

	if (!crew_claims())
		return;
	soup_bumpy(&s, 0.15, &c.seed);
	soup_place(&s, scale, vec_make(0, 0, 0), true);
	for (unsigned i = 0; i < 64 && bad != 0; i++) {
		vec v[3] = { s.vertex[i], s.vertex[i + 1], s.vertex[i + 2] };

		(&v[i % 3].x)[i / 3 % 3] = i & 1 ? -bad : bad;
		soup_triangle(&s, v[0], v[1], v[2]);
	}
	for (unsigned i = 0; i < shells; i++) { /* concentric, from huge to tiny */
		struct soup inner = { 0 };

		soup_bumpy(&inner, 0.15, &c.seed);
		soup_place(&inner, i ? 1e-20 : 1e15, vec_make(0, 0, 0), true);
		for (uint32_t k = 0; k < inner.triangles; k++)
			soup_triangle(&s, inner.vertex[inner.triangle[k][0]], inner.vertex[inner.triangle[k][1]],
				      inner.vertex[inner.triangle[k][2]]);
		soup_release(&inner);
	}
	run_soup(&s, &c, ray_mixed, rays, 0, &tally);
	report(name, &tally, l);
}

static void ray_bad(void *arg, uint32_t i, ald_ray *r)
{
	static const double bad[] = { (double)NAN, (double)INFINITY, -(double)INFINITY };

	ray_ordinary(arg, i, r);
	if (i % 8 == 6)
		r->dir = vec_make(0, -0.0, 0);
	else if (i % 8 == 7)
		r->tmin = i & 8 ? 2 : i & 16 ? (double)NAN : 0, r->tmax = i & 8 || i & 16 ? 1 : (double)NAN;
	else
		(i & 1 ? &r->org.x : &r->dir.x)[i / 2 % 3] = bad[i / 8 % 3];
}

static void class_f(void)
{
	static const double scale[] = { 1e-40, 1e-30, 1e-20, 1e-12, 1e12, 1e18, 1e20, 1e30 };
	static const double bad[] = { (double)NAN, (double)INFINITY, 1e30, 1e38 };
	const struct limits l = { 0, 0, ANY, ANY }, none = { 0, 0, 0, ANY };
	char name[200];

	for (unsigned i = 0; i < sizeof(scale) / sizeof(scale[0]); i++) {
		snprintf(name, sizeof(name), "f: scale %g", scale[i]);
		cell_f(name, scale[i], 0, 0, &l);
	}
	for (unsigned i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
		snprintf(name, sizeof(name), "f: 64 more triangles with a corner at %g", bad[i]);
		cell_f(name, 1, bad[i], 0, &l);
	}
	cell_f("f: shells of 1e15, 1 and 1e-20 in each other", 1, 0, 2, &l);
	cell_kind("f: rays with a NaN, an infinity, no direction, no extent", BUMPY, 0, true, ray_bad, &none);
}

struct sheets {
	struct course c;
	struct xform turn;
	double height;
};

static void ray_to_sheet(void *arg, uint32_t i, ald_ray *r)
{
	struct sheets *s = arg;
	vec to = vec_make(0.99 * random_signed(&s->c.seed), 0.99 * random_signed(&s->c.seed), s->height);
	vec from = vec_make(random_signed(&s->c.seed), random_signed(&s->c.seed), i & 1 ? 2 * s->height : 0);

	ray_start(r);
	r->org = kept_vec(&s->c, mat_point(&s->turn.fwd, from));
	r->dir = kept_vec(&s->c, vec_sub(mat_point(&s->turn.fwd, to), r->org));
}

static void cell_g(const char *name, double gap, bool turned, bool floats, const struct limits *l)
{
	struct sheets g = { .c = course_of(10, 0, floats, next_seed()), .height = 10 };
	struct xform x = xform_rotate(vec_make(31, 17, 53));
	struct tally tally = { 0 };
	struct soup s = { 0 };

	if (!crew_claims())
		return;
	g.turn = turned ? x : xform_identity;
	soup_sheets(&s, g.height, gap);
	soup_turn(&s, &g.turn.fwd);
	soup_place(&s, 1, vec_make(0, 0, 0), floats);
	run_soup(&s, &g.c, ray_to_sheet, rays, s.triangles / 2, &tally);
	report(name, &tally, l);
}

static void class_g(void)
{
	const struct limits none = { 0, 0, ANY, 0 }, told = { 0, ANY, ANY, ANY };
	double ulp = (double)(nextafterf(10, 11) - 10);

	cell_g("g: sheets a float's ulp apart", ulp, false, true, &none);
	cell_g("g: sheets a float's ulp apart, turned, floats", ulp, true, true, &none);
	cell_g("g: sheets 1e-5 apart, turned, floats", 1e-5, true, true, &none);
	cell_g("g: sheets 1e-6 apart, turned, doubles", 1e-6, true, false, &none);
	cell_g("g: sheets a float's ulp apart, turned, doubles", ulp, true, false, &none);
	cell_g("g: sheets a double's ulp apart", nextafter(10, 11) - 10, false, false, &told);
}

/* ---- rays that leave surfaces ---- */

struct leaving {
	struct trial trial;
	struct tally tally;
};

/* From where a ray of the course first hits, off along the normal by the error bound, as shading does it. */
static bool leave(struct leaving *e, struct course *c, ald_ray *r, struct surface *at)
{
	const struct geometry *g = e->trial.geometry[0];
	ald_hit hit;
	vec d;

	ray_ordinary(c, (uint32_t)e->tally.rays, r);
	trace_nearest(g, 0, r, &hit, 1, 0);
	if (hit.prim == ALD_NONE)
		return false;
	surface_at(g, r, &hit, at);
	do {
		d = random_direction(&c->seed);
	} while (fabs(vec_dot(d, at->n)) <= 1e-3);
	if ((vec_dot(d, at->n) < 0) != (vec_dot(r->dir, at->n) > 0))
		d = vec_neg(d); /* to the side the ray came from */
	ray_start(r);
	r->org = vec_mad(at->p, at->n, vec_dot(d, at->n) < 0 ? -at->error : at->error);
	r->dir = d;
	r->skip = at->planar ? hit.prim : ALD_NONE;
	return true;
}

/* own: how many triangles the sheet has that was left. */
static void judge_leaving(struct leaving *e, uint32_t accel, const ald_ray *r, uint32_t own, bool wall)
{
	ald_hit hit;

	trace_nearest(e->trial.geometry[accel], 0, r, &hit, 1, 0);
	e->tally.missed += wall && hit.prim == ALD_NONE;
	e->tally.foreign += hit.prim != ALD_NONE && trial_triangle(&e->trial, &hit) < own;
}

static void cell_e(const char *name, double scale, double k, double gap, bool floats)
{
	struct course c = course_of(scale, k, floats, next_seed());
	struct leaving e = { 0 };
	struct soup s = { 0 };
	uint32_t own, own_id;
	char line[200];
	bool good;

	if (!crew_claims())
		return;
	soup_bumpy(&s, 0, &c.seed);
	own = s.triangles;
	for (uint32_t i = 0; i < own && gap > 0; i++) {
		vec v[3];

		for (unsigned j = 0; j < 3; j++)
			v[j] = vec_scale(s.vertex[s.triangle[i][j]], 1 + gap);
		soup_triangle(&s, v[0], v[1], v[2]);
	}
	soup_place(&s, scale, c.centre, floats);
	c.soup = &s;
	c.inside = gap > 0; /* the inner sheet from within, the outer one is behind it */
	good = trial_begin(&e.trial, &tools, &s);
	for (uint32_t i = 0; good && i < rays; i++) {
		struct surface at;
		ald_hit hit;
		ald_ray r;

		if (!leave(&e, &c, &r, &at))
			continue;
		e.tally.rays++;
		if (gap > 0) { /* on through the inner sheet */
			r.org = vec_mad(at.p, at.n, vec_dot(r.dir, at.n) < 0 ? at.error : -at.error);
			r.dir = vec_neg(r.dir);
		}
		for (uint32_t a = 0; a < tools.accels; a++)
			judge_leaving(&e, a, &r, own, gap > 0);
		own_id = r.skip;
		r.skip = ALD_NONE; /* the error bound has to do alone */
		trace_nearest(e.trial.geometry[0], 0, &r, &hit, 1, 0);
		e.tally.self += own_id != ALD_NONE && hit.prim == own_id;
	}
	good = good && e.tally.rays > rays / 2 &&
	       (precision == ALD_PRECISION_FAST || (!e.tally.self && !e.tally.foreign && !e.tally.missed));
	snprintf(line, sizeof(line),
		 "%llu rays: own triangle, were it not skipped, %llu, others of the sheet %llu, wall missed %llu",
		 (unsigned long long)e.tally.rays, (unsigned long long)e.tally.self,
		 (unsigned long long)e.tally.foreign, (unsigned long long)e.tally.missed);
	crew_tell(name, &e.tally, good, line);
	trial_end(&e.trial);
	soup_release(&s);
}

static void class_e(void)
{
	static const struct {
		double scale, away; /* of how many radii */
	} at[] = {
		{ 1e-6, 0 }, { 1e-3, 0 }, { 1, 0 }, { 1e3, 0 }, { 1e6, 0 },
		{ 1, 1e3 }, { 1, 1e5 }, { 1e-6, 1e6 }, { 1, 1e6 }, { 1e6, 1e6 },
	};
	static const double gap[] = { 0, 1e-2, 1e-4, 1e-6 };
	char name[200];

	for (unsigned i = 0; i < sizeof(at) / sizeof(at[0]); i++) {
		for (unsigned g = 0; g < 4; g++) {
			double s = at[i].scale, k = at[i].away;

			snprintf(name, sizeof(name), "e: leaving a ball, scale %g, %g radii off, wall at %g radii", s,
				 k, gap[g]);
			cell_e(name, s, k, gap[g], k == 0 && gap[g] != 1e-6);
		}
	}
}

static const struct {
	char name;
	void (*run)(void);
} classes[] = {
	{ 'a', class_a }, { 'b', class_b }, { 'c', class_c }, { 'd', class_d },
	{ 'e', class_e }, { 'f', class_f }, { 'g', class_g }, { 'r', class_r },
};

static void run_classes(void)
{
	for (unsigned i = 0; i < sizeof(classes) / sizeof(classes[0]); i++) {
		if (strchr(want, classes[i].name))
			classes[i].run();
	}
}

static bool named(const char *name, uint32_t *out)
{
	for (*out = ALD_PRECISION_DEFAULT; *out <= ALD_PRECISION_FAST; *out *= 2) {
		if (!strcmp(name, accel_precision_name(*out)))
			return true;
	}
	return false;
}

int main(int argc, char **argv)
{
	/* In floats bvh8 has coordinates of its own, and answers otherwise than the others. */
#ifdef HAVE_EMBREE
	static const char *const all[] = { "octree", "box", "sphere", "none", "bvh8", "embree", NULL };
#else
	static const char *const all[] = { "octree", "box", "sphere", "none", "bvh8", NULL };
#endif
	static const char *const alike[] = { "octree", "box", "sphere", "none", NULL };
	const char *const *usual;
	const char *accel[TRIAL_ACCELS + 1] = { NULL };
	unsigned accels = 0;
	unsigned processes = pool_cores(), first = 1;
	bool good;
	int c;

	while ((c = getopt(argc, argv, "n:s:p:j:c:a:")) != -1) {
		if (c == 'n')
			rays = (uint32_t)strtoul(optarg, NULL, 10);
		else if (c == 's')
			first_seed = strtoull(optarg, NULL, 10);
		else if (c == 'j')
			processes = (unsigned)strtoul(optarg, NULL, 10);
		else if (c == 'c')
			first = (unsigned)strtoul(optarg, NULL, 10);
		else if (c == 'p' && named(optarg, &precision))
			;
		else if (c == 'a' && accels < TRIAL_ACCELS)
			accel[accels++] = optarg;
		else
			return 2;
	}
	if (!first)
		return 2;
	if (optind < argc)
		want = argv[optind];
	usual = precision == ALD_PRECISION_FAST ? alike : all;
	if (!trial_tools_init(&tools, accels ? accel : usual, precision))
		return 1;
	printf("# seed %llu, %u rays a cell, precision %s\n", (unsigned long long)first_seed, rays,
	       accel_precision_name(precision));
	good = crew_run(processes, first - 1, run_classes);
	trial_tools_release(&tools);
	return !good;
}
