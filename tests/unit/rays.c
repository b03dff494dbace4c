/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "rays.h"

#include <stdlib.h>

uint64_t random_next(uint64_t *state)
{
	uint64_t z = *state += 0x9e3779b97f4a7c15u; /* splitmix64 */

	z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
	z = (z ^ z >> 27) * 0x94d049bb133111ebu;
	return z ^ z >> 31;
}

double random_unit(uint64_t *state)
{
	return (double)(random_next(state) >> 11) * 0x1p-53;
}

static double random_in(uint64_t *s, double lo, double hi)
{
	return lo + (hi - lo) * random_unit(s);
}

void mesh_group(struct mesh *m)
{
	m->group_first = realloc(m->group_first, (m->groups + 2) * sizeof(*m->group_first));
	m->group_first[m->groups++] = m->prims.count;
}

/* volatile: gcc 12 at -O2 takes pairs of (double)(float)x to be x. */
static double round_to_float(double x)
{
	volatile float f = (float)x;

	return (double)f;
}

uint32_t mesh_vertex(struct mesh *m, double x, double y, double z)
{
	if (m->vertices == m->vertex_room) {
		m->vertex_room = 2 * m->vertex_room + 64;
		m->vertex = realloc(m->vertex, m->vertex_room * sizeof(*m->vertex));
	}
	/* So that a mesh of floats is the same mesh. */
	m->vertex[m->vertices] = (ald_vec){ round_to_float(x), round_to_float(y), round_to_float(z) };
	return m->vertices++;
}

void mesh_triangle(struct mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
	uint32_t at = 3 * m->prims.count++;

	if (at + 3 > m->index_room) {
		m->index_room = 2 * m->index_room + 192;
		m->index = realloc(m->index, m->index_room * sizeof(*m->index));
	}
	m->index[at] = a;
	m->index[at + 1] = b;
	m->index[at + 2] = c;
}

/* Two triangles a cell of an n by k grid of vertices that begins at first; closed: the ends meet. */
static void add_grid(struct mesh *m, uint32_t first, uint32_t n, uint32_t k, bool closed)
{
	for (uint32_t i = 0; i + !closed < n; i++) {
		for (uint32_t j = 0; j + !closed < k; j++) {
			uint32_t i1 = (i + 1) % n, j1 = (j + 1) % k;

			mesh_triangle(m, first + i * k + j, first + i1 * k + j, first + i1 * k + j1);
			mesh_triangle(m, first + i * k + j, first + i1 * k + j1, first + i * k + j1);
		}
	}
}

void mesh_torus(struct mesh *m, ald_vec centre, double big, double small, uint32_t around, uint32_t across)
{
	uint32_t first = m->vertices;

	mesh_group(m);
	for (uint32_t i = 0; i < around; i++) {
		for (uint32_t j = 0; j < across; j++) {
			double a = 6.283185307179586 * i / around, b = 6.283185307179586 * j / across;
			double r = big + small * cos(b);

			mesh_vertex(m, centre.x + r * cos(a), centre.y + r * sin(a),
				   centre.z + small * sin(b));
		}
	}
	add_grid(m, first, around, across, true);
}

void mesh_field(struct mesh *m, uint32_t n, double size, double height, uint64_t seed)
{
	uint32_t first = m->vertices;
	double wave[12];

	mesh_group(m);
	for (unsigned k = 0; k < 12; k++)
		wave[k] = random_in(&seed, 0.5, 2);
	for (uint32_t i = 0; i <= n; i++) {
		for (uint32_t j = 0; j <= n; j++) {
			double x = (double)i / n, y = (double)j / n, z = 0, f = 3;

			for (unsigned k = 0; k < 6; k++, f *= 1.9)
				z += sin(f * (wave[2 * k] * x + wave[2 * k + 1] * y) + k) *
				     cos(f * (wave[2 * k + 1] * x - wave[2 * k] * y)) / f;
			mesh_vertex(m, (x - 0.5) * size, (y - 0.5) * size, z * height);
		}
	}
	add_grid(m, first, n + 1, n + 1, false);
}

void mesh_soup(struct mesh *m, uint32_t n, double size, double edge, uint64_t seed)
{
	mesh_group(m);
	for (uint32_t i = 0; i < n; i++) {
		double c[3], e = edge * pow(random_unit(&seed), 4);
		uint32_t v[3];

		for (unsigned k = 0; k < 3; k++)
			c[k] = random_in(&seed, -size, size);
		for (unsigned k = 0; k < 3; k++) { /* one in four is a needle, one in sixteen a line */
			double thin = i % 4 || k < 2 ? 1 : i % 16 ? 1e-6 : 0;

			v[k] = mesh_vertex(m, c[0] + thin * random_in(&seed, -e, e),
					  c[1] + thin * random_in(&seed, -e, e),
					  c[2] + thin * random_in(&seed, -e, e));
		}
		mesh_triangle(m, v[0], v[1], i % 16 ? v[2] : v[1]);
	}
}

void mesh_sheets(struct mesh *m, uint32_t n, uint32_t sheets, double gap)
{
	for (uint32_t s = 0; s < sheets; s++) {
		uint32_t first = m->vertices;

		mesh_group(m);
		for (uint32_t i = 0; i <= n; i++) {
			for (uint32_t j = 0; j <= n; j++)
				mesh_vertex(m, (double)i / n, (double)j / n, gap * s);
		}
		add_grid(m, first, n + 1, n + 1, false);
	}
}

void mesh_balls(struct mesh *m, uint32_t n, double radius, uint64_t seed)
{
	mesh_group(m);
	m->ball = realloc(m->ball, (m->balls + n) * sizeof(*m->ball));
	for (uint32_t i = 0; i < n; i++) {
		ald_vec c = { random_in(&seed, -1, 1), random_in(&seed, -1, 1),
			      random_in(&seed, -1, 1) };

		m->ball[m->balls++] = (struct ball){ c, radius * random_unit(&seed) };
	}
	m->prims.count += n;
}

static const struct mesh *mesh_of(const ald_prims *p)
{
	return (const struct mesh *)p;
}

static uint32_t mesh_triangles(const struct mesh *m)
{
	return m->prims.count - m->balls;
}

static void prim_bounds(const ald_prims *p, uint32_t id, ald_box *out)
{
	const struct mesh *m = mesh_of(p);
	ald_box b = ald_box_empty(), point;

	if (id >= mesh_triangles(m)) {
		const struct ball *s = &m->ball[id - mesh_triangles(m)];

		b.lo = (ald_vec){ s->centre.x - s->radius, s->centre.y - s->radius,
				  s->centre.z - s->radius };
		b.hi = (ald_vec){ s->centre.x + s->radius, s->centre.y + s->radius,
				  s->centre.z + s->radius };
	} else {
		for (unsigned k = 0; k < 3; k++) {
			point.lo = point.hi = m->vertex[m->index[3 * id + k]];
			ald_box_join(&b, &point);
		}
	}
	for (unsigned k = 0; k < 3; k++) {
		(&b.lo.x)[k] -= p->pad;
		(&b.hi.x)[k] += p->pad;
	}
	*out = b;
}

static int ball_hit(const struct ball *s, uint32_t id, const ald_ray *r, ald_hit *hit)
{
	double fx = r->org.x - s->centre.x, fy = r->org.y - s->centre.y, fz = r->org.z - s->centre.z;
	double dd = r->dir.x * r->dir.x + r->dir.y * r->dir.y + r->dir.z * r->dir.z;
	double tc = -(fx * r->dir.x + fy * r->dir.y + fz * r->dir.z) / dd;
	double lx = fx + tc * r->dir.x, ly = fy + tc * r->dir.y, lz = fz + tc * r->dir.z;
	double gap = s->radius * s->radius - (lx * lx + ly * ly + lz * lz);

	if (!(gap >= 0))
		return 0;
	for (int side = -1; side <= 1; side += 2) {
		double t = tc + side * sqrt(gap / dd);

		if (ald_counts(r, t, id, hit)) {
			*hit = (ald_hit){ .t = t, .prim = id, .part = side > 0 };
			return 1;
		}
	}
	return 0;
}

static int prim_intersect(const ald_prims *p, uint32_t id, ald_query *q, const ald_ray *r, ald_hit *hit)
{
	const struct mesh *m = mesh_of(p);
	ald_prep prep;
	ald_vec v[3];

	(void)q;
	if (!ald_sees(p, r, id))
		return 0;
	if (id >= mesh_triangles(m))
		return ball_hit(&m->ball[id - mesh_triangles(m)], id, r, hit);
	ald_ray_prep(&m->frame, r, &prep);
	for (unsigned k = 0; k < 3; k++)
		v[k] = m->vertex[m->index[3 * id + k]];
	return ald_triangle(&prep, r, v, id, hit);
}

static void prim_intersect_n(const ald_prims *p, uint32_t id, ald_query *q, const ald_ray *r, ald_hit *hit,
			     const uint8_t *live, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++) {
		if (live[i])
			prim_intersect(p, id, q, &r[i], &hit[i]);
	}
}

void mesh_finish(struct mesh *m, bool as_float, bool with_mask, bool exact)
{
	ald_prims *p = &m->prims;
	ald_box all = ald_box_empty(), box;
	double size;

	mesh_group(m);
	p->size = sizeof(*p);
	p->precision = exact ? ALD_PRECISION_EXACT : ALD_PRECISION_DEFAULT;
	p->bounds = prim_bounds;
	p->intersect = prim_intersect;
	p->intersect_n = prim_intersect_n;
	p->group_count = --m->groups;
	p->group_first = m->group_first;
	p->tri_count = mesh_triangles(m);
	p->vertex_double = !as_float;
	p->index = m->index;
	p->vertex = m->vertex;
	if (as_float) {
		m->vertex_float = malloc(3 * (m->vertices + 1) * sizeof(float));
		for (uint32_t i = 0; i < 3 * m->vertices; i++)
			m->vertex_float[i] = (float)(&m->vertex[0].x)[i];
		p->vertex = m->vertex_float;
		m->origin = calloc(m->groups + 1, sizeof(*m->origin));
		p->origin = m->origin;
	}
	if (with_mask) {
		m->mask = malloc((p->count + 1) * sizeof(*m->mask));
		for (uint32_t i = 0; i < p->count; i++)
			m->mask[i] = 1u << i % 3;
		p->mask = m->mask;
	}
	for (uint32_t i = 0; i < p->count; i++) {
		prim_bounds(p, i, &box);
		ald_box_join(&all, &box);
	}
	p->box = all;
	m->frame = ald_frame_for(p, &all);
	size = fabs(m->frame.centre.x) + fabs(m->frame.centre.y) + fabs(m->frame.centre.z);
	p->pad = 16 * ALD_U * (size + m->frame.radius);
	m->frame.radius += 6 * p->pad;
	for (unsigned k = 0; k < 3 && p->count; k++) {
		(&p->box.lo.x)[k] -= p->pad;
		(&p->box.hi.x)[k] += p->pad;
	}
}

void mesh_settle(const struct mesh *m, const ald_ray *r, ald_hit *hit)
{
	ald_prep prep;
	ald_vec v[3];

	if (m->prims.precision != ALD_PRECISION_EXACT || hit->prim >= mesh_triangles(m))
		return;
	ald_ray_prep(&m->frame, r, &prep);
	for (unsigned k = 0; k < 3; k++)
		v[k] = m->vertex[m->index[3 * hit->prim + k]];
	ald_exact_settle(&prep, v, hit, 0);
}

void mesh_release(struct mesh *m)
{
	free(m->vertex);
	free(m->vertex_float);
	free(m->index);
	free(m->mask);
	free(m->group_first);
	free(m->origin);
	free(m->ball);
}

/* ---- the host ---- */

static void *host_alloc(void *ctx, size_t bytes, const char *what)
{
	return mem_alloc(&((struct test_host *)ctx)->book, what, bytes);
}

static void host_free(void *ctx, void *p)
{
	(void)ctx;
	mem_free(p);
}

struct host_job {
	void (*job)(void *arg, uint32_t i);
	void *arg;
};

static void run_job(void *arg, uint32_t i, uint32_t thread)
{
	struct host_job *j = arg;

	(void)thread;
	j->job(j->arg, i);
}

static void host_parallel(void *ctx, uint32_t n, void (*job)(void *arg, uint32_t i), void *arg)
{
	struct host_job j = { job, arg };

	pool_run(((struct test_host *)ctx)->pool, n, run_job, &j);
}

static int host_progress(void *ctx, double done)
{
	return done >= ((struct test_host *)ctx)->cancel_at;
}

static void host_log(void *ctx, int level, const char *text)
{
	(void)ctx;
	(void)level;
	(void)text;
}

static void host_trim(void *ctx, void *p, size_t bytes)
{
	(void)ctx;
	mem_trim(p, bytes);
}

static int host_account(void *ctx, int64_t bytes, const char *what)
{
	return mem_account_foreign(&((struct test_host *)ctx)->book, what, bytes);
}

void test_host_init(struct test_host *h, uint32_t threads, uint64_t limit)
{
	mem_book_init(&h->book, limit);
	h->pool = pool_new(threads);
	h->cancel_at = 2;
	h->host = (ald_host){
		.abi = ALD_ACCEL_ABI,
		.size = sizeof(h->host),
		.ctx = h,
		.threads = threads,
		.alloc = host_alloc,
		.free = host_free,
		.parallel = host_parallel,
		.progress = host_progress,
		.log = host_log,
		.account = host_account,
		.trim = host_trim,
	};
}

void test_host_release(struct test_host *h)
{
	pool_free(h->pool);
}

/* ---- rays ---- */

static ald_vec any_direction(uint64_t *s)
{
	ald_vec d;
	double dd;

	do {
		d = (ald_vec){ random_in(s, -1, 1), random_in(s, -1, 1), random_in(s, -1, 1) };
		dd = d.x * d.x + d.y * d.y + d.z * d.z;
	} while (dd > 1 || dd < 1e-6);
	return d;
}

static ald_vec some_vertex(const struct mesh *m, uint64_t *s)
{
	if (!m->vertices || random_next(s) % 8 == 0)
		return (ald_vec){ random_in(s, -1, 1), random_in(s, -1, 1), random_in(s, -1, 1) };
	return m->vertex[random_next(s) % m->vertices];
}

/* A point on a plane where an octree cuts the mesh's box: the worst place to start from. */
static ald_vec grid_point(const struct mesh *m, uint64_t *s)
{
	ald_box all = ald_box_empty(), box;
	ald_vec p = some_vertex(m, s);
	unsigned k = (unsigned)(random_next(s) % 3), cuts = 1u << random_next(s) % 8;

	for (uint32_t i = 0; i < m->prims.count; i += m->prims.count / 64 + 1) {
		prim_bounds(&m->prims, i, &box);
		ald_box_join(&all, &box);
	}
	(&p.x)[k] = (&all.lo.x)[k] +
		    ((&all.hi.x)[k] - (&all.lo.x)[k]) * (double)(random_next(s) % (cuts + 1)) / cuts;
	return p;
}

/* Zero some components, with either sign. */
static void zero_some(ald_vec *d, uint64_t *s)
{
	unsigned keep = (unsigned)(random_next(s) % 7) + 1;

	for (unsigned k = 0; k < 3; k++) {
		if (!(keep >> k & 1))
			(&d->x)[k] = random_next(s) % 2 ? 0.0 : -0.0;
	}
}

void ray_make(const struct mesh *m, uint64_t seed, uint32_t i, ald_ray *r)
{
	uint64_t s = seed + i * 0xd1342543de82ef95u;
	double far = random_next(&s) % 4 ? m->frame.radius : m->frame.radius * 1e6;
	ald_vec a = any_direction(&s), b = some_vertex(m, &s), d = any_direction(&s);

	*r = (ald_ray){ .tmax = 1e300, .mask = UINT32_MAX, .skip = ALD_NONE, .after = ALD_NONE,
			.after_sub = { ALD_NONE, ALD_NONE } };
	r->org = (ald_vec){ m->frame.centre.x + a.x * m->frame.radius,
			    m->frame.centre.y + a.y * m->frame.radius,
			    m->frame.centre.z + a.z * m->frame.radius };
	r->dir = d;
	switch (i % 9) {
	case 0: /* from around to a vertex, from afar too */
		r->org = (ald_vec){ b.x + a.x * far, b.y + a.y * far, b.z + a.z * far };
		/* fall through */
	case 1: /* to a vertex */
		r->dir = (ald_vec){ b.x - r->org.x, b.y - r->org.y, b.z - r->org.z };
		break;
	case 2: /* along axes, through a vertex */
		zero_some(&d, &s);
		r->dir = d;
		r->org = (ald_vec){ b.x - d.x * far, b.y - d.y * far, b.z - d.z * far };
		break;
	case 3: /* from a vertex */
		r->org = b;
		if (random_next(&s) % 2)
			zero_some(&r->dir, &s);
		break;
	case 4: /* from a plane between cells, often along it */
		r->org = grid_point(m, &s);
		zero_some(&r->dir, &s);
		break;
	case 5: /* from one vertex to another, grazing what is flat */
		r->org = b;
		b = some_vertex(m, &s);
		r->dir = (ald_vec){ b.x - r->org.x, b.y - r->org.y, b.z - r->org.z };
		break;
	default:
		break;
	}
	if (random_next(&s) % 8 == 0) { /* not a unit length by far */
		double length = ldexp(1, (int)(random_next(&s) % 200) - 100);

		r->dir = (ald_vec){ r->dir.x * length, r->dir.y * length, r->dir.z * length };
	}
	if (random_next(&s) % 8 == 0)
		r->tmin = random_in(&s, 0, 1);
	if (random_next(&s) % 8 == 0)
		r->tmax = random_in(&s, 0, 3);
	if (random_next(&s) % 8 == 0)
		r->mask = (uint32_t)(random_next(&s) % 8);
	if (random_next(&s) % 8 == 0)
		r->skip = (uint32_t)(random_next(&s) % m->prims.count);
	if (random_next(&s) % 4096 == 0)
		(&r->org.x)[random_next(&s) % 6] = random_next(&s) % 2 ? ALD_NAN : ALD_INF;
}
