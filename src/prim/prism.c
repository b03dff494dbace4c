/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Prisms: closed curves (x(u), z(u)) swept along y, or conically from the origin (manual 3.4.5.1.11). Each piece of
 * a curve is a primitive, and so is each end.
 *
 * The plane through the line that holds the direction of sweeping meets the wall above (x, z) where A x + B z + C = 0:
 * a polynomial of u no higher than the curve's, in both kinds of sweep. Pieces share their ends to the bit and see
 * the same sign there.
 */
#include "prim/body.h"
#include "prim/curve.h"
#include "prim/poly.h"

struct wall {
	double x[4], z[4], end_x[2], end_z[2];
	double out; /* 1: (z', -x') points out of the prism, or -1 */
};

struct prim_prism {
	struct body_data head;
	bool conic;
	unsigned degree;
	double end[2]; /* heights */
	uint32_t walls;
	struct wall *wall; /* [walls] */
};

/* a x(u) + b z(u) + c */
struct cut {
	const struct wall *w;
	unsigned n;
	double a, b, c;
};

static void at_wall(const struct wall *w, unsigned n, double u, double *x, double *z)
{
	if (u == 0 || u == 1) {
		*x = w->end_x[u == 1];
		*z = w->end_z[u == 1];
	} else {
		*x = poly_value(w->x, n, u);
		*z = poly_value(w->z, n, u);
	}
}

static double beside(const void *arg, double u)
{
	const struct cut *c = arg;
	double x, z;

	at_wall(c->w, c->n, u, &x, &z);
	return c->a * x + c->b * z + c->c;
}

/* Where the piece crosses the line of cut. */
static unsigned crossings(const struct cut *c, double root[3])
{
	double f[4], slope[3], at[3], x = 0, fx = beside(c, 0);
	unsigned n, found = 0;

	for (unsigned i = 0; i <= c->n; i++)
		f[i] = c->a * c->w->x[i] + c->b * c->w->z[i];
	poly_slope(f, c->n, slope);
	n = c->n > 1 ? poly_roots(slope, c->n - 1, 0, 1, at) : 0;
	at[n] = 1;
	for (unsigned i = 0; i <= n; i++) {
		double fy = beside(c, at[i]);

		if ((fx < 0) != (fy < 0))
			root[found++] = poly_refine(beside, c, x, fx, at[i], fy);
		x = at[i];
		fx = fy;
	}
	return found;
}

/* Is the point of the plane within the curves, by the parity of those further out along x? */
static bool within(const struct prim_prism *p, double x, double z)
{
	bool in = false;

	for (uint32_t i = 0; i < p->walls; i++) {
		struct cut c = { &p->wall[i], p->degree, 0, 1, -z };
		double root[3], at, there;
		unsigned n = crossings(&c, root);

		while (n--) {
			at_wall(c.w, c.n, root[n], &at, &there);
			in ^= at > x;
		}
	}
	return in;
}

static bool wall_next(const struct prim_prism *p, const struct wall *w, vec o, vec d, double from,
		      struct body_root *out)
{
	struct cut c = { w, p->degree, d.z, -d.x, o.z * d.x - o.x * d.z };
	double root[3], best = ALD_INF;
	unsigned n;

	if (p->conic) {
		c.a = o.y * d.z - o.z * d.y;
		c.b = o.x * d.y - o.y * d.x;
	}
	n = crossings(&c, root);
	while (n--) {
		double x, z, nx = d.x, nz = d.z, t, y;

		at_wall(w, p->degree, root[n], &x, &z);
		if (p->conic) {
			nx -= x * d.y;
			nz -= z * d.y;
			x = x * o.y;
			z = z * o.y;
		}
		t = fabs(nx) > fabs(nz) ? (x - o.x) / nx : (z - o.z) / nz;
		y = o.y + t * d.y;
		if (y >= p->end[0] && y <= p->end[1] && t > from && t < best) {
			best = t;
			*out = (struct body_root){ t, root[n] };
		}
	}
	return best < ALD_INF;
}

static bool prism_next(const struct prim *q, uint32_t piece, const struct prim_line *line, double from,
		       struct body_root *out)
{
	const struct prim_prism *p = q->data;
	vec o = line->o, d = line->d;
	double h, t, s;

	if (piece < p->walls)
		return wall_next(p, &p->wall[piece], o, d, from, out);
	h = p->end[piece - p->walls];
	s = p->conic ? h : 1;
	t = (h - o.y) / d.y;
	if (s == 0 || !isfinite(t) || !(t > from) || !within(p, (o.x + t * d.x) / s, (o.z + t * d.z) / s))
		return false;
	*out = (struct body_root){ t, 0 };
	return true;
}

static void prism_surface(const struct prim *q, vec at, uint32_t piece, double u, struct prim_point *s)
{
	const struct prim_prism *p = q->data;
	double slope[3], x, z, dx, dz, y;
	const struct wall *w;

	s->p = at;
	if (piece >= p->walls) {
		s->p.y = p->end[piece - p->walls];
		s->n = vec_make(0, piece > p->walls ? 1 : -1, 0);
		return;
	}
	w = &p->wall[piece];
	y = s->p.y = fmax(p->end[0], fmin(p->end[1], at.y));
	at_wall(w, p->degree, u, &x, &z);
	poly_slope(w->x, p->degree, slope);
	dx = poly_value(slope, p->degree - 1, u);
	poly_slope(w->z, p->degree, slope);
	dz = poly_value(slope, p->degree - 1, u);
	s->n = vec_make(dz, p->conic ? dx * z - dz * x : 0, -dx);
	s->n = vec_unit(vec_scale(s->n, p->conic && y < 0 ? -w->out : w->out));
	if (!(vec_dot(s->n, s->n) > 0.5))
		s->n = vec_make(1, 0, 0); /* a cusp */
	s->p.x = p->conic ? x * y : x;
	s->p.z = p->conic ? z * y : z;
}

/* Open prisms hold what they would with their ends. */
static bool prism_inside(const struct prim *q, vec at)
{
	const struct prim_prism *p = q->data;
	double s = p->conic ? at.y : 1;

	return at.y >= p->end[0] && at.y <= p->end[1] && s != 0 && within(p, at.x / s, at.z / s);
}

/* The greatest and the least of m.x x + m.z z. */
static void wall_range(const struct wall *w, unsigned n, vec m, double *lo, double *hi)
{
	double f[4], slope[3], root[3];
	unsigned k = 0;

	*hi = fmax(m.x * w->end_x[0] + m.z * w->end_z[0], m.x * w->end_x[1] + m.z * w->end_z[1]);
	*lo = fmin(m.x * w->end_x[0] + m.z * w->end_z[0], m.x * w->end_x[1] + m.z * w->end_z[1]);
	for (unsigned i = 0; i <= n; i++)
		f[i] = m.x * w->x[i] + m.z * w->z[i];
	poly_slope(f, n, slope);
	if (n > 1)
		k = poly_roots(slope, n - 1, 0, 1, root);
	while (k--) {
		*hi = fmax(*hi, poly_value(f, n, root[k]));
		*lo = fmin(*lo, poly_value(f, n, root[k]));
	}
}

static double prism_reach(const struct prim *q, uint32_t piece, vec m)
{
	const struct prim_prism *p = q->data;
	uint32_t first = piece < p->walls ? piece : 0, end = piece < p->walls ? piece + 1 : p->walls;
	double most = -ALD_INF, lo, hi;

	for (uint32_t i = first; i < end; i++) {
		wall_range(&p->wall[i], p->degree, m, &lo, &hi);
		for (uint32_t k = 0; k < 2; k++) {
			double s = p->conic ? p->end[k] : 1;

			if (piece < p->walls || piece - p->walls == k)
				most = fmax(most, fmax(s * lo, s * hi) + m.y * p->end[k]);
		}
	}
	return most;
}

static uint32_t prism_pieces(const struct scene *s, const struct object *o)
{
	const struct prism *p = &s->prism[o->shape.prism.index];

	return p->count / 4 + (p->open ? 0 : 2);
}

/* Own coordinates: the middle of all, or where a cone's tip is. */
static void prism_head(const struct prism *in, uint32_t pieces, struct body_data *head)
{
	double lo[2] = { ALD_INF, ALD_INF }, hi[2] = { -ALD_INF, -ALD_INF }, size = (in->hi - in->lo) / 2;
	double far = fmax(fabs(in->lo), fabs(in->hi));

	for (uint32_t i = 0; i < in->count; i++) {
		for (unsigned k = 0; k < 2; k++) {
			lo[k] = fmin(lo[k], in->point[i][k]);
			hi[k] = fmax(hi[k], in->point[i][k]);
		}
	}
	*head = (struct body_data){ .pieces = pieces };
	if (in->conic) {
		size = 1;
		for (unsigned k = 0; k < 2; k++)
			size = fmax(size, fmax(fabs(lo[k]), fabs(hi[k])));
		head->size = size * far;
		return;
	}
	head->centre = vec_make(lo[0] + (hi[0] - lo[0]) / 2, in->lo + size, lo[1] + (hi[1] - lo[1]) / 2);
	head->size = fmax(size, fmax(hi[0] - lo[0], hi[1] - lo[1]) / 2);
}

/* Which side of its piece lies outside, looked at in the middle. */
static void turn_out(const struct prim_prism *p, struct wall *w)
{
	double slope[3], x, z, dx, dz, l, step = 1e-7;

	at_wall(w, p->degree, 0.5, &x, &z);
	poly_slope(w->x, p->degree, slope);
	dx = poly_value(slope, p->degree - 1, 0.5);
	poly_slope(w->z, p->degree, slope);
	dz = poly_value(slope, p->degree - 1, 0.5);
	l = sqrt(dx * dx + dz * dz);
	w->out = 1;
	if (l > 0 && within(p, x + step * dz / l, z - step * dx / l))
		w->out = -1;
}

static void prism_make(const struct scene *s, const struct object *o, void *data)
{
	const struct prism *in = &s->prism[o->shape.prism.index];
	struct prim_prism *p = data;
	double scale;

	*p = (struct prim_prism){ .conic = in->conic, .degree = curve_degree(in->kind), .walls = in->count / 4,
				  .wall = (struct wall *)(p + 1) };
	prism_head(in, prism_pieces(s, o), &p->head);
	p->end[0] = (in->lo - p->head.centre.y) / p->head.size;
	p->end[1] = (in->hi - p->head.centre.y) / p->head.size;
	scale = in->conic ? 1 : p->head.size;
	for (uint32_t i = 0; i < p->walls; i++) {
		struct wall *w = &p->wall[i];
		double x[4], z[4];

		for (unsigned k = 0; k < 4; k++) {
			x[k] = (in->point[4 * i + k][0] - p->head.centre.x) / scale;
			z[k] = (in->point[4 * i + k][1] - p->head.centre.z) / scale;
		}
		curve_term(in->kind, x, w->x, w->end_x);
		curve_term(in->kind, z, w->z, w->end_z);
	}
	for (uint32_t i = 0; i < p->walls; i++)
		turn_out(p, &p->wall[i]);
}

static size_t prism_bytes(const struct scene *s, const struct object *o)
{
	return sizeof(struct prim_prism) + s->prism[o->shape.prism.index].count / 4 * sizeof(struct wall);
}

static uint32_t prism_shape(const struct scene *s, const struct object *o, uint32_t *count)
{
	*count = s->prism_count;
	return o->shape.prism.index;
}

const struct body_ops prism_ops = { prism_shape, prism_pieces, prism_bytes,   prism_make,
				    prism_reach, prism_next,   prism_surface, prism_inside };
