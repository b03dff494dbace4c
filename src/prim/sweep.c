/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Sphere sweeps: all that a ball covers whose centre C(u) and radius R(u) are polynomials, piece by piece
 * (manual 3.4.5.1.13; van Wijk: Raytracing Objects Defined by Sweeping a Sphere, Eurographics 1984).
 *
 * Along a line with unit direction the ball at u covers [a - sqrt h, a + sqrt h], where a(u) is the place
 * nearest to its centre and h(u) = R^2 - w^2, w the centre's offset from the line. Where h >= 0 these
 * spans change without a break, so each interval of u with h >= 0 covers one span of the line, from the
 * least a - sqrt h to the greatest a + sqrt h: no root of the quartic or worse in the line's own
 * parameter is needed, and nothing can slip through. The extrema are at the ends or where
 * 4 h a'^2 = h'^2, of degree 10 for cubics. They are stationary, so that an error e in u moves the
 * surface by no more than e^2 of its curvature. Degree and order come out of the interval's own frame,
 * because a thin hair's h is tiny elsewhere.
 *
 * Every piece is a primitive, so that boxes fit. What lies within another piece is no surface: an end of
 * a span counts only if no other piece's span holds it; of equal ends the first piece's counts. Pieces
 * share the balls between them to the bit, so that their spans overlap or neither is there.
 */
#include "prim/sweep.h"

#include "prim/poly.h"

static double square_gap(double r, double x, double y, double z)
{
	double l = sqrt(x * x + y * y + z * z);

	return (r - l) * (r + l);
}

double sweep_seen_h(const void *arg, double u)
{
	const struct seen *s = arg;

	return square_gap(poly_value(s->r, s->n, u), poly_value(s->x, s->n, u), poly_value(s->y, s->n, u),
			  poly_value(s->z, s->n, u));
}

static void see_term(struct seen *s, unsigned i, vec c, vec d)
{
	double a = vec_dot(c, d);

	s->a[i] = a;
	s->x[i] = c.x - a * d.x;
	s->y[i] = c.y - a * d.y;
	s->z[i] = c.z - a * d.z;
}

static void see(const struct prim_sweep *w, uint32_t i, vec o, vec d, struct seen *s)
{
	const struct curve *c = w->curve ? &w->curve[i] : NULL;
	const struct ball *k = &w->knot[i];

	s->n = c ? 3 : 1;
	see_term(s, 0, vec_sub(k[0].c, o), d);
	s->r[0] = c ? c->r[0] : k[0].r; /* a spline can swing below 0: its balls are as large as |R| */
	if (!c) {
		see_term(s, 1, vec_sub(k[1].c, k[0].c), d);
		s->r[1] = k[1].r - k[0].r;
		return;
	}
	for (unsigned n = 1; n <= 3; n++) {
		see_term(s, n, vec_make(c->x[n], c->y[n], c->z[n]), d);
		s->r[n] = c->r[n];
	}
}

double sweep_knot_h(const struct ball *k, vec o, vec d, double *a)
{
	struct seen s;

	see_term(&s, 0, vec_sub(k->c, o), d);
	*a = s.a[0];
	return square_gap(k->r, s.x[0], s.y[0], s.z[0]);
}

/* Is the origin surely farther from the curve's control points than any radius? A curve lies within
 * their hull; they are seen along the way to the nearest point of the chord. */
static bool passes_by(const struct seen *s)
{
	double x[4], y[4], z[4], r[4], most = 0, t, l, qx, qy, qz, dx, dy, dz;
	unsigned n = s->n;

	x[0] = s->x[0], y[0] = s->y[0], z[0] = s->z[0], r[0] = s->r[0];
	if (n == 1) {
		x[1] = x[0] + s->x[1], y[1] = y[0] + s->y[1], z[1] = z[0] + s->z[1];
		r[1] = r[0] + s->r[1];
	} else {
		const double *from[4] = { s->x, s->y, s->z, s->r };
		double *to[4] = { x, y, z, r };

		for (unsigned k = 0; k < 4; k++) {
			to[k][1] = from[k][0] + from[k][1] / 3;
			to[k][2] = from[k][0] + (2 * from[k][1] + from[k][2]) / 3;
			to[k][3] = from[k][0] + from[k][1] + from[k][2] + from[k][3];
		}
	}
	for (unsigned k = 0; k <= n; k++)
		most = fmax(most, fabs(r[k]));
	dx = x[n] - x[0], dy = y[n] - y[0], dz = z[n] - z[0];
	t = -(x[0] * dx + y[0] * dy + z[0] * dz) / (dx * dx + dy * dy + dz * dz);
	t = t > 0 ? (t < 1 ? t : 1) : 0; /* NaN: 0 */
	qx = x[0] + t * dx, qy = y[0] + t * dy, qz = z[0] + t * dz;
	l = sqrt(qx * qx + qy * qy + qz * qz);
	most = (most * (1 + 16 * ALD_U) + 64 * ALD_U) * l;
	for (unsigned k = 0; k <= n; k++) {
		if (!(x[k] * qx + y[k] * qy + z[k] * qz > most))
			return false;
	}
	return true;
}

/* h's coefficients, of degree 2 n. */
static void expand(const struct seen *s, double *h)
{
	const double *part[3] = { s->x, s->y, s->z };
	double square[7];

	poly_mul(s->r, s->n, s->r, s->n, h);
	for (unsigned k = 0; k < 3; k++) {
		poly_mul(part[k], s->n, part[k], s->n, square);
		for (unsigned i = 0; i <= 2 * s->n; i++)
			h[i] -= square[i];
	}
}

static void stretch(struct span *out, double a, double h, double u)
{
	double half = h > 0 ? sqrt(h) : 0;

	if (a - half < out->lo) {
		out->lo = a - half;
		out->u_lo = u;
	}
	if (a + half > out->hi) {
		out->hi = a + half;
		out->u_hi = u;
	}
}

unsigned sweep_touches(struct seen *s, double u0, double u1, double u[SWEEP_TOUCHES], unsigned *clean)
{
	double h[7], dh[6], da[3], aa[5], p[11], q[11];
	unsigned n = s->n;

	poly_shift(s->a, n, u0, u1 - u0);
	poly_shift(s->x, n, u0, u1 - u0);
	poly_shift(s->y, n, u0, u1 - u0);
	poly_shift(s->z, n, u0, u1 - u0);
	poly_shift(s->r, n, u0, u1 - u0);
	expand(s, h);
	poly_slope(h, 2 * n, dh);
	poly_slope(s->a, n, da);
	poly_mul(da, n - 1, da, n - 1, aa);
	poly_mul(h, 2 * n, aa, 2 * n - 2, p);
	poly_mul(dh, 2 * n - 1, dh, 2 * n - 1, q);
	for (unsigned i = 0; i <= 4 * n - 2; i++)
		p[i] = 4 * p[i] - q[i];
	*clean = poly_roots(p, 4 * n - 2, 0, 1, u);
	/* Where the curve runs across the line, a' is 0 and the two roots are one without a change of sign,
	 * at h' = 0. Where a' is nearly 0 that is as good a place as the true ones. */
	return *clean + poly_roots(dh, 2 * n - 1, 0, 1, u + *clean);
}

static void stretch_between(const struct seen *whole, double u0, double u1, struct span *out)
{
	double root[SWEEP_TOUCHES];
	struct seen s = *whole;
	unsigned clean, roots = sweep_touches(&s, u0, u1, root, &clean);

	for (unsigned i = 0; i < roots; i++)
		stretch(out, poly_value(s.a, s.n, root[i]), sweep_seen_h(&s, root[i]), u0 + root[i] * (u1 - u0));
}

/* One interval of u where h >= 0. An end that is a knot has its exact ball. */
static void add_span(const struct seen *s, double u0, double u1, const double a[2], const double h[2],
		     struct span *out)
{
	*out = (struct span){ ALD_INF, -ALD_INF, u0, u0, u0, u1 };
	if (u0 == 0)
		stretch(out, a[0], h[0], 0);
	else
		stretch(out, poly_value(s->a, s->n, u0), sweep_seen_h(s, u0), u0);
	if (u1 == 1)
		stretch(out, a[1], h[1], 1);
	else
		stretch(out, poly_value(s->a, s->n, u1), sweep_seen_h(s, u1), u1);
	if (u1 > u0)
		stretch_between(s, u0, u1, out);
}

unsigned sweep_spans(const struct prim_sweep *w, uint32_t i, vec o, vec d, struct seen *s, struct span out[SPANS])
{
	double h[7], slope[6], cut[7], a[2], end[2], x = 0, fx, begin = 0;
	unsigned cuts, count = 0;

	see(w, i, o, d, s);
	if (passes_by(s))
		return 0;
	end[0] = sweep_knot_h(&w->knot[i], o, d, &a[0]);
	end[1] = sweep_knot_h(&w->knot[i + 1], o, d, &a[1]);
	expand(s, h);
	poly_slope(h, 2 * s->n, slope);
	cuts = poly_roots(slope, 2 * s->n - 1, 0, 1, cut);
	cut[cuts++] = 1;
	fx = end[0];
	for (unsigned k = 0; k < cuts; k++) {
		double y = cut[k], fy = y == 1 ? end[1] : sweep_seen_h(s, y), root;

		if ((fx < 0) != (fy < 0)) {
			root = poly_refine(sweep_seen_h, s, x, fx, y, fy);
			if (fx < 0)
				begin = root;
			else if (count < SPANS)
				add_span(s, begin, root, a, end, &out[count++]);
		}
		x = y;
		fx = fy;
	}
	if (fx >= 0 && count < SPANS)
		add_span(s, begin, 1, a, end, &out[count++]);
	if (!w->curve && count == 2) { /* a straight piece is convex */
		stretch(&out[0], out[1].lo, 0, out[1].u_lo);
		stretch(&out[0], out[1].hi, 0, out[1].u_hi);
		count = 1;
	}
	return count;
}

static struct ball around(const struct prim_sweep *w, uint32_t i)
{
	const struct ball *k = &w->knot[i];
	struct ball b;

	if (w->curve)
		return w->curve[i].around;
	b.c = vec_scale(vec_add(k[0].c, k[1].c), 0.5);
	b.r = 0.5 * vec_length(vec_sub(k[1].c, k[0].c)) + fmax(k[0].r, k[1].r);
	return b;
}

/* Is the end at s of a span of piece i inside another span? */
static bool hidden_by(const struct span *by, double s, bool lower, bool first)
{
	if (lower)
		return (by->lo < s || (by->lo == s && first)) && by->hi >= s;
	return (by->hi > s || (by->hi == s && first)) && by->lo <= s;
}

static bool hidden(const struct prim_sweep *w, uint32_t i, vec o, vec d, double s, bool lower)
{
	vec q = vec_mad(o, d, s);
	struct span other[SPANS];
	struct seen seen;

	for (uint32_t k = 0; k < w->head.pieces; k++) {
		struct ball b;
		vec off;
		unsigned n;

		if (k == i)
			continue;
		b = around(w, k);
		off = vec_sub(q, b.c);
		b.r = b.r * (1 + 64 * ALD_U) + 64 * ALD_U;
		if (vec_dot(off, off) > b.r * b.r)
			continue;
		n = sweep_spans(w, k, o, d, &seen, other);
		for (unsigned j = 0; j < n; j++) {
			if (hidden_by(&other[j], s, lower, k < i))
				return true;
		}
	}
	return false;
}

static bool sweep_next(const struct prim *p, uint32_t piece, const struct prim_line *line, double from,
		       struct body_root *out)
{
	const struct prim_sweep *w = p->data;
	double len = vec_length(line->d);
	vec o = line->o, d = vec_scale(line->d, 1 / len);
	struct span own[SPANS];
	struct seen seen;
	unsigned n;

	if (p->inner)
		return sweep_inner_next(p, piece, line, from, out);
	n = sweep_spans(w, piece, o, d, &seen, own);
	while (n) {
		double best = ALD_INF, u = 0;
		bool lower = false;
		unsigned which = 0;

		for (unsigned j = 0; j < n; j++) {
			if (own[j].lo / len > from && own[j].lo < best) {
				best = own[j].lo, u = own[j].u_lo, lower = true, which = j;
			}
			if (own[j].hi / len > from && own[j].hi < best) {
				best = own[j].hi, u = own[j].u_hi, lower = false, which = j;
			}
		}
		if (!(best < ALD_INF))
			return false;
		from = best / len;
		for (unsigned j = 0; j < n && best < ALD_INF; j++) {
			if (j != which && hidden_by(&own[j], best, lower, j < which))
				best = ALD_INF;
		}
		if (best < ALD_INF && !hidden(w, piece, o, d, best, lower)) {
			*out = (struct body_root){ from, u };
			return true;
		}
	}
	return false;
}

static struct ball ball_at(const struct prim_sweep *w, uint32_t i, double u)
{
	const struct ball *k = &w->knot[i];
	const struct curve *c;

	if (u == 0 || u == 1)
		return k[u == 1];
	if (!w->curve)
		return (struct ball){ vec_mad(k[0].c, vec_sub(k[1].c, k[0].c), u),
				      k[0].r + u * (k[1].r - k[0].r) };
	c = &w->curve[i];
	return (struct ball){ { poly_value(c->x, 3, u), poly_value(c->y, 3, u), poly_value(c->z, 3, u) },
			      poly_value(c->r, 3, u) };
}

static void sweep_surface(const struct prim *p, vec at, uint32_t piece, double u, struct prim_point *s)
{
	struct ball b;
	vec n;

	if (u >= SWEEP_DISC) {
		sweep_inner_surface(p->data, at, piece, u > SWEEP_DISC, s);
		return;
	}
	b = ball_at(p->data, piece, u);
	n = vec_sub(at, b.c);
	s->n = vec_unit(n);
	if (!(vec_dot(s->n, s->n) > 0.5)) /* the tip of a radius of 0 */
		s->n = vec_make(0, 0, 1);
	s->p = vec_mad(b.c, s->n, fabs(b.r));
}

/* Along any line through the point, is it between the ends of a span? */
static bool sweep_inside(const struct prim *p, vec at)
{
	const struct prim_sweep *w = p->data;
	struct span own[SPANS];
	struct seen seen;

	for (uint32_t i = 0; i < w->head.pieces; i++) {
		struct ball b = around(w, i);
		vec off = vec_sub(at, b.c);
		unsigned n;

		if (vec_dot(off, off) > b.r * b.r * (1 + 64 * ALD_U))
			continue;
		n = sweep_spans(w, i, at, vec_make(0, 0, 1), &seen, own);
		for (unsigned k = 0; k < n; k++) {
			if (own[k].lo <= 0 && own[k].hi >= 0)
				return true;
		}
	}
	return false;
}

/* The greatest of C(u).m + R(u) |m| over the piece. */
static double sweep_reach(const struct prim *p, uint32_t piece, vec m)
{
	const struct prim_sweep *w = p->data;
	const struct ball *k = &w->knot[piece];
	double l = vec_length(m), most;

	most = fmax(vec_dot(k[0].c, m) + k[0].r * l, vec_dot(k[1].c, m) + k[1].r * l);
	for (int side = -1; w->curve && side <= 1; side += 2) {
		const struct curve *c = &w->curve[piece];
		double f[4], slope[3], root[3];
		unsigned n;

		for (unsigned i = 0; i < 4; i++)
			f[i] = c->x[i] * m.x + c->y[i] * m.y + c->z[i] * m.z + side * c->r[i] * l;
		poly_slope(f, 3, slope);
		n = poly_roots(slope, 2, 0, 1, root);
		for (unsigned i = 0; i < n; i++)
			most = fmax(most, poly_value(f, 3, root[i]));
	}
	return most;
}

static uint32_t sweep_pieces(const struct sweep *w)
{
	uint32_t less = w->kind == SWEEP_LINEAR ? 1 : 3;

	return w->count > less ? w->count - less : 0;
}

static void canonical(const struct sweep *w, vec *centre, double *size)
{
	ald_box b = ald_box_empty();

	for (uint32_t i = 0; i < w->count; i++) {
		vec c = vec_make(w->point[i][0], w->point[i][1], w->point[i][2]);
		double r = fabs(w->point[i][3]);

		ald_box_join(&b, &(ald_box){ vec_sub(c, vec_make(r, r, r)), vec_add(c, vec_make(r, r, r)) });
	}
	*centre = vec_mad(b.lo, vec_sub(b.hi, b.lo), 0.5);
	*size = fmax(b.hi.x - b.lo.x, fmax(b.hi.y - b.lo.y, b.hi.z - b.lo.z)) / 2;
}

static void own_point(const struct sweep *w, uint32_t i, const struct body_data *head, double out[4])
{
	for (unsigned k = 0; k < 3; k++)
		out[k] = (w->point[i][k] - (&head->centre.x)[k]) / head->size;
	out[3] = w->point[i][3] / head->size;
}

/* Catmull and Rom's and the uniform B-spline, by powers of u. */
static void curve_term(enum sweep_kind kind, const double q[4], double out[4])
{
	if (kind == SWEEP_CUBIC) {
		out[0] = q[1];
		out[1] = (q[2] - q[0]) / 2;
		out[2] = q[0] - 2.5 * q[1] + 2 * q[2] - q[3] / 2;
		out[3] = 1.5 * (q[1] - q[2]) + (q[3] - q[0]) / 2;
	} else {
		out[0] = (q[0] + 4 * q[1] + q[2]) / 6;
		out[1] = (q[2] - q[0]) / 2;
		out[2] = (q[0] + q[2]) / 2 - q[1];
		out[3] = (q[3] - q[0]) / 6 + (q[1] - q[2]) / 2;
	}
}

/* By the hull of the control points. */
static struct ball curve_ball(const struct curve *c)
{
	const double *term[4] = { c->x, c->y, c->z, c->r };
	double b[4][4];
	struct ball out = { { 0, 0, 0 }, 0 };
	vec mid;

	for (unsigned k = 0; k < 4; k++) {
		const double *f = term[k];

		b[0][k] = f[0];
		b[1][k] = f[0] + f[1] / 3;
		b[2][k] = f[0] + (2 * f[1] + f[2]) / 3;
		b[3][k] = f[0] + f[1] + f[2] + f[3];
	}
	mid = vec_scale(vec_make(b[0][0] + b[3][0], b[0][1] + b[3][1], b[0][2] + b[3][2]), 0.5);
	out.c = mid;
	for (unsigned i = 0; i < 4; i++)
		out.r = fmax(out.r, vec_length(vec_sub(vec_make(b[i][0], b[i][1], b[i][2]), mid)) +
					    fabs(b[i][3]));
	return out;
}

static void make_curves(struct prim_sweep *out, const struct sweep *w)
{
	for (uint32_t i = 0; i < out->head.pieces; i++) {
		struct curve *c = &out->curve[i];
		double *term[4] = { c->x, c->y, c->z, c->r }, q[4][4];

		for (uint32_t j = 0; j < 4; j++)
			own_point(w, i + j, &out->head, q[j]);
		for (unsigned k = 0; k < 4; k++) {
			double column[4] = { q[0][k], q[1][k], q[2][k], q[3][k] };

			curve_term(w->kind, column, term[k]);
		}
		c->around = curve_ball(c);
		out->knot[i] = (struct ball){ { c->x[0], c->y[0], c->z[0] }, fabs(c->r[0]) };
		out->knot[i + 1] = (struct ball){ { poly_value(c->x, 3, 1), poly_value(c->y, 3, 1),
						    poly_value(c->z, 3, 1) }, fabs(poly_value(c->r, 3, 1)) };
	}
}

static size_t sweep_bytes(const struct scene *s, const struct object *o)
{
	const struct sweep *w = &s->sweep[o->shape.sweep];
	size_t n = sweep_pieces(w);

	return sizeof(struct prim_sweep) + (n + 1) * sizeof(struct ball) +
	       (w->kind == SWEEP_LINEAR ? 0 : n * sizeof(struct curve));
}

static void sweep_make(const struct scene *s, const struct object *o, void *data)
{
	const struct sweep *w = &s->sweep[o->shape.sweep];
	struct prim_sweep *out = data;

	*out = (struct prim_sweep){ .head.pieces = sweep_pieces(w), .knot = (struct ball *)(out + 1) };
	canonical(w, &out->head.centre, &out->head.size);
	if (w->kind != SWEEP_LINEAR) {
		out->curve = (struct curve *)(out->knot + out->head.pieces + 1);
		make_curves(out, w);
		return;
	}
	for (uint32_t i = 0; i < w->count; i++) {
		double q[4];

		own_point(w, i, &out->head, q);
		out->knot[i] = (struct ball){ { q[0], q[1], q[2] }, fabs(q[3]) };
	}
}

static uint32_t sweep_shape(const struct scene *s, const struct object *o, uint32_t *count)
{
	*count = s->sweep_count;
	return o->shape.sweep;
}

static uint32_t sweep_count(const struct scene *s, const struct object *o)
{
	return sweep_pieces(&s->sweep[o->shape.sweep]);
}

const struct body_ops sweep_ops = { sweep_shape, sweep_count,	sweep_bytes,   sweep_make,
				    sweep_reach, sweep_next, sweep_surface, sweep_inside };
