/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Lathes: a curve (r(u), y(u)) turned about the y axis (manual 3.4.5.1.8); each of its pieces is a primitive.
 *
 * Seen from above the line passes the axis at distance h, and is at radius |r| at two places, -+ sqrt(r^2 - h^2)
 * from there. So it meets the circle of u where
 *	F(u) = D (y(u) - y0) -+ dy sqrt(r(u)^2 - h^2)
 * is 0, y0 being its height at that place, D and dy the lengths of its direction's horizontal and vertical
 * parts. Both signs' F are smooth where |r| >= h, and stay sound for lines that are level or upright, where the
 * sextic that they multiply to has roots too close to tell. The extrema of both are roots of
 * D^2 y'^2 (r^2 - h^2) = dy^2 r^2 r'^2, of degree 10 for cubics. Pieces share their ends to the bit.
 */
#include "prim/body.h"
#include "prim/curve.h"
#include "prim/poly.h"

struct curve {
	unsigned n; /* degree */
	double r[4], y[4];
	double end_r[2], end_y[2];
};

struct prim_lathe {
	struct body_data head;
	struct curve *curve; /* [pieces] */
};

struct seen {
	const struct curve *c;
	double h, level, flat, rise; /* h, D y0, D, dy */
	double y, along; /* where it begins: its height, and how far past the place nearest the axis */
	double side;
};

static void at_end(const struct curve *c, double u, double *r, double *y)
{
	if (u == 0 || u == 1) {
		*r = c->end_r[u == 1];
		*y = c->end_y[u == 1];
	} else {
		*r = poly_value(c->r, c->n, u);
		*y = poly_value(c->y, c->n, u);
	}
}

static double gap(const struct seen *s, double r)
{
	double g = (fabs(r) - s->h) * (fabs(r) + s->h);

	return g > 0 ? sqrt(g) : 0;
}

static double excess(const void *arg, double u)
{
	const struct seen *s = arg;
	double r, y;

	at_end(s->c, u, &r, &y);
	return s->flat * y - s->level - s->side * s->rise * gap(s, r);
}

static double beyond(const void *arg, double u)
{
	const struct seen *s = arg;
	double r, y;

	at_end(s->c, u, &r, &y);
	return fabs(r) - s->h;
}

static unsigned sort_in(double *x, unsigned n, double v)
{
	unsigned i = n;

	for (; i && x[i - 1] > v; i--)
		x[i] = x[i - 1];
	x[i] = v;
	return n + 1;
}

/* Cuts of 0..1, ends included, between which the curve's radius and its slope keep their signs. */
static unsigned radius_cuts(const struct curve *c, double cut[7])
{
	double slope[3], root[3];
	unsigned n = 0, k;

	n = sort_in(cut, n, 0);
	n = sort_in(cut, n, 1);
	poly_slope(c->r, c->n, slope);
	k = poly_roots(slope, c->n - 1, 0, 1, root);
	while (k--)
		n = sort_in(cut, n, root[k]);
	k = poly_roots(c->r, c->n, 0, 1, root);
	while (k--)
		n = sort_in(cut, n, root[k]);
	return n;
}

static unsigned extrema(const struct seen *s, double *root)
{
	const struct curve *c = s->c;
	double rr[7], dr[3], dy[3], dyy[5], rdr[6], left[11], right[11];
	unsigned n = c->n;

	poly_mul(c->r, n, c->r, n, rr);
	rr[0] -= s->h * s->h;
	poly_slope(c->r, n, dr);
	poly_slope(c->y, n, dy);
	poly_mul(dy, n - 1, dy, n - 1, dyy);
	poly_mul(dyy, 2 * n - 2, rr, 2 * n, left);
	poly_mul(c->r, n, dr, n - 1, rdr);
	poly_mul(rdr, 2 * n - 1, rdr, 2 * n - 1, right);
	for (unsigned i = 0; i <= 4 * n - 2; i++)
		left[i] = s->flat * s->flat * left[i] - s->rise * s->rise * right[i];
	n = poly_roots(left, 4 * n - 2, 0, 1, root);
	/* Where one of the sides is all but 0, as a square it has no sign: its own zeros do as well. */
	return n + poly_roots(dy, c->n - 1, 0, 1, root + n);
}

struct found {
	unsigned n;
	struct body_root root[24];
};

static void add(const struct seen *s, double u, struct found *f)
{
	double r, y, t;

	if (f->n == 24)
		return;
	at_end(s->c, u, &r, &y);
	if (s->flat >= fabs(s->rise))
		t = (s->side * gap(s, r) - s->along) / s->flat;
	else
		t = (y - s->y) / s->rise;
	f->root[f->n++] = (struct body_root){ t, u };
}

/* At an end where |r| = h both signs agree, whatever rounding leaves of the difference. */
static double end_excess(const struct seen *s, double u)
{
	double r, y;

	if (u == 0 || u == 1)
		return excess(s, u);
	at_end(s->c, u, &r, &y);
	return s->flat * y - s->level;
}

/* Over [u0, u1] of one curve, where |r| >= h. */
static void search(struct seen *s, double u0, double u1, const double *cut, unsigned cuts, struct found *f)
{
	for (s->side = -1; s->side <= 1; s->side += 2) {
		double x = u0, fx = end_excess(s, u0);

		for (unsigned i = 0; i <= cuts; i++) {
			double y = i < cuts ? cut[i] : u1, fy;

			if (y <= x || y > u1)
				continue;
			fy = y == u1 ? end_excess(s, y) : excess(s, y);
			if ((fx < 0) != (fy < 0))
				add(s, poly_refine(excess, s, x, fx, y, fy), f);
			x = y;
			fx = fy;
		}
	}
}

/* Lines along the axis meet circles of their own radius. */
static void search_upright(const struct seen *s, double oy, double u0, double f0, double u1, double f1,
			   struct found *f)
{
	double u, r, y;

	if ((f0 < 0) == (f1 < 0) || f->n == 24)
		return;
	u = poly_refine(beyond, s, u0, f0, u1, f1);
	at_end(s->c, u, &r, &y);
	f->root[f->n++] = (struct body_root){ (y - oy) / s->rise, u };
}

static void search_all(const struct curve *c, vec o, vec d, struct found *f)
{
	struct seen s = { .c = c, .y = o.y, .flat = sqrt(d.x * d.x + d.z * d.z), .rise = d.y };
	double cut[7], extreme[2 * POLY_DEGREE], sorted[2 * POLY_DEGREE], x, fx, begin = 0;
	unsigned n = radius_cuts(c, cut), extremes = 0, k;

	if (s.flat > 0) {
		s.h = fabs(o.x * d.z - o.z * d.x) / s.flat;
		s.along = (o.x * d.x + o.z * d.z) / s.flat;
		s.level = s.flat * o.y - s.along * d.y;
		k = extrema(&s, extreme);
		while (k--)
			extremes = sort_in(sorted, extremes, extreme[k]);
	} else {
		s.h = sqrt(o.x * o.x + o.z * o.z);
	}
	x = cut[0];
	fx = beyond(&s, x);
	for (unsigned i = 1; i < n; i++) {
		double y = cut[i], fy = beyond(&s, y), root;

		if (!(s.flat > 0)) {
			search_upright(&s, o.y, x, fx, y, fy, f);
		} else if ((fx < 0) != (fy < 0)) {
			root = poly_refine(beyond, &s, x, fx, y, fy);
			if (fx < 0)
				begin = root;
			else
				search(&s, begin, root, sorted, extremes, f);
		}
		x = y;
		fx = fy;
	}
	if (s.flat > 0 && fx >= 0)
		search(&s, begin, 1, sorted, extremes, f);
}

static bool lathe_next(const struct prim *p, uint32_t piece, const struct prim_line *line, double from,
		       struct body_root *out)
{
	const struct prim_lathe *l = p->data;
	double len = vec_length(line->d), best = ALD_INF;
	struct found f = { .n = 0 };

	search_all(&l->curve[piece], line->o, vec_scale(line->d, 1 / len), &f);
	for (unsigned i = 0; i < f.n; i++) {
		double t = f.root[i].t / len;

		if (t > from && t < best) {
			best = t;
			*out = (struct body_root){ t, f.root[i].u };
		}
	}
	return best < ALD_INF;
}

static void lathe_surface(const struct prim *p, vec at, uint32_t piece, double u, struct prim_point *s)
{
	const struct curve *c = &((const struct prim_lathe *)p->data)->curve[piece];
	double slope[3], r, y, dr, dy, l = sqrt(at.x * at.x + at.z * at.z), x = 1, z = 0;

	at_end(c, u, &r, &y);
	poly_slope(c->r, c->n, slope);
	dr = poly_value(slope, c->n - 1, u);
	poly_slope(c->y, c->n, slope);
	dy = poly_value(slope, c->n - 1, u);
	if (l > 0) {
		x = at.x / l;
		z = at.z / l;
	}
	s->n = vec_unit(vec_make(x * dy, r < 0 ? dr : -dr, z * dy));
	if (!(vec_dot(s->n, s->n) > 0.5))
		s->n = vec_make(x, 0, z);
	s->p = vec_make(x * fabs(r), y, z * fabs(r));
}

struct height {
	const struct curve *c;
	double y;
};

static double above(const void *arg, double u)
{
	const struct height *h = arg;
	double r, y;

	at_end(h->c, u, &r, &y);
	return y - h->y;
}

/* As POV-Ray has it: whether an odd number of pieces lie further out at this height. */
static bool lathe_inside(const struct prim *p, vec at)
{
	const struct prim_lathe *l = p->data;
	double out = sqrt(at.x * at.x + at.z * at.z);
	bool in = false;

	for (uint32_t i = 0; i < l->head.pieces; i++) {
		const struct curve *c = &l->curve[i];
		struct height h = { c, at.y };
		double slope[3], cut[3], x = 0, fx = above(&h, 0), r, y;
		unsigned n;

		poly_slope(c->y, c->n, slope);
		n = poly_roots(slope, c->n - 1, 0, 1, cut);
		cut[n++] = 1;
		for (unsigned k = 0; k < n; k++) {
			double fy = above(&h, cut[k]);

			if ((fx < 0) != (fy < 0)) {
				at_end(c, poly_refine(above, &h, x, fx, cut[k], fy), &r, &y);
				in ^= fabs(r) > out;
			}
			x = cut[k];
			fx = fy;
		}
	}
	return in;
}

static double lathe_reach(const struct prim *p, uint32_t piece, vec m)
{
	const struct curve *c = &((const struct prim_lathe *)p->data)->curve[piece];
	double flat = sqrt(m.x * m.x + m.z * m.z), most = -ALD_INF;

	for (int side = -1; side <= 1; side += 2) {
		double f[4], slope[3], root[3];
		unsigned n;

		for (unsigned i = 0; i <= c->n; i++)
			f[i] = side * flat * c->r[i] + m.y * c->y[i];
		poly_slope(f, c->n, slope);
		n = poly_roots(slope, c->n - 1, 0, 1, root);
		for (unsigned i = 0; i < n; i++)
			most = fmax(most, poly_value(f, c->n, root[i]));
		for (unsigned i = 0; i < 2; i++)
			most = fmax(most, side * flat * c->end_r[i] + m.y * c->end_y[i]);
	}
	return most;
}

static uint32_t count_pieces(const struct lathe *l)
{
	static const uint32_t less[] = { [LATHE_LINEAR] = 1, [LATHE_QUADRATIC] = 2, [LATHE_CUBIC] = 3 };

	if (l->kind == LATHE_BEZIER)
		return l->count / 4;
	return l->count > less[l->kind] ? l->count - less[l->kind] : 0;
}

void curve_term(enum lathe_kind kind, const double p[4], double c[4], double end[2])
{
	end[0] = p[kind == LATHE_QUADRATIC || kind == LATHE_CUBIC];
	end[1] = p[kind == LATHE_LINEAR ? 1 : kind == LATHE_BEZIER ? 3 : 2];
	c[0] = end[0];
	switch (kind) {
	case LATHE_LINEAR:
		c[1] = p[1] - p[0];
		break;
	case LATHE_QUADRATIC:
		c[1] = (p[2] - p[0]) / 2;
		c[2] = (p[0] + p[2]) / 2 - p[1];
		break;
	case LATHE_CUBIC:
		c[1] = (p[2] - p[0]) / 2;
		c[2] = p[0] - 2.5 * p[1] + 2 * p[2] - p[3] / 2;
		c[3] = 1.5 * (p[1] - p[2]) + (p[3] - p[0]) / 2;
		break;
	case LATHE_BEZIER:
		c[1] = 3 * (p[1] - p[0]);
		c[2] = 3 * (p[0] - 2 * p[1] + p[2]);
		c[3] = p[3] - p[0] + 3 * (p[1] - p[2]);
		break;
	}
}

static void lathe_make(const struct scene *s, const struct object *o, void *data)
{
	const struct lathe *l = &s->lathe[o->shape.lathe.index];
	struct prim_lathe *out = data;
	double r = 0, lo = ALD_INF, hi = -ALD_INF;

	for (uint32_t i = 0; i < l->count; i++) {
		r = fmax(r, fabs(l->point[i][0]));
		lo = fmin(lo, l->point[i][1]);
		hi = fmax(hi, l->point[i][1]);
	}
	*out = (struct prim_lathe){ .head = { { 0, lo + (hi - lo) / 2, 0 }, fmax(r, (hi - lo) / 2),
					      count_pieces(l) }, .curve = (struct curve *)(out + 1) };
	for (uint32_t i = 0; i < out->head.pieces; i++) {
		uint32_t first = l->kind == LATHE_BEZIER ? 4 * i : i;
		struct curve *c = &out->curve[i];
		double p[2][4];

		for (uint32_t k = 0; k < 4 && first + k < l->count; k++) {
			p[0][k] = l->point[first + k][0] / out->head.size;
			p[1][k] = (l->point[first + k][1] - out->head.centre.y) / out->head.size;
		}
		c->n = curve_degree(l->kind);
		curve_term(l->kind, p[0], c->r, c->end_r);
		curve_term(l->kind, p[1], c->y, c->end_y);
	}
}

static size_t lathe_bytes(const struct scene *s, const struct object *o)
{
	return sizeof(struct prim_lathe) +
	       count_pieces(&s->lathe[o->shape.lathe.index]) * sizeof(struct curve);
}

static uint32_t lathe_shape(const struct scene *s, const struct object *o, uint32_t *count)
{
	*count = s->lathe_count;
	return o->shape.lathe.index;
}

static uint32_t lathe_pieces(const struct scene *s, const struct object *o)
{
	return count_pieces(&s->lathe[o->shape.lathe.index]);
}

const struct body_ops lathe_ops = { lathe_shape, lathe_pieces, lathe_bytes,   lathe_make,
				    lathe_reach, lathe_next,   lathe_surface, lathe_inside };
